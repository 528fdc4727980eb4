//! `model`, `want`, `within`: which model runs the scene.

use fsi_coupling::entry_theory::EntryModel;
use fsi_coupling::settings::Problem;
use serde_json::Value;
use sph_core::FluidSettings;

use super::draft::Draft;
use super::impact::Entry;
use super::resolve_body::resolve_body;
use super::settings::{Body, GRAVITY, QuantityOfInterest, Scene, Symmetry};
use crate::charted::spacing_within;
use crate::model_hierarchy::{Choice, Theory, charted_number, choose};

/// Question that `model = "auto"` answers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ask {
    want: QuantityOfInterest,
    within: f64,
}

/// Largest error that `auto` may have had, where the scene does not say [-].
const USUAL_TOLERANCE: f64 = 0.05;
/// Left to the program, the end of an entry is when a body that kept its speed would be this many times as deep as when its
/// spray root is at the chines: past the largest force.
const PAST_CHINES: f64 = 2.0;
/// Spacings in the draught from which a spacing is looked for.
const PROVISIONAL: f64 = 32.0;

/// Writes the solver of a scene whose model names one, and the model of a solver.
pub(super) fn settle_solver(given: &mut Value) -> Result<(), Problem> {
    let word = |key: &str| given.get(key).and_then(Value::as_str).map(String::from);
    let (model, solver) = (word("model"), word("solver"));
    let Some(model) = model.and_then(|name| EntryModel::ALL.into_iter().find(|model| model.name() == name)) else {
        return Ok(());
    };
    let incompressible = solver.as_ref().map(|solver| solver != "weakly_compressible");
    match (model == EntryModel::Incompressible, incompressible) {
        (true, None) => given["solver"] = "incompressible".into(),
        (wanted, Some(is)) if wanted != is => {
            let expected = format!("no solver, or that of model = \"{}\"", model.name());
            return Err(Problem::new("solver", format!("{:?}", solver.unwrap_or_default()), expected));
        }
        _ => {}
    }
    Ok(())
}

impl Ask {
    /// What a scene asks of `model = "auto"`; `None` where it names its model.
    pub fn of(given: &Value, draft: &Draft) -> Result<Option<Ask>, Problem> {
        if given.get("model").and_then(Value::as_str) != Some("auto") {
            return Ok(None);
        }
        let ask =
            Ask { want: draft.get("want").unwrap_or_default(), within: draft.get("within").unwrap_or(USUAL_TOLERANCE) };
        if ask.want == QuantityOfInterest::Strain && draft.count("body.panels") == 0 {
            return Err(Problem::new("want", "\"strain\"", "something else without body.panels: nothing bends"));
        }
        Ok(Some(ask))
    }
}

/// Refuses a scene that its theory cannot do.
pub(super) fn check_model(scene: Scene) -> Result<Scene, Problem> {
    if scene.model.is_theory() {
        let name = scene.model.name();
        let refused = |e| Problem::new("model", format!("\"{name}\""), format!("a scene it holds for: {e}"));
        Theory::of(&scene, scene.model).map_err(refused)?;
    }
    Ok(scene)
}

/// The scene of `model = "auto"`, by the model that [`choose`] takes: symmetry, end, spacing and solver are left to the program
/// where the scene does not give them. `resolved` makes a sensible scene of a table, or says what is wrong.
pub(super) fn settle_auto(
    given: &Value,
    ask: Ask,
    resolved: impl Fn(&Value) -> Result<Scene, Problem>,
    draft_of: impl Fn(&Value) -> Result<Draft, Problem>,
) -> Result<Scene, Problem> {
    let mut given = given.clone();
    for key in ["model", "want", "within"] {
        given.as_object_mut().map(|table| table.remove(key));
    }
    fill_in_end(&mut given, &draft_of)?;
    // half of a symmetric scene is as good
    let resolved = |given: &Value| match given.get("symmetry") {
        Some(_) => resolved(given),
        None => resolved(&with(given, "symmetry", "x")).or_else(|_| resolved(given)),
    };
    let solvers = match given.get("solver").and_then(Value::as_str) {
        Some(solver) => vec![solver],
        None => vec!["weakly_compressible", "incompressible"],
    };
    let mut of_particles = Vec::new();
    for solver in solvers {
        match fine_enough(with(&given, "solver", solver), ask, resolved, &draft_of) {
            Ok(scene) => of_particles.push(scene),
            Err(problem) if of_particles.is_empty() => return Err(problem),
            Err(_) => {} // the other solver can
        }
    }
    let Choice { model, scene, spacing, why } = choose(&of_particles, ask.want, ask.within);
    if !model.is_theory() && spacing_of(&given).is_none() && !spacing {
        let why = format!("the finest spacing [m]: no chart is near this scene that would tell it; {why}");
        return Err(Problem::missing("resolution.spacing", why));
    }
    let mut scene = of_particles.swap_remove(scene);
    (scene.model, scene.choice) = (model, Some(why));
    Ok(scene)
}

/// The table with another value at a key.
fn with(given: &Value, key: &str, value: &str) -> Value {
    let mut given = given.clone();
    given[key] = value.into();
    given
}

fn spacing_of(given: &Value) -> Option<&Value> {
    given.get("resolution").and_then(|table| table.get("spacing"))
}

fn set_number(given: &mut Value, table: &str, key: &str, value: f64) {
    if !given[table].is_object() {
        given[table] = Value::Object(serde_json::Map::new());
    }
    given[table][key] = value.into();
}

/// A scene at the spacing that it gives, or else at the one that charts say is fine enough.
fn fine_enough(
    mut given: Value,
    ask: Ask,
    resolved: impl Fn(&Value) -> Result<Scene, Problem>,
    draft_of: impl Fn(&Value) -> Result<Draft, Problem>,
) -> Result<Scene, Problem> {
    if spacing_of(&given).is_some() {
        return resolved(&given);
    }
    let entry = entry_of(draft_of(&given)?)?;
    let draught = entry.map(|(_, entry)| entry.attached_draught().max(entry.bottom.draught_at(entry.half_breadth)));
    let draught = draught
        .ok_or_else(|| Problem::missing("resolution.spacing", "the finest spacing [m]: nothing enters the water"))?;
    set_number(&mut given, "resolution", "spacing", draught / PROVISIONAL);
    let scene = resolved(&given)?;
    let fine = charted_number(ask.want).and_then(|number| spacing_within(&scene, number, ask.within));
    fine.map_or(Ok(scene), |spacing| {
        set_number(&mut given, "resolution", "spacing", spacing);
        resolved(&given)
    })
}

/// The entry of a draft's body, were there no end.
fn entry_of(mut draft: Draft) -> Result<Option<(Body, Entry)>, Problem> {
    let Some(body) = resolve_body(&mut draft, Symmetry::None)? else { return Ok(None) };
    let gravity = draft.get("gravity").unwrap_or_else(GRAVITY);
    let density = draft.get("fluid.density").unwrap_or(FluidSettings::default().density);
    let entry = Entry::of(&body, gravity, density, draft.get("time.end").unwrap_or(0.0));
    Ok(entry.map(|entry| (body, entry)))
}

/// An entry without an end: the end from how long it takes.
fn fill_in_end(given: &mut Value, draft_of: &impl Fn(&Value) -> Result<Draft, Problem>) -> Result<(), Problem> {
    let draft = draft_of(given)?;
    if let (false, Some((body, entry))) = (draft.is_given("time.end"), entry_of(draft)?) {
        let gap = (-body.draught()).max(0.0);
        let fall = 2.0 * gap / (entry.speed - body.velocity[1]); // at the mean of first and last speed
        let end = fall + PAST_CHINES * entry.bottom.draught_at(entry.half_breadth) / entry.speed;
        set_number(given, "time", "end", end);
    }
    Ok(())
}
