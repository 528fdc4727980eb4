//! From a name or a path to a scene.

use std::fs;
use std::io::ErrorKind;

use fsi_coupling::settings::{Problem, significant};
use serde_json::Value;
use sph_core::Solver;

use super::builtin::builtin;
use super::check::check;
use super::draft::Draft;
use super::dropped::refuse_dropped;
use super::error::SceneError;
use super::estimate::{BYTES_PER_PARTICLE, memory_estimate, particle_estimate};
use super::limits::check_step;
use super::resolve::resolve;
use super::resolve_model::{Ask, check_model, settle_auto, settle_solver};
use super::settings::{Scene, schema};
use super::source::Source;
use super::warnings::warnings;

/// Whether steps at which the scheme is known to break down are refused (THEORY WC16).
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
    /// Warnings, in plain words.
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

/// As [`load`], but steps at which the scheme is known to break down are let through (THEORY WC16): for maps of where that is.
pub fn load_beyond_limits(name_or_path: &str, sets: &[String]) -> Result<Loaded, SceneError> {
    let (name, text) = text_of(name_or_path)?;
    load_under(&name, &text, sets, Limits::Ignored)
}

/// Loads a scene from its text; `name` stands for the file in messages.
pub fn load_text(name: &str, text: &str, sets: &[String]) -> Result<Loaded, SceneError> {
    load_under(name, text, sets, Limits::Kept)
}

fn load_under(name: &str, text: &str, sets: &[String], limits: Limits) -> Result<Loaded, SceneError> {
    let source = Source { name: name.to_string(), text: text.to_string(), sets: sets.to_vec(), schema: schema() };
    let given = source.read()?;
    let scene = checked(given.clone(), limits).map_err(|problem| source.error(problem))?;
    let warnings = ignored(&given, &scene).into_iter().chain(warnings(&scene)).collect();
    Ok(Loaded { warnings, scene, source })
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

fn checked(mut given: Value, limits: Limits) -> Result<Scene, Problem> {
    refuse_dropped(&mut given)?;
    settle_solver(&mut given)?;
    let draft = draft_of(&given)?;
    match Ask::of(&given, &draft)? {
        Some(ask) => settle_auto(&given, ask, |given| sensible(draft_of(given)?, limits), draft_of),
        None => check_model(sensible(draft, limits)?),
    }
}

/// Options that are on and that the solver ignores.
fn ignored(given: &Value, scene: &Scene) -> Vec<String> {
    let solver = scene.solver.name();
    let on = |key: &&&str| given.pointer(&format!("/fluid/{key}")) == Some(&Value::Bool(true));
    let ignored: &[&str] = match scene.solver.kind() {
        Solver::WeaklyCompressible => &[],
        Solver::IncompressibleThesis => &["ventilation", "wall_stretch"],
        Solver::Incompressible | Solver::IncompressibleExplicit => &["wall_stretch"],
    };
    ignored.iter().filter(on).map(|key| format!("fluid.{key} = true does nothing with solver = {solver:?}")).collect()
}

fn draft_of(given: &Value) -> Result<Draft, Problem> {
    let mut draft = Draft::of(given, schema())?;
    draft.fill("solver", "weakly_compressible".to_string());
    Ok(draft)
}

/// The scene of a draft, if it makes sense as a whole.
fn sensible(draft: Draft, limits: Limits) -> Result<Scene, Problem> {
    let scene = resolve(draft)?;
    if limits == Limits::Kept {
        check_step(&scene)?;
    }
    check(&scene)?;
    Ok(scene)
}
