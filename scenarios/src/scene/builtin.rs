//! The scenes that come with the program: every file in `scenarios/scenes`.

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/scenes");

/// Name and text of each built-in scene, by name.
pub fn builtin() -> &'static [(&'static str, &'static str)] {
    static SCENES: LazyLock<Vec<(&str, &str)>> = LazyLock::new(|| {
        let scene = |file: &'static include_dir::File<'_>| {
            Some((file.path().file_name()?.to_str()?.strip_suffix(".toml")?, file.contents_utf8()?))
        };
        let mut scenes: Vec<_> = FILES.files().filter_map(scene).collect();
        scenes.sort_unstable();
        scenes
    });
    &SCENES
}
