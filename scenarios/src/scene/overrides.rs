//! `--set key.path=value`: single values of a scene, changed from outside its file.

use toml::{Table, Value};

use super::error::SceneError;

/// One step of a key's path: `gauges[0].at` is the key `gauges`, the index 0, the key `at`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Segment<'a> {
    Key(&'a str),
    Index(usize),
}

/// The steps of a path; `gauges[0].at` and `gauges.0.at` are the same.
pub(super) fn segments(path: &str) -> impl Iterator<Item = Segment<'_>> {
    let steps = path.split(['.', '[', ']']).filter(|step| !step.is_empty());
    steps.map(|step| step.parse().map_or(Segment::Key(step), Segment::Index))
}

/// The two sides of `key.path=value`.
pub(super) fn assignment(set: &str) -> Option<(&str, &str)> {
    let (path, value) = set.split_once('=')?;
    Some((path.trim(), value.trim()))
}

/// Writes `key.path=value` into a scene's table. The value is TOML; a bare word is a string: `fluid.kernel=gaussian`.
///
/// Tables on the way are made where they are missing, items of arrays are not. Whether a scene knows the key is seen
/// when the table is read as one.
pub fn apply_set(table: &mut Table, set: &str) -> Result<(), SceneError> {
    let refuse = |problem: String| SceneError::Set { argument: set.to_string(), problem, help: None };
    let form = || refuse("expected the form key.path=value".to_string());
    let (path, text) = assignment(set).ok_or_else(form)?;
    let steps: Vec<Segment> = segments(path).collect();
    let (Some(Segment::Key(_)), false) = (steps.first(), text.is_empty()) else {
        return Err(form());
    };
    let value = parse(text).map_err(|why| refuse(format!("`{path}` = {text}: expected a TOML value; {why}")))?;
    *slot(table, &steps).map_err(|why| refuse(format!("`{path}`: {why}")))? = value;
    Ok(())
}

fn parse(text: &str) -> Result<Value, String> {
    let bare = |c: char| c.is_alphanumeric() || "_-./ ".contains(c);
    match text.parse::<Value>() {
        Ok(value) => Ok(value),
        Err(_) if text.starts_with(char::is_alphabetic) && text.chars().all(bare) => {
            Ok(Value::String(text.to_string()))
        }
        Err(error) => Err(error.message().to_string()),
    }
}

/// The place that a path leads to.
fn slot<'a>(table: &'a mut Table, steps: &[Segment]) -> Result<&'a mut Value, String> {
    let empty = || Value::Table(Table::new());
    let (Some(Segment::Key(first)), rest) = (steps.first(), &steps[1..]) else {
        return Err("expected a key first".to_string());
    };
    let mut value = table.entry(*first).or_insert_with(empty);
    let mut so_far = (*first).to_string();
    for step in rest {
        let kind = value.type_str();
        value = match (step, value) {
            (Segment::Key(key), Value::Table(table)) => {
                so_far.push_str(&format!(".{key}"));
                table.entry(*key).or_insert_with(empty)
            }
            (Segment::Index(index), Value::Array(items)) => {
                let count = items.len();
                let item = items.get_mut(*index);
                item.ok_or_else(|| format!("{so_far} has {count} items: expected an index below {count}"))?
            }
            (Segment::Key(key), _) => {
                return Err(format!("{so_far} is of type {kind}: expected a table with {key}"));
            }
            (Segment::Index(index), _) => {
                return Err(format!("{so_far} is of type {kind}: expected an array with an item {index}"));
            }
        };
        if let Segment::Index(index) = step {
            so_far.push_str(&format!("[{index}]"));
        }
    }
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(text: &str, set: &str) -> Result<Table, String> {
        let mut table: Table = text.parse().expect("valid TOML");
        apply_set(&mut table, set).map_err(|error| error.to_string())?;
        Ok(table)
    }

    #[test]
    fn values_are_toml_and_bare_words_are_strings() {
        for (given, value) in [
            ("a.b=2", Value::Integer(2)),
            ("a.b = 2.5e-3", Value::Float(2.5e-3)),
            ("a.b=[1, 2]", Value::Array(vec![Value::Integer(1), Value::Integer(2)])),
            ("a.b=true", Value::Boolean(true)),
            ("a.b=\"2\"", Value::String("2".to_string())),
            ("a.b=cubic_spline", Value::String("cubic_spline".to_string())),
            ("a.b=x=1", Value::Integer(0)),
        ] {
            match set("", given) {
                Ok(table) => assert_eq!(table["a"]["b"], value, "{given}"),
                Err(message) => assert!(given == "a.b=x=1" && message.contains("expected a TOML value"), "{message}"),
            }
        }
    }

    #[test]
    fn items_of_arrays_are_reached_both_ways() {
        for path in ["g[1].at", "g.1.at"] {
            let table = set("g = [{ at = 1 }, { at = 2 }]", &format!("{path}=3")).expect("both items exist");
            assert_eq!(table["g"][1]["at"], Value::Integer(3));
        }
    }

    #[test]
    fn a_path_that_leads_nowhere_says_where_it_ends() {
        for (given, expected) in [
            ("g[2].at=3", "--set g[2].at=3: `g[2].at`: g has 1 items: expected an index below 1"),
            ("a.b.c=3", "--set a.b.c=3: `a.b.c`: a.b is of type integer: expected a table with c"),
            ("a=", "--set a=: expected the form key.path=value"),
            ("a", "--set a: expected the form key.path=value"),
        ] {
            assert_eq!(set("g = [{ at = 1 }]\na = { b = 1 }", given), Err(expected.to_string()));
        }
    }
}
