//! `series.csv`: a row per sample, kept in memory too for comparisons and charts.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use scene::Scene;

use super::columns::{SOURCES, VOLUME, Water, columns};
use super::source::Reader;
use super::{Frame, ObserveError, Observer};

/// Create the file with its heading.
fn create(path: &Path, columns: &[String]) -> Result<(String, BufWriter<File>), ObserveError> {
    let name = path.display().to_string();
    let wrong = |source| ObserveError::Io(name.clone(), source);
    let mut file = BufWriter::new(File::create(path).map_err(wrong)?);
    writeln!(file, "{}", columns.join(",")).map_err(wrong)?;
    Ok((name, file))
}

/// The sampled curves.
pub struct Series {
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
    readers: Vec<Reader>,
    file: Option<(String, BufWriter<File>)>,
    /// Rows that the file has.
    written: usize,
    /// Rows that it may have, where later ones may still be discarded.
    accepted: Option<usize>,
}

impl Series {
    /// Columns for a scene; rows go to `path` as well if one is given.
    pub fn new(scene: &Scene, path: Option<&Path>) -> Result<Series, ObserveError> {
        let columns = columns(scene);
        let file = path.map(|path| create(path, &columns)).transpose()?;
        let readers = SOURCES.iter().map(|source| (source.reader)(scene)).collect();
        Ok(Series { columns, rows: Vec::new(), readers, file, written: 0, accepted: None })
    }

    /// The rows, in the order of the columns.
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// Take rows, and write them to `path` if one is given.
    pub fn restore(&mut self, rows: Vec<Vec<f64>>, path: Option<&Path>) -> Result<(), ObserveError> {
        (self.rows, self.written) = (rows, 0);
        self.file = path.map(|path| create(path, &self.columns)).transpose()?;
        self.flush()
    }

    /// Take a row, in the order of the columns.
    pub fn push(&mut self, row: Vec<f64>) {
        self.rows.push(row);
    }

    /// Rows from here on may be discarded; the file has them once the next call accepts them.
    pub fn hold(&mut self) -> Result<(), ObserveError> {
        self.accepted = Some(self.rows.len());
        self.flush()
    }

    /// Forget the rows since `hold`.
    pub fn discard(&mut self) {
        self.rows.truncate(self.accepted.unwrap_or(self.rows.len()));
    }

    /// Accept all rows.
    pub fn release(&mut self) {
        self.accepted = None;
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

    /// Drift of the water's volume (GE11), over the samples from `since` [s] on; `None` unless the scene asks for it.
    pub fn water(&self, since: f64) -> Option<Water> {
        let volumes = self.column(VOLUME)?;
        let first = *volumes.first()?;
        let drift = |volume: f64| volume / first - 1.0;
        let mean = self.means(since).find(|(name, _)| *name == VOLUME)?.1;
        let farthest = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
        let worst = volumes.iter().map(|&v| drift(v)).fold(0.0, farthest);
        Some(Water { volume_start_m2: first, volume_drift: drift(mean), volume_drift_worst: worst })
    }

    /// See that all accepted rows are in the file.
    pub fn flush(&mut self) -> Result<(), ObserveError> {
        let Some((path, file)) = &mut self.file else { return Ok(()) };
        let wrong = |source| ObserveError::Io(path.clone(), source);
        let until = self.accepted.unwrap_or(self.rows.len());
        for row in &self.rows[self.written.min(until)..until] {
            let text: Vec<String> = row.iter().map(|v| format!("{v:.9e}")).collect();
            writeln!(file, "{}", text.join(",")).map_err(wrong)?;
        }
        self.written = until;
        file.flush().map_err(wrong)
    }
}

impl Observer for Series {
    fn observe(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        let mut row = vec![frame.time()];
        row.extend(self.readers.iter_mut().flat_map(|read| read(frame)));
        self.push(row);
        if frame.particles {
            self.flush()?;
        }
        Ok(())
    }
}
