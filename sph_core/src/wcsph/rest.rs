//! Graded water that stays at rest (THEORY WC28).

use crate::system::ParticleSystem;

/// Neighbours are unequal from this ratio of their smoothing lengths on.
const UNEQUAL: f64 = 1.05;

/// Water that nothing holds, before its forces at rest are found.
pub(super) fn release(system: &mut ParticleSystem) {
    system.particles.rest.iter_mut().for_each(Vec::clear);
}

/// WC28: what accelerates still water beside unequal neighbours before time starts is taken off, then and later.
pub(super) fn hold_at_rest(system: &mut ParticleSystem) {
    let ParticleSystem { domain, particles: p, neighbours, .. } = system;
    let finest = p.h.iter().copied().fold(f64::INFINITY, f64::min);
    let is_coarse = |k: usize| p.h[k] > UNEQUAL * finest;
    let beside_coarse = |k: usize| neighbours.fluid.of(k).any(|j| is_coarse(neighbours.source(j, p.len())));
    let is_held = |k: usize| p.u[k] == 0.0 && p.v[k] == 0.0 && (is_coarse(k) || beside_coarse(k));
    if !domain.starts_level || domain.gravity == [0.0; 2] || !(0..p.len()).any(is_held) {
        return;
    }
    let held: Vec<bool> = (0..p.len()).map(is_held).collect();
    for (acceleration, rest) in [&mut p.ax, &mut p.ay].into_iter().zip(&mut p.rest) {
        *rest = acceleration.iter().zip(&held).map(|(a, held)| if *held { -a } else { 0.0 }).collect();
        acceleration.iter_mut().zip(&*rest).for_each(|(a, rest)| *a += rest);
    }
}
