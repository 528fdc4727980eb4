//! Sections of numbers that stand beside the results: loads of the rules, and a section between free ends.

use run::stated_numbers::{FiniteLength, RuleLoad, Share};

use super::quantity::{digits, with_unit};
use super::record::Record;
use crate::{Block, Table, row};

/// Loads that rules state, with the computed number that is next to each.
pub(super) fn rules_section(record: &Record) -> Vec<Block> {
    if record.rule_loads.is_empty() {
        return Vec::new();
    }
    let number = |value: Option<f64>, si: &str| value.map(|value| with_unit(value, si));
    let shown = |load: &RuleLoad| {
        let by_rule = number(load.value, &load.unit).or_else(|| load.reason.clone()).unwrap_or("–".into());
        let computed = number(load.computed, &load.unit).unwrap_or("–".into());
        let what = load.computed_is.as_deref().unwrap_or_default();
        row(&[&format!("14 CFR {}", load.paragraph), &load.load, &by_rule, &computed, what])
    };
    let head = ["paragraph", "load", "by the rule", "computed", "which is"];
    vec![
        Block::Table(Table::new("Loads that rules state", &head, record.rule_loads.iter().map(shown).collect())),
        Block::Text(
            "A rule's number stands for the worst landing of an aircraft at its stalling speed, in waves; it does not know the speed of this \
             run. It replaces no computed number. §§ 25.523–25.537 are for seaplanes and apply unless a more rational analysis is made \
             (25.521(b))."
                .into(),
        ),
    ]
}

/// The share of the loads between two free ends.
pub(super) fn ends_section(record: &Record) -> Vec<Block> {
    let Some(FiniteLength { length_m, peak_force, impulse }) = record.ends else { return Vec::new() };
    let shown = |what: &str, si: &str, share: Option<Share>| {
        let Some(Share { factor, band, wetted_breadth_m, aspect_ratio, whole }) = share else {
            return row(&[what, "–", "–", "–", "no such result, or past wet chines: no factor is known"]);
        };
        let factor = format!("{} ± {}", digits(factor), digits(band));
        row(&[what, &factor, &with_unit(wetted_breadth_m, "m"), &digits(aspect_ratio), &with_unit(whole, si)])
    };
    let rows = vec![shown("Peak force", "N", peak_force), shown("Impulse", "N s", impulse)];
    let head = ["result", "factor", "wetted breadth", "length over it", "whole section"];
    let title = format!("With two free ends, {} long", with_unit(length_m, "m"));
    vec![
        Block::Table(Table::new(title, &head, rows)),
        Block::Text(
            "The results above are those of an endless section. The band is the spread of two formulas (Pabst 1930; a rectangular plate in \
             potential flow), for the same motion; a body that is free is slowed less by its shorter section. Walls near the ends, or parts of \
             the hull beyond them, bring the factor nearer to 1."
                .into(),
        ),
    ]
}
