//! The table `[thesis]`: what a scene chooses of the thesis's projection (THEORY J1–J16).

use super::file::FluidFile;
use super::model::{Dissipation, Scene, Solver, ThesisSettings};
use super::problem::{Problem, positive, within};

/// h/Δx of the thesis, up to 1.25 of which its surface holds (THEORY J16).
const SMOOTHING_RATIO: f64 = 1.0;
/// h/Δx up to which the surface holds.
const LARGEST_RATIO: f64 = 1.25;
/// α with which its water at rest stays at rest (J16).
const ARTIFICIAL_VISCOSITY: f64 = 0.1;

/// What the thesis's projection is not to be relied on for.
pub(super) fn thesis_warnings(scene: &Scene) -> Vec<String> {
    let mut warnings = Vec::new();
    if scene.solver != Solver::IncompressibleThesis {
        return warnings;
    }
    if scene.fluid.smoothing_ratio > LARGEST_RATIO {
        warnings.push(format!(
            "fluid.smoothing_ratio = {}: with solver = \"incompressible_thesis\" the free surface holds up to {LARGEST_RATIO}",
            scene.fluid.smoothing_ratio
        ));
    }
    if scene.body.is_some() {
        warnings.push(
            "solver = \"incompressible_thesis\" breaks down where a body enters the surface (THEORY J16): take \"incompressible\""
                .into(),
        );
    }
    warnings
}

/// What the thesis's projection needs of the fluid, where the scene does not say.
pub(super) fn settle_thesis(fluid: &mut FluidFile, solver: Solver) {
    if solver == Solver::IncompressibleThesis {
        fluid.smoothing_ratio.get_or_insert(SMOOTHING_RATIO);
        if fluid.dissipation != Some(Dissipation::Riemann) {
            fluid.artificial_viscosity.get_or_insert(ARTIFICIAL_VISCOSITY);
        }
    }
}

/// Its values within their ranges; nothing for other solvers, where a table that says anything but the defaults is refused.
pub(super) fn resolve_thesis(given: Option<ThesisSettings>, solver: Solver) -> Result<Option<ThesisSettings>, Problem> {
    if solver != Solver::IncompressibleThesis {
        return match given {
            Some(settings) if settings != ThesisSettings::default() => {
                let expected = "\"incompressible_thesis\" where a scene has a table [thesis]";
                Err(Problem::new("solver", format!("{:?}", solver.name()), expected))
            }
            _ => Ok(None),
        };
    }
    let settings = given.unwrap_or_default();
    within("thesis.surface_ratio", settings.surface_ratio, 0.0..=1.0)?;
    positive("thesis.density_tolerance", settings.density_tolerance)?;
    at_least_one("thesis.inner_passes", settings.inner_passes)?;
    within("thesis.residual", settings.residual, 1e-12..=0.1)?;
    at_least_one("thesis.most_iterations", settings.most_iterations)?;
    Ok(Some(settings))
}

fn at_least_one(key: &str, count: usize) -> Result<usize, Problem> {
    match count {
        0 => Err(Problem::new(key, count, "a whole number of at least 1")),
        _ => Ok(count),
    }
}
