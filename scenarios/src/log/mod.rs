//! The log of a run: one self-describing [MCAP](https://mcap.dev) file that Foxglove and
//! Lichtblick open without set-up.
//!
//! | topic | schema | content | written by |
//! |---|---|---|---|
//! | `/fluid`, `/walls` | `foxglove.PointCloud` | one packed point per particle | [`LogWriter::frame`] |
//! | `/scene` | `foxglove.SceneUpdate` | the outline of each body, in the frame of the body | [`LogWriter::frame`] |
//! | `/tf` | `foxglove.FrameTransforms` | the frame of each body, `body/NAME`, in `world` | [`LogWriter::frame`] |
//! | `/log` | `foxglove.Log` | notes in words | [`LogWriter::note`] |
//! | any other | JSON, schema from the names | curves, conservation numbers | [`LogWriter::sample`] |
//!
//! Metadata `splashdown` (`scene`, `version`) and `scene.resolved.toml` (`toml`) and the
//! attachment `scene.resolved.toml` come first in the file. Log time and publish time are both
//! the simulated time [ns]; the wall clock is nowhere, and compression runs on one thread, so that
//! the same calls write the same bytes.
//!
//! # A run that is killed
//!
//! The file only ever grows: a chunk is built in memory and appended whole, and handed to the
//! operating system before [`LogWriter::frame`] and [`LogWriter::note`] return. A process killed
//! at any moment thus leaves a prefix of the file it would have finished, holding everything up
//! to the last frame or note that returned; samples taken since then are lost. A run writes through a
//! [`BackgroundLog`], which may have two frames on their way to the file: those are lost too. A writer dropped
//! without [`LogWriter::finish`] (an early return, a panic) still completes the file, as far as
//! the disk allows, but reports no error.
//!
//! Such a prefix lacks the summary at the end of the file. Streaming readers need none: they
//! read up to the last whole chunk (`mcap::io::MessageReader` in Rust, `StreamReader` of the
//! PyPI package `mcap`). Seeking readers start from the summary and fail: among them is what
//! `mcap.reader.make_reader` of PyPI returns for a file on disk. `tests/mcap/read_log.py` reads
//! both kinds of file, the second with `--truncated`; `mcap recover` turns a prefix into a
//! complete file.

mod background;
mod bodies;
mod budget;
mod container;
mod error;
mod frame;
mod level;
mod particles;
mod pose;
mod sample;
mod stamp;

use std::collections::BTreeMap;
use std::path::Path;

use foxglove::messages::{FrameTransforms, Log, PointCloud, SceneUpdate};

pub use background::{BackgroundLog, Logged};
pub use bodies::BodyView;
pub use budget::Budget;
pub use error::LogError;
pub use frame::Frame;
pub use level::Level;
pub use particles::ParticleView;

use container::{Container, TypedTopic};
use sample::SampleTopic;
use stamp::Stamp;

/// The frame of reference of the simulation: x right, y up, z towards the viewer [m].
const WORLD_FRAME: &str = "world";

/// The name of the program, in the metadata and as the source of its notes.
const PROGRAM: &str = "splashdown";

/// The name under which the log keeps the resolved scene.
const RESOLVED_SCENE: &str = "scene.resolved.toml";

const FLUID: &str = "/fluid";
const WALLS: &str = "/walls";
const SCENE: &str = "/scene";
const TF: &str = "/tf";
const LOG: &str = "/log";

/// The topics of fixed meaning, which [`LogWriter::sample`] may not use.
const FIXED_TOPICS: [&str; 5] = [FLUID, WALLS, SCENE, TF, LOG];

/// What a log says about the run that wrote it.
#[derive(Clone, Copy, Debug)]
pub struct LogMetadata<'a> {
    /// The name of the scene.
    pub scene: &'a str,
    /// The resolved scene: every default filled in, as TOML.
    pub scene_toml: &'a str,
    /// The version of the program.
    pub version: &'a str,
}

/// Writes the log of one run; see the [module](self) for what is in the file.
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
    fn flush(&mut self) -> Result<(), LogError> {
        self.container.flush()
    }

    /// Writes named numbers at `time` [s] to the topic `/CHANNEL`, as one JSON object in the
    /// order given. A number that is not finite becomes `null`, since JSON has no other word.
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
