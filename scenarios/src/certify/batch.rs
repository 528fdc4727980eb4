//! The cases, run on all cores in one process; each that ended is a line of a file, so that a cut run goes on.

use std::any::Any;
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use super::cases::Case;
use super::record::{Ended, Record};

/// The file of the cases that ended: a line with what is run, then a line for each.
pub const RECORDS: &str = "cases.jsonl";

/// Why a batch cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum BatchError {
    /// The folder's cases are others.
    #[error(
        "{0} holds the cases of another file, rule or program version: expected another folder, or --force to replace them"
    )]
    Other(String),
    /// Another process writes them.
    #[error("{0}: another `splashdown certify` runs these cases: expected one at a time")]
    Locked(String),
    /// The disk refuses.
    #[error("cannot write {0}: {1}")]
    Write(String, std::io::Error),
}

/// The file of a batch, open and locked, with the cases that it knows.
pub struct Records {
    file: File,
    path: PathBuf,
    known: Vec<Record>,
}

impl Records {
    /// Open or begin the file in a folder; `head` says what is run. A line that was cut, and all after it, are removed.
    ///
    /// # Errors
    /// The file is of other cases, another process has it, or the disk refuses.
    pub fn open(folder: &Path, head: &str, cases: &[Case], force: bool) -> Result<Records, BatchError> {
        let path = folder.join(RECORDS);
        let shown = path.display().to_string();
        let unwritten = |error| BatchError::Write(shown.clone(), error);
        fs::create_dir_all(folder).map_err(|e| BatchError::Write(folder.display().to_string(), e))?;
        let mut file =
            OpenOptions::new().create(true).truncate(false).read(true).write(true).open(&path).map_err(unwritten)?;
        file.try_lock().map_err(|_| BatchError::Locked(shown.clone()))?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(unwritten)?;
        let text = String::from_utf8_lossy(&bytes);
        let (first, rest) = text.split_once('\n').unwrap_or(("", ""));
        let is_empty = force || text.is_empty() || !text.contains('\n') && head.starts_with(&*text);
        if !is_empty && first != head {
            return Err(BatchError::Other(folder.display().to_string()));
        }
        let known = if is_empty { Vec::new() } else { whole_lines(rest, cases) };
        let length = known.iter().map(|(_, bytes)| bytes).sum::<usize>() + head.len() + 1;
        if is_empty {
            file.set_len(0).map_err(unwritten)?;
            file.rewind().map_err(unwritten)?;
            file.write_all(format!("{head}\n").as_bytes()).map_err(unwritten)?;
        } else {
            file.set_len(length as u64).map_err(unwritten)?;
        }
        file.seek(SeekFrom::End(0)).map_err(unwritten)?;
        Ok(Records { file, path, known: known.into_iter().map(|(record, _)| record).collect() })
    }

    /// Number of cases that ended before.
    pub fn known(&self) -> usize {
        self.known.len()
    }

    /// Run the cases that have not ended on `threads` threads; `done` is called with the number of cases that ended.
    ///
    /// # Errors
    /// The disk refuses.
    pub fn run(
        mut self,
        cases: &[Case],
        threads: usize,
        one: impl Fn(&Case) -> Record + Sync,
        mut done: impl FnMut(usize),
    ) -> Result<Vec<Record>, BatchError> {
        let mut records = std::mem::take(&mut self.known);
        let next = AtomicUsize::new(records.len());
        let (send, receive) = mpsc::channel();
        thread::scope(|scope| {
            for _ in 0..threads.max(1) {
                let (send, next, one) = (send.clone(), &next, &one);
                scope.spawn(move || {
                    loop {
                        let k = next.fetch_add(1, Ordering::Relaxed);
                        let Some(case) = cases.get(k) else { return };
                        if send.send((k, kept(case, one))).is_err() {
                            return;
                        }
                    }
                });
            }
            drop(send);
            // lines stand in the order of the cases, whichever ends first
            let mut waiting = BTreeMap::new();
            for (k, record) in receive {
                waiting.insert(k, record);
                while let Some(record) = waiting.remove(&records.len()) {
                    let line = serde_json::to_string(&record).unwrap_or_default() + "\n";
                    self.file
                        .write_all(line.as_bytes())
                        .map_err(|error| BatchError::Write(self.path.display().to_string(), error))?;
                    records.push(record);
                    done(records.len());
                }
            }
            Ok(records)
        })
    }
}

/// Records and lengths [bytes] of whole lines that are those of the cases in their order.
fn whole_lines(text: &str, cases: &[Case]) -> Vec<(Record, usize)> {
    let lines = text.split_inclusive('\n').filter(|line| line.ends_with('\n'));
    let record = |(line, case): (&str, &Case)| {
        let record: Record = serde_json::from_str(line).ok()?;
        (record.case == case.number).then_some((record, line.len()))
    };
    lines.zip(cases).map_while(record).collect()
}

/// The record of a case; a fault of the program is a reason too.
fn kept(case: &Case, one: impl Fn(&Case) -> Record) -> Record {
    catch_unwind(AssertUnwindSafe(|| one(case))).unwrap_or_else(|fault: Box<dyn Any + Send>| {
        let said = fault.downcast_ref::<String>().cloned();
        let said = said.or_else(|| fault.downcast_ref::<&str>().map(|text| (*text).to_string()));
        Record {
            case: case.number,
            ended: Ended::Failed,
            message: Some(format!("a fault of the program: {}", said.unwrap_or_default())),
            numbers: BTreeMap::new(),
            lost: Vec::new(),
            map: Vec::new(),
        }
    })
}
