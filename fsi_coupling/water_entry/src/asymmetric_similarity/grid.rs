//! Points on free surfaces and faces, and what the fall of a surface's direction adds to ln|dζ/du| there (THEORY EN31).

use faer::Mat;

use crate::dobrovolskaya::{points, softplus, surface_kernel};

/// Range of y on a free surface, u = ±(1 + e^y): m falls like e^(y/2) to the left and e^(−3y) to the right.
const SURFACE: [f64; 2] = [-48.0, 12.0];
/// Least t on a face: the distance from the tip is d/(1 + e^(−t)).
const FROM_TIP: f64 = 60.0;
/// The force on the last part of a face falls like e^(−t (1 − B)): this many times e.
const FALLEN: f64 = 25.0;
/// Distance of both tips in u.
pub(super) const TIPS: f64 = 2.0;

/// The points on a free surface, alike on both sides.
pub(super) struct Grid {
    pub step: f64,
    pub y: Vec<f64>,
    /// e^y: distance from the own tip in u.
    pub away: Vec<f64>,
    /// h ln|1 − e^(y_j − y_i)|: of the own side's fall.
    pub own: Mat<f64>,
    /// h ln(1 + e^(y_j)/(2 + e^(y_i))): of the other side's.
    pub other: Mat<f64>,
}

impl Grid {
    pub fn new(step: f64) -> Grid {
        let y = points(SURFACE, step);
        let away: Vec<f64> = y.iter().map(|y| y.exp()).collect();
        let n = y.len();
        let other = Mat::from_fn(n, n, |i, j| step * (away[j] / (TIPS + away[i])).ln_1p());
        Grid { step, own: surface_kernel(n, step), other, y, away }
    }
}

/// The points on a face from tip to keel, which are `keel` apart in u.
pub(super) struct FaceGrid {
    /// Distance from tip to keel d.
    pub keel: f64,
    /// Logarithms of the distances q from the tip and d − q from the keel.
    pub logs: Vec<[f64; 2]>,
    /// h ln(1 + e^(y_j)/q_i).
    pub own: Mat<f64>,
    /// h ln(1 + e^(y_j)/(2 − q_i)).
    pub other: Mat<f64>,
}

impl FaceGrid {
    /// Of the keel at the distance `keel` and the turn πB of the face at the keel.
    pub fn new(grid: &Grid, keel: f64, turn: f64) -> FaceGrid {
        let log_keel = keel.ln();
        let logs: Vec<[f64; 2]> = points([-FROM_TIP, FALLEN / (1.0 - turn)], grid.step)
            .into_iter()
            .map(|t| [log_keel - softplus(-t), log_keel - softplus(t)])
            .collect();
        let (n, h) = (grid.y.len(), grid.step);
        let own = Mat::from_fn(logs.len(), n, |i, j| h * softplus(grid.y[j] - logs[i][0]));
        let other = Mat::from_fn(logs.len(), n, |i, j| h * (grid.away[j] / (TIPS - logs[i][0].exp())).ln_1p());
        FaceGrid { keel, logs, own, other }
    }
}
