//! Statics at large displacements: load steps, Newton's method with a line search (THEORY BE15).

use super::StaticSolution;
use super::mechanism::require_no_free_motion;
use crate::assembly::{System, reactions};
use crate::element::PlasticStrains;
use crate::error::Error;
use crate::field::{Field, combine};
use crate::linear_algebra::Bordered;
use crate::model::{Beam, Loads, Supports};

/// A correction this small against the whole displacement ends the iteration \[-\]: with the exact
/// tangent the next one is of the order of its square.
const CONVERGED: f64 = 1e-8;

/// A correction this small against the model's extent is rounding \[-\].
const ROUNDING: f64 = 1e-14;

/// Maximum number of iterations of a load step, with full corrections and with a line search.
const ITERATIONS: [usize; 2] = [25, 50];

/// Maximum number of bisections of a load step that does not converge.
const STEP_BISECTIONS: i32 = 8;

/// The line search ends where the slope of the energy has fallen to this fraction \[-\] (Crisfield 1991, 9.2).
const LINE_SEARCH_TOLERANCE: f64 = 0.8;

/// Maximum number of trials of the line search.
const LINE_SEARCH_TRIALS: usize = 8;

/// A supported model at large displacements and rotations.
///
/// Equilibrium f(u) = lambda F(u), with co-rotational elements (THEORY BE11), forces that keep their
/// direction and pressures that follow. Small strains; elements may [yield](Beam::with_plasticity).
#[derive(Debug, Clone)]
pub struct NonlinearStatics {
    pub(crate) system: System,
    zero: Field,
}

/// Displacement and plastic strains.
#[derive(Debug, Clone)]
pub(crate) struct Equilibrium {
    pub u: Vec<[f64; 3]>,
    pub plastic: Vec<PlasticStrains>,
}

impl NonlinearStatics {
    /// A supported model; the equations are numbered here, once.
    pub fn new(beam: Beam, supports: Supports) -> Result<Self, Error> {
        require_no_free_motion(&beam, &supports)?;
        let zero = vec![[0.0; 3]; beam.nodes().len()];
        Ok(Self { system: System::new(beam, supports)?, zero })
    }

    /// The model.
    pub fn beam(&self) -> &Beam {
        &self.system.beam
    }

    /// Applies the loads in `steps` equal steps, each brought to equilibrium by Newton's method.
    ///
    /// If Newton's method does not converge, corrections are shortened (line search), then steps are halved. It fails
    /// where the load passes a maximum: use [`NonlinearStatics::path`] there.
    pub fn solve(&self, loads: &Loads, steps: usize) -> Result<StaticSolution, Error> {
        loads.check(self.beam())?;
        let mut at = self.at_rest();
        self.advance(&Loads::default(), loads, steps, &mut at)?;
        Ok(self.solution(loads, 1.0, at))
    }

    /// Applies load cases in sequence, each by linear interpolation from the one before in `steps` equal steps; the first
    /// from zero. Plastic strains accumulate: after a load, [`Loads::default`] gives the permanent deformation.
    pub fn history(&self, cases: &[Loads], steps: usize) -> Result<Vec<StaticSolution>, Error> {
        let mut at = self.at_rest();
        let none = Loads::default();
        let mut before = &none;
        let mut solutions = Vec::with_capacity(cases.len());
        for case in cases {
            case.check(self.beam())?;
            self.advance(before, case, steps, &mut at)?;
            solutions.push(self.solution(case, 1.0, at.clone()));
            before = case;
        }
        Ok(solutions)
    }

    pub(crate) fn at_rest(&self) -> Equilibrium {
        Equilibrium { u: self.zero.clone(), plastic: self.system.no_plasticity() }
    }

    /// From one load case to another in `steps` steps, halved where Newton's method does not converge.
    fn advance(&self, from: &Loads, to: &Loads, steps: usize, at: &mut Equilibrium) -> Result<(), Error> {
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
                        self.system.update_plasticity(&at.u, &mut at.plastic);
                    }
                    Err(error) if increment < whole * 0.5_f64.powi(STEP_BISECTIONS) => return Err(error),
                    Err(_) => {
                        at.u = before;
                        increment *= 0.5;
                    }
                }
            }
        }
        self.system.require_moderate_bending(&at.u)
    }

    /// Newton's method with full corrections; if it does not converge, once more with a line search.
    ///
    /// In this order, because a slender beam overshoots in its membrane forces at every large correction and corrects it
    /// in the next; a line search would prevent both.
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
            matrix.factorise().map_err(|pivot| system.equations.singular(pivot))?;
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

    /// Length of a correction \[-\]: 1, or less if the work of the residual along it indicates an overshoot.
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
        for _ in 0..LINE_SEARCH_TRIALS {
            let mut trial = at.clone();
            self.system.displace(share, correction, &mut trial.u);
            let slope = work(&self.residual(loads, load_factor, &trial)?);
            if slope.abs() <= LINE_SEARCH_TOLERANCE * at_start.abs() {
                break;
            }
            // The zero of the straight line through both slopes, within limits.
            share *= (at_start / (at_start - slope)).clamp(0.2, 0.7);
        }
        Ok(share)
    }

    pub(crate) fn residual(&self, loads: &Loads, load_factor: f64, at: &Equilibrium) -> Result<Vec<f64>, Error> {
        let mut internal = self.zero.clone();
        self.system.elastic_forces(&at.u, &at.plastic, &mut internal, None);
        Ok(self.difference(loads, load_factor, &at.u, &internal))
    }

    pub(crate) fn residual_and_tangent(
        &self,
        loads: &Loads,
        load_factor: f64,
        Equilibrium { u, plastic }: &Equilibrium,
        matrix: &mut Bordered,
    ) -> Result<Vec<f64>, Error> {
        let mut internal = self.zero.clone();
        let arms = self.system.equations.links.arms_at(u);
        matrix.clear();
        self.system.elastic_forces(u, plastic, &mut internal, Some((1.0, [&arms, &arms], matrix)));
        self.system.subtract_pressure_tangent(loads, u, load_factor, matrix);
        if !arms.is_empty() {
            self.system.add_arm_rotation(&self.load(loads, u), &arms, load_factor, matrix);
            self.system.add_arm_rotation(&internal, &arms, -1.0, matrix);
        }
        Ok(self.difference(loads, load_factor, u, &internal))
    }

    /// Load minus internal forces.
    fn difference(&self, loads: &Loads, load_factor: f64, u: &[[f64; 3]], internal: &[[f64; 3]]) -> Vec<f64> {
        let equations = &self.system.equations;
        let arms = equations.links.arms_at(u);
        let mut residual = equations.reduce(&self.load(loads, u), &arms);
        for (residual, internal) in residual.iter_mut().zip(equations.reduce(internal, &arms)) {
            *residual = load_factor * *residual - internal;
        }
        residual
    }

    /// The whole load of the displaced model.
    pub(crate) fn load(&self, loads: &Loads, u: &[[f64; 3]]) -> Field {
        loads.nodal_forces(self.beam(), &loads.element_forces_at(self.beam(), u))
    }

    /// Reactions and section forces of a displacement in equilibrium with `load_factor` times the loads.
    fn solution(&self, loads: &Loads, load_factor: f64, Equilibrium { u, plastic }: Equilibrium) -> StaticSolution {
        let own: Vec<_> = loads.element_forces_at(self.beam(), &u).iter().map(|&ends| load_factor * ends).collect();
        let mut load = self.load(loads, &u);
        load.as_flattened_mut().iter_mut().for_each(|value| *value *= load_factor);
        let mut internal = self.zero.clone();
        self.system.elastic_forces(&u, &plastic, &mut internal, None);
        let residual = combine(&internal, &load, |internal, load| internal - load);
        let links = &self.system.equations.links;
        StaticSolution {
            reactions: reactions(&self.system.supports, (links, &links.arms_at(&u)), &u, residual),
            section_forces: self.system.section_forces(&u, &plastic, Some(&own)),
            displacement: u,
            plastic_curvature: self.system.plastic_curvatures(&plastic),
        }
    }
}
