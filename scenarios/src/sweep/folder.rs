//! The folders of a sweep and of its points: their files, their locks, how a point ended.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use run::RunError;
use run::folder::refuse_occupied;
use scene::read_text;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::error::SweepError;
use super::plan::{Plan, Task};

/// A process that only looks at a lock holds it for less than this.
const PATIENCE: Duration = Duration::from_millis(150);
const PAUSE: Duration = Duration::from_millis(10);

/// How a point ended: `point.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// The run's status; `refused`: the scene is wrong; `killed`: its process died each time.
    pub status: String,
    /// Why it has no result.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub message: Option<String>,
    /// Wall-clock time of its process [s].
    pub wall_time_s: f64,
    /// Threads of its process.
    pub threads: usize,
}

/// Status of a point whose process died.
pub(super) const KILLED: &str = "killed";

impl Outcome {
    /// True for a point with results.
    pub fn is_completed(&self) -> bool {
        scene::vocabulary::Status::of(&self.status).has_results()
    }
}

/// Where a point stands.
#[derive(Clone, Debug, PartialEq)]
pub enum State {
    /// It ended: with results, or by itself without.
    Ended(Outcome),
    /// A process runs it.
    Running,
    /// It has not run, was interrupted, or its process died.
    Waiting,
}

/// The folder of a sweep.
#[derive(Clone, Debug)]
pub struct SweepFolder(PathBuf);

impl SweepFolder {
    /// At a path, which need not exist.
    pub fn new(path: impl Into<PathBuf>) -> SweepFolder {
        SweepFolder(path.into())
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// A file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// The folder of a point.
    pub fn point(&self, id: &str) -> PointFolder {
        PointFolder(self.0.join("points").join(id))
    }

    /// The plan that it holds; `None` where there is none.
    ///
    /// # Errors
    /// The plan cannot be read.
    pub fn plan(&self) -> Result<Option<Plan>, SweepError> {
        let path = self.file("sweep.json");
        match read_json(&path) {
            Err(_) if !path.exists() => Ok(None),
            Err(why) => Err(SweepError::Input(format!("{}: {why}: expected the plan of a sweep", path.display()))),
            Ok(plan) => Ok(Some(plan)),
        }
    }

    /// Become the coordinator: make the folder and lock it until the value is dropped or the process ends, however it ends.
    ///
    /// # Errors
    /// The folder holds a run, another coordinator holds the lock, or the disk refuses.
    pub fn lock(&self) -> Result<File, SweepError> {
        refuse_occupied(&self.0, false).map_err(|error: RunError| SweepError::Input(error.to_string()))?;
        fs::create_dir_all(&self.0).map_err(|e| SweepError::write(&self.0, e))?;
        let path = self.file("sweep.lock");
        match lock(&path)? {
            Some(held) => Ok(held),
            None => Err(SweepError::Input(format!(
                "{}: another `splashdown sweep` runs this sweep: expected one at a time; --status tells how far it is",
                path.display()
            ))),
        }
    }

    /// True while a coordinator runs.
    pub fn is_locked(&self) -> bool {
        is_locked(&self.file("sweep.lock"))
    }

    /// Write a text file so that it is there as a whole or not at all.
    ///
    /// # Errors
    /// The disk's.
    pub fn write(&self, name: &str, text: &str) -> Result<(), SweepError> {
        replace(&self.file(name), text)
    }

    /// Write a file of the sweep by a function of its path, whole or not at all.
    ///
    /// # Errors
    /// The disk's.
    pub fn write_with(&self, name: &str, write: impl Fn(&Path) -> io::Result<()>) -> Result<(), SweepError> {
        replace_with(&self.file(name), write)
    }
}

/// The folder of a point.
#[derive(Clone, Debug)]
pub struct PointFolder(PathBuf);

impl PointFolder {
    /// Its path.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// A file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// Make the folder, with what its process is given.
    ///
    /// # Errors
    /// The disk's.
    pub fn prepare(&self, task: &Task) -> Result<(), SweepError> {
        fs::create_dir_all(&self.0).map_err(|e| SweepError::write(&self.0, e))?;
        replace(&self.file("given.json"), &json(task))
    }

    /// What its process is given.
    ///
    /// # Errors
    /// The file is missing or damaged.
    pub fn task(&self) -> Result<Task, SweepError> {
        let path = self.file("given.json");
        read_json(&path).map_err(|why| {
            SweepError::Input(format!(
                "{}: {why}: expected a point that `splashdown sweep FILE` has planned",
                path.display()
            ))
        })
    }

    /// Lock the point until the value is dropped or the process ends; `None` if another process holds it.
    ///
    /// # Errors
    /// The disk's.
    pub fn lock(&self) -> Result<Option<File>, SweepError> {
        lock(&self.file("point.lock"))
    }

    /// True while a process runs the point.
    pub fn is_locked(&self) -> bool {
        is_locked(&self.file("point.lock"))
    }

    /// How the point ended, where it did; a process that died counts as an end.
    pub fn outcome(&self) -> Option<Outcome> {
        read_json(&self.file("point.json")).ok()
    }

    /// The numbers of its run, `summary.json`.
    ///
    /// # Errors
    /// The file is missing or damaged; in words, with its path.
    pub fn summary(&self) -> Result<Value, String> {
        let path = self.file("summary.json");
        read_json(&path).map_err(|why| format!("{}: {why}", path.display()))
    }

    /// Where the point stands; one whose process died waits for another, and so does one whose results are lost or damaged.
    pub fn state(&self) -> State {
        let is_whole = |outcome: &Outcome| !outcome.is_completed() || self.summary().is_ok();
        match self.outcome().filter(|outcome| outcome.status != KILLED && is_whole(outcome)) {
            Some(outcome) => State::Ended(outcome),
            None if self.is_locked() => State::Running,
            None => State::Waiting,
        }
    }

    /// Keep how the point ended.
    ///
    /// # Errors
    /// The disk's.
    pub fn end(&self, outcome: &Outcome) -> Result<(), SweepError> {
        replace(&self.file("point.json"), &json(outcome))
    }

    /// Forget how the point ended.
    ///
    /// # Errors
    /// The disk's.
    pub fn reopen(&self) -> Result<(), SweepError> {
        let path = self.file("point.json");
        match fs::remove_file(&path) {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(SweepError::write(&path, error)),
            _ => Ok(()),
        }
    }
}

pub(super) fn json(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value).unwrap_or_default() + "\n"
}

fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T, String> {
    let text = read_text(path).map_err(|e| e.to_string())?;
    serde_json::from_str(&text).map_err(|e| e.to_string())
}

/// Write beside the file, then rename.
fn replace(path: &Path, text: &str) -> Result<(), SweepError> {
    replace_with(path, |beside| fs::write(beside, text))
}

fn replace_with(path: &Path, write: impl Fn(&Path) -> io::Result<()>) -> Result<(), SweepError> {
    let beside = path.with_extension(format!("{}.part", std::process::id()));
    let written = write(&beside).and_then(|()| fs::rename(&beside, path));
    written.map_err(|e| SweepError::write(path, e))
}

/// An open lock file; the system frees it when the process ends, also by kill -9. `None` if another process holds it.
fn lock(path: &Path) -> Result<Option<File>, SweepError> {
    let open = OpenOptions::new().create(true).truncate(false).write(true).open(path);
    let file = open.map_err(|e| SweepError::write(path, e))?;
    let start = Instant::now();
    loop {
        match file.try_lock() {
            Ok(()) => return Ok(Some(file)),
            // a look at the lock by `--status` is short
            Err(TryLockError::WouldBlock) if start.elapsed() < PATIENCE => thread::sleep(PAUSE),
            Err(TryLockError::WouldBlock) => return Ok(None),
            Err(TryLockError::Error(error)) => return Err(SweepError::write(path, error)),
        }
    }
}

/// True if another process holds the lock.
fn is_locked(path: &Path) -> bool {
    File::open(path).is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
}
