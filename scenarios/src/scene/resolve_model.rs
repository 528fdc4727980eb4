//! `model`, `want`, `within`: which model runs the scene.

use serde::Deserialize;

use super::model::{Rung, Scene, Solver};
use super::problem::{Problem, within};
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
