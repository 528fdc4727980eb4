//! `model`, `want`, `within`: which model runs the scene.

use serde::de::Error;
use serde::{Deserialize, Deserializer};

use super::file::SceneFile;
use super::impact::Entry;
use super::model::{Body, EntryModel, Scene, Solver, Symmetry};
use super::problem::{Problem, within};
use super::resolve_body::resolve_body;
use crate::charted::spacing_within;
use crate::model_hierarchy::{Choice, Theory, Want, charted_number, choose};

/// The key `model`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelName {
    /// The cheapest that is near enough.
    Auto,
    /// This one.
    Named(EntryModel),
}

impl<'de> Deserialize<'de> for ModelName {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<ModelName, D::Error> {
        let word = String::deserialize(from)?;
        if word == "auto" {
            return Ok(ModelName::Auto);
        }
        let named = EntryModel::ALL.into_iter().find(|rung| rung.name() == word);
        named.map(ModelName::Named).ok_or_else(|| {
            let known = EntryModel::ALL.map(|rung| format!("`{}`", rung.name())).join(", ");
            D::Error::custom(format!("unknown variant `{word}`, expected one of `auto`, {known}"))
        })
    }
}

/// What `auto` is to find a model for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ask {
    want: Want,
    within: f64,
}

/// Largest error that `auto` may have had, where the scene does not say [-].
const USUAL_TOLERANCE: f64 = 0.05;
/// Left to the program, the end of an entry is when a body that kept its speed would be this many times as deep as when its
/// spray root is at the chines: past the largest force.
const PAST_CHINES: f64 = 2.0;
/// Spacings in the draught from which a spacing is looked for.
const PROVISIONAL: f64 = 32.0;

impl Ask {
    /// What a scene asks of `model = "auto"`; `None` where it names its model.
    pub fn of(file: &SceneFile) -> Result<Option<Ask>, Problem> {
        let tolerance = file.within.map(|share| within("within", share, 0.0..=1.0)).transpose()?;
        let asks = file.want.is_some() || tolerance.is_some();
        match file.model {
            Some(ModelName::Auto) => {
                let (want, within) = (file.want.unwrap_or_default(), tolerance.unwrap_or(USUAL_TOLERANCE));
                let bends = file.body.as_ref().is_some_and(|body| !body.panels.is_empty());
                if want == Want::Strain && !bends {
                    return Err(Problem::new(
                        "want",
                        "\"strain\"",
                        "something else without body.panels: nothing bends",
                    ));
                }
                Ok(Some(Ask { want, within }))
            }
            _ if asks => {
                let key = if file.want.is_some() { "want" } else { "within" };
                Err(Problem::new(key, "given", "no such key without model = \"auto\": the model is named"))
            }
            _ => Ok(None),
        }
    }
}

/// The model of a scene as written, and its solver; `auto` is settled later.
pub(super) fn resolve_model(model: Option<ModelName>, solver: Option<Solver>) -> Result<(EntryModel, Solver), Problem> {
    let of_solver =
        |solver: Solver| if solver.is_incompressible() { EntryModel::Incompressible } else { EntryModel::Wcsph };
    let rung = match model {
        None | Some(ModelName::Auto) => of_solver(solver.unwrap_or_default()),
        Some(ModelName::Named(rung)) => rung,
    };
    let usual = if rung == EntryModel::Incompressible { Solver::Incompressible } else { Solver::WeaklyCompressible };
    let solver = solver.unwrap_or(usual);
    match of_solver(solver) == if rung.is_theory() { EntryModel::Wcsph } else { rung } {
        true => Ok((rung, solver)),
        false => {
            let expected = format!("no solver, or that of model = \"{}\"", rung.name());
            Err(Problem::new("solver", format!("\"{}\"", solver.name()), expected))
        }
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
/// where the file is silent. `resolved` makes a sensible scene of a file, or says what is wrong.
pub(super) fn settle_auto(
    file: SceneFile,
    ask: Ask,
    resolved: impl Fn(SceneFile) -> Result<Scene, Problem>,
) -> Result<Scene, Problem> {
    let file = fill_in(SceneFile { model: None, want: None, within: None, ..file })?;
    // half of a symmetric scene is as good
    let resolved = |file: SceneFile| match file.symmetry {
        Some(_) => resolved(file),
        None => resolved(SceneFile { symmetry: Some(Symmetry::X), ..file.clone() }).or_else(|_| resolved(file)),
    };
    let solvers = file.solver.map_or(vec![Solver::WeaklyCompressible, Solver::Incompressible], |solver| vec![solver]);
    let mut of_particles = Vec::new();
    for solver in solvers {
        match fine_enough(SceneFile { solver: Some(solver), ..file.clone() }, ask, resolved) {
            Ok(scene) => of_particles.push(scene),
            Err(problem) if of_particles.is_empty() => return Err(problem),
            Err(_) => {} // the other solver can
        }
    }
    let Choice { rung, scene, spacing, why } = choose(&of_particles, ask.want, ask.within);
    if !rung.is_theory() && file.resolution.spacing.is_none() && !spacing {
        let why = format!("the finest spacing [m]: no chart is near this scene that would tell it; {why}");
        return Err(Problem::missing("resolution.spacing", why));
    }
    let mut scene = of_particles.swap_remove(scene);
    (scene.model, scene.choice) = (rung, Some(why));
    Ok(scene)
}

/// A scene at the spacing that its file says, or else at the one that charts say is fine enough.
fn fine_enough(
    mut file: SceneFile,
    ask: Ask,
    resolved: impl Fn(SceneFile) -> Result<Scene, Problem>,
) -> Result<Scene, Problem> {
    if file.resolution.spacing.is_some() {
        return resolved(file);
    }
    let draught =
        entry_of(&file)?.map(|(_, entry)| entry.attached_draught().max(entry.bottom.draught_at(entry.half_breadth)));
    let draught = draught
        .ok_or_else(|| Problem::missing("resolution.spacing", "the finest spacing [m]: nothing enters the water"))?;
    file.resolution.spacing = Some(draught / PROVISIONAL);
    let scene = resolved(file.clone())?;
    let fine = charted_number(ask.want).and_then(|number| spacing_within(&scene, number, ask.within));
    fine.map_or(Ok(scene), |spacing| {
        file.resolution.spacing = Some(spacing);
        resolved(file)
    })
}

/// The entry of a file's body, were there no end.
fn entry_of(file: &SceneFile) -> Result<Option<(Body, Entry)>, Problem> {
    let Some(body) = &file.body else { return Ok(None) };
    let body = resolve_body(body.clone(), Symmetry::None, file.resolution.spacing)?;
    let (gravity, density) = (file.gravity.unwrap_or([0.0, -9.81]), file.fluid.density.unwrap_or(1000.0));
    let entry = Entry::of(&body, gravity, density, file.time.end.unwrap_or(0.0));
    Ok(entry.map(|entry| (body, entry)))
}

/// An entry without an end: the end from how long it takes.
fn fill_in(mut file: SceneFile) -> Result<SceneFile, Problem> {
    if let (None, Some((body, entry))) = (file.time.end, entry_of(&file)?) {
        let gap = (-body.draught()).max(0.0);
        let fall = 2.0 * gap / (entry.speed - body.velocity[1]); // at the mean of first and last speed
        file.time.end = Some(fall + PAST_CHINES * entry.bottom.draught_at(entry.half_breadth) / entry.speed);
    }
    Ok(file)
}
