//! Keys that stand in a scene and do nothing.

use serde_json::Value;
use sph_core::Solver;

use super::keys::Scene;

/// Options that are on and that the solver ignores.
pub(super) fn ignored(given: &Value, scene: &Scene) -> Vec<String> {
    let solver = scene.solver.name();
    let on = |key: &&&str| given.pointer(&format!("/fluid/{key}")) == Some(&Value::Bool(true));
    let ignored: &[&str] = match scene.solver.kind() {
        Solver::WeaklyCompressible => &[],
        Solver::IncompressibleThesis => &["ventilation", "wall_stretch", "still_pressure"],
        Solver::Incompressible | Solver::IncompressibleExplicit => &["wall_stretch", "still_pressure"],
    };
    let mut ignored: Vec<String> = ignored
        .iter()
        .filter(on)
        .map(|key| format!("fluid.{key} = true does nothing with solver = {solver:?}"))
        .collect();
    ignored.extend(idle_steps(given, scene));
    ignored
}

/// Keys of split-explicit steps (THEORY WC22) that stand in a scene and do nothing.
fn idle_steps(given: &Value, scene: &Scene) -> Vec<String> {
    let number = |key: &str| given.pointer(&format!("/fluid/{key}")).and_then(Value::as_f64);
    let by = match scene.solver.weakly_compressible() {
        _ if scene.model.is_theory() => format!("model = {:?}", scene.model.name()),
        None => format!("solver = {:?}", scene.solver.name()),
        Some(fluid) if fluid.scheme.acoustic_steps() == 1 => "fluid.acoustic_steps = 1".to_string(),
        Some(_) => return Vec::new(),
    };
    let on = [("acoustic_steps", number("acoustic_steps")), ("advective_limit", number("advective_limit"))];
    let idle = on.into_iter().filter_map(|(key, value)| Some((key, value.filter(|value| *value != 1.0)?)));
    idle.map(|(key, value)| format!("fluid.{key} = {value} does nothing with {by}")).collect()
}
