//! Files that a scene names: they lie below the folder of the scene's file.

use std::fs;
use std::path::{Component, Path, PathBuf};

use settings::{DataLine, Problem, require};

use crate::bounded_text::read_text;

/// A file that the text of a key names.
pub(super) struct DataFile<'a> {
    pub key: &'a str,
    /// As the scene names it.
    pub name: &'a str,
    pub text: String,
}

/// What is wrong with a line of a file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fault {
    /// Line, from 1.
    pub line: usize,
    pub given: String,
    pub expected: String,
}

impl Fault {
    pub fn new(line: usize, given: impl Into<String>, expected: impl Into<String>) -> Fault {
        Fault { line, given: given.into(), expected: expected.into() }
    }
}

/// Longest text of a file that a message shows [characters].
const SHOWN: usize = 60;

/// Text that fits into a message.
pub(super) fn shortened(text: &str) -> String {
    let printable = text.chars().map(|c| if c.is_control() { ' ' } else { c });
    let start: String = printable.clone().take(SHOWN).collect();
    if printable.count() > SHOWN { start + "…" } else { start }
}

/// The path of a file that a scene names, if it is below the folder of the scene's file; `kind` says what it should be.
pub(super) fn beside(scene_file: &str, key: &str, name: &str, kind: &str) -> Result<PathBuf, Problem> {
    let folder = Path::new(scene_file).parent().unwrap_or(Path::new(""));
    let file = folder.join(name);
    let below = Path::new(name).components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    // what is not there is reported by what reads it
    let within = below && is_within(&file, folder).unwrap_or(true);
    let expected = format_args!("{kind} below the folder of the scene's file");
    require(within, key, format_args!("{name:?}"), expected)?;
    Ok(file)
}

/// Whether a file is below a folder once links are followed.
fn is_within(file: &Path, folder: &Path) -> std::io::Result<bool> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    Ok(fs::canonicalize(file)?.starts_with(fs::canonicalize(folder)?))
}

impl<'a> DataFile<'a> {
    /// The file that a key names.
    pub fn read(scene_file: &str, key: &'a str, name: &'a str, kind: &str) -> Result<DataFile<'a>, Problem> {
        let path = beside(scene_file, key, name, kind)?;
        let text = read_text(&path).map_err(|cause| {
            let expected = format!("{kind} that can be read, looked for at {}: {cause}", path.display());
            Problem::new(key, format!("{:?}", shortened(name)), expected)
        })?;
        Ok(DataFile { key, name, text })
    }

    /// A problem of one of its lines.
    pub fn problem(&self, fault: Fault) -> Problem {
        let at = DataLine { file: self.name.to_string(), line: fault.line };
        Problem::in_file(self.key, at, fault.given, fault.expected)
    }
}
