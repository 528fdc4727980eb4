//! Pressure gauges: their positions, and the reading of the fluid there (THEORY GE2, GE3, GE4).

use std::collections::BTreeMap;

use fsi_coupling::geometry::vector::rotate;
use fsi_coupling::{Coupled, Motion};
use sph_core::particles::probe::Probe;

use super::gauge_record::{GaugeRecord, GaugeResult};
use super::low_pass::LowPass;
use super::sensing::sensing;
use super::source::Source;
use crate::scene::{GaugeFrame, Scene, Symmetry};

pub(super) const SOURCE: Source = Source { names, reader: |_| Box::new(|frame| frame.gauges.to_vec()) };

/// A column of pressure for each gauge.
fn names(scene: &Scene) -> Vec<String> {
    scene.gauges.iter().map(|g| format!("{}.p_Pa", g.name)).collect()
}

/// How a place on a surface is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// On a flat face with this outward normal (body frame), farther than a kernel's support from its ends.
    Face([f64; 2]),
    /// At a corner, or away from any face.
    Point,
}

/// A point of a gauge's face.
struct Place {
    at: [f64; 2],
    reading: Reading,
    weight: f64,
}

/// A gauge: its face, its filter, its readings.
struct Instrument {
    name: String,
    on: GaugeFrame,
    places: Vec<Place>,
    length: f64,
    bandwidth: Option<f64>,
    filter: Option<LowPass>,
    record: GaugeRecord,
}

/// Reads all gauges of a scene.
pub struct GaugeReader {
    instruments: Vec<Instrument>,
    rho: f64,
    gravity: [f64; 2],
}

impl GaugeReader {
    /// The gauges of a scene.
    pub fn new(scene: &Scene) -> GaugeReader {
        let support = 2.0 * scene.water().smoothing_ratio * scene.resolution.spacing;
        let half = 0.5 * scene.tank.width;
        let (floor, rim) = (-scene.tank.depth, scene.tank.height - scene.tank.depth);
        let tank = [[-half, floor], [half, floor], [half, rim], [-half, rim]];
        // Only x ≥ 0 is simulated: what lies beyond the plane of symmetry is read at its image.
        let simulated = |at: [f64; 2]| if scene.symmetry == Symmetry::X { [at[0].abs(), at[1]] } else { at };
        let instrument = |g: &crate::scene::Gauge| {
            let corners = match (g.on, &scene.body) {
                (GaugeFrame::Body, Some(body)) => body.shape.outline(),
                _ => tank.to_vec(),
            };
            let face = sensing(&corners, g.at, g.length, support);
            let place = |(at, weight): ([f64; 2], f64)| {
                let at = simulated(at);
                Place { at, reading: reading(&corners, at, support, g.on == GaugeFrame::Fixed), weight }
            };
            Instrument {
                name: g.name.clone(),
                on: g.on,
                places: face.points.into_iter().map(place).collect(),
                length: face.length,
                bandwidth: g.bandwidth,
                filter: g.bandwidth.map(LowPass::new),
                record: GaugeRecord::default(),
            }
        };
        GaugeReader {
            instruments: scene.gauges.iter().map(instrument).collect(),
            rho: scene.water().density,
            gravity: scene.gravity,
        }
    }

    /// Update the gauges with a bandwidth. Their filters need every step, so that samples do not alias.
    pub fn follow(&mut self, system: &Coupled) {
        self.update(system, |instrument| instrument.filter.is_some());
    }

    /// Pressures now [Pa].
    pub fn read(&mut self, system: &Coupled) -> Vec<f64> {
        self.update(system, |instrument| instrument.filter.is_none());
        self.instruments.iter().map(|i| i.record.latest()).collect()
    }

    /// The results of each gauge so far, by name.
    pub fn results(&self) -> BTreeMap<String, GaugeResult> {
        let one = |i: &Instrument| Some((i.name.clone(), i.record.result(i.length, i.bandwidth)?));
        self.instruments.iter().filter_map(one).collect()
    }

    fn update(&mut self, system: &Coupled, which: impl Fn(&Instrument) -> bool) {
        if !self.instruments.iter().any(&which) {
            return;
        }
        let time = system.fluid.time();
        let probe = Probe::new(&system.fluid);
        let body = system.bodies().find(|b| b.motion().is_some());
        let motion = body.and_then(|b| b.motion()).unwrap_or_default();
        let (rho, gravity) = (self.rho, self.gravity);
        for instrument in self.instruments.iter_mut().filter(|i| which(i)) {
            let still = Motion::default();
            let frame = if instrument.on == GaugeFrame::Body { &motion } else { &still };
            let riding = body.filter(|_| instrument.on == GaugeFrame::Body);
            let read = |place: &Place| {
                let spot = riding.and_then(|b| b.material_point(place.at)).map_or_else(
                    || Spot::rigid(frame, place),
                    |(surface, acceleration)| Spot { at: surface.at, normal: surface.normal, acceleration },
                );
                place.weight * read_one(&probe, &spot, place.reading, rho, gravity)
            };
            let raw = instrument.places.iter().map(read).sum();
            let shown = match &mut instrument.filter {
                None => raw,
                Some(filter) => {
                    filter.take(time, raw);
                    filter.value()
                }
            };
            instrument.record.take(time, shown);
        }
    }
}

/// A place of a surface now.
struct Spot {
    at: [f64; 2],
    normal: [f64; 2],
    acceleration: [f64; 2],
}

impl Spot {
    /// Of a frame that moves as `frame` does.
    fn rigid(frame: &Motion, place: &Place) -> Spot {
        let normal = match place.reading {
            Reading::Point => [0.0; 2],
            Reading::Face(normal) => rotate(normal, frame.angle),
        };
        Spot { at: on(frame, place.at), normal, acceleration: frame.acceleration }
    }
}

/// Pressure at a place [Pa].
fn read_one(probe: &Probe<'_>, spot: &Spot, reading: Reading, rho: f64, gravity: [f64; 2]) -> f64 {
    match reading {
        Reading::Point => probe.shepard(spot.at),
        Reading::Face(_) => {
            let (n, field) = (spot.normal, [0, 1].map(|k| gravity[k] - spot.acceleration[k]));
            probe.on_flat_face(spot.at, n, rho * (field[0] * n[0] + field[1] * n[1]))
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
