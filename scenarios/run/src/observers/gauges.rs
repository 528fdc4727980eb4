//! Pressure gauges: their positions, and the reading of the fluid there (THEORY GE2, GE3, GE4).

use std::collections::BTreeMap;

use fsi_coupling::geometry::vector::rotate;
use fsi_coupling::{Coupled, Motion};
use scene::{GaugeFrame, Scene, Symmetry};
use sph_core::Probe;
use sph_core::state_bytes::{StateError, decode, encode, expect_count};

use super::gauge_record::{GaugeRecord, GaugeResult};
use super::low_pass::LowPass;
use super::sensing::sensing;
use super::source::Source;

pub(super) const SOURCE: Source = Source { names, reader: |_| Box::new(|frame| frame.gauges.to_vec()) };

/// A column of pressure for each gauge.
fn names(scene: &Scene) -> Vec<String> {
    scene.gauges.iter().map(|g| format!("{}.p_Pa", g.name)).collect()
}

/// A point of a gauge's face.
struct Place {
    at: [f64; 2],
    /// Outward normal of the face, as [`face_normal`] gives it.
    normal: Option<[f64; 2]>,
    weight: f64,
}

/// Where it is in the tank, with its unit normal out of the body or into the water and its acceleration [m/s²].
struct PlaceNow {
    at: [f64; 2],
    normal: [f64; 2],
    acceleration: [f64; 2],
}

/// A gauge: its face, its filter, its readings.
struct Instrument {
    name: String,
    on: GaugeFrame,
    places: Vec<Place>,
    length: f64,
    bandwidth: Option<f64>,
    filter: Option<LowPass>,
    /// Time [s] and pressure [Pa] of the last step.
    now: [f64; 2],
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
        let instrument = |g: &scene::Gauge| {
            let corners = match (g.on, &scene.body) {
                (GaugeFrame::Body, Some(body)) => body.shape.outline(),
                _ => tank.to_vec(),
            };
            let face = sensing(&corners, g.at, g.length, support);
            let place = |(at, weight): ([f64; 2], f64)| {
                let at = simulated(at);
                Place { at, normal: face_normal(&corners, at, support, g.on == GaugeFrame::Fixed), weight }
            };
            Instrument {
                name: g.name.clone(),
                on: g.on,
                places: face.points.into_iter().map(place).collect(),
                length: face.length,
                bandwidth: g.bandwidth,
                filter: g.bandwidth.map(LowPass::new),
                now: [f64::NEG_INFINITY, 0.0],
                record: GaugeRecord::default(),
            }
        };
        GaugeReader {
            instruments: scene.gauges.iter().map(instrument).collect(),
            rho: scene.water().density,
            gravity: scene.gravity,
        }
    }

    /// Read the pressures after a step [Pa], and feed the filters and the records: samples would miss peaks.
    pub fn follow(&mut self, system: &Coupled) -> Vec<f64> {
        let time = system.fluid.time();
        self.update(system);
        for Instrument { filter, now, record, .. } in &mut self.instruments {
            let pressure = filter.as_mut().map_or(now[1], |filter| {
                filter.take(time, now[1]);
                filter.value()
            });
            record.take(time, pressure);
        }
        self.instruments.iter().map(|i| i.now[1]).collect()
    }

    /// Pressures for a sample [Pa]: of filters where a gauge has a bandwidth. Before: `follow`.
    pub fn read(&self) -> Vec<f64> {
        self.instruments.iter().map(|i| i.record.latest()).collect()
    }

    /// Readings and filters, as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        encode(&self.instruments.iter().map(|i| (&i.filter, i.now, &i.record)).collect::<Vec<_>>())
    }

    /// Take readings and filters of as many gauges.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        let stored: Vec<(Option<LowPass>, [f64; 2], GaugeRecord)> = decode("the gauges", bytes)?;
        expect_count("gauges", stored.len(), self.instruments.len())?;
        for (instrument, (filter, now, record)) in self.instruments.iter_mut().zip(stored) {
            (instrument.filter, instrument.now, instrument.record) = (filter, now, record);
        }
        Ok(())
    }

    /// The results of each gauge so far, by name.
    pub fn results(&self) -> BTreeMap<String, GaugeResult> {
        let one = |i: &Instrument| Some((i.name.clone(), i.record.result(i.length, i.bandwidth)?));
        self.instruments.iter().filter_map(one).collect()
    }

    fn update(&mut self, system: &Coupled) {
        let time = system.fluid.time();
        if self.instruments.iter().all(|instrument| instrument.now[0] == time) {
            return;
        }
        let body = system.bodies().find(|b| b.motion().is_some());
        let (moving, still) = (body.and_then(|b| b.motion()).unwrap_or_default(), Motion::default());
        let places: Vec<PlaceNow> = self
            .instruments
            .iter()
            .flat_map(|Instrument { on, places, .. }| {
                let (frame, riding) = match on {
                    GaugeFrame::Body => (&moving, body),
                    GaugeFrame::Fixed => (&still, None),
                };
                places.iter().map(move |place| match riding.and_then(|b| b.material_point(place.at)) {
                    Some((surface, acceleration)) => PlaceNow { at: surface.at, normal: surface.normal, acceleration },
                    None => {
                        let normal = rotate(place.normal.unwrap_or_default(), frame.angle);
                        PlaceNow { at: frame.point(place.at), normal, acceleration: frame.acceleration }
                    }
                })
            })
            .collect();
        let probe = Probe::near(&system.fluid, &places.iter().map(|now| now.at).collect::<Vec<_>>());
        let (rho, gravity, mut places) = (self.rho, self.gravity, places.into_iter());
        for instrument in &mut self.instruments {
            let read = |(place, PlaceNow { at, normal, acceleration }): (&Place, PlaceNow)| {
                let pressure = match place.normal {
                    None => probe.shepard(at),
                    Some(_) => {
                        let field = [0, 1].map(|k| gravity[k] - acceleration[k]);
                        probe.on_flat_face(at, normal, rho * (field[0] * normal[0] + field[1] * normal[1]))
                    }
                };
                place.weight * pressure
            };
            instrument.now = [time, instrument.places.iter().zip(places.by_ref()).map(read).sum()];
        }
    }
}

/// Outward normal, in the frame of the corners, of the flat face that a place lies on, farther than a kernel's support from its
/// ends; `None` at a corner or away from any face. Counter-clockwise corners; with `inside`, the fluid is inside them.
fn face_normal(corners: &[[f64; 2]], at: [f64; 2], support: f64, inside: bool) -> Option<[f64; 2]> {
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
            return Some([sign * dy / length, -sign * dx / length]);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_is_reported_from_its_corners() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(face_normal(&square, [0.5, 0.0], 0.1, false), Some([0.0, -1.0]));
        assert_eq!(face_normal(&square, [1.0, 0.5], 0.1, true), Some([-1.0, 0.0]));
        assert_eq!(face_normal(&square, [0.05, 0.0], 0.1, false), None);
        assert_eq!(face_normal(&square, [0.5, 0.5], 0.1, false), None);
    }
}
