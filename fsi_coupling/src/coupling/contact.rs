//! Contact of single particles with a body's true surface (THEORY E25).
//!
//! Pressure keeps water out of walls as long as it flows in layers; a lone particle of a jet, or one that a sharp
//! corner cuts through, meets the outline itself: it is put back on the surface and its approach is stopped, an
//! inelastic blow that the body feels as the same impulse.

use sph_core::{Fluid, Passage};

use crate::bodies::body::WettedBody;

/// How far above the surface a particle is put back, in smoothing lengths: enough for rounding.
const ABOVE: f64 = 1e-6;

/// How deep below its face a particle that went through a plate is put before it is thrown back, of half the thickness.
const BELOW_FACE: f64 = 0.5;

/// T5: take a particle that went through a screen of `body`, of the given half thickness [m], back to the face it met; the work
/// of the blow on the body [J/m].
pub(crate) fn take_back(
    fluid: &mut Fluid,
    passage: &Passage,
    half_thickness: f64,
    body: &mut dyn WettedBody,
    dt: f64,
) -> f64 {
    let below = BELOW_FACE * half_thickness;
    let Passage { particle, at, normal, .. } = *passage;
    fluid.put(particle, [at[0] + below * normal[0], at[1] + below * normal[1]]);
    throw_back(fluid, particle, body, dt)
}

/// Throw particle `k` back if it is beyond the surface of `body`; the work of the blow on the body [J/m].
pub(crate) fn throw_back(fluid: &mut Fluid, k: usize, body: &mut dyn WettedBody, dt: f64) -> f64 {
    let mirror = fluid.parameters.mirror;
    let p = &mut fluid.particles;
    let at = [p.x[k], p.y[k]];
    if body.clearance(at) >= 0.0 {
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
    // what yields to the blow takes part of the approach: both end with one velocity, and no energy comes of it
    let yields = body.mobility(surface.at, n, dt);
    let stopped = approach / (1.0 + p.mass[k] * yields);
    p.u[k] -= stopped * n[0];
    p.v[k] -= stopped * n[1];
    let blow = [p.mass[k] * stopped * n[0], p.mass[k] * stopped * n[1]];
    let size = p.mass[k] * stopped;
    let work = blow[0] * surface.velocity[0] + blow[1] * surface.velocity[1] + 0.5 * size * size * yields;
    if mirror.is_some() {
        body.strike_both(surface.at, blow);
        return 2.0 * work;
    }
    body.strike(surface.at, blow);
    work
}
