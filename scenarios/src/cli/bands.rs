//! `splashdown bands`.

use std::path::PathBuf;

use clap::Args;

use super::{Cli, DONE, Stop, say};
use crate::study;

#[derive(Args)]
pub(super) struct BandsArgs {
    /// Cases to run.
    cases: Vec<String>,
    /// Run every case.
    #[arg(long, conflicts_with = "cases")]
    all: bool,
    /// Write the table to this Markdown file.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
}

pub(super) fn run_bands(cli: &Cli, args: &BandsArgs) -> Result<u8, Stop> {
    if args.cases.is_empty() && !args.all {
        for case in study::band_cases()? {
            say(format_args!("{:<24} {}", case.name, case.about));
        }
        return Ok(DONE);
    }
    let mut lines = Vec::new();
    for case in study::select_bands(&args.cases)? {
        if !cli.quiet {
            eprintln!("{} …", case.name);
        }
        lines.extend(study::hold(&case)?);
    }
    let table = study::to_markdown(&lines);
    match cli.json {
        true => say(format_args!("{}", serde_json::to_string_pretty(&lines).unwrap_or_default())),
        false => say(format_args!("{}", table.trim_end())),
    }
    if let Some(path) = &args.table {
        let text = format!(
            "# Error bars\n\nWritten by `splashdown bands --all --table docs/src/validation/error_bars.md`.\n\n{table}"
        );
        std::fs::write(path, text).map_err(|e| Stop::Failed(format!("cannot write {}: {e}", path.display())))?;
    }
    Ok(DONE)
}
