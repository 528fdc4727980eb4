//! What is given an input, and how it must end.

use std::fs;
use std::panic::{catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};

use run::compare;
use scenarios::experiments::catalogue::{Case, Catalogue};
use scenarios::experiments::convergence::{Plan, study};
use scenarios::experiments::{ExperimentError, coverage, stability, validation, work_precision};
use scenarios::sweep::{SweepError, SweepFile};
use scenarios::{ditching, preflight};
use scene::{Loaded, SceneError, reference};

/// Scenes that need more are not laid out [bytes].
const MEMORY: u64 = 128 << 20;
/// Landings with more strips in all their steps are not followed.
const MOST_STRIPS: f64 = 3e5;

/// Reader of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The text of a scene.
    Scene,
    /// A scene's name on the first line, a `--set` argument on each other.
    Set,
    /// The text of a landing.
    Landing,
    /// A landing's name and its `--set` arguments.
    LandingSet,
    /// A CSV table that a scene compares with.
    Table,
    /// A stability map.
    Map,
    /// A work-precision chart.
    Chart,
    /// A case of error bars.
    Bands,
    /// A validation case.
    Validation,
    /// Arguments of a study: spacings, sound speeds, a scene's name, `--set` arguments.
    Study,
    /// A sweep file.
    Sweep,
}

/// An input and its reader.
#[derive(Clone, Debug)]
pub struct Input {
    pub target: Target,
    pub text: String,
}

/// The runs of a study have begun: its arguments are accepted.
struct Begun;

impl Target {
    pub const ALL: [Target; 11] = [
        Target::Scene,
        Target::Set,
        Target::Landing,
        Target::LandingSet,
        Target::Table,
        Target::Map,
        Target::Chart,
        Target::Bands,
        Target::Validation,
        Target::Study,
        Target::Sweep,
    ];

    /// Its folder in the corpus.
    pub fn name(self) -> &'static str {
        match self {
            Target::Scene => "scene",
            Target::Set => "set",
            Target::Landing => "landing",
            Target::LandingSet => "landing_set",
            Target::Table => "table",
            Target::Map => "map",
            Target::Chart => "chart",
            Target::Bands => "bands",
            Target::Validation => "validation",
            Target::Study => "study",
            Target::Sweep => "sweep",
        }
    }
}

impl Input {
    /// Writes the input into a folder of its target, named by its text.
    pub fn keep(&self, folder: &Path) -> PathBuf {
        let hash =
            self.text.bytes().fold(0xcbf2_9ce4_8422_2325u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3));
        let folder = folder.join(self.target.name());
        fs::create_dir_all(&folder).expect("a folder");
        let path = folder.join(format!("{hash:016x}"));
        fs::write(&path, &self.text).expect("written");
        path
    }

    /// True for an input that is accepted, false for one that is refused as it should be.
    ///
    /// # Errors
    /// What is wrong with the message, or with what is accepted.
    pub fn judge(&self) -> Result<bool, String> {
        let text = &self.text;
        match self.target {
            Target::Scene => of_scene("fuzz.toml:", run::load_text("fuzz.toml", text, &[])),
            Target::Set => {
                let (name, sets) = name_and_sets(text);
                of_scene(&format!("{name}.toml:"), run::load(&name, &sets))
            }
            Target::Landing => of_landing("fuzz.toml:", ditching::load_text("fuzz.toml", text, &[])),
            Target::LandingSet => {
                let (name, sets) = name_and_sets(text);
                of_landing(&format!("{name}.toml:"), ditching::load(&name, &sets))
            }
            Target::Table => of_table(text),
            Target::Map => of_case(&stability::MAPS, text),
            Target::Chart => of_case(&work_precision::CHARTS, text),
            Target::Bands => of_case(&coverage::CASES, text),
            Target::Validation => of_case(&validation::CASES, text),
            Target::Study => of_study(text),
            Target::Sweep => of_sweep(text),
        }
    }
}

fn name_and_sets(text: &str) -> (String, Vec<String>) {
    let mut lines = text.lines().map(str::to_string);
    (lines.next().unwrap_or_default(), lines.collect())
}

/// A message names its place and what is expected, and can be drawn.
fn refused(place: &str, error: SceneError) -> Result<bool, String> {
    let text = error.to_string();
    let line = text.strip_prefix(place).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    let names =
        text.starts_with("--set ") || line || matches!(error, SceneError::Unknown { .. } | SceneError::Mistaken { .. });
    let expects = ["expected", "not valid TOML", "is missing", "neither"].iter().any(|word| text.contains(word));
    let drawn = format!("{:?}", miette::Report::new(error));
    match names && expects && !drawn.is_empty() {
        true => Ok(false),
        false => Err(format!("the message names no place, or nothing expected: {}", short(&text))),
    }
}

fn of_scene(place: &str, loaded: Result<Loaded, SceneError>) -> Result<bool, String> {
    let loaded = match loaded {
        Ok(loaded) => loaded,
        Err(error) => return refused(place, error),
    };
    if let Err(error) = loaded.fits_in_memory(MEMORY) {
        return refused(place, error).map(|_| true);
    }
    preflight::preflight(&loaded.scene, &loaded.warnings).to_text();
    let written = loaded.scene.to_toml();
    match run::load_text("resolved.toml", &written, &[]) {
        Ok(_) => Ok(true),
        Err(error) => Err(format!("scene.resolved.toml is refused: {}", short(&error.to_string()))),
    }
}

fn of_landing(place: &str, loaded: Result<ditching::Scene, SceneError>) -> Result<bool, String> {
    let scene = match loaded {
        Ok(scene) => scene,
        Err(error) => return refused(place, error),
    };
    if scene.landing.end / scene.landing.step * scene.landing.strips as f64 <= MOST_STRIPS {
        let landed = ditching::follow(&scene);
        landed.summary.to_text();
        ditching::section_scenes(&scene, &landed, 3);
    }
    match ditching::load_text("resolved.toml", &scene.to_toml(), &[]) {
        Ok(_) => Ok(true),
        Err(error) => Err(format!("scene.resolved.toml is refused: {}", short(&error.to_string()))),
    }
}

/// A scene compares with the table; its first two columns are read.
fn of_table(text: &str) -> Result<bool, String> {
    let folder = temp_dir::TempDir::new().expect("a folder");
    let (file, scene_file) = (folder.path().join("own.csv"), folder.path().join("own.toml"));
    fs::write(&file, text).expect("written");
    let columns: Vec<&str> = text.lines().find(|line| !line.starts_with('#')).unwrap_or("").split(',').collect();
    let (x, y) = (columns[0].trim(), columns.get(1).unwrap_or(&"").trim());
    let quoted = |word: &str| format!("{}", serde_json::Value::from(word)).replace('\u{7f}', "");
    let (_, wedge) = scene::builtin().iter().find(|(name, _)| *name == "wedge").expect("a scene");
    let compare = format!(
        "[[compare]]\nreference = \"own.csv\"\nquantity = \"wedge.vy_m_per_s\"\nx = {}\ny = {}\n",
        quoted(x),
        quoted(y)
    );
    let name = scene_file.display().to_string();
    let loaded = match run::load_text(&name, &format!("{wedge}\n{compare}"), &[]) {
        Ok(loaded) => loaded,
        Err(error) => return refused(&format!("{name}:"), error),
    };
    let last = loaded.scene.compare.last().ok_or("the comparison is gone")?;
    compare::curve(last).map_err(|e| format!("a table that was accepted is refused: {e}"))?;
    reference::Table::load(&file.display().to_string()).map(|_| true).map_err(|e| e.to_string())
}

fn of_case<C: Case>(cases: &Catalogue<C>, text: &str) -> Result<bool, String> {
    let folder = temp_dir::TempDir::new().expect("a folder");
    let file = folder.path().join("own.toml");
    fs::write(&file, text).expect("written");
    match cases.select(&[file.display().to_string()]) {
        Ok(_) => Ok(true),
        Err(error) => {
            let said = error.to_string();
            let names = said.contains("own") && said.len() > 30;
            if names { Ok(false) } else { Err(format!("the message names no file: {}", short(&said))) }
        }
    }
}

/// The points of a sweep file; their scenes are inputs of another target.
fn of_sweep(text: &str) -> Result<bool, String> {
    match SweepFile::parse(Path::new("fuzz.toml"), "fuzz.toml", text).and_then(|file| file.rows()) {
        Ok(rows) if rows.iter().all(|row| row.len() == rows[0].len()) => Ok(true),
        Ok(_) => Err("rows of different lengths".into()),
        Err(SweepError::Scene(error)) => refused("fuzz.toml:", error),
        Err(error) if error.to_string().contains("expected") => Ok(false),
        Err(error) => Err(format!("a message without what is expected: {error}")),
    }
}

fn of_study(text: &str) -> Result<bool, String> {
    let mut lines = text.splitn(3, '\n');
    let mut numbers = || -> Vec<f64> {
        let line = lines.next().unwrap_or_default();
        line.split(',').filter_map(|word| word.trim().parse().ok()).collect()
    };
    let (spacings, sound_speeds) = (numbers(), numbers());
    let (scene, sets) = name_and_sets(lines.next().unwrap_or_default());
    let place = format!("{scene}.toml:");
    let plan = Plan { scene, sets, quantity: "peaks/none".into(), spacings, sound_speeds };
    let made = catch_unwind(|| study(&plan, |_, _, _, _| resume_unwind(Box::new(Begun))).map(|_| ()));
    match made {
        Err(payload) if payload.is::<Begun>() => Ok(true),
        Err(payload) => resume_unwind(payload),
        Ok(Ok(())) => Err("a study without runs".into()),
        Ok(Err(ExperimentError::Scene(error))) => refused(&place, error),
        Ok(Err(error @ ExperimentError::Input { .. })) => {
            let text = error.to_string();
            if text.contains("expected") { Ok(false) } else { Err(format!("nothing expected: {}", short(&text))) }
        }
        Ok(Err(error)) => Err(format!("not an error of input: {}", short(&error.to_string()))),
    }
}

fn short(text: &str) -> String {
    text.chars().take(400).collect()
}
