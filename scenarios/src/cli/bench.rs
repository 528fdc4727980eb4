//! `splashdown bench`.

use std::path::PathBuf;

use clap::Args;

use super::shared::{DONE, Output, Stop, say, write};
use crate::bench::{self, BenchError, Extent};

#[derive(Args)]
pub(super) struct BenchArgs {
    /// About twenty seconds (the default).
    #[arg(long, conflicts_with = "full")]
    quick: bool,
    /// Minutes: a million particles too, and the dam break to 0.5 s.
    #[arg(long)]
    full: bool,
    /// Keep the numbers as JSON in this file; with --json they go to stdout.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl From<BenchError> for Stop {
    fn from(error: BenchError) -> Stop {
        Stop::Failed(error.to_string())
    }
}

pub(super) fn run_bench(output: &Output, args: &BenchArgs) -> Result<u8, Stop> {
    let extent = if args.full { Extent::FULL } else { Extent::QUICK };
    let tell = |what: &str| {
        output.progress(format_args!("{what} …"));
    };
    let measured = bench::measure(&extent, tell)?;
    let json = serde_json::to_string_pretty(&measured).unwrap_or_default();
    match output.json {
        true => say(&json),
        false => say(bench::in_words(&measured)),
    }
    if let Some(path) = &args.out {
        write(path, &json)?;
    }
    Ok(DONE)
}
