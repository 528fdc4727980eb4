//! Graded water that stays at rest (THEORY WC28).

use crate::parallel;
use crate::particles::{COARSE, Particles};
use crate::system::ParticleSystem;
use crate::walls::Walls;

/// Distance from its place at the start beyond which a particle is not held [h].
const DRIFT: f64 = 0.5;

/// Hold no particle, before the forces at rest are found.
pub(super) fn release_all(system: &mut ParticleSystem) {
    let Particles { rest, home, .. } = &mut system.particles;
    rest.iter_mut().chain(home).for_each(Vec::clear);
}

/// WC28: what accelerates still water in and beside coarse rows before time starts is taken off, then and later. Particles beside a body are
/// not held.
pub(super) fn hold_at_rest(system: &mut ParticleSystem, walls: &Walls) {
    let ParticleSystem { domain, particles: p, neighbours, .. } = system;
    let ends = |values: &[f64]| {
        values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [x.min(low), x.max(high)])
    };
    let [finest, coarsest] = ends(&p.h);
    if !domain.starts_level || domain.gravity == [0.0; 2] || coarsest <= COARSE * finest {
        return;
    }
    let ([left, right], [floor, _]) = (ends(&p.x), ends(&p.y));
    let of_body = |w: usize| (left..right).contains(&walls.x[w]) && walls.y[w] > floor; // the tank's are outside the water
    let beside_body = |k: usize| {
        let mut walls_near = neighbours.walls_of_fluid.of(k);
        walls_near.any(|w| of_body(neighbours.wall_source(w as usize, walls.len())))
    };
    let is_coarse = |k: usize| p.h[k] > COARSE * finest;
    let beside_coarse = |k: usize| neighbours.fluid.of(k).any(|j| is_coarse(neighbours.source(j, p.len())));
    let is_still = |k: usize| p.u[k] == 0.0 && p.v[k] == 0.0;
    let is_held = |k: usize| is_still(k) && (is_coarse(k) || beside_coarse(k)) && !beside_body(k);
    let held: Vec<bool> = (0..p.len()).map(is_held).collect();
    for (acceleration, rest) in [&mut p.ax, &mut p.ay].into_iter().zip(&mut p.rest) {
        *rest = acceleration.iter().zip(&held).map(|(a, held)| if *held { -a } else { 0.0 }).collect();
        acceleration.iter_mut().zip(&*rest).for_each(|(a, rest)| *a += rest);
    }
    p.home = [p.x.clone(), p.y.clone()];
}

/// WC28: particles that are far from where they started have other neighbours and are not held.
pub(super) fn release_drifted(p: &mut Particles) {
    if p.home[0].is_empty() {
        return;
    }
    let has_drifted = |k: &usize| {
        let away = [p.x[*k] - p.home[0][*k], p.y[*k] - p.home[1][*k]];
        p.rest(*k) != [0.0; 2] && away[0].hypot(away[1]) > DRIFT * p.h[*k]
    };
    for k in parallel::by_chunk(p.len(), |targets| targets.filter(has_drifted).collect::<Vec<usize>>()).concat() {
        p.release(k);
    }
}
