//! The equations of the flow about a wedge with two deadrises (THEORY EN31, EN32).

use std::f64::consts::PI;

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::grid::{FaceGrid, Grid, TIPS};
use crate::dobrovolskaya::{integral, times};

/// What is sought: per side, right and left, ln m at the points of the surface and ln(θ/π); ln c, artanh of the places of the keel and of the
/// zero of the acceleration.
#[derive(Clone)]
pub(super) struct Unknowns {
    pub log_fall: [Vec<f64>; 2],
    pub log_contact: [f64; 2],
    pub log_strength: f64,
    pub keel: f64,
    pub zero: f64,
}

impl Unknowns {
    /// Distance of the zero of the acceleration from the tip of a side, in u.
    fn zero_from_tip(&self, side: usize) -> f64 {
        1.0 + if side == 0 { self.zero.tanh() } else { -self.zero.tanh() }
    }

    /// Number of unknowns.
    pub fn count(&self) -> usize {
        2 * self.log_fall[0].len() + 5
    }

    fn at(&mut self, k: usize) -> &mut f64 {
        let n = self.log_fall[0].len();
        match k {
            k if k < n => &mut self.log_fall[0][k],
            k if k < 2 * n => &mut self.log_fall[1][k - n],
            k => match k - 2 * n {
                0 => &mut self.log_contact[0],
                1 => &mut self.log_contact[1],
                2 => &mut self.log_strength,
                3 => &mut self.keel,
                _ => &mut self.zero,
            },
        }
    }

    /// The difference to others.
    pub fn less(&self, other: &Unknowns) -> Vec<f64> {
        let (mut own, mut other) = (self.clone(), other.clone());
        (0..self.count()).map(|k| *own.at(k) - *other.at(k)).collect()
    }

    /// Moved by `share` of `by`.
    pub fn moved(&self, by: &[f64], share: f64) -> Unknowns {
        let mut next = self.clone();
        for (k, by) in by.iter().enumerate() {
            *next.at(k) += share * by;
        }
        next
    }
}

/// What the falls of both surfaces add to ln|dζ/du|, per side on its surface and its face.
#[derive(Clone)]
struct Sums {
    surface: [Vec<f64>; 2],
    face: [Vec<f64>; 2],
}

/// One side of a trial, lengths in units of λ.
#[derive(Clone)]
pub(super) struct Side {
    /// Fall of the surface's direction m.
    pub fall: Vec<f64>,
    /// Angle at the tip over π.
    pub contact: f64,
    /// On the surface: ds/dy, and the length from the tip.
    pub density: Vec<f64>,
    pub arc: Vec<f64>,
    /// On the face from the tip: ds/dt, and the rate of the velocity along it.
    pub lengths: Vec<f64>,
    pub speeds: Vec<f64>,
    /// Length of the face.
    pub along: f64,
    /// Velocity of the tip, outwards and up.
    pub velocity: [f64; 2],
}

/// A trial.
pub(super) struct Trial {
    pub unknowns: Unknowns,
    pub sides: [Side; 2],
    pub residual: Vec<f64>,
    sums: Sums,
    faces: [FaceGrid; 2],
}

/// The equations for deadrises right and left [rad] and the ratio U/V of the speed to the right to the one downwards.
pub(super) struct System<'a> {
    pub grid: &'a Grid,
    pub beta: [f64; 2],
    pub ratio: f64,
}

impl System<'_> {
    /// B: the turn of the faces at the keel over π.
    pub fn turn(&self) -> f64 {
        (self.beta[0] + self.beta[1]) / PI
    }

    fn faces(&self, unknowns: &Unknowns) -> [FaceGrid; 2] {
        let keel = unknowns.keel.tanh();
        [1.0 + keel, 1.0 - keel].map(|distance| FaceGrid::new(self.grid, distance, self.turn()))
    }

    pub fn trial(&self, unknowns: Unknowns) -> Trial {
        let faces = self.faces(&unknowns);
        let falls = [0, 1].map(|i| unknowns.log_fall[i].iter().map(|w| w.exp()).collect::<Vec<f64>>());
        let add = |own: &Mat<f64>, other: &Mat<f64>, i: usize| -> Vec<f64> {
            times(own, &falls[i]).into_iter().zip(times(other, &falls[1 - i])).map(|(a, b)| a + b).collect()
        };
        let sums = Sums {
            surface: [0, 1].map(|i| add(&self.grid.own, &self.grid.other, i)),
            face: [0, 1].map(|i| add(&faces[i].own, &faces[i].other, i)),
        };
        let (sides, residual) = self.evaluate(&unknowns, &sums, &faces);
        Trial { unknowns, sides, residual, sums, faces }
    }

    fn evaluate(&self, unknowns: &Unknowns, sums: &Sums, faces: &[FaceGrid; 2]) -> ([Side; 2], Vec<f64>) {
        let (n, h) = (self.grid.y.len(), self.grid.step);
        let mut residual = Vec::with_capacity(unknowns.count());
        let sides = [0, 1].map(|i| {
            let side = self.side(i, unknowns, sums, &faces[i]);
            residual.extend(self.off_surface(i, unknowns, &side, faces[i].keel));
            side
        });
        debug_assert_eq!(residual.len(), 2 * n);
        for (side, beta) in sides.iter().zip(self.beta) {
            residual.push(1.0 - beta / PI - side.contact - h * side.fall.iter().sum::<f64>());
        }
        // EN32: at the tips the water rests on the face, whose keel is at (U/V − i)/λ
        let [right, left] = [0, 1].map(|i| self.keel_speed(i, &sides[i]));
        let unit = sides[0].along + sides[1].along;
        let drift = [right, left].map(|[_, down]| self.ratio * down);
        residual.extend([(right[0] - drift[0]) / unit, (left[0] + drift[1]) / unit, (right[1] - left[1]) / unit]);
        (sides, residual)
    }

    /// Velocity at the keel if the water moved with the face as at its tip, [outwards, down], in units of λ.
    pub fn keel_speed(&self, i: usize, side: &Side) -> [f64; 2] {
        let (sin, cos) = self.beta[i].sin_cos();
        [side.velocity[0] - side.along * cos, side.along * sin - side.velocity[1]]
    }

    fn side(&self, i: usize, unknowns: &Unknowns, sums: &Sums, face: &FaceGrid) -> Side {
        let (grid, h, turn) = (self.grid, self.grid.step, self.turn());
        let [own, other] = [self.beta[i] / PI, self.beta[1 - i] / PI];
        let fall: Vec<f64> = unknowns.log_fall[i].iter().map(|w| w.exp()).collect();
        let contact = unknowns.log_contact[i].exp();
        let density: Vec<f64> = (0..grid.y.len())
            .map(|k| {
                let [y, e] = [grid.y[k], grid.away[k]];
                (sums.surface[i][k] + turn * (face.keel + e).ln() + (1.0 - own) * y - other * (TIPS + e).ln()).exp()
            })
            .collect();
        let arc = integral(&density, h, density[0] / contact);
        let (strength, zero) = (unknowns.log_strength.exp(), unknowns.zero_from_tip(i));
        let (mut lengths, mut speeds) = (Vec::new(), Vec::new());
        for (sum, [lq, lr]) in sums.face[i].iter().zip(&face.logs) {
            let (q, rest) = (lq.exp(), lr.exp());
            let stretch = sum + turn * lr - own * lq - other * (TIPS - q).ln();
            lengths.push((stretch + lq + lr).exp() / face.keel);
            let rate = (-0.5 * lq - 1.5 * (TIPS - q).ln() - stretch).exp() / face.keel;
            speeds.push(strength * rate * (zero - face.keel + rest));
        }
        let along = h * lengths.iter().sum::<f64>() + lengths[0] * (1.0 / contact - 0.5 * h);
        let mut side = Side { fall, contact, density, arc, lengths, speeds, along, velocity: [0.0; 2] };
        let kicks = side.directions(h).into_iter().enumerate().map(|(k, [cos, down])| {
            let kick = h * PI * side.fall[k] * side.arc[k];
            [kick * down, kick * cos]
        });
        side.velocity = kicks.fold([0.0; 2], |sum, kick| [sum[0] + kick[0], sum[1] + kick[1]]);
        side
    }

    /// EN32 on a surface: the residual of ln m.
    fn off_surface(&self, i: usize, unknowns: &Unknowns, side: &Side, keel: f64) -> Vec<f64> {
        let zero = unknowns.zero_from_tip(i);
        let wanted = |k: usize| {
            let [y, e] = [self.grid.y[k], self.grid.away[k]];
            // π m = c e^(−y/2) (2 + e^y)^(−3/2) (b + e^y)/(d + e^y)/(|dζ/du| s)
            unknowns.log_strength - PI.ln() + 0.5 * y - 1.5 * (TIPS + e).ln() + ((zero + e) / (keel + e)).ln()
                - side.density[k].ln()
                - side.arc[k].ln()
        };
        (0..side.fall.len()).map(|k| unknowns.log_fall[i][k] - wanted(k)).collect()
    }

    /// Newton's step: the Jacobian by differences.
    pub fn correction(&self, trial: &Trial) -> Vec<f64> {
        const SMALL: f64 = 1e-6;
        let (n, count) = (self.grid.y.len(), trial.unknowns.count());
        let mut jacobian = Mat::<f64>::zeros(count, count);
        let mut by = vec![0.0; count];
        for column in 0..count {
            by[column] = SMALL;
            let moved = trial.unknowns.moved(&by, 1.0);
            by[column] = 0.0;
            let residual = match column {
                column if column < 2 * n => {
                    let (i, j) = (column / n, column % n);
                    let grown = moved.log_fall[i][j].exp() - trial.unknowns.log_fall[i][j].exp();
                    let mut sums = trial.sums.clone();
                    let add = |sums: &mut Vec<f64>, kernel: &Mat<f64>| {
                        sums.iter_mut().zip(kernel.col(j).iter()).for_each(|(sum, a)| *sum += grown * a);
                    };
                    add(&mut sums.surface[i], &self.grid.own);
                    add(&mut sums.surface[1 - i], &self.grid.other);
                    add(&mut sums.face[i], &trial.faces[i].own);
                    add(&mut sums.face[1 - i], &trial.faces[1 - i].other);
                    self.evaluate(&moved, &sums, &trial.faces).1
                }
                column if column == 2 * n + 3 => self.trial(moved).residual,
                _ => self.evaluate(&moved, &trial.sums, &trial.faces).1,
            };
            for (row, (after, before)) in residual.iter().zip(&trial.residual).enumerate() {
                jacobian[(row, column)] = (after - before) / SMALL;
            }
        }
        let wrong = Mat::from_fn(count, 1, |row, _| -trial.residual[row]);
        jacobian.partial_piv_lu().solve(&wrong).col(0).iter().copied().collect()
    }
}

impl Side {
    /// Cosine of the surface's fall outwards from the tip and its sine, downwards positive, at the points.
    pub fn directions(&self, step: f64) -> Vec<[f64; 2]> {
        let backwards: Vec<f64> = self.fall.iter().rev().copied().collect();
        let fallen = integral(&backwards, step, backwards[0] / 3.0);
        fallen.into_iter().rev().map(|f| [(PI * f).cos(), (PI * f).sin()]).collect()
    }
}

impl Trial {
    pub fn error(&self) -> f64 {
        self.residual.iter().fold(0.0, |worst, r| if r.is_nan() { f64::INFINITY } else { f64::max(worst, r.abs()) })
    }

    pub fn norm(&self) -> f64 {
        self.residual.iter().map(|r| r * r).sum::<f64>().sqrt()
    }
}
