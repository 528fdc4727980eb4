//! From a name or a path to a scene.

use std::fs;
use std::io::ErrorKind;

use serde_path_to_error as tracked;
use toml::{Table, Value};

use super::builtin::builtin;
use super::check::check;
use super::error::SceneError;
use super::estimate::{BYTES_PER_PARTICLE, memory_estimate, particle_estimate};
use super::file::SceneFile;
use super::keywords;
use super::limits::check_step;
use super::model::Scene;
use super::overrides::apply_set;
use super::problem::{Problem, significant};
use super::resolve::resolve;
use super::resolve_model::{Ask, check_model, settle_auto};
use super::source::Source;
use super::warnings::warnings;

/// Beyond any length [m], time [s], mass [kg/m] or factor of a scene.
const LARGEST_NUMBER: f64 = 1e12;

/// Whether steps at which the scheme is known to break down are refused (THEORY H4).
#[derive(Clone, Copy, PartialEq, Eq)]
enum Limits {
    Kept,
    Ignored,
}

/// A scene that can be run, and what is doubtful about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// The resolved scene.
    pub scene: Scene,
    /// Doubts, in plain words.
    pub warnings: Vec<String>,
    source: Source,
}

/// Loads a built-in scene by its name, or a scene file by its path, with `--set` arguments applied in their order.
pub fn load(name_or_path: &str, sets: &[String]) -> Result<Loaded, SceneError> {
    let (name, text) = text_of(name_or_path)?;
    load_text(&name, &text, sets)
}

/// The file's name and text of a built-in scene, or of one by its path.
fn text_of(name_or_path: &str) -> Result<(String, String), SceneError> {
    if let Some((name, text)) = builtin().iter().find(|(name, _)| *name == name_or_path) {
        return Ok((format!("{name}.toml"), text.to_string()));
    }
    let text = fs::read_to_string(name_or_path).map_err(|cause| match cause.kind() {
        ErrorKind::NotFound => {
            let names: Vec<&str> = builtin().iter().map(|(name, _)| *name).collect();
            SceneError::Unknown {
                name: name_or_path.to_string(),
                help: format!("built-in scenes: {}", names.join(", ")),
            }
        }
        _ => SceneError::Unreadable { path: name_or_path.to_string(), cause },
    })?;
    Ok((name_or_path.to_string(), text))
}

/// As [`load`], but steps at which the scheme is known to break down are let through (THEORY H4): for maps of where that is.
pub fn load_beyond_limits(name_or_path: &str, sets: &[String]) -> Result<Loaded, SceneError> {
    let (name, text) = text_of(name_or_path)?;
    load_under(&name, &text, sets, Limits::Ignored)
}

/// Loads a scene from its text; `name` stands for the file in messages.
pub fn load_text(name: &str, text: &str, sets: &[String]) -> Result<Loaded, SceneError> {
    load_under(name, text, sets, Limits::Kept)
}

fn load_under(name: &str, text: &str, sets: &[String], limits: Limits) -> Result<Loaded, SceneError> {
    let source = Source { name: name.to_string(), text: text.to_string(), sets: sets.to_vec() };
    let mut table: Table = text.parse().map_err(|error| source.syntax_error(&error))?;
    for set in sets {
        apply_set(&mut table, set)?;
    }
    let scene = read(Value::Table(table), limits).map_err(|problem| source.error(problem))?;
    Ok(Loaded { warnings: warnings(&scene), scene, source })
}

impl Loaded {
    /// The file the scene was read from, or the name of a built-in scene's.
    pub fn source_name(&self) -> &str {
        &self.source.name
    }

    /// An error where the particles would need more than `limit` [bytes].
    pub fn fits_in_memory(&self, limit: u64) -> Result<(), SceneError> {
        let bytes = memory_estimate(&self.scene);
        if bytes <= limit || self.scene.model.is_theory() {
            return Ok(());
        }
        let (fluid, wall) = particle_estimate(&self.scene);
        let gib = |bytes: u64| significant(bytes as f64 / f64::from(1 << 30));
        let expected = format!(
            "a spacing that fits in {} GiB of memory: this one makes {fluid} fluid and {wall} wall particles of \
             {BYTES_PER_PARTICLE} bytes, {} GiB",
            gib(limit),
            gib(bytes)
        );
        let spacing = self.scene.resolution.spacing;
        Err(self.source.error(Problem::new("resolution.spacing", spacing, expected)))
    }
}

fn read(value: Value, limits: Limits) -> Result<Scene, Problem> {
    refuse_absurd_numbers("", &value)?;
    let file: SceneFile = tracked::deserialize(value).map_err(|error| unreadable(&error))?;
    let sensible = |file: SceneFile| {
        let scene = resolve(file)?;
        if limits == Limits::Kept {
            check_step(&scene)?;
        }
        check(&scene)?;
        Ok(scene)
    };
    match Ask::of(&file)? {
        Some(ask) => settle_auto(file, ask, sensible),
        None => check_model(sensible(file)?),
    }
}

/// TOML can say `nan`, `inf` and 1e300; no key of a scene can mean them, and sums of squares need not survive them.
fn refuse_absurd_numbers(path: &str, value: &Value) -> Result<(), Problem> {
    match value {
        Value::Float(number) if number.is_nan() || number.abs() > LARGEST_NUMBER => {
            Err(Problem::new(path, number, format!("a finite number up to {LARGEST_NUMBER:e}")))
        }
        Value::Array(items) => {
            let mut items = items.iter().enumerate();
            items.try_for_each(|(i, item)| refuse_absurd_numbers(&format!("{path}[{i}]"), item))
        }
        Value::Table(table) => table.iter().try_for_each(|(key, value)| {
            let dot = if path.is_empty() { "" } else { "." };
            refuse_absurd_numbers(&format!("{path}{dot}{key}"), value)
        }),
        _ => Ok(()),
    }
}

/// Serde's names of types in a user's words.
fn plain(complaint: &str) -> String {
    let said = complaint.replace("expected f64", "expected a number");
    let said = said.replace("expected u32", &format!("expected a whole number from 0 to {}", u32::MAX));
    let said = said.replace("expected i64", "expected a whole number");
    let said =
        said.replace("expected a sequence", "expected a list (of tables: a heading in double brackets, [[...]])");
    let said = said.replace("expected fewer elements in array", "expected two numbers");
    match said.split_once("expected struct ") {
        Some((given, _)) => format!("{given}expected a table of keys"),
        None => said,
    }
}

/// Serde's complaint about a value or a key.
fn unreadable(error: &tracked::Error<toml::de::Error>) -> Problem {
    let key = error.path().to_string();
    let complaint = error.inner().message();
    let sentence = match complaint.starts_with("unknown field") {
        false => format!("`{key}`: {}", plain(complaint)),
        true => match keywords::nearest(&key) {
            Some(known) => {
                format!("unknown key `{key}`: expected a key of a scene, such as `{known}`")
            }
            None => format!("unknown key `{key}`: expected a key of a scene"),
        },
    };
    Problem { key, sentence }
}
