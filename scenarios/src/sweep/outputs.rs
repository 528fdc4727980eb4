//! The files that a sweep writes when its points have ended.

use super::collect::Collected;
use super::error::SweepError;
use super::folder::SweepFolder;
use super::page::page;
use super::table::{table, worst_table};

/// Write `table.csv`, `table.parquet`, `worst.csv` and `sweep.html`.
///
/// # Errors
/// The disk's.
pub fn write_results(collected: &Collected, folder: &SweepFolder) -> Result<(), SweepError> {
    let table = table(collected);
    folder.write("table.csv", &table.to_csv())?;
    folder.write_with("table.parquet", |part| table.write_parquet(part))?;
    folder.write("worst.csv", &worst_table(collected).to_csv())?;
    folder.write("sweep.html", &page(collected))
}
