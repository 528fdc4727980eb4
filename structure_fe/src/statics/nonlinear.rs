//! Statics at large displacements: load steps, Newton's method with a line search.

use crate::beam::Beam;
use crate::bordered::Bordered;
use crate::error::Error;
use crate::loads::Loads;
use crate::statics::StaticSolution;
use crate::supports::Supports;
use crate::system::System;

/// A correction this small against the whole displacement ends the iteration \[-\]: with the exact
/// tangent the next one is of the order of its square.
const CONVERGED: f64 = 1e-8;

/// A correction this small against the model's extent is rounding \[-\].
const ROUNDING: f64 = 1e-14;

/// Iterations of a load step, at most, with whole corrections; and then with a line search.
const ITERATIONS: [usize; 2] = [25, 50];

/// Halvings of a load step that does not converge, at most.
const STEP_HALVINGS: i32 = 8;

/// The line search ends where the slope of the energy has fallen to this fraction \[-\] (Crisfield 1991, 9.2).
const SLACK: f64 = 0.8;

/// Halvings of a correction, at most.
const HALVINGS: usize = 8;

/// A supported model at large displacements and rotations.
///
/// Equilibrium f(u) = lambda F(u), with co-rotational elements (THEORY S10), forces that keep their
/// direction and pressures that follow. Small strains; elements may [yield](Beam::with_plasticity) in bending.
#[derive(Debug, Clone)]
pub struct NonlinearStatics {
    pub(crate) system: System,
    motionless: Vec<[f64; 3]>,
}

/// Displacement, and what elements that yield kept of the loads before.
#[derive(Debug, Clone)]
pub(crate) struct Equilibrium {
    pub u: Vec<[f64; 3]>,
    pub plastic: Vec<[f64; 2]>,
}

impl NonlinearStatics {
    /// A supported model; its equations are numbered and their band laid out here, once.
    pub fn new(beam: Beam, supports: Supports) -> Result<Self, Error> {
        crate::mechanism::require_no_free_motion(&beam, &supports)?;
        let motionless = vec![[0.0; 3]; beam.nodes().len()];
        Ok(Self { system: System::new(beam, supports)?, motionless })
    }

    /// The model.
    pub fn beam(&self) -> &Beam {
        &self.system.beam
    }

    /// Puts the loads on in `steps` equal steps, each brought to equilibrium by Newton's method.
    ///
    /// Where that does not settle, corrections are shortened (line search), then steps are halved. Fails where the load passes
    /// a maximum: [`NonlinearStatics::path`] goes on.
    pub fn solve(&self, loads: &Loads, steps: usize) -> Result<StaticSolution, Error> {
        loads.check(self.beam())?;
        let mut at = self.at_rest();
        self.go(&Loads::default(), loads, steps, &mut at)?;
        Ok(self.solution(loads, 1.0, at))
    }

    /// Puts one load case after the other on, each growing out of the one before in `steps` equal steps; the first out
    /// of none. Where elements yield, what they keep of one case stays in the next: after a load, [`Loads::default`]
    /// leaves the dent.
    pub fn history(&self, cases: &[Loads], steps: usize) -> Result<Vec<StaticSolution>, Error> {
        let mut at = self.at_rest();
        let none = Loads::default();
        let mut before = &none;
        let mut solutions = Vec::with_capacity(cases.len());
        for case in cases {
            case.check(self.beam())?;
            self.go(before, case, steps, &mut at)?;
            solutions.push(self.solution(case, 1.0, at.clone()));
            before = case;
        }
        Ok(solutions)
    }

    pub(crate) fn at_rest(&self) -> Equilibrium {
        Equilibrium { u: self.motionless.clone(), plastic: self.system.unyielded() }
    }

    /// From one load case to another in `steps` steps, halved where that does not settle.
    fn go(&self, from: &Loads, to: &Loads, steps: usize, at: &mut Equilibrium) -> Result<(), Error> {
        let mut matrix = self.system.matrix();
        let whole = 1.0 / steps.max(1) as f64;
        for step in 1..=steps.max(1) {
            let target = if step == steps.max(1) { 1.0 } else { step as f64 * whole };
            let (mut factor, mut increment) = ((step - 1) as f64 * whole, whole);
            while factor < target {
                let next = if factor + 1.5 * increment > target { target } else { factor + increment };
                let before = at.u.clone();
                let outcome = if from.is_empty() {
                    self.equilibrate(to, next, step, at, &mut matrix)
                } else {
                    self.equilibrate(&from.blend(to, next), 1.0, step, at, &mut matrix)
                };
                match outcome {
                    Ok(()) => {
                        factor = next;
                        self.system.flow(&at.u, &mut at.plastic);
                    }
                    Err(error) if increment < whole * 0.5_f64.powi(STEP_HALVINGS) => return Err(error),
                    Err(_) => {
                        at.u = before;
                        increment *= 0.5;
                    }
                }
            }
        }
        self.system.require_bent_little(&at.u)
    }

    /// Newton's method; where whole corrections do not settle, once more with a line search.
    ///
    /// In that order: a slender beam overshoots in its membrane forces at every large correction, and
    /// mends it in the next; a line search would forbid both.
    fn equilibrate(
        &self,
        loads: &Loads,
        load_factor: f64,
        step: usize,
        at: &mut Equilibrium,
        matrix: &mut Bordered,
    ) -> Result<(), Error> {
        let start = at.u.clone();
        let mut outcome = Ok(());
        for search in [false, true] {
            at.u.clone_from(&start);
            outcome = self.iterate(loads, load_factor, step, search, at, matrix);
            if outcome.is_ok() {
                break;
            }
        }
        outcome
    }

    fn iterate(
        &self,
        loads: &Loads,
        load_factor: f64,
        step: usize,
        search: bool,
        at: &mut Equilibrium,
        matrix: &mut Bordered,
    ) -> Result<(), Error> {
        let system = &self.system;
        let iterations = ITERATIONS[usize::from(search)];
        let mut residual = self.residual_and_tangent(loads, load_factor, at, matrix)?;
        let mut made = 0;
        while made < iterations && residual.iter().all(|r| r.is_finite()) {
            matrix.factorise().map_err(|pivot| system.singular(pivot))?;
            let mut correction = residual.clone();
            matrix.solve(&mut correction);
            let share = if search { self.line_search(loads, load_factor, at, &residual, &correction)? } else { 1.0 };
            system.displace(share, &correction, &mut at.u);
            let size = system.size(&correction);
            let whole = system.size(&system.equations.pick(at.u.as_flattened()));
            if size <= CONVERGED * whole.min(1.0) + ROUNDING {
                return Ok(());
            }
            made += 1;
            residual = self.residual_and_tangent(loads, load_factor, at, matrix)?;
        }
        let (residual, node, dof) = system.worst(&residual);
        Err(Error::NotConverged { step, iteration: made, residual, load_factor, node, dof })
    }

    /// How much of a correction to take: all of it, unless the residual's work along it says overshoot.
    fn line_search(
        &self,
        loads: &Loads,
        load_factor: f64,
        at: &Equilibrium,
        residual: &[f64],
        correction: &[f64],
    ) -> Result<f64, Error> {
        let work = |residual: &[f64]| residual.iter().zip(correction).map(|(r, c)| r * c).sum::<f64>();
        let at_start = work(residual);
        let mut share = 1.0;
        for _ in 0..HALVINGS {
            let mut trial = at.clone();
            self.system.displace(share, correction, &mut trial.u);
            let slope = work(&self.residual(loads, load_factor, &trial)?);
            if slope.abs() <= SLACK * at_start.abs() {
                break;
            }
            // Where the straight line through both slopes is zero, within limits.
            share *= (at_start / (at_start - slope)).clamp(0.2, 0.7);
        }
        Ok(share)
    }

    pub(crate) fn residual(&self, loads: &Loads, load_factor: f64, at: &Equilibrium) -> Result<Vec<f64>, Error> {
        let mut internal = self.motionless.clone();
        self.system.elastic_forces(&at.u, &at.plastic, &mut internal, None);
        Ok(self.less(loads, load_factor, &at.u, &internal))
    }

    pub(crate) fn residual_and_tangent(
        &self,
        loads: &Loads,
        load_factor: f64,
        Equilibrium { u, plastic }: &Equilibrium,
        matrix: &mut Bordered,
    ) -> Result<Vec<f64>, Error> {
        let mut internal = self.motionless.clone();
        let arms = self.system.equations.ties.arms_at(u);
        matrix.clear();
        self.system.elastic_forces(u, plastic, &mut internal, Some((1.0, [&arms, &arms], matrix)));
        loads.subtract_tangent(&self.system, u, load_factor, matrix);
        if !arms.is_empty() {
            self.system.subtract_turning(&self.load(loads, u), &arms, load_factor, matrix);
            self.system.subtract_turning(&internal, &arms, -1.0, matrix);
        }
        Ok(self.less(loads, load_factor, u, &internal))
    }

    /// Load less internal forces.
    fn less(&self, loads: &Loads, load_factor: f64, u: &[[f64; 3]], internal: &[[f64; 3]]) -> Vec<f64> {
        let equations = &self.system.equations;
        let arms = equations.ties.arms_at(u);
        let mut residual = equations.reduce(&self.load(loads, u), &arms);
        for (residual, internal) in residual.iter_mut().zip(equations.reduce(internal, &arms)) {
            *residual = load_factor * *residual - internal;
        }
        residual
    }

    /// The whole load of the displaced model.
    pub(crate) fn load(&self, loads: &Loads, u: &[[f64; 3]]) -> Vec<[f64; 3]> {
        loads.nodal_forces(self.beam(), &loads.element_forces_at(self.beam(), u))
    }

    /// Reactions and section forces of a displacement in equilibrium with `load_factor` times the loads.
    fn solution(&self, loads: &Loads, load_factor: f64, Equilibrium { u, plastic }: Equilibrium) -> StaticSolution {
        let scaled = |field: &mut [f64]| field.iter_mut().for_each(|value| *value *= load_factor);
        let mut own = loads.element_forces_at(self.beam(), &u);
        scaled(own.as_flattened_mut());
        let mut load = self.load(loads, &u);
        scaled(load.as_flattened_mut());
        let mut internal = self.motionless.clone();
        self.system.elastic_forces(&u, &plastic, &mut internal, None);
        StaticSolution {
            reactions: self.system.reactions(&u, &internal, &load),
            section_forces: self.system.section_forces(&u, &plastic, Some(&own)),
            displacement: u,
            plastic_curvature: plastic,
        }
    }
}
