//! Steady planing of a prismatic hull, a towing tank: from a file to numbers (THEORY EN42–EN45).
//!
//! # Example
//! ```
//! use scenarios::planing;
//!
//! let towed = planing::tow(&planing::load("planing_hull", &["trim_deg=8".to_string()])?);
//! assert!(towed.summary.lift_n.band.is_some());
//! # Ok::<(), scene::SceneError>(())
//! ```

mod model;
mod towed;

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use include_dir::{Dir, include_dir};
use run::RunError;
use run::folder::{refuse_files, write};
use scene::draft::Draft;
use scene::mistaken_file::Expected;
use scene::source::Source;
use scene::{SceneError, texts};
use settings::Problem;

pub use model::{HullKeys, Scene, WaterKeys, schema};
pub use towed::{Judged, Summary, Towed};

static HULLS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/planing");

/// Name and text of each built-in planing hull, by name.
pub fn builtin() -> &'static [(&'static str, &'static str)] {
    static SCENES: LazyLock<Vec<(&str, &str)>> = LazyLock::new(|| texts(&HULLS));
    &SCENES
}

/// Loads a built-in hull by its name, or a file by its path, with `--set` arguments applied in their order.
pub fn load(name_or_path: &str, sets: &[String]) -> Result<Scene, SceneError> {
    let source = Source::find(Expected::PlaningHull, builtin(), name_or_path, sets, schema())?;
    let given = source.read()?;
    let scene = Draft::of(&given, schema()).and_then(|draft| {
        draft.read::<HullKeys>("hull")?;
        draft.read::<Scene>("")
    });
    scene.and_then(Scene::checked).map_err(|problem| source.error(problem))
}

/// The load of a hull that was [loaded](load).
///
/// # Panics
/// A scene that was changed by hand into one that [`load`] refuses.
pub fn tow(scene: &Scene) -> Towed {
    let refused = |problem: Problem| -> ! { panic!("{}", problem.sentence) };
    let (hull, planing) = scene.hull_and_load().unwrap_or_else(|problem| refused(problem));
    Towed::new(scene, &hull, planing)
}

/// Files of a planing hull.
pub const FILES: [&str; 3] = ["slices.csv", "summary.json", "scene.resolved.toml"];

/// Computes the load of a hull and writes its files into a folder; `force` replaces those that it holds.
///
/// # Errors
/// The folder is a file, holds such files, or cannot be written to.
pub fn run(scene: &Scene, out: &Path, force: bool) -> Result<Towed, RunError> {
    refuse_files(out, &FILES, force)?;
    let towed = tow(scene);
    fs::create_dir_all(out).map_err(|e| RunError::Write(out.display().to_string(), e))?;
    let texts = [towed.slices_csv(), towed.summary.to_json(), scene.to_toml()];
    for (name, text) in FILES.iter().zip(texts) {
        write(&out.join(name), &text)?;
    }
    Ok(towed)
}
