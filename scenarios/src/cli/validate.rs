//! `splashdown validate`.

use std::path::PathBuf;

use clap::Args;

use super::shared::{DONE, Output, Stop, say, write};
use crate::validate::{self, ValidateError};

#[derive(Args)]
pub(super) struct ValidateArgs {
    /// Cases to run.
    cases: Vec<String>,
    /// Run every case.
    #[arg(long, conflicts_with = "cases")]
    all: bool,
    /// Keep each case's files below this folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write the table to this Markdown file.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
}

impl From<ValidateError> for Stop {
    fn from(error: ValidateError) -> Stop {
        match error {
            ValidateError::Scene(e) => e.into(),
            ValidateError::Run(e) => e.into(),
            other => Stop::Input(other.to_string()),
        }
    }
}

pub(super) fn run_validate(output: &Output, args: &ValidateArgs) -> Result<u8, Stop> {
    if args.cases.is_empty() && !args.all {
        for case in validate::cases()? {
            say(format_args!("{:<24} {}", case.name, case.about));
        }
        return Ok(DONE);
    }
    let mut lines = Vec::new();
    for case in validate::select(&args.cases)? {
        output.progress(format_args!("{} …", case.name));
        lines.extend(validate::run_case(&case, args.out.as_ref())?);
    }
    let table = validate::to_markdown(&lines);
    output.result(&lines, &table);
    if let Some(path) = &args.table {
        let text = format!(
            "# Validation\n\nWritten by `splashdown validate --all --table docs/src/validation/cases.md`.\n\n{table}"
        );
        write(path, &text)?;
    }
    let misses = lines.iter().filter(|l| !l.holds).count();
    if misses > 0 {
        return Err(Stop::Failed(format!("{misses} of {} numbers do not hold", lines.len())));
    }
    Ok(DONE)
}
