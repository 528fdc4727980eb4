//! The writer of a log.

use std::collections::BTreeMap;
use std::path::Path;

use foxglove::messages::{FrameTransforms, Log, PointCloud, SceneUpdate};

use super::bodies::BodyView;
use super::container::{Container, TypedTopic};
use super::error::LogError;
use super::frame::Frame;
use super::level::Level;
use super::particles::ParticleView;
use super::sample::SampleTopic;
use super::stamp::Stamp;
use super::topics::{FLUID, LOG, PROGRAM, RESOLVED_SCENE, SCENE, TF, WALLS};

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
        Ok(Self {
            fluid: container.add_typed(FLUID)?,
            walls: container.add_typed(WALLS)?,
            scene: container.add_typed(SCENE)?,
            tf: container.add_typed(TF)?,
            log: container.add_typed(LOG)?,
            samples: BTreeMap::new(),
            container,
        })
    }

    /// Writes one picture of the run at `time` [s]: one message on each of `/fluid`, `/walls`,
    /// `/scene` and `/tf`. The frame is in the file, whole, when this returns.
    ///
    /// # Errors
    /// [`LogError::Time`] and [`LogError::Length`] before anything is written,
    /// [`LogError::Write`] if the disk refuses it.
    pub fn frame(
        &mut self,
        time: f64,
        fluid: &ParticleView<'_>,
        walls: &ParticleView<'_>,
        bodies: &[BodyView<'_>],
    ) -> Result<(), LogError> {
        self.write(&Frame::new(time, fluid, walls, bodies)?)
    }

    /// Writes one picture of the run, as [`LogWriter::frame`] does.
    ///
    /// # Errors
    /// [`LogError::Write`] if the disk refuses it.
    pub fn write(&mut self, frame: &Frame) -> Result<(), LogError> {
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
        let stamp = Stamp::from_seconds(time)?;
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
        let stamp = Stamp::from_seconds(time)?;
        let note = Log {
            timestamp: Some(stamp.timestamp()),
            level: level.code(),
            message: text.to_owned(),
            name: PROGRAM.to_owned(),
            ..Log::default()
        };
        self.container.write_typed(&mut self.log, stamp, &note)?;
        self.container.flush()
    }

    /// Completes the file with its summary and returns its length [bytes].
    ///
    /// # Errors
    /// [`LogError::Write`] if the disk refuses it.
    pub fn finish(self) -> Result<u64, LogError> {
        self.container.finish()
    }
}
