//! TOML files that the program carries.

use include_dir::{Dir, File};
use serde::de::DeserializeOwned;

/// Every TOML file of a folder under its name, in the order of names; else the name of one that is wrong, and why.
pub(crate) fn all<T: DeserializeOwned>(folder: &Dir<'_>) -> Result<Vec<(String, T)>, (String, String)> {
    let mut found = Vec::new();
    for file in folder.files().filter(|f| f.path().extension().is_some_and(|e| e == "toml")) {
        let name = file.path().file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let text = file.contents_utf8().unwrap_or_default();
        match toml::from_str(text) {
            Ok(content) => found.push((name, content)),
            Err(error) => return Err((name, error.to_string())),
        }
    }
    found.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(found)
}

/// Name and text of every TOML file of a folder, by name.
pub(crate) fn texts(folder: &'static Dir<'_>) -> Vec<(&'static str, &'static str)> {
    let named = |file: &'static File<'_>| {
        Some((file.path().file_name()?.to_str()?.strip_suffix(".toml")?, file.contents_utf8()?))
    };
    let mut found: Vec<_> = folder.files().filter_map(named).collect();
    found.sort_unstable();
    found
}
