//! Entry of a flat plate at constant speed, its lower edge first: the similar flow without gravity and viscosity (THEORY EN48; Faltinsen &
//! Semenov 2008).
//!
//! The water wets the lower side, leaves the edge along it, and rises behind the plate to a tip between the surface that left the edge and the
//! one that was there before.

mod equations;

use std::f64::consts::PI;

use equations::{Equations, Grids, SCALARS, Trial, Unknowns};

use super::sums::{Place, Sums};
use super::{Balance, FaceFlow, side};
use crate::dobrovolskaya::{Dobrovolskaya, integral, softplus};

/// Step of the usual grids.
const USUAL_STEP: f64 = 0.5;
/// Step of the grids on which it is sought first.
const FIRST_STEP: f64 = 1.0;
/// Pitches [deg].
const PITCHES: [f64; 2] = [4.0, 60.0];
/// Range of U/V [-].
const RATIOS: [f64; 2] = [-0.5, 2.0];
/// Largest residual of a solution.
const SOLVED: f64 = 1e-9;
/// Most iterations of Newton's method: 12 to 40 are needed from the start.
const MOST_ITERATIONS: usize = 80;
/// Longest move of an unknown in one of them.
const LONGEST_MOVE: f64 = 2.0;
/// Steps of U/V, the first and the least.
const RATIO_STEPS: [f64; 2] = [0.1, 0.01];

/// The flow about a plate that rises to the right from its lower edge, moves down at constant speed V and to the right at U, in units of V t,
/// ½ρV² and ρV³t.
#[derive(Clone, Debug)]
pub struct PlateFlow {
    /// The lower side, from the edge; its tip and surface are those on the right.
    pub face: FaceFlow,
    /// Force [F_x, F_y]/(ρV³t) [-], x to the right, y up.
    pub force: [f64; 2],
    /// Moment about the edge M/(ρV⁴t²) [-], counter-clockwise.
    pub moment: f64,
    /// Tip of the water behind the plate, [x, y]/(V t) [-], from the place of first contact.
    pub tip: [f64; 2],
    /// Velocity of the water there over V [-]: equal to the place in an exact solution.
    pub tip_velocity: [f64; 2],
    /// Angle of the water there [deg].
    pub tip_angle_deg: f64,
    /// The surface that left the edge, from the tip to the edge, [x, y]/(V t) [-], shape (n, 2).
    pub behind: Vec<[f64; 2]>,
    /// The surface on the left, from the tip outwards, [x, y]/(V t) [-], shape (n, 2).
    pub surface: Vec<[f64; 2]>,
    /// Checks of the solution.
    pub balance: Balance,
}

/// There is no such flow.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no similar flow about a plate pitched by {pitch_deg} degrees at U/V = {ratio}: {why}")]
pub struct NoPlateFlow {
    /// Pitch [deg].
    pub pitch_deg: f64,
    /// Speed to the right over the one downwards U/V [-].
    pub ratio: f64,
    /// Why.
    pub why: &'static str,
}

impl PlateFlow {
    /// For the pitch, the angle between plate and still water [rad], and the speed to the right over the one downwards U/V [-].
    ///
    /// # Errors
    /// A pitch outside 4–60°, U/V outside −0.5 to 2; a flow at which Newton's method does not arrive.
    pub fn solve(pitch: f64, ratio: f64) -> Result<PlateFlow, NoPlateFlow> {
        PlateFlow::with_step(pitch, ratio, USUAL_STEP)
    }

    /// The same on grids of another step [-].
    ///
    /// # Errors
    /// As [`PlateFlow::solve`].
    pub fn with_step(pitch: f64, ratio: f64, step: f64) -> Result<PlateFlow, NoPlateFlow> {
        let pitch_deg = pitch.to_degrees();
        let refused = |why| NoPlateFlow { pitch_deg, ratio, why };
        let within = |of: f64, [least, most]: [f64; 2]| (least..=most).contains(&of);
        if !within(pitch_deg, PITCHES) || !within(ratio, RATIOS) {
            return Err(refused("expected a pitch of 4 to 60 degrees and U/V from -0.5 to 2"));
        }
        let at = |ratio: f64| Equations { pitch, ratio };
        let coarse = |ratio: f64, from| newton(&at(ratio), FIRST_STEP, from);
        start(&at(0.0), FIRST_STEP)
            .and_then(|start| coarse(0.0, start))
            .and_then(|vertical| continued(vertical, ratio, coarse))
            .and_then(|coarse| newton(&at(ratio), step, coarse.unknowns.between(FIRST_STEP, step)))
            .map(|trial| PlateFlow::of(&trial, &at(ratio), step))
            .ok_or(refused("Newton's method does not arrive"))
    }

    /// Of a solution of the equations.
    fn of(trial: &Trial, equations: &Equations, step: f64) -> PlateFlow {
        let Equations { pitch, ratio } = *equations;
        let (sin, cos) = pitch.sin_cos();
        let scale = 1.0 / equations.edge_speed(&trial.right)[1];
        let (face, on_right) = side::flow(&trial.right, [pitch, ratio], step, scale);
        let (behind, on_behind) = behind(trial, equations, step, scale);
        let tip = behind[0];
        let (surface, on_left) = side::surface(&trial.left, step, scale, [-tip[0], tip[1]]);
        let sums = on_right.plus(&on_behind, 1.0).plus(&on_left.mirrored(), 1.0);
        let force = [-face.force_coefficient * sin, face.force_coefficient * cos];
        let [out, up] = trial.left.velocity;
        PlateFlow {
            force,
            moment: face.moment_coefficient,
            tip,
            tip_velocity: [-out * scale, up * scale],
            tip_angle_deg: 180.0 * trial.left.contact,
            behind,
            surface: surface.into_iter().map(|[x, y]| [-x, y]).collect(),
            balance: Balance::of(&sums, ratio, force[0], face.length * (cos + ratio * sin)),
            face,
        }
    }
}

/// The surface that left the edge, from its tip, and the integrals over it: the water there moves towards the tip with its distance from it.
fn behind(trial: &Trial, equations: &Equations, step: f64, scale: f64) -> (Vec<[f64; 2]>, Sums) {
    let surface = &trial.behind;
    let n = surface.fall.len();
    let from_edge = |f: &dyn Fn(usize) -> f64, power: f64| {
        let backwards: Vec<f64> = (0..n).rev().map(f).collect();
        let mut sums = integral(&backwards, step, backwards[0] / power);
        sums.reverse();
        sums
    };
    let turned = from_edge(&|k| PI * surface.fall[k], 0.5);
    let to_tip: Vec<[f64; 2]> = turned
        .iter()
        .map(|turned| {
            let (sin, cos) = (PI + equations.pitch - turned).sin_cos();
            [cos, sin]
        })
        .collect();
    let [x, y] = [0, 1].map(|i| from_edge(&|k| surface.density[k] * to_tip[k][i] * scale, 1.0));
    let at: Vec<[f64; 2]> = (0..n).map(|k| [equations.ratio + x[k], y[k] - 1.0]).collect();
    let first = surface.arc[0] * scale;
    let tip = [0, 1].map(|i| at[0][i] + first * to_tip[0][i]);
    let place = |k: usize| {
        let [cos, sin] = to_tip[k];
        let relative = surface.arc[k] * scale;
        let velocity = [at[k][0] + relative * cos, at[k][1] + relative * sin];
        Place { at: at[k], velocity, normal: [sin, -cos], pressure: 0.0 }
    };
    let places: Vec<Place> = (0..n).map(place).collect();
    let weights: Vec<f64> = surface.density.iter().map(|d| d * step * scale).collect();
    let sums = Sums::over(&places, &weights).plus(&places[0].jet(tip, first), 1.0);
    (std::iter::once(tip).chain(at).collect(), sums)
}

/// The right side of a wedge of this deadrise, and shapes that were fitted to solutions.
fn start(equations: &Equations, step: f64) -> Option<Unknowns> {
    const EDGE: f64 = 0.2;
    const TIP_ANGLE: f64 = 0.26;
    const SHARE_AFORE: f64 = 0.45;
    let grids = Grids::new(step, EDGE);
    let bevel = equations.pitch / PI;
    let exact = Dobrovolskaya::solve(equations.pitch, USUAL_STEP)?;
    let last = exact.y.len() - 1;
    let of_wedge = |y: &f64| {
        let away = 2.0 + y.exp();
        let place = (y + away.ln() - exact.y[0]) / exact.step;
        let k = (place.floor() as usize).min(last - 1);
        let [a, b] = [exact.fall[k].ln(), exact.fall[k + 1].ln()];
        a + (place - k as f64) * (b - a) + softplus(y - away.ln())
    };
    let power = 1.0 - 2.0 * TIP_ANGLE;
    let shape = |points: &[f64], centre: f64, decay: f64, total: f64| {
        let raw: Vec<f64> =
            points.iter().map(|x| -softplus((centre - x) * power) - softplus((x - centre) * decay)).collect();
        let lift = (total / (step * raw.iter().map(|w| w.exp()).sum::<f64>())).ln();
        raw.into_iter().map(|w| w + lift).collect::<Vec<_>>()
    };
    let whole = 1.0 + bevel - TIP_ANGLE;
    let mut unknowns: Vec<f64> = grids.y.iter().map(of_wedge).collect();
    unknowns.extend(shape(&grids.y, -1.0, 3.0, whole * SHARE_AFORE));
    unknowns.extend(shape(&grids.t, 0.0, 0.5, whole * (1.0 - SHARE_AFORE)));
    unknowns.extend([exact.contact.ln(), TIP_ANGLE.ln(), 0.0, EDGE.atanh()]);
    let off = equations.evaluate(&grids, Unknowns(unknowns.clone())).residual;
    let (outer, strength) = (2 * grids.y.len(), unknowns.len() - SCALARS + 2);
    unknowns[strength] = off[..outer].iter().sum::<f64>() / outer as f64;
    Some(Unknowns(unknowns))
}

/// From the vertical motion to U/V = `ratio`.
fn continued(vertical: Trial, ratio: f64, solve: impl Fn(f64, Unknowns) -> Option<Trial>) -> Option<Trial> {
    let [mut step, least] = RATIO_STEPS;
    let (mut reached, mut now, mut before) = (0.0, vertical, None::<(f64, Unknowns)>);
    while reached != ratio {
        let next = reached + (ratio - reached).clamp(-step, step);
        let guess = match &before {
            Some((at, earlier)) => {
                let by: Vec<f64> = now.unknowns.0.iter().zip(&earlier.0).map(|(now, before)| now - before).collect();
                now.unknowns.moved(&by, (next - reached) / (reached - at))
            }
            None => now.unknowns.clone(),
        };
        match solve(next, guess) {
            Some(solved) => {
                before = Some((reached, now.unknowns));
                (now, reached) = (solved, next);
            }
            None if step > least => step *= 0.5,
            None => return None,
        }
    }
    Some(now)
}

/// Newton's method with steps that the norm of the residual limits.
fn newton(equations: &Equations, step: f64, from: Unknowns) -> Option<Trial> {
    let mut trial = equations.trial(step, from);
    for _ in 0..MOST_ITERATIONS {
        if trial.error() < SOLVED {
            return Some(trial);
        }
        let grids = Grids::new(step, trial.unknowns.edge());
        let by = equations.correction(&grids, &trial);
        let farthest = by.iter().fold(0.0, |far, d| if d.is_nan() { f64::INFINITY } else { f64::max(far, d.abs()) });
        if !farthest.is_finite() {
            return None;
        }
        let mut share = (LONGEST_MOVE / farthest).min(1.0);
        let mut next = equations.trial(step, trial.unknowns.moved(&by, share));
        while next.norm().is_nan() || next.norm() >= (1.0 - 0.1 * share) * trial.norm() && next.error() >= SOLVED {
            share *= 0.5;
            if share < 1e-3 {
                return None;
            }
            next = equations.trial(step, trial.unknowns.moved(&by, share));
        }
        trial = next;
    }
    None
}

#[cfg(test)]
mod tests;
