//! `splashdown bench`.

use std::path::PathBuf;

use clap::Args;

use super::{Cli, DONE, Stop, say};
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

pub(super) fn run_bench(cli: &Cli, args: &BenchArgs) -> Result<u8, Stop> {
    let extent = if args.full { Extent::FULL } else { Extent::QUICK };
    let tell = |what: &str| {
        if !cli.quiet {
            eprintln!("{what} …");
        }
    };
    let measured = bench::measure(&extent, tell)?;
    let json = serde_json::to_string_pretty(&measured).unwrap_or_default();
    match cli.json {
        true => say(format_args!("{json}")),
        false => say(format_args!("{}", bench::in_words(&measured))),
    }
    if let Some(path) = &args.out {
        std::fs::write(path, json).map_err(|e| Stop::Failed(format!("cannot write {}: {e}", path.display())))?;
    }
    Ok(DONE)
}
