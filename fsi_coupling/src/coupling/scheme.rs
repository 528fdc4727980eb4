//! Coupling schemes: how fluid and bodies find accelerations and wall pressures that belong together (THEORY CO4–CO9).

use serde::{Deserialize, Serialize};

use sph_core::walls::interface::InterfaceResidual;
use sph_core::{Breakdown, Fluid, WallInterface, Walls};

use crate::coupling::error::CouplingError;
use crate::coupling::quasi_newton::QuasiNewton;

/// A coupling scheme.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scheme {
    /// Explicit: the fluid uses the accelerations of the bodies at the end of the step before (WA3).
    #[default]
    Weak,
    /// Accelerations and wall pressures are solved together (CO5), without iterations. For extrapolated walls.
    AddedMass,
    /// The step is repeated with a quasi-Newton update from the least squares of its history (CO9; Degroote et al. 2009).
    IqnIls(Iteration),
}

/// When an iteration ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// Tolerance of the residual CO8 [-].
    pub tolerance: f64,
    /// Maximum number of iterations, at least one. A step that has not converged then is an error.
    pub max_iterations: u32,
}

/// Iterations and residuals of the coupling over many steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CouplingStatistics {
    /// Steps.
    pub steps: u64,
    /// Steps of the fluid, repeated ones included.
    pub iterations: u64,
    /// Most iterations in a step.
    pub most_iterations: u32,
    /// Largest residual CO8 of a step [-]: difference between the accelerations that the fluid used and those that it caused.
    pub worst_residual: f64,
}

/// The interface of fluid and bodies: the scheme and its history.
#[derive(Clone)]
pub(super) struct Interface {
    scheme: Scheme,
    history: QuasiNewton,
    pub statistics: CouplingStatistics,
}

impl Interface {
    pub fn new(scheme: Scheme) -> Interface {
        Interface { scheme, history: QuasiNewton::default(), statistics: CouplingStatistics::default() }
    }

    /// What it keeps from step to step.
    pub fn memory(&self) -> (&QuasiNewton, &CouplingStatistics) {
        (&self.history, &self.statistics)
    }

    /// Take what was kept.
    pub fn set_memory(&mut self, (history, statistics): (QuasiNewton, CouplingStatistics)) {
        (self.history, self.statistics) = (history, statistics);
    }

    /// Let the fluid `attempt` a step until its forces and the bodies' accelerations belong together. Before: the walls'
    /// kinematics contain the bodies' predicted accelerations.
    pub fn solve(
        &mut self,
        fluid: &mut Fluid,
        walls: &mut Walls,
        mut bodies: Vec<WallInterface>,
        mut attempt: impl FnMut(&mut Fluid, &mut Walls, &mut [WallInterface]) -> Result<(), Breakdown>,
    ) -> Result<(), CouplingError> {
        match self.scheme {
            Scheme::Weak => attempt(fluid, walls, &mut [])?,
            Scheme::AddedMass => {
                attempt(fluid, walls, &mut bodies)?;
            }
            Scheme::IqnIls(iteration) => {
                fluid.save();
                let (start, time) = (walls.clone(), fluid.time());
                let ended = self.iterate(iteration, time, unknowns(&bodies), |accelerations, repeated| {
                    if repeated {
                        fluid.restore();
                        walls.clone_from(&start);
                        set_trial(&mut bodies, walls, accelerations);
                    }
                    attempt(fluid, walls, &mut [])?;
                    Ok(Residual::of(&bodies, walls, uses_mean_force(fluid)))
                });
                fluid.forget();
                return ended;
            }
        }
        let residual = Residual::of(&bodies, walls, uses_mean_force(fluid)).relative;
        self.record(1, residual);
        Ok(())
    }

    /// CO8, CO9: improve the unknowns, from `x` on, until a `trial` of them has a small residual.
    pub fn iterate(
        &mut self,
        Iteration { tolerance, max_iterations }: Iteration,
        time: f64,
        mut x: Vec<f64>,
        mut trial: impl FnMut(&[f64], bool) -> Result<Residual, CouplingError>,
    ) -> Result<(), CouplingError> {
        self.history.begin_step();
        for iterations in 1.. {
            let Residual { of_unknowns, relative: residual } = trial(&x, iterations > 1)?;
            if residual <= tolerance {
                self.record(iterations, residual);
                break;
            }
            if iterations >= max_iterations {
                return Err(CouplingError::NotConverged { iterations, residual, tolerance, time });
            }
            x = self.history.next(&x, &of_unknowns);
        }
        Ok(())
    }

    fn record(&mut self, iterations: u32, residual: f64) {
        let all = &mut self.statistics;
        all.steps += 1;
        all.iterations += u64::from(iterations);
        all.most_iterations = all.most_iterations.max(iterations);
        all.worst_residual = all.worst_residual.max(residual);
    }
}

/// CO21: the force of a projection acts over the whole step.
fn uses_mean_force(fluid: &Fluid) -> bool {
    fluid.steps() > 0 && fluid.force_is_constant_in_step()
}

/// The accelerations that the walls' kinematics were written with [m/s²], of all bodies.
pub(super) fn unknowns(bodies: &[WallInterface]) -> Vec<f64> {
    bodies.iter().flat_map(|member| member.owner.unknowns()).collect()
}

/// Replace the accelerations of the bodies' particles by trial accelerations [m/s²] of all bodies.
pub(super) fn set_trial(bodies: &mut [WallInterface], walls: &mut Walls, mut unknowns: &[f64]) {
    for WallInterface { range, owner, .. } in bodies {
        let (own, others) = unknowns.split_at(owner.unknowns().len());
        owner.accelerate(own, walls.slice_mut(range.clone()));
        unknowns = others;
    }
}

/// CO8: accelerations that the forces cause, less the trial accelerations.
pub(super) struct Residual {
    pub of_unknowns: Vec<f64>,
    /// Over the accelerations that forces cause and that result, summed [-].
    pub relative: f64,
}

impl Residual {
    /// Under the forces now, or under the mean forces of the step.
    pub fn of(bodies: &[WallInterface], walls: &Walls, in_mean: bool) -> Residual {
        let (mut of_unknowns, mut squares) = (Vec::new(), [0.0; 3]);
        for WallInterface { range, mirrored, owner } in bodies {
            let mut forces = walls.forces(range.clone());
            forces.mirrored = *mirrored;
            let InterfaceResidual { residual, driving } =
                if in_mean { owner.residual_in_mean(&forces) } else { owner.residual(&forces) };
            for ((residual, caused), unknown) in residual.iter().zip(driving).zip(owner.unknowns()) {
                for (sum, value) in squares.iter_mut().zip([*residual, caused, residual + unknown]) {
                    *sum += value * value;
                }
            }
            of_unknowns.extend(residual);
        }
        let [residual, caused, found] = squares.map(f64::sqrt);
        let relative = if residual == 0.0 { 0.0 } else { residual / (caused + found) };
        Residual { of_unknowns, relative }
    }
}
