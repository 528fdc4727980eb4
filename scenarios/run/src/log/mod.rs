//! The log of a run: one self-describing [MCAP](https://mcap.dev) file that Foxglove and
//! Lichtblick open without set-up.
//!
//! | topic | schema | content | written by |
//! |---|---|---|---|
//! | `/fluid`, `/walls` | `foxglove.PointCloud` | one packed point per particle, and per image of a symmetric run | [`LogWriter::frame`] |
//! | `/scene` | `foxglove.SceneUpdate` | the outline of each body, in the frame of the body | [`LogWriter::frame`] |
//! | `/tf` | `foxglove.FrameTransforms` | the frame of each body, `body/NAME`, in `world` | [`LogWriter::frame`] |
//! | `/log` | `foxglove.Log` | notes in words | [`LogWriter::note`] |
//! | any other | JSON, schema from the names | curves, conservation numbers | [`LogWriter::sample`] |
//!
//! Metadata `splashdown` (`scene`, `version`) and `scene.resolved.toml` (`toml`) and the
//! attachment `scene.resolved.toml` come first in the file. Log time and publish time are both
//! the simulated time since the start of the run [ns]; the wall clock is nowhere, and compression runs on one thread, so that
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
//! Such a prefix is without the summary at the end of the file. Streaming readers need none: they
//! read up to the last whole chunk (`mcap::io::MessageReader` in Rust, `StreamReader` of the
//! PyPI package `mcap`). Seeking readers start from the summary and fail: among them is what
//! `mcap.reader.make_reader` of PyPI returns for a file on disk. `tests/mcap/read_log.py` reads
//! both kinds of file, the second with `--truncated`; `mcap recover` turns a prefix into a
//! complete file.

mod background;
mod budget;
mod container;
mod error;
mod frame;
mod reader;
mod samples;
mod stored;
mod viewers;
mod writer;

pub use background::{BackgroundLog, Logged};
pub use budget::Budget;
pub use error::LogError;
/// Severity of a note.
pub use foxglove::messages::log::Level;
pub use frame::{BodyView, Frame, IMAGE, Point, stamp};
pub use reader::{LogReader, LoggedBody, LoggedFrame};
pub use samples::{Samples, read_samples};
pub use stored::StoredLog;
pub use viewers::Viewers;
pub use writer::{LogMetadata, LogWriter, PROGRAM, sample_message, sample_schema};
