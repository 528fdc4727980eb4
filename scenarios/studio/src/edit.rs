//! Edits of a scene's text: one key changes, comments and all other lines stay.

use scene::source::{Segment, segments};
use serde::Deserialize;
use serde_json::{Map, Value as Json, json};
use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value};

/// A key's new value.
#[derive(Clone, Debug, Deserialize)]
pub struct Edit {
    /// Its path, such as `gauges[0].at`.
    pub key: String,
    /// Its value as TOML, a bare word, or a number with a unit; `None` removes the key.
    pub value: Option<String>,
}

impl Edit {
    /// A key gets a value.
    pub fn set(key: &str, value: &str) -> Edit {
        Edit { key: key.into(), value: Some(value.into()) }
    }

    /// A key is removed.
    pub fn remove(key: &str) -> Edit {
        Edit { key: key.into(), value: None }
    }
}

/// An edit that cannot be made, or a text that is no TOML.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{why}")]
pub struct EditError {
    /// The key.
    pub key: Option<String>,
    /// Why.
    pub why: String,
}

/// The text with its edits.
///
/// # Errors
/// A text that is no TOML, a key that leads nowhere.
pub fn apply(text: &str, edits: &[Edit]) -> Result<String, EditError> {
    if edits.is_empty() {
        return Ok(text.to_string());
    }
    let mut document: DocumentMut = text
        .parse()
        .map_err(|error: toml_edit::TomlError| EditError { key: None, why: error.message().to_string() })?;
    for edit in edits {
        let steps: Vec<Segment<'_>> = segments(&edit.key).collect();
        let value = edit.value.as_deref().map(|text| value(&edit.key, text));
        change(document.as_item_mut(), &steps, value)
            .map_err(|why| EditError { key: Some(edit.key.clone()), why: format!("{}: {why}", edit.key) })?;
    }
    Ok(document.to_string())
}

/// The value of a text: TOML, or a string.
fn value(key: &str, text: &str) -> Value {
    let is_text = scene::schema().keyword(key).is_some_and(|keyword| keyword.takes == "a string");
    let text = text.trim();
    match text.parse::<Value>() {
        Ok(value) if !is_text || value.is_str() => value,
        _ => Value::from(text),
    }
}

fn change(item: &mut Item, steps: &[Segment<'_>], value: Option<Value>) -> Result<(), String> {
    match (steps, value) {
        ([], Some(value)) => put(item, value),
        ([], None) => *item = Item::None,
        ([Segment::Key(key)], None) => {
            item.as_table_like_mut().ok_or("expected a table")?.remove(key);
        }
        ([Segment::Index(index)], None) => match item {
            Item::ArrayOfTables(tables) if *index < tables.len() => drop(tables.remove(*index)),
            Item::Value(Value::Array(items)) if *index < items.len() => drop(items.remove(*index)),
            _ => return Err(format!("there is no item {index}")),
        },
        ([Segment::Key(key), rest @ ..], value) => {
            let inline = item.is_value();
            let table = item.as_table_like_mut().ok_or_else(|| format!("expected a table with {key}"))?;
            if value.is_none() && !table.contains_key(key) {
                return Ok(());
            }
            let empty = || match rest {
                [] => Item::None,
                [Segment::Index(_), _, ..] if !inline => Item::ArrayOfTables(ArrayOfTables::new()),
                [Segment::Index(_), ..] => Item::Value(Array::new().into()),
                _ if inline => Item::Value(InlineTable::new().into()),
                _ => Item::Table(Table::new()),
            };
            let place = table.entry(key).or_insert_with(empty);
            change(place, rest, value)?;
        }
        ([Segment::Index(index), rest @ ..], value) => {
            if let Some(tables) = item.as_array_of_tables_mut() {
                if *index == tables.len() {
                    tables.push(Table::new());
                }
                let count = tables.len();
                let table = tables.get_mut(*index).ok_or_else(|| format!("there are {count}"))?;
                let mut one = Item::Table(std::mem::take(table));
                let done = change(&mut one, rest, value);
                *table = one.into_table().unwrap_or_default();
                return done;
            }
            let items = item.as_array_mut().ok_or("expected a list")?;
            let count = items.len();
            let place = items.get_mut(*index).ok_or_else(|| format!("there are {count}"))?;
            let mut one = Item::Value(place.clone());
            change(&mut one, rest, value)?;
            *place = one.into_value().map_err(|_| "expected a value")?;
        }
    }
    Ok(())
}

/// Puts a value in place of another, with the blanks and comments about it.
fn put(item: &mut Item, mut value: Value) {
    if let Some(old) = item.as_value() {
        *value.decor_mut() = old.decor().clone();
    } else {
        value.decor_mut().clear();
    }
    *item = Item::Value(value);
}

/// The keys of a text with their values as written, strings without quotes; `None` where it is no TOML.
pub fn written(text: &str) -> Option<Map<String, Json>> {
    let document: DocumentMut = text.parse().ok()?;
    let mut keys = Map::new();
    collect(document.as_item(), "", &mut keys);
    Some(keys)
}

fn collect(item: &Item, path: &str, keys: &mut Map<String, Json>) {
    if let Some(tables) = item.as_array_of_tables() {
        for (k, table) in tables.iter().enumerate() {
            collect_table(table.iter(), &format!("{path}[{k}]"), keys);
        }
    } else if let Some(table) = item.as_table_like() {
        collect_table(table.iter(), path, keys);
    } else if let Some(value) = item.as_value() {
        let tables = value.as_array().filter(|items| !items.is_empty() && items.iter().all(Value::is_inline_table));
        match (tables, value.as_str()) {
            (Some(tables), _) => {
                for (k, table) in tables.iter().enumerate() {
                    collect(&Item::Value(table.clone()), &format!("{path}[{k}]"), keys);
                }
            }
            (None, Some(text)) => drop(keys.insert(path.into(), json!(text))),
            (None, None) => {
                let mut plain = value.clone();
                plain.decor_mut().clear();
                keys.insert(path.into(), json!(plain.to_string()));
            }
        }
    }
}

fn collect_table<'a>(entries: impl Iterator<Item = (&'a str, &'a Item)>, path: &str, keys: &mut Map<String, Json>) {
    let dot = if path.is_empty() { "" } else { "." };
    entries.for_each(|(key, item)| collect(item, &format!("{path}{dot}{key}"), keys));
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "name = \"a\" # a word\n\n[body]\nmass = 120.0   # kg/m\npoints = [\n    [0, 0], [1, 1],\n]\n\n[[gauges]]\nname = \"p1\"\nat = [0.2, 0.1]\n";

    fn edited(key: &str, value: &str) -> String {
        apply(TEXT, &[Edit::set(key, value)]).expect("an edit that can be made")
    }

    #[test]
    fn an_edit_keeps_comments_and_all_other_lines() {
        assert_eq!(edited("body.mass", "90"), TEXT.replace("120.0", "90"));
        assert_eq!(edited("gauges[0].at", "[0.3, 0.2]"), TEXT.replace("[0.2, 0.1]", "[0.3, 0.2]"));
        assert_eq!(apply(TEXT, &[Edit::set("body.mass", "1"), Edit::set("body.mass", "120.0")]), Ok(TEXT.into()));
        assert_eq!(edited("name", "2024"), TEXT.replace("\"a\"", "\"2024\""), "a word stays a word");
        assert_eq!(edited("body.mass", "2 t/m"), TEXT.replace("120.0", "\"2 t/m\""));
    }

    #[test]
    fn keys_and_tables_are_added_and_removed() {
        assert!(edited("body.breadth", "2").contains("]\nbreadth = 2\n"));
        assert!(edited("fluid.water", "sea_15C").contains("[fluid]\nwater = \"sea_15C\"\n"));
        assert!(edited("gauges[1].name", "p2").ends_with("at = [0.2, 0.1]\n\n[[gauges]]\nname = \"p2\"\n"));
        let less = apply(TEXT, &[Edit::remove("body.mass"), Edit::remove("gauges[0]"), Edit::remove("tank.depth")]);
        let less = less.expect("keys that are there");
        assert!(!less.contains("mass") && !less.contains("p1") && less.contains("points"), "{less}");
        let refused = apply(TEXT, &[Edit::set("name.of", "2")]).expect_err("no table");
        assert_eq!(refused.key.as_deref(), Some("name.of"));
    }

    #[test]
    fn written_keys_have_their_paths_and_strings_no_quotes() {
        let keys = written(TEXT).expect("valid TOML");
        let of = |key: &str| keys.get(key).and_then(Json::as_str);
        assert_eq!([of("name"), of("body.mass"), of("gauges[0].at")], [Some("a"), Some("120.0"), Some("[0.2, 0.1]")]);
        assert_eq!(written("a = = 1"), None);
    }
}
