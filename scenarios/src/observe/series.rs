//! `series.csv`: a row per sample, kept in memory too for comparisons and charts.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use fsi_coupling::{Motion, PanelState};

use super::front::{FRONT, front};
use super::level::{self, LevelReader};
use super::volume::{VOLUME, VolumeReader};
use super::{Frame, ObserveError, Observer};
use crate::scene::Scene;
use crate::summary::Water;

/// The sampled curves.
pub struct Series {
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
    front: bool,
    levels: LevelReader,
    volume: Option<VolumeReader>,
    file: Option<(String, BufWriter<File>)>,
}

/// Reads a column from a body's motion.
type Read = fn(&Motion) -> f64;

/// Columns of a body, with what they read.
pub(super) const BODY: [(&str, Read); 10] = [
    ("x_m", |m| m.position[0]),
    ("y_m", |m| m.position[1]),
    ("angle_deg", |m| m.angle.to_degrees()),
    ("vx_m_per_s", |m| m.velocity[0]),
    ("vy_m_per_s", |m| m.velocity[1]),
    ("ax_m_per_s2", |m| m.acceleration[0]),
    ("ay_m_per_s2", |m| m.acceleration[1]),
    ("fx_N_per_m", |m| m.force[0]),
    ("fy_N_per_m", |m| m.force[1]),
    ("moment_N", |m| m.moment),
];

impl Series {
    /// Columns for a scene; rows go to `path` as well if one is given.
    pub fn new(scene: &Scene, path: Option<&Path>) -> Result<Series, ObserveError> {
        let mut columns = vec!["time_s".to_string()];
        for body in scene.body.iter() {
            columns.extend(BODY.iter().map(|(unit, _)| format!("{}.{unit}", body.name)));
            columns.extend(body.panels.iter().flat_map(|panel| panel.columns()));
        }
        columns.extend(scene.gauges.iter().map(|g| format!("{}.p_Pa", g.name)));
        columns.extend(scene.observe.front.then(|| FRONT.to_string()));
        columns.extend(level::columns(scene));
        columns.extend(scene.observe.volume.then(|| VOLUME.to_string()));
        let file = match path {
            None => None,
            Some(path) => {
                let name = path.display().to_string();
                let wrong = |source| ObserveError::Io { path: name.clone(), source };
                let mut file = BufWriter::new(File::create(path).map_err(wrong)?);
                writeln!(file, "{}", columns.join(",")).map_err(wrong)?;
                Some((name, file))
            }
        };
        let volume = scene.observe.volume.then(|| VolumeReader::new(scene));
        let (front, levels) = (scene.observe.front, LevelReader::new(scene));
        Ok(Series { columns, rows: Vec::new(), front, levels, volume, file })
    }

    /// Take a row, in the order of the columns.
    pub fn push(&mut self, row: Vec<f64>) -> Result<(), ObserveError> {
        if let Some((path, file)) = &mut self.file {
            let text: Vec<String> = row.iter().map(|v| format!("{v:.9e}")).collect();
            writeln!(file, "{}", text.join(",")).map_err(|source| ObserveError::Io { path: path.clone(), source })?;
        }
        self.rows.push(row);
        Ok(())
    }

    /// Names of a body's columns, after its own name and a dot.
    pub fn body_columns() -> [&'static str; 10] {
        BODY.map(|(name, _)| name)
    }

    /// Values of a body's columns.
    pub fn body_values(motion: &Motion) -> [f64; 10] {
        BODY.map(|(_, read)| read(motion))
    }

    /// Names of the columns; the first is `time_s`.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// A column by name, or `None`.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let k = self.columns.iter().position(|c| c == name)?;
        Some(self.rows.iter().map(|row| row[k]).collect())
    }

    /// Sample times [s].
    pub fn times(&self) -> Vec<f64> {
        self.rows.iter().map(|row| row[0]).collect()
    }

    /// The last row.
    pub fn last(&self) -> Option<&[f64]> {
        self.rows.last().map(Vec::as_slice)
    }

    /// Extreme value of each column with its time [s]: the entry of largest magnitude.
    pub fn peaks(&self) -> impl Iterator<Item = (&str, f64, f64)> {
        (1..self.columns.len()).filter_map(|k| {
            let row = self.rows.iter().max_by(|a, b| a[k].abs().total_cmp(&b[k].abs()))?;
            Some((self.columns[k].as_str(), row[k], row[0]))
        })
    }

    /// Mean of each column over the rows from `since` [s] on.
    pub fn means(&self, since: f64) -> impl Iterator<Item = (&str, f64)> {
        let late: Vec<&Vec<f64>> = self.rows.iter().filter(|row| row[0] >= since).collect();
        (1..self.columns.len()).filter_map(move |k| {
            let mean = late.iter().map(|row| row[k]).sum::<f64>() / late.len() as f64;
            mean.is_finite().then_some((self.columns[k].as_str(), mean))
        })
    }

    /// What became of the water's volume (GE11), judged over the samples from `since` [s] on; `None` where nobody asked.
    pub fn water(&self, since: f64) -> Option<Water> {
        let volumes = self.column(VOLUME)?;
        let first = *volumes.first()?;
        let drift = |volume: f64| volume / first - 1.0;
        let mean = self.means(since).find(|(name, _)| *name == VOLUME)?.1;
        let farthest = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
        let worst = volumes.iter().map(|&v| drift(v)).fold(0.0, farthest);
        Some(Water { volume_start_m2: first, volume_drift: drift(mean), volume_drift_worst: worst })
    }

    /// See that all rows are in the file.
    pub fn flush(&mut self) -> Result<(), ObserveError> {
        match &mut self.file {
            Some((path, file)) => file.flush().map_err(|source| ObserveError::Io { path: path.clone(), source }),
            None => Ok(()),
        }
    }
}

/// Values of a panel's columns, in the order of [`crate::scene::Panel::columns`].
pub(super) fn panel_values(panel: &PanelState) -> Vec<f64> {
    let watched = panel
        .watched
        .iter()
        .flat_map(|w| [w.displacement[0], w.displacement[1], w.deflection, w.section.moment, w.strain[0], w.strain[1]]);
    watched.chain([panel.stress]).collect()
}

impl Observer for Series {
    fn observe(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        let mut row = vec![frame.time()];
        for (body, motion) in frame.system.bodies().filter_map(|b| Some((b, b.motion()?))) {
            row.extend(Series::body_values(&motion));
            row.extend(body.panels().iter().flat_map(panel_values));
        }
        row.extend(frame.gauges);
        row.extend(self.front.then(|| front(&frame.system.fluid)));
        row.extend(self.levels.read(&frame.system.fluid));
        row.extend(self.volume.as_ref().map(|volume| volume.read(&frame.system.fluid)));
        self.push(row)?;
        if frame.particles {
            self.flush()?;
        }
        Ok(())
    }
}
