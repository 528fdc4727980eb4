//! Dobrovolskaya's problem: the flow about a wedge that enters water at constant speed, without gravity (THEORY EN6, EN7).
//!
//! Everything depends on ζ = (x + iy)/(V t). The right half of the water is mapped to the upper half-plane of u: the free
//! surface to u < 0, the wetted face to 0 < u < 1, tip to keel, the plane of symmetry to u > 1. In there, two analytic functions
//! are known on the boundary but for one real function, the fall of the surface's direction, m(y) at u = −e^y.

use std::f64::consts::PI;

use faer::Mat;
use faer::linalg::solvers::Solve;

/// Range of y = ln|u| on the free surface: m falls like e^(y/2) to the left and e^(−3y/2) to the right.
const SURFACE: [f64; 2] = [-48.0, 20.0];
/// ζ′(−2): the trapezoidal rule past a logarithm's singularity is without h ln(h/2π) m + ζ′(−2) h³ m″ (Sidi & Israeli 1988).
const SINGULAR: f64 = -0.030_448_457_058_393_27;
/// Least t on the face, u = 1/(1 + e^−t), and largest on the plane of symmetry, u = 1 + e^t.
const FROM_KEEL: f64 = 60.0;
/// Speeds next to the keel fall like e^(−t (1/2 − β/π)): this many times e.
const FALLEN: f64 = 25.0;
/// Largest residual of a solution.
const SOLVED: f64 = 1e-9;
/// Iterations of Newton's method: 6 to 14 are needed.
const MOST_ITERATIONS: usize = 60;
/// Longest move of an unknown in one of them.
const LONGEST_MOVE: f64 = 2.0;

/// The solution of the boundary problem for one deadrise.
pub(super) struct Dobrovolskaya {
    /// Deadrise β [rad].
    pub beta: f64,
    /// Distance of grid points h in y and t.
    pub step: f64,
    /// y of the points on the free surface.
    pub y: Vec<f64>,
    /// Fall of the surface's direction m = −dδ/dy, whose angle is π(1 + δ), there.
    pub fall: Vec<f64>,
    /// ln|dζ/du| there, but for [`Dobrovolskaya::scale`].
    pub log_stretch: Vec<f64>,
    /// Angle between free surface and face at the jet's tip, over π.
    pub contact: f64,
    /// Lengths in units of V t over lengths here.
    pub scale: f64,
    /// Along the face, from tip to keel: ds/dt, and the tangential velocity's rate dv/dt, in lengths here.
    pub face: [Vec<f64>; 2],
}

/// Points of a range that are `step` apart.
pub(super) fn points([from, to]: [f64; 2], step: f64) -> Vec<f64> {
    (0..=((to - from) / step).round() as usize).map(|k| from + step * k as f64).collect()
}

/// ln(1 + e^x).
pub(super) fn softplus(x: f64) -> f64 {
    x.max(0.0) + (-x.abs()).exp().ln_1p()
}

/// ln|1 − e^z|, z ≠ 0.
pub(super) fn log_distance(z: f64) -> f64 {
    z.max(0.0) + (-(-z.abs()).exp_m1()).ln()
}

/// ∫ up to every point, the values below the first one being `tail`: trapezoids less h²/12 f′ and more h⁴/720 f‴ of the ends (Euler and
/// Maclaurin), order 6 away from the range's ends.
pub(super) fn integral(f: &[f64], step: f64, tail: f64) -> Vec<f64> {
    let n = f.len();
    let end = |k: usize| match k {
        0 => (f[1] - f[0]) / 12.0,
        k if k + 1 == n => (f[k] - f[k - 1]) / 12.0,
        k if k == 1 || k + 2 == n => (f[k + 1] - f[k - 1]) / 24.0,
        k => (82.0 * (f[k + 1] - f[k - 1]) - 11.0 * (f[k + 2] - f[k - 2])) / 1440.0,
    };
    let mut sum = tail;
    let trapezoids = (0..n).map(|k| {
        sum += if k == 0 { 0.0 } else { 0.5 * step * (f[k - 1] + f[k]) };
        sum
    });
    trapezoids.enumerate().map(|(k, sum)| sum - step * (end(k) - end(0))).collect()
}

/// The grids, and what m at each point of the surface adds to ln|dζ/du| elsewhere.
struct Kernels {
    step: f64,
    y: Vec<f64>,
    /// On the surface: h ln|1 − e^(y_j − y_i)|; the entries about the singularity are those of the trapezoidal rule corrected for it.
    surface: Mat<f64>,
    /// ln u and ln(1 − u) on the face.
    face_logs: Vec<[f64; 2]>,
    /// On the face: h ln(1 + e^(y_j)/u_i).
    face: Mat<f64>,
}

/// h ln|1 − e^(y_j − y_i)| of `n` points that are `step` apart; the entries about the singularity are those of the trapezoidal rule corrected for
/// it. Shape (n, n).
pub(super) fn surface_kernel(n: usize, step: f64) -> Mat<f64> {
    let apart: Vec<f64> = (0..2 * n - 1)
        .map(|k| match k as isize - (n as isize - 1) {
            0 => step * ((step / (2.0 * PI)).ln() - 2.0 * SINGULAR),
            d if d.abs() == 1 => step * (log_distance(step * d as f64) + SINGULAR),
            d => step * log_distance(step * d as f64),
        })
        .collect();
    Mat::from_fn(n, n, |i, j| apart[n - 1 + j - i])
}

impl Kernels {
    fn new(beta: f64, step: f64) -> Kernels {
        let y = points(SURFACE, step);
        let n = y.len();
        let face_logs: Vec<[f64; 2]> = points([-FROM_KEEL, FALLEN / (0.5 - beta / PI)], step)
            .into_iter()
            .map(|t| [-softplus(-t), -softplus(t)])
            .collect();
        Kernels {
            surface: surface_kernel(n, step),
            face: Mat::from_fn(face_logs.len(), n, |i, j| step * softplus(y[j] - face_logs[i][0])),
            step,
            y,
            face_logs,
        }
    }
}

/// Σ_j a_ij x_j.
pub(super) fn times(a: &Mat<f64>, x: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; a.nrows()];
    for (j, x) in x.iter().enumerate() {
        sums.iter_mut().zip(a.col(j).iter()).for_each(|(sum, a)| *sum += a * x);
    }
    sums
}

/// Unknowns ln m and ln(θ/π), the residual of EN7, and what it was made of.
struct Trial {
    log_fall: Vec<f64>,
    log_contact: f64,
    residual: Vec<f64>,
    fall: Vec<f64>,
    contact: f64,
    log_stretch: Vec<f64>,
    /// e^(y + L), and arc length from the tip.
    arc: [Vec<f64>; 2],
    /// |dζ/du| du/dt on the face, and 1/|dζ/du| u^(−3/2)/(1 − u) du/dt.
    face: [Vec<f64>; 2],
    integrals: [f64; 2],
}

impl Trial {
    fn new(k: &Kernels, beta: f64, log_fall: Vec<f64>, log_contact: f64) -> Trial {
        let (bevel, corner) = (beta / PI, 0.5 - beta / PI);
        let fall: Vec<f64> = log_fall.iter().map(|w| w.exp()).collect();
        let contact = log_contact.exp();
        // EN6 on the surface and on the face
        let stretched = times(&k.surface, &fall).into_iter().zip(&k.y);
        let log_stretch: Vec<f64> = stretched.map(|(sum, y)| sum - bevel * y - corner * softplus(*y)).collect();
        let on_face = times(&k.face, &fall).into_iter().zip(&k.face_logs);
        let logs: Vec<f64> = on_face.map(|(sum, [lu, l1u])| sum - bevel * lu - corner * l1u).collect();
        let density: Vec<f64> = k.y.iter().zip(&log_stretch).map(|(y, l)| (y + l).exp()).collect();
        let length = integral(&density, k.step, density[0] / contact);
        let lengths: Vec<f64> = logs.iter().zip(&k.face_logs).map(|(l, [lu, l1u])| (l + lu + l1u).exp()).collect();
        let speeds: Vec<f64> = logs.iter().zip(&k.face_logs).map(|(l, [lu, _])| (-l - 0.5 * lu).exp()).collect();
        // EN7: the face's length closes the circuit
        let along = k.step * lengths.iter().sum::<f64>() + lengths[0] * (1.0 / contact - 0.5 * k.step);
        let rate = k.step * speeds.iter().sum::<f64>();
        let strength = (along / (PI * rate)).ln();
        let wanted = |i: usize| strength - 0.5 * k.y[i] - softplus(k.y[i]) - log_stretch[i] - length[i].ln();
        let mut residual: Vec<f64> = (0..fall.len()).map(|i| log_fall[i] - wanted(i)).collect();
        residual.push(1.0 - bevel - contact - k.step * fall.iter().sum::<f64>()); // the direction's whole fall
        let (arc, face, integrals) = ([density, length], [lengths, speeds], [along, rate]);
        Trial { log_fall, log_contact, residual, fall, contact, log_stretch, arc, face, integrals }
    }

    fn error(&self) -> f64 {
        self.residual.iter().fold(0.0, |worst, r| f64::max(worst, r.abs()))
    }

    fn norm(&self) -> f64 {
        self.residual.iter().map(|r| r * r).sum::<f64>().sqrt()
    }

    /// Newton's step.
    fn correction(&self, k: &Kernels) -> Vec<f64> {
        let n = self.fall.len();
        let Trial { arc: [density, length], face: [lengths, speeds], integrals: [along, rate], contact, fall, .. } =
            self;
        let mut weights = lengths.clone();
        weights[0] += lengths[0] * (1.0 / (contact * k.step) - 0.5);
        let mut jacobian = Mat::<f64>::zeros(n + 1, n + 1);
        for j in 0..n {
            let (on_surface, on_face) = (k.surface.col(j), k.face.col(j));
            let of = |w: &[f64]| w.iter().zip(on_face.iter()).map(|(w, a)| w * a).sum::<f64>();
            let strength = k.step * fall[j] * (of(&weights) / along + of(speeds) / rate);
            let grown: Vec<f64> = density.iter().zip(on_surface.iter()).map(|(e, a)| e * a * fall[j]).collect();
            let grown = integral(&grown, k.step, grown[0] / contact);
            for i in 0..n {
                jacobian[(i, j)] = on_surface[i] * fall[j] + grown[i] / length[i] - strength;
            }
            jacobian[(j, j)] += 1.0;
            jacobian[(n, j)] = -fall[j] * k.step;
        }
        for i in 0..n {
            jacobian[(i, n)] = lengths[0] / (contact * along) - density[0] / (contact * length[i]);
        }
        jacobian[(n, n)] = -contact;
        let wrong = Mat::from_fn(n + 1, 1, |i, _| -self.residual[i]);
        jacobian.partial_piv_lu().solve(&wrong).col(0).iter().copied().collect()
    }

    fn moved(&self, k: &Kernels, beta: f64, by: &[f64], share: f64) -> Trial {
        let log_fall = self.log_fall.iter().zip(by).map(|(w, d)| w + share * d).collect();
        Trial::new(k, beta, log_fall, self.log_contact + share * by[by.len() - 1])
    }
}

/// A start from which Newton's method converges for every deadrise from 3° to 85°: asymptotes as above, a contact angle and a
/// place of the jet's root that were fitted to solutions.
fn start(k: &Kernels, beta: f64) -> Trial {
    let degrees = beta.to_degrees();
    let contact = 0.002_62 * degrees.powi(2) * (-0.0112 * degrees + 6e-5 * degrees * degrees).exp() / 180.0;
    let roots =
        [(3.0, -8.2), (4.0, -7.6), (10.0, -6.0), (20.0, -4.8), (30.0, -4.2), (45.0, -3.9), (60.0, -3.8), (80.0, -5.0)];
    let after = roots.iter().position(|(at, _)| *at > degrees).unwrap_or(roots.len() - 1).max(1);
    let ((b0, y0), (b1, y1)) = (roots[after - 1], roots[after]);
    let root = y0 + (y1 - y0) * (degrees - b0) / (b1 - b0);
    let shape = |y: &f64| {
        let (left, right) = (-0.5 * (y - root), y - root);
        -(left.max(right) + (-(left - right).abs()).exp().ln_1p()) - softplus(0.5 * y)
    };
    let raw: Vec<f64> = k.y.iter().map(shape).collect();
    let total = k.step * raw.iter().map(|w| w.exp()).sum::<f64>();
    let lift = ((1.0 - beta / PI - contact) / total).ln();
    Trial::new(k, beta, raw.into_iter().map(|w| w + lift).collect(), contact.ln())
}

impl Dobrovolskaya {
    /// Solve for a deadrise [rad] on grids of the given step; `None` where Newton's method does not arrive.
    pub fn solve(beta: f64, step: f64) -> Option<Dobrovolskaya> {
        let k = Kernels::new(beta, step);
        let mut trial = start(&k, beta);
        for _ in 0..MOST_ITERATIONS {
            if trial.error() < SOLVED {
                return Some(Dobrovolskaya::from(trial, &k, beta));
            }
            let by = trial.correction(&k);
            let farthest = by.iter().fold(0.0, |far, d| f64::max(far, d.abs()));
            let mut share = (LONGEST_MOVE / farthest).min(1.0);
            let mut next = trial.moved(&k, beta, &by, share);
            // a residual that is no number does not fall either
            let falls = |next: &Trial, share: f64| next.norm() < (1.0 - 0.1 * share) * trial.norm();
            while !falls(&next, share) && share > 1e-3 {
                share *= 0.5;
                next = trial.moved(&k, beta, &by, share);
            }
            trial = next;
        }
        None
    }

    fn from(trial: Trial, k: &Kernels, beta: f64) -> Dobrovolskaya {
        let Trial { fall, contact, log_stretch, face: [lengths, speeds], integrals: [along, rate], .. } = trial;
        let strength = along / rate;
        // EN7: on the plane of symmetry the water's speed falls from V at the keel to nothing
        let fallen: f64 = points([-FALLEN / (0.5 - beta / PI), FROM_KEEL], k.step)
            .into_iter()
            .map(|t| {
                let log_u = softplus(t);
                let sum: f64 = k.y.iter().zip(&fall).map(|(y, m)| k.step * m * softplus(y - log_u)).sum();
                let log_stretch = sum - beta / PI * log_u - (0.5 - beta / PI) * t;
                (-1.5 * log_u - log_stretch).exp()
            })
            .sum();
        let scale = 1.0 / (strength * k.step * fallen);
        let face = [lengths, speeds.into_iter().map(|v| strength * v).collect()];
        Dobrovolskaya { beta, step: k.step, y: k.y.clone(), fall, log_stretch, contact, scale, face }
    }
}
