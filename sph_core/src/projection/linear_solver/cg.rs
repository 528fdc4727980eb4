//! Conjugate gradients for the pressure equation (THEORY LS3–LS5, LS10).

use serde::{Deserialize, Serialize};

use crate::parallel::{self, CHUNK};
use crate::projection::linear_solver::hierarchy::Hierarchy;
use crate::projection::linear_solver::matrix::{MatrixRows, RankOne};
use crate::projection::linear_solver::null_space::NullSpace;
use crate::projection::linear_solver::woodbury::Bodies;

/// When to stop (LS4).
#[derive(Clone, Copy, Debug)]
pub struct Stop {
    /// Largest |r_i|/scale_i allowed [-].
    pub tolerance: f64,
    /// Iterations after which to give up.
    pub most_iterations: usize,
}

/// How a solve went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solved {
    /// Iterations taken.
    pub iterations: usize,
    /// Largest |r_i|/scale_i left [-].
    pub residual: f64,
}

/// A solve that did not reach its tolerance; the solution holds how far it got.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "pressure not converged: after {iterations} iterations the residual is {residual:.3e} of its scale, in row {worst}"
)]
pub struct NotConverged {
    /// Iterations taken.
    pub iterations: usize,
    /// Largest |r_i|/scale_i left [-].
    pub residual: f64,
    /// The row that has it.
    pub worst: usize,
}

/// Times the iterations that the last attempt at a solve gets.
const MORE: usize = 4;
/// A solve with a hierarchy of an earlier step that has not gained a factor of ten in this number of iterations is stuck.
const STUCK: usize = 40;

/// What a solve is given besides the matrix.
struct Given<'a> {
    ranks: &'a [RankOne],
    b: &'a [f64],
    scale: &'a [f64],
    constrained: &'a [bool],
    stop: &'a Stop,
}

/// LS3: solves A x = b by conjugate gradients. Keeps its memory, and its hierarchy as long as that serves, from solve
/// to solve: to repeat a step to the same bits, keep a clone as well.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct PressureSolver {
    hierarchy: Hierarchy,
    #[serde(skip)]
    null_space: NullSpace,
    #[serde(skip)]
    bodies: Bodies,
    /// 1/a_ii, 0 in rows that are pinned or empty.
    #[serde(skip)]
    inverse: Vec<f64>,
    #[serde(skip)]
    residual: Vec<f64>,
    #[serde(skip)]
    preconditioned: Vec<f64>,
    #[serde(skip)]
    direction: Vec<f64>,
    #[serde(skip)]
    image: Vec<f64>,
    #[serde(skip)]
    guess: Vec<f64>,
    /// 1/scale, of the residual (LS4).
    #[serde(skip)]
    weight: Vec<f64>,
    #[serde(skip)]
    sums: Vec<f64>,
}

impl PressureSolver {
    /// With a preconditioner of choice.
    #[cfg(test)]
    pub fn with(preconditioner: crate::projection::linear_solver::hierarchy::Preconditioner) -> PressureSolver {
        PressureSolver { hierarchy: Hierarchy::with(preconditioner), ..PressureSolver::default() }
    }

    /// What a stored solver is without.
    pub(crate) fn complete(&mut self) {
        self.hierarchy.complete();
    }

    /// Set up for a new matrix; positions [m] and smoothing lengths [m] of its rows tell whether the last one's
    /// hierarchy still serves (LS9).
    pub fn prepare(&mut self, a: &impl MatrixRows, x: &[f64], y: &[f64], h: &[f64]) {
        let n = a.rows();
        let PressureSolver { inverse, residual, preconditioned, direction, image, guess, weight, .. } = self;
        let arrays = [inverse, residual, preconditioned, direction, image, guess, weight];
        for array in arrays {
            array.resize(n, 0.0);
        }
        self.sums.resize(n.div_ceil(CHUNK), 0.0);
        parallel::within_pool(|| self.hierarchy.prepare(a, x, y, h));
    }

    /// LS9: gives the particle `id[k]` of row k, since rows may be reordered between solves. Call before every
    /// [`prepare`](Self::prepare), or never.
    pub fn name(&mut self, id: &[u32]) {
        self.hierarchy.name(id);
    }

    /// How often a hierarchy was made.
    #[cfg(test)]
    pub fn set_ups(&self) -> u64 {
        self.hierarchy.set_ups
    }

    /// LS3–LS5: (A + Σ c g gᵀ) x = b, x = 0 where `constrained`, with the matrix that was prepared. `x` is the first guess
    /// and becomes the solution; the residual of row i is measured against `scale[i]` > 0. What floats gets the mean 0.
    pub fn solve(
        &mut self,
        a: &impl MatrixRows,
        ranks: &[RankOne],
        b: &[f64],
        scale: &[f64],
        constrained: &[bool],
        x: &mut [f64],
        stop: &Stop,
    ) -> Result<Solved, NotConverged> {
        assert_eq!(self.inverse.len(), a.rows(), "prepare the solver for this matrix first");
        let given = Given { ranks, b, scale, constrained, stop };
        parallel::within_pool(|| {
            let old = self.hierarchy.is_old();
            if old {
                self.guess.clone_from_slice(x);
            }
            let first = self.iterate(a, &given, x, old);
            let all = match first {
                Err(stuck) if old => {
                    // made for an earlier matrix: parts may have come to float, or to stand, since
                    self.hierarchy.renew(a);
                    x.copy_from_slice(&self.guess);
                    let more = self.iterate(a, &given, x, false);
                    let total = |i: usize| i + stuck.iterations;
                    more.map(|s| Solved { iterations: total(s.iterations), ..s })
                        .map_err(|e| NotConverged { iterations: total(e.iterations), ..e })
                }
                first => first,
            };
            self.hierarchy.judge(all.ok().map(|s| s.iterations));
            all
        })
    }

    /// LS11: [`solve`](Self::solve), and where that fails from no pressure with a hierarchy of its own, then from there
    /// with more iterations. What is left of the last attempt is what is reported, with the iterations of all.
    pub fn persist(
        &mut self,
        a: &impl MatrixRows,
        b: &[f64],
        scale: &[f64],
        constrained: &[bool],
        x: &mut [f64],
        stop: &Stop,
    ) -> Result<Solved, NotConverged> {
        let more = Stop { most_iterations: MORE * stop.most_iterations, ..*stop };
        let mut failed = match self.solve(a, &[], b, scale, constrained, x, stop) {
            Err(failed) => failed,
            solved => return solved,
        };
        x.fill(0.0);
        parallel::within_pool(|| self.hierarchy.renew(a));
        for stop in [*stop, more] {
            let spent = failed.iterations;
            match self.solve(a, &[], b, scale, constrained, x, &stop) {
                Ok(solved) => return Ok(Solved { iterations: spent + solved.iterations, ..solved }),
                Err(again) => failed = NotConverged { iterations: spent + again.iterations, ..again },
            }
        }
        Err(failed)
    }

    fn iterate(
        &mut self,
        a: &impl MatrixRows,
        given: &Given,
        x: &mut [f64],
        impatient: bool,
    ) -> Result<Solved, NotConverged> {
        let &Given { ranks, b, scale, constrained, stop } = given;
        self.null_space.find(&self.hierarchy.components, constrained, ranks);
        let PressureSolver {
            hierarchy,
            null_space,
            bodies,
            inverse,
            residual,
            preconditioned,
            direction,
            image,
            weight,
            sums,
            ..
        } = self;
        parallel::gather_into(weight, |i| 1.0 / scale[i]);
        let weight = &*weight;
        parallel::gather_into(inverse, |i| {
            if constrained[i] || a.diagonal()[i] <= 0.0 { 0.0 } else { 1.0 / a.diagonal()[i] }
        });
        let inverse = &*inverse;
        parallel::update(x, |i, x| {
            if inverse[i] == 0.0 {
                *x = 0.0
            }
        });

        bodies.set_up(
            ranks,
            |i| inverse[i] != 0.0,
            residual,
            |g, image| {
                hierarchy.apply(inverse, g, image, sums);
            },
        );

        // r = b − A x
        apply(a, ranks, inverse, x, image, sums);
        parallel::gather_into(residual, |i| if inverse[i] == 0.0 { 0.0 } else { b[i] - image[i] });
        null_space.remove(residual);
        let mut worst = largest(residual, weight, sums);
        direction.fill(0.0);
        let (mut old, mut iterations) = (f64::INFINITY, 0);
        let mut mark = (0, worst);
        while worst > stop.tolerance || worst.is_nan() {
            if worst < 0.1 * mark.1 {
                mark = (iterations, worst);
            }
            let stuck = impatient && iterations - mark.0 >= STUCK;
            if iterations == stop.most_iterations || stuck || !worst.is_finite() {
                return Err(give_up(residual, scale, iterations, worst));
            }
            // z = B r less the bodies' part, p ← z + (r·z)/(r·z)_old p
            let mut rz = hierarchy.apply(inverse, residual, preconditioned, sums);
            rz -= bodies.correct(ranks, preconditioned);
            let beta = rz / old;
            parallel::update(direction, |i, p| *p = preconditioned[i] - bodies.taken(i) + beta * *p);
            old = rz;
            // α = r·z/(p·A p), x ← x + α p, r ← r − α A p
            let energy = apply(a, ranks, inverse, direction, image, sums);
            if energy <= 0.0 || !energy.is_finite() {
                return Err(give_up(residual, scale, iterations, worst));
            }
            let alpha = rz / energy;
            worst = go(x, residual, alpha, (direction, image), weight, sums);
            if null_space.is_felt() {
                null_space.remove(residual);
                worst = largest(residual, weight, sums);
            }
            iterations += 1;
        }
        null_space.remove(x);
        Ok(Solved { iterations, residual: worst })
    }
}

/// y ← (A + Σ c g gᵀ) x in rows with an `inverse`, 0 in the others; returns x·y.
fn apply(a: &impl MatrixRows, ranks: &[RankOne], inverse: &[f64], x: &[f64], y: &mut [f64], sums: &mut [f64]) -> f64 {
    let mut energy = a.multiply(x, |i| inverse[i] != 0.0, y, sums);
    for rank in ranks {
        let along = rank.dot(x);
        energy += rank.weight * along * along;
        for &(i, g) in &rank.entries {
            if inverse[i as usize] != 0.0 {
                y[i as usize] += rank.weight * along * g;
            }
        }
    }
    energy
}

/// LS3: x ← x + α p, r ← r − α A p; returns the largest |r_i|/scale_i.
fn go(
    x: &mut [f64],
    residual: &mut [f64],
    alpha: f64,
    (p, image): (&[f64], &[f64]),
    weight: &[f64],
    parts: &mut [f64],
) -> f64 {
    parallel::update_both_chunks(parts, x, residual, |rows, x, r| {
        let (p, image, weight) = (&p[rows.clone()], &image[rows.clone()], &weight[rows]);
        let mut worst = 0.0;
        for k in 0..x.len() {
            x[k] += alpha * p[k];
            r[k] -= alpha * image[k];
            worst = worse(worst, r[k].abs() * weight[k]);
        }
        worst
    });
    parts.iter().fold(0.0, |w, &p| worse(w, p))
}

/// LS4: the largest |r_i|/scale_i; not a number if any is not.
fn largest(residual: &mut [f64], weight: &[f64], parts: &mut [f64]) -> f64 {
    parallel::update_chunks(parts, residual, |rows, chunk| {
        chunk.iter().zip(&weight[rows]).fold(0.0, |w, (r, s)| worse(w, r.abs() * s))
    });
    parts.iter().fold(0.0, |w, &p| worse(w, p))
}

fn worse(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

fn give_up(residual: &[f64], scale: &[f64], iterations: usize, worst: f64) -> NotConverged {
    let share = |i: usize| residual[i].abs() / scale[i];
    let row = (0..residual.len()).max_by(|&i, &k| share(i).total_cmp(&share(k))).unwrap_or(0);
    NotConverged { iterations, residual: worst, worst: row }
}
