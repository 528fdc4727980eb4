//! The step of the thesis's projection.

use crate::error::Breakdown;
use crate::fluid::Fluid;
use crate::parallel;
use crate::walls::Walls;

/// Share of √(h/(|g| + |a|)) a step may take: with 0.1 water at rest begins to churn after 20 s, with 0.07 not (J15).
const FORCE: f64 = 0.05;
/// Share of h²/ν a step may take (E17).
const VISCOUS: f64 = 0.125;
/// ν of artificial viscosity over α h c₀ (E7; Monaghan 2005).
const ARTIFICIAL: f64 = 0.125;
/// A step this many times smaller than that of water at rest means breakdown.
const COLLAPSE: f64 = 1e-3;
/// Where nothing moves and nothing weighs: this many acoustic steps.
const AT_LEISURE: f64 = 5.0;

impl Fluid {
    /// J15: Δt ≤ ½ C Δx/|v|, 1/20 √(h/(|g| + |a|)), ⅛ h²/(ν + ⅛ α h c₀) [s].
    pub(crate) fn thesis_dt(&self, walls: &Walls) -> Result<f64, Breakdown> {
        let (p, q) = (&self.particles, &self.parameters);
        let g = q.gravity[0].hypot(q.gravity[1]);
        let limit = |h: f64, speed: f64, acceleration: f64| {
            let moving = 0.5 * q.cfl * h / q.smoothing_ratio / speed;
            moving
                .min(FORCE * (h / (g + acceleration)).sqrt())
                .min(VISCOUS * h * h / (q.nu + ARTIFICIAL * q.alpha * h * q.eos.c0))
        };
        let of_fluid = |k: usize| limit(p.h[k], p.u[k].hypot(p.v[k]), p.ax[k].hypot(p.ay[k]));
        let of_wall = |k: usize| limit(walls.h[k], walls.u[k].hypot(walls.v[k]), walls.ax[k].hypot(walls.ay[k]));
        let dt = parallel::least(p.len(), of_fluid).min(parallel::least(walls.len(), of_wall));
        let leisure = AT_LEISURE * q.cfl * parallel::least(p.len(), |k| p.h[k]) / q.eos.c0;
        let dt = if g > 0.0 { dt } else { dt.min(leisure) };
        let at_rest = parallel::least(p.len(), |k| limit(p.h[k], 0.0, 0.0));
        if p.is_empty() || !at_rest.is_finite() || dt > COLLAPSE * at_rest {
            return Ok(dt);
        }
        let k = (0..p.len()).min_by(|&a, &b| of_fluid(a).total_cmp(&of_fluid(b))).unwrap_or(0);
        Err(self.collapsed(k, dt))
    }
}
