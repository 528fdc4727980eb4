//! From a name or a path to a landing.

use std::fs;
use std::io::ErrorKind;
use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

use super::check::checked;
use super::model::{AeroplaneKeys, LandingKeys, Scene, StationKeys, WingKeys, schema};
use crate::embedded::texts;
use crate::scene::SceneError;
use crate::scene::draft::Draft;
use crate::scene::source::Source;
use fsi_coupling::settings::Problem;

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/ditching");

/// Name and text of each built-in landing, by name.
pub fn builtin() -> &'static [(&'static str, &'static str)] {
    static SCENES: LazyLock<Vec<(&str, &str)>> = LazyLock::new(|| texts(&FILES));
    &SCENES
}

/// Loads a built-in landing by its name, or a file by its path, with `--set` arguments applied in their order.
pub fn load(name_or_path: &str, sets: &[String]) -> Result<Scene, SceneError> {
    if let Some((name, text)) = builtin().iter().find(|(name, _)| *name == name_or_path) {
        return load_text(&format!("{name}.toml"), text, sets);
    }
    let text = fs::read_to_string(name_or_path).map_err(|cause| match cause.kind() {
        ErrorKind::NotFound => {
            let names: Vec<&str> = builtin().iter().map(|(name, _)| *name).collect();
            SceneError::Unknown {
                name: name_or_path.to_string(),
                help: format!("built-in landings: {}", names.join(", ")),
            }
        }
        _ => SceneError::Unreadable { path: name_or_path.to_string(), cause },
    })?;
    load_text(name_or_path, &text, sets)
}

/// Loads a landing from its text; `name` stands for the file in messages. What the file leaves out is filled in.
pub fn load_text(name: &str, text: &str, sets: &[String]) -> Result<Scene, SceneError> {
    let source = Source { name: name.to_string(), text: text.to_string(), sets: sets.to_vec(), schema: schema() };
    let given = source.read()?;
    let scene = Draft::of(&given, schema()).and_then(|draft| read(&draft));
    scene.and_then(checked).map_err(|problem| source.error(problem))
}

/// The landing of a draft: table by table, so that a missing key is found where it belongs.
fn read(draft: &Draft) -> Result<Scene, Problem> {
    draft.read::<LandingKeys>("landing")?;
    draft.read::<AeroplaneKeys>("aeroplane")?;
    draft.read::<WingKeys>("wing")?;
    for k in 0..draft.count("stations") {
        draft.read::<StationKeys>(&format!("stations[{k}]"))?;
    }
    draft.read("")
}
