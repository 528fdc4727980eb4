//! Scenes with all models of this program: theories and particles.

use scene::{Choice, Loaded, Loader, Models, QuantityOfInterest, Scene, SceneError};
use water_entry::{EntryModel, OutOfRange};

use crate::charted::spacing_within;
use crate::model_hierarchy::{Theory, charted_number, choose};
use crate::observers::columns;

/// All models.
struct Hierarchy;

impl Models for Hierarchy {
    fn columns(&self, scene: &Scene) -> Vec<String> {
        columns(scene)
    }

    fn holds(&self, scene: &Scene, theory: EntryModel) -> Result<(), OutOfRange> {
        let (_, end) = Theory::outlined(scene, theory)?;
        end.map_or(Ok(()), Err)
    }

    fn spacing_within(&self, scene: &Scene, want: QuantityOfInterest, within: f64) -> Option<f64> {
        spacing_within(scene, charted_number(want)?, within)
    }

    fn choose(&self, of_particles: &[Scene], want: QuantityOfInterest, within: f64) -> Choice {
        choose(of_particles, want, within)
    }
}

/// Loads a built-in scene by its name, or a scene file by its path, with `--set` arguments applied in their order.
///
/// # Errors
/// A scene that cannot be read, that has no sense, or that its model does not hold for.
pub fn load(name_or_path: &str, sets: &[String]) -> Result<Loaded, SceneError> {
    Loader::new(&Hierarchy).load(name_or_path, sets)
}

/// As [`load`], but steps at which the scheme is known to break down are let through (THEORY WC16): for maps of where that is.
///
/// # Errors
/// As [`load`].
pub fn load_beyond_limits(name_or_path: &str, sets: &[String]) -> Result<Loaded, SceneError> {
    Loader::new(&Hierarchy).beyond_limits().load(name_or_path, sets)
}

/// Loads a scene from its text; `name` stands for the file in messages.
///
/// # Errors
/// As [`load`].
pub fn load_text(name: &str, text: &str, sets: &[String]) -> Result<Loaded, SceneError> {
    Loader::new(&Hierarchy).load_text(name, text, sets)
}
