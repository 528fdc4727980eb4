//! Landings that a ditching rule asks for: the list of cases from one file, run as a batch that goes on where it was cut; envelopes, worst cases, a dossier.
//!
//! [`Plan::read`] reads a landing with its table `[certify]` and makes the list; [`batch`] runs it; [`Findings`] has envelopes, reasons and answers to the
//! rule's paragraphs; [`dossier`] is their page. A case is a landing with other values of its keys, the same as `splashdown ditch FILE --set …`.

pub mod batch;
mod cases;
mod choices;
mod dossier;
mod dossier_tables;
mod envelope;
mod findings;
mod quantity;
mod record;
mod rule;
mod tables;

use std::path::Path;

use scene::mistaken_file::Expected;
use scene::source::Source;
use scene::{SceneError, read_text};
use serde::Serialize;
use serde_json::Value;
use sha2::{Digest, Sha256};

pub use cases::Case;
pub use choices::{Choices, Input};
pub use dossier::dossier;
pub use envelope::{Envelope, Extreme, Reason};
pub use findings::Findings;
pub use quantity::Quantity;
pub use record::{Ended, Record};
pub use rule::{Answer, Evidence, Rule, evidence};
pub use tables::{cases_csv, pressure_csv};

use crate::ditching::{self, Scene};

/// Time of one core for a strip and a step of a landing [s], measured; for the estimate of the cost.
const CORE_SECONDS: f64 = 3.7e-6;

/// A file that was read, and its hash.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HashedFile {
    /// Its name as given.
    pub file: String,
    /// SHA-256 of its bytes.
    pub sha256: String,
}

/// What is to be run.
pub struct Plan {
    /// The landing file, or the name of a built-in one.
    pub file: String,
    /// Overrides from the command line.
    pub given: Vec<String>,
    /// The landing.
    pub scene: Scene,
    /// The lists.
    pub choices: Choices,
    /// The cases that are run.
    pub cases: Vec<Case>,
    /// Number of all combinations.
    pub combinations: usize,
    /// The files that were read.
    pub files: Vec<HashedFile>,
}

/// SHA-256 in hexadecimal digits.
fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

impl Plan {
    /// The list of cases of a landing by its name or path, with `--set` arguments.
    ///
    /// # Errors
    /// The file cannot be read, or its first mistake.
    pub fn read(file: &str, given: &[String]) -> Result<Plan, SceneError> {
        let scene = ditching::load(file, given)?;
        let source = Source::find(Expected::Landing, ditching::builtin(), file, given, ditching::schema())?;
        let as_given = source.read()?;
        let speed_is_given = as_given["landing"].get("speed").is_some();
        let choices = Choices::new(&scene, speed_is_given).map_err(|problem| source.error(problem))?;
        let (cases, combinations) = cases::cases(&scene, &choices).map_err(|problem| source.error(problem))?;
        let files = hashed(&source, &as_given);
        Ok(Plan { file: file.to_string(), given: given.to_vec(), scene, choices, cases, combinations, files })
    }

    /// What the records of these cases begin with: other values, another program, another list are other cases.
    pub fn head(&self) -> String {
        let cases = serde_json::to_string(&self.cases).unwrap_or_default();
        let of_cases = sha256((self.scene.to_toml() + &cases).as_bytes());
        let head = (env!("CARGO_PKG_VERSION"), &self.scene.name, self.cases.len(), of_cases);
        serde_json::to_string(&head).unwrap_or_default()
    }

    /// Estimated time on one core, at most [s]: a case that ends early takes less.
    pub fn core_seconds(&self) -> f64 {
        let landing = &self.scene.landing;
        let tried = self.cases.iter().filter(|case| case.outside.is_none()).count();
        CORE_SECONDS * tried as f64 * landing.strips as f64 * landing.end / landing.step
    }

    /// Run a case.
    pub fn run(&self, case: &Case) -> Record {
        Record::of(&self.file, &self.given, case)
    }

    /// The command that repeats a case.
    pub fn command(&self, case: &Case) -> String {
        let quoted = |set: &String| match set.contains([' ', '[', '{', '"']) {
            true => format!(" --set '{set}'"),
            false => format!(" --set {set}"),
        };
        let sets: String = self.given.iter().chain(&case.sets).map(quoted).collect();
        format!("splashdown ditch {}{sets} --out runs/case_{}", self.file, case.number)
    }
}

/// The landing file and the outlines that it names.
fn hashed(source: &Source, given: &Value) -> Vec<HashedFile> {
    let landing = HashedFile { file: source.name.clone(), sha256: sha256(source.text.as_bytes()) };
    let folder = Path::new(&source.name).parent().unwrap_or(Path::new(""));
    let mut outlines: Vec<&str> =
        given["stations"].as_array().into_iter().flatten().filter_map(|s| s["outline"].as_str()).collect();
    outlines.dedup();
    let outline = |name: &str| {
        let text = read_text(folder.join(name)).ok()?;
        Some(HashedFile { file: name.to_string(), sha256: sha256(text.as_bytes()) })
    };
    std::iter::once(landing).chain(outlines.into_iter().filter_map(outline)).collect()
}
