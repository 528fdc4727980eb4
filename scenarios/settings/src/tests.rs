//! Tables tagged by shape and by solver, and keys that have an effect under conditions.

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};
use sph_core::Auto;

use super::Schema;

#[derive(Deserialize, JsonSchema)]
#[allow(dead_code)]
struct Case {
    #[serde(flatten)]
    shape: Form,
    #[serde(flatten)]
    solver: Solver,
    /// Width [m].
    #[schemars(with = "Auto<f64>", extend("exclusiveMinimum" = 0, "x-default" = "auto"))]
    width: f64,
    /// Amplitude [m].
    #[serde(default)]
    amplitude: f64,
    /// Half waves [-].
    #[serde(default)]
    #[schemars(range(min = 0, max = 9), extend("x-when" = ".amplitude"))]
    mode: u32,
}

#[derive(Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "snake_case")]
#[allow(dead_code)]
enum Form {
    Wedge {
        /// Deadrise [deg].
        deadrise: f64,
    },
    Arc {
        /// Radius [m].
        radius: f64,
    },
}

#[derive(Deserialize, JsonSchema)]
#[serde(tag = "solver", rename_all = "snake_case")]
#[schemars(extend("x-solver-default" = "slow"))]
#[allow(dead_code)]
enum Solver {
    Slow { fluid: Slow },
    Fast { fluid: Fast },
}

#[derive(Deserialize, JsonSchema)]
#[serde(default)]
#[derive(Default)]
#[allow(dead_code)]
struct Slow {
    /// Viscosity [-].
    #[schemars(extend("x-neutral" = 0))]
    viscosity: f64,
    /// Filter [-].
    #[schemars(extend("x-ignored-elsewhere" = true))]
    filter: u32,
    density: f64,
}

#[derive(Deserialize, JsonSchema)]
#[serde(default)]
#[derive(Default)]
#[allow(dead_code)]
struct Fast {
    density: f64,
}

fn check(given: &Value) -> Result<Value, String> {
    Schema::of::<Case>("a case").check(given).map_err(|problem| problem.sentence)
}

#[test]
fn a_key_of_another_tag_is_refused_with_its_owner() {
    let wrong = check(&json!({"shape": "wedge", "deadrise": 30, "radius": 1.5}));
    let expected = "`radius` = 1.5: expected none with shape = \"wedge\": the key belongs to shape = \"arc\"";
    assert_eq!(wrong, Err(expected.into()));
    let nested = check(&json!({"solver": "fast", "fluid": {"viscosity": 0.1}}));
    let expected =
        "`fluid.viscosity` = 0.1: expected none, or 0, with solver = \"fast\": the key belongs to solver = \"slow\"";
    assert_eq!(nested, Err(expected.into()));
    let unknown = check(&json!({"solver": "fast", "fluid": {"denstiy": 1}}));
    assert_eq!(unknown, Err("unknown key `fluid.denstiy`: expected a key of a case, such as `fluid.density`".into()));
    assert!(check(&json!({"shape": "cone"})).is_err_and(|said| said.contains("one of `wedge`, `arc`")));
}

#[test]
fn words_neutral_and_ignored_keys_are_left_out() {
    let given = json!({"solver": "fast", "fluid": {"viscosity": 0, "filter": 3, "density": 2}, "width": "auto"});
    assert_eq!(check(&given), Ok(json!({"solver": "fast", "fluid": {"density": 2}})));
    assert_eq!(check(&json!({"fluid": {"viscosity": 0.5}})), Ok(json!({"fluid": {"viscosity": 0.5}})));
    assert_eq!(check(&json!({"width": -1})), Err("`width` = -1: expected a finite number above 0 or \"auto\"".into()));
}

#[test]
fn a_key_without_effect_is_refused_unless_it_has_its_default() {
    assert!(check(&json!({"amplitude": 0.1, "mode": 3})).is_ok() && check(&json!({"mode": 0})).is_ok());
    let expected = "`mode` = 3: expected none, or its default 0: the key has no effect here, only with amplitude";
    assert_eq!(check(&json!({"mode": 3})), Err(expected.into()));
}

#[test]
fn a_variant_names_who_requires_its_keys() {
    let schema = Schema::of::<Case>("a case");
    let default = |path: &str| schema.keyword(path).map(|keyword| keyword.default.clone());
    assert_eq!(default("radius"), Some("required by arc".into()));
    assert_eq!(default("solver"), Some("slow".into()));
    assert_eq!(default("width"), Some("auto".into()));
}
