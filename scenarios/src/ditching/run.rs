//! A landing with its files.

use std::path::Path;

use super::landed::{Landed, follow};
use super::model::Scene;
use super::page::page;
use super::series::csv;
use crate::run::RunError;

/// Files of a landing.
pub const FILES: [&str; 4] = ["series.csv", "summary.json", "scene.resolved.toml", "report.html"];

/// Follow a landing and write its files into a folder; `force` replaces those that it holds.
///
/// # Errors
/// The folder is a file, holds a landing, or cannot be written to.
pub fn run(scene: &Scene, out: &Path, force: bool) -> Result<Landed, RunError> {
    if out.is_file() {
        return Err(RunError::NotAFolder(out.display().to_string()));
    }
    if let (Some(held), false) = (FILES.iter().find(|name| out.join(name).exists()), force) {
        return Err(RunError::Occupied(out.display().to_string(), held));
    }
    let landed = follow(scene);
    std::fs::create_dir_all(out).map_err(|e| RunError::Write(out.display().to_string(), e))?;
    let texts = [csv(&landed.rows), landed.summary.to_json(), scene.to_toml(), page(scene, &landed)];
    for (name, text) in FILES.iter().zip(texts) {
        let path = out.join(name);
        std::fs::write(&path, text).map_err(|e| RunError::Write(path.display().to_string(), e))?;
    }
    Ok(landed)
}
