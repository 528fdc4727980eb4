//! Contact of single fluid particles with a wall's surface (THEORY WA7): particles near a wall are found here, the wall's owner
//! tells its surface there, and the particle is put back on it.

use std::ops::Range;

use crate::parallel;
use crate::system::ParticleSystem;
use crate::walls::Walls;

/// A fluid particle is a contact candidate below this height over its nearest wall particle, along that one's normal, in
/// wall spacings; a wall's surface is half a spacing above its first row.
const CANDIDATE: f64 = 0.6;
/// Height above the surface at which a particle is put back, in smoothing lengths: enough for rounding.
const ABOVE: f64 = 1e-6;

/// A wall's surface near a particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// The nearest place of the surface [m].
    pub at: [f64; 2],
    /// Unit normal there, into the fluid [-].
    pub normal: [f64; 2],
    /// Velocity of the surface there [m/s].
    pub velocity: [f64; 2],
}

/// A contact impulse on a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impulse {
    /// Impulse per metre of span, of the fluid on the wall [N s/m].
    pub impulse: [f64; 2],
    /// Its component along the normal [N s/m].
    pub size: f64,
    /// Velocity along the normal that a unit impulse gives the wall [m/kg].
    pub inverse_mass: f64,
}

/// WA7: put particle `k`, which is beyond `surface`, back on it and stop its approach inelastically; the impulse that the wall
/// takes, or `None` where the particle does not approach. Both end with one normal velocity, so that no energy is created:
/// `inverse_mass` is the velocity along the normal that a unit impulse gives the wall [m/kg].
pub(crate) fn resolve(
    system: &mut ParticleSystem,
    k: usize,
    surface: &Surface,
    inverse_mass: impl FnOnce() -> f64,
) -> Option<Impulse> {
    let mirror = system.domain.mirror;
    let p = &mut system.particles;
    let n = surface.normal;
    let above = ABOVE * p.h[k];
    let x = surface.at[0] + above * n[0];
    p.x[k] = mirror.map_or(x, |m| x.max(m.at)); // at a keel the surface ends in the plane: along the face to it
    let slope = if n[1].abs() > n[0].abs() * ABOVE { n[0] / n[1] } else { 0.0 };
    p.y[k] = surface.at[1] + above * n[1] - (p.x[k] - x) * slope;
    let approach = (p.u[k] - surface.velocity[0]) * n[0] + (p.v[k] - surface.velocity[1]) * n[1];
    if approach >= 0.0 {
        return None;
    }
    let inverse_mass = inverse_mass();
    let stopped = approach / (1.0 + p.mass[k] * inverse_mass);
    p.u[k] -= stopped * n[0];
    p.v[k] -= stopped * n[1];
    let size = p.mass[k] * stopped;
    Some(Impulse { impulse: [size * n[0], size * n[1]], size, inverse_mass })
}

/// Fluid particles that may be beyond a wall's surface, in the order of the particles.
pub(crate) fn candidates(system: &ParticleSystem, walls: &Walls) -> Vec<usize> {
    let near = |k: &usize| height_over_nearest(system, *k, walls) < CANDIDATE;
    let of_chunk = |targets: Range<usize>| match system.neighbours.walls_of_fluid.any_of_chunk(targets.start) {
        true => targets.filter(near).collect::<Vec<usize>>(),
        false => Vec::new(),
    };
    parallel::by_chunk(system.particles.len(), of_chunk).concat()
}

/// Height over the nearest wall particle along its normal, in wall spacings; infinity far from walls.
fn height_over_nearest(system: &ParticleSystem, k: usize, walls: &Walls) -> f64 {
    let (x, y, n) = (system.particles.x[k], system.particles.y[k], walls.len());
    let (mut least, mut height) = (f64::INFINITY, f64::INFINITY);
    let reflect = |x: f64| system.domain.mirror.map_or(x, |mirror| mirror.reflect(x));
    for j in system.neighbours.walls_of_fluid.of(k) {
        let (source, side, [sx, sy]) = wall_source(system, j as usize, n);
        let wall_x = if side > 0.0 { walls.x[source] + sx } else { reflect(walls.x[source]) };
        let (dx, dy) = (x - wall_x, y - (walls.y[source] + sy));
        let r2 = dx * dx + dy * dy;
        if r2 < least {
            least = r2;
            height = (dx * side * walls.nx[source] + dy * walls.ny[source]) / walls.h[source];
        }
    }
    height * system.domain.fluid.smoothing_ratio
}

/// The wall particle behind a listed index, −1 for a reflection, and the translation of a repeated one [m].
fn wall_source(system: &ParticleSystem, j: usize, walls: usize) -> (usize, f64, [f64; 2]) {
    if j < walls {
        return (j, 1.0, [0.0; 2]);
    }
    let lists = &system.neighbours;
    let source = lists.wall_images[j - walls] as usize;
    lists.wall_shifts.get(j - walls).map_or((source, -1.0, [0.0; 2]), |&shift| (source, 1.0, shift))
}
