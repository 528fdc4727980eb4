//! Cases: the built-in ones by name, others by the path of a TOML file; results that were stored as JSON.

use std::path::Path;

use include_dir::Dir;
use serde::de::DeserializeOwned;

use super::ExperimentError;
use crate::embedded;

/// A kind of case.
pub trait Case: Clone + DeserializeOwned {
    /// The noun used in messages.
    const KIND: &'static str;

    /// The built-in cases.
    fn folder() -> &'static Dir<'static>;

    /// The case's name: that of its file, without folders and ending.
    fn name(&self) -> &str;

    /// Set the name.
    fn rename(&mut self, name: String);

    /// What the case shows, in one sentence.
    fn about(&self) -> &str;

    /// The name of a case that is read from a file.
    fn name_of_file(path: &str) -> String {
        Path::new(path).file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Consistency beyond the file's grammar.
    ///
    /// # Errors
    /// The entry at fault and what is expected.
    fn check(&self) -> Result<(), String> {
        Ok(())
    }
}

/// All built-in cases, by name.
///
/// # Errors
/// A built-in file is wrong.
pub fn all<C: Case>() -> Result<Vec<C>, ExperimentError> {
    let wrong = |(name, why)| ExperimentError::Case { kind: C::KIND, name, why };
    let contents: Vec<(String, C)> = embedded::contents(C::folder()).map_err(wrong)?;
    contents.into_iter().map(|(name, case)| checked(named(case, name))).collect()
}

/// The cases of the given names, or of the given TOML files; all built-in ones if none is given.
///
/// # Errors
/// A name is unknown, or a file is wrong.
pub fn select<C: Case>(names: &[String]) -> Result<Vec<C>, ExperimentError> {
    let all = all::<C>()?;
    if names.is_empty() {
        return Ok(all);
    }
    let known = || all.iter().map(C::name).collect::<Vec<_>>().join(", ");
    let unknown = |name: &String| ExperimentError::Unknown { kind: C::KIND, name: name.clone(), known: known() };
    let chosen = |name: &String| match name.ends_with(".toml") {
        true => from_file(name),
        false => all.iter().find(|c| c.name() == name).cloned().ok_or_else(|| unknown(name)),
    };
    names.iter().map(chosen).collect()
}

/// The case of a TOML file.
fn from_file<C: Case>(path: &str) -> Result<C, ExperimentError> {
    let wrong = |why: String| ExperimentError::Case { kind: C::KIND, name: path.to_string(), why };
    let text = std::fs::read_to_string(path).map_err(|e| wrong(e.to_string()))?;
    let case = toml::from_str(&text).map_err(|e| wrong(e.to_string()))?;
    checked(named(case, C::name_of_file(path)))
}

fn named<C: Case>(mut case: C, name: String) -> C {
    case.rename(name);
    case
}

/// A case whose entries are consistent.
pub(super) fn checked<C: Case>(case: C) -> Result<C, ExperimentError> {
    match case.check() {
        Ok(()) => Ok(case),
        Err(why) => Err(ExperimentError::Case { kind: C::KIND, name: case.name().to_string(), why }),
    }
}

/// A stored result of a kind of case.
pub(super) fn stored<C: Case, T: DeserializeOwned>(path: &Path) -> Result<T, ExperimentError> {
    let wrong = |why: String| ExperimentError::Stored { kind: C::KIND, file: path.display().to_string(), why };
    let text = std::fs::read_to_string(path).map_err(|e| wrong(e.to_string()))?;
    serde_json::from_str(&text).map_err(|e| wrong(e.to_string()))
}

/// Write a text file and the folders that lead to it.
///
/// # Errors
/// The file system's.
pub fn write(path: &Path, text: &str) -> Result<(), ExperimentError> {
    let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
    let written = folder.and_then(|()| std::fs::write(path, text));
    written.map_err(|e| ExperimentError::Write(path.display().to_string(), e))
}
