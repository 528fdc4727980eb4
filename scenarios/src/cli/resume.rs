//! `splashdown resume`.

use std::path::PathBuf;

use clap::Args;

use super::progress::{interval, listen, live_at, step_to_end};
use super::shared::{LiveArgs, Output, Stop};
use crate::run::{Checkpoints, Resumable, RunOptions};

#[derive(Args)]
pub(super) struct ResumeArgs {
    /// Folder of a run with --checkpoint-every, or of an interrupted one.
    #[arg(value_name = "DIR")]
    dir: PathBuf,
    /// Go on to this simulated time: the key time.end.
    #[arg(long, value_name = "SECONDS")]
    until: Option<f64>,
    /// Write checkpoint.bin every so many seconds of simulated time, and at the end (default: as before).
    #[arg(long, value_name = "SECONDS")]
    checkpoint_every: Option<f64>,
    #[command(flatten)]
    live: LiveArgs,
}

pub(super) fn resume_run(output: &Output, args: &ResumeArgs) -> Result<u8, Stop> {
    let every = interval(args.checkpoint_every)?;
    let run = Resumable::open(&args.dir, args.until)?;
    listen()?;
    let live_at = live_at(output, args.live.live);
    let options = RunOptions {
        live: args.live.live,
        live_at: Some(&live_at),
        checkpoints: Some(Checkpoints { every: every.or(run.checkpoint_interval()) }),
        warnings: run.warnings().to_vec(),
        ..RunOptions::default()
    };
    let end = run.scene().time.end;
    step_to_end(output, &args.dir, end, options, |options| run.resume(options))
}
