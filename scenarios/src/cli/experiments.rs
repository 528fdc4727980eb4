//! Experiments on the command line: selection of cases, their list, tables and files.

pub(super) mod accuracy;
pub(super) mod convergence;
pub(super) mod stability;
pub(super) mod work_precision;

use std::path::{Path, PathBuf};

use clap::{Args, value_parser};
use serde::Serialize;

use super::shared::{DONE, Output, Stop, say};
use crate::experiments::catalogue::{self, Case, Catalogue};
use crate::experiments::{
    ExperimentError, coverage, drops, stability as stability_maps, uncharted, validation, work_precision as charts,
};

/// Cases of an experiment, and the file of its table.
#[derive(Args)]
struct Selection {
    /// Cases to run: names of built-in ones, or TOML files like those in scenarios/cases. Without any, they are listed.
    cases: Vec<String>,
    /// Run every built-in case.
    #[arg(long, conflicts_with = "cases")]
    all: bool,
    /// Write the table to this Markdown file.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
}

impl Selection {
    fn is_empty(&self) -> bool {
        self.cases.is_empty() && !self.all
    }

    /// Print the result as JSON or as a table; keep the table, below a heading.
    fn show(&self, output: &Output, result: &impl Serialize, heading: &str, table: &str) -> Result<(), Stop> {
        output.result(result, table);
        if let Some(path) = &self.table {
            catalogue::write(path, &format!("{heading}\n\n{table}"))?;
        }
        Ok(())
    }
}

impl From<ExperimentError> for Stop {
    fn from(error: ExperimentError) -> Stop {
        match error {
            ExperimentError::Scene(e) => e.into(),
            ExperimentError::Run(e) => e.into(),
            other if other.is_input() => Stop::Input(other.to_string()),
            other => Stop::Failed(other.to_string()),
        }
    }
}

/// List the built-in cases.
fn list<C: Case>(cases: &Catalogue<C>) -> Result<u8, Stop> {
    for case in cases.all()? {
        let [name, about] = case.title();
        say(format_args!("{name:<24} {about}"));
    }
    Ok(DONE)
}

/// Run cases that give lines of one table, one after another.
fn lines_of<C: Case, Line>(
    output: &Output,
    cases: &[C],
    run: impl Fn(&C) -> Result<Vec<Line>, ExperimentError>,
) -> Result<Vec<Line>, Stop> {
    let mut lines = Vec::new();
    for case in cases {
        output.progress(format_args!("{} …", case.title()[0]));
        lines.extend(run(case)?);
    }
    Ok(lines)
}

/// Write text files into a folder.
fn write_all(folder: &Path, files: &[(String, String)]) -> Result<(), ExperimentError> {
    files.iter().try_for_each(|(name, text)| catalogue::write(&folder.join(name), text))
}

// `splashdown validate`.
#[derive(Args)]
pub struct ValidateArgs {
    #[command(flatten)]
    selection: Selection,
    /// Keep each case's files below this folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Take the numbers from this file, which `validate --json` printed, instead of running.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["cases", "all", "out"])]
    from: Option<PathBuf>,
    /// Write bias and scatter by quantity to this Markdown file.
    #[arg(long, value_name = "FILE")]
    quantities: Option<PathBuf>,
    /// Write the numbers beside those of earlier states to this Markdown file.
    #[arg(long, value_name = "FILE")]
    drift: Option<PathBuf>,
    /// Write the credibility sheet to this Markdown file.
    #[arg(long, value_name = "FILE")]
    sheet: Option<PathBuf>,
    /// Write the list of reference data to this Markdown file.
    #[arg(long, value_name = "FILE")]
    data: Option<PathBuf>,
    /// Write the points, from which reports quote, to this JSON file.
    #[arg(long, value_name = "FILE")]
    evidence: Option<PathBuf>,
}

/// The page of a table of validation: its heading, the option that writes it, its file, and what it shows.
fn heading(title: &str, option: &str, file: &str) -> String {
    format!("# {title}\n\nWritten by `splashdown validate --all --{option} docs/src/validation/{file}.md`.\n\n")
}

const VALIDATION: &str = "# Validation\n\nWritten by `splashdown validate --all --table docs/src/validation/cases.md`.";

const QUANTITIES: &str = "Bias δ: ours over theirs. σ: relative standard deviations. C: score of curves, 0 for the same curve. A true value is below a number of the \
    program times the 95 % factor with a probability of 95 % (THEORY GE27, GE28). Points of a case are not independent.";
const DATA: &str = "The tables lie in `scenarios/scene/reference`, CSV with a header of `#` lines; they may be used without this program. Cite the source of \
    a table, and this project for tables that it computed. Where a repository states no licence, figures are cited from the paper; do not copy \
    the file as it is. A dash: not stated in the header.";
const DRIFT: &str = "Tables of earlier states are stored in `scenarios/cases/states`. A changed number needs an entry in the changelog.";
const SHEET: &str = "Factors of NASA-STD-7009B. The program argues each level from its own numbers.";

pub fn run_validation(output: &Output, args: &ValidateArgs) -> Result<u8, Stop> {
    let lines = match &args.from {
        Some(path) => validation::stored(path)?,
        None if args.selection.is_empty() && args.data.is_none() => return list(&validation::CASES),
        None if args.selection.is_empty() => Vec::new(),
        None => lines_of(output, &validation::CASES.select(&args.selection.cases)?, |case| {
            validation::validate(case, args.out.as_ref())
        })?,
    };
    if !lines.is_empty() {
        args.selection.show(output, &lines, VALIDATION, &validation::table(&lines))?;
    }
    let points: Vec<_> = lines.iter().filter_map(|line| line.point.clone()).collect();
    let experiments = validation::credibility::Experiments {
        charts: charts::CHARTS.all()?.len(),
        maps: stability_maps::MAPS.all()?.len(),
        bands: coverage::CASES.all()?.len(),
    };
    let pages = [
        (
            &args.quantities,
            heading("Bias and scatter by quantity", "quantities", "quantities"),
            QUANTITIES,
            validation::quantities::page(&points),
        ),
        (&args.drift, heading("Drift", "drift", "drift"), DRIFT, validation::drift::page(&lines)),
        (
            &args.sheet,
            heading("Credibility", "sheet", "credibility"),
            SHEET,
            validation::credibility::page(&lines, experiments),
        ),
    ];
    if let Some(path) = &args.data {
        let heading = "# Reference data\n\nWritten by `splashdown validate --data docs/src/validation/data.md`.\n\n";
        catalogue::write(path, &format!("{heading}{DATA}\n\n{}", validation::data::page()))?;
    }
    for (path, heading, about, page) in pages {
        path.as_ref().map(|path| catalogue::write(path, &format!("{heading}{about}\n\n{page}"))).transpose()?;
    }
    if let Some(path) = &args.evidence {
        let points: Vec<String> = points.iter().map(|p| serde_json::to_string(p).unwrap_or_default()).collect();
        catalogue::write(path, &format!("[\n{}\n]\n", points.join(",\n")))?;
    }
    match lines.iter().filter(|l| !l.holds).count() {
        0 => Ok(DONE),
        misses => {
            let judged = lines.iter().filter(|l| l.is_judged()).count();
            Err(Stop::Failed(format!("{misses} of {judged} numbers that are judged do not hold")))
        }
    }
}

// `splashdown bands`.
#[derive(Args)]
pub struct BandsArgs {
    #[command(flatten)]
    selection: Selection,
    /// Run this number of wedges that are on no chart, and compare the error bars that they have from charts.
    #[arg(long, value_name = "COUNT", conflicts_with_all = ["cases", "all"], value_parser = value_parser!(u32).range(1..=10_000))]
    uncharted: Option<u32>,
    /// Run this number of drops of wedges and arcs, and compare the bands of their quoted results with boundary elements.
    #[arg(long, value_name = "COUNT", conflicts_with_all = ["cases", "all", "uncharted"], value_parser = value_parser!(u32).range(1..=10_000))]
    drops: Option<u32>,
    /// Which ones.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

const ERROR_BARS: &str =
    "# Error bars\n\nWritten by `splashdown bands --all --table docs/src/validation/error_bars.md`.";

pub fn run_bands(output: &Output, args: &BandsArgs) -> Result<u8, Stop> {
    if let Some(count) = args.uncharted {
        let cases: Vec<_> = (0..count as usize).map(|k| uncharted::draw(args.seed, k)).collect();
        uncharted::read_all(&cases)?;
        let about = ["Error bars between charts", "uncharted"];
        return run_random(output, args, about, &cases, |sets| sets.join(" "), |sets| uncharted::cover(sets));
    }
    if let Some(count) = args.drops {
        let drops: Vec<_> = (0..count as usize).map(|k| drops::draw(args.seed, k)).collect();
        drops::read_all(&drops)?;
        let about = ["Bands of quoted results", "drops"];
        return run_random(
            output,
            args,
            about,
            &drops,
            |drop| format!("{} {}", drop.0, drop.1.join(" ")),
            drops::cover,
        );
    }
    if args.selection.is_empty() {
        return list(&coverage::CASES);
    }
    let lines = lines_of(output, &coverage::CASES.select(&args.selection.cases)?, coverage::cover)?;
    args.selection.show(output, &lines, ERROR_BARS, &coverage::table(&lines))?;
    Ok(DONE)
}

/// Runs cases that were drawn at random, and shows how many bars hold.
fn run_random<C>(
    output: &Output,
    args: &BandsArgs,
    [title, option]: [&str; 2],
    cases: &[C],
    name: impl Fn(&C) -> String,
    cover: impl Fn(&C) -> Result<Vec<coverage::Line>, ExperimentError>,
) -> Result<u8, Stop> {
    let mut lines = Vec::new();
    for case in cases {
        output.progress(format_args!("{} …", name(case)));
        lines.extend(cover(case)?);
    }
    let (count, seed) = (cases.len(), args.seed);
    let heading = format!("# {title}\n\nWritten by `splashdown bands --{option} {count} --seed {seed} --table FILE`.");
    args.selection.show(output, &lines, &heading, &uncharted::table(&lines))?;
    Ok(DONE)
}
