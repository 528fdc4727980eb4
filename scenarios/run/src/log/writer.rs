//! The writer of a log.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use foxglove::Schema;
use foxglove::messages::log::Level;
use foxglove::messages::{FrameTransforms, Log, PointCloud, SceneUpdate, Timestamp};
use serde::{Serialize, Serializer};
use serde_json::json;

use super::container::{Container, Topic, TypedTopic};
use super::error::LogError;
use super::frame::{Frame, stamp};

/// The name of the program, in the metadata and as the source of its notes.
pub const PROGRAM: &str = "splashdown";

/// The name under which the log keeps the resolved scene.
const RESOLVED_SCENE: &str = "scene.resolved.toml";

/// The topics of fixed meaning, which samples may not use.
const FIXED_TOPICS: [&str; 5] = ["/fluid", "/walls", "/scene", "/tf", "/log"];

/// The run that writes the log.
#[derive(Clone, Copy, Debug)]
pub struct LogMetadata<'a> {
    /// The name of the scene.
    pub scene: &'a str,
    /// The resolved scene: every default filled in, as TOML.
    pub scene_toml: &'a str,
    /// The version of the program.
    pub version: &'a str,
}

/// Writes the log of one run; see the [module](super) for what is in the file.
pub struct LogWriter {
    container: Container,
    fluid: TypedTopic<PointCloud>,
    walls: TypedTopic<PointCloud>,
    scene: TypedTopic<SceneUpdate>,
    tf: TypedTopic<FrameTransforms>,
    log: TypedTopic<Log>,
    samples: BTreeMap<String, SampleTopic>,
}

impl LogWriter {
    /// Creates the file, replacing one that is there, and writes the metadata and the scene.
    ///
    /// # Errors
    /// [`LogError::Create`] if the file cannot be opened, [`LogError::Write`] if the disk
    /// refuses it.
    pub fn create(path: &Path, metadata: &LogMetadata<'_>) -> Result<Self, LogError> {
        let mut container = Container::create(path, &format!("{PROGRAM}/{}", metadata.version))?;
        container.metadata(PROGRAM, &[("scene", metadata.scene), ("version", metadata.version)])?;
        container.metadata(RESOLVED_SCENE, &[("toml", metadata.scene_toml)])?;
        container.attach(RESOLVED_SCENE, "application/toml", metadata.scene_toml)?;
        container.flush()?;
        let [fluid, walls, scene, tf, log] = FIXED_TOPICS;
        Ok(Self {
            fluid: container.add_typed(fluid)?,
            walls: container.add_typed(walls)?,
            scene: container.add_typed(scene)?,
            tf: container.add_typed(tf)?,
            log: container.add_typed(log)?,
            samples: BTreeMap::new(),
            container,
        })
    }

    /// Writes one picture of the run: one message on each of `/fluid`, `/walls`, `/scene` and `/tf`. The frame is in the
    /// file, whole, when this returns.
    ///
    /// # Errors
    /// [`LogError::Write`] if the disk refuses it.
    pub fn frame(&mut self, frame: &Frame) -> Result<(), LogError> {
        let Frame { stamp, fluid, walls, scene, tf, .. } = frame;
        self.container.write_typed(&mut self.fluid, *stamp, fluid)?;
        self.container.write_typed(&mut self.walls, *stamp, walls)?;
        self.container.write_typed(&mut self.scene, *stamp, scene)?;
        self.container.write_typed(&mut self.tf, *stamp, tf)?;
        self.flush()
    }

    /// Hands every sample so far to the operating system.
    pub(super) fn flush(&mut self) -> Result<(), LogError> {
        self.container.flush()
    }

    /// Writes named numbers at `time` [s] to the topic `/CHANNEL`, as one JSON object in the
    /// order given. A number that is not finite becomes `null`: JSON has no number for it.
    ///
    /// The first sample of a channel fixes its names, from which its schema is made; by
    /// convention a name ends with its unit. The sample reaches the file with the next frame
    /// or note.
    ///
    /// # Errors
    /// [`LogError::Channel`] if the channel is not a topic for samples, [`LogError::Names`] if
    /// the names are not those of its first sample, or one is given twice, [`LogError::Time`];
    /// [`LogError::Write`] if the disk refuses it.
    pub fn sample(&mut self, time: f64, channel: &str, values: &[(&str, f64)]) -> Result<(), LogError> {
        let stamp = stamp(time)?;
        if !self.samples.contains_key(channel) {
            let topic = SampleTopic::create(&mut self.container, channel, values)?;
            self.samples.insert(channel.to_owned(), topic);
        }
        let topic = self.samples.get_mut(channel).expect("the channel was added above");
        topic.write(&mut self.container, channel, stamp, values)
    }

    /// Writes a note in words at `time` [s] to `/log`. The note, and every sample before it, is
    /// in the file when this returns: the note that explains why a run stops survives the stop.
    ///
    /// # Errors
    /// [`LogError::Time`], [`LogError::Write`].
    pub fn note(&mut self, time: f64, level: Level, text: &str) -> Result<(), LogError> {
        let stamp = stamp(time)?;
        let note = Log {
            timestamp: Some(stamp),
            level: level.into(),
            message: text.to_owned(),
            name: PROGRAM.to_owned(),
            ..Log::default()
        };
        self.container.write_typed(&mut self.log, stamp, &note)?;
        self.container.flush()
    }

    /// Channels of samples with their names, in the order in which they were added.
    pub(super) fn channels(&self) -> Vec<(String, Vec<String>)> {
        let mut topics: Vec<_> = self.samples.iter().collect();
        topics.sort_by_key(|(_, sample)| sample.topic.id());
        topics.into_iter().map(|(channel, sample)| (channel.clone(), sample.names.clone())).collect()
    }

    /// Writes a message of an earlier log again; `names` are those of the topic's samples.
    pub(super) fn repeat(
        &mut self,
        topic: &str,
        names: Option<&[String]>,
        time: u64,
        message: &[u8],
    ) -> Result<(), LogError> {
        let container = &mut self.container;
        let fixed = match topic {
            "/fluid" => self.fluid.untyped(),
            "/walls" => self.walls.untyped(),
            "/scene" => self.scene.untyped(),
            "/tf" => self.tf.untyped(),
            "/log" => self.log.untyped(),
            _ => {
                let channel = topic.strip_prefix('/').unwrap_or(topic);
                if !self.samples.contains_key(channel) {
                    let first: Vec<(&str, f64)> =
                        names.unwrap_or_default().iter().map(|name| (name.as_str(), 0.0)).collect();
                    self.samples.insert(channel.to_owned(), SampleTopic::create(container, channel, &first)?);
                }
                &mut self.samples.get_mut(channel).expect("the channel was added above").topic
            }
        };
        container.repeat(fixed, time, message)
    }

    /// Messages so far; those since the last frame or note are not in the file.
    pub(super) fn messages(&self) -> u64 {
        self.container.messages()
    }

    /// The file takes another name, in place of a file that has it.
    pub(super) fn rename(&mut self, path: &Path) -> Result<(), LogError> {
        self.container.rename(path)
    }

    /// Completes the file with its summary and returns its length [bytes].
    ///
    /// # Errors
    /// [`LogError::Write`] if the disk refuses it.
    pub fn finish(self) -> Result<u64, LogError> {
        self.container.finish()
    }
}

/// A topic of samples, all of which have the same names in the same order.
struct SampleTopic {
    topic: Topic,
    names: Vec<String>,
}

impl SampleTopic {
    /// Adds the topic of `channel`, with the schema of its first sample.
    fn create(container: &mut Container, channel: &str, first: &[(&str, f64)]) -> Result<Self, LogError> {
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
        Ok(Self { topic: container.add(&topic, "json", &sample_schema(&topic, first))?, names })
    }

    /// Writes one sample.
    fn write(
        &mut self,
        container: &mut Container,
        channel: &str,
        stamp: Timestamp,
        values: &[(&str, f64)],
    ) -> Result<(), LogError> {
        if !values.iter().map(|&(name, _)| name).eq(&self.names) {
            return Err(LogError::Names {
                channel: channel.to_owned(),
                expected: self.names.clone(),
                found: names(values),
            });
        }
        container.write(&mut self.topic, stamp, &sample_message(values))
    }
}

/// A sample as a JSON object; `serde_json` writes a number that is not finite as `null`.
struct Sample<'a>(&'a [(&'a str, f64)]);

impl Serialize for Sample<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().copied())
    }
}

/// A sample as it is written.
pub fn sample_message(values: &[(&str, f64)]) -> Vec<u8> {
    serde_json::to_vec(&Sample(values)).expect("names and numbers are JSON")
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
    Err(LogError::Channel(channel.to_owned(), reason))
}

/// The JSON schema of samples with the names of one, called after its topic: viewers keep one schema
/// per name.
///
/// A property is a plain `number`, although a message may hold `null` in its place: the schema
/// reader of Foxglove Studio, from which Lichtblick descends, refuses a union of types, and
/// messages are not checked against the schema.
pub fn sample_schema(topic: &str, sample: &[(&str, f64)]) -> Schema {
    let properties: serde_json::Map<_, _> =
        sample.iter().map(|(name, _)| (name.to_string(), json!({ "type": "number" }))).collect();
    let text = json!({ "type": "object", "properties": properties }).to_string();
    Schema::new(format!("splashdown{topic}"), "jsonschema", text.into_bytes())
}
