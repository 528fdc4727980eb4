//! Everything that is to be known of a region of water.

use std::collections::BTreeMap;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use sph_core::wcsph::eos::Tait;
use sph_core::{Integrator, Kernel, Parameters, Slip};

use super::error::HostError;
use super::keywords::{self, Value, keywords};

/// Least speed of sound over the fastest known speed of the flow [-] (THEORY E19).
const LEAST_SOUND_RATIO: f64 = 10.0;

/// A rectangular basin of water at rest, and the numerical scheme; what a scene file calls defaults are the defaults here.
/// It is read from and written to any format of serde's as a table of [`keywords`](super::keywords), which has units,
/// ranges and meanings.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidElementSpec {
    /// Finest particle spacing [m].
    pub spacing: f64,
    /// Half width of the basin [m].
    pub reach: f64,
    /// Depth of the water at rest [m].
    pub depth: f64,
    /// Height of still water [m].
    pub still_water: f64,
    /// Middle of the basin [m]; none: that of the wet surface.
    pub middle: Option<f64>,
    /// Height of the side walls above still water [m]; none: a quarter of the depth.
    pub rim: Option<f64>,
    /// Ratio of successive rows outside the fine zone [-].
    pub growth: f64,
    /// Half width of the fine zone [m]; none: by the wet surface.
    pub fine_half_width: Option<f64>,
    /// Depth of the fine zone [m]; none: by the wet surface.
    pub fine_depth: Option<f64>,
    /// Gravity on the water [m/s²].
    pub gravity: [f64; 2],
    /// Density of the undisturbed water ρ₀ [kg/m³].
    pub density: f64,
    /// Fastest expected speed of the flow [m/s].
    pub fastest_speed: Option<f64>,
    /// Speed of sound c₀ [m/s]; none: ten times the fastest speed.
    pub sound_speed: Option<f64>,
    /// Exponent γ of Tait's equation of state [-].
    pub eos_exponent: f64,
    /// Smoothing kernel.
    pub kernel: Kernel,
    /// Smoothing length over spacing h/Δx [-].
    pub smoothing_ratio: f64,
    /// Coefficient α of artificial viscosity [-].
    pub artificial_viscosity: f64,
    /// Kinematic viscosity ν [m²/s].
    pub kinematic_viscosity: f64,
    /// Coefficient δ of density diffusion [-].
    pub density_diffusion: f64,
    /// Particle shifting.
    pub shifting: bool,
    /// Tangential condition on walls.
    pub wall_slip: Slip,
    /// Walls feel the water stretch along them.
    pub wall_stretch: bool,
    /// Air comes in between a wall and water under tension.
    pub ventilation: bool,
    /// Time integration of the water.
    pub integrator: Integrator,
    /// Courant number [-]; none: the integrator's usual one.
    pub cfl: Option<f64>,
    /// Most steps of the water within a step of the host [-].
    pub most_substeps: f64,
}

impl FluidElementSpec {
    /// Of the three lengths that have no default [m]: the finest spacing, the basin's half width and its depth. One speed,
    /// `fastest_speed` or `sound_speed`, must be set beside them.
    pub fn new(spacing: f64, reach: f64, depth: f64) -> FluidElementSpec {
        let usual = Parameters::usual(Tait { rho0: 1000.0, c0: f64::NAN, gamma: 7.0 });
        FluidElementSpec {
            spacing,
            reach,
            depth,
            still_water: 0.0,
            middle: None,
            rim: None,
            growth: 1.1,
            fine_half_width: None,
            fine_depth: None,
            gravity: [0.0, -9.81],
            density: usual.eos.rho0,
            fastest_speed: None,
            sound_speed: None,
            eos_exponent: usual.eos.gamma,
            kernel: usual.kernel,
            smoothing_ratio: usual.smoothing_ratio,
            artificial_viscosity: usual.alpha,
            kinematic_viscosity: usual.nu,
            density_diffusion: usual.delta,
            shifting: usual.shifting,
            wall_slip: usual.slip,
            wall_stretch: usual.wall_stretch,
            ventilation: usual.ventilation,
            integrator: usual.integrator,
            cfl: None,
            most_substeps: 100_000.0,
        }
    }

    /// From keys and values: unknown keys and values out of range are refused with what was expected.
    pub fn from_keys<K: Into<String>>(
        given: impl IntoIterator<Item = (K, Value)>,
    ) -> Result<FluidElementSpec, HostError> {
        keywords::parse(&given.into_iter().map(|(key, value)| (key.into(), value)).collect())
    }

    /// Refuse a value out of its range, wherever it came from.
    pub(super) fn check(&self) -> Result<(), HostError> {
        for key in keywords() {
            match (key.get)(self) {
                Some(Value::Number(x)) if x.is_nan() && key.absent == "required" => {
                    let (given, expected) = ("nothing".into(), format!("{} [{}]", key.takes.expected(), key.unit));
                    return Err(HostError::Key { key: key.name.into(), given, expected });
                }
                Some(value) => key.check(&value)?,
                None => {}
            }
        }
        if self.sound_speed.or(self.fastest_speed).is_none() {
            let expected = "a number above 0 [m/s], or sound_speed".into();
            return Err(HostError::Key { key: "fastest_speed".into(), given: "nothing".into(), expected });
        }
        Ok(())
    }

    /// Speed of sound c₀ [m/s].
    pub fn speed_of_sound(&self) -> f64 {
        let least = self.fastest_speed.map(|speed| LEAST_SOUND_RATIO * speed);
        self.sound_speed.or(least).unwrap_or(f64::NAN)
    }

    /// What the water does not change during a run.
    pub fn parameters(&self) -> Parameters {
        let eos = Tait { rho0: self.density, c0: self.speed_of_sound(), gamma: self.eos_exponent };
        let usual_cfl = match self.integrator {
            Integrator::PredictorCorrector => 0.3,
            _ if self.wall_stretch => 0.4,
            _ => 0.6,
        };
        let mut parameters = Parameters {
            kernel: self.kernel,
            smoothing_ratio: self.smoothing_ratio,
            gravity: self.gravity,
            alpha: self.artificial_viscosity,
            nu: self.kinematic_viscosity,
            delta: self.density_diffusion,
            shifting: self.shifting,
            slip: self.wall_slip,
            wall_stretch: self.wall_stretch,
            ventilation: self.ventilation,
            integrator: self.integrator,
            cfl: self.cfl.unwrap_or(usual_cfl),
            ..Parameters::usual(eos)
        };
        parameters.walls.water_depth = self.depth;
        parameters
    }
}

impl Serialize for FluidElementSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(keywords().iter().filter_map(|key| Some((key.name, (key.get)(self)?))))
    }
}

impl<'de> Deserialize<'de> for FluidElementSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<FluidElementSpec, D::Error> {
        let given = BTreeMap::<String, Value>::deserialize(deserializer)?;
        keywords::parse(&given).map_err(D::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(given: &[(&str, Value)]) -> String {
        FluidElementSpec::from_keys(given.iter().map(|(k, v)| (*k, v.clone()))).expect_err("refused").to_string()
    }

    fn sound() -> Vec<(&'static str, Value)> {
        ["spacing", "reach", "depth", "sound_speed"]
            .into_iter()
            .zip([0.05, 1.0, 0.5, 40.0].map(Value::Number))
            .collect()
    }

    #[test]
    fn a_specification_is_read_from_any_format_and_written_to_it() {
        let text = r#"{"spacing": 0.05, "reach": 2, "depth": 1.0, "fastest_speed": 4.5, "gravity": [0, -9.81],
            "kernel": "wendland_c4", "shifting": false, "wall_slip": "none"}"#;
        let spec: FluidElementSpec = serde_json::from_str(text).expect("a sound specification");
        assert_eq!((spec.reach, spec.kernel, spec.shifting), (2.0, Kernel::WendlandC4, false));
        assert_eq!(spec.speed_of_sound(), 45.0);
        let again: FluidElementSpec =
            serde_json::from_str(&serde_json::to_string(&spec).expect("numbers")).expect("what was written");
        assert_eq!(again, spec);
        let wrong = serde_json::from_str::<FluidElementSpec>(r#"{"spacing": -1}"#).expect_err("refused").to_string();
        assert_eq!(wrong, "spacing: given -1.0, expected a number above 0");
    }

    #[test]
    fn bad_keys_are_refused_with_key_given_and_expected() {
        let with = |key, value| said(&[sound(), vec![(key, value)]].concat());
        assert!(
            with("spaceing", Value::Number(1.0)).starts_with("spaceing: given 1.0, expected one of spacing, reach")
        );
        assert_eq!(
            with("growth", Value::Number(0.9)),
            "growth: given 0.9, expected a number of at least 1 and at most 1.5"
        );
        assert_eq!(with("cfl", Value::Number(1.2)), "cfl: given 1.2, expected a number above 0 and below 1.2");
        assert_eq!(with("wall_slip", Value::Word("some".into())), "wall_slip: given some, expected free | none");
        assert_eq!(with("density", Value::Flag(true)), "density: given true, expected a number above 0");
        assert_eq!(
            with("gravity", Value::Pair([0.0, f64::NAN])),
            "gravity: given [0.0, NaN], expected two finite numbers"
        );
        assert_eq!(said(&sound()[1..]), "spacing: given nothing, expected a number above 0 [m]");
        assert_eq!(
            said(&sound()[..3]),
            "fastest_speed: given nothing, expected a number above 0 [m/s], or sound_speed"
        );
    }
}
