//! Equilibrium paths through limit points, by the cylindrical arc length.

use super::nonlinear::{Equilibrium, NonlinearStatics};
use crate::error::Error;
use crate::field::Dof;
use crate::model::Loads;

/// A correction this small against the arc ends the iteration \[-\].
const CONVERGED: f64 = 1e-9;

/// Maximum number of iterations of a point; a point that needs more is repeated with half the arc.
const ITERATIONS: usize = 20;

/// Target number of iterations for the control of the arc length (Crisfield 1991, 9.5).
const WANTED: f64 = 4.0;

/// Maximum number of bisections of the arc.
const ARC_BISECTIONS: usize = 12;

/// A point on a path of equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPoint {
    /// The loads are this many times those given \[-\].
    pub load_factor: f64,
    /// Displacement `[nodes][u, w, theta]` \[m, m, rad\].
    pub displacement: Vec<[f64; 3]>,
    /// Number of unstable directions of the equilibrium: negative pivots of the tangent stiffness.
    pub unstable_directions: usize,
}

/// A converged point on an arc.
struct Arrival {
    increment: Vec<f64>,
    factor: f64,
    iterations: usize,
}

impl NonlinearStatics {
    /// Follows the path of equilibrium from no load on, through peaks and valleys of the load.
    ///
    /// Crisfield's cylindrical arc length (1981; THEORY BE16): each point lies on a sphere about the one
    /// before, in displacements over the model's extent and rotations. The first point has a load factor of
    /// about `first`; the arc then adapts to the number of iterations, up to `longest` times the first. The
    /// path ends after `points` points, or where `until` returns true.
    pub fn path(
        &self,
        loads: &Loads,
        first: f64,
        longest: f64,
        points: usize,
        until: impl Fn(&PathPoint) -> bool,
    ) -> Result<Vec<PathPoint>, Error> {
        loads.check(self.beam())?;
        if let Some(index) = self.beam().first_plastic_element() {
            let (analysis, instead) = ("a path by the arc length", "NonlinearStatics::solve or history");
            return Err(Error::Unsupported { analysis, feature: "plasticity", item: "element", index, instead });
        }
        let equations = &self.system.equations;
        let mut at = self.at_rest();
        let (mut factor, mut before) = (0.0, vec![0.0; equations.count()]);
        let (mut arc, mut limit) = (f64::NAN, f64::NAN);
        let mut path: Vec<PathPoint> = Vec::new();
        while path.len() < points {
            let (along, unstable_directions) = self.tangent_solution(loads, factor, &at)?;
            if let Some(last) = path.last_mut() {
                last.unstable_directions = unstable_directions;
                if until(last) {
                    break;
                }
            } else {
                arc = first.abs() * self.product(&along, &along).sqrt();
                limit = longest.max(1.0) * arc;
                before = along.iter().map(|x| x * first.signum()).collect();
            }
            let mut arrival = None;
            for _ in 0..ARC_BISECTIONS {
                arrival = self.arrive(loads, factor, &at, &along, &before, arc)?;
                if arrival.is_some() {
                    break;
                }
                arc *= 0.5;
            }
            let Some(arrival) = arrival else {
                let (residual, node, dof) = self.system.worst(&self.residual(loads, factor, &at)?);
                let (step, iteration) = (path.len() + 1, ITERATIONS);
                return Err(Error::NotConverged { step, iteration, residual, load_factor: factor, node, dof });
            };
            self.system.displace(1.0, &arrival.increment, &mut at.u);
            factor += arrival.factor;
            before = arrival.increment;
            arc = (arc * (WANTED / arrival.iterations as f64).sqrt().clamp(0.5, 2.0)).min(limit);
            path.push(PathPoint { load_factor: factor, displacement: at.u.clone(), unstable_directions: 0 });
        }
        Ok(path)
    }

    /// A point on the arc, in the direction of the last increment; none if the iteration does not converge.
    fn arrive(
        &self,
        loads: &Loads,
        factor: f64,
        at: &Equilibrium,
        along: &[f64],
        before: &[f64],
        arc: f64,
    ) -> Result<Option<Arrival>, Error> {
        let equations = &self.system.equations;
        let forward = arc.copysign(self.product(along, before)) / self.product(along, along).sqrt();
        let mut increment: Vec<f64> = along.iter().map(|x| forward * x).collect();
        let mut added = forward;
        let mut matrix = self.system.matrix();
        for iterations in 1..=ITERATIONS {
            let mut here = at.clone();
            self.system.displace(1.0, &increment, &mut here.u);
            let mut correction = self.residual_and_tangent(loads, factor + added, &here, &mut matrix)?;
            if matrix.factorise().is_err() {
                return Ok(None);
            }
            matrix.solve(&mut correction);
            let mut along = equations.reduce(&self.load(loads, &here.u), &equations.links.arms_at(&here.u));
            matrix.solve(&mut along);
            // On the sphere: |increment + correction + x along| = arc.
            let moved: Vec<f64> = increment.iter().zip(&correction).map(|(a, b)| a + b).collect();
            let a = self.product(&along, &along);
            let b = self.product(&along, &moved);
            let c = self.product(&moved, &moved) - arc * arc;
            let root = (b * b - a * c).sqrt();
            if !root.is_finite() {
                return Ok(None);
            }
            // The root that continues in the same direction.
            let ahead = self.product(&along, &increment);
            let x = (-b + root.copysign(ahead)) / a;
            let next: Vec<f64> = moved.iter().zip(&along).map(|(m, t)| m + x * t).collect();
            let change: Vec<f64> = next.iter().zip(&increment).map(|(new, old)| new - old).collect();
            added += x;
            increment = next;
            if self.product(&change, &change).sqrt() <= CONVERGED * arc {
                return Ok(Some(Arrival { increment, factor: added, iterations }));
            }
        }
        Ok(None)
    }

    /// The linear response to the full load at an equilibrium, and the number of negative pivots.
    fn tangent_solution(&self, loads: &Loads, factor: f64, at: &Equilibrium) -> Result<(Vec<f64>, usize), Error> {
        let mut matrix = self.system.matrix();
        self.residual_and_tangent(loads, factor, at, &mut matrix)?;
        let negative = matrix.factorise().map_err(|pivot| self.system.equations.singular(pivot))?;
        let equations = &self.system.equations;
        let mut along = equations.reduce(&self.load(loads, &at.u), &equations.links.arms_at(&at.u));
        matrix.solve(&mut along);
        Ok((along, negative))
    }

    /// Scalar product of two changes of the displacements, lengths over the model's extent.
    fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        let scale = self.beam().extent().powi(-2);
        let weight = |equation: usize| match self.system.equations.place(equation).1 {
            Dof::Theta => 1.0,
            _ => scale,
        };
        a.iter().zip(b).enumerate().map(|(equation, (a, b))| weight(equation) * a * b).sum()
    }
}
