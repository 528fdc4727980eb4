//! The folder of a run: its files, and the lock that one process holds on it.

use std::fs::{File, TryLockError};
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use crate::checkpoint;
use crate::error::RunError;

/// Files of a run, by the contract of the command line.
pub const FILES: [&str; 6] =
    ["log.mcap", "series.csv", "summary.json", "scene.resolved.toml", "report.html", "checkpoint.bin"];

/// Begins the first line of `scene.resolved.toml` of a run whose body a host program moved; the name of its interface follows.
pub const HOST_MARK: &str = "# moved by a host program: ";

/// Longest wait for a folder that another process holds.
const PATIENCE: Duration = Duration::from_secs(1);

/// An error if the folder holds a run that may not be replaced.
pub fn refuse_occupied(dir: &Path, force: bool) -> Result<(), RunError> {
    refuse_files(dir, &FILES, force)
}

/// An error if the folder is a file, or holds one of these files that may not be replaced.
pub fn refuse_files(dir: &Path, files: &[&'static str], force: bool) -> Result<(), RunError> {
    if dir.is_file() {
        return Err(RunError::NotAFolder(dir.display().to_string()));
    }
    match files.iter().find(|name| dir.join(name).exists()) {
        Some(name) if !force => Err(RunError::Occupied(dir.display().to_string(), name)),
        _ => Ok(()),
    }
}

/// Make the folder, hold it and remove the files of an earlier run, so that no file is mistaken for one of this run.
pub(crate) fn prepare(dir: &Path) -> Result<Held, RunError> {
    let wrong = |path: &Path, e| RunError::Write(path.display().to_string(), e);
    std::fs::create_dir_all(dir).map_err(|e| wrong(dir, e))?;
    let held = hold(dir)?;
    let parts = [checkpoint::PART, "log.mcap.part", "series.csv.part", "scene.resolved.toml.part"];
    for path in FILES.iter().chain(&parts).map(|name| dir.join(name)).filter(|path| path.exists()) {
        std::fs::remove_file(&path).map_err(|e| wrong(&path, e))?;
    }
    Ok(held)
}

/// The lock on a folder, as long as the value lives; the system frees it when the process ends.
pub(crate) struct Held {
    _folder: Option<File>,
}

/// Hold a folder, so that no other process writes a run there. Where the system cannot lock folders, nothing is held.
pub(crate) fn hold(dir: &Path) -> Result<Held, RunError> {
    let folder = File::open(dir).ok();
    let start = Instant::now();
    loop {
        match folder.as_ref().map(File::try_lock) {
            // a process that was killed holds it until the system has taken it down
            Some(Err(TryLockError::WouldBlock)) if start.elapsed() < PATIENCE => thread::sleep(PATIENCE / 100),
            Some(Err(TryLockError::WouldBlock)) => return Err(RunError::Held(dir.display().to_string())),
            _ => return Ok(Held { _folder: folder }),
        }
    }
}

/// Write a text file.
pub fn write(path: &Path, text: &str) -> Result<(), RunError> {
    std::fs::write(path, text).map_err(|e| RunError::Write(path.display().to_string(), e))
}
