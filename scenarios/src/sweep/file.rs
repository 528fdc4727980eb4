//! The sweep file: what is run, and over what.

use std::fs;
use std::path::{Path, PathBuf};

use scene::mistaken_file::{Expected, refuse_other_kind};
use scene::read_text;
use scene::source::{Source, refuse_absurd_numbers};
use serde::{Deserialize, Serialize};
use settings::Problem;
use toml::{Table, Value};

use super::axes::{Block, hypercube, product, toml, zip};
use super::error::SweepError;
use super::keys::{Keys, refused, schema, with_paths};
use crate::axis::MOST_POINTS;
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
        let source = Source { name: shown.into(), text: text.into(), sets: Vec::new(), schema: schema() };
        let table = source.table()?;
        Ok(SweepFile::of(path, &source, table).map_err(|problem| source.error(problem))?)
    }

    fn of(path: &Path, source: &Source, table: Table) -> Result<SweepFile, Problem> {
        for (key, value) in &table {
            match key.as_str() {
                "latin_hypercube" => {
                    value.get("keys").map_or(Ok(()), |keys| refuse_absurd_numbers("latin_hypercube.keys", keys))?
                }
                key => refuse_absurd_numbers(key, value)?,
            }
        }
        let given = with_paths(source, &table)?;
        let keys = Keys::deserialize(schema().check(&given)?);
        let keys = keys.map_err(|error| schema().missing("latin_hypercube", &error))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let (kind, scenes) = match (keys.scene, keys.ditch) {
            (Some(names), None) => (Kind::Run, scenes(names.placed("scene"), scene::builtin(), folder)?),
            (None, Some(names)) => (Kind::Ditch, scenes(names.placed("ditch"), ditching::builtin(), folder)?),
            (Some(_), Some(_)) => return Err(refused("ditch", "expected `scene` or `ditch`, not both")),
            (None, None) => {
                let expected =
                    "expected `scene = \"NAME\"` or `ditch = \"NAME\"`: a built-in name, or a path from this file";
                return Err(refused("", expected));
            }
        };
        let grid = keys.grid.iter().map(|axis| Ok(("grid", zip("grid", [axis])?)));
        let mut blocks = grid.collect::<Result<Vec<_>, Problem>>()?;
        for (path, axes) in keys.zip.map_or(Vec::new(), |zips| zips.placed("zip")) {
            blocks.push(("zip", zip(&path, &axes)?));
        }
        if let Some(cube) = &keys.latin_hypercube {
            blocks.push(("latin_hypercube", hypercube(cube)?));
        }
        blocks.sort_by_cached_key(|(table, _)| source.span(table).start);
        let mut blocks: Vec<Block> = blocks.into_iter().map(|(_, block)| block).collect();
        if scenes.len() > 1 {
            let rows = scenes.iter().map(|[given, _]| vec![Value::String(given.clone())]).collect();
            blocks.insert(0, Block { keys: vec![SCENE_AXIS.into()], rows });
        }
        let sets = keys.set.iter().map(|(key, value)| assignment(key, &toml(value))).collect();
        let tabulate = keys.tabulate.map_or(Vec::new(), |paths| paths.placed("tabulate"));
        let tabulate = tabulate.into_iter().map(|(_, path)| path).collect();
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
fn scenes(names: Vec<(String, String)>, builtin: &[(&str, &str)], folder: &Path) -> Result<Vec<[String; 2]>, Problem> {
    let place = |(key, name): (String, String)| {
        let path = folder.join(&name);
        match (builtin.iter().any(|(known, _)| *known == name), path.is_file()) {
            (true, _) => Ok([name.clone(), name]),
            (false, true) => Ok([name, path.to_string_lossy().into_owned()]),
            (false, false) => {
                let names = builtin.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
                let expected = format!("a built-in name ({names}), or the path of a file from {}", folder.display());
                Err(Problem::new(&key, format!("{name:?}"), expected))
            }
        }
    };
    names.into_iter().map(place).collect()
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
        let quoted = "scene = \"wedge\"\n[[zip]]\nz = [1]\n[grid]\n\"body.velocity[1]\" = [-4, -6]\nbody.mass = [1, 2]";
        assert_eq!(parse(quoted).expect("a sweep").keys(), ["z", "body.velocity[1]", "body.mass"]);
        assert_eq!(rows(quoted)[1], "1 -4 2");
        let tables = "scene = \"wedge\"\n[grid]\nbody.mass = [1, 2]\nfluid.alpha = [3, 4]\nbody.deadrise = [5, 6]";
        assert_eq!(parse(tables).expect("a sweep").keys(), ["body.mass", "body.deadrise", "fluid.alpha"]);
        let cube = "scene = \"wedge\"\n[latin_hypercube]\nsamples = 5\nkeys.a = [0, 1]\nkeys.b = { from = -1, to = -100, scale = \"log\" }";
        assert_eq!(rows(cube).len(), 5);
    }

    #[test]
    fn mistakes_are_reported_with_their_line() {
        for (text, expected) in [
            ("scene = \"wedgy\"", "s.toml:1: `scene` = \"wedgy\": expected a built-in name"),
            ("[grid]\na = [1]", "s.toml:1: expected `scene = \"NAME\"`"),
            ("scene = \"wedge\"\n[grid]\na = 3", "s.toml:3: `grid.a` = 3: expected a list of values, or a range"),
            ("scene = \"wedge\"\n[grid]\na = []", "s.toml:3: `grid.a` = []: expected at least one value"),
            ("scene = \"wedge\"\n[grid]\na = { from = 1, to = 2 }", "expected `count` or `step`"),
            (
                "scene = \"wedge\"\n[grid]\na = { from = 1, to = 2, step = -1 }",
                "expected a linear step from `from` to `to`",
            ),
            ("scene = \"wedge\"\n[grid]\na = { from = -1, to = 2, count = 3, scale = \"log\" }", "of the same sign"),
            (
                "scene = \"wedge\"\n[grid]\na = { from = 1, too = 2, count = 3 }",
                "s.toml:3: unknown key `grid.a.too`: expected a key of a sweep, such as `grid.KEY.to`",
            ),
            ("scene = \"wedge\"\n[set]\na = 1\n[grid]\na = [1, 2]", "s.toml:5: `a` stands twice"),
            (
                "scene = \"wedge\"\n[[zip]]\na = [1, 2]\nb = [1]",
                "s.toml:4: `zip[0].b` = [1]: expected as many values as `a`: 2, not 1",
            ),
            ("scene = \"wedge\"\n[zip]\n", "s.toml:2: [zip]: expected at least one key"),
            (
                "scene = \"wedge\"\n[latin_hypercube]\nkeys.a = [0, 1]",
                "s.toml:2: `latin_hypercube.samples` is missing: expected a whole number from 1 to 100000",
            ),
            (
                "scene = \"wedge\"\n[gird]\na = [1]",
                "s.toml:2: unknown key `gird`: expected a key of a sweep, such as `grid`",
            ),
            ("scene = \"wedge\"\nditch = \"mercure\"", "`scene` or `ditch`, not both"),
            (
                "scene = \"wedge\"\n[zip]\nb = [1, 2]\n\"a[1]\" = 3",
                "s.toml:4: `zip.a[1]` = 3: expected a list of values",
            ),
            (
                "scene = \"wedge\"\n[grid]\na = { to = 2, count = 3 }",
                "s.toml:3: `grid.a` = { count = 3, to = 2 }: expected both ends",
            ),
            ("scene = \"wedge\"\n[grid]\na.b = [1, inf]", "s.toml:3: `grid.a.b[1]` = inf: expected a finite number"),
            ("scene = \"wedge\"\n[grid]\na.b = [1]\n\"a.b\" = [2]", "`a.b` stands twice"),
            (
                "scene = \"wedge\"\n[latin_hypercube]\nsamples = 3\nkeys.a = [0, 0]",
                "s.toml:4: `latin_hypercube.keys.a` = [0, 0]: expected two different ends",
            ),
            ("scene = []", "s.toml:1: `scene` = an array of length 0: expected a list of at least one"),
            (
                "scene = \"wedge\"\n[latin_hypercube]\nsamples = 3",
                "s.toml:2: [latin_hypercube.keys]: expected at least one key with its ends",
            ),
            ("scene = [\"wedge\", 3]", "s.toml:1: `scene[1]` = 3: expected a string"),
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
