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

#[derive(Deserialize, JsonSchema)]
#[allow(dead_code)]
struct Study {
    /// Names.
    names: Option<OneOrMore>,
    /// Axes by their keys.
    axes: std::collections::BTreeMap<String, Axis>,
    /// Overrides.
    set: std::collections::BTreeMap<String, Value>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
#[allow(dead_code)]
enum OneOrMore {
    One(String),
    More(Vec<String>),
}

/// Values.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
#[allow(dead_code)]
enum Axis {
    List(Vec<Value>),
    Range(Ends),
}

#[derive(Deserialize, JsonSchema)]
#[allow(dead_code)]
struct Ends {
    /// First.
    from: f64,
}

#[test]
fn free_keys_and_values_of_several_kinds_are_checked() {
    let schema = Schema::of::<Study>("a study");
    let given =
        json!({"names": ["a", "b"], "axes": {"x.y": [1, "b"], "z": {"from": 1}}, "set": {"a": null, "b": {"c": 1}}});
    assert_eq!(schema.check(&given), Ok(given.clone()));
    assert!(schema.check(&json!({"names": "a"})).is_ok());
    for (given, sentence) in [
        (json!({"names": 3}), "`names` = 3: expected a string or a list"),
        (json!({"names": ["a", 3]}), "`names[1]` = 3: expected a string"),
        (json!({"axes": {"x.y": true}}), "`axes.x.y` = true: expected a list or a table of keys"),
        (
            json!({"axes": {"x": {"frm": 1}}}),
            "unknown key `axes.x.frm`: expected a key of a study, such as `axes.KEY.from`",
        ),
        (json!({"axes": {"x": {"from": "a"}}}), "`axes.x.from` = \"a\": expected a number"),
    ] {
        assert_eq!(schema.check(&given).map_err(|problem| problem.sentence), Err(sentence.to_string()));
    }
    let paths: Vec<&str> = schema.keywords().iter().map(|keyword| keyword.path.as_str()).collect();
    assert_eq!(paths, ["names", "axes.KEY", "axes.KEY.from", "set.KEY"]);
    assert_eq!(schema.keywords()[3].doc, "Overrides");
}
