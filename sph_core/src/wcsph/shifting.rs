//! Particle shifting (THEORY WC10).

use crate::parallel;
use crate::particles::{Fields, KernelMoments, Particles};
use crate::scheme::Flow;
use crate::system::ParticleSystem;
use crate::wcsph::Settings;

/// Longest shift in a step, in smoothing lengths.
const LONGEST_SHIFT: f64 = 0.02;
/// Before time starts, particles are shifted until no shift exceeds this [h].
const SETTLED: f64 = 1e-4;
/// Most shifts before time starts.
const MOST_SETTLING_SHIFTS: u32 = 60;

/// WC10: δr = −(2h Δt |v| + κ h²) ∇C, at most 0.02 h, outside the free surface; κ, `settling` [-], acts on particles that were newly
/// split (WC21). With `shifting_at_surface` particles that see the surface are shifted too.
pub(crate) fn even_out(system: &mut ParticleSystem, settings: &Settings, dt: f64) {
    let share = Share { settling: settings.settling, dt, all: false, at_surface: settings.shifting_at_surface };
    shift(system, |p, fields, k| share.of(p, fields, k));
}

/// Longest shift in an advective step, in smoothing lengths.
const LONGEST_ADVECTIVE_SHIFT: f64 = 0.16;

/// WC26: the shifts [m] of an advective step of `dt` [s] and as many acoustic `steps`, in equal stages of at most `gain` h² ∇C.
/// `concentration_gradient` finds ∇C [1/m] of the particles moved by the shifts so far.
pub(crate) fn shifts_in_stages(
    system: &mut ParticleSystem,
    settings: &Settings,
    (dt, steps): (f64, f64),
    gain: f64,
    concentration_gradient: impl Fn(&mut ParticleSystem, &[Vec<f64>; 2]) -> [Vec<f64>; 2],
) -> [Vec<f64>; 2] {
    let n = system.particles.len();
    let mut shifts = [vec![0.0; n], vec![0.0; n]];
    if !settings.shifting {
        return shifts;
    }
    let share = Share { settling: steps * settings.settling, dt, all: false, at_surface: settings.shifting_at_surface };
    let longest = (steps * LONGEST_SHIFT).min(LONGEST_ADVECTIVE_SHIFT);
    let stages = (share.settling / gain).ceil().max(1.0);
    let of_moments = |moments: &KernelMoments| <(f64, f64)>::from(moments.concentration_gradient());
    let mut gradient: [Vec<f64>; 2] =
        system.fields.moments.iter().map(of_moments).unzip::<_, _, Vec<_>, Vec<_>>().into();
    for stage in 1..=stages as usize {
        if stage > 1 {
            gradient = concentration_gradient(system, &shifts);
        }
        let ParticleSystem { particles: p, fields, .. } = &*system;
        let [x, y] = &mut shifts;
        parallel::each([x, y], |at, [x, y]| {
            for (i, k) in at.enumerate() {
                let share = (share.of(p, fields, k) / stages).min(gain * p.h[k]);
                let [dx, dy] = [&gradient[0], &gradient[1]].map(|c| -p.h[k] * share * c[k]);
                [x[i], y[i]] = within(longest * p.h[k], [x[i] + dx, y[i] + dy]);
            }
        });
    }
    shifts
}

/// By how much particles are shifted.
#[derive(Clone, Copy)]
struct Share {
    /// κ [-]
    settling: f64,
    /// [s]
    dt: f64,
    /// κ acts on all particles that have neither surface nor wall in their neighbourhood, else on those newly split.
    all: bool,
    /// Particles that see the surface are shifted too.
    at_surface: bool,
}

impl Share {
    /// 2 Δt |v| + κ h [m] of particle `k`; 0 where it stays.
    #[inline(always)]
    fn of(self, p: &Particles, fields: &Fields, k: usize) -> f64 {
        if fields.moments[k].at_surface() || (fields.near_surface[k] && !self.at_surface) {
            return 0.0;
        }
        let settles = match self.all {
            true => !fields.near_surface[k] && fields.moments[k].wall_kernel_sum == 0.0,
            false => !fields.near_surface[k] && p.newly_split.get(k) == Some(&true),
        };
        let settling = if settles { self.settling * p.h[k] } else { 0.0 };
        2.0 * self.dt * (p.u[k] * p.u[k] + p.v[k] * p.v[k]).sqrt() + settling
    }
}

/// A vector [m], shortened to `limit` [m] where it is longer.
#[inline(always)]
fn within(limit: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    let length = (x * x + y * y).sqrt();
    let shrink = if length > limit { limit / length } else { 1.0 };
    [shrink * x, shrink * y]
}

/// Shift particles by δr = −h `share` ∇C, at most `LONGEST_SHIFT` h.
fn shift(system: &mut ParticleSystem, share: impl Fn(&Particles, &Fields, usize) -> f64 + Sync) {
    let (p, fields) = (&mut system.particles, &system.fields);
    let [mut x, mut y] = [&mut p.x, &mut p.y].map(std::mem::take);
    let unmoved = &*p;
    parallel::each([&mut x, &mut y], |at, [x, y]| {
        for (i, k) in at.enumerate() {
            let (h, share) = (unmoved.h[k], share(unmoved, fields, k));
            let shift = fields.moments[k].concentration_gradient().map(|c| -h * share * c);
            let [dx, dy] = within(LONGEST_SHIFT * h, shift);
            x[i] += dx;
            y[i] += dy;
        }
    });
    (p.x, p.y) = (x, y);
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
/// size stay where they are. `evaluate_forces` computes the kernel moments again.
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
        let share = Share { settling, dt: 0.0, all: true, at_surface: true };
        shift(flow.system, |p, fields, k| share.of(p, fields, k));
        evaluate_forces(flow);
        flow.system.neighbours.flag_surface(&mut flow.system.fields);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Domain, Fluid, Kernel, Seed, Walls};

    const SPACING: f64 = 0.1;
    const H: f64 = 1.5 * SPACING;
    const SIDE: usize = 15;
    const MIDDLE: usize = SIDE * SIDE / 2;

    fn place(k: usize) -> [f64; 2] {
        let off = if k == MIDDLE { 0.2 * SPACING } else { 0.0 };
        [SPACING * (k % SIDE) as f64 + off, SPACING * (k / SIDE) as f64]
    }

    /// A square block whose middle particle lies a fifth of a spacing too far right, moving at `speed` [m/s].
    fn block(speed: f64, settings: &Settings) -> Fluid {
        let seed = |k| Seed { at: place(k), velocity: [0.0, speed], area: SPACING * SPACING, pressure: 0.0 };
        let mut fluid = Fluid::new(Domain::default(), settings, &(0..SIDE * SIDE).map(seed).collect::<Vec<_>>());
        fluid.initialise(&mut Walls::default()).expect("a block of water");
        fluid
    }

    /// How far each particle is from where it was seeded [m], by identity.
    fn shifts(fluid: &Fluid) -> Vec<[f64; 2]> {
        let (p, mut shifts) = (fluid.particles(), vec![[0.0; 2]; SIDE * SIDE]);
        for (k, &id) in p.id.iter().enumerate() {
            let [x, y] = place(id as usize);
            shifts[id as usize] = [p.x[k] - x, p.y[k] - y];
        }
        shifts
    }

    /// ∂C/∂x of the middle particle [1/m], by hand.
    fn gradient() -> f64 {
        let [x, y] = place(MIDDLE);
        let of = |k: usize| {
            let [dx, dy] = [x - place(k)[0], y - place(k)[1]];
            SPACING * SPACING * Kernel::WendlandC2.gradient_factor(dx.hypot(dy), H) * dx
        };
        (0..SIDE * SIDE).filter(|&k| k != MIDDLE).map(of).sum()
    }

    /// WC10: δx = −2h Δt |v| ∂C/∂x towards the gap, not beyond 0.02 h; particles of the free surface stay.
    #[test]
    fn a_moving_particle_is_shifted_out_of_the_crowd() {
        let settings = Settings { sound_speed: 50.0.into(), settling: 0.0, ..Settings::default() };
        let (speed, dt) = (2.0, 1e-3);
        let mut fluid = block(speed, &settings);
        even_out(fluid.system_mut(), &settings, dt);
        let (found, exact) = (shifts(&fluid), -2.0 * H * dt * speed * gradient());
        assert!(exact < -1e-5, "{exact} m");
        assert!((found[MIDDLE][0] / exact - 1.0).abs() < 1e-5, "{} m, exact {exact} m", found[MIDDLE][0]);
        assert!(found[MIDDLE][1].abs() < 1e-5 * exact.abs());
        assert_eq!(found[SIDE / 2], [0.0; 2], "a particle of the surface");
        even_out(fluid.system_mut(), &settings, 10.0);
        let farther = found[MIDDLE][0] - shifts(&fluid)[MIDDLE][0];
        assert!((farther / (LONGEST_SHIFT * H) - 1.0).abs() < 1e-12, "{farther} m in a long step");
    }

    /// Particles at rest stay, but for those newly split: δx = −κ h² ∂C/∂x, away from the surface.
    #[test]
    fn a_newly_split_particle_settles_at_rest() {
        let settings = Settings { sound_speed: 50.0.into(), settling: 0.1, ..Settings::default() };
        let mut fluid = block(0.0, &settings);
        even_out(fluid.system_mut(), &settings, 1e-3);
        assert!(shifts(&fluid).iter().all(|shift| *shift == [0.0; 2]));
        fluid.particles_mut().newly_split = vec![true; SIDE * SIDE];
        even_out(fluid.system_mut(), &settings, 1e-3);
        let (found, exact) = (shifts(&fluid), -0.1 * H * H * gradient());
        assert!((found[MIDDLE][0] / exact - 1.0).abs() < 1e-5, "{} m, exact {exact} m", found[MIDDLE][0]);
        assert_eq!(found[SIDE + SIDE / 2], [0.0; 2], "beside the surface");
    }
}
