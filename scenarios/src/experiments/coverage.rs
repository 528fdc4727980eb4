//! `splashdown bands`: how often the error bar of a convergence study contains an exact value.
//!
//! A case is a TOML file in `scenarios/cases/bands`: a scene and numbers of its `summary.json` whose exact values are known.

use include_dir::{Dir, include_dir};
use serde::{Deserialize, Serialize};

use super::convergence::coarser_runs;
use super::runs::{run_to_end, scene_with};
use super::{ExperimentError, catalogue, markdown};
use crate::error_bar::ErrorBar;

static CASES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/cases/bands");

/// A scene with exact answers.
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
    /// Overrides, as for `--set`, of the finest run.
    #[serde(default)]
    pub set: Vec<String>,
    /// Numbers.
    pub number: Vec<Exact>,
}

/// A number of `summary.json` and its exact value.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exact {
    /// Its path, keys joined by `/`.
    pub path: String,
    /// Its exact value.
    pub exact: f64,
    /// Source of the value.
    pub source: String,
}

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

impl catalogue::Case for Case {
    const KIND: &'static str = "case of bands";

    fn folder() -> &'static Dir<'static> {
        &CASES
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn rename(&mut self, name: String) {
        self.name = name;
    }

    fn about(&self) -> &str {
        &self.about
    }
}

/// Run a case at 4, 2 and 1 times its spacing, and compare its error bars with the exact values.
///
/// # Errors
/// The scene is wrong, a run ended early, or a number is missing.
pub fn cover(case: &Case) -> Result<Vec<Line>, ExperimentError> {
    let paths: Vec<String> = case.number.iter().map(|n| n.path.clone()).collect();
    let scene = scene_with(&case.scene, &case.set, &[])?;
    let coarser = coarser_runs(&case.scene, &case.set, |_, _| {})?;
    coarser.refuse_unknown(&paths)?;
    let run = run_to_end(&scene)?;
    let core_seconds = coarser.core_seconds() + run.core_seconds();
    let bars = coarser.error_bars(&scene, &run.summary, &paths);
    let line = |number: &Exact| {
        let bar = bars.get(&number.path)?.clone();
        let (case, path, source) = (case.name.clone(), number.path.clone(), number.source.clone());
        Some(Line { case, path, exact: number.exact, holds: bar.holds(number.exact), bar, core_seconds, source })
    };
    Ok(case.number.iter().filter_map(line).collect())
}

/// The table as Markdown, with the share of bars that contain the exact value.
pub fn table(lines: &[Line]) -> String {
    let head = [
        "case",
        "number",
        "exact",
        "finest run",
        "extrapolated",
        "band ±",
        "order",
        "holds",
        "verdict",
        "core-s",
        "source",
    ];
    let row = |l: &Line| {
        let percent = |value: f64| format!("{:+.2} %", 100.0 * (value / l.exact - 1.0));
        vec![
            l.case.clone(),
            l.path.clone(),
            l.exact.to_string(),
            percent(l.bar.value),
            percent(l.bar.middle()),
            format!("{:.2} %", 100.0 * (l.bar.band / l.exact).abs()),
            l.bar.order.map_or("–".into(), |p| format!("{p:.2}")),
            if l.holds { "yes" } else { "**no**" }.into(),
            l.bar.verdict.clone(),
            format!("{:.0}", l.core_seconds),
            l.source.clone(),
        ]
    };
    let held = lines.iter().filter(|l| l.holds).count();
    let rows: Vec<Vec<String>> = lines.iter().map(row).collect();
    let first = format!("{held} of {} bars hold the exact value. Errors and bands in percent of it.\n\n", lines.len());
    first + &markdown(&head, &rows)
}
