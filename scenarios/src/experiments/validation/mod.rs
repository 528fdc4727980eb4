//! `splashdown validate`: numbers of a run against measured and exact values.
//!
//! A case is a TOML file in `scenarios/cases/validation`: a scene, overrides, and the values that its `summary.json` must
//! have. A case contains no source code.

pub mod credibility;
pub mod data;
pub mod drift;
pub mod quantities;

use std::path::{Path, PathBuf};

use include_dir::{Dir, include_dir};
use report::{Column, Table};
use run::compare::Comparison;
use run::evidence::{Nature, Pedigree, Point, Quantity, Setup};
use run::numbers::Numbers;
use run::{self, RunOptions};
use scene::Scene;
use serde::{Deserialize, Serialize};
use water_entry::EntryModel;

use super::catalogue::{self, Catalogue};
use super::runs::RunRecord;
use super::{ExperimentError, yes};
use crate::{ditching, planing};

/// The model of landings, as points name it.
const LANDING: &str = "strips";

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
    #[serde(default)]
    pub scene: String,
    /// Landing instead of a scene, likewise.
    #[serde(default)]
    pub ditch: String,
    /// Planing hull instead of a scene, likewise.
    #[serde(default)]
    pub plane: String,
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
    /// Further runs of the same with overrides and numbers of their own.
    #[serde(default)]
    pub variant: Vec<Variant>,
}

/// A further run of a case.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Further overrides.
    pub set: Vec<String>,
    /// Numbers that must hold.
    pub expect: Vec<Expect>,
}

/// A number of `summary.json` and its allowed range: near a reference, or within bounds.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expect {
    /// Path in `summary.json`, keys joined by `/`.
    #[serde(alias = "path")]
    pub value: String,
    /// Further paths: the largest of all numbers counts.
    #[serde(default)]
    pub largest_of: Vec<String>,
    /// The reference value.
    #[serde(alias = "exact")]
    pub reference: Option<f64>,
    /// Largest relative difference from the reference [-].
    pub tolerance: Option<f64>,
    /// Largest magnitude.
    pub at_most: Option<f64>,
    /// Source of the reference.
    pub source: String,
    /// What the reference is; absent: what the header of the table says that `source` names, else an exact solution.
    pub nature: Option<Nature>,
    /// Relative standard uncertainty of the reference [-]; absent: as its table says, 0 for an exact one.
    pub uncertainty: Option<f64>,
    /// `false`: no evidence of a quantity, as a number that follows from another or is measured from an arbitrary height.
    pub evidence: Option<bool>,
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
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
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
    /// The number as evidence of a quantity; absent where it has no reference.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point: Option<Point>,
}

/// The bound of a number that is compared and not judged.
const NOT_JUDGED: &str = "not judged";

impl Line {
    /// Whether the number has a bound.
    pub fn is_judged(&self) -> bool {
        self.allowed != NOT_JUDGED
    }
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
    let out = out.map(|dir| dir.join(&case.name));
    let without_fluid = |further: &[String], expect: &[Expect]| match case.plane.is_empty() {
        true => of_landing(case, further, expect),
        false => of_hull(case, further, expect),
    };
    let is_scene = case.ditch.is_empty() && case.plane.is_empty();
    let mut lines = if is_scene { of_scene(case, out)? } else { without_fluid(&[], &case.expect)? };
    for variant in &case.variant {
        lines.extend(if is_scene {
            let (scene, run) = run_with(case, &variant.set, None)?;
            judged(&variant.expect, &scene, &run)
        } else {
            without_fluid(&variant.set, &variant.expect)?
        });
    }
    for line in &mut lines {
        line.case.clone_from(&case.name);
        line.point.iter_mut().for_each(|point| point.case.clone_from(&case.name));
    }
    Ok(lines)
}

/// The lines of a run: of the numbers that are expected.
fn judged(expect: &[Expect], scene: &Scene, run: &RunRecord) -> Vec<Line> {
    let of = |e| judge(e, &run.numbers, run.summary.model, Setup::of(scene));
    let mut lines: Vec<Line> = expect.iter().map(of).collect();
    ended(&mut lines, run.core_seconds(), run.summary.status.is_completed());
    lines
}

fn ended(lines: &mut [Line], core_seconds: f64, completed: bool) {
    for line in lines {
        line.core_seconds = core_seconds;
        line.holds &= completed;
    }
}

fn of_landing(case: &Case, further: &[String], expect: &[Expect]) -> Result<Vec<Line>, ExperimentError> {
    let landed = ditching::follow(&ditching::load(&case.ditch, &[&case.set, further].concat())?).summary;
    let numbers = Numbers::of(&landed);
    let mut lines: Vec<Line> = expect.iter().map(|e| judge(e, &numbers, LANDING, Setup::default())).collect();
    ended(&mut lines, landed.wall_time_s, landed.status.is_completed());
    Ok(lines)
}

fn of_hull(case: &Case, further: &[String], expect: &[Expect]) -> Result<Vec<Line>, ExperimentError> {
    let scene = planing::load(&case.plane, &[&case.set, further].concat())?;
    let towed = planing::tow(&scene).summary;
    let numbers = Numbers::of(&towed);
    let setup = Setup { deadrise_deg: Some(scene.hull.deadrise_deg), speed: Some(towed.speed_m_per_s), spacings: None };
    let mut lines: Vec<Line> = expect.iter().map(|e| judge(e, &numbers, towed.model, setup)).collect();
    ended(&mut lines, 0.0, towed.status.is_completed());
    Ok(lines)
}

fn of_scene(case: &Case, out: Option<PathBuf>) -> Result<Vec<Line>, ExperimentError> {
    let (scene, run) = run_with(case, &[], out)?;
    let mut lines = judged(&case.expect, &scene, &run);
    if case.comparisons {
        lines.extend(run.summary.comparison.iter().map(|c| of_comparison(c, run.summary.model, Setup::of(&scene))));
        let found = run.summary.comparison.iter().filter(|c| c.tolerance.is_some()).count();
        let asked = scene.compare.iter().filter(|c| c.tolerance.is_some()).count();
        lines.extend((found < asked).then(|| Line {
            quantity: "comparisons that the run could be judged by".into(),
            ours: found as f64,
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
    ended(&mut lines, run.core_seconds(), run.summary.status.is_completed());
    Ok(lines)
}

/// The line of a comparison, of a curve or of a single number, with a reference.
fn of_comparison(c: &Comparison, model: &str, setup: Setup) -> Line {
    let ratio = c.waveform.filter(|_| !c.quantity.contains(',')).map_or(c.ours / c.theirs, |w| 1.0 + w.magnitude);
    let point = |quantity| Point {
        quantity,
        case: String::new(),
        number: c.quantity.clone(),
        model: model.into(),
        ratio,
        waveform: c.waveform.map(|w| w.combined),
        numerical: None,
        setup,
        reference: Pedigree::of(&c.reference),
    };
    Line {
        quantity: c.quantity.clone(),
        ours: c.ours,
        theirs: number(c.theirs),
        error: Some(c.error),
        allowed: c.tolerance.map_or(NOT_JUDGED.into(), number),
        holds: c.passes(),
        source: c.reference.clone(),
        point: Quantity::of(&c.quantity).map(point),
        ..Line::default()
    }
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

fn judge(expect: &Expect, numbers: &Numbers, model: &str, setup: Setup) -> Line {
    let paths = std::iter::once(&expect.value).chain(&expect.largest_of);
    let ours = paths.filter_map(|path| numbers.get(path)).reduce(f64::max).unwrap_or(f64::NAN);
    let error = expect.reference.map(|r| ours / r - 1.0);
    let near = match (error, expect.tolerance) {
        (Some(error), Some(tolerance)) => error.abs() <= tolerance,
        _ => expect.at_most.is_some(), // a number without a bound is not judged: it does not hold
    };
    let bounded = expect.at_most.is_none_or(|bound| ours.abs() <= bound);
    // a result of a run without a band is no evidence; a band contains 95 %
    let result = expect.value.strip_prefix("results/").and_then(|_| expect.value.strip_suffix("/value"));
    let band = result.and_then(|result| numbers.get(&format!("{result}/band")));
    let quantity =
        Quantity::of(&expect.value).filter(|_| expect.evidence != Some(false) && (result.is_none() || band.is_some()));
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
        point: expect.reference.zip(quantity).map(|(reference, quantity)| Point {
            quantity,
            case: String::new(),
            number: expect.value.clone(),
            model: model.into(),
            ratio: ours / reference,
            waveform: None,
            numerical: band.filter(|_| is_particles(model)).map(|band| (0.5 * band / ours).abs()),
            setup,
            reference: expect.pedigree(),
        }),
        ..Line::default()
    }
}

impl Expect {
    fn pedigree(&self) -> Pedigree {
        let Pedigree { nature, uncertainty } = Pedigree::of(&self.source);
        let nature = self.nature.unwrap_or(nature);
        Pedigree { nature, uncertainty: self.uncertainty.or(uncertainty.filter(|_| self.nature.is_none())) }
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

/// True for the models of particles.
fn is_particles(model: &str) -> bool {
    EntryModel::ALL.iter().any(|known| known.name() == model && !known.is_theory())
}

/// Lines that `splashdown validate --json` printed.
///
/// # Errors
/// The file cannot be read, or holds something else.
pub fn stored(path: &Path) -> Result<Vec<Line>, ExperimentError> {
    CASES.stored(path)
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
