//! A prismatic hull that planes, and its wetted bottom (THEORY EN42).

use std::f64::consts::PI;

use crate::{EntryModel, Loads, Section};

/// Least C_v: at lower speeds a hull floats more than it planes, and tests have none (Savitsky 1964).
const LEAST_FROUDE: f64 = 0.6;
/// Trims at which a section sinks slowly beside the speed [deg].
const TRIMS: [f64; 2] = [0.5, 30.0];
/// Mean wetted lengths over the breadth [-].
const LENGTHS: [f64; 2] = [0.05, 20.0];

/// A prismatic V-hull with a transom, at a trim and a steady speed on calm water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaningHull {
    /// Breadth between the chines b [m].
    pub breadth: f64,
    /// Deadrise β [deg], 4 to 60.
    pub deadrise_deg: f64,
    /// Angle of the keel over the water τ [deg], 0.5 to 30.
    pub trim_deg: f64,
    /// Speed U [m/s].
    pub speed: f64,
    /// Density of the water [kg/m³].
    pub density: f64,
    /// Acceleration of gravity [m/s²].
    pub gravity: f64,
}

/// How deep a hull is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Immersion {
    /// Mean wetted length over the breadth λ [-], 0.05 to 20: wetted area over b².
    WettedLength(f64),
    /// Draught of the keel at the step below still water [m].
    Draught(f64),
}

/// The wetted bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wetted {
    /// Wetted length of the keel [m].
    pub keel: f64,
    /// Wetted length of a chine [m]; 0 where the chines are dry.
    pub chine: f64,
    /// Mean wetted length over the breadth λ [-]: wetted area over b², with wet chines the mean of both lengths over b.
    pub mean: f64,
    /// Draught of the keel at the step [m].
    pub draught: f64,
    /// Wetted breadth at the step [m].
    pub breadth: f64,
}

/// A hull that the method does not hold for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{what} {value}: expected {expected}")]
pub struct NotPlaning {
    /// Which number: `breadth`, `deadrise_deg`, `trim_deg`, `speed`, `density`, `gravity`, `wetted_length`, `draught` or `convergence`.
    pub what: &'static str,
    /// Its value.
    pub value: f64,
    /// What was expected.
    pub expected: String,
}

/// Refuses a number without its property.
pub(super) fn require(holds: bool, what: &'static str, value: f64, expected: &str) -> Result<(), NotPlaning> {
    if holds { Ok(()) } else { Err(NotPlaning { what, value, expected: expected.to_string() }) }
}

impl PlaningHull {
    /// C_v = U/√(g b) [-].
    pub fn froude(&self) -> f64 {
        self.speed / (self.gravity * self.breadth).sqrt()
    }

    /// ½ρ U² b² [N], over which the lift coefficient is.
    pub fn reference_force(&self) -> f64 {
        0.5 * self.density * (self.speed * self.breadth).powi(2)
    }

    pub(super) fn trim(&self) -> f64 {
        self.trim_deg.to_radians()
    }

    /// Length of keel over the breadth on which the chines ahead of their wet part are dry, tan β/(π sin τ) (Wagner 1932) [-].
    pub fn spray_root(&self) -> f64 {
        self.deadrise_deg.to_radians().tan() / (PI * self.trim().sin())
    }

    /// EN42: the wetted bottom.
    ///
    /// # Errors
    /// A number out of the method's range.
    pub fn wetted(&self, immersion: Immersion) -> Result<Wetted, NotPlaning> {
        self.check()?;
        let (b, dry) = (self.breadth, self.spray_root());
        // a spray root from the keel's front to the chine, or to the step
        let keel_of = |mean: f64| if mean >= 0.5 * dry { mean + 0.5 * dry } else { (2.0 * dry * mean).sqrt() };
        let [least, most] = LENGTHS;
        let keel = match immersion {
            Immersion::WettedLength(mean) => {
                require((least..=most).contains(&mean), "wetted_length", mean, &format!("{least} to {most} breadths"))?;
                keel_of(mean)
            }
            Immersion::Draught(draught) => {
                let [shallow, deep] = LENGTHS.map(|mean| keel_of(mean) * b * self.trim().sin());
                let range = format!("{shallow:.4} to {deep:.4} m, wetted lengths of {least} to {most} breadths");
                require((shallow..=deep).contains(&draught), "draught", draught, &range)?;
                draught / (b * self.trim().sin())
            }
        };
        let mean = if keel >= dry { keel - 0.5 * dry } else { keel * keel / (2.0 * dry) };
        Ok(Wetted {
            keel: b * keel,
            chine: b * (keel - dry).max(0.0),
            mean,
            draught: b * keel * self.trim().sin(),
            breadth: b * (keel / dry).min(1.0),
        })
    }

    fn check(&self) -> Result<(), NotPlaning> {
        let above = |what, value: f64| require(value > 0.0 && value.is_finite(), what, value, "a number above 0");
        above("breadth", self.breadth)?;
        above("density", self.density)?;
        above("gravity", self.gravity)?;
        above("speed", self.speed)?;
        let [least, most] = EntryModel::Mlm.deadrises();
        let range = format!("{least} to {most} degrees");
        require((least..=most).contains(&self.deadrise_deg), "deadrise_deg", self.deadrise_deg, &range)?;
        let range = format!("{} to {} degrees", TRIMS[0], TRIMS[1]);
        require((TRIMS[0]..=TRIMS[1]).contains(&self.trim_deg), "trim_deg", self.trim_deg, &range)?;
        let slowest = LEAST_FROUDE * (self.gravity * self.breadth).sqrt();
        let expected = format!("at least {slowest:.4} m/s, {LEAST_FROUDE} times the root of gravity times breadth");
        require(self.froude() >= LEAST_FROUDE, "speed", self.speed, &expected)
    }

    /// Loads of its section at a breadth of 1.
    pub(super) fn loads(&self) -> Result<Loads, NotPlaning> {
        let refused = |error: crate::OutOfRange| NotPlaning {
            what: "deadrise_deg",
            value: self.deadrise_deg,
            expected: error.range,
        };
        let section = Section::wedge(self.deadrise_deg, 1.0).map_err(refused)?;
        Loads::new(EntryModel::Mlm, &section).map_err(refused)
    }
}
