//! `splashdown resume`.

use std::path::PathBuf;

use clap::Args;
use report::page_of_run;
use run::{Checkpoints, Resumable, RunOptions};
use settings::significant;

use super::progress::{interval, listen, step_to_end, viewers_at};
use super::shared::{LiveArgs, Output, Stop, seconds};

/// Ends over the one before from which one is most likely meant in milliseconds.
const FAR: f64 = 100.0;

#[derive(Args)]
pub(super) struct ResumeArgs {
    /// Folder of a run with --checkpoint-every, or of an interrupted one.
    #[arg(value_name = "DIR")]
    dir: PathBuf,
    /// Go on to this simulated time: the key time.end. In seconds, or with a unit, as 30ms.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    until: Option<f64>,
    /// Go on even to an end more than 100 times as late as the one before, which is refused otherwise.
    #[arg(long, requires = "until")]
    force: bool,
    /// Write checkpoint.bin at this interval of simulated time, and at the end (default: as before).
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    checkpoint_every: Option<f64>,
    #[command(flatten)]
    live: LiveArgs,
}

pub(super) fn resume_run(output: &Output, args: &ResumeArgs) -> Result<u8, Stop> {
    let every = interval(args.checkpoint_every)?;
    let run = Resumable::open(&args.dir, args.until)?;
    refuse_far_end(args, run.end_before())?;
    if args.until.is_some() {
        run.warnings().iter().for_each(|warning| tracing::warn!("{warning}"));
    }
    listen()?;
    let viewers = args.live.live.map(|address| viewers_at(output, address));
    let options = RunOptions {
        live: viewers.as_ref().map(|start| start as &(dyn Fn(&_) -> _ + Sync)),
        page: Some(page_of_run),
        checkpoints: Some(Checkpoints { every: every.or(run.checkpoint_interval()) }),
        warnings: run.warnings().to_vec(),
        ..RunOptions::default()
    };
    let end = run.scene().time.end;
    step_to_end(output, &args.dir, end, options, |options| run.resume(options))
}

/// Refuses an end that is hardly meant: most often milliseconds given as seconds.
fn refuse_far_end(args: &ResumeArgs, before: f64) -> Result<(), Stop> {
    let Some(until) = args.until.filter(|until| *until > FAR * before && until.is_finite() && !args.force) else {
        return Ok(());
    };
    Err(Stop::Input(format!(
        "--until {until}: expected at most {} s, {FAR} times the end so far, {before} s: --until {until}ms is in milliseconds, --force \
         goes on to {until} s",
        significant(FAR * before)
    )))
}
