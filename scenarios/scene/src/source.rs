//! The text that a scene comes from, the `--set` arguments that change it, and where in it a key stands.

use std::io::ErrorKind;
use std::ops::Range;
use std::sync::Arc;

use miette::NamedSource;
use settings::{Keyword, Problem, Schema, is_quantity, require};
use toml::de::{DeTable, DeValue};
use toml::{Table, Value};

use super::error::SceneError;
use super::mistaken_file::{Expected, refuse_folder, refuse_other_kind};
use crate::bounded_text::read_text;
use crate::spelling::nearest;

/// Beyond any length [m], time [s], mass [kg/m] or factor of a scene.
pub const LARGEST_NUMBER: f64 = 1e12;

/// Longest line that a message draws whole, and how much of a longer one it shows before and behind a mistake [bytes].
const WIDEST_LINE: usize = 2_000;
const PART_SHOWN: usize = 60;

/// Most keys in the path of an argument: no scene has as many, and deeper tables would not fit on the stack.
const DEEPEST: usize = 32;

/// A scene's text and the `--set` arguments that change it.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// The file, or the name of a built-in one.
    pub name: String,
    /// Its text.
    pub text: String,
    /// `--set` arguments, in their order.
    pub sets: Vec<String>,
    /// The schema of such a file.
    pub schema: &'static Schema,
}

impl Source {
    /// A file by its path, or a built-in one by its name.
    pub fn find(
        expected: Expected,
        builtin: &[(&str, &str)],
        name_or_path: &str,
        sets: &[String],
        schema: &'static Schema,
    ) -> Result<Source, SceneError> {
        let path = name_or_path.to_string();
        let (name, text) = match builtin.iter().find(|(name, _)| *name == path) {
            Some((name, text)) => (format!("{name}.toml"), text.to_string()),
            None => match refuse_folder(&path, expected).map(|()| read_text(&path))? {
                Ok(text) => {
                    refuse_other_kind(&path, &text, expected)?;
                    (path, text)
                }
                Err(cause) if cause.kind() == ErrorKind::NotFound => {
                    let names: Vec<&str> = builtin.iter().map(|(name, _)| *name).collect();
                    let help = format!("built-in {}: {}", expected.plural(), names.join(", "));
                    let near = nearest(&path, names).map(String::from);
                    let kind = expected.name().trim_start_matches("a ");
                    return Err(SceneError::Unknown { name: path, kind, near, help });
                }
                Err(cause) => return Err(SceneError::Unreadable { path, cause }),
            },
        };
        Ok(Source { name, text, sets: sets.to_vec(), schema })
    }

    /// The file as a table.
    pub fn table(&self) -> Result<Table, SceneError> {
        self.text.parse().map_err(|error| self.syntax_error(&error))
    }

    /// The file with its `--set` arguments applied in their order.
    pub fn read(&self) -> Result<serde_json::Value, SceneError> {
        let mut table = self.table()?;
        for set in &self.sets {
            apply_set(&mut table, set)?;
        }
        let value = Value::Table(table);
        refuse_absurd_numbers("", &value).map_err(|problem| self.error(problem))?;
        let given = serde_json::to_value(value).unwrap_or_default();
        self.schema.in_si(given, LARGEST_NUMBER).map_err(|problem| self.error(problem))
    }

    /// Puts a problem in its place: the last `--set` argument that wrote the key, else its line in the text.
    pub fn error(&self, problem: Problem) -> SceneError {
        let help = self.schema.keyword(&problem.key).map(Keyword::help);
        match self.sets.iter().rfind(|set| writes(set, &problem.key)) {
            Some(argument) => SceneError::Set { argument: argument.clone(), problem: problem.into(), help },
            None => self.error_at(self.span(&problem.key), problem, help),
        }
    }

    /// What the TOML parser has to say about the text.
    fn syntax_error(&self, error: &toml::de::Error) -> SceneError {
        let span = error.span().unwrap_or(0..0);
        let hint = if self.has_decimal_comma(span.start) { "; a decimal comma? TOML has decimal points" } else { "" };
        let sentence = format!("not valid TOML: {}{hint}", error.message());
        let problem = Problem { sentence, expected: "valid TOML".into(), ..Problem::default() };
        self.error_at(span, problem, None)
    }

    /// True where the line at a place is a key with a number that has a decimal comma.
    fn has_decimal_comma(&self, at: usize) -> bool {
        let line = 1 + self.text.as_bytes().iter().take(at).filter(|byte| **byte == b'\n').count();
        let value =
            self.text.lines().nth(line - 1).and_then(|line| line.split_once('=')).map(|(_, value)| value.trim());
        let parts = value.and_then(|value| value.split('#').next()?.trim().split_once(','));
        let digits = |part: &str| !part.is_empty() && part.chars().all(|c| c.is_ascii_digit());
        parts.is_some_and(|(whole, rest)| digits(whole.trim_start_matches(['-', '+'])) && digits(rest))
    }

    fn error_at(&self, span: Range<usize>, problem: Problem, help: Option<String>) -> SceneError {
        let before = &self.text.as_bytes()[..span.start.min(self.text.len())];
        let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
        let (shown, span) = self.shown(span);
        let text = Arc::new(NamedSource::new(&self.name, shown));
        SceneError::File { name: self.name.clone(), line, problem: problem.into(), text, span: span.into(), help }
    }

    /// The text that a message shows, and the place in it: all of it, or a part where the text is too wide to be drawn.
    fn shown(&self, span: Range<usize>) -> (String, Range<usize>) {
        if self.text.lines().all(|line| line.len() <= WIDEST_LINE) {
            return (self.text.clone(), span);
        }
        let boundary = |byte: &usize| self.text.is_char_boundary(*byte);
        let at = |byte: usize| (0..=byte.min(self.text.len())).rev().find(boundary).unwrap_or(0);
        let (start, end) = (at(span.start.saturating_sub(PART_SHOWN)), at(span.start.saturating_add(PART_SHOWN)));
        let place = at(span.start) - start..at(span.end).min(end).max(at(span.start)) - start;
        (self.text[start..end].to_string(), place)
    }

    /// Where the value of a key stands; a key that no scene has, itself; for a key that is not written, its table's header. A key in quotes
    /// may be several steps of the path.
    pub fn span(&self, key: &str) -> Range<usize> {
        let Ok(document) = DeTable::parse(&self.text) else {
            return 0..0;
        };
        let known = self.schema.keyword(key).is_some();
        let mut span = 0..0;
        let mut value = &DeValue::Table(document.into_inner());
        let path: Vec<Segment> = segments(key).collect();
        let mut rest = path.as_slice();
        while let Some(step) = rest.first() {
            let found = match (step, value) {
                (_, DeValue::Table(table)) => {
                    let fitting = table.iter().filter_map(|(key, item)| {
                        let steps: Vec<Segment> = segments(key.get_ref()).collect();
                        let behind = rest.strip_prefix(steps.as_slice()).filter(|_| !steps.is_empty())?;
                        let place = if known && !item.get_ref().is_table() { item.span() } else { key.span() };
                        Some((place, item, behind))
                    });
                    fitting.min_by_key(|(_, _, behind)| behind.len())
                }
                (Segment::Index(index), DeValue::Array(items)) => {
                    items.get(*index).map(|item| (item.span(), item, &rest[1..]))
                }
                _ => None,
            };
            let Some((place, item, behind)) = found else {
                break;
            };
            (span, value, rest) = (place, item.get_ref(), behind);
        }
        span
    }
}

/// Does the argument write the key, a table around it or an item in it?
fn writes(set: &str, key: &str) -> bool {
    assignment(set).is_some_and(|(path, _)| segments(path).zip(segments(key)).all(|(a, b)| a == b))
}

/// TOML can say `nan`, `inf`, 1e300 and 2^63 - 1; no key of a scene can mean them, and sums of squares need not survive them.
pub fn refuse_absurd_numbers(path: &str, value: &Value) -> Result<(), Problem> {
    match value {
        Value::Float(number) if number.is_nan() || number.abs() > LARGEST_NUMBER => {
            Err(Problem::new(path, number, format!("a finite number up to {LARGEST_NUMBER:e}")))
        }
        Value::Integer(number) if number.unsigned_abs() as f64 > LARGEST_NUMBER => {
            Err(Problem::new(path, number, format!("a number up to {LARGEST_NUMBER:e}")))
        }
        Value::Array(items) => {
            let mut items = items.iter().enumerate();
            items.try_for_each(|(i, item)| refuse_absurd_numbers(&format!("{path}[{i}]"), item))
        }
        Value::Table(table) => table.iter().try_for_each(|(key, value)| {
            let dot = if path.is_empty() { "" } else { "." };
            refuse_absurd_numbers(&format!("{path}{dot}{key}"), value)
        }),
        _ => Ok(()),
    }
}

/// Refuses a name of a file or column that has other characters than letters, digits, `_` and `-`.
pub fn word(key: &str, name: &str) -> Result<(), Problem> {
    let fits = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    let fits = (1..=LONGEST_WORD).contains(&name.len()) && name.chars().all(fits);
    let start: String = name.chars().take(LONGEST_WORD).collect();
    let expected = format_args!("a word of letters, digits, _ and -, at most {LONGEST_WORD}");
    require(fits, key, format_args!("{start:?}"), expected)
}

/// Longest name: it becomes a folder's.
const LONGEST_WORD: usize = 100;
/// One step of a key's path: `gauges[0].at` is the key `gauges`, the index 0, the key `at`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Segment<'a> {
    /// A key of a table.
    Key(&'a str),
    /// A place in a list.
    Index(usize),
}

/// The steps of a path; `gauges[0].at` and `gauges.0.at` are the same.
pub fn segments(path: &str) -> impl Iterator<Item = Segment<'_>> {
    let steps = path.split(['.', '[', ']']).filter(|step| !step.is_empty());
    steps.map(|step| step.parse().map_or(Segment::Key(step), Segment::Index))
}

/// The two sides of `key.path=value`.
pub(super) fn assignment(set: &str) -> Option<(&str, &str)> {
    let (path, value) = set.split_once('=')?;
    Some((path.trim(), value.trim()))
}

/// Writes `key.path=value` into a scene's table. The value is TOML; a bare word is a string, `fluid.kernel=gaussian`, and so is a
/// number with a unit, `body.mass=2 t/m`.
///
/// Tables on the way are made where they are missing, items of arrays are not. Whether a scene knows the key is seen
/// when the table is read as one.
pub fn apply_set(table: &mut Table, set: &str) -> Result<(), SceneError> {
    let refuse = |sentence: String| {
        let problem = Problem { sentence, given: Some(set.to_string()), ..Problem::default() };
        SceneError::Set { argument: set.to_string(), problem: problem.into(), help: None }
    };
    let form = || refuse("expected the form key.path=value".to_string());
    let (path, text) = assignment(set).ok_or_else(form)?;
    let steps: Vec<Segment> = segments(path).collect();
    let (Some(Segment::Key(_)), false) = (steps.first(), text.is_empty()) else {
        return Err(form());
    };
    if path.contains("..") || path.starts_with('.') || path.ends_with('.') {
        return Err(form());
    }
    if steps.len() > DEEPEST {
        return Err(refuse(format!("expected a path of at most {DEEPEST} keys, {} given", steps.len())));
    }
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
        Err(_) if is_quantity(text) => Ok(Value::String(text.to_string())),
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
