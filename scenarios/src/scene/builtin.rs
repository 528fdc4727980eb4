//! The scenes that come with the program: every file in `scenarios/scenes`.

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

use crate::embedded::texts;

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/scenes");

/// Name and text of each built-in scene, by name.
pub fn builtin() -> &'static [(&'static str, &'static str)] {
    static SCENES: LazyLock<Vec<(&str, &str)>> = LazyLock::new(|| texts(&FILES));
    &SCENES
}
