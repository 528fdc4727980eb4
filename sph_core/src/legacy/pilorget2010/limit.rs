//! Limit particles and dummies: the parts that the walls' particles play (THEORY LE21).

use crate::system::ParticleSystem;
use crate::walls::Walls;

/// A wall's first row lies less deep than this many spacings, the corner's own particle (½√2) with it.
const FIRST_ROW: f64 = 0.9;
/// A wall stands upright where its normal rises by less than this.
const UPRIGHT: f64 = 0.5;
/// Water belongs to an upright wall up to this many spacings beyond the limit particles' first neighbours.
const BESIDE: f64 = 1.0;

/// What the walls' particles are.
#[derive(Clone, Debug, Default)]
pub(crate) struct Limits {
    /// The wall particle behind each limit particle.
    pub walls: Vec<u32>,
    /// For each wall particle its own or, for a dummy, the nearest limit particle; none for one that plays no part.
    pub of_wall: Vec<Option<u32>>,
    /// True for a particle of an upright wall at rest, which takes the predictor's motion (LE21).
    pub side: Vec<bool>,
}

impl Limits {
    /// LE21: sort the wall particles as they stand at the start.
    pub fn sort(system: &ParticleSystem, walls: &Walls) -> Limits {
        let up = system.domain.up();
        let spacing = |k: usize| walls.h[k] / system.domain.fluid.smoothing_ratio;
        let height = |x: f64, y: f64| x * up[0] + y * up[1];
        let at_rest =
            |k: usize| [walls.u[k], walls.v[k], walls.ax[k], walls.ay[k]].iter().all(|component| *component == 0.0);
        let p = &system.particles;
        let floor = (0..p.len()).map(|k| height(p.x[k], p.y[k]) - 0.75 * p.h[k] / system.domain.fluid.smoothing_ratio);
        let floor = floor.fold(f64::INFINITY, f64::min);
        let side: Vec<bool> = (0..walls.len())
            .map(|k| {
                let upright = height(walls.nx[k], walls.ny[k]).abs() < UPRIGHT;
                upright && at_rest(k) && height(walls.x[k], walls.y[k]) > floor
            })
            .collect();
        // wall height is water height: what stands above the water beside it plays no part
        let above = |k: usize| {
            let reach = walls.depth[k] + BESIDE * spacing(k);
            let beside = (0..p.len()).filter(|&j| {
                let out = (p.x[j] - walls.x[k]) * walls.nx[k] + (p.y[j] - walls.y[k]) * walls.ny[k];
                out > 0.0 && out < reach
            });
            let level = beside.map(|j| height(p.x[j], p.y[j])).fold(f64::NEG_INFINITY, f64::max);
            level.is_finite() && height(walls.x[k], walls.y[k]) > level + 0.5 * spacing(k)
        };
        let plays: Vec<bool> = (0..walls.len()).map(|k| !(side[k] && above(k))).collect();
        let is_limit = |k: &usize| plays[*k] && walls.depth[*k] < FIRST_ROW * spacing(*k);
        let limits: Vec<u32> = (0..walls.len()).filter(is_limit).map(|k| k as u32).collect();
        let nearest = |k: usize| {
            let away = |l: u32| {
                let w = limits[l as usize] as usize;
                (walls.x[w] - walls.x[k]).powi(2) + (walls.y[w] - walls.y[k]).powi(2)
            };
            (0..limits.len() as u32).min_by(|&a, &b| away(a).total_cmp(&away(b)))
        };
        let of_wall = (0..walls.len()).map(|k| if plays[k] { nearest(k) } else { None }).collect();
        Limits { walls: limits, of_wall, side }
    }
}
