//! The log of a run in progress: compression and disk use a thread of their own.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};

use foxglove::messages::log::Level;

use super::budget::{Budget, Standing};
use super::error::LogError;
use super::frame::Frame;
use super::writer::{LogMetadata, LogWriter};

/// Frames that wait for the disk while another is written; beyond these the run waits.
const WAITING: usize = 1;
/// Bytes of a number of a sample beside its name, and of what surrounds a message or a chunk, at most.
const NUMBER: usize = 32;
const AROUND: usize = 256;

/// Writes the same bytes as a [`LogWriter`] that is called in the same order, off the caller's path.
///
/// What is handed over reaches the file a frame or two later: a process that is killed loses those. The memory that it takes is
/// bounded: with a frame in work and another waiting, the next call waits for the disk. A write that fails ends the thread; the
/// next call returns the error.
pub struct BackgroundLog {
    samples: Vec<Sample>,
    batches: Option<SyncSender<Batch>>,
    thread: Option<JoinHandle<Result<Logged, LogError>>>,
    path: PathBuf,
}

/// The size of a finished log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Logged {
    /// Size of the file [bytes].
    pub bytes: u64,
    /// Frames in it.
    pub frames: u64,
    /// Frames that the budget had no room for.
    pub left_out: u64,
}

struct Sample {
    time: f64,
    channel: String,
    values: Vec<(String, f64)>,
}

/// Samples, and what comes after them and takes them to the file.
struct Batch {
    samples: Vec<Sample>,
    then: Then,
}

enum Then {
    Frame { frame: Box<Frame>, last: bool },
    Note { time: f64, level: Level, text: String },
    Nothing,
}

impl BackgroundLog {
    /// Creates the file and starts its thread; with a `budget`, the file stays below it.
    ///
    /// # Errors
    /// Those of [`LogWriter::create`].
    pub fn create(path: &Path, metadata: &LogMetadata<'_>, budget: Option<Budget>) -> Result<Self, LogError> {
        let writer = Writer { log: LogWriter::create(path, metadata)?, budget, path: path.to_owned(), start: None };
        let (batches, received) = sync_channel(WAITING);
        let thread = thread::Builder::new().name("log".into()).spawn(move || writer.write_all(&received));
        let thread = thread.map_err(|source| LogError::Create(path.to_owned(), source))?;
        Ok(Self { samples: Vec::new(), batches: Some(batches), thread: Some(thread), path: path.to_owned() })
    }

    /// As [`LogWriter::sample`].
    pub fn sample(&mut self, time: f64, channel: &str, values: &[(&str, f64)]) -> Result<(), LogError> {
        let values = values.iter().map(|&(name, value)| (name.to_owned(), value)).collect();
        self.samples.push(Sample { time, channel: channel.to_owned(), values });
        if self.thread.as_ref().is_none_or(JoinHandle::is_finished) { Err(self.failure()) } else { Ok(()) }
    }

    /// Hands over a frame; the `last` of a run is written if a budget has room for it alone.
    pub fn frame(&mut self, frame: Frame, last: bool) -> Result<(), LogError> {
        self.submit(Then::Frame { frame: Box::new(frame), last })
    }

    /// As [`LogWriter::note`].
    pub fn note(&mut self, time: f64, level: Level, text: &str) -> Result<(), LogError> {
        self.submit(Then::Note { time, level, text: text.to_owned() })
    }

    /// Waits for the disk and completes the file.
    pub fn finish(mut self) -> Result<Logged, LogError> {
        self.submit(Then::Nothing)?;
        self.end().unwrap_or(Err(LogError::Ended(self.path.clone())))
    }

    fn submit(&mut self, then: Then) -> Result<(), LogError> {
        let batch = Batch { samples: std::mem::take(&mut self.samples), then };
        match self.batches.as_ref().map(|batches| batches.send(batch)) {
            Some(Ok(())) => Ok(()),
            _ => Err(self.failure()),
        }
    }

    /// What ended the thread.
    fn failure(&mut self) -> LogError {
        match self.end() {
            Some(Err(error)) => error,
            _ => LogError::Ended(self.path.clone()),
        }
    }

    /// Wait for the thread; its result, at the first call.
    fn end(&mut self) -> Option<Result<Logged, LogError>> {
        self.batches = None;
        let ended = self.thread.take()?.join();
        Some(ended.unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    }
}

impl Drop for BackgroundLog {
    /// An early return still completes the file, as far as the disk allows.
    fn drop(&mut self) {
        self.batches = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// The receiving end, which owns the file.
struct Writer {
    log: LogWriter,
    budget: Option<Budget>,
    path: PathBuf,
    start: Option<u64>,
}

impl Writer {
    fn write_all(mut self, batches: &Receiver<Batch>) -> Result<Logged, LogError> {
        let mut logged = Logged::default();
        for Batch { samples, then } in batches {
            let mut raw = AROUND;
            for Sample { time, channel, values } in &samples {
                let values: Vec<(&str, f64)> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
                self.log.sample(*time, channel, &values)?;
                raw += AROUND + values.iter().map(|(name, _)| name.len() + NUMBER).sum::<usize>();
            }
            match then {
                Then::Nothing => {}
                Then::Note { time, level, text } => self.log.note(time, level, &text)?,
                Then::Frame { frame, last } => {
                    if self.admits(&frame, last, logged.frames, raw as u64) {
                        self.log.frame(&frame)?;
                        logged.frames += 1;
                    } else {
                        self.log.flush()?;
                        logged.left_out += 1;
                    }
                }
            }
        }
        logged.bytes = self.log.finish()?;
        Ok(logged)
    }

    fn admits(&mut self, frame: &Frame, last: bool, frames: u64, samples: u64) -> bool {
        let Some(budget) = self.budget else { return true };
        let now = std::fs::metadata(&self.path).map_or(0, |file| file.len());
        let start = *self.start.get_or_insert(now);
        budget.admits(Standing { start, now, frames }, frame.time, frame.raw_bytes() + samples, last)
    }
}
