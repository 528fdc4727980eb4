//! The settings of a region of water that a host embeds.

use std::sync::LazyLock;

use schemars::JsonSchema;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map, Value};
use sph_core::{Domain, FluidSettings, SchemeSettings, wcsph};

use super::element_scheme::{ElementScheme, Integrator};
use super::error::HostError;
use crate::settings::{Problem, Schema, require};

/// Courant number at which the water's step breaks down (THEORY WC16) [-].
const BREAKDOWN_CFL: f64 = 1.2;
/// The key of the solver.
const SOLVER: &str = "solver";

/// The schema of a [`FluidElementSpec`]: its keys with units, ranges, defaults and meanings.
pub fn schema() -> &'static Schema {
    static SCHEMA: LazyLock<Schema> = LazyLock::new(|| Schema::of::<FluidElementSpec>("a fluid element"));
    &SCHEMA
}

/// A rectangular basin of water at rest, and its scheme. It is read from and written to any format of serde's as a table; a
/// key that is unknown or out of range is refused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(remote = "Self")]
pub struct FluidElementSpec {
    /// Finest particle spacing dx [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub spacing: f64,
    /// Half width of the basin, from its middle to either side wall [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub reach: f64,
    /// Depth of the water at rest [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub depth: f64,
    /// Height of the still-water line in the host's frame [m].
    #[serde(default)]
    pub still_water: f64,
    /// Middle of the basin [m].
    #[schemars(extend("x-default" = "middle of the wet surface"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub middle: Option<f64>,
    /// Height of the side walls above still water [m].
    #[schemars(range(min = 0.0), extend("x-default" = "0.25 depth"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rim: Option<f64>,
    /// Ratio of successive rows outside the fine zone; 1 is uniform [-].
    #[serde(default = "usual::growth")]
    #[schemars(range(min = 1.0, max = 1.5))]
    pub growth: f64,
    /// Half width of the fine zone, about the middle of the wet surface [m].
    #[schemars(extend(
        "exclusiveMinimum" = 0,
        "x-default" = "1.6 times half the wet surface's breadth, 10 spacings at least"
    ))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fine_half_width: Option<f64>,
    /// Depth of the fine zone below still water [m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "half the wet surface's breadth, 4 spacings at least"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fine_depth: Option<f64>,
    /// Acceleration of gravity on the water [x, y]; the host's own weight is the host's [m/s²].
    #[serde(default = "usual::gravity")]
    pub gravity: [f64; 2],
    /// Largest expected speed of the flow, such as the spray root's (pi/2) V/tan(deadrise) [m/s].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required without sound_speed"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fastest_speed: Option<f64>,
    /// The water.
    #[serde(flatten)]
    pub water: FluidSettings,
    /// The scheme.
    #[serde(flatten)]
    pub scheme: ElementScheme,
    /// Steps of the water above which a step of the host is refused [-].
    #[serde(default = "usual::most_substeps")]
    #[schemars(range(min = 1.0, max = 1e9))]
    pub most_substeps: f64,
}

mod usual {
    pub fn growth() -> f64 {
        1.1
    }
    pub fn gravity() -> [f64; 2] {
        [0.0, -9.81]
    }
    pub fn most_substeps() -> f64 {
        100_000.0
    }
}

impl FluidElementSpec {
    /// The three lengths that have no default [m]: the finest spacing, the basin's half width and its depth. One speed,
    /// `fastest_speed` or [`FluidElementSpec::with_sound_speed`], must be set beside them.
    pub fn new(spacing: f64, reach: f64, depth: f64) -> FluidElementSpec {
        FluidElementSpec {
            spacing,
            reach,
            depth,
            still_water: 0.0,
            middle: None,
            rim: None,
            growth: usual::growth(),
            fine_half_width: None,
            fine_depth: None,
            gravity: usual::gravity(),
            fastest_speed: None,
            water: FluidSettings::default(),
            scheme: ElementScheme::default(),
            most_substeps: usual::most_substeps(),
        }
    }

    /// The same, weakly compressible with a numerical speed of sound [m/s].
    pub fn with_sound_speed(mut self, sound_speed: f64) -> FluidElementSpec {
        let scheme = self.scheme.weakly_compressible().copied().unwrap_or_default();
        let integrator = match self.scheme {
            ElementScheme::WeaklyCompressible { integrator, .. } => integrator,
            _ => Integrator::default(),
        };
        let scheme = wcsph::Settings { sound_speed: sound_speed.into(), ..scheme };
        self.scheme = ElementScheme::WeaklyCompressible { scheme, integrator };
        self
    }

    /// A specification from keys and values.
    ///
    /// # Errors
    /// A key that is unknown, absent or out of range.
    pub fn from_keys<K: Into<String>, V: Into<Value>>(
        given: impl IntoIterator<Item = (K, V)>,
    ) -> Result<FluidElementSpec, HostError> {
        let table: Map<String, Value> = given.into_iter().map(|(key, value)| (key.into(), value.into())).collect();
        FluidElementSpec::from_table(&Value::Object(table)).map_err(HostError::Key)
    }

    fn from_table(given: &Value) -> Result<FluidElementSpec, Problem> {
        let mut given = given.clone();
        if let Some(keys) = given.as_object_mut() {
            keys.entry(SOLVER).or_insert_with(|| "weakly_compressible".into());
        }
        let checked = schema().check(&given)?;
        let spec = FluidElementSpec::deserialize(&checked).map_err(|error| schema().missing("", &error))?;
        spec.refuse_combinations()?;
        Ok(spec)
    }

    /// Refuses a value out of its range, wherever it came from.
    pub(super) fn check(&self) -> Result<(), HostError> {
        let table = serde_json::to_value(self).unwrap_or_default();
        schema().check(&table).and_then(|_| self.refuse_combinations()).map_err(HostError::Key)
    }

    fn refuse_combinations(&self) -> Result<(), Problem> {
        let ElementScheme::WeaklyCompressible { scheme, integrator } = &self.scheme else {
            let missing = || Problem::missing("fastest_speed", "a number above 0 [m/s]");
            return self.fastest_speed.map(|_| ()).ok_or_else(missing);
        };
        if scheme.sound_speed.value().or(self.fastest_speed).is_none() {
            return Err(Problem::missing("fastest_speed", "a number above 0 [m/s], or sound_speed"));
        }
        let there = cfg!(feature = "legacy") || *integrator == Integrator::Symplectic;
        let expected = "symplectic: this program was built without the cargo feature `legacy`";
        require(there, "integrator", "predictor_corrector", expected)?;
        let cfl = self.scheme.courant_number();
        let expected = format_args!("a number above 0 and below {BREAKDOWN_CFL}");
        require(cfl < BREAKDOWN_CFL, "cfl", cfl, expected)
    }

    /// Speed of sound c₀ [m/s]; of a projection ten times `fastest_speed`, which no node may exceed.
    pub fn speed_of_sound(&self) -> f64 {
        let fastest = self.fastest_speed.unwrap_or(f64::NAN);
        self.scheme.weakly_compressible().map_or(10.0 * fastest, |scheme| scheme.speed_of_sound(fastest))
    }

    /// The water and the space it moves in.
    pub fn domain(&self) -> Domain {
        Domain {
            fluid: self.water,
            gravity: self.gravity,
            fastest_speed: self.fastest_speed.unwrap_or(0.1 * self.speed_of_sound()),
            starts_level: true,
            ..Domain::default()
        }
    }

    /// The scheme's settings.
    pub fn settings(&self) -> Box<dyn SchemeSettings> {
        self.scheme.settings(self.speed_of_sound(), self.depth)
    }

    /// The water's step at rest [s] (THEORY WC12, PR14).
    pub(super) fn step_at_rest(&self) -> f64 {
        let h = self.water.smoothing_ratio * self.spacing;
        let own = match self.scheme.projection() {
            None => self.scheme.courant_number() * h / self.speed_of_sound(),
            Some(projection) => projection.step_at_rest(h, &self.domain()),
        };
        own.min(0.125 * h * h / self.water.kinematic_viscosity)
    }
}

impl Serialize for FluidElementSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        FluidElementSpec::serialize(self, serializer)
    }
}

impl<'de> Deserialize<'de> for FluidElementSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<FluidElementSpec, D::Error> {
        let given = Value::deserialize(deserializer)?;
        FluidElementSpec::from_table(&given).map_err(D::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use sph_core::Kernel;

    use super::*;

    fn refusal(change: &[(&str, Value)]) -> String {
        let mut keys = json!({"spacing": 0.05, "reach": 1.0, "depth": 0.5, "sound_speed": 40.0});
        for (key, value) in change {
            match value {
                Value::Null => drop(keys.as_object_mut().map(|keys| keys.remove(*key))),
                value => keys[*key] = value.clone(),
            }
        }
        let Value::Object(keys) = keys else { panic!("a table") };
        FluidElementSpec::from_keys(keys).expect_err("refused").to_string()
    }

    #[test]
    fn a_specification_is_read_from_any_format_and_written_to_it() {
        let text = r#"{"spacing": 0.05, "reach": 2, "depth": 1.0, "fastest_speed": 4.5, "gravity": [0, -9.81],
            "kernel": "wendland_c4", "shifting": false, "kinematic_viscosity": 0.001, "wall_slip": "none"}"#;
        let spec: FluidElementSpec = serde_json::from_str(text).expect("a sound specification");
        let shifting = spec.scheme.weakly_compressible().expect("the usual solver").shifting;
        assert_eq!((spec.reach, spec.water.kernel, shifting), (2.0, Kernel::WendlandC4, false));
        assert_eq!(spec.speed_of_sound(), 45.0);
        let written = serde_json::to_string(&spec).expect("numbers");
        assert_eq!(serde_json::from_str::<FluidElementSpec>(&written).expect("what was written"), spec);
        let wrong = serde_json::from_str::<FluidElementSpec>(r#"{"spacing": -1}"#).expect_err("refused").to_string();
        assert_eq!(wrong, "`spacing` = -1: expected a finite number above 0");
    }

    #[test]
    fn a_projection_has_its_own_keys() {
        let text = r#"{"spacing": 0.05, "reach": 2, "depth": 1.0, "fastest_speed": 4.5, "solver": "incompressible",
            "ventilation": true, "projection": {"tolerance": 1e-5}}"#;
        let spec: FluidElementSpec = serde_json::from_str(text).expect("a sound specification");
        let settings = spec.scheme.projection().expect("a projection");
        assert!(settings.flow.ventilation && settings.tolerance == 1e-5 && settings.flow.cfl == 0.4);
        let written = serde_json::to_string(&spec).expect("numbers");
        assert_eq!(serde_json::from_str::<FluidElementSpec>(&written).expect("what was written"), spec);
        let said = |change: &str| {
            let text = text.replace("\"ventilation\": true", change);
            serde_json::from_str::<FluidElementSpec>(&text).expect_err("refused").to_string()
        };
        assert!(said("\"sound_speed\": 40").contains("`sound_speed`"), "{}", said("\"sound_speed\": 40"));
        assert!(said("\"vetilation\": true").contains("such as `ventilation`"));
    }

    #[test]
    fn bad_keys_are_refused_with_key_given_and_expected() {
        let with = |key, value: Value| refusal(&[(key, value)]);
        assert_eq!(
            with("spaceing", json!(1.0)),
            "unknown key `spaceing`: expected a key of a fluid element, such as `spacing`"
        );
        assert_eq!(with("growth", json!(0.9)), "`growth` = 0.9: expected a number from 1 to 1.5");
        assert_eq!(with("cfl", json!(1.2)), "`cfl` = 1.2: expected a number above 0 and below 1.2");
        assert_eq!(with("wall_slip", json!("some")), "`wall_slip` = `some`: expected one of `free`, `none`");
        assert_eq!(with("density", json!(true)), "`density` = true: expected a finite number above 0");
        assert_eq!(with("gravity", json!([0.0, f64::NAN])), "`gravity[1]` = null: expected a number");
        assert!(with("spacing", Value::Null).starts_with("`spacing` is missing: expected a finite number above 0 [m]"));
        assert!(with("sound_speed", Value::Null).starts_with("`fastest_speed` is missing: expected"));
        let mut spec = FluidElementSpec::new(0.1, 1.0, 1.0).with_sound_speed(20.0);
        spec.growth = 2.0;
        assert_eq!(
            spec.check().map_err(|e| e.to_string()),
            Err("`growth` = 2: expected a number from 1 to 1.5".into())
        );
    }

    #[test]
    fn every_key_has_a_meaning_a_default_and_a_row_of_the_page() {
        let page = schema().markdown();
        for key in schema().keywords() {
            assert!(!key.doc.is_empty() && !key.default.is_empty() && page.contains(&format!("| `{}` |", key.path)));
        }
        let growth = schema().keyword("growth").expect("a key").help();
        assert_eq!(
            growth,
            "growth [-]: Ratio of successive rows outside the fine zone; 1 is uniform; a number from 1 to 1.5 (default: 1.1)"
        );
    }
}
