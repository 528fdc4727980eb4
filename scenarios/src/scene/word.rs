//! Names that become parts of file and column names.

use fsi_coupling::settings::Problem;

/// Refuses a name that has other characters than letters, digits, `_` and `-`.
pub(crate) fn word(key: &str, name: &str) -> Result<(), Problem> {
    let fits = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !name.is_empty() && name.chars().all(fits) {
        true => Ok(()),
        false => Err(Problem::new(key, format!("{name:?}"), "a word of letters, digits, _ and -")),
    }
}
