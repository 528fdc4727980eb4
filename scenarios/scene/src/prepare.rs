//! From what a scene's text says to plain keys: files that it names are read, names of materials become numbers.

use serde_json::Value;
use settings::Problem;

use super::outline::OutlineReport;
use super::references::settle_references;
use super::{library, modes_file, motion_file, outline, stations, structure_file};

/// What the files of a scene say beside its values.
#[derive(Debug, Default)]
pub(super) struct Prepared {
    /// What was understood of an outline.
    pub outline: Option<OutlineReport>,
    /// What was left out, in sentences.
    pub notes: Vec<String>,
}

/// Replaces names of files, materials and numbered points by their values.
pub(super) fn prepare(given: &mut Value, scene_file: &str) -> Result<Prepared, Problem> {
    settle_references(given, scene_file)?;
    let structures = structure_file::files(given, scene_file)?;
    library::settle(given);
    let mut notes = motion_file::settle(given, scene_file)?;
    modes_file::settle(given, scene_file)?;
    let from_file = outline::settle(given, scene_file)?;
    let written = if from_file.is_some() { None } else { stations::written(given) };
    stations::settle(given, from_file.as_ref().map(|settled| &settled.stations).or(written.as_ref()))?;
    structure_file::settle(given, &structures)?;
    notes.extend(structures.iter().flat_map(|file| file.notes().to_vec()));
    notes.extend(from_file.iter().flat_map(|settled| settled.notes.clone()));
    Ok(Prepared { outline: from_file.map(|settled| settled.report), notes })
}
