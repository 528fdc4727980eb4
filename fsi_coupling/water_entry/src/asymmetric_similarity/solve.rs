//! Newton's method from the symmetric flow to one with two deadrises, or with a speed sideways.

use std::f64::consts::PI;

use super::grid::Grid;
use super::system::{System, Trial, Unknowns};
use crate::dobrovolskaya::{Dobrovolskaya, softplus};

/// Largest residual of a solution.
const SOLVED: f64 = 1e-9;
/// Most iterations of Newton's method.
const MOST_ITERATIONS: usize = 12;
/// Longest move of an unknown in one of them.
const LONGEST_MOVE: f64 = 1.0;
/// Steps of half the difference of the deadrises [rad] or of U/V, the larger of both: the first and the least.
const STEPS: [f64; 2] = [5.0 * PI / 180.0, 0.25 * PI / 180.0];
/// Step of the symmetric solution that is the start.
const START_STEP: f64 = 0.5;

/// Where it ended: the solution, or the share of the way from the symmetric flow that was solved.
pub(super) type Solved = Result<Trial, f64>;

/// For the mean of the deadrises and half their difference, right less left [rad], and the ratio U/V.
pub(super) fn solve(grid: &Grid, mean: f64, half: f64, ratio: f64) -> Solved {
    let whole = half.abs().max(ratio.abs());
    let system = |reached: f64| {
        let [half, ratio] = [half, ratio].map(|of| if whole > 0.0 { of / whole * reached } else { 0.0 });
        System { grid, beta: [mean + half, mean - half], ratio }
    };
    let symmetric = start(&system(0.0)).and_then(|start| newton(&system(0.0), start)).ok_or(0.0)?;
    let [mut step, least] = STEPS;
    let (mut reached, mut now, mut before) = (0.0, symmetric, None::<(f64, Unknowns)>);
    while reached < whole {
        let next = reached + (whole - reached).min(step);
        let guess = match &before {
            Some((at, earlier)) => {
                let share = (next - reached) / (reached - at);
                now.unknowns.moved(&now.unknowns.less(earlier), share)
            }
            None => now.unknowns.clone(),
        };
        match newton(&system(next), guess) {
            Some(solved) => {
                before = Some((reached, now.unknowns));
                (now, reached) = (solved, next);
            }
            None if step > least => step *= 0.5,
            None => return Err(reached / whole),
        }
    }
    Ok(now)
}

/// Newton's method with steps that the norm of the residual limits.
fn newton(system: &System<'_>, from: Unknowns) -> Option<Trial> {
    let mut trial = system.trial(from);
    for _ in 0..MOST_ITERATIONS {
        if trial.error() < SOLVED {
            return Some(trial);
        }
        let by = system.correction(&trial);
        let farthest = by.iter().fold(0.0, |far, d| if d.is_nan() { f64::INFINITY } else { f64::max(far, d.abs()) });
        if !farthest.is_finite() {
            return None;
        }
        let mut share = (LONGEST_MOVE / farthest).min(1.0);
        let mut next = system.trial(trial.unknowns.moved(&by, share));
        let falls =
            |next: &Trial, share: f64| next.norm() < (1.0 - 0.1 * share) * trial.norm() || next.error() < SOLVED;
        while !falls(&next, share) {
            share *= 0.5;
            if share < 1e-2 {
                return None;
            }
            next = system.trial(trial.unknowns.moved(&by, share));
        }
        trial = next;
    }
    None
}

/// The symmetric solution (EN6) on the points of this one: U = 1 − u², e^Y = e^y (2 + e^y).
fn start(system: &System<'_>) -> Option<Unknowns> {
    let exact = Dobrovolskaya::solve(system.beta[0], START_STEP)?;
    let first = exact.y[0];
    let last = exact.y.len() - 1;
    let log_fall = |(y, away): (&f64, &f64)| {
        let place = (y + (2.0 + away).ln() - first) / exact.step;
        let k = (place.floor() as usize).min(last - 1);
        let [a, b] = [exact.fall[k].ln(), exact.fall[k + 1].ln()];
        a + (place - k as f64) * (b - a) + softplus(y - (2.0 + away).ln())
    };
    let log_fall: Vec<f64> = system.grid.y.iter().zip(&system.grid.away).map(log_fall).collect();
    let log_contact = [exact.contact.ln(); 2];
    let unknowns =
        Unknowns { log_fall: [log_fall.clone(), log_fall], log_contact, log_strength: 0.0, keel: 0.0, zero: 0.0 };
    let off = system.trial(unknowns.clone()).residual;
    Some(Unknowns {
        log_strength: off[..system.grid.y.len()].iter().sum::<f64>() / system.grid.y.len() as f64,
        ..unknowns
    })
}
