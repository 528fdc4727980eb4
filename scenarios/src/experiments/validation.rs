//! `splashdown validate`: numbers of a run against measured and exact values.
//!
//! A case is a TOML file in `scenarios/cases/validation`: a scene, overrides, and the values that its `summary.json` must
//! have. A case contains no source code.

use std::path::PathBuf;

use include_dir::{Dir, include_dir};
use report::{Column, Table};
use run::{self, RunOptions};
use scene::Scene;
use serde::{Deserialize, Serialize};

use super::catalogue::{self, Catalogue};
use super::runs::RunRecord;
use super::{ExperimentError, yes};

static FOLDER: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/cases/validation");

/// The validation cases.
pub static CASES: Catalogue<Case> = Catalogue::new("validation case", "validate", &FOLDER);

/// A validation case.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Name, that of its file.
    #[serde(skip)]
    pub name: String,
    /// What is shown.
    pub about: String,
    /// Name of a built-in scene, or path of a scene file.
    pub scene: String,
    /// Overrides, as for `--set`.
    #[serde(default)]
    pub set: Vec<String>,
    /// Require every judged comparison of the scene to pass.
    #[serde(default)]
    pub comparisons: bool,
    /// Numbers that must hold.
    #[serde(default, alias = "number")]
    pub expect: Vec<Expect>,
    /// A coarser run of the same, whose errors must be larger.
    pub coarser: Option<Coarser>,
}

/// A number of `summary.json` and its allowed range: near a reference, or within bounds.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expect {
    /// Path in `summary.json`, keys joined by `/`.
    #[serde(alias = "path")]
    pub value: String,
    /// The reference value.
    #[serde(alias = "exact")]
    pub reference: Option<f64>,
    /// Largest relative difference from the reference [-].
    pub tolerance: Option<f64>,
    /// Largest magnitude.
    pub at_most: Option<f64>,
    /// Source of the reference.
    pub source: String,
}

/// A coarser run.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coarser {
    /// Further overrides.
    pub set: Vec<String>,
    /// Paths of expected numbers whose error must fall from the coarser run to the finer: the relative error
    /// where the number has a reference, else the number itself.
    pub error_falls: Vec<String>,
    /// Errors below this level need not fall any further.
    #[serde(default)]
    pub noise: f64,
}

/// A line of the table.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Line {
    /// The case.
    pub case: String,
    /// The number.
    pub quantity: String,
    /// Its value in the run.
    pub ours: f64,
    /// Its reference.
    pub theirs: String,
    /// The error, where there is a reference.
    pub error: Option<f64>,
    /// The allowed range.
    pub allowed: String,
    /// Whether it holds.
    pub holds: bool,
    /// Source of the reference.
    pub source: String,
    /// Core-seconds of the case's run.
    pub core_seconds: f64,
}

impl catalogue::Case for Case {
    fn title(&self) -> [&str; 2] {
        [&self.name, &self.about]
    }

    fn rename(&mut self, name: String) {
        self.name = name;
    }
}

/// Run a case; its files go to a folder of its name under `out`, if one is given.
///
/// # Errors
/// The scene is wrong, or its run could not be made.
pub fn validate(case: &Case, out: Option<&PathBuf>) -> Result<Vec<Line>, ExperimentError> {
    let (scene, run) = run_with(case, &[], out.map(|dir| dir.join(&case.name)))?;
    let mut lines: Vec<Line> = case.expect.iter().map(|e| judge(e, &run)).collect();
    if case.comparisons {
        let judged = run.summary.comparison.iter().filter(|c| c.tolerance.is_some());
        lines.extend(judged.clone().map(|c| Line {
            quantity: c.quantity.clone(),
            ours: c.ours,
            theirs: number(c.theirs),
            error: Some(c.error),
            allowed: c.tolerance.map_or(String::new(), number),
            holds: c.passes(),
            source: c.reference.clone(),
            ..Line::default()
        }));
        let (judged, asked) = (judged.count(), scene.compare.iter().filter(|c| c.tolerance.is_some()).count());
        lines.extend((judged < asked).then(|| Line {
            quantity: "comparisons that the run could be judged by".into(),
            ours: judged as f64,
            theirs: number(asked as f64),
            allowed: "all".into(),
            source: case.scene.clone(),
            ..Line::default()
        }));
    }
    if let Some(coarser) = &case.coarser {
        let coarse = run_with(case, &coarser.set, None)?.1;
        lines.extend(coarser.error_falls.iter().map(|path| falls(case, coarser, path, &run, &coarse)));
    }
    for line in &mut lines {
        (line.case, line.core_seconds) = (case.name.clone(), run.core_seconds());
        line.holds &= run.summary.status.is_completed();
    }
    Ok(lines)
}

fn run_with(case: &Case, further: &[String], out: Option<PathBuf>) -> Result<(Scene, RunRecord), ExperimentError> {
    let loaded = run::load(&case.scene, &[&case.set, further].concat())?;
    let options = RunOptions {
        out,
        force: true,
        page: Some(report::page_of_run),
        warnings: loaded.warnings,
        ..RunOptions::default()
    };
    let summary = run::run(&loaded.scene, &options)?.summary;
    Ok((loaded.scene, RunRecord::new(summary)))
}

fn judge(expect: &Expect, run: &RunRecord) -> Line {
    let ours = run.numbers.get(&expect.value).unwrap_or(f64::NAN);
    let error = expect.reference.map(|r| ours / r - 1.0);
    let near = match (error, expect.tolerance) {
        (Some(error), Some(tolerance)) => error.abs() <= tolerance,
        _ => expect.at_most.is_some(), // a number without a bound is not judged: it does not hold
    };
    let bounded = expect.at_most.is_none_or(|bound| ours.abs() <= bound);
    let mut allowed = Vec::new();
    allowed.extend(expect.tolerance.map(|t| format!("{} %", number(100.0 * t))));
    allowed.extend(expect.at_most.map(|b| format!("at most {}", number(b))));
    Line {
        quantity: expect.value.clone(),
        ours,
        theirs: expect.reference.map_or(String::new(), number),
        error,
        allowed: allowed.join(", "),
        holds: near && bounded && ours.is_finite(),
        source: expect.source.clone(),
        ..Line::default()
    }
}

fn falls(case: &Case, coarser: &Coarser, path: &str, fine: &RunRecord, coarse: &RunRecord) -> Line {
    let reference = case.expect.iter().find(|e| e.value == path).and_then(|e| e.reference);
    let error = |run: &RunRecord| {
        let value = run.numbers.get(path).unwrap_or(f64::NAN);
        reference.map_or(value, |r| value / r - 1.0)
    };
    let (ours, theirs, noise) = (error(fine), error(coarse), coarser.noise);
    Line {
        quantity: format!("{path}, error against the coarser run's"),
        ours,
        theirs: number(theirs),
        allowed: if noise > 0.0 { format!("smaller, or both below {}", number(noise)) } else { "smaller".into() },
        holds: ours.abs() < theirs.abs() || ours.abs().max(theirs.abs()) < noise,
        source: coarser.set.join(" "),
        ..Line::default()
    }
}

/// The table as Markdown.
pub fn table(lines: &[Line]) -> String {
    let columns: &[Column<&Line>] = &[
        ("case", |l| l.case.clone()),
        ("quantity", |l| l.quantity.clone()),
        ("ours", |l| number(l.ours)),
        ("reference", |l| l.theirs.clone()),
        ("error", |l| l.error.map_or(String::new(), |e| format!("{:+.2} %", 100.0 * e))),
        ("allowed", |l| l.allowed.clone()),
        ("holds", |l| yes(l.holds)),
        ("core-s", |l| format!("{:.0}", l.core_seconds)),
        ("source", |l| l.source.clone()),
    ];
    Table::of("", lines, columns).markdown()
}

/// Six digits; in powers of ten outside 10⁻³ to 10⁶.
fn number(x: f64) -> String {
    if x == 0.0 {
        "0".into()
    } else if (1e-3..1e6).contains(&x.abs()) {
        let digits = (5.0 - x.abs().log10().floor()).max(0.0) as usize;
        let text = format!("{x:.digits$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
    } else {
        format!("{x:.2e}")
    }
}
