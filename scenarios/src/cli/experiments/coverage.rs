//! `splashdown bands`.

use clap::Args;

use super::super::{Cli, DONE, Stop};
use super::{Selection, lines_of, list};
use crate::experiments::coverage::{CASES, cover, table};

#[derive(Args)]
pub(in crate::cli) struct BandsArgs {
    #[command(flatten)]
    selection: Selection,
}

const HEADING: &str = "# Error bars\n\nWritten by `splashdown bands --all --table docs/src/validation/error_bars.md`.";

pub(in crate::cli) fn run_bands(cli: &Cli, args: &BandsArgs) -> Result<u8, Stop> {
    if args.selection.is_empty() {
        return list(&CASES);
    }
    let lines = lines_of(cli, &CASES.select(&args.selection.cases)?, cover)?;
    args.selection.show(cli, &lines, HEADING, &table(&lines))?;
    Ok(DONE)
}
