//! From a file's text to the table that it gives.

use fsi_coupling::settings::Problem;
use toml::{Table, Value};

use super::error::SceneError;
use super::overrides::apply_set;
use super::source::Source;

/// Beyond any length [m], time [s], mass [kg/m] or factor of a scene.
const LARGEST_NUMBER: f64 = 1e12;

impl Source {
    /// The file with its `--set` arguments applied in their order.
    pub fn read(&self) -> Result<serde_json::Value, SceneError> {
        let mut table: Table = self.text.parse().map_err(|error| self.syntax_error(&error))?;
        for set in &self.sets {
            apply_set(&mut table, set)?;
        }
        let value = Value::Table(table);
        refuse_absurd_numbers("", &value).map_err(|problem| self.error(problem))?;
        Ok(serde_json::to_value(value).unwrap_or_default())
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
