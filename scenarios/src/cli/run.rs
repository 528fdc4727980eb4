//! `splashdown run`.

use std::path::PathBuf;

use clap::Args;
use report::page_of_run;
use run::error_bar::ErrorBars;
use run::folder::refuse_occupied;
use run::summary::Summary;
use run::{Checkpoints, RunOptions, run};

use super::experiments::{accuracy, convergence};
use super::progress::{interval, listen, step_to_end, viewers_at};
use super::shared::{LiveArgs, Output, SceneArgs, Stop, load, seconds};

/// A share of a value, from a number of percent with or without its sign.
fn percent(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches('%').trim().parse::<f64>().ok();
    let share = number.map(|percent| percent / 100.0).filter(|share| (1e-3..=0.5).contains(share));
    share.ok_or_else(|| "expected a number of percent from 0.1 to 50, such as 5%".into())
}

#[derive(Args)]
pub(super) struct RunArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Folder for the run's files (default: runs/SCENE).
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace a run that the folder holds.
    #[arg(long)]
    force: bool,
    /// Keep log.mcap below this size, with fewer frames of particles: the key report.log_budget.
    #[arg(long, value_name = "MB")]
    log_budget: Option<f64>,
    #[command(flatten)]
    live: LiveArgs,
    /// Write checkpoint.bin at this interval of simulated time, and at the end: `splashdown resume` continues from there.
    #[arg(long, value_name = "SECONDS", conflicts_with = "study", value_parser = seconds)]
    checkpoint_every: Option<f64>,
    /// Run at 4 and 2 times the spacing first, and extrapolate the main numbers, with error bars.
    #[arg(long, group = "study")]
    converge: bool,
    /// Choose model and spacing so that each quoted result is within this share of its value, as 5%: cost first, then the runs, a folder each.
    #[arg(long, value_name = "PERCENT", group = "study", value_parser = percent, conflicts_with_all = ["log_budget", "live"])]
    to: Option<f64>,
    /// A number for an error bar, by its path in summary.json (default: the scene's main ones); with --to a result, as peak_force_N_per_m or
    /// PANEL.peak_stress_Pa (default: all). Repeatable.
    #[arg(long = "quantity", value_name = "PATH", requires = "study")]
    quantities: Vec<String>,
}

pub(super) fn run_scene(output: &Output, args: &RunArgs) -> Result<u8, Stop> {
    if let Some(share) = args.to {
        return accuracy::run_to(output, &args.scene, share, &args.quantities, args.out.clone());
    }
    let SceneArgs { scene, mut sets } = args.scene.clone();
    sets.extend(args.log_budget.map(|megabytes| format!("report.log_budget={megabytes:?}")));
    let given = SceneArgs { scene, sets };
    let every = interval(args.checkpoint_every)?;
    let loaded = load(&given)?;
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(&loaded.scene.name));
    refuse_occupied(&out, args.force)?;
    loaded.warnings.iter().for_each(|w| tracing::warn!("{w}"));
    listen()?;
    let coarser = match args.converge {
        true if loaded.scene.model.is_theory() => {
            let text = format!(
                "--converge: expected a model of particles, not {}: it has no spacing",
                loaded.scene.model.name()
            );
            return Err(Stop::Input(text));
        }
        true => Some(convergence::coarser_runs(output, &given, &args.quantities, &out, args.force)?),
        false => None,
    };
    let studied =
        coarser.as_ref().map(|runs| |summary: &Summary| runs.error_bars(&loaded.scene, summary, &args.quantities));
    let viewers = args.live.live.map(|address| viewers_at(output, address));
    let options = RunOptions {
        out: Some(out.clone()),
        live: viewers.as_ref().map(|start| start as &(dyn Fn(&_) -> _ + Sync)),
        page: Some(page_of_run),
        force: args.force,
        // the error bars of a study are lost with it: a run with them is not resumed
        checkpoints: (!args.converge).then_some(Checkpoints { every }),
        warnings: loaded.warnings.clone(),
        error_bars: studied.as_ref().map(|of| of as &(dyn Fn(&Summary) -> ErrorBars + Sync)),
        ..RunOptions::default()
    };
    step_to_end(output, &out, loaded.scene.time.end, options, |options| run(&loaded.scene, options))
}
