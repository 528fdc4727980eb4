//! The equations of the flow about a plate whose lower edge the water leaves (THEORY EN48).

use std::f64::consts::PI;

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::super::grid::TIPS;
use super::super::system::Side;
use crate::dobrovolskaya::{integral, points, softplus, surface_kernel, times};

/// Range of y on the outer surfaces, and of t on the plate and on the surface that leaves its edge: there the fall of the direction and the speeds
/// decrease like e^(−t/2).
const SURFACE: [f64; 2] = [-48.0, 12.0];
const BETWEEN: [f64; 2] = [-60.0, 50.0];
/// Scalar unknowns: ln(θ/π) right and left, ln C, artanh of the edge's place.
pub(super) const SCALARS: usize = 4;

/// The points, and what the falls of the directions add to ln|dζ/du|; the lines are right, left, behind the edge, plate.
pub(super) struct Grids {
    pub step: f64,
    pub y: Vec<f64>,
    pub t: Vec<f64>,
    /// Distances from the tips in u.
    places: [Vec<f64>; 4],
    /// Of the falls on the right, on the left, behind the edge.
    kernels: [[Mat<f64>; 3]; 4],
}

/// ln(1/(1 + e^(−t))).
fn log_share(t: f64) -> f64 {
    -softplus(-t)
}

impl Grids {
    /// Of the edge at u = `edge`.
    pub fn new(step: f64, edge: f64) -> Grids {
        let (y, t) = (points(SURFACE, step), points(BETWEEN, step));
        let of_plate = |i: usize| ((1.0 + edge).ln() + log_share(t[i])).exp();
        let behind = |i: usize| ((1.0 - edge).ln() + log_share(t[i])).exp();
        let (n, m) = (y.len(), t.len());
        let over = |a: f64, b: f64| step * (a / b).ln_1p();
        let others = Mat::from_fn(n, n, |i, j| over(y[j].exp(), TIPS + y[i].exp()));
        let own = surface_kernel(n, step);
        let cavity = surface_kernel(m, step);
        // 1 − q/(2 − p) next to the edge, free of cancellation
        let between = |i: usize, j: usize| {
            let away = (1.0 + edge) * log_share(-t[i]).exp() + (1.0 - edge) * log_share(-t[j]).exp();
            step * (away / (TIPS - of_plate(i))).ln()
        };
        let kernels = [
            [own.clone(), others.clone(), Mat::from_fn(n, m, |i, j| over(-behind(j), TIPS + y[i].exp()))],
            [others, own, Mat::from_fn(n, m, |i, j| step * softplus(behind(j).ln() - y[i]))],
            [
                Mat::from_fn(m, n, |i, j| over(y[j].exp(), TIPS - behind(i))),
                Mat::from_fn(m, n, |i, j| step * softplus(y[j] - behind(i).ln())),
                Mat::from_fn(m, m, |i, j| cavity[(i, j)] - step * softplus(t[j])),
            ],
            [
                Mat::from_fn(m, n, |i, j| step * softplus(y[j] - of_plate(i).ln())),
                Mat::from_fn(m, n, |i, j| over(y[j].exp(), TIPS - of_plate(i))),
                Mat::from_fn(m, m, between),
            ],
        ];
        let outer: Vec<f64> = y.iter().map(|y| y.exp()).collect();
        let places = [outer.clone(), outer, (0..m).map(behind).collect(), (0..m).map(of_plate).collect()];
        Grids { step, y, t, places, kernels }
    }
}

/// What is sought: ln m at the points on the right, on the left and behind the edge, then the scalars.
#[derive(Clone)]
pub(super) struct Unknowns(pub Vec<f64>);

impl Unknowns {
    /// Place of the edge in u.
    pub fn edge(&self) -> f64 {
        self.0[self.0.len() - 1].tanh()
    }

    /// Those of grids with the distance `from` of points, linear in between, on grids with the distance `to`.
    pub fn between(&self, from: f64, to: f64) -> Unknowns {
        let [outer, inner] = [SURFACE, BETWEEN].map(|range| [points(range, from).len(), points(range, to).len()]);
        let mut first = 0;
        let mut all = Vec::new();
        for [before, after] in [outer, outer, inner] {
            let of = &self.0[first..first + before];
            all.extend((0..after).map(|k| {
                let place = (k as f64 * to / from).min((before - 1) as f64);
                let left = (place as usize).min(before - 2);
                of[left] + (place - left as f64) * (of[left + 1] - of[left])
            }));
            first += before;
        }
        all.extend(&self.0[first..]);
        Unknowns(all)
    }

    /// Moved by `share` of `by`.
    pub fn moved(&self, by: &[f64], share: f64) -> Unknowns {
        Unknowns(self.0.iter().zip(by).map(|(of, by)| of + share * by).collect())
    }
}

/// The surface that leaves the edge, from the tip on the left to the edge, in units of λ.
pub(super) struct Behind {
    pub fall: Vec<f64>,
    pub density: Vec<f64>,
    /// Length from the tip.
    pub arc: Vec<f64>,
}

/// A trial.
pub(super) struct Trial {
    pub unknowns: Unknowns,
    pub right: Side,
    pub left: Side,
    pub behind: Behind,
    pub residual: Vec<f64>,
}

/// The equations for a pitch [rad] and U/V.
#[derive(Clone, Copy)]
pub(super) struct Equations {
    pub pitch: f64,
    pub ratio: f64,
}

impl Equations {
    pub fn trial(&self, step: f64, unknowns: Unknowns) -> Trial {
        let grids = Grids::new(step, unknowns.edge());
        self.evaluate(&grids, unknowns)
    }

    pub fn evaluate(&self, grids: &Grids, unknowns: Unknowns) -> Trial {
        let (n, m, h) = (grids.y.len(), grids.t.len(), grids.step);
        let of = &unknowns.0;
        let scalars = &of[2 * n + m..];
        let contacts = [scalars[0].exp(), scalars[1].exp()];
        let falls =
            [&of[..n], &of[n..2 * n], &of[2 * n..2 * n + m]].map(|w| w.iter().map(|w| w.exp()).collect::<Vec<_>>());
        let lines = [0, 1, 2, 3].map(|line| self.line(grids, line, &falls, unknowns.edge()));
        let [on_right, on_left, on_behind, lengths] = lines
            .each_ref()
            .map(|line| line.iter().map(|[stretch, growth, _]| (stretch + growth).exp()).collect::<Vec<_>>());
        let speeds: Vec<f64> =
            lines[3].iter().map(|[stretch, growth, pull]| (scalars[2] + pull - stretch + growth).exp()).collect();
        let arcs = [(&on_right, contacts[0]), (&on_left, contacts[1]), (&on_behind, contacts[1])]
            .map(|(density, contact)| integral(density, h, density[0] / contact));
        let mut residual = Vec::with_capacity(of.len());
        for (number, (line, arc)) in lines.iter().zip(&arcs).enumerate() {
            let off = |(k, [stretch, growth, pull]): (usize, &[f64; 3])| {
                of[number * n + k] - (scalars[2] + pull - PI.ln() + growth - stretch - arc[k].ln())
            };
            residual.extend(line.iter().enumerate().map(off));
        }
        let bevel = self.pitch / PI;
        let whole = |fall: &[f64]| h * fall.iter().sum::<f64>();
        residual.push(1.0 - bevel - contacts[0] - whole(&falls[0]));
        residual.push(1.0 + bevel - contacts[1] - whole(&falls[1]) - whole(&falls[2]));
        let along = h * lengths.iter().sum::<f64>() + lengths[0] * (1.0 / contacts[0] - 0.5 * h);
        let speed = h * speeds.iter().sum::<f64>() + speeds[0] * (1.0 / (0.5 - contacts[0]) - 0.5 * h);
        let ([fall_right, fall_left, fall], [arc_right, arc_left, arc]) = (falls, arcs);
        let plate = (lengths, speeds, along);
        let left = outer(h, fall_left, contacts[1], (on_left, arc_left), (Vec::new(), Vec::new(), 0.0));
        let right = outer(h, fall_right, contacts[0], (on_right, arc_right), plate);
        let [outwards, down] = self.edge_speed(&right);
        residual.push((outwards - self.ratio * down) / along);
        // the water leaves the edge as fast as the surface there is long
        residual.push((speed - along - arc[m - 1]) / (along + arc[m - 1]));
        Trial { unknowns, right, left, behind: Behind { fall, density: on_behind, arc }, residual }
    }

    /// At the points of a line: ln|dζ/du|, ln|du/dy| or ln|du/dt|, and ln of the acceleration's 1/((u + 1)^(3/2) (u − k)^(1/2) (u − 1)).
    fn line(&self, grids: &Grids, line: usize, falls: &[Vec<f64>; 3], edge: f64) -> Vec<[f64; 3]> {
        let sums = [0, 1, 2].map(|from| times(&grids.kernels[line][from], &falls[from]));
        let at = |(i, place): (usize, &f64)| {
            let to_edge = |whole: f64| whole.ln() + log_share(-grids.t[i]);
            let [to_right, to_left, to_edge] = match line {
                0 => [place.ln(), (TIPS + place).ln(), (1.0 + edge + place).ln()],
                1 => [(TIPS + place).ln(), place.ln(), (1.0 - edge + place).ln()],
                2 => [(TIPS - place).ln(), place.ln(), to_edge(1.0 - edge)],
                _ => [place.ln(), (TIPS - place).ln(), to_edge(1.0 + edge)],
            };
            let stretch = self.pitch / PI * (to_left - to_right) + sums[0][i] + sums[1][i] + sums[2][i];
            let growth = place.ln() + if line < 2 { 0.0 } else { log_share(-grids.t[i]) };
            [stretch, growth, -1.5 * to_right - 0.5 * to_edge - to_left]
        };
        grids.places[line].iter().enumerate().map(at).collect()
    }

    /// Velocity at the edge if the water moved with the plate as at its tip, [outwards, down], in units of λ.
    pub fn edge_speed(&self, right: &Side) -> [f64; 2] {
        let (sin, cos) = self.pitch.sin_cos();
        [right.velocity[0] - right.along * cos, right.along * sin - right.velocity[1]]
    }

    /// Newton's step: the Jacobian by differences.
    pub fn correction(&self, grids: &Grids, trial: &Trial) -> Vec<f64> {
        const SMALL: f64 = 1e-6;
        let count = trial.residual.len();
        let mut jacobian = Mat::<f64>::zeros(count, count);
        for column in 0..count {
            let mut moved = trial.unknowns.clone();
            moved.0[column] += SMALL;
            let after = if column + 1 == count { self.trial(grids.step, moved) } else { self.evaluate(grids, moved) };
            for (row, (after, before)) in after.residual.iter().zip(&trial.residual).enumerate() {
                jacobian[(row, column)] = (after - before) / SMALL;
            }
        }
        let wrong = Mat::from_fn(count, 1, |row, _| -trial.residual[row]);
        jacobian.partial_piv_lu().solve(&wrong).col(0).iter().copied().collect()
    }
}

/// A surface that was there before the entry: its points are `h` apart; the plate has ds/dt, dv/dt and its length.
fn outer(
    h: f64,
    fall: Vec<f64>,
    contact: f64,
    (density, arc): (Vec<f64>, Vec<f64>),
    (lengths, speeds, along): (Vec<f64>, Vec<f64>, f64),
) -> Side {
    let mut side = Side { fall, contact, density, arc, lengths, speeds, along, velocity: [0.0; 2] };
    let kicks = side.directions(h).into_iter().enumerate().map(|(k, [cos, down])| {
        let kick = h * PI * side.fall[k] * side.arc[k];
        [kick * down, kick * cos]
    });
    side.velocity = kicks.fold([0.0; 2], |sum, kick| [sum[0] + kick[0], sum[1] + kick[1]]);
    side
}

impl Trial {
    pub fn error(&self) -> f64 {
        self.residual.iter().fold(0.0, |worst, r| if r.is_nan() { f64::INFINITY } else { f64::max(worst, r.abs()) })
    }

    pub fn norm(&self) -> f64 {
        self.residual.iter().map(|r| r * r).sum::<f64>().sqrt()
    }
}
