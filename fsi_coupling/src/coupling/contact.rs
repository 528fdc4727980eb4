//! Contact of single particles with a body's surface (THEORY E25).
//!
//! Pressure keeps water out of walls as long as it flows in layers. A single particle of a jet, or one at a sharp corner, meets
//! the outline itself: it is put back on the surface, and its approach is stopped by an inelastic impulse that acts on the body too.

use sph_core::{Fluid, Passage};

use crate::bodies::body::Body;
use crate::bodies::state::ContactImpulse;

/// Height above the surface at which a particle is put back, in smoothing lengths: enough for rounding.
const ABOVE: f64 = 1e-6;

/// Depth below its face at which a particle that crossed a plate is put before its contact is resolved [half thicknesses].
const BELOW_FACE: f64 = 0.5;

/// T5: resolve the tunnelling of a particle through a plate of `body` of the given half thickness [m]: it returns to the face it met. Returns the
/// work of the impulse on the body [J/m].
pub(super) fn resolve_tunnelling(
    fluid: &mut Fluid,
    passage: &Passage,
    half_thickness: f64,
    body: &mut dyn Body,
    dt: f64,
) -> f64 {
    let below = BELOW_FACE * half_thickness;
    let Passage { particle, at, normal, .. } = *passage;
    fluid.put(particle, [at[0] + below * normal[0], at[1] + below * normal[1]]);
    resolve_contact(fluid, particle, body, dt)
}

/// E25: resolve the contact of particle `k` if it is behind the surface of `body`. Returns the work of the impulse on the body [J/m].
pub(super) fn resolve_contact(fluid: &mut Fluid, k: usize, body: &mut dyn Body, dt: f64) -> f64 {
    let mirror = fluid.parameters.mirror;
    let p = &mut fluid.particles;
    let at = [p.x[k], p.y[k]];
    if body.signed_distance(at) >= 0.0 {
        return 0.0;
    }
    let surface = body.surface(at);
    let n = surface.normal;
    let above = ABOVE * p.h[k];
    let x = surface.at[0] + above * n[0];
    p.x[k] = mirror.map_or(x, |m| x.max(m.at)); // at a keel the surface ends in the plane: along the face to it
    let slope = if n[1].abs() > n[0].abs() * ABOVE { n[0] / n[1] } else { 0.0 };
    p.y[k] = surface.at[1] + above * n[1] - (p.x[k] - x) * slope;
    let approach = (p.u[k] - surface.velocity[0]) * n[0] + (p.v[k] - surface.velocity[1]) * n[1];
    if approach >= 0.0 {
        return 0.0;
    }
    // both end with one normal velocity: the impulse is that of two masses
    let inverse_mass = body.inverse_effective_mass(surface.at, n, dt);
    let stopped = approach / (1.0 + p.mass[k] * inverse_mass);
    p.u[k] -= stopped * n[0];
    p.v[k] -= stopped * n[1];
    let impulse = [p.mass[k] * stopped * n[0], p.mass[k] * stopped * n[1]];
    let size = p.mass[k] * stopped;
    let work = impulse[0] * surface.velocity[0] + impulse[1] * surface.velocity[1] + 0.5 * size * size * inverse_mass;
    body.apply_impulse(&ContactImpulse { at: surface.at, impulse, mirrored: mirror.is_some() });
    if mirror.is_some() { 2.0 * work } else { work }
}
