//! `splashdown chart`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{Cli, DONE, Stop, say};
use crate::chart::{self, ChartError, Measured};

#[derive(Args)]
pub(super) struct ChartArgs {
    /// Charts to measure: names of built-in ones, or TOML files like those in tests/charts.
    cases: Vec<String>,
    /// Measure every chart.
    #[arg(long, conflicts_with = "cases")]
    all: bool,
    /// Draw a chart that was measured before, from its JSON file, without running it (repeatable).
    #[arg(long, value_name = "FILE", conflicts_with_all = ["cases", "all"])]
    from: Vec<PathBuf>,
    /// Folder for NAME.json, NAME.svg and NAME.html.
    #[arg(long, value_name = "DIR", default_value = "runs/charts")]
    out: PathBuf,
    /// Write the tables to this Markdown file.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
}

impl From<ChartError> for Stop {
    fn from(error: ChartError) -> Stop {
        match error {
            ChartError::Scene(e) => e.into(),
            ChartError::Run(e) => e.into(),
            ChartError::Ended { .. } => Stop::Failed(error.to_string()),
            other => Stop::Input(other.to_string()),
        }
    }
}

pub(super) fn run_charts(cli: &Cli, args: &ChartArgs) -> Result<u8, Stop> {
    if args.cases.is_empty() && !args.all && args.from.is_empty() {
        for case in chart::cases()? {
            say(format_args!("{:<24} {}", case.name, case.about));
        }
        return Ok(DONE);
    }
    let mut charts = Vec::new();
    for file in &args.from {
        charts.push(chart::stored(file)?);
    }
    if args.from.is_empty() {
        for case in chart::select(&args.cases)? {
            let tell = |k: usize, of: usize, family: &str, at: f64| {
                if !cli.quiet {
                    eprintln!("{}, run {k} of {of}: {family}, {at} …", case.name);
                }
            };
            let measured = chart::measure(&case, tell)?;
            keep(&measured, &args.out)?; // each as soon as it is there: the next may fail
            charts.push(measured);
        }
    } else {
        charts.iter().try_for_each(|measured| keep(measured, &args.out))?;
    }
    let tables: Vec<String> = charts.iter().map(|c| format!("## {}\n\n{}", c.case.name, chart::table(c))).collect();
    match cli.json {
        true => say(format_args!("{}", serde_json::to_string_pretty(&charts).unwrap_or_default())),
        false => say(format_args!("{}", tables.join("\n").trim_end())),
    }
    if let Some(path) = &args.table {
        let head = "# Error against cost\n\nWritten by `splashdown chart --table`.\n\n";
        let text = format!("{head}{}", tables.join("\n"));
        std::fs::write(path, text).map_err(|e| Stop::Failed(format!("cannot write {}: {e}", path.display())))?;
    }
    Ok(DONE)
}

fn keep(measured: &Measured, out: &Path) -> Result<(), Stop> {
    let wrong = |e: std::io::Error| Stop::Failed(format!("cannot write to {}: {e}", out.display()));
    let file = |ending: &str| out.join(format!("{}.{ending}", measured.case.name));
    std::fs::create_dir_all(out).map_err(wrong)?;
    std::fs::write(file("json"), measured.to_json()).map_err(wrong)?;
    std::fs::write(file("svg"), chart::svg(measured)).map_err(wrong)?;
    std::fs::write(file("html"), chart::page(measured)).map_err(wrong)
}
