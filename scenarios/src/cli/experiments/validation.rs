//! `splashdown validate`.

use std::path::PathBuf;

use clap::Args;

use super::{Selection, lines_of, list};
use crate::cli::shared::{DONE, Output, Stop};
use crate::experiments::validation::{CASES, table, validate};

#[derive(Args)]
pub struct ValidateArgs {
    #[command(flatten)]
    selection: Selection,
    /// Keep each case's files below this folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

const HEADING: &str = "# Validation\n\nWritten by `splashdown validate --all --table docs/src/validation/cases.md`.";

pub fn run_validation(output: &Output, args: &ValidateArgs) -> Result<u8, Stop> {
    if args.selection.is_empty() {
        return list(&CASES);
    }
    let lines = lines_of(output, &CASES.select(&args.selection.cases)?, |case| validate(case, args.out.as_ref()))?;
    args.selection.show(output, &lines, HEADING, &table(&lines))?;
    match lines.iter().filter(|l| !l.holds).count() {
        0 => Ok(DONE),
        misses => Err(Stop::Failed(format!("{misses} of {} numbers do not hold", lines.len()))),
    }
}
