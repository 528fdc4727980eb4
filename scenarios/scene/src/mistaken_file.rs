//! What a path names in place of the file that a command expects, and the command that takes it.

use std::path::Path;

use toml::Table;

use super::error::SceneError;

/// Endings of files of points.
const OUTLINES: [&str; 5] = ["csv", "dat", "dxf", "svg", "txt"];

/// The kind of a file that a command expects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// A scene.
    Scene,
    /// A landing.
    Landing,
    /// A planing hull.
    PlaningHull,
    /// A sweep.
    Sweep,
}

impl Expected {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Expected::Scene => "a scene",
            Expected::Landing => "a landing",
            Expected::PlaningHull => "a planing hull",
            Expected::Sweep => "a sweep file",
        }
    }

    /// Several of them.
    pub fn plural(self) -> &'static str {
        match self {
            Expected::Scene => "scenes",
            Expected::Landing => "landings",
            Expected::PlaningHull => "planing hulls",
            Expected::Sweep => "sweeps",
        }
    }

    fn of(table: &Table) -> Option<Expected> {
        let has = |keys: &[&str]| keys.iter().any(|key| table.contains_key(*key));
        let names = |key: &str| table.get(key).is_some_and(|value| value.is_str() || value.is_array());
        match () {
            _ if has(&["grid", "zip", "latin_hypercube"]) || names("scene") || names("ditch") => Some(Expected::Sweep),
            _ if has(&["landing", "aeroplane", "wing"]) => Some(Expected::Landing),
            _ if has(&["hull", "trim_deg", "wetted_length"]) => Some(Expected::PlaningHull),
            _ if has(&["time", "resolution", "body", "tank"]) => Some(Expected::Scene),
            _ => None,
        }
    }
}

/// Refuses a folder.
pub(crate) fn refuse_folder(path: &str, expected: Expected) -> Result<(), SceneError> {
    let folder = Path::new(path);
    if !folder.is_dir() {
        return Ok(());
    }
    let holds = |name: &str| folder.join(name).is_file();
    let (what, help) = match () {
        _ if holds("sweep.json") => ("the folder of a sweep", format!("`splashdown sweep {path}` continues it")),
        _ if holds("scene.resolved.toml") => (
            "the folder of a run",
            format!("`splashdown resume {path}` continues it, `splashdown report {path}` makes its page again"),
        ),
        _ => ("a folder", "name a file in it".to_string()),
    };
    Err(mistaken(path, what, expected, help))
}

/// Refuses a text that is clearly another kind of file.
pub fn refuse_other_kind(path: &str, text: &str, expected: Expected) -> Result<(), SceneError> {
    let Ok(table) = text.parse::<Table>() else {
        let ending = path.rsplit_once('.').map_or(String::new(), |(_, ending)| ending.to_lowercase());
        let name = Path::new(path).file_name().map_or(path.into(), |name| name.to_string_lossy());
        let help =
            format!("`splashdown new section` prints a scene to start from: with body.outline = {name:?} beside it");
        return match OUTLINES.contains(&ending.as_str()) {
            true => Err(mistaken(path, "a file of points, such as an outline", expected, help)),
            false => Ok(()),
        };
    };
    let (what, help) = match Expected::of(&table) {
        Some(found) if found == expected => return Ok(()),
        Some(Expected::Sweep) => ("a sweep", format!("`splashdown sweep {path}` runs it")),
        Some(Expected::Landing) => ("a landing", format!("`splashdown ditch {path}` runs it")),
        Some(Expected::PlaningHull) => ("a planing hull", format!("`splashdown plane {path}` runs it")),
        Some(Expected::Scene) => (
            "a scene",
            format!("`splashdown run {path}` runs it; a sweep over it is a file of its own, with scene = \"FILE\""),
        ),
        None => return Ok(()),
    };
    Err(mistaken(path, what, expected, help))
}

fn mistaken(path: &str, what: &'static str, expected: Expected, help: String) -> SceneError {
    SceneError::Mistaken { path: path.to_string(), what, expected: expected.name(), help }
}
