//! Contact of single particles with a body's surface (THEORY WA7).
//!
//! Pressure keeps water out of walls as long as it flows in layers. A single particle of a jet, or one at a sharp corner, meets
//! the outline itself: it is put back on the surface, and its approach is stopped by an inelastic impulse that acts on the body too.

use sph_core::contact::{self, Impulse};
use sph_core::{Fluid, Passage};

use crate::bodies::body::Body;
use crate::bodies::state::ContactImpulse;

/// Depth below its face at which a particle that crossed a plate is put before its contact is resolved [half thicknesses].
const BELOW_FACE: f64 = 0.5;

/// WA11: resolve the tunnelling of a particle through a plate of `body` of the given half thickness [m]: it returns to the face it met. Returns the
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
    fluid.place(particle, [at[0] + below * normal[0], at[1] + below * normal[1]]);
    resolve_contact(fluid, particle, body, dt)
}

/// WA7: resolve the contact of particle `k` if it is behind the surface of `body`. Returns the work of the impulse on the body [J/m].
pub(super) fn resolve_contact(fluid: &mut Fluid, k: usize, body: &mut dyn Body, dt: f64) -> f64 {
    let mirrored = fluid.domain().mirror.is_some();
    let p = fluid.particles();
    let at = [p.x[k], p.y[k]];
    if body.signed_distance(at) >= 0.0 {
        return 0.0;
    }
    let surface = body.surface(at);
    let (at, normal, velocity) = (surface.at, surface.normal, surface.velocity);
    let inverse_mass = || body.inverse_effective_mass(at, normal, dt);
    let Some(Impulse { impulse, size, inverse_mass }) =
        fluid.resolve_contact(k, &contact::Surface { at, normal, velocity }, inverse_mass)
    else {
        return 0.0;
    };
    let work = impulse[0] * velocity[0] + impulse[1] * velocity[1] + 0.5 * size * size * inverse_mass;
    body.apply_impulse(&ContactImpulse { at, impulse, mirrored });
    if mirrored { 2.0 * work } else { work }
}
