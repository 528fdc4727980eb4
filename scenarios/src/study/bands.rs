//! `splashdown bands`: how often the error bar of a convergence study holds an exact value.
//!
//! A case is a TOML file in `scenarios/cases/bands`: a scene and numbers of its `summary.json` whose exact values are known.

use include_dir::{Dir, include_dir};
use serde::{Deserialize, Serialize};

use super::{StudyError, coarser};
use crate::embedded;
use crate::error_bar::ErrorBar;
use crate::run::{self, RunOptions};
use crate::scene;
use crate::summary::Status;

static CASES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/cases/bands");

/// A scene with exact answers.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BandCase {
    /// Name, that of its file.
    #[serde(skip)]
    pub name: String,
    /// What is shown.
    pub about: String,
    /// Name of a built-in scene.
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
    /// What it is.
    pub exact: f64,
    /// Where that is from.
    pub source: String,
}

/// A line of the table.
#[derive(Clone, Debug, Serialize)]
pub struct BandLine {
    /// The case.
    pub case: String,
    /// The number.
    pub path: String,
    /// Its exact value.
    pub exact: f64,
    /// Its error bar.
    pub bar: ErrorBar,
    /// True where the bar holds the exact value.
    pub holds: bool,
    /// Cost of the three runs [s].
    pub core_seconds: f64,
    /// Where the exact value is from.
    pub source: String,
}

/// All cases, by name.
pub fn band_cases() -> Result<Vec<BandCase>, StudyError> {
    let all: Vec<(String, BandCase)> = embedded::all(&CASES).map_err(|(name, why)| StudyError::Case(name, why))?;
    Ok(all.into_iter().map(|(name, case)| BandCase { name, ..case }).collect())
}

/// The cases of the given names; all of them if none is given.
pub fn select_bands(names: &[String]) -> Result<Vec<BandCase>, StudyError> {
    let all = band_cases()?;
    if let Some(stranger) = names.iter().find(|n| all.iter().all(|c| c.name != **n)) {
        let known = all.iter().map(|c| c.name.as_str()).collect::<Vec<_>>().join(", ");
        return Err(StudyError::Case(stranger.clone(), format!("there are: {known}")));
    }
    Ok(all.into_iter().filter(|c| names.is_empty() || names.contains(&c.name)).collect())
}

/// Run a case at 4, 2 and 1 times its spacing, and hold its error bars against the exact values.
pub fn hold(case: &BandCase) -> Result<Vec<BandLine>, StudyError> {
    let paths: Vec<String> = case.number.iter().map(|n| n.path.clone()).collect();
    let scene = scene::load(&case.scene, &case.set)?.scene;
    let before = coarser(&case.scene, &case.set, |_, _| {})?;
    before.refuse_unknown(&paths)?;
    let summary = run::run(&scene, &RunOptions::default())?.summary;
    if summary.status != Status::Completed {
        let (dx, c) = (scene.resolution.spacing, scene.sound_speed());
        return Err(StudyError::Ended(dx, c, summary.message.unwrap_or_default()));
    }
    let core_seconds = before.core_seconds + summary.wall_time_s * summary.threads as f64;
    let bars = before.error_bars(&scene, &summary, &paths);
    let line = |number: &Exact| {
        let bar = bars.get(&number.path)?.clone();
        let (case, path, source) = (case.name.clone(), number.path.clone(), number.source.clone());
        Some(BandLine { case, path, exact: number.exact, holds: bar.holds(number.exact), bar, core_seconds, source })
    };
    Ok(case.number.iter().filter_map(line).collect())
}

/// The table as Markdown, with the share of bars that hold.
pub fn to_markdown(lines: &[BandLine]) -> String {
    let held = lines.iter().filter(|l| l.holds).count();
    let mut text = format!(
        "{held} of {} bars hold the exact value. Errors and bands in percent of it.\n\n\
         | case | number | exact | finest run | extrapolated | band ± | order | holds | verdict | core-s | source |\n|{}\n",
        lines.len(),
        "---|".repeat(11)
    );
    for l in lines {
        let percent = |value: f64| format!("{:+.2} %", 100.0 * (value / l.exact - 1.0));
        text += &format!(
            "| {} | {} | {} | {} | {} | {:.2} % | {} | {} | {} | {:.0} | {} |\n",
            l.case,
            l.path,
            l.exact,
            percent(l.bar.value),
            percent(l.bar.middle()),
            100.0 * (l.bar.band / l.exact).abs(),
            l.bar.order.map_or("–".into(), |p| format!("{p:.2}")),
            if l.holds { "yes" } else { "**no**" },
            l.bar.verdict,
            l.core_seconds,
            l.source
        );
    }
    text
}
