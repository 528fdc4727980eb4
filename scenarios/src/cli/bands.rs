//! `splashdown bands`.

use std::path::PathBuf;

use clap::Args;

use super::shared::{DONE, Output, Stop, say, write};
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

pub(super) fn run_bands(output: &Output, args: &BandsArgs) -> Result<u8, Stop> {
    if args.cases.is_empty() && !args.all {
        for case in study::band_cases()? {
            say(format_args!("{:<24} {}", case.name, case.about));
        }
        return Ok(DONE);
    }
    let mut lines = Vec::new();
    for case in study::select_bands(&args.cases)? {
        output.progress(format_args!("{} …", case.name));
        lines.extend(study::hold(&case)?);
    }
    let table = study::to_markdown(&lines);
    output.result(&lines, &table);
    if let Some(path) = &args.table {
        let text = format!(
            "# Error bars\n\nWritten by `splashdown bands --all --table docs/src/validation/error_bars.md`.\n\n{table}"
        );
        write(path, &text)?;
    }
    Ok(DONE)
}
