//! From a file's text to the keys that it gives.

use serde::de::DeserializeOwned;
use serde_path_to_error as tracked;
use toml::{Table, Value};

use super::error::SceneError;
use super::keywords::{self, Keyword};
use super::overrides::apply_set;
use super::problem::Problem;
use super::source::Source;

/// Beyond any length [m], time [s], mass [kg/m] or factor of a scene.
const LARGEST_NUMBER: f64 = 1e12;

impl Source {
    /// The file with its `--set` arguments applied in their order.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, SceneError> {
        let mut table: Table = self.text.parse().map_err(|error| self.syntax_error(&error))?;
        for set in &self.sets {
            apply_set(&mut table, set)?;
        }
        let value = Value::Table(table);
        refuse_absurd_numbers("", &value).map_err(|problem| self.error(problem))?;
        tracked::deserialize(value).map_err(|error| self.error(unreadable(&error, self.keys)))
    }
}

/// TOML can say `nan`, `inf` and 1e300; no key of a scene can mean them, and sums of squares need not survive them.
fn refuse_absurd_numbers(path: &str, value: &Value) -> Result<(), Problem> {
    match value {
        Value::Float(number) if number.is_nan() || number.abs() > LARGEST_NUMBER => {
            Err(Problem::new(path, number, format!("a finite number up to {LARGEST_NUMBER:e}")))
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

/// Serde's names of types in a user's words.
fn plain(complaint: &str) -> String {
    let said = complaint.replace("expected f64", "expected a number");
    let said = said.replace("expected u32", &format!("expected a whole number from 0 to {}", u32::MAX));
    let said = said.replace("expected i64", "expected a whole number");
    let said =
        said.replace("expected a sequence", "expected a list (of tables: a heading in double brackets, [[...]])");
    let said = said.replace("expected fewer elements in array", "expected two numbers");
    match said.split_once("expected struct ") {
        Some((given, _)) => format!("{given}expected a table of keys"),
        None => said,
    }
}

/// Serde's complaint about a value or a key.
fn unreadable(error: &tracked::Error<toml::de::Error>, keys: &'static [Keyword]) -> Problem {
    let key = error.path().to_string();
    let complaint = error.inner().message();
    let sentence = match complaint.starts_with("unknown field") {
        false => format!("`{key}`: {}", plain(complaint)),
        true => match keywords::nearest(keys, &key) {
            Some(known) => {
                format!("unknown key `{key}`: expected a key of a scene, such as `{known}`")
            }
            None => format!("unknown key `{key}`: expected a key of a scene"),
        },
    };
    Problem { key, sentence }
}
