//! The error bars of `report.html`.

use crate::report::table::row;
use crate::report::{Block, Table};
use crate::run::summary::Summary;

/// Main numbers with their bands.
pub(super) fn error_bars_section(summary: &Summary) -> Vec<Block> {
    let text = "Error bars of main numbers. The band is centred on the extrapolated value if a convergence study was made, else on \
                the value of the run.";
    let rows = summary.error_bars.iter().map(|(path, bar)| {
        let known = |value: Option<f64>, digits: usize| value.map_or("–".into(), |v| format!("{v:.digits$}"));
        let percent = 100.0 * (bar.band / bar.middle()).abs();
        row(&[
            path,
            &format!("{:.5e}", bar.value),
            &bar.extrapolated.map_or("–".into(), |v| format!("{v:.5e}")),
            &format!("{:.2e}", bar.band),
            &format!("{percent:.2}"),
            &known(bar.order, 2),
            &bar.verdict,
            &bar.method,
        ])
    });
    let head = ["number", "value", "extrapolated", "band ±", "band [%]", "order", "verdict", "method"];
    let table = Table { title: "Error bars".into(), head: row(&head), rows: rows.collect() };
    vec![Block::Text(text.into()), Block::Table(table)]
}
