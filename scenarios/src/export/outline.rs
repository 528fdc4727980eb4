//! Pressure along the outline of a rigid body, from the boundary particles in the frames of a log, as tables.

use std::io;
use std::path::Path;

use fsi_coupling::Outline;
use fsi_coupling::geometry::polyline::Polyline;

use super::time_of_run;
use crate::data_table::DataTable;
use crate::log::{IMAGE, LogReader, LoggedBody, LoggedFrame, Point};
use crate::scene::{Body, Scene};

/// Depth below the surface over the spacing up to which a boundary particle belongs to the outermost row [-].
const OUTERMOST: f64 = 0.75;

/// A boundary particle of the outermost row.
struct Station {
    id: u32,
    /// Running length of its place on the outline, counter-clockwise [m].
    along: f64,
    /// The place [m, body's frame].
    at: [f64; 2],
}

/// Pressures on a body.
pub(super) struct OutlinePressures {
    body: String,
    stations: Vec<Station>,
    /// Times of the frames [s].
    pub times: Vec<f64>,
    /// `[times][stations]` [Pa].
    pressures: Vec<Vec<f64>>,
}

impl OutlinePressures {
    /// Of the frames of a log; `None` without frames, or without boundary particles on the body.
    pub fn of(scene: &Scene, body: &Body, log: &mut LogReader) -> Option<OutlinePressures> {
        let mut found = OutlinePressures {
            body: body.name.clone(),
            stations: Vec::new(),
            times: Vec::new(),
            pressures: Vec::new(),
        };
        for index in 0..log.times().len() {
            let Some(frame) = log.frame(index) else { continue };
            let Some(logged) = frame.bodies.iter().find(|own| own.name == body.name) else { continue };
            if found.stations.is_empty() {
                found.stations = stations(body, &frame, logged)?;
            }
            let mut walls: Vec<Point> = frame.walls().filter(|point| point.id & IMAGE == 0).collect();
            walls.sort_by_key(|point| point.id);
            let pressure = |station: &Station| {
                let place = walls.binary_search_by_key(&station.id, |point| point.id);
                place.map_or(f64::NAN, |k| walls[k].pressure)
            };
            found.pressures.push(found.stations.iter().map(pressure).collect());
            found.times.push(time_of_run(frame.time, scene.time.start));
        }
        (!found.stations.is_empty()).then_some(found)
    }

    /// Write its tables.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        let mut table = DataTable::default();
        table.numbers("time_s", self.times.iter().map(|time| Some(*time)));
        for (k, station) in self.stations.iter().enumerate() {
            let values = self.pressures.iter().map(|row| Some(row[k]).filter(|p| p.is_finite()));
            table.numbers(format!("p_Pa_at_{:.6}_m", station.along), values);
        }
        std::fs::write(folder.join(format!("{}_pressure.csv", self.body)), table.to_csv())?;
        let most = |k: usize| {
            let each = self.pressures.iter().map(|row| row[k]).zip(self.times.iter().copied());
            each.filter(|(p, _)| p.is_finite()).max_by(|a, b| a.0.total_cmp(&b.0))
        };
        let largest: Vec<Option<(f64, f64)>> = (0..self.stations.len()).map(most).collect();
        let mut table = DataTable::default();
        table.numbers("along_m", self.stations.iter().map(|station| Some(station.along)));
        table.numbers("x_m", self.stations.iter().map(|station| Some(station.at[0])));
        table.numbers("y_m", self.stations.iter().map(|station| Some(station.at[1])));
        table.numbers("p_most_Pa", largest.iter().map(|most| most.map(|most| most.0)));
        table.numbers("p_most_at_s", largest.iter().map(|most| most.map(|most| most.1)));
        std::fs::write(folder.join(format!("{}_stations.csv", self.body)), table.to_csv())
    }
}

/// The outermost row of a body's boundary particles, along its outline.
fn stations(body: &Body, frame: &LoggedFrame, logged: &LoggedBody) -> Option<Vec<Station>> {
    let (outline, line) = (Outline::of(&body.shape).ok()?, Polyline::closed(&body.shape.outline()));
    let (sin, cos) = logged.angle.sin_cos();
    let station = |point: Point| {
        let [x, y] = [0, 1].map(|k| point.at[k] - logged.position[k]);
        let local = [cos * x + sin * y, cos * y - sin * x];
        let depth = -outline.signed_distance(local);
        let outermost = point.id & IMAGE == 0 && depth > 0.0 && depth < OUTERMOST * point.spacing;
        let (along, _) = line.nearest(local);
        outermost.then(|| Station { id: point.id, along, at: line.at(along) })
    };
    let mut found: Vec<Station> = frame.walls().filter_map(station).collect();
    found.sort_by(|a, b| a.along.total_cmp(&b.along));
    // two rows meet at a corner; names of columns have six digits
    found.dedup_by(|a, b| (a.along - b.along).abs() < 2e-6);
    Some(found)
}
