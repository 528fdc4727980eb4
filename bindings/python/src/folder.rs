//! Files of a run that are not text: the frames of its log.

use std::path::PathBuf;

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use run::log::{LogReader, LoggedFrame, Point};
use scenarios::export::{start_of_run, time_of_run};

use crate::arrays::{self, Particles};
use crate::call::{Guarded, refuse_fork};
use crate::errors;
use crate::settings::text;

/// Water, walls and bodies of a frame.
type Shown<'py> = (Bound<'py, PyDict>, Bound<'py, PyDict>, Bound<'py, PyDict>);

/// The frames of a run's log.
#[pyclass(frozen, module = "splashdown._core")]
pub struct Log {
    folder: String,
    start: f64,
    reader: Guarded<LogReader>,
}

#[pymethods]
impl Log {
    /// The log in the folder of a run, as many frames as are whole.
    #[new]
    fn new(py: Python<'_>, folder: PathBuf) -> PyResult<Log> {
        refuse_fork()?;
        let name = text(&folder)?.to_string();
        let opened = py.detach(|| LogReader::open(&folder.join("log.mcap")));
        let missing = || errors::input(format!("{name}: expected the folder of a run, with frames in its log.mcap"));
        let start = start_of_run(&folder).map_err(errors::input)?;
        Ok(Log { reader: Guarded::new(opened.ok_or_else(missing)?), start, folder: name })
    }

    /// Times of the frames [s], as in the series.
    fn times<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let times = self.reader.open()?.times();
        arrays::values(py, times.into_iter().map(|time| time_of_run(time, self.start)).collect())
    }

    /// Frame `index`: the particles of the water, those of the walls, and the bodies.
    fn frame<'py>(&self, py: Python<'py>, index: usize) -> PyResult<Shown<'py>> {
        let mut reader = self.reader.open()?;
        let count = reader.times().len();
        if index >= count {
            return Err(errors::input(format!("frame {index}: expected 0 to {}", count.saturating_sub(1))));
        }
        let log = &mut *reader;
        let frame = py.detach(|| log.frame(index));
        let frame =
            frame.ok_or_else(|| errors::input(format!("{}: frame {index} of its log is damaged", self.folder)))?;
        Ok((points(py, frame.fluid())?, points(py, frame.walls())?, bodies(py, &frame)?))
    }
}

/// Logged particles as arrays, with their identities; images in a plane of symmetry are marked.
fn points<'py>(py: Python<'py>, points: impl Iterator<Item = Point>) -> PyResult<Bound<'py, PyDict>> {
    let (mut particles, mut ids, mut images) = (Particles::default(), Vec::new(), Vec::new());
    for point in points {
        particles.position.push(point.at);
        particles.velocity.push(point.velocity);
        particles.pressure.push(point.pressure);
        particles.density.push(point.density);
        particles.spacing.push(point.spacing);
        ids.push(point.id);
        images.push(point.is_image());
    }
    let dict = particles.into_dict(py)?;
    dict.set_item("id", arrays::values(py, ids)?)?;
    dict.set_item("image", arrays::values(py, images)?)?;
    Ok(dict)
}

/// The bodies of a frame by name: place, angle, and outline in space.
fn bodies<'py>(py: Python<'py>, frame: &LoggedFrame) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for body in &frame.bodies {
        let one = PyDict::new(py);
        one.set_item("position", arrays::values(py, body.position.to_vec())?)?;
        one.set_item("angle", body.angle)?;
        let outline = PyList::empty(py);
        for line in &body.loops {
            outline.append(arrays::pairs(py, line.clone())?)?;
        }
        one.set_item("outline", outline)?;
        all.set_item(&body.name, one)?;
    }
    Ok(all)
}

/// A TOML text as JSON.
#[pyfunction]
pub fn toml_to_json(text: &str) -> PyResult<String> {
    let table: toml::Table = text.parse().map_err(|error: toml::de::Error| errors::input(error.message()))?;
    serde_json::to_string(&table).map_err(errors::input)
}
