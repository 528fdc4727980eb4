//! Folders for files that are needed once.

use std::path::PathBuf;

use crate::guard::random_word;

/// A folder of its own in the system's temporary folder; it is gone with the value.
pub struct Scratch(pub PathBuf);

impl Scratch {
    /// A new one.
    ///
    /// # Errors
    /// The system refuses.
    pub fn new() -> Result<Scratch, String> {
        let word = random_word().map_err(|cause| cause.to_string())?;
        let path = std::env::temp_dir().join(format!("splashdown-{word}"));
        std::fs::create_dir(&path).map_err(|cause| format!("{}: {cause}", path.display()))?;
        Ok(Scratch(path))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // what cannot be removed is left to the system
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
