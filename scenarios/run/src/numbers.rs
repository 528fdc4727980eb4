//! Numbers of a summary by their paths in `summary.json`.

use serde::Serialize;
use serde_json::Value;

/// The numbers of a summary.
///
/// # Example
/// ```
/// use run::numbers::Numbers;
///
/// let numbers = Numbers::of(&serde_json::json!({"audit": {"momentum": 1e-15}, "peaks": [2.0]}));
/// assert_eq!(numbers.get("audit/momentum"), Some(1e-15));
/// assert_eq!(numbers.paths(), ["audit/momentum", "peaks/0"]);
/// ```
#[derive(Clone, Debug)]
pub struct Numbers(Value);

impl Numbers {
    /// Of a summary.
    pub fn of(summary: &impl Serialize) -> Numbers {
        Numbers(serde_json::to_value(summary).unwrap_or_default())
    }

    /// The number at a path, keys joined by `/`.
    pub fn get(&self, path: &str) -> Option<f64> {
        self.0.pointer(&format!("/{path}")).and_then(Value::as_f64)
    }

    /// Paths of all numbers.
    pub fn paths(&self) -> Vec<String> {
        let mut known = Vec::new();
        paths_below("", &self.0, &mut known);
        known
    }
}

fn paths_below(path: &str, value: &Value, known: &mut Vec<String>) {
    let below = |key: &str| if path.is_empty() { key.to_string() } else { format!("{path}/{key}") };
    match value {
        Value::Number(_) => known.push(path.to_string()),
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(k, v)| paths_below(&below(&k.to_string()), v, known));
        }
        Value::Object(map) => map.iter().for_each(|(key, v)| paths_below(&below(key), v, known)),
        _ => {}
    }
}
