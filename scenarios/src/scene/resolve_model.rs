//! `model`, `want`, `within`: which model runs the scene.

use serde::Deserialize;

use super::file::SceneFile;
use super::impact::Entry;
use super::model::{Rung, Scene, Solver, Symmetry};
use super::problem::{Problem, within};
use super::resolve_body::resolve_body;
use crate::ladder::{Theory, Want, choose};

/// The key `model`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ModelName {
    /// The cheapest that is near enough.
    Auto,
    /// Added mass of a flat plate.
    VonKarman,
    /// With the water's pile-up.
    Wagner,
    /// Modified Logvinovich model.
    Mlm,
    /// The exact flow about a wedge.
    Similarity,
    /// Weakly compressible particles.
    Wcsph,
    /// Incompressible particles.
    Incompressible,
}

/// What `auto` is to find a model for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ask {
    want: Want,
    within: f64,
}

/// The model of a scene as written, and its solver; what is asked where the model is left to the program.
pub(super) fn resolve_model(
    model: Option<ModelName>,
    solver: Option<Solver>,
    want: Option<Want>,
    tolerance: Option<f64>,
) -> Result<(Rung, Solver, Option<Ask>), Problem> {
    let of_solver = |solver: Solver| if solver.is_incompressible() { Rung::Incompressible } else { Rung::Wcsph };
    let tolerance = tolerance.map(|share| within("within", share, 0.0..=1.0)).transpose()?;
    let named = |rung: Rung| {
        let usual = if rung == Rung::Incompressible { Solver::Incompressible } else { Solver::WeaklyCompressible };
        let solver = solver.unwrap_or(usual);
        match of_solver(solver) == if rung.is_theory() { Rung::Wcsph } else { rung } {
            true => Ok((rung, solver, None)),
            false => {
                let expected = format!("no solver, or that of model = \"{}\"", rung.name());
                Err(Problem::new("solver", format!("\"{}\"", solver.name()), expected))
            }
        }
    };
    match model {
        Some(ModelName::Auto) => {
            let (_, solver, _) = named(of_solver(solver.unwrap_or_default()))?;
            let ask = Ask { want: want.unwrap_or_default(), within: tolerance.unwrap_or(0.05) };
            Ok((of_solver(solver), solver, Some(ask)))
        }
        _ if want.is_some() || tolerance.is_some() => {
            let key = if want.is_some() { "want" } else { "within" };
            Err(Problem::new(key, "given", "no such key without model = \"auto\": the model is named"))
        }
        None => {
            let solver = solver.unwrap_or_default();
            Ok((of_solver(solver), solver, None))
        }
        Some(ModelName::VonKarman) => named(Rung::VonKarman),
        Some(ModelName::Wagner) => named(Rung::Wagner),
        Some(ModelName::Mlm) => named(Rung::Mlm),
        Some(ModelName::Similarity) => named(Rung::Similarity),
        Some(ModelName::Wcsph) => named(Rung::Wcsph),
        Some(ModelName::Incompressible) => named(Rung::Incompressible),
    }
}

/// Left to the program, the end of an entry is when a body that kept its speed would be this many times as deep as when its
/// spray root is at the chines: past the largest force.
const PAST_CHINES: f64 = 2.0;

/// A scene with `model = "auto"` and no end: the end from how long the entry takes.
pub(super) fn fill_in(mut file: SceneFile) -> Result<SceneFile, Problem> {
    let (Some(ModelName::Auto), None, Some(body)) = (file.model, file.time.end, &file.body) else { return Ok(file) };
    let body = resolve_body(body.clone(), Symmetry::None, file.resolution.spacing)?;
    let gravity = file.gravity.unwrap_or([0.0, -9.81]);
    if let Some(entry) = Entry::of(&body, gravity, file.fluid.density.unwrap_or(1000.0), 0.0) {
        let gap = (-body.draught()).max(0.0);
        let fall = 2.0 * gap / (entry.speed - body.velocity[1]); // at the mean of first and last speed
        file.time.end = Some(fall + PAST_CHINES * entry.bottom.draught_at(entry.half_breadth) / entry.speed);
    }
    Ok(file)
}

/// The same scene by half, where `model = "auto"` and nothing is said of symmetry; it may not be symmetric.
pub(super) fn halved(file: &SceneFile) -> Option<SceneFile> {
    let left_out = file.model == Some(ModelName::Auto) && file.symmetry.is_none();
    left_out.then(|| SceneFile { symmetry: Some(Symmetry::X), ..file.clone() })
}

/// A scene with its model found, or refused where the one named cannot do it.
pub(super) fn settle_model(mut scene: Scene, ask: Option<Ask>) -> Result<Scene, Problem> {
    if let Some(Ask { want, within }) = ask {
        let (rung, why) = choose(&scene, want, within);
        if rung.is_theory() {
            scene.model = rung;
        }
        scene.choice = Some(why);
    } else if scene.model.is_theory() {
        let refused =
            |e| Problem::new("model", format!("\"{}\"", scene.model.name()), format!("a scene it holds for: {e}"));
        Theory::of(&scene, scene.model).map_err(refused)?;
    }
    Ok(scene)
}
