//! A TOML text read table by table, in the order of the file, with the place of each mistake.

use std::ops::Range;
use std::sync::Arc;

use miette::NamedSource;
use scene::SceneError;
use scene::source::LARGEST_NUMBER;
use settings::Problem;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Value};

/// A file's name and text.
pub(super) struct TomlReader<'a> {
    pub name: &'a str,
    pub text: &'a str,
}

/// A key, where it stands, and its value.
#[derive(Clone)]
pub(super) struct Entry<'t> {
    pub key: String,
    pub place: Range<usize>,
    pub value: &'t Spanned<DeValue<'t>>,
}

impl<'a> TomlReader<'a> {
    /// The file as a table.
    pub fn parse(&self) -> Result<DeTable<'a>, SceneError> {
        let parsed = DeTable::parse(self.text);
        let table =
            parsed.map_err(|e| self.error(e.span().unwrap_or(0..0), format!("not valid TOML: {}", e.message())))?;
        Ok(table.into_inner())
    }

    /// A mistake at a place of the text.
    pub fn error(&self, span: Range<usize>, problem: String) -> SceneError {
        let before = &self.text.as_bytes()[..span.start.min(self.text.len())];
        SceneError::File {
            name: self.name.to_string(),
            line: 1 + before.iter().filter(|byte| **byte == b'\n').count(),
            problem: Box::new(Problem { sentence: problem, ..Problem::default() }),
            text: Arc::new(NamedSource::new(self.name, self.text.to_string())),
            span: span.into(),
            help: None,
        }
    }

    /// `key` has a value of the wrong kind.
    pub fn unexpected(&self, key: &str, value: &Spanned<DeValue<'_>>, expected: &str) -> SceneError {
        self.error(value.span(), format!("`{key}` = {}: expected {expected}", self.shown(value)))
    }

    /// The text of a value, shortened.
    fn shown(&self, value: &Spanned<DeValue<'_>>) -> String {
        const LONGEST: usize = 60;
        let text: String =
            self.text.get(value.span()).unwrap_or("a table").split_whitespace().collect::<Vec<_>>().join(" ");
        match text.char_indices().nth(LONGEST) {
            Some((end, _)) => format!("{} …", &text[..end]),
            None => text,
        }
    }

    /// The entries of a table in the order of the file.
    pub fn entries<'t>(&self, table: &'t DeTable<'t>) -> Vec<Entry<'t>> {
        let mut entries: Vec<Entry<'t>> = table
            .iter()
            .map(|(key, value)| Entry { key: key.get_ref().to_string(), place: key.span(), value })
            .collect();
        entries.sort_by_key(|entry| entry.place.start);
        entries
    }

    /// The entries of a table and of the tables in it, with keys joined by dots; `is_leaf` says which tables are values.
    pub fn leaves<'t>(&self, table: &'t DeTable<'t>, is_leaf: fn(&DeTable<'_>) -> bool) -> Vec<Entry<'t>> {
        let mut found = Vec::new();
        let mut waiting: Vec<Entry<'t>> = self.entries(table);
        waiting.reverse();
        while let Some(entry) = waiting.pop() {
            match entry.value.get_ref() {
                DeValue::Table(inner) if !is_leaf(inner) => {
                    let below = self.entries(inner).into_iter().rev();
                    waiting.extend(below.map(|e| Entry { key: format!("{}.{}", entry.key, e.key), ..e }));
                }
                _ => found.push(entry),
            }
        }
        found
    }

    /// The table at a key.
    pub fn table<'t>(&self, entry: &Entry<'t>) -> Result<&'t DeTable<'t>, SceneError> {
        match entry.value.get_ref() {
            DeValue::Table(table) => Ok(table),
            _ => Err(self.unexpected(&entry.key, entry.value, "a table")),
        }
    }

    /// Refuses a key that is not known.
    pub fn unknown(&self, entry: &Entry<'_>, known: &[&str]) -> SceneError {
        let like = |word: &str| strsim::normalized_damerau_levenshtein(&entry.key, word);
        let near = known.iter().max_by(|a, b| like(a).total_cmp(&like(b))).filter(|near| like(near) > 0.6);
        let near = near.map(|near| format!(", perhaps `{near}`"));
        let expected = format!("expected one of {}{}", known.join(", "), near.unwrap_or_default());
        self.error(entry.place.clone(), format!("unknown key `{}`: {expected}", entry.key))
    }

    /// A value as TOML has it.
    pub fn value(&self, value: &Spanned<DeValue<'_>>) -> Result<Value, SceneError> {
        let text = self.text.get(value.span()).unwrap_or_default();
        text.parse::<Value>().map_err(|e| self.error(value.span(), format!("not valid TOML: {}", e.message())))
    }

    /// A number that a scene can hold.
    pub fn number(&self, key: &str, value: &Spanned<DeValue<'_>>) -> Result<f64, SceneError> {
        let number = match self.value(value)? {
            Value::Integer(whole) => Some(whole as f64),
            Value::Float(float) => Some(float),
            _ => None,
        };
        let number = number.filter(|number| number.abs() <= LARGEST_NUMBER);
        number.ok_or_else(|| self.unexpected(key, value, &format!("a finite number up to {LARGEST_NUMBER:e}")))
    }

    /// A whole number within limits.
    pub fn whole(&self, key: &str, value: &Spanned<DeValue<'_>>, limits: [i64; 2]) -> Result<i64, SceneError> {
        let [least, most] = limits;
        match self.value(value)? {
            Value::Integer(whole) if (least..=most).contains(&whole) => Ok(whole),
            _ => Err(self.unexpected(key, value, &format!("a whole number from {least} to {most}"))),
        }
    }

    /// A text.
    pub fn string(&self, key: &str, value: &Spanned<DeValue<'_>>) -> Result<String, SceneError> {
        match value.get_ref() {
            DeValue::String(text) => Ok(text.to_string()),
            _ => Err(self.unexpected(key, value, "a text in quotes")),
        }
    }

    /// A text, or a list of them.
    pub fn strings(&self, key: &str, value: &Spanned<DeValue<'_>>) -> Result<Vec<String>, SceneError> {
        match value.get_ref() {
            DeValue::Array(items) if !items.is_empty() => items.iter().map(|item| self.string(key, item)).collect(),
            DeValue::Array(_) => Err(self.unexpected(key, value, "at least one text")),
            _ => Ok(vec![self.string(key, value)?]),
        }
    }
}
