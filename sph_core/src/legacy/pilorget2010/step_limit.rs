//! The step of the thesis's projection.

use crate::error::Breakdown;
use crate::parallel;
use crate::system::ParticleSystem;
use crate::walls::Walls;

use super::settings::FlowSettings;

/// Share of √(h/(|g| + |a|)) a step may take: with 0.1 water at rest begins to churn after 20 s, with 0.07 not (LE27).
const FORCE: f64 = 0.05;
/// Share of h²/ν a step may take (WC12).
const VISCOUS: f64 = 0.125;
/// ν of artificial viscosity over α h c₀ (WC6; Monaghan 2005).
const ARTIFICIAL: f64 = 0.125;
/// A step this many times smaller than that of water at rest means breakdown.
const COLLAPSE: f64 = 1e-3;
/// Where nothing moves and nothing weighs: this many acoustic steps.
const AT_LEISURE: f64 = 5.0;

/// LE27: Δt ≤ ½ C Δx/|v|, 1/20 √(h/(|g| + |a|)), ⅛ h²/(ν + ⅛ α h c₀) [s], for a speed of sound `c0` [m/s].
pub(crate) fn stable_dt(
    system: &ParticleSystem,
    walls: &Walls,
    flow: &FlowSettings,
    c0: f64,
) -> Result<f64, Breakdown> {
    let (p, domain) = (&system.particles, &system.domain);
    let (ratio, nu) = (domain.fluid.smoothing_ratio, domain.fluid.kinematic_viscosity);
    let g = domain.gravity[0].hypot(domain.gravity[1]);
    let limit = |h: f64, speed: f64, acceleration: f64| {
        let moving = 0.5 * flow.cfl * h / ratio / speed;
        moving
            .min(FORCE * (h / (g + acceleration)).sqrt())
            .min(VISCOUS * h * h / (nu + ARTIFICIAL * flow.artificial_viscosity * h * c0))
    };
    let of_fluid = |k: usize| limit(p.h[k], p.u[k].hypot(p.v[k]), p.ax[k].hypot(p.ay[k]));
    let of_wall = |k: usize| limit(walls.h[k], walls.u[k].hypot(walls.v[k]), walls.ax[k].hypot(walls.ay[k]));
    let dt = parallel::least(p.len(), of_fluid).min(parallel::least(walls.len(), of_wall));
    let leisure = AT_LEISURE * flow.cfl * system.least_smoothing_length() / c0;
    let dt = if g > 0.0 { dt } else { dt.min(leisure) };
    let at_rest = parallel::least(p.len(), |k| limit(p.h[k], 0.0, 0.0));
    if p.is_empty() || !at_rest.is_finite() || dt > COLLAPSE * at_rest {
        return Ok(dt);
    }
    let k = (0..p.len()).min_by(|&a, &b| of_fluid(a).total_cmp(&of_fluid(b))).unwrap_or(0);
    Err(system.collapsed(k, dt))
}
