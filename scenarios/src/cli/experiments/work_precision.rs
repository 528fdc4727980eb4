//! `splashdown chart`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{Selection, list, write_all};
use crate::cli::shared::{DONE, Output, Stop};
use crate::experiments::work_precision::{self, CHARTS, Case, Measured};
use crate::experiments::{ExperimentError, catalogue};

#[derive(Args)]
pub struct ChartArgs {
    #[command(flatten)]
    selection: Selection,
    /// Draw a chart that was measured before, from the NAME.json that `splashdown chart NAME` wrote into its --out, without
    /// running it (repeatable).
    #[arg(long, value_name = "FILE", conflicts_with_all = ["cases", "all", "resume"])]
    from: Vec<PathBuf>,
    /// Override a key in every run whose family does not set it, e.g. --set fluid.cfl=0.4 (repeatable).
    #[arg(long = "set", value_name = "KEY=VALUE", conflicts_with = "from")]
    sets: Vec<String>,
    /// Resume charts that --out holds: only runs that are missing there, or failed, are made.
    #[arg(long)]
    resume: bool,
    /// Folder for NAME.json, NAME.html and NAME_QUANTITY.svg.
    #[arg(long, value_name = "DIR", default_value = "runs/charts")]
    out: PathBuf,
    /// Write the laws that error bars of other runs are computed from to this JSON file.
    #[arg(long, value_name = "FILE")]
    fits: Option<PathBuf>,
}

const HEADING: &str = "# Error against cost\n\nWritten by `splashdown chart --table`.";

pub fn run_charts(output: &Output, args: &ChartArgs) -> Result<u8, Stop> {
    if args.selection.is_empty() && args.from.is_empty() {
        return list(&CHARTS);
    }
    let charts = match args.from.is_empty() {
        true => measure(output, args)?,
        false => args.from.iter().map(|file| work_precision::stored(file)).collect::<Result<Vec<_>, _>>()?,
    };
    charts.iter().try_for_each(|measured| draw(measured, &args.out))?;
    let table = |c: &Measured| Ok(format!("## {}\n\n{}", c.case.name, work_precision::table(c)?));
    let tables = charts.iter().map(table).collect::<Result<Vec<_>, ExperimentError>>()?.join("\n");
    args.selection.show(output, &charts, HEADING, &tables)?;
    if let Some(path) = &args.fits {
        let laws = charts.iter().map(work_precision::error_laws).collect::<Result<Vec<_>, _>>()?.concat();
        catalogue::write(path, &serde_json::to_string_pretty(&laws).unwrap_or_default())?;
    }
    match charts.iter().find(|c| c.points.iter().all(|p| p.run().is_none())) {
        Some(empty) => Err(Stop::Failed(format!("no run of {} gave a number", empty.case.name))),
        None => Ok(DONE),
    }
}

/// Measure the charts; each run is stored at once.
fn measure(output: &Output, args: &ChartArgs) -> Result<Vec<Measured>, ExperimentError> {
    let measure_one = |mut case: Case| {
        case.set.extend_from_slice(&args.sets);
        let file = args.out.join(format!("{}.json", case.name));
        let before = match args.resume && file.exists() {
            true => Some(work_precision::stored(&file)?),
            false => None,
        };
        let tell = |k: usize, of: usize, run: &str| {
            output.progress(format_args!("{}, run {k} of {of}: {run} …", case.name));
        };
        work_precision::measure(&case, before.as_ref(), tell, |measured| catalogue::write(&file, &measured.to_json()))
    };
    CHARTS.select(&args.selection.cases)?.into_iter().map(measure_one).collect()
}

fn draw(measured: &Measured, out: &Path) -> Result<(), ExperimentError> {
    let name = &measured.case.name;
    let mut files =
        vec![(format!("{name}.json"), measured.to_json()), (format!("{name}.html"), work_precision::page(measured)?)];
    for quantity in &measured.case.quantity {
        files.push((format!("{name}_{}.svg", quantity.name), work_precision::svg(measured, quantity)?));
    }
    write_all(out, &files)
}
