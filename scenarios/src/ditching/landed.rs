//! A landing that was followed.

use std::time::Instant;

use fsi_coupling::entry_theory::ditching::LandingResult;

use super::check::{hull, landing};
use super::model::Scene;
use super::series::{COLUMNS, rows};
use super::summary::Summary;

/// A landing that was followed.
pub struct Landed {
    /// The numbers.
    pub summary: Summary,
    /// Its motion in time.
    pub run: LandingResult,
    /// Rows of the series.
    pub(super) rows: Vec<Vec<f64>>,
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

impl Landed {
    /// A column of the series by its name.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let k = COLUMNS.iter().position(|(column, _)| *column == name)?;
        Some(self.rows.iter().map(|row| row[k]).collect())
    }
}
