//! Pressure gauges: where they are now, and how the fluid is read there.

use fsi_coupling::pose::rotate;
use fsi_coupling::{Coupled, Motion};
use sph_core::probe::Probe;

use crate::scene::{GaugeFrame, Scene};

/// How a place on a surface is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// On a flat face with this outward normal (body frame), farther than a kernel's support from its ends.
    Face([f64; 2]),
    /// At a corner, or away from any face.
    Point,
}

struct Place {
    on: GaugeFrame,
    at: [f64; 2],
    reading: Reading,
}

/// Reads all gauges of a scene.
pub struct GaugeReader {
    places: Vec<Place>,
    rho: f64,
    gravity: [f64; 2],
}

impl GaugeReader {
    /// Decide for every gauge how it is read.
    pub fn new(scene: &Scene) -> GaugeReader {
        let support = 2.0 * scene.fluid.smoothing_ratio * scene.resolution.spacing;
        let half = 0.5 * scene.tank.width;
        let (floor, rim) = (-scene.tank.depth, scene.tank.height - scene.tank.depth);
        let tank = [[-half, floor], [half, floor], [half, rim], [-half, rim]];
        let place = |g: &crate::scene::Gauge| {
            let corners = match (g.on, &scene.body) {
                (GaugeFrame::Body, Some(body)) => body.shape.outline(),
                _ => tank.to_vec(),
            };
            let reading = reading(&corners, g.at, support, g.on == GaugeFrame::Fixed);
            Place { on: g.on, at: g.at, reading }
        };
        GaugeReader {
            places: scene.gauges.iter().map(place).collect(),
            rho: scene.fluid.density,
            gravity: scene.gravity,
        }
    }

    /// Pressures now [Pa].
    pub fn read(&self, system: &Coupled) -> Vec<f64> {
        if self.places.is_empty() {
            return Vec::new();
        }
        let probe = Probe::new(&system.fluid);
        let body = system.bodies().find_map(|b| b.motion()).unwrap_or_default();
        self.places.iter().map(|place| self.read_one(&probe, &body, place)).collect()
    }

    fn read_one(&self, probe: &Probe<'_>, body: &Motion, place: &Place) -> f64 {
        let on_body = place.on == GaugeFrame::Body;
        let (at, turn) = if on_body { (on(body, place.at), body.angle) } else { (place.at, 0.0) };
        match place.reading {
            Reading::Point => probe.shepard(at),
            Reading::Face(normal) => {
                let n = rotate(normal, turn);
                let acceleration = if on_body { body.acceleration } else { [0.0; 2] };
                let field = [0, 1].map(|k| self.gravity[k] - acceleration[k]);
                probe.on_flat_face(at, n, self.rho * (field[0] * n[0] + field[1] * n[1]))
            }
        }
    }
}

/// A point of the body's frame in space [m].
pub fn on(body: &Motion, at: [f64; 2]) -> [f64; 2] {
    let r = rotate(at, body.angle);
    [body.position[0] + r[0], body.position[1] + r[1]]
}

/// Face or point? Counter-clockwise corners; with `inside`, the fluid is inside them.
pub fn reading(corners: &[[f64; 2]], at: [f64; 2], support: f64, inside: bool) -> Reading {
    let n = corners.len();
    for k in 0..n {
        let (a, b) = (corners[k], corners[(k + 1) % n]);
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy);
        let (along, off) = (
            ((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / length,
            ((at[0] - a[0]) * dy - (at[1] - a[1]) * dx) / length,
        );
        if off.abs() < 0.1 * support && along > support && along < length - support {
            let sign = if inside { -1.0 } else { 1.0 };
            return Reading::Face([sign * dy / length, -sign * dx / length]);
        }
    }
    Reading::Point
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_is_told_from_its_corners() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(reading(&square, [0.5, 0.0], 0.1, false), Reading::Face([0.0, -1.0]));
        assert_eq!(reading(&square, [1.0, 0.5], 0.1, true), Reading::Face([-1.0, 0.0]));
        assert_eq!(reading(&square, [0.05, 0.0], 0.1, false), Reading::Point);
        assert_eq!(reading(&square, [0.5, 0.5], 0.1, false), Reading::Point);
    }
}
