//! A scene on its way from a file to its settings: values that depend on others are filled in one after another.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use settings::{Problem, Schema};

use super::source::{Segment, segments};

/// A table of settings that has been checked against its schema and is not yet complete.
#[derive(Clone)]
pub struct Draft {
    table: Value,
    schema: &'static Schema,
}

impl Draft {
    /// Of a table as it was given, if it fits the schema.
    pub fn of(given: &Value, schema: &'static Schema) -> Result<Draft, Problem> {
        Ok(Draft { table: schema.check(given)?, schema })
    }

    fn at(&self, path: &str) -> Option<&Value> {
        segments(path).try_fold(&self.table, |value, step| match step {
            Segment::Key(key) => value.get(key),
            Segment::Index(index) => value.get(index),
        })
    }

    /// True for a key that was given.
    pub fn is_given(&self, path: &str) -> bool {
        self.at(path).is_some()
    }

    /// The value at a path, where it is given.
    pub fn get<T: DeserializeOwned>(&self, path: &str) -> Option<T> {
        self.at(path).and_then(|value| T::deserialize(value).ok())
    }

    /// Number of items of a list.
    pub fn count(&self, path: &str) -> usize {
        self.at(path).and_then(Value::as_array).map_or(0, Vec::len)
    }

    /// Writes a value, over what was given.
    pub fn set(&mut self, path: &str, value: impl Serialize) {
        let value = serde_json::to_value(value).unwrap_or_default();
        let mut place = &mut self.table;
        for step in segments(path) {
            place = match step {
                Segment::Key(key) => {
                    if !place.is_object() {
                        *place = Value::Object(Map::new());
                    }
                    &mut place[key]
                }
                Segment::Index(index) => &mut place[index],
            };
        }
        *place = value;
    }

    /// Writes a value where none is given, and returns the one that counts.
    pub fn fill<T: Serialize + DeserializeOwned>(&mut self, path: &str, value: T) -> T {
        match self.get(path) {
            Some(given) => given,
            None => {
                self.set(path, &value);
                value
            }
        }
    }

    /// Removes a key.
    pub fn remove(&mut self, table: &str, key: &str) {
        let table = match table {
            "" => Some(&mut self.table),
            table => self.table.get_mut(table),
        };
        table.and_then(Value::as_object_mut).map(|table| table.remove(key));
    }

    /// The settings of the table at a path (empty: of all); the first required key that is absent is a problem.
    pub fn read<T: DeserializeOwned>(&self, path: &str) -> Result<T, Problem> {
        let empty = Value::Object(Map::new());
        let value = self.at(path).unwrap_or(&empty);
        T::deserialize(value).map_err(|error| self.schema.missing(path, &error))
    }
}
