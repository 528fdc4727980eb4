//! `splashdown bands`: how often the error bar of a convergence study contains an exact value.
//!
//! A case is a TOML file in `scenarios/cases/bands`: a scene and numbers of its `summary.json` whose exact values are known.

use include_dir::{Dir, include_dir};
use report::{Table, known};
use run::error_bar::ErrorBar;
use serde::Serialize;

use super::catalogue::Catalogue;
use super::convergence::coarser_runs;
use super::runs::{run_to_end, scene_with};
use super::validation::{Case, Expect};
use super::{ExperimentError, yes};

static FOLDER: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/cases/bands");

/// The cases: validation cases whose references are exact.
pub static CASES: Catalogue<Case> = Catalogue::new("case of bands", "bands", &FOLDER);

/// A line of the table.
#[derive(Clone, Debug, Serialize)]
pub struct Line {
    /// The case.
    pub case: String,
    /// The number.
    pub path: String,
    /// Its exact value.
    pub exact: f64,
    /// Its error bar.
    pub bar: ErrorBar,
    /// True where the bar contains the exact value.
    pub holds: bool,
    /// Cost of the three runs [s].
    pub core_seconds: f64,
    /// Source of the exact value.
    pub source: String,
}

/// Run a case at 4, 2 and 1 times its spacing, and compare its error bars with the exact values.
///
/// # Errors
/// The scene is wrong, a run ended early, or a number is missing.
pub fn cover(case: &Case) -> Result<Vec<Line>, ExperimentError> {
    let exact = |e: &Expect| Some((e.value.clone(), e.reference?, e.source.clone()));
    let numbers: Vec<(String, f64, String)> = case.expect.iter().filter_map(exact).collect();
    let paths: Vec<String> = numbers.iter().map(|n| n.0.clone()).collect();
    let scene = scene_with(&case.scene, &case.set, &[])?;
    let coarser = coarser_runs(&case.scene, &case.set, |_, _| {})?;
    coarser.refuse_unknown(&paths)?;
    let run = run_to_end(&scene)?;
    let core_seconds = coarser.core_seconds() + run.core_seconds();
    let mut bars = coarser.error_bars(&scene, &run.summary, &paths);
    let line = |(path, exact, source): (String, f64, String)| {
        let bar = bars.remove(&path)?;
        Some(Line { case: case.name.clone(), path, exact, holds: bar.holds(exact), bar, core_seconds, source })
    };
    Ok(numbers.into_iter().filter_map(line).collect())
}

/// The table as Markdown, with the share of bars that contain the exact value.
pub fn table(lines: &[Line]) -> String {
    fn percent(value: f64, l: &Line) -> String {
        format!("{:+.2} %", 100.0 * (value / l.exact - 1.0))
    }
    let table = Table::of(
        "",
        lines,
        &[
            ("case", |l| l.case.clone()),
            ("number", |l| l.path.clone()),
            ("exact", |l| l.exact.to_string()),
            ("finest run", |l| percent(l.bar.value, l)),
            ("extrapolated", |l| percent(l.bar.middle(), l)),
            ("band ±", |l| format!("{:.2} %", 100.0 * (l.bar.band / l.exact).abs())),
            ("order", |l| known(l.bar.order, 2)),
            ("holds", |l| yes(l.holds)),
            ("verdict", |l| l.bar.verdict.clone()),
            ("core-s", |l| format!("{:.0}", l.core_seconds)),
            ("source", |l| l.source.clone()),
        ],
    );
    let held = lines.iter().filter(|l| l.holds).count();
    let first = format!("{held} of {} bars hold the exact value. Errors and bands in percent of it.\n\n", lines.len());
    first + &table.markdown()
}
