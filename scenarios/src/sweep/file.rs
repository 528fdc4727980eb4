//! The sweep file: what is run, and over what.

use std::fs;
use std::path::{Path, PathBuf};

use scene::mistaken_file::{Expected, refuse_other_kind};
use scene::source::segments;
use scene::{SceneError, read_text};
use serde::{Deserialize, Serialize};
use toml::Value;

use super::axes::{Block, MOST_POINTS, grid, hypercube, product, zip};
use super::error::SweepError;
use super::toml_reader::{Entry, TomlReader};
use crate::ditching;

/// What a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A scene, as of `splashdown run`.
    Run,
    /// A landing, as of `splashdown ditch`.
    Ditch,
}

/// A sweep file.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepFile {
    /// The file.
    pub path: PathBuf,
    /// What its points are.
    pub kind: Kind,
    /// Scenes or landings as the file names them, each with its built-in name or its path.
    pub scenes: Vec<[String; 2]>,
    /// Fixed overrides, `key=value`.
    pub sets: Vec<String>,
    /// Axes.
    pub blocks: Vec<Block>,
    /// Paths in `summary.json` to tabulate; empty: the results.
    pub tabulate: Vec<String>,
}

const KEYS: [&str; 7] = ["scene", "ditch", "tabulate", "set", "grid", "zip", "latin_hypercube"];

impl SweepFile {
    /// Read a sweep file.
    ///
    /// # Errors
    /// The file cannot be read, or its first mistake.
    pub fn read(path: &Path) -> Result<SweepFile, SweepError> {
        let shown = path.display().to_string();
        let text = read_text(path).map_err(|e| {
            let scene = if scene::builtin().iter().any(|(name, _)| *name == shown) {
                format!("; {shown} is a built-in scene: `splashdown run {shown}` runs it")
            } else {
                String::new()
            };
            SweepError::Input(format!("cannot read the sweep file {shown}: {e}{scene}"))
        })?;
        refuse_other_kind(&shown, &text, Expected::Sweep)?;
        let whole = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        SweepFile::parse(&whole, &shown, &text)
    }

    /// From its text; `path` tells the folder in which scenes are looked for, `shown` stands for the file in messages.
    ///
    /// # Errors
    /// The first mistake.
    pub fn parse(path: &Path, shown: &str, text: &str) -> Result<SweepFile, SweepError> {
        let reader = TomlReader { name: shown, text };
        let table = reader.parse()?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let (mut what, mut tabulate, mut sets, mut blocks) = (None, Vec::new(), Vec::new(), Vec::new());
        let mut keys: Vec<String> = Vec::new();
        let mut take = |place: std::ops::Range<usize>, key: &str| -> Result<(), SceneError> {
            if keys.iter().any(|other| segments(other).eq(segments(key))) {
                return Err(reader.error(place, format!("`{key}` stands twice: expected one place for each key")));
            }
            keys.push(key.to_string());
            Ok(())
        };
        for entry in reader.entries(&table) {
            let mut found: Vec<Block> = Vec::new();
            match entry.key.as_str() {
                word @ ("scene" | "ditch") if what.is_none() => what = Some(scenes(&reader, &entry, word, folder)?),
                "scene" | "ditch" => {
                    return Err(reader.error(entry.place, "expected `scene` or `ditch`, not both".into()).into());
                }
                "tabulate" => tabulate = reader.strings("tabulate", entry.value)?,
                "set" => {
                    for leaf in reader.leaves(reader.table(&entry)?, |_| false) {
                        take(leaf.place.clone(), &leaf.key)?;
                        sets.push(assignment(&leaf.key, &reader.value(leaf.value)?));
                    }
                }
                "grid" => found = grid(&reader, reader.table(&entry)?)?,
                "zip" => found = zips(&reader, &entry)?,
                "latin_hypercube" => found = vec![hypercube(&reader, &entry)?],
                _ => return Err(reader.unknown(&entry, &KEYS).into()),
            }
            found.iter().flat_map(|block| &block.keys).try_for_each(|key| take(entry.place.clone(), key))?;
            blocks.extend(found);
        }
        let Some((kind, scenes)) = what else {
            let expected =
                "expected `scene = \"NAME\"` or `ditch = \"NAME\"`: a built-in name, or a path from this file";
            return Err(reader.error(0..0, expected.into()).into());
        };
        if scenes.len() > 1 {
            let rows = scenes.iter().map(|[given, _]| vec![Value::String(given.clone())]).collect();
            blocks.insert(0, Block { keys: vec![SCENE_AXIS.into()], rows });
        }
        Ok(SweepFile { path: path.to_path_buf(), kind, scenes, sets, blocks, tabulate })
    }

    /// The keys of all axes.
    pub fn keys(&self) -> Vec<String> {
        self.blocks.iter().flat_map(|block| block.keys.clone()).collect()
    }

    /// The values of all points, shape (points, keys).
    ///
    /// # Errors
    /// Too many points.
    pub fn rows(&self) -> Result<Vec<Vec<Value>>, SweepError> {
        product(&self.blocks).ok_or_else(|| {
            let sizes: Vec<String> = self.blocks.iter().map(|block| block.rows.len().to_string()).collect();
            SweepError::Input(format!(
                "{}: {} points: expected at most {MOST_POINTS}",
                self.path.display(),
                sizes.join(" x ")
            ))
        })
    }
}

/// Name of the axis of several scenes.
pub(super) const SCENE_AXIS: &str = "scene";

/// A `--set` argument.
pub(super) fn assignment(key: &str, value: &Value) -> String {
    format!("{key}={value}")
}

/// Scenes: built-in names stay, paths lead from the sweep file's folder.
fn scenes(
    reader: &TomlReader<'_>,
    entry: &Entry<'_>,
    word: &str,
    folder: &Path,
) -> Result<(Kind, Vec<[String; 2]>), SceneError> {
    let (kind, builtin) = match word {
        "ditch" => (Kind::Ditch, ditching::builtin()),
        _ => (Kind::Run, scene::builtin()),
    };
    let place = |name: String| {
        let path = folder.join(&name);
        let known = builtin.iter().any(|(builtin, _)| *builtin == name);
        match (known, path.is_file()) {
            (true, _) => Ok([name.clone(), name]),
            (false, true) => Ok([name, path.to_string_lossy().into_owned()]),
            (false, false) => {
                let names = builtin.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
                let expected = format!("a built-in name ({names}), or the path of a file from {}", folder.display());
                Err(reader.unexpected(word, entry.value, &expected))
            }
        }
    };
    Ok((kind, reader.strings(word, entry.value)?.into_iter().map(place).collect::<Result<_, _>>()?))
}

/// `[[zip]]` or `[zip]`.
fn zips(reader: &TomlReader<'_>, entry: &Entry<'_>) -> Result<Vec<Block>, SceneError> {
    let toml::de::DeValue::Array(items) = entry.value.get_ref() else {
        return Ok(vec![zip(reader, entry)?]);
    };
    items.iter().map(|value| zip(reader, &Entry { value, ..entry.clone() })).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<SweepFile, String> {
        SweepFile::parse(Path::new("/nowhere/s.toml"), "s.toml", text).map_err(|e| e.to_string())
    }

    fn rows(text: &str) -> Vec<String> {
        let rows = parse(text).expect("a sweep").rows().expect("few points");
        rows.iter().map(|row| row.iter().map(Value::to_string).collect::<Vec<_>>().join(" ")).collect()
    }

    #[test]
    fn axes_multiply_in_the_order_of_the_file() {
        let grid = "scene = \"wedge\"\n[grid]\nbody.mass = [200, 241.5]\nb = { from = 1, to = 3, count = 3 }\na = { from = 0.1, to = 0.3, step = 0.1 }";
        let all = rows(grid);
        assert_eq!(all.len(), 18);
        assert_eq!((all[0].as_str(), all[1].as_str(), all[17].as_str()), ("200 1 0.1", "200 1 0.2", "241.5 3 0.3"));
        assert_eq!(
            rows("scene = \"wedge\"\n[grid]\na = { from = 1.0, to = 100, count = 3, scale = \"log\" }"),
            ["1.0", "10.0", "100.0"]
        );
        assert_eq!(rows("scene = \"wedge\"\n[[zip]]\na = [1, 2]\n\"b[1]\" = [\"x\", true]"), ["1 \"x\"", "2 true"]);
        assert_eq!(rows("scene = \"wedge\""), [""]);
        let cube = "scene = \"wedge\"\n[latin_hypercube]\nsamples = 5\nkeys.a = [0, 1]\nkeys.b = { from = -1, to = -100, scale = \"log\" }";
        assert_eq!(rows(cube).len(), 5);
    }

    #[test]
    fn mistakes_are_told_with_their_line() {
        for (text, expected) in [
            ("scene = \"wedgy\"", "s.toml:1: `scene` = \"wedgy\": expected a built-in name"),
            ("[grid]\na = [1]", "s.toml:1: expected `scene = \"NAME\"`"),
            ("scene = \"wedge\"\n[grid]\na = 3", "s.toml:3: `a` = 3: expected a list of values"),
            ("scene = \"wedge\"\n[grid]\na = []", "s.toml:3: `a` = []: expected at least one value"),
            ("scene = \"wedge\"\n[grid]\na = { from = 1, to = 2 }", "expected `count` or `step`"),
            ("scene = \"wedge\"\n[grid]\na = { from = 1, to = 2, step = -1 }", "expected a step that leads"),
            ("scene = \"wedge\"\n[grid]\na = { from = -1, to = 2, count = 3, scale = \"log\" }", "of the same sign"),
            (
                "scene = \"wedge\"\n[grid]\na = { from = 1, too = 2, count = 3 }",
                "unknown key `too`: expected one of from",
            ),
            ("scene = \"wedge\"\n[set]\na = 1\n[grid]\na = [1, 2]", "s.toml:4: `a` stands twice"),
            (
                "scene = \"wedge\"\n[[zip]]\na = [1, 2]\nb = [1]",
                "s.toml:4: `b` = [1]: expected as many values as `a`: 2, not 1",
            ),
            ("scene = \"wedge\"\n[zip]\n", "s.toml:2: [zip]: expected at least one key"),
            ("scene = \"wedge\"\n[latin_hypercube]\nkeys.a = [0, 1]", "expected `samples`"),
            (
                "scene = \"wedge\"\n[gird]\na = [1]",
                "s.toml:2: unknown key `gird`: expected one of scene, ditch, tabulate, set, grid, zip, latin_hypercube, perhaps `grid`",
            ),
            ("scene = \"wedge\"\nditch = \"mercure\"", "`scene` or `ditch`, not both"),
            ("scene = ", "s.toml:1: not valid TOML"),
        ] {
            let said = parse(text).expect_err(text);
            assert!(said.contains(expected), "{text}\n{said}");
        }
        let many =
            "scene = \"wedge\"\n[grid]\na = { from = 1, to = 2, count = 1000 }\nb = { from = 1, to = 2, count = 1000 }";
        assert!(parse(many).expect("a sweep").rows().is_err_and(|e| e.to_string().contains("1000 x 1000 points")));
    }
}
