//! Named numbers as JSON objects.

use std::collections::BTreeSet;

use foxglove::Schema;
use serde::{Serialize, Serializer};
use serde_json::json;

use super::container::{Container, Topic};
use super::error::LogError;
use super::stamp::Stamp;
use super::topics::FIXED_TOPICS;

/// A topic of samples, all of which have the same names in the same order.
pub(super) struct SampleTopic {
    topic: Topic,
    names: Vec<String>,
}

impl SampleTopic {
    /// Adds the topic of `channel`, with the schema of its first sample.
    pub(super) fn create(container: &mut Container, channel: &str, first: &[(&str, f64)]) -> Result<Self, LogError> {
        let topic = topic_name(channel)?;
        let names = names(first);
        let distinct: BTreeSet<&String> = names.iter().collect();
        if distinct.len() != names.len() {
            return Err(LogError::Names {
                channel: channel.to_owned(),
                expected: distinct.into_iter().cloned().collect(),
                found: names,
            });
        }
        Ok(Self { topic: container.add(&topic, "json", &schema(&topic, &names))?, names })
    }

    /// Writes one sample.
    pub(super) fn write(
        &mut self,
        container: &mut Container,
        channel: &str,
        stamp: Stamp,
        values: &[(&str, f64)],
    ) -> Result<(), LogError> {
        if !values.iter().map(|&(name, _)| name).eq(&self.names) {
            return Err(LogError::Names {
                channel: channel.to_owned(),
                expected: self.names.clone(),
                found: names(values),
            });
        }
        let message = serde_json::to_vec(&Sample(values)).expect("names and numbers are JSON");
        container.write(&mut self.topic, stamp, &message)
    }
}

/// A sample as a JSON object; `serde_json` writes a number that is not finite as `null`.
struct Sample<'a>(&'a [(&'a str, f64)]);

impl Serialize for Sample<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().copied())
    }
}

fn names(values: &[(&str, f64)]) -> Vec<String> {
    values.iter().map(|&(name, _)| name.to_owned()).collect()
}

/// The topic of `channel`, unless it is malformed or has a fixed meaning.
fn topic_name(channel: &str) -> Result<String, LogError> {
    let topic = format!("/{channel}");
    let reason = if channel.is_empty() {
        "it is empty"
    } else if channel.starts_with('/') {
        "the log adds the leading slash"
    } else if FIXED_TOPICS.contains(&topic.as_str()) {
        "its topic has a fixed meaning"
    } else {
        return Ok(topic);
    };
    Err(LogError::Channel { channel: channel.to_owned(), reason })
}

/// The JSON schema of samples with `names`, called after its topic: viewers keep one schema
/// per name.
///
/// A property is a plain `number`, although a message may hold `null` in its place: the schema
/// reader of Foxglove Studio, from which Lichtblick descends, refuses a union of types, and
/// messages are not checked against the schema.
fn schema(topic: &str, names: &[String]) -> Schema {
    let properties: serde_json::Map<_, _> =
        names.iter().map(|name| (name.clone(), json!({ "type": "number" }))).collect();
    let text = json!({ "type": "object", "properties": properties }).to_string();
    Schema::new(format!("splashdown{topic}"), "jsonschema", text.into_bytes())
}
