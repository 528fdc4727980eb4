//! How fluid and bodies agree on a step: on the bodies' accelerations, which the wall pressures contain (THEORY C1–C7).

use sph_core::walls::interface::Lack;
use sph_core::{Breakdown, Fluid, Walls, Yielding};

use crate::coupling::error::CouplingError;
use crate::coupling::quasi_newton::Relaxation;

/// How fluid and bodies agree on a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scheme {
    /// Not at all: the fluid sees the bodies' accelerations of the step before (E9).
    #[default]
    Weak,
    /// Accelerations and wall pressures are found together (C2), without iterations. Extrapolated walls.
    AddedMass,
    /// Repeat the step under Aitken's relaxation (C6; Küttler & Wall 2008) until both agree.
    Aitken(Iteration),
    /// Repeat the step with a quasi-Newton update from the least squares of its history (C7; Degroote et al. 2009).
    IqnIls(Iteration),
}

/// When to stop iterating.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// Residual C5 that is good enough [-].
    pub tolerance: f64,
    /// Iterations, one at least, after which a step that still disagrees is an error.
    pub max_iterations: u32,
}

/// How well fluid and bodies agreed, over many steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Agreement {
    /// Steps taken.
    pub steps: u64,
    /// Times that the fluid took a step.
    pub iterations: u64,
    /// Most of these in a step.
    pub most_iterations: u32,
    /// Largest residual C5 of a step [-]: the mismatch between the acceleration that the fluid saw and the one it caused.
    pub worst_residual: f64,
}

/// The exchange of a step, by a scheme.
#[derive(Clone)]
pub(crate) struct Exchange {
    scheme: Scheme,
    relaxation: Relaxation,
    pub report: Agreement,
}

impl Exchange {
    pub fn new(scheme: Scheme) -> Exchange {
        let relaxation = match scheme {
            Scheme::IqnIls(_) => Relaxation::quasi_newton(),
            _ => Relaxation::aitken(),
        };
        Exchange { scheme, relaxation, report: Agreement::default() }
    }

    /// Let the fluid `attempt` a step until it agrees with the owners of its walls. Before: the walls' kinematics are
    /// written with the owners' accelerations.
    pub fn agree(
        &mut self,
        fluid: &mut Fluid,
        walls: &mut Walls,
        mut owners: Vec<Yielding>,
        mut attempt: impl FnMut(&mut Fluid, &mut Walls) -> Result<(), Breakdown>,
    ) -> Result<(), CouplingError> {
        match self.scheme {
            Scheme::Weak => attempt(fluid, walls)?,
            Scheme::AddedMass => {
                fluid.yielding = owners;
                let ended = attempt(fluid, walls);
                owners = std::mem::take(&mut fluid.yielding);
                ended?;
            }
            Scheme::Aitken(iteration) | Scheme::IqnIls(iteration) => {
                fluid.save();
                let (start, time) = (walls.clone(), fluid.time);
                let ended = self.converge(iteration, time, unknowns(&owners), |accelerations, again| {
                    if again {
                        fluid.restore();
                        walls.clone_from(&start);
                        accelerate(&mut owners, walls, accelerations);
                    }
                    attempt(fluid, walls)?;
                    Ok(Residual::of(&owners, walls, obeys_mean(fluid)))
                });
                fluid.forget();
                return ended;
            }
        }
        let residual = Residual::of(&owners, walls, obeys_mean(fluid)).relative;
        self.note(1, residual);
        Ok(())
    }

    /// C5–C7: better and better unknowns, from `x` on, until a `trial` of them leaves a residual that is small enough.
    pub fn converge(
        &mut self,
        Iteration { tolerance, max_iterations }: Iteration,
        time: f64,
        mut x: Vec<f64>,
        mut trial: impl FnMut(&[f64], bool) -> Result<Residual, CouplingError>,
    ) -> Result<(), CouplingError> {
        self.relaxation.begin();
        for iterations in 1.. {
            let Residual { of_unknowns, relative: residual } = trial(&x, iterations > 1)?;
            if residual <= tolerance {
                self.note(iterations, residual);
                break;
            }
            if iterations >= max_iterations {
                return Err(CouplingError::NotConverged { iterations, residual, tolerance, time });
            }
            x = self.relaxation.next(&x, &of_unknowns);
        }
        Ok(())
    }

    fn note(&mut self, iterations: u32, residual: f64) {
        let report = &mut self.report;
        report.steps += 1;
        report.iterations += u64::from(iterations);
        report.most_iterations = report.most_iterations.max(iterations);
        report.worst_residual = report.worst_residual.max(residual);
    }
}

/// PB3: what a projection's force does to a body it does over the whole step.
fn obeys_mean(fluid: &Fluid) -> bool {
    fluid.steps > 0 && fluid.parameters.solver.is_incompressible()
}

/// The accelerations that the walls' kinematics were written with [m/s²], of all owners.
pub(crate) fn unknowns(owners: &[Yielding]) -> Vec<f64> {
    owners.iter().flat_map(|member| member.owner.unknowns()).collect()
}

/// Give the owners' particles other accelerations [m/s²], of all owners, than their kinematics were written with.
pub(crate) fn accelerate(owners: &mut [Yielding], walls: &mut Walls, mut unknowns: &[f64]) {
    for Yielding { range, owner, .. } in owners {
        let (own, others) = unknowns.split_at(owner.unknowns().len());
        owner.accelerate(own, walls.slice_mut(range.clone()));
        unknowns = others;
    }
}

/// C5: what the accelerations lack of those that the forces cause.
pub(crate) struct Residual {
    pub of_unknowns: Vec<f64>,
    /// Over the accelerations that forces cause and that result, summed [-].
    pub relative: f64,
}

impl Residual {
    /// Under the forces now, or under the mean forces of the step.
    pub fn of(owners: &[Yielding], walls: &Walls, in_mean: bool) -> Residual {
        let (mut of_unknowns, mut squares) = (Vec::new(), [0.0; 3]);
        for Yielding { range, mirrored, owner } in owners {
            let mut forces = walls.forces(range.clone());
            forces.mirrored = *mirrored;
            let Lack { lack, caused } = if in_mean { owner.lack_in_mean(&forces) } else { owner.lack(&forces) };
            for ((lack, caused), unknown) in lack.iter().zip(caused).zip(owner.unknowns()) {
                for (sum, value) in squares.iter_mut().zip([*lack, caused, lack + unknown]) {
                    *sum += value * value;
                }
            }
            of_unknowns.extend(lack);
        }
        let [lack, caused, found] = squares.map(f64::sqrt);
        let relative = if lack == 0.0 { 0.0 } else { lack / (caused + found) };
        Residual { of_unknowns, relative }
    }
}
