//! The words that start this program as a process of its own.

use std::ffi::OsString;
use std::fmt;
use std::process::Command;

use super::error::SweepError;

/// The words that start this program: its path, or an interpreter with what it runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    first: OsString,
    rest: Vec<OsString>,
}

impl Program {
    /// A program of these words.
    ///
    /// # Errors
    /// There are none: the system did not tell where this program is.
    pub fn of(words: &[OsString]) -> Result<Program, SweepError> {
        let (first, rest) =
            words.split_first().ok_or_else(|| SweepError::Failed("cannot find this program's file".into()))?;
        Ok(Program { first: first.clone(), rest: rest.to_vec() })
    }

    /// A command that starts it.
    pub fn command(&self) -> Command {
        let mut command = Command::new(&self.first);
        command.args(&self.rest);
        command
    }

    /// Its words as text.
    pub fn words(&self) -> Vec<String> {
        [&self.first].into_iter().chain(&self.rest).map(|word| word.to_string_lossy().into_owned()).collect()
    }
}

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words().join(" "))
    }
}
