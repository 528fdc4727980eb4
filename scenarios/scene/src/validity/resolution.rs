//! How many spacings a draught, or the length of a peak, needs, and how wide the bands then are (THEORY GE19).

use settings::significant;

use crate::bottom::Bottom;
use crate::impact::Entry;
use crate::vocabulary::Why;

/// Least draught at a peak (THEORY GE19) [spacings].
pub const LEAST_DRAUGHT: f64 = 6.0;

/// Spacings across the length with 90 % of the peak pressure that give the peak to 2–4 %; 5 give it to 25 %.
pub const PEAK_SPACINGS: f64 = 17.0;
/// Bands of a peak pressure by the spacings across the length with 90 % of the peak: least length, share of the pressure [-].
const PRESSURE_BANDS: [(f64, f64); 2] = [(PEAK_SPACINGS, 0.04), (5.0, 0.25)];
/// Band of a peak force times its draught in spacings, weakly compressible and incompressible, shares of the force [-].
const FORCE_BAND: [f64; 2] = [0.28, 1.0];
/// The least band of a peak force, a share of it [-].
const LEAST_FORCE_BAND: f64 = 0.02;
/// The same of an impulse, of wedges and of round bottoms, each weakly compressible and incompressible, shares of the impulse [-].
const IMPULSE_BAND: [[f64; 2]; 2] = [[0.55, 1.3], [0.75, 2.0]];
const LEAST_IMPULSE_BAND: [[f64; 2]; 2] = [[0.015, 0.03], [0.02, 0.05]];
/// What unequal faces beside a keel add to an impulse in weakly compressible water, times k over the difference of their slopes: 7 % at 30°
/// rolled by 20° and 9.7 spacings [-].
const UNEQUAL_FACES: f64 = 0.6;
/// What the tip of a wedge steeper than 45 degrees, which is thinner than the kernel, adds to the force times k/tan²β: weakly
/// compressible and incompressible [-].
const THIN_TIP: [f64; 2] = [0.15, 0.5];
/// A force with a band wider than this is not resolved [-].
const WIDEST: f64 = 0.4;

/// A draught [m], resolved by a spacing [m].
#[derive(Clone, Copy)]
pub struct Depth {
    /// The draught [m].
    pub draught: f64,
    /// The spacing [m].
    pub spacing: f64,
    /// Whether the water is incompressible.
    pub incompressible: bool,
}

impl Depth {
    fn spacings(self) -> f64 {
        self.draught / self.spacing
    }

    /// Share of a force in its band, or why it is not resolved.
    pub fn force_share(self, entry: &Entry) -> Result<f64, Why> {
        if self.spacings() < LEAST_DRAUGHT {
            // where theory has it deeper, the run's peak is one of first contact
            let cure = (entry.peak_draught / LEAST_DRAUGHT).min(0.5 * self.spacing);
            let cure = format!("{LEAST_DRAUGHT} are needed{}", advice(cure));
            return Err(Why::shallow("the peak comes at a draught of", self.spacings().max(0.0), cure));
        }
        let at_one_spacing = FORCE_BAND[usize::from(self.incompressible)];
        self.within_widest(((at_one_spacing + self.thin_tip(entry)) / self.spacings()).max(LEAST_FORCE_BAND))
    }

    /// Share of an impulse in its band, or why it is not resolved; of the largest draught of the run.
    pub fn impulse_share(self, entry: &Entry) -> Result<f64, Why> {
        let round = matches!(entry.bottom, Bottom::Arc { .. });
        let least = if round { self.draught } else { self.draught.min(entry.peak_draught) };
        if least < LEAST_DRAUGHT * self.spacing {
            let cure = format!("{LEAST_DRAUGHT} are needed{}", advice(least / LEAST_DRAUGHT));
            return Err(Why::shallow("the draught at the end or at the largest force is", least / self.spacing, cure));
        }
        let solver = usize::from(self.incompressible);
        let at_one_spacing = IMPULSE_BAND[usize::from(round)][solver];
        let of_faces = if self.incompressible { 0.0 } else { UNEQUAL_FACES * entry.unequal_faces };
        // past wet chines an incompressible impulse is no nearer than at them
        let at_chines = entry.bottom.draught_at(entry.half_breadth);
        let counts = if self.incompressible && !round { self.draught.min(at_chines) } else { self.draught };
        let share = (at_one_spacing + 2.0 * self.thin_tip(entry) + of_faces) * self.spacing / counts;
        self.within_widest(share.max(LEAST_IMPULSE_BAND[usize::from(round)][solver]))
    }

    fn within_widest(self, share: f64) -> Result<f64, Why> {
        let why = || {
            format!(
                "its band is {} %, because the draught is small or the tip of a steep wedge thinner than the kernel: {} m would do for \
                 resolution.spacing",
                significant(100.0 * share),
                significant(self.spacing * WIDEST / share)
            )
        };
        if share > WIDEST { Err(why().into()) } else { Ok(share) }
    }

    /// Share of a force or of a pressure that the tip of a steep wedge adds.
    pub fn tip_share(self, entry: &Entry) -> f64 {
        self.thin_tip(entry) / self.spacings()
    }

    fn thin_tip(self, entry: &Entry) -> f64 {
        match entry.bottom {
            Bottom::Wedge { slope } if slope > 1.0 => THIN_TIP[usize::from(self.incompressible)] * slope * slope,
            _ => 0.0,
        }
    }
}

/// Share of a pressure peak in its band, or why it is not resolved: of the length of the face with 90 % of the peak [spacings].
pub fn pressure_share(spacings: f64) -> Result<f64, Why> {
    let band = PRESSURE_BANDS.iter().find(|(least, _)| spacings >= *least);
    band.map(|(_, share)| *share).ok_or_else(|| {
        let (length, least) = (significant(spacings), PRESSURE_BANDS[1].0);
        format!("the length with 90 % of the peak is {length} spacings; {least} are needed").into()
    })
}

/// The spacing that would do [m]; none does for a body that is not in the water.
fn advice(spacing: f64) -> String {
    match spacing > 0.0 {
        true => format!(": {} m would do for resolution.spacing", significant(spacing)),
        false => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::compressibility::lost_beyond;
    use super::*;
    use crate::load;

    fn entry(deadrise: f64) -> Entry {
        let sets = [format!("body.deadrise_deg={deadrise}"), "body.breadth=200".to_string()];
        load("wedge_constant", &sets).expect("a scene").scene.entry().expect("an entry")
    }

    /// A wedge of 30° rolled by 20° at 9.7 and 19.4 spacings: impulses 7.4 and 4 % above the exact ones. An incompressible wedge of 12° past its
    /// chines, at 25 spacings in the largest draught and 20.5 at the chines: 4.8 % below boundary elements.
    #[test]
    fn impulses_of_rolled_wedges_and_past_chines_are_within_their_bands() {
        let rolled = load("wedge_rolled", &["body.angle_deg=20".to_string()]).expect("a scene").scene.entry();
        let rolled = rolled.expect("an entry");
        let share = |spacings: f64| Depth {
            draught: rolled.peak_draught,
            spacing: rolled.peak_draught / spacings,
            incompressible: false,
        };
        assert!(share(9.7).impulse_share(&rolled).is_ok_and(|share| (0.074..0.2).contains(&share)));
        assert!(share(19.4).impulse_share(&rolled).is_ok_and(|share| (0.04..0.1).contains(&share)));
        let sets = ["body.deadrise_deg=12".to_string(), "body.breadth=0.937".to_string()];
        let wet = load("wedge_chines", &sets).expect("a scene").scene.entry().expect("an entry");
        let depth = Depth { draught: 25.0 * 0.00309, spacing: 0.00309, incompressible: true };
        assert!(depth.impulse_share(&wet).is_ok_and(|share| (0.048..0.07).contains(&share)));
    }

    /// An impulse at Mach 0.1 was 3.6 % low, with a band of 2.7 % for its draught.
    #[test]
    fn what_compressibility_takes_is_known_to_bands() {
        let entry = entry(30.0);
        let lost = |mach: f64| lost_beyond(Some(entry.root_speed() / mach), &entry);
        assert!(lost(0.1).is_ok_and(|share| share > 0.02) && lost(0.02) == Ok(0.0) && lost(0.31).is_err());
        assert_eq!(lost_beyond(None, &entry), Ok(0.0));
    }

    /// The force of the projection on steep wedges against the similarity solution, at 20 spacings of draught: +10 % (60°), +33 %
    /// (75°), impulses +10 and +35 %.
    #[test]
    fn the_band_of_a_steep_wedge_holds_what_its_thin_tip_adds() {
        let at = |draught: f64, incompressible| Depth { draught, spacing: 0.05, incompressible };
        assert!(at(1.0, true).force_share(&entry(60.0)).is_ok_and(|share| share > 0.10));
        assert!(at(1.0, true).impulse_share(&entry(60.0)).is_ok_and(|share| share > 0.10));
        assert!(at(1.0, true).force_share(&entry(75.0)).is_ok_and(|share| share > 0.33));
        assert!(at(1.0, true).force_share(&entry(79.0)).is_err());
        assert!(at(1.0, false).force_share(&entry(75.0)).is_ok_and(|share| share < 0.2));
        assert!(
            at(1.0, true)
                .impulse_share(&entry(75.0))
                .is_err_and(|why| why.text.contains("m would do for resolution.spacing"))
        );
        assert!(at(0.5, false).force_share(&entry(30.0)).is_ok_and(|share| (share - 0.028).abs() < 1e-12));
        // an oblique drop of 31 degrees at 9 spacings: 10.7 % below that at a third of its spacing
        assert!(at(0.45, true).force_share(&entry(31.0)).is_ok_and(|share| share > 0.107));
        assert!(at(0.2, false).impulse_share(&entry(30.0)).is_err_and(|why| why.text.contains("4 spacings")));
        assert!(at(0.0, false).impulse_share(&entry(30.0)).is_err_and(|why| why.text.ends_with("6 are needed")));
    }
}
