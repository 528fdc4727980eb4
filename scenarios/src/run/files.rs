//! The folder of a run.

use std::path::Path;

use super::error::RunError;

/// Files of a run, by the contract of the command line.
pub const FILES: [&str; 5] = ["log.mcap", "series.csv", "summary.json", "scene.resolved.toml", "report.html"];

/// An error if the folder holds a run that may not be replaced.
pub(crate) fn refuse_occupied(dir: &Path, force: bool) -> Result<(), RunError> {
    if dir.is_file() {
        return Err(RunError::NotAFolder(dir.display().to_string()));
    }
    match FILES.iter().find(|name| dir.join(name).exists()) {
        Some(name) if !force => Err(RunError::Occupied(dir.display().to_string(), name)),
        _ => Ok(()),
    }
}

/// Make the folder and remove the files of an earlier run, so that no file is mistaken for one of this run.
pub(super) fn prepare(dir: &Path) -> Result<(), RunError> {
    let wrong = |path: &Path, e| RunError::Write(path.display().to_string(), e);
    std::fs::create_dir_all(dir).map_err(|e| wrong(dir, e))?;
    for path in FILES.iter().map(|name| dir.join(name)).filter(|path| path.exists()) {
        std::fs::remove_file(&path).map_err(|e| wrong(&path, e))?;
    }
    Ok(())
}

/// Write a text file.
pub(super) fn write(path: &Path, text: &str) -> Result<(), RunError> {
    std::fs::write(path, text).map_err(|e| RunError::Write(path.display().to_string(), e))
}
