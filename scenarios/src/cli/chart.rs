//! `splashdown chart`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{Cli, DONE, Stop, say};
use crate::chart::{self, ChartError, Measured};

#[derive(Args)]
pub(super) struct ChartArgs {
    /// Charts to measure: names of built-in ones, or TOML files like those in scenarios/cases/charts.
    cases: Vec<String>,
    /// Measure every chart.
    #[arg(long, conflicts_with = "cases")]
    all: bool,
    /// Draw a chart that was measured before, from its JSON file, without running it (repeatable).
    #[arg(long, value_name = "FILE", conflicts_with_all = ["cases", "all", "resume"])]
    from: Vec<PathBuf>,
    /// Override a key in every run whose family does not set it, e.g. --set fluid.cfl=0.4 (repeatable).
    #[arg(long = "set", value_name = "KEY=VALUE", conflicts_with = "from")]
    sets: Vec<String>,
    /// Take up charts that --out holds: only runs that are missing there, or failed, are made.
    #[arg(long)]
    resume: bool,
    /// Folder for NAME.json, NAME.html and NAME_QUANTITY.svg.
    #[arg(long, value_name = "DIR", default_value = "runs/charts")]
    out: PathBuf,
    /// Write the tables to this Markdown file.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// Write the laws that error bars of other runs are taken from to this JSON file.
    #[arg(long, value_name = "FILE")]
    fits: Option<PathBuf>,
}

impl From<ChartError> for Stop {
    fn from(error: ChartError) -> Stop {
        match error {
            ChartError::Scene(e) => e.into(),
            ChartError::Write(..) => Stop::Failed(error.to_string()),
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
    let charts = match args.from.is_empty() {
        true => measure(cli, args)?,
        false => args.from.iter().map(|file| chart::stored(file)).collect::<Result<Vec<_>, _>>()?,
    };
    charts.iter().try_for_each(|measured| draw(measured, &args.out))?;
    let tables = charts.iter().map(|c| Ok(format!("## {}\n\n{}", c.case.name, chart::table(c)?)));
    let tables = tables.collect::<Result<Vec<_>, ChartError>>()?.join("\n");
    match cli.json {
        true => say(format_args!("{}", serde_json::to_string_pretty(&charts).unwrap_or_default())),
        false => say(format_args!("{}", tables.trim_end())),
    }
    if let Some(path) = &args.table {
        let head = "# Error against cost\n\nWritten by `splashdown chart --table`.\n\n";
        write(path, &format!("{head}{tables}"))?;
    }
    if let Some(path) = &args.fits {
        let laws = charts.iter().map(chart::fits).collect::<Result<Vec<_>, _>>()?.concat();
        write(path, &serde_json::to_string_pretty(&laws).unwrap_or_default())?;
    }
    match charts.iter().find(|c| c.points.iter().all(|p| p.run().is_none())) {
        Some(empty) => Err(Stop::Failed(format!("no run of {} gave a number", empty.case.name))),
        None => Ok(DONE),
    }
}

/// Measure the charts; each run is kept as soon as it is done.
fn measure(cli: &Cli, args: &ChartArgs) -> Result<Vec<Measured>, Stop> {
    let mut charts = Vec::new();
    for mut case in chart::select(&args.cases)? {
        case.set.extend_from_slice(&args.sets);
        let file = args.out.join(format!("{}.json", case.name));
        let before = match args.resume && file.exists() {
            true => Some(chart::stored(&file)?),
            false => None,
        };
        let tell = |k: usize, of: usize, run: &str| {
            if !cli.quiet {
                eprintln!("{}, run {k} of {of}: {run} …", case.name);
            }
        };
        charts.push(chart::measure(&case, before.as_ref(), tell, |measured| write(&file, &measured.to_json()))?);
    }
    Ok(charts)
}

fn draw(measured: &Measured, out: &Path) -> Result<(), ChartError> {
    let name = &measured.case.name;
    write(&out.join(format!("{name}.json")), &measured.to_json())?;
    write(&out.join(format!("{name}.html")), &chart::page(measured)?)?;
    let mut quantities = measured.case.quantity.iter();
    quantities.try_for_each(|q| write(&out.join(format!("{name}_{}.svg", q.name)), &chart::svg(measured, q)?))
}

/// Write a file, and the folders on the way to it.
fn write(path: &Path, text: &str) -> Result<(), ChartError> {
    let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
    folder.and_then(|()| std::fs::write(path, text)).map_err(|e| ChartError::Write(path.display().to_string(), e))
}
