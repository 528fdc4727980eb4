//! The panels of `report.html`.

use crate::report::{Block, Table};
use crate::run::summary::Summary;
use crate::run::{Extremes, PanelResult};

/// Extremes over every step, by panel; nothing without panels.
pub(super) fn panels_section(summary: &Summary) -> Vec<Block> {
    summary
        .panels
        .iter()
        .flat_map(|(name, panel)| [table(name, panel)].into_iter().chain(broken(name, panel)))
        .collect()
}

fn table(name: &str, panel: &PanelResult) -> Block {
    let line = |what: &str, unit: &str, e: &Extremes| {
        let numbers = [e.least, e.least_at_s, e.most, e.most_at_s].map(|v| format!("{v:.5e}"));
        [vec![format!("{what} [{unit}]")], numbers.to_vec()].concat()
    };
    let mut rows = vec![
        line("normal force N", "N/m", &panel.normal_n_per_m),
        line("shear force Q", "N/m", &panel.shear_n_per_m),
        line("bending moment M", "N", &panel.moment_n),
        line("stress of outer fibres", "Pa", &panel.stress_pa),
        line("their strain", "-", &panel.strain),
    ];
    let single = |what: &str, value: f64| vec![what.to_string(), String::new(), String::new(), format!("{value:.4e}")];
    rows.extend(panel.reserve_factor.map(|factor| single("reserve factor: allowable over largest stress [-]", factor)));
    if panel.plastic_curvature_per_m > 0.0 {
        rows.push(single("plastic curvature left, largest [1/m]", panel.plastic_curvature_per_m));
    }
    for row in &mut rows {
        row.resize(5, String::new());
    }
    let head = ["quantity", "least", "at [s]", "most", "at [s]"].map(String::from).to_vec();
    Block::Table(Table { title: format!("{name}: extremes over every step"), head, rows })
}

/// The ruptures in a sentence.
fn broken(name: &str, panel: &PanelResult) -> Option<Block> {
    let each = panel.ruptures.iter();
    let told: Vec<String> = each
        .map(|r| {
            format!(
                "{name} broke off at ({:.4}, {:.4}) m, t = {:.6} s, at a strain of {:.4}",
                r.x_m, r.y_m, r.time_s, r.strain
            )
        })
        .collect();
    (!told.is_empty()).then(|| Block::Text(format!("{}.", told.join("; "))))
}
