//! The files that a sweep writes when its points have ended.

use super::collect::Collected;
use super::error::SweepError;
use super::folder::SweepFolder;
use super::page::page;
use super::table::{table_csv, worst_csv};

/// Write `table.csv`, `worst.csv` and `sweep.html`.
///
/// # Errors
/// The disk's.
pub fn write_results(collected: &Collected, folder: &SweepFolder) -> Result<(), SweepError> {
    folder.write("table.csv", &table_csv(collected))?;
    folder.write("worst.csv", &worst_csv(collected))?;
    folder.write("sweep.html", &page(collected))
}
