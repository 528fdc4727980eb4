//! How fluid and bodies agree on a step: on the bodies' accelerations, which the wall pressures contain (THEORY C1–C7).

use sph_core::{Breakdown, Fluid, Walls, Yielding};

use crate::coupled::CouplingError;
use crate::relaxation::Relaxation;

/// How fluid and bodies agree on a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scheme {
    /// Not at all: the fluid sees the bodies' accelerations of the step before (E9).
    #[default]
    Weak,
    /// Accelerations and wall pressures are found together (C2), without iterations. Rigid bodies, extrapolated walls.
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
                walls.yielding = owners;
                let ended = attempt(fluid, walls);
                owners = std::mem::take(&mut walls.yielding);
                ended?;
                for owner in &mut owners {
                    (0..3).for_each(|k| owner.acceleration[k] += owner.change[k]);
                }
            }
            Scheme::Aitken(iteration) | Scheme::IqnIls(iteration) => {
                fluid.save();
                let ended = self.iterate(fluid, walls, owners, attempt, iteration);
                fluid.forget();
                return ended;
            }
        }
        let residual = Residual::of(&owners, walls).relative;
        self.note(1, residual);
        Ok(())
    }

    /// C5–C7: repeat the step, from the state that the fluid remembers, with better and better accelerations.
    fn iterate(
        &mut self,
        fluid: &mut Fluid,
        walls: &mut Walls,
        mut owners: Vec<Yielding>,
        mut attempt: impl FnMut(&mut Fluid, &mut Walls) -> Result<(), Breakdown>,
        Iteration { tolerance, max_iterations }: Iteration,
    ) -> Result<(), CouplingError> {
        let (start, first) = (walls.clone(), owners.clone());
        self.relaxation.begin();
        let time = fluid.time;
        for iterations in 1..=max_iterations.max(1) {
            attempt(fluid, walls)?;
            let residual = Residual::of(&owners, walls);
            if residual.relative <= tolerance {
                self.note(iterations, residual.relative);
                return Ok(());
            }
            if iterations >= max_iterations {
                let residual = residual.relative;
                return Err(CouplingError::NotConverged { iterations, residual, tolerance, time });
            }
            let better = self.relaxation.next(&unknowns(&owners), &residual.of_unknowns);
            fluid.restore();
            walls.clone_from(&start);
            for ((owner, first), better) in owners.iter_mut().zip(&first).zip(better.chunks(3)) {
                owner.acceleration = [0, 1, 2].map(|k| better[k] / scales(owner)[k]);
                let change = [0, 1, 2].map(|k| owner.acceleration[k] - first.acceleration[k]);
                walls.accelerate(owner.range.clone(), owner.pole, change);
            }
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

/// C5: angular accelerations count by the radius of gyration [m], so that all unknowns are in m/s².
fn scales(owner: &Yielding) -> [f64; 3] {
    let [x, y, angle] = owner.mobility;
    let gyration = if angle > 0.0 && x.max(y) > 0.0 { (x.max(y) / angle).sqrt() } else { 1.0 };
    [1.0, 1.0, gyration]
}

/// The accelerations that the walls' kinematics were written with [m/s²], three an owner.
fn unknowns(owners: &[Yielding]) -> Vec<f64> {
    owners.iter().flat_map(|owner| [0, 1, 2].map(|k| scales(owner)[k] * owner.acceleration[k])).collect()
}

/// C5: what the accelerations lack of those that the forces cause.
struct Residual {
    of_unknowns: Vec<f64>,
    /// Over the accelerations that forces cause and that result, summed [-].
    relative: f64,
}

impl Residual {
    fn of(owners: &[Yielding], walls: &Walls) -> Residual {
        let (mut of_unknowns, mut squares) = (Vec::new(), [0.0; 3]);
        for owner in owners {
            let mut forces = walls.forces(owner.range.clone());
            forces.mirrored = owner.mirrored;
            let total = forces.resultant(owner.pole);
            let force = [total.force[0], total.force[1], total.moment];
            let (lack, scale) = (owner.lack(force), scales(owner));
            for k in 0..3 {
                let (lack, caused) = (scale[k] * lack[k], scale[k] * owner.mobility[k] * force[k]);
                let found = lack + scale[k] * owner.acceleration[k];
                for (sum, value) in squares.iter_mut().zip([lack, caused, found]) {
                    *sum += value * value;
                }
                of_unknowns.push(lack);
            }
        }
        let [lack, caused, found] = squares.map(f64::sqrt);
        let relative = if lack == 0.0 { 0.0 } else { lack / (caused + found) };
        Residual { of_unknowns, relative }
    }
}
