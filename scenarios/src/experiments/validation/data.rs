//! The page of the reference data: each table with its quantity, units, source, nature, uncertainty and licence.

use report::Table;
use scene::reference;

/// Longest text of a cell [characters].
const LONGEST: usize = 220;

/// The page as Markdown.
pub fn page() -> String {
    let row = |(name, about): (String, Vec<String>)| {
        let line = |keys: &[&str]| {
            let found = keys.iter().find_map(|key| about.iter().find_map(|line| line.strip_prefix(key)));
            let text = found.unwrap_or("–").trim().replace('|', "/");
            if text.chars().count() > LONGEST { text.chars().take(LONGEST).collect::<String>() + " …" } else { text }
        };
        let first = about.first().cloned().unwrap_or_default();
        let quantity =
            if about.iter().any(|line| line.starts_with("quantity:")) { line(&["quantity:"]) } else { first };
        vec![
            format!("`{name}`"),
            quantity.replace('|', "/").chars().take(LONGEST).collect(),
            line(&["columns/units:"]),
            line(&["source paper:", "source:"]),
            line(&["nature:"]),
            line(&["uncertainty:"]),
            line(&["licence of that repository:", "licence:"]),
        ]
    };
    let rows = reference::builtin().into_iter().map(row).collect();
    Table::new("", &["file", "quantity", "units", "source", "nature", "uncertainty", "licence"], rows).markdown()
}
