//! The text that a scene comes from, and where in it a key stands.

use std::ops::Range;
use std::sync::Arc;

use fsi_coupling::settings::{Keyword, Problem, Schema};
use miette::NamedSource;
use toml::de::{DeTable, DeValue};

use super::error::SceneError;
use super::overrides::{Segment, assignment, segments};

/// A scene's text and the `--set` arguments that change it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Source {
    pub name: String,
    pub text: String,
    pub sets: Vec<String>,
    /// The schema of such a file.
    pub schema: &'static Schema,
}

impl Source {
    /// Puts a problem in its place: the last `--set` argument that wrote the key, else its line in the text.
    pub fn error(&self, problem: Problem) -> SceneError {
        let help = self.schema.keyword(&problem.key).map(Keyword::help);
        match self.sets.iter().rfind(|set| writes(set, &problem.key)) {
            Some(argument) => SceneError::Set { argument: argument.clone(), problem: problem.sentence, help },
            None => self.error_at(self.span(&problem.key), problem.sentence, help),
        }
    }

    /// What the TOML parser has to say about the text.
    pub fn syntax_error(&self, error: &toml::de::Error) -> SceneError {
        let sentence = format!("not valid TOML: {}", error.message());
        self.error_at(error.span().unwrap_or(0..0), sentence, None)
    }

    fn error_at(&self, span: Range<usize>, problem: String, help: Option<String>) -> SceneError {
        let before = &self.text.as_bytes()[..span.start.min(self.text.len())];
        SceneError::File {
            name: self.name.clone(),
            line: 1 + before.iter().filter(|byte| **byte == b'\n').count(),
            problem,
            text: Arc::new(NamedSource::new(&self.name, self.text.clone())),
            span: span.into(),
            help,
        }
    }

    /// Where the value of a key stands; a key that no scene has, itself; for a key that is not written, its table's header.
    fn span(&self, key: &str) -> Range<usize> {
        let Ok(document) = DeTable::parse(&self.text) else {
            return 0..0;
        };
        let known = self.schema.keyword(key).is_some();
        let mut span = 0..0;
        let mut value = &DeValue::Table(document.into_inner());
        for segment in segments(key) {
            let found = match (&segment, value) {
                (Segment::Key(key), DeValue::Table(table)) => {
                    table.get_key_value(*key).map(|(key, item)| match known && !item.get_ref().is_table() {
                        true => (item.span(), item),
                        false => (key.span(), item),
                    })
                }
                (Segment::Index(index), DeValue::Array(items)) => items.get(*index).map(|item| (item.span(), item)),
                _ => None,
            };
            let Some((place, item)) = found else {
                break;
            };
            (span, value) = (place, item.get_ref());
        }
        span
    }
}

/// Does the argument write the key, a table around it or an item in it?
fn writes(set: &str, key: &str) -> bool {
    assignment(set).is_some_and(|(path, _)| segments(path).zip(segments(key)).all(|(a, b)| a == b))
}
