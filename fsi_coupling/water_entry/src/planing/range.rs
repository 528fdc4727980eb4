//! Where the loads of planing hulls are compared with towing tanks, and their errors there (`planing`, Savitsky 1964).

use super::hull::{PlaningHull, Wetted};

/// Band of the lift in the range of [`PlaningHull::not_judged`]: more than nine of ten errors are within it, the largest is 0.105 [-].
pub const LIFT_BAND: f64 = 0.09;
/// Band of the place of the lift there, likewise; the largest error is 0.055, over the mean wetted length [-].
pub const CENTRE_BAND: f64 = 0.045;

/// Compared deadrises [deg], trims [deg], mean wetted lengths over the breadth [-] and C_v [-].
const DEADRISES: [f64; 2] = [10.0, 30.0];
const TRIMS: [f64; 2] = [4.0, 12.0];
const LENGTHS: [f64; 2] = [1.0, 3.0];
const FROUDE: [f64; 2] = [4.0, 12.0];
/// Longest length of keel over the breadth with dry chines [-]: at 2.6, a deadrise of 30° at 4°, the lift was up to 16 % high.
const LONGEST_SPRAY_ROOT: f64 = 2.0;
/// Ends of ranges include numbers that differ by rounding.
const ROUNDING: f64 = 1e-9;

impl PlaningHull {
    /// Why the load of a hull has no band: no comparison is known there, or the errors were larger; `None` where [`LIFT_BAND`] and
    /// [`CENTRE_BAND`] hold.
    pub fn not_judged(&self, wetted: &Wetted) -> Option<String> {
        let ranges = [
            ("a deadrise", self.deadrise_deg, DEADRISES, " degrees"),
            ("a trim", self.trim_deg, TRIMS, " degrees"),
            ("a wetted length", wetted.mean, LENGTHS, " breadths"),
            ("a C_v", self.froude(), FROUDE, ""),
        ];
        let outside =
            |value: f64, [least, most]: [f64; 2]| value < least * (1.0 - ROUNDING) || value > most * (1.0 + ROUNDING);
        let mut whys: Vec<String> = Vec::new();
        for (what, value, range, unit) in ranges {
            if outside(value, range) {
                let value = (1e4 * value).round() / 1e4;
                whys.push(format!("{what} of {value}{unit}; compared with tests: {} to {}", range[0], range[1]));
            }
        }
        if wetted.chine <= 0.0 {
            whys.push("the chines are dry; tests: wet chines".to_string());
        } else if self.spray_root() > LONGEST_SPRAY_ROOT {
            let length = self.spray_root();
            whys.push(format!(
                "dry chines on {length:.2} breadths of the keel; compared with tests: up to {LONGEST_SPRAY_ROOT}"
            ));
        }
        (!whys.is_empty()).then(|| whys.join("; "))
    }
}
