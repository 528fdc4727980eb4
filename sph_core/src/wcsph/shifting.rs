//! Particle shifting (THEORY WC10).

use crate::parallel;
use crate::scheme::Flow;
use crate::system::ParticleSystem;
use crate::wcsph::Settings;

/// Longest shift in a step, in smoothing lengths.
const LONGEST_SHIFT: f64 = 0.02;
/// Largest share of h² ∇C that particles are shifted at once in an advective step [-] (WC22): more overshoots.
const LARGEST_GAIN: f64 = 0.3;
/// Before time starts, particles are shifted until no shift exceeds this [h].
const SETTLED: f64 = 1e-4;
/// Most shifts before time starts.
const MOST_SETTLING_SHIFTS: u32 = 60;

/// WC10: δr = −(2h Δt |v| + κ h²) ∇C, at most 0.02 h, outside the free surface; κ, `settling` [-], acts on particles that were newly
/// split (WC21). `at_surface`: particles that see the surface are shifted too.
pub(crate) fn even_out(system: &mut ParticleSystem, settings: &Settings, dt: f64) {
    shift(system, settings.settling, dt, settings.shifting_at_surface, false, 1.0);
}

/// WC22: the same for an advective step of `dt` [s], `steps` times as long as its acoustic steps.
pub(crate) fn even_out_once(system: &mut ParticleSystem, settings: &Settings, dt: f64, steps: f64) {
    let settling = (settings.settling * steps).min(LARGEST_GAIN);
    shift(system, settling, dt, settings.shifting_at_surface, false, steps);
}

/// `longest`: longest shift over that of a step, which a share of h² bounds too. `all`: κ acts on all particles that have neither surface nor wall in their neighbourhood.
fn shift(system: &mut ParticleSystem, settling: f64, dt: f64, at_surface: bool, all: bool, longest: f64) {
    let (p, fields) = (&mut system.particles, &system.fields);
    let newly_split = &p.newly_split;
    parallel::each([&mut p.x, &mut p.y], |at, [x, y]| {
        let (u, v, h) = (&p.u[at.clone()], &p.v[at.clone()], &p.h[at.clone()]);
        let (moments, near_surface) = (&fields.moments[at.clone()], &fields.near_surface[at.clone()]);
        let settles = |k: usize| match all {
            true => !near_surface[k] && moments[k].wall_kernel_sum == 0.0,
            false => !near_surface[k] && newly_split.get(at.start + k) == Some(&true),
        };
        for k in 0..u.len() {
            let settling = if settles(k) { settling * h[k] } else { 0.0 };
            let along = 2.0 * dt * (u[k] * u[k] + v[k] * v[k]).sqrt();
            let gain = if longest > 1.0 && along > LARGEST_GAIN * h[k] { LARGEST_GAIN * h[k] } else { along };
            let scale = -h[k] * (gain + settling);
            let [dx, dy] = moments[k].concentration_gradient().map(|c| scale * c);
            let (length, limit) = ((dx * dx + dy * dy).sqrt(), longest * LONGEST_SHIFT * h[k]);
            let shrink = if length > limit { limit / length } else { 1.0 };
            let stays = moments[k].at_surface() || (near_surface[k] && !at_surface);
            let share = if stays { 0.0 } else { shrink };
            x[k] += share * dx;
            y[k] += share * dy;
        }
    });
}

/// The forces at the start, after shifts with the coefficient `settling` [-], if there is one: they are the mean forces too.
pub(crate) fn settle(flow: &mut Flow<'_>, settling: Option<f64>, mut evaluate_forces: impl FnMut(&mut Flow<'_>)) {
    evaluate_forces(flow);
    flow.system.neighbours.flag_surface(&mut flow.system.fields);
    if let Some(settling) = settling {
        shift_before_start(flow, settling, evaluate_forces);
    }
    flow.walls.set_mean_force();
}

/// WC10 before time starts: shift until the largest shift is 10⁻⁴ h, so that Σ V ∇W vanishes where rows grow. Particles of one
/// size stay where they are. `evaluate_forces` finds the kernel moments anew.
fn shift_before_start(flow: &mut Flow<'_>, settling: f64, mut evaluate_forces: impl FnMut(&mut Flow<'_>)) {
    let h = &flow.system.particles.h;
    if h.iter().all(|&one| (one / h[0] - 1.0).abs() < 1e-9) {
        return;
    }
    for _ in 0..MOST_SETTLING_SHIFTS {
        let (p, fields) = (&flow.system.particles, &flow.system.fields);
        let length = |k: usize| match fields.near_surface[k] || fields.moments[k].wall_kernel_sum > 0.0 {
            true => 0.0,
            false => {
                let [x, y] = fields.moments[k].concentration_gradient();
                settling * p.h[k] * x.hypot(y)
            }
        };
        if -parallel::least(p.len(), |k| -length(k)) < SETTLED {
            return;
        }
        shift(flow.system, settling, 0.0, true, true, 1.0);
        evaluate_forces(flow);
        flow.system.neighbours.flag_surface(&mut flow.system.fields);
    }
}
