//! What reading a scene asks of the models that run it, which lie above scenes.

use water_entry::{EntryModel, OutOfRange};

use super::keys::{QuantityOfInterest, Scene};

/// The models of scenes: theories and particles.
pub trait Models {
    /// Columns of the curves that a run of the scene writes, the first of them the time.
    fn columns(&self, scene: &Scene) -> Vec<String>;

    /// Refuses a scene that a theory does not hold for, from its start to its end.
    ///
    /// # Errors
    /// What is outside the range of the theory.
    fn holds(&self, scene: &Scene, theory: EntryModel) -> Result<(), OutOfRange>;

    /// The coarsest spacing at which particles give a quantity within a share of it [m]; `None` where that is not known.
    fn spacing_within(&self, scene: &Scene, want: QuantityOfInterest, within: f64) -> Option<f64>;

    /// The cheapest model that gives a quantity within a share of it, of the theories and of the same scene by particles, with one solver or
    /// several.
    fn choose(&self, of_particles: &[Scene], want: QuantityOfInterest, within: f64) -> Choice;
}

/// What was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The model.
    pub model: EntryModel,
    /// Index of the scene of particles.
    pub scene: usize,
    /// True if that scene's spacing is known to be fine enough.
    pub spacing: bool,
    /// The reason.
    pub why: String,
}
