//! The log of a run in progress: compression and disk use a thread of their own.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};

use foxglove::messages::log::Level;

use super::budget::{Budget, Standing};
use super::error::LogError;
use super::frame::Frame;
use super::stored::{LogStanding, Sample, StoredLog, replay};
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
    held: Option<Held>,
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

/// What may still be discarded.
#[derive(Default)]
struct Held {
    samples: Vec<Sample>,
    batches: Vec<Batch>,
}

/// Samples, and what comes after them and takes them to the file.
struct Batch {
    samples: Vec<Sample>,
    then: Then,
}

enum Then {
    Frame {
        frame: Box<Frame>,
        last: bool,
    },
    Note {
        time: f64,
        level: Level,
        text: String,
    },
    /// Tell how far the file is.
    Tell(SyncSender<LogStanding>),
    Nothing,
}

impl BackgroundLog {
    /// Creates the file and starts its thread; with a `budget`, the file stays below it.
    ///
    /// # Errors
    /// Those of [`LogWriter::create`].
    pub fn create(path: &Path, metadata: &LogMetadata<'_>, budget: Option<Budget>) -> Result<Self, LogError> {
        let log = LogWriter::create(path, metadata)?;
        BackgroundLog::spawn(Writer { log, budget, path: path.to_owned(), start: None, logged: Logged::default() })
    }

    /// Continues the log `path` from where it was `stored`: a new file is written next to it, and replaces it once it is as far.
    ///
    /// # Errors
    /// Those of [`LogWriter::create`], and [`LogError::Read`] if the file does not hold what it held.
    pub fn resume(
        path: &Path,
        metadata: &LogMetadata<'_>,
        budget: Option<Budget>,
        stored: StoredLog,
    ) -> Result<Self, LogError> {
        let StoredLog { standing, pending } = stored;
        let part = path.with_extension("mcap.part");
        let written = LogWriter::create(&part, metadata).and_then(|mut log| {
            replay(path, &standing, &mut log)?;
            log.rename(path)?;
            Ok(log)
        });
        let log = written.inspect_err(|_| drop(std::fs::remove_file(&part)))?;
        let logged = Logged { bytes: 0, frames: standing.frames, left_out: standing.left_out };
        let mut resumed =
            BackgroundLog::spawn(Writer { log, budget, path: path.to_owned(), start: standing.start, logged })?;
        resumed.samples = pending;
        Ok(resumed)
    }

    fn spawn(writer: Writer) -> Result<Self, LogError> {
        let path = writer.path.clone();
        let (batches, received) = sync_channel(WAITING);
        let thread = thread::Builder::new().name("log".into()).spawn(move || writer.write_all(&received));
        let thread = thread.map_err(|source| LogError::Create(path.clone(), source))?;
        Ok(Self { samples: Vec::new(), held: None, batches: Some(batches), thread: Some(thread), path })
    }

    /// As [`LogWriter::sample`].
    pub fn sample(&mut self, time: f64, channel: &str, values: &[(&str, f64)]) -> Result<(), LogError> {
        let values = values.iter().map(|&(name, value)| (name.to_owned(), value)).collect();
        let sample = Sample { time, channel: channel.to_owned(), values };
        self.held.as_mut().map_or(&mut self.samples, |held| &mut held.samples).push(sample);
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

    /// From here on keeps in memory what it is given, until the next call of `hold` or `release` accepts it or `discard` forgets it.
    pub fn hold(&mut self) -> Result<(), LogError> {
        self.release()?;
        self.held = Some(Held::default());
        Ok(())
    }

    /// Forgets what was held, and holds on.
    pub fn discard(&mut self) {
        if let Some(held) = &mut self.held {
            *held = Held::default();
        }
    }

    /// Accepts what was held.
    pub fn release(&mut self) -> Result<(), LogError> {
        let Some(Held { samples, batches }) = self.held.take() else { return Ok(()) };
        for batch in batches {
            self.samples.extend(batch.samples);
            self.submit(batch.then)?;
        }
        self.samples.extend(samples);
        Ok(())
    }

    /// Waits for the disk; what a later process needs to continue from here.
    pub fn stored(&mut self) -> Result<StoredLog, LogError> {
        let (answer, answered) = sync_channel(1);
        let batch = Batch { samples: Vec::new(), then: Then::Tell(answer) };
        let sent = self.batches.as_ref().is_some_and(|batches| batches.send(batch).is_ok());
        match answered.recv().ok().filter(|_| sent) {
            Some(standing) => Ok(StoredLog { standing, pending: self.samples.clone() }),
            None => Err(self.failure()),
        }
    }

    /// Waits for the disk and completes the file.
    pub fn finish(mut self) -> Result<Logged, LogError> {
        self.release()?;
        self.submit(Then::Nothing)?;
        self.end().unwrap_or(Err(LogError::Ended(self.path.clone())))
    }

    fn submit(&mut self, then: Then) -> Result<(), LogError> {
        if let Some(held) = &mut self.held {
            let samples = std::mem::take(&mut held.samples);
            held.batches.push(Batch { samples, then });
            return Ok(());
        }
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
    logged: Logged,
}

impl Writer {
    fn write_all(mut self, batches: &Receiver<Batch>) -> Result<Logged, LogError> {
        for Batch { samples, then } in batches {
            let mut raw = AROUND;
            for Sample { time, channel, values } in &samples {
                let values: Vec<(&str, f64)> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
                self.log.sample(*time, channel, &values)?;
                raw += AROUND + values.iter().map(|(name, _)| name.len() + NUMBER).sum::<usize>();
            }
            match then {
                Then::Nothing => {}
                Then::Tell(answer) => drop(answer.send(self.standing())), // who asked may be gone
                Then::Note { time, level, text } => self.log.note(time, level, &text)?,
                Then::Frame { frame, last } => {
                    if self.admits(&frame, last, raw as u64) {
                        self.log.frame(&frame)?;
                        self.logged.frames += 1;
                    } else {
                        self.log.flush()?;
                        self.logged.left_out += 1;
                    }
                }
            }
        }
        Ok(Logged { bytes: self.log.finish()?, ..self.logged })
    }

    fn standing(&self) -> LogStanding {
        let Logged { frames, left_out, .. } = self.logged;
        let (messages, channels) = (self.log.messages(), self.log.channels());
        LogStanding { messages, start: self.start, frames, left_out, channels }
    }

    fn admits(&mut self, frame: &Frame, last: bool, samples: u64) -> bool {
        let Some(budget) = self.budget else { return true };
        let now = std::fs::metadata(&self.path).map_or(0, |file| file.len());
        let start = *self.start.get_or_insert(now);
        budget.admits(
            Standing { start, now, frames: self.logged.frames },
            frame.time,
            frame.raw_bytes() + samples,
            last,
        )
    }
}
