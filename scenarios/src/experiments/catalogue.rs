//! Cases: the built-in ones by name, others by the path of a TOML file; results that were stored as JSON.

use std::fmt::Display;
use std::marker::PhantomData;
use std::path::Path;

use include_dir::Dir;
use scene::{embedded, read_text};
use serde::de::DeserializeOwned;

use super::ExperimentError;

/// A case of an experiment.
pub trait Case: Clone + DeserializeOwned {
    /// The case's name and what it shows in one sentence.
    fn title(&self) -> [&str; 2];

    /// Set the name.
    fn rename(&mut self, name: String);

    /// The name of a case that is read from a file: that of the file, without folders and ending.
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

/// The cases of one kind.
pub struct Catalogue<C> {
    /// The noun used in messages.
    kind: &'static str,
    /// The command that makes the experiment.
    command: &'static str,
    folder: &'static Dir<'static>,
    case: PhantomData<fn() -> C>,
}

impl<C: Case> Catalogue<C> {
    /// The cases in a folder.
    pub(super) const fn new(kind: &'static str, command: &'static str, folder: &'static Dir<'static>) -> Self {
        Catalogue { kind, command, folder, case: PhantomData }
    }

    /// All built-in cases, by name.
    ///
    /// # Errors
    /// A built-in file is wrong.
    pub fn all(&self) -> Result<Vec<C>, ExperimentError> {
        let contents: Vec<(String, C)> =
            embedded::contents(self.folder).map_err(|(name, why)| self.wrong(&name, &why))?;
        contents.into_iter().map(|(name, case)| self.named(case, name)).collect()
    }

    /// The cases of the given names, or of the given TOML files; all built-in ones if none is given.
    ///
    /// # Errors
    /// A name is unknown, or a file is wrong.
    pub fn select(&self, names: &[String]) -> Result<Vec<C>, ExperimentError> {
        let all = self.all()?;
        if names.is_empty() {
            return Ok(all);
        }
        let unknown = |name: &String| {
            let known = all.iter().map(|c| c.title()[0]).collect::<Vec<_>>().join(", ");
            ExperimentError::Case(format!("no {} `{name}`; there are: {known}", self.kind))
        };
        let chosen = |name: &String| match name.ends_with(".toml") {
            true => self.read_file(name),
            false => all.iter().find(|c| c.title()[0] == name).cloned().ok_or_else(|| unknown(name)),
        };
        names.iter().map(chosen).collect()
    }

    /// The case of a TOML file.
    fn read_file(&self, path: &str) -> Result<C, ExperimentError> {
        let text = read_text(path).map_err(|e| self.wrong(path, &e))?;
        self.named(toml::from_str(&text).map_err(|e| self.wrong(path, &e))?, C::name_of_file(path))
    }

    fn named(&self, mut case: C, name: String) -> Result<C, ExperimentError> {
        case.rename(name);
        self.checked(case)
    }

    /// A case whose entries are consistent.
    pub(super) fn checked(&self, case: C) -> Result<C, ExperimentError> {
        match case.check() {
            Ok(()) => Ok(case),
            Err(why) => Err(self.wrong(case.title()[0], &why)),
        }
    }

    fn wrong(&self, name: &str, why: &dyn Display) -> ExperimentError {
        ExperimentError::Case(format!("{} `{name}`: {why}", self.kind))
    }

    /// A stored result.
    pub(super) fn stored<T: DeserializeOwned>(&self, path: &Path) -> Result<T, ExperimentError> {
        let text = read_text(path).map_err(|e| self.not_stored(path, &e))?;
        serde_json::from_str(&text).map_err(|e| self.not_stored(path, &e))
    }

    pub(super) fn not_stored(&self, path: &Path, why: &dyn Display) -> ExperimentError {
        let Catalogue { kind, command, .. } = self;
        ExperimentError::Case(format!(
            "{}: {why}; expected the JSON file of a {kind} that was measured: `splashdown {command} NAME` writes \
             NAME.json into --out",
            path.display()
        ))
    }
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
