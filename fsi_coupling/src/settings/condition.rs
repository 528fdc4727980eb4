//! Conditions under which a key has an effect: `.integrator = verlet | beeman and .kinematic_viscosity`.

use serde_json::{Map, Value};

use super::node::Node;

/// A table with its schema: what a path of a condition starts from.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub node: Node<'a>,
    pub content: &'a Map<String, Value>,
}

impl Place<'_> {
    /// The value at a path, or its default.
    fn value(self, path: &str) -> Option<Value> {
        let (key, rest) = path.split_once('.').map_or((path, None), |(key, rest)| (key, Some(rest)));
        let keys = self.node.keys(self.content);
        if let Some((_, value)) = keys.tags.iter().find(|(tag, _)| *tag == key) {
            return Some(Value::from(*value));
        }
        let node = keys.own(key)?;
        match rest {
            None => self.content.get(key).or(node.default()).cloned(),
            Some(rest) => {
                let empty = Map::new();
                let content = self.content.get(key).and_then(Value::as_object).unwrap_or(&empty);
                Place { node, content }.value(rest)
            }
        }
    }

    /// `here` and `root` satisfy the condition: paths that start with a dot are those of `here`.
    pub fn satisfies(here: Place, root: Place, condition: &str) -> bool {
        condition.split(" and ").all(|part| {
            let (path, words) = part.split_once(" = ").map_or((part, None), |(path, words)| (path, Some(words)));
            let value = match path.strip_prefix('.') {
                Some(path) => here.value(path),
                None => root.value(path),
            };
            match (value, words) {
                (Some(value), None) => !is_off(&value),
                (Some(value), Some(words)) => {
                    value.as_str().is_some_and(|value| words.split(" | ").any(|word| word == value))
                }
                (None, _) => false,
            }
        })
    }
}

/// False, zero, `none` and an empty list switch an option off.
pub(super) fn is_off(value: &Value) -> bool {
    match value {
        Value::Null | Value::Bool(false) => true,
        Value::Number(x) => x.as_f64() == Some(0.0),
        Value::String(word) => word == "none",
        Value::Array(items) => items.iter().all(is_off),
        _ => false,
    }
}
