//! TOML files that are part of the program.

use include_dir::{Dir, File};
use serde::de::DeserializeOwned;

/// Name and text of every TOML file of a folder, by name.
pub fn texts(folder: &'static Dir<'_>) -> Vec<(&'static str, &'static str)> {
    let named = |file: &'static File<'_>| {
        Some((file.path().file_name()?.to_str()?.strip_suffix(".toml")?, file.contents_utf8()?))
    };
    let mut found: Vec<_> = folder.files().filter_map(named).collect();
    found.sort_unstable();
    found
}

/// Name and content of every TOML file of a folder, by name.
///
/// # Errors
/// The name of a file that does not parse, and why.
pub fn contents<T: DeserializeOwned>(folder: &'static Dir<'_>) -> Result<Vec<(String, T)>, (String, String)> {
    let parse = |(name, text): (&str, &str)| match toml::from_str(text) {
        Ok(content) => Ok((name.to_string(), content)),
        Err(error) => Err((name.to_string(), error.to_string())),
    };
    texts(folder).into_iter().map(parse).collect()
}
