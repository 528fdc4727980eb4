//! What is wrong with a value, independent of where it was written.

use std::fmt::{self, Display};

/// A wrong value: its key, and a sentence that names the key, what was given and what was expected.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Problem {
    /// The key's path, such as `gauges[0].at`.
    pub key: String,
    /// The sentence.
    pub sentence: String,
    /// What was given; absent for a key that is missing.
    pub given: Option<String>,
    /// What was expected; empty where the sentence alone says it.
    pub expected: String,
    /// The line of another file that the key names.
    pub line: Option<Box<DataLine>>,
}

/// A line of a file of data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DataLine {
    /// The file.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
}

impl Problem {
    /// A value that is not allowed.
    pub fn new(key: &str, given: impl Display, expected: impl Display) -> Problem {
        let (given, expected) = (given.to_string(), expected.to_string());
        let sentence = format!("`{key}` = {given}: expected {expected}");
        Problem { key: key.to_string(), sentence, given: Some(given), expected, line: None }
    }

    /// A wrong line of a file that a key names.
    pub fn in_file(key: &str, at: DataLine, given: impl Display, expected: impl Display) -> Problem {
        let (given, expected) = (given.to_string(), expected.to_string());
        let sentence = format!("`{key}`: {}:{}: {given}: expected {expected}", at.file, at.line);
        Problem { key: key.to_string(), sentence, given: Some(given), expected, line: Some(Box::new(at)) }
    }

    /// A key that is absent.
    pub fn missing(key: &str, expected: impl Display) -> Problem {
        let expected = expected.to_string();
        let sentence = format!("`{key}` is missing: expected {expected}");
        Problem { key: key.to_string(), sentence, expected, ..Problem::default() }
    }
}

/// Refuses a value unless the condition holds.
pub fn require(holds: bool, key: &str, given: impl Display, expected: impl Display) -> Result<(), Problem> {
    if holds { Ok(()) } else { Err(Problem::new(key, given, expected)) }
}

impl Display for Problem {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.sentence)
    }
}

/// A number with four significant digits.
pub fn significant(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    rounded.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_digits_whatever_the_size() {
        assert_eq!(significant(1234.56789), "1235");
        assert_eq!(significant(0.000123456), "0.0001235");
        assert_eq!(significant(-2.0), "-2");
    }
}
