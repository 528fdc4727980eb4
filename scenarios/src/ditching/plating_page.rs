//! Tables of the plating on a landing's page.

use report::run_page::quantity::{Unit, digits, with_unit};
use report::{Block, Table, escape, row};

use super::plating::PlatingStress;

/// Tables and notes of each plating.
pub(super) fn blocks(plating: &[PlatingStress]) -> Vec<Block> {
    plating.iter().flat_map(|plating| [vec![Block::Table(bays(plating))], notes(plating)].concat()).collect()
}

fn bays(plating: &PlatingStress) -> Table {
    let most = plating.bays.iter().map(|bay| {
        bay.stress_pa.as_ref().map_or(0.0, |p| p.value).max(bay.static_stress_pa.as_ref().map_or(0.0, |p| p.value))
    });
    let unit = Unit::of("Pa", most.fold(0.0, f64::max));
    let none = || "–".to_string();
    let line = |bay: &super::plating::BayStress| {
        let [low, high] = bay.girth.map(|share| digits(100.0 * share));
        let stress = bay.stress_pa.as_ref();
        vec![
            format!("{low} to {high} %"),
            stress.map_or_else(none, |p| {
                digits(unit.scale * p.value) + if bay.doubt.is_some() { ", doubtful" } else { "" }
            }),
            bay.at_m.map_or_else(none, digits),
            stress.map_or_else(none, |p| digits(p.time_s)),
            bay.reserve_factor.map_or_else(none, digits),
            bay.static_stress_pa.as_ref().map_or_else(none, |p| digits(unit.scale * p.value)),
            bay.static_at_m.map_or_else(none, digits),
            bay.doubt.clone().unwrap_or_default(),
        ]
    };
    let head = [
        "bay, share of the girth".to_string(),
        format!("largest stress [{}]", unit.name),
        "from the nose [m]".into(),
        "time [s]".into(),
        "reserve factor".into(),
        format!("stress under the mean pressure at rest [{}]", unit.name),
        "from the nose [m]".into(),
        "doubt".into(),
    ];
    let title = format!(
        "Plating {}: elastic stresses by boundary elements in sections chosen by load, without a known band; stress_map.csv has all cells",
        plating.name
    );
    Table::new(&title, &head.each_ref().map(String::as_str), plating.bays.iter().map(line).collect())
}

/// The sections that were followed, and what is wrong with them.
fn notes(plating: &PlatingStress) -> Vec<Block> {
    if plating.sections.is_empty() {
        return vec![Block::Text(format!("Plating {}: it stays dry.", escape(&plating.name)))];
    }
    let line = |s: &super::plating::PlatingSection| {
        let state = match (&s.refused, &s.doubt) {
            (Some(why), _) => format!("not followed: {why}"),
            (None, Some(doubt)) => format!("doubtful: {doubt}"),
            (None, None) => "followed".into(),
        };
        let bay = s.girth.map(|share| digits(100.0 * share)).join(" to ") + " %";
        row(&[&digits(s.x_m), &digits(s.time_s), &bay, &with_unit(s.static_stress_pa, "Pa"), &state])
    };
    let head = ["from the nose [m]", "time [s]", "bay", "its stress at rest", "boundary elements"];
    vec![Block::Table(Table::new(
        format!("Sections of plating {}: where the pressure on a bay is largest", plating.name),
        &head,
        plating.sections.iter().map(line).collect(),
    ))]
}
