//! The table `[thesis]`: what a scene chooses of the thesis's projection (THEORY J1–J14).

use super::model::{Solver, ThesisSettings};
use super::problem::{Problem, positive, within};

/// Its values within their ranges; nothing for other solvers, where a scene that has the table is refused.
pub(super) fn resolve_thesis(
    given: Option<ThesisSettings>,
    solver: Solver,
) -> Result<Option<ThesisSettings>, Problem> {
    if solver != Solver::IncompressibleThesis {
        return match given {
            None => Ok(None),
            Some(_) => {
                let expected = "\"incompressible_thesis\" where a scene has a table [thesis]";
                Err(Problem::new("solver", format!("{:?}", solver.name()), expected))
            }
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
