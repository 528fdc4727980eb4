//! The references of a scene: where they may lie, whether they hold points to compare, and which of them a changed key leaves.

use serde_json::Value;
use settings::{Problem, require};

use super::data_file::beside;
use super::keys::{Compare, Scene};
use super::source::assignment;
use crate::reference::{ReferenceError, Table};

/// Tables of a scene that say what flows and where it is measured, and keys of the other tables that do; the rest says how it is computed and observed.
const OF_THE_FLOW: [&str; 6] = ["body", "tank", "gauges", "gravity", "fluid.density", "fluid.kinematic_viscosity"];
/// Keys of those tables that do not.
const NOT_OF_THE_FLOW: [&str; 2] = ["elements", "name"];

/// Puts the path of each reference behind the folder of the scene's file. Only files below that folder may be named: the text of a
/// cell that is not a number is shown in a message.
pub(super) fn settle_references(given: &mut Value, scene_file: &str) -> Result<(), Problem> {
    let Some(compares) = given.get_mut("compare").and_then(Value::as_array_mut) else { return Ok(()) };
    for (i, compare) in compares.iter_mut().enumerate() {
        let Some(reference) = compare.get_mut("reference") else { continue };
        let Some(name) = reference.as_str().filter(|name| !Table::is_builtin(name)).map(str::to_string) else {
            continue;
        };
        let key = format!("compare[{i}].reference");
        let file = beside(scene_file, &key, &name, "a built-in table, or a CSV file")?;
        *reference = Value::String(file.to_string_lossy().into_owned());
    }
    Ok(())
}

/// The `--set` arguments without those that say what flows, and the first of those; `None` where none does, or where one gives
/// references too.
pub(super) fn sets_of_the_flow(sets: &[String]) -> Option<(Vec<String>, String)> {
    let key = |set: &str| assignment(set).map_or(String::new(), |(key, _)| key.to_string());
    let changes = |set: &String| is_of_the_flow(&key(set));
    let gives_reference = |key: &str| key == "compare" || table_of(key) == "compare" && key.ends_with(".reference");
    let first = key(sets.iter().find(|set| changes(set))?);
    if sets.iter().any(|set| gives_reference(&key(set))) {
        return None;
    }
    Some((sets.iter().filter(|set| !changes(set)).cloned().collect(), first))
}

/// True for scenes in which the same flows.
fn is_same_flow(one: &Scene, other: &Scene) -> bool {
    let water = |scene: &Scene| [scene.water().density, scene.water().kinematic_viscosity];
    one.body == other.body && one.gravity == other.gravity && water(one) == water(other) && is_same_tank(one, other)
}

/// Around a body that enters from the air a tank may be larger than that of the reference.
fn is_same_tank(one: &Scene, reference: &Scene) -> bool {
    let (tank, other) = (&one.tank, &reference.tank);
    let wide_open = tank.water_width == tank.width && other.water_width == other.width;
    let larger = tank.width >= other.width && tank.depth >= other.depth && wide_open;
    tank == other || reference.entry().is_some() && larger
}

/// True where a column is not of a gauge that differs from that of the reference.
fn is_same_gauge(column: &str, one: &Scene, reference: &Scene) -> bool {
    let of = |scene: &Scene| scene.gauges.iter().find(|gauge| column == format!("{}.p_Pa", gauge.name)).cloned();
    of(reference).is_none_or(|gauge| of(one) == Some(gauge))
}

/// Takes away the references of a scene that do not fit it since a key `changed` it from what it was; what to tell of it.
pub(super) fn drop_references(scene: &mut Scene, before: Option<&Scene>, changed: &str) -> Option<String> {
    let same = before.filter(|before| is_same_flow(scene, before));
    let fits = |column: &str| same.is_some_and(|before| is_same_gauge(column, scene, before));
    let kept: Vec<bool> = scene.compare.iter().map(|compare| fits(&compare.quantity)).collect();
    let dropped = scene.compare.iter().zip(&kept).filter(|(_, kept)| !**kept);
    let mut names: Vec<String> = dropped.map(|(compare, _)| compare.reference.clone()).collect();
    let mut kept = kept.into_iter();
    scene.compare.retain(|_| kept.next() == Some(true));
    names.dedup();
    (!names.is_empty())
        .then(|| format!("no comparison with {}: `{changed}` is not that of the reference", names.join(", ")))
}

fn table_of(key: &str) -> &str {
    key.split(['.', '[']).next().unwrap_or(key)
}

fn is_of_the_flow(key: &str) -> bool {
    let last = key.rsplit(['.', ']']).next().unwrap_or(key);
    (OF_THE_FLOW.contains(&table_of(key)) || OF_THE_FLOW.contains(&key)) && !NOT_OF_THE_FLOW.contains(&last)
}

/// The reference is there, has the columns that the scene names, and at least two points in the times compared; a run that ends
/// before them is stated by its summary.
pub(super) fn check_reference(i: usize, compare: &Compare, end: f64) -> Result<(), Problem> {
    let wrong = |name: &str, given: &str, error: ReferenceError| {
        let expected = format!("a table that can be used: {error}");
        Problem::new(&format!("compare[{i}].{name}"), format!("{given:?}"), expected)
    };
    let table = Table::load(&compare.reference).map_err(|e| wrong("reference", &compare.reference, e))?;
    let column =
        |name: &str, column: &str| table.column(&compare.reference, column).map_err(|e| wrong(name, column, e));
    let times: Vec<f64> = column("x", &compare.x)?.into_iter().map(|x| x * compare.x_scale).collect();
    column("y", &compare.y)?;
    let rising = times.windows(2).all(|pair| pair[0] <= pair[1]);
    require(rising, &format!("compare[{i}].x"), format_args!("{:?}", compare.x), "a column of times that do not fall")?;
    let [from, to] = compare.window;
    let to = if to < end { to } else { f64::INFINITY };
    let inside = times.iter().filter(|t| (from..=to).contains(*t)).count();
    let expected = format_args!(
        "times with two points of the reference, which has {inside} there and goes from {} to {} s",
        times[0],
        times[times.len() - 1]
    );
    require(inside >= 2, &format!("compare[{i}].window"), format_args!("{:?}", compare.window), expected)
}

#[cfg(test)]
mod tests {
    use crate::load;

    fn loaded(sets: &[&str]) -> Result<(usize, Vec<String>), String> {
        let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
        load("wedge25", &sets).map(|l| (l.scene.compare.len(), l.warnings)).map_err(|e| e.to_string())
    }

    #[test]
    fn a_changed_flow_drops_its_references_with_a_warning() {
        let (all, _) = loaded(&[]).expect("a scene");
        assert!(all > 0);
        for kept in [
            "tank.width=30.0",
            "resolution.spacing=0.02",
            "solver=incompressible",
            "time.end=0.01",
            "gravity=[0.0, -9.81]",
        ] {
            assert_eq!(loaded(&[kept]).expect("a scene").0, all, "{kept}");
        }
        for changed in
            ["tank.width=3.0", "body.deadrise_deg=20", "body.mass=50", "gravity=[0.0, -1.6]", "fluid.density=1025"]
        {
            let (left, warnings) = loaded(&[changed]).expect("a scene");
            assert!(left == 0 && warnings.iter().any(|w| w.contains("no comparison with")), "{changed}: {warnings:?}");
        }
    }

    #[test]
    fn a_gauge_or_a_reservoir_that_changed_drops_what_was_measured_there() {
        let left = |scene: &str, sets: &[&str]| {
            let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
            let loaded = load(scene, &sets).expect("a scene");
            (loaded.scene.compare.len(), loaded.warnings.iter().any(|w| w.contains("no comparison with")))
        };
        let (all, _) = left("dam_break", &[]);
        let (moved, notes) = left("dam_break", &["gauges[1].at=[1.61, -0.1]"]);
        assert!(moved < all && moved > 0 && notes, "{moved} of {all}");
        assert_eq!(left("elastic_gate", &["tank.water_width=0.05"]), (0, true));
        assert_eq!(left("wedge", &["body.mass=100", "compare[0].tolerance=0.5"]), (0, true));
    }

    #[test]
    fn a_reference_stays_below_the_folder_of_its_scene() {
        for outside in ["/etc/passwd", "../secret.csv", "a/../../b.csv"] {
            let compare =
                format!("compare=[{{ reference = '{outside}', quantity = 'wedge.vy_m_per_s', x = 't', y = 'v' }}]");
            let text = loaded(&[&compare]).expect_err("outside");
            assert!(text.contains("compare[0].reference") && text.contains("below the folder"), "{text}");
        }
    }

    #[test]
    fn a_window_without_points_of_the_reference_is_refused() {
        let name = "external/wedge25_yettou2006_velocity_exp.csv";
        let of = |window: &str| {
            format!(
                "compare=[{{ reference = '{name}', quantity = 'wedge.vy_m_per_s', x = 't_ms', x_scale = 0.001, y = 'v_m_s', \
                 window = {window} }}]"
            )
        };
        assert_eq!(loaded(&[&of("[0.0, 0.02]")]).expect("a scene").0, 1);
        let text = loaded(&[&of("[0.0, 1e-6]")]).expect_err("no points");
        assert!(text.contains("compare[0].window") && text.contains("has 0 there"), "{text}");
    }
}
