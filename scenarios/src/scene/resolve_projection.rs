//! The incompressible solvers' table `[projection]`, and what they make of the keys of `[fluid]` (THEORY I1–I16).

use serde::Serialize;

use super::file::{FluidFile, ProjectionFile};
use super::model::{
    CouplingScheme, DensityEvolution, DensityFilter, DiffusionForm, Dissipation, EquationOfState, Integrator, Motion,
    Projection, Scene, Solver, Turbulence, WallModel,
};
use super::problem::{Problem, not_negative, positive, significant, within};
use sph_core::projection::Settings;

/// Largest share of its smoothing length that a particle may move in a step, where the scene does not say.
const CFL: f64 = 0.4;

/// Largest share of it that makes sense: farther, and its neighbours are not those that its pressure was found with.
const LARGEST_CFL: f64 = 1.0;

/// Largest share that was found steady: at 0.6 forces are as good as with shorter steps, at 1 they are twice as unsteady, and
/// falls of water on water gain energy.
const STEADY_CFL: f64 = 0.6;

/// Draughts to the tank's walls and floor from which an impact does not feel them: water that carries no sound answers at
/// once, which took 18 % of a wedge's force at 5 draughts and 6 % at 10.
const REACH: f64 = 15.0;

/// True where a table `[projection]` has a meaning.
fn projects(solver: Solver) -> bool {
    matches!(solver, Solver::Incompressible | Solver::IncompressibleExplicit)
}

/// Its values within their ranges; nothing for other solvers, where a table that says anything is refused.
pub(super) fn resolve_projection(file: &ProjectionFile, solver: Solver) -> Result<Option<Projection>, Problem> {
    if !projects(solver) {
        return refuse_table(file, solver).map(|()| None);
    }
    let usual = Projection::from(Settings::default());
    let most_iterations = file.most_iterations.unwrap_or(usual.most_iterations);
    if most_iterations == 0 {
        return Err(Problem::new("projection.most_iterations", 0, "a whole number of at least 1"));
    }
    Ok(Some(Projection {
        tolerance: within("projection.tolerance", file.tolerance.unwrap_or(usual.tolerance), 1e-12..=0.1)?,
        most_iterations,
        relaxation: positive("projection.relaxation", file.relaxation.unwrap_or(usual.relaxation))?,
        calming: not_negative("projection.calming", file.calming.unwrap_or(usual.calming))?,
        shift: within("projection.shift", file.shift.unwrap_or(usual.shift), 0.0..=10.0)?,
    }))
}

fn refuse_table(file: &ProjectionFile, solver: Solver) -> Result<(), Problem> {
    let ProjectionFile { tolerance, most_iterations, relaxation, calming, shift } = *file;
    let given = [
        ("tolerance", tolerance),
        ("most_iterations", most_iterations.map(|count| count as f64)),
        ("relaxation", relaxation),
        ("calming", calming),
        ("shift", shift),
    ];
    match given.iter().find_map(|(name, value)| Some((name, (*value)?))) {
        None => Ok(()),
        Some((name, value)) => {
            let expected = format!(
                "none with solver = {:?}: the key belongs to \"incompressible\" and \"incompressible_explicit\"",
                solver.name()
            );
            Err(Problem::new(&format!("projection.{name}"), value, expected))
        }
    }
}

/// Defaults of an incompressible solver; what belongs to the weakly compressible one is refused.
pub(super) fn settle_projection(fluid: &mut FluidFile, solver: Solver) -> Result<(), Problem> {
    if !solver.is_incompressible() {
        return Ok(());
    }
    let only = Only { solver };
    only.neutral("integrator", &fluid.integrator, Integrator::Symplectic)?;
    only.neutral("walls", &fluid.walls, WallModel::Extrapolated)?;
    only.neutral("equation_of_state", &fluid.equation_of_state, EquationOfState::Tait)?;
    only.neutral("density_diffusion", &fluid.density_diffusion, 0.0)?;
    only.neutral("density_diffusion_form", &fluid.density_diffusion_form, DiffusionForm::Fourtakas)?;
    only.neutral("density_evolution", &fluid.density_evolution, DensityEvolution::Continuity)?;
    only.neutral("density_filter", &fluid.density_filter, DensityFilter::None)?;
    only.neutral("volume_correction", &fluid.volume_correction, false)?;
    only.neutral("xsph", &fluid.xsph, 0.0)?;
    only.neutral("turbulence", &fluid.turbulence, Turbulence::None)?;
    fluid.density_diffusion = Some(0.0);
    if projects(solver) {
        only.neutral("dissipation", &fluid.dissipation, Dissipation::Diffusion)?;
        if let Some(alpha) = fluid.artificial_viscosity.filter(|alpha| *alpha != 0.0) {
            let expected = format!(
                "none, or 0, with solver = {:?}, which has no speed of sound to scale it (THEORY E7): its viscosity is \
                 projection.calming",
                solver.name()
            );
            return Err(Problem::new("fluid.artificial_viscosity", alpha, expected));
        }
        fluid.artificial_viscosity = Some(0.0);
        fluid.cfl.get_or_insert(CFL);
    }
    Ok(())
}

/// What a key may say beside a solver that does not read it.
struct Only {
    solver: Solver,
}

impl Only {
    /// Nothing, or its neutral value.
    fn neutral<T: PartialEq + Serialize>(&self, name: &str, given: &Option<T>, neutral: T) -> Result<(), Problem> {
        match given {
            Some(value) if *value != neutral => {
                let expected = format!(
                    "none, or {}, with solver = {:?}: the key belongs to \"weakly_compressible\"",
                    written(&neutral),
                    self.solver.name()
                );
                Err(Problem::new(&format!("fluid.{name}"), written(value), expected))
            }
            _ => Ok(()),
        }
    }
}

/// A value as a scene file has it.
fn written<T: Serialize>(value: &T) -> String {
    toml::Value::try_from(value).map_or_else(|_| "a value".to_string(), |value| value.to_string())
}

/// Refuses steps in which water moves farther than its neighbours reach.
pub(super) fn check_projection_step(scene: &Scene) -> Result<(), Problem> {
    match scene.fluid.cfl <= LARGEST_CFL {
        true => Ok(()),
        false => {
            let expected = format!(
                "a number above 0 and up to {LARGEST_CFL} with solver = {:?}: the share of its smoothing length that a particle \
                 moves in a step",
                scene.solver.name()
            );
            Err(Problem::new("fluid.cfl", scene.fluid.cfl, expected))
        }
    }
}

/// Doubts about a scene with an incompressible solver: its step, its walls, and what does nothing.
pub(super) fn projection_warnings(scene: &Scene) -> Vec<String> {
    let (fluid, mut warnings) = (&scene.fluid, Vec::new());
    let thesis = scene.solver == Solver::IncompressibleThesis;
    let idle = [("ventilation", thesis && fluid.ventilation), ("wall_stretch", fluid.wall_stretch)];
    warnings.extend(
        idle.iter()
            .filter(|key| key.1)
            .map(|(name, _)| format!("fluid.{name} = true does nothing with solver = {:?}", scene.solver.name())),
    );
    if fluid.cfl > STEADY_CFL {
        warnings.push(format!(
            "fluid.cfl = {}: up to {STEADY_CFL} forces are as good as with shorter steps; at 1 they are twice as unsteady, and falling \
             water has gained energy",
            fluid.cfl
        ));
    }
    let passing = fluid.smoothing_ratio * scene.resolution.spacing / scene.projection_speed();
    if let Some(step) = scene.time.step.filter(|step| *step > LARGEST_CFL * passing) {
        warnings.push(format!(
            "time.step = {step} s: at the fastest known speed a particle moves {} smoothing lengths in it, and beyond 1 its \
             neighbours are others; {} s would do",
            significant(step / passing),
            significant(CFL * passing)
        ));
    }
    warnings.extend(near_walls(scene));
    warnings.extend(one_exchange(scene));
    warnings
}

/// A body that moves with the water, told of it once a step.
fn one_exchange(scene: &Scene) -> Option<String> {
    let body = scene.body.as_ref()?;
    let moved = !body.panels.is_empty() || matches!(body.motion, Motion::Free(_));
    let (name, holds) = match scene.solver {
        Solver::Incompressible => ("incompressible", "\"added_mass\" holds at any mass"),
        solver => (solver.name(), "\"iqn_ils\" repeats the step until both agree"),
    };
    (moved && scene.coupling.scheme == CouplingScheme::Weak).then(|| {
        format!(
            "coupling.scheme = \"weak\" with solver = \"{name}\": one exchange a step holds where the body is heavier than the \
             water that moves with it, however short the step; {holds}"
        )
    })
}

/// Walls that an impact feels.
fn near_walls(scene: &Scene) -> Option<String> {
    let draught = scene.entry()?.final_draught;
    let beside = 0.5 * scene.tank.width - scene.fine_zone_center().abs();
    let reach = beside.min(scene.tank.depth);
    (draught > 0.0 && reach < REACH * draught).then(|| {
        format!(
            "the tank's walls are {} draughts away at the end: incompressible water answers at once, which took 6 % of a \
             wedge's force at 10 draughts and 18 % at 5; {} m would keep it out",
            significant(reach / draught),
            significant(REACH * draught)
        )
    })
}
