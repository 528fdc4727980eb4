//! Scenes for tests of this crate: by particles alone.

use water_entry::{EntryModel, OutOfRange};

use super::error::SceneError;
use super::keys::{QuantityOfInterest, Scene};
use super::load::{Loaded, Loader};
use super::models::{Choice, Models};

struct Particles;

impl Models for Particles {
    fn columns(&self, scene: &Scene) -> Vec<String> {
        std::iter::once("time_s".into()).chain(scene.compare.iter().map(|compare| compare.quantity.clone())).collect()
    }

    fn holds(&self, _: &Scene, _: EntryModel) -> Result<(), OutOfRange> {
        Ok(())
    }

    fn spacing_within(&self, _: &Scene, _: QuantityOfInterest, _: f64) -> Option<f64> {
        None
    }

    fn choose(&self, of_particles: &[Scene], _: QuantityOfInterest, _: f64) -> Choice {
        Choice { model: of_particles[0].model, scene: 0, spacing: false, why: String::new() }
    }
}

pub fn load(name_or_path: &str, sets: &[String]) -> Result<Loaded, SceneError> {
    Loader::new(&Particles).load(name_or_path, sets)
}

pub fn load_text(name: &str, text: &str, sets: &[String]) -> Result<Loaded, SceneError> {
    Loader::new(&Particles).load_text(name, text, sets)
}
