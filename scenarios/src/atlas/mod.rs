//! `splashdown stability`: where a method is stable, inaccurate or fails, over two parameters, and where theory says so.
//!
//! A map is a TOML file in `scenarios/cases/maps`: a scene, two axes, what counts as inaccurate and as failed, and the name of a
//! formula for the boundary ([`Theory`]). Every point is a run of its own on one thread, so that a map has the same bits
//! however many of them run beside each other; `--point X,Y` runs one again.

mod acoustics;
mod lattice;
mod map;
mod page;
mod picture;
mod sweep;
mod theory;
mod verdict;

use std::path::Path;

use include_dir::{Dir, include_dir};
use serde::{Deserialize, Serialize};

use crate::embedded;
use crate::run::RunError;
use crate::scene::SceneError;

pub use map::{Axis, Choice, Key, Map};
pub use page::{page, table};
pub use picture::svg;
pub use sweep::{Point, foretold, point, sweep};
pub use theory::Theory;
pub use verdict::{Bound, Verdict};

static MAPS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/cases/maps");

/// A map, measured.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Measured {
    /// What was mapped.
    pub map: Map,
    /// Version of the program.
    pub version: String,
    /// The points, row by row: along x first.
    pub points: Vec<Point>,
}

/// A map that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum AtlasError {
    /// No map of that name.
    #[error("no map `{0}`; there are: {1}")]
    Unknown(String, String),
    /// A map's file is wrong.
    #[error("map `{0}`: {1}")]
    Map(String, String),
    /// A stored map cannot be read.
    #[error("{0}: {1}; expected the JSON file of a map that was measured")]
    Stored(String, String),
    /// A point is not on the map.
    #[error("--point {given}: `{part}` is not on the axis `{axis}`; expected {expected}")]
    Point {
        /// The argument.
        given: String,
        /// What of it is wrong.
        part: String,
        /// The axis' label.
        axis: String,
        /// What it holds.
        expected: String,
    },
    /// A point's scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A run could not be made.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// All maps, by name.
pub fn maps() -> Result<Vec<Map>, AtlasError> {
    let all: Vec<(String, Map)> = embedded::all(&MAPS).map_err(|(name, why)| AtlasError::Map(name, why))?;
    all.into_iter().map(|(name, map)| Map { name, ..map }.sound()).collect()
}

/// The maps of the given names, or of the given TOML files; all that are built in if none is given.
pub fn select(names: &[String]) -> Result<Vec<Map>, AtlasError> {
    let all = maps()?;
    if names.is_empty() {
        return Ok(all);
    }
    let known = || all.iter().map(|m| m.name.as_str()).collect::<Vec<_>>().join(", ");
    let chosen = |name: &String| match name.ends_with(".toml") {
        true => from_file(name),
        false => {
            all.iter().find(|m| m.name == *name).cloned().ok_or_else(|| AtlasError::Unknown(name.clone(), known()))
        }
    };
    names.iter().map(chosen).collect()
}

/// The map of a file; its name is the file's path, so that the commands on it lead back to it.
fn from_file(file: &str) -> Result<Map, AtlasError> {
    let wrong = |why: String| AtlasError::Map(file.to_string(), why);
    let text = std::fs::read_to_string(file).map_err(|e| wrong(e.to_string()))?;
    let map: Map = toml::from_str(&text).map_err(|e| wrong(e.to_string()))?;
    Map { name: file.to_string(), ..map }.sound()
}

/// A map that was measured before.
pub fn stored(path: &Path) -> Result<Measured, AtlasError> {
    let wrong = |why: String| AtlasError::Stored(path.display().to_string(), why);
    let text = std::fs::read_to_string(path).map_err(|e| wrong(e.to_string()))?;
    let measured: Measured = serde_json::from_str(&text).map_err(|e| wrong(e.to_string()))?;
    let map = measured.map.sound()?;
    match measured.points.len() == map.x.len() * map.y.len() {
        true => Ok(Measured { map, ..measured }),
        false => Err(wrong(format!("{} points for {} by {}", measured.points.len(), map.x.len(), map.y.len()))),
    }
}

impl Measured {
    /// The points of a row, along x.
    pub fn row(&self, j: usize) -> &[Point] {
        let columns = self.map.x.len();
        &self.points[j * columns..(j + 1) * columns]
    }

    /// Cells between the measured boundary of a row and the theory's: the longest run of neighbouring points at which one
    /// says failed and the other does not; `None` where no theory speaks of the row.
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
    use super::*;

    fn measured(row: &[(Verdict, Option<f64>)]) -> Measured {
        let mut map = maps().expect("they parse").swap_remove(0);
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
        let file = tempfile::NamedTempFile::new().expect("a file");
        std::fs::write(file.path(), measured.to_json()).expect("written");
        let back = stored(file.path()).expect("read");
        assert_eq!(back.to_json(), measured.to_json());
        assert_eq!(svg(&back), svg(&measured));
        std::fs::write(file.path(), "{}").expect("written");
        assert!(matches!(stored(file.path()), Err(AtlasError::Stored(..))));
    }
}
