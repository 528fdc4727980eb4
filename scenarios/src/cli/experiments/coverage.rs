//! `splashdown bands`.

use clap::Args;

use super::{Selection, lines_of, list};
use crate::cli::shared::{DONE, Output, Stop};
use crate::experiments::coverage::{CASES, cover, table};

#[derive(Args)]
pub struct BandsArgs {
    #[command(flatten)]
    selection: Selection,
}

const HEADING: &str = "# Error bars\n\nWritten by `splashdown bands --all --table docs/src/validation/error_bars.md`.";

pub fn run_bands(output: &Output, args: &BandsArgs) -> Result<u8, Stop> {
    if args.selection.is_empty() {
        return list(&CASES);
    }
    let lines = lines_of(output, &CASES.select(&args.selection.cases)?, cover)?;
    args.selection.show(output, &lines, HEADING, &table(&lines))?;
    Ok(DONE)
}
