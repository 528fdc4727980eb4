//! Entry of a wedge at constant speed: the exact solution without gravity and viscosity (THEORY EN8).

use super::dobrovolskaya::{Dobrovolskaya, integral};

/// Deadrises that are solved [deg].
pub const DEADRISES: [f64; 2] = [4.0, 80.0];
/// Step of the usual grids: everything is within 4·10⁻⁵ of grids five times as fine.
const USUAL_STEP: f64 = 0.5;
/// Points of the profile between two of the grid.
const BETWEEN: usize = 16;

/// The flow about a wedge at constant speed V, in units of V t, ½ρV² and ρV³t.
#[derive(Clone, Debug)]
pub struct SimilarityFlow {
    /// Deadrise [deg].
    pub deadrise_deg: f64,
    /// Force on both faces F/(ρV³t) [-].
    pub force_coefficient: f64,
    /// The same from the rate of the water's kinetic energy [-]: a check of the solution.
    pub force_from_energy: f64,
    /// Largest pressure coefficient [-].
    pub cp_max: f64,
    /// Height of it above still water, over V t [-]; −1 is the keel.
    pub z_max: f64,
    /// Pressure coefficient at the keel [-].
    pub cp_keel: f64,
    /// Angle between free surface and face at the jet's tip [deg].
    pub contact_angle_deg: f64,
    /// The jet's tip, [x, y]/(V t) [-].
    pub tip: [f64; 2],
    /// Where the free surface is vertical, next to the jet's root, x/(V t) [-]; the tip's where it nowhere is.
    pub turn: f64,
    /// Along the face from keel to tip: x/(V t) and pressure coefficient [-], shape (n, 2).
    pub profile: Vec<[f64; 2]>,
    /// Free surface from the tip outwards: [x, y]/(V t) [-], shape (n, 2).
    pub surface: Vec<[f64; 2]>,
}

impl SimilarityFlow {
    /// Solve for a deadrise of 4 to 80 degrees; `None` outside.
    pub fn solve(deadrise_deg: f64) -> Option<SimilarityFlow> {
        SimilarityFlow::with_step(deadrise_deg, USUAL_STEP)
    }

    /// The same on grids of another step [-].
    pub fn with_step(deadrise_deg: f64, step: f64) -> Option<SimilarityFlow> {
        let [least, most] = DEADRISES;
        let solvable = (least..=most).contains(&deadrise_deg);
        let solved = solvable.then(|| Dobrovolskaya::solve(deadrise_deg.to_radians(), step)).flatten()?;
        Some(SimilarityFlow::from(&solved))
    }

    /// Pressure coefficient at x/(V t) on the face [-]; none beyond the tip.
    pub fn pressure_coefficient(&self, x: f64) -> f64 {
        let after = self.profile.partition_point(|p| p[0] <= x.abs());
        match after {
            0 => self.cp_keel,
            n if n == self.profile.len() => 0.0,
            n => {
                let ([x0, p0], [x1, p1]) = (self.profile[n - 1], self.profile[n]);
                p0 + (p1 - p0) * (x.abs() - x0) / (x1 - x0)
            }
        }
    }

    fn from(d: &Dobrovolskaya) -> SimilarityFlow {
        let (sin, cos) = d.beta.sin_cos();
        let [lengths, speeds] = &d.face;
        let length = integral(lengths, d.step, lengths[0] / d.contact);
        let speed = integral(speeds, d.step, speeds[0] / (0.5 - d.contact));
        // Bernoulli along the face: dp = ρ (s − v) dv, from the tip, where p is nothing
        let rate: Vec<f64> = (0..length.len()).map(|k| (length[k] - speed[k]) * speeds[k]).collect();
        let pressure = integral(&rate, d.step, 0.0);
        let (scale, whole) = (d.scale, length[length.len() - 1]);
        let cp: Vec<f64> = pressure.iter().map(|p| 2.0 * p * scale * scale).collect();
        let force: f64 = cp.iter().zip(lengths).map(|(cp, s)| cp * s * scale * d.step * cos).sum();
        let from_keel: Vec<f64> = length.iter().map(|s| (whole - s) * scale).collect();

        let fine = |values: &[f64]| finer(values, BETWEEN);
        let (arcs, cps) = (fine(&from_keel), fine(&cp));
        let (top, cp_max) = peak(&cps);
        let mut profile: Vec<[f64; 2]> = arcs.iter().zip(&cps).map(|(s, p)| [s * cos, *p]).rev().collect();
        profile.dedup_by(|b, a| b[0] - a[0] < 1e-12);

        let tip = [whole * scale * cos, whole * scale * sin - 1.0];
        let (surface, surface_energy) = surface(d, tip);
        let face_energy = {
            let flow = |k: usize| {
                let (s, relative) = (length[k] * scale, (speed[k] - length[k]) * scale);
                face_energy([sin, cos], tip, s, relative, 0.5 * cp[k])
            };
            // near the tip the water rests on the face, relatively to nothing but the tip: a cubic in s
            let resting = |s: f64| face_energy([sin, cos], tip, s, -s, 0.0);
            let first = length[0] * scale;
            let tail = first / 6.0 * (resting(0.0) + 4.0 * resting(0.5 * first) + flow(0));
            let along: f64 = (0..length.len()).map(|k| flow(k) * lengths[k] * scale * d.step).sum();
            along + tail - 0.5 * flow(0) * lengths[0] * scale * d.step
        };
        let turned = surface.windows(2).find(|w| w[1][0] > w[0][0]).map_or(tip[0], |w| w[0][0]);
        SimilarityFlow {
            deadrise_deg: d.beta.to_degrees(),
            force_coefficient: force,
            force_from_energy: 2.0 * (face_energy + surface_energy),
            cp_max,
            z_max: top.map_or(-1.0, |place| {
                let (k, share) = (place as usize, place.fract());
                (arcs[k] + share * (arcs[k + 1] - arcs[k])) * sin - 1.0
            }),
            cp_keel: cp[cp.len() - 1],
            contact_angle_deg: 180.0 * d.contact,
            tip,
            turn: turned,
            profile,
            surface,
        }
    }
}

/// φ ∂φ/∂n at the distance s from the tip on the face, in units of V t and V² t, where the water moves at `relative` along it, tip
/// to keel, and has the pressure p/(ρV²): φ = ζ·v − ½v² − p.
fn face_energy([sin, cos]: [f64; 2], tip: [f64; 2], s: f64, relative: f64, p: f64) -> f64 {
    let at = [tip[0] - s * cos, tip[1] - s * sin];
    let v = [at[0] - relative * cos, at[1] - relative * sin];
    let potential = at[0] * v[0] + at[1] * v[1] - 0.5 * (v[0] * v[0] + v[1] * v[1]) - p;
    -cos * potential
}

/// The free surface from the jet's tip outwards, a point a step of the grid behind it; and ∫ φ ∂φ/∂n ds along it, with
/// ∂φ/∂n = ζ·n and φ = ζ·v − ½v². What falls off far away is gathered from there: direction, height over still water, and
/// velocity, dv = π m s n dy by EN7.
fn surface(d: &Dobrovolskaya, tip: [f64; 2]) -> (Vec<[f64; 2]>, f64) {
    let n = d.y.len();
    let from_afar = |f: &dyn Fn(usize) -> f64, decay: f64| {
        let backwards: Vec<f64> = (0..n).rev().map(f).collect();
        let mut sums = integral(&backwards, d.step, backwards[0] / decay);
        sums.reverse();
        sums
    };
    let density: Vec<f64> = d.y.iter().zip(&d.log_stretch).map(|(y, l)| d.scale * (y + l).exp()).collect();
    let arc = integral(&density, d.step, density[0] / d.contact);
    let directions: Vec<[f64; 2]> = from_afar(&|k| d.fall[k], 1.5)
        .into_iter()
        .map(|fallen| <[f64; 2]>::from((-std::f64::consts::PI * fallen).sin_cos()))
        .collect();
    let rate: Vec<f64> = (0..n).map(|k| density[k] * directions[k][1]).collect();
    let x = integral(&rate, d.step, tip[0] + rate[0] / d.contact);
    let y = from_afar(&|k| -density[k] * directions[k][0], 1.0);
    let kick = |k: usize| std::f64::consts::PI * d.fall[k] * arc[k];
    let u = from_afar(&|k| -kick(k) * directions[k][0], 1.0);
    let v = from_afar(&|k| kick(k) * directions[k][1], 1.0);
    let energy = |[x, y]: [f64; 2], [u, v]: [f64; 2], [sin, cos]: [f64; 2]| {
        (x * u + y * v - 0.5 * (u * u + v * v)) * (y * cos - x * sin)
    };
    let first = energy([x[0], y[0]], [u[0], v[0]], directions[0]);
    let middle = [0.5 * (tip[0] + x[0]), 0.5 * (tip[1] + y[0])];
    let between = energy(middle, [0.5 * (tip[0] + u[0]), 0.5 * (tip[1] + v[0])], directions[0]);
    let tail = arc[0] / 6.0 * (energy(tip, tip, directions[0]) + 4.0 * between + first); // straight: a cubic in s
    let sum: f64 = (0..n).map(|k| energy([x[k], y[k]], [u[k], v[k]], directions[k]) * density[k] * d.step).sum();
    let surface = std::iter::once(tip).chain(x.into_iter().zip(y).map(|(x, y)| [x, y])).collect();
    (surface, sum + tail - 0.5 * first * density[0] * d.step)
}

/// Place of the largest value between points, `None` at the end, and that value: by the parabola through the three highest.
pub(super) fn peak(values: &[f64]) -> (Option<f64>, f64) {
    let top = (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap_or(0);
    if top == 0 || top + 2 >= values.len() {
        return (None, values[values.len() - 1]);
    }
    let [left, middle, right] = [values[top - 1], values[top], values[top + 1]];
    let off = 0.5 * (left - right) / (left - 2.0 * middle + right);
    (Some(top as f64 + off), middle - 0.25 * (left - right) * off)
}

/// `times` as many points by polynomials through six.
pub(super) fn finer(values: &[f64], times: usize) -> Vec<f64> {
    const THROUGH: usize = 6;
    let n = values.len();
    let at = |k: usize| {
        let place = k as f64 / times as f64;
        let first = (place as usize).saturating_sub(2).min(n - THROUGH);
        let weight = |i: usize| {
            let others = (first..first + THROUGH).filter(|&j| j != i);
            others.map(|j| (place - j as f64) / (i as f64 - j as f64)).product::<f64>()
        };
        (first..first + THROUGH).map(|i| values[i] * weight(i)).sum()
    };
    (0..=times * (n - 1)).map(at).collect()
}
