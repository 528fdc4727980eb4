//! A landing: follow it, and keep its files.

use std::path::Path;
use std::time::Instant;

use fsi_coupling::entry_theory::ditching::LandingResult;

use super::check::{hull, landing};
use super::model::Scene;
use super::page::page;
use super::series::{csv, rows};
use super::summary::Summary;
use crate::run::RunError;

/// Files of a landing.
pub const FILES: [&str; 4] = ["series.csv", "summary.json", "scene.resolved.toml", "report.html"];

/// A landing that was followed.
pub struct Landed {
    /// The numbers.
    pub summary: Summary,
    /// Its course.
    pub run: LandingResult,
    /// Rows of the series.
    rows: Vec<Vec<f64>>,
}

/// Follow a landing that was [loaded](super::load).
///
/// # Panics
/// A scene that was changed by hand into one that [`load`](super::load) refuses.
pub fn follow(scene: &Scene) -> Landed {
    let hull = hull(scene).unwrap_or_else(|problem| panic!("{}", problem.sentence));
    let start = Instant::now();
    let run = landing(scene, &hull).solve();
    let rows = rows(&run.moments, scene.aeroplane.mass * scene.water.gravity);
    let summary = Summary::new(scene, &run, &rows, start.elapsed().as_secs_f64());
    Landed { summary, run, rows }
}

/// Follow a landing and write its files into a folder; `force` replaces those that it holds.
pub fn run(scene: &Scene, out: &Path, force: bool) -> Result<Landed, RunError> {
    if out.is_file() {
        return Err(RunError::NotAFolder(out.display().to_string()));
    }
    if let (Some(held), false) = (FILES.iter().find(|name| out.join(name).exists()), force) {
        return Err(RunError::Occupied(out.display().to_string(), held));
    }
    let landed = follow(scene);
    std::fs::create_dir_all(out).map_err(|e| RunError::Write(out.display().to_string(), e))?;
    let texts = [csv(&landed.rows), landed.summary.to_json(), scene.to_toml(), page(scene, &landed)];
    for (name, text) in FILES.iter().zip(texts) {
        let path = out.join(name);
        std::fs::write(&path, text).map_err(|e| RunError::Write(path.display().to_string(), e))?;
    }
    Ok(landed)
}

impl Landed {
    /// A column of the series by its name.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let k = super::series::COLUMNS.iter().position(|(column, _)| *column == name)?;
        Some(self.rows.iter().map(|row| row[k]).collect())
    }
}
