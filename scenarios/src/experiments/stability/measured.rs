//! A map that was measured.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::map::{MAPS, Map};
use crate::experiments::ExperimentError;

/// Verdict on a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Ran to its end, within all bounds.
    Stable,
    /// Ran to its end, but a number is wrong.
    Inaccurate,
    /// Broke down, took too many steps, gained energy, let water penetrate a wall, violated the momentum balance, or left the
    /// map's bounds of failure.
    Failed,
}

impl Verdict {
    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Stable => "stable",
            Verdict::Inaccurate => "inaccurate",
            Verdict::Failed => "failed",
        }
    }
}

/// One run.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Point {
    /// Place on the x axis.
    pub x: String,
    /// Place on the y axis.
    pub y: String,
    /// Its verdict.
    pub verdict: Verdict,
    /// The reason.
    pub why: String,
    /// The parameters over the theoretical limit [-]: stable below 1; `None` without a theory.
    pub theory: Option<f64>,
    /// Steps taken.
    pub steps: u64,
}

/// A map, measured.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Measured {
    /// The map.
    pub map: Map,
    /// Version of the program.
    pub version: String,
    /// The points, row by row: along x first.
    pub points: Vec<Point>,
}

/// A map that was measured before.
///
/// # Errors
/// The file cannot be read, or is not a map.
pub fn stored(path: &Path) -> Result<Measured, ExperimentError> {
    let measured: Measured = MAPS.stored(path)?;
    let map = MAPS.checked(measured.map)?;
    if measured.points.len() == map.x.len() * map.y.len() {
        return Ok(Measured { map, ..measured });
    }
    let why = format!("{} points for {} by {}", measured.points.len(), map.x.len(), map.y.len());
    Err(MAPS.not_stored(path, &why))
}

impl Measured {
    /// The points of a row, along x.
    pub fn row(&self, j: usize) -> &[Point] {
        let columns = self.map.x.len();
        &self.points[j * columns..(j + 1) * columns]
    }

    /// Cells between the measured boundary of a row and the theoretical one: the longest sequence of neighbouring points at
    /// which only one of them has failed; `None` without a theory for the row.
    pub fn misfit(&self, j: usize) -> Option<usize> {
        let row = self.row(j);
        row.iter().any(|p| p.theory.is_some()).then(|| {
            let agree = |p: &Point| p.theory.is_none_or(|ratio| (ratio >= 1.0) == (p.verdict == Verdict::Failed));
            row.split(agree).map(<[Point]>::len).max().unwrap_or(0)
        })
    }

    /// As the text of a JSON file.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a map holds nothing that JSON cannot say")
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Choice, svg};
    use super::*;

    fn measured(row: &[(Verdict, Option<f64>)]) -> Measured {
        let mut map = MAPS.all().expect("they parse").swap_remove(0);
        map.x = Axis { values: (0..row.len()).map(|k| k as f64).collect(), ..map.x };
        map.y = Axis { values: vec![], choices: vec![Choice { name: "a".into(), set: vec![] }], ..map.y };
        let point = |&(verdict, theory): &(Verdict, Option<f64>)| Point {
            x: "0".into(),
            y: "a".into(),
            verdict,
            why: "as given".into(),
            theory,
            steps: 1,
        };
        Measured { map, version: "1".into(), points: row.iter().map(point).collect() }
    }

    #[test]
    fn a_misfit_counts_the_cells_between_two_boundaries() {
        use Verdict::{Failed, Inaccurate, Stable};
        let row = |theory: [f64; 5], found: [Verdict; 5]| {
            let row: Vec<_> = found.into_iter().zip(theory.map(Some)).collect();
            measured(&row).misfit(0)
        };
        let rising = [0.5, 0.8, 1.1, 1.5, 2.0];
        assert_eq!(row(rising, [Stable, Inaccurate, Failed, Failed, Failed]), Some(0));
        assert_eq!(row(rising, [Stable, Stable, Stable, Stable, Failed]), Some(2));
        assert_eq!(row([2.0, 0.5, 0.5, 0.5, 2.0], [Failed, Failed, Stable, Failed, Failed]), Some(1));
        assert_eq!(measured(&[(Failed, None)]).misfit(0), None);
    }

    #[test]
    fn a_stored_map_comes_back() {
        let measured = measured(&[(Verdict::Stable, Some(0.5)), (Verdict::Failed, Some(1.5))]);
        let folder = temp_dir::TempDir::new().expect("a folder");
        let file = folder.child("map.json");
        std::fs::write(&file, measured.to_json()).expect("written");
        let back = stored(&file).expect("read");
        assert_eq!(back.to_json(), measured.to_json());
        assert_eq!(svg(&back), svg(&measured));
        std::fs::write(&file, "{}").expect("written");
        assert!(matches!(stored(&file), Err(ExperimentError::Case(_))));
    }
}
