//! What is wrong with a value, before anybody knows where it was written; and the checks that find it.

use std::fmt::Display;
use std::ops::RangeInclusive;

/// A wrong value: the key, and a sentence that names it, what was given and what was expected.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Problem {
    pub key: String,
    pub sentence: String,
}

impl Problem {
    pub fn new(key: &str, given: impl Display, expected: impl Display) -> Problem {
        let sentence = format!("`{key}` = {given}: expected {expected}");
        Problem { key: key.to_string(), sentence }
    }

    pub fn missing(key: &str, why: impl Display) -> Problem {
        let sentence = format!("`{key}` is missing: expected {why}");
        Problem { key: key.to_string(), sentence }
    }
}

/// Four significant digits.
pub(crate) fn significant(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    rounded.to_string()
}

pub(crate) fn required<T>(key: &str, value: Option<T>, what: &str) -> Result<T, Problem> {
    value.ok_or_else(|| Problem::missing(key, what))
}

pub(crate) fn positive(key: &str, value: f64) -> Result<f64, Problem> {
    match value > 0.0 && value.is_finite() {
        true => Ok(value),
        false => Err(Problem::new(key, value, "a finite number above 0")),
    }
}

pub(crate) fn not_negative(key: &str, value: f64) -> Result<f64, Problem> {
    match value >= 0.0 {
        true => Ok(value),
        false => Err(Problem::new(key, value, "a number of at least 0")),
    }
}

pub(crate) fn within(key: &str, value: f64, range: RangeInclusive<f64>) -> Result<f64, Problem> {
    match range.contains(&value) {
        true => Ok(value),
        false => {
            let expected = format!("a number from {} to {}", range.start(), range.end());
            Err(Problem::new(key, value, expected))
        }
    }
}

/// A word that can be part of a file or column name: letters, digits, `_` and `-`.
pub(crate) fn word(key: &str, value: String) -> Result<String, Problem> {
    let fits = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !value.is_empty() && value.chars().all(fits) {
        true => Ok(value),
        false => Err(Problem::new(key, format!("{value:?}"), "a word of letters, digits, _ and -")),
    }
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
