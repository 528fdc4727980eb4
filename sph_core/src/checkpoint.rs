//! Save and restore: a step can be taken back, and comes again to the same bits.
//!
//! Kept is what the next step reads: state, derived quantities, what walls extrapolated, the history of a multistep
//! integrator, what a projection keeps, and the neighbour lists. The lists are not copied: they are set aside if they are remade meanwhile.

use std::sync::Arc;

use crate::fluid::Fluid;
use crate::interactions::pair::Extrapolated;
use crate::legacy::dynamic_walls::DynamicWalls;
use crate::legacy::multistep::History;
use crate::neighbours::Search;
use crate::particles::{Derived, Particles};
use crate::projection::Projection;
use crate::walls::midline::Screen;

/// A state to return to.
pub(crate) struct Saved {
    particles: Particles,
    derived: Derived,
    time: f64,
    steps: u64,
    history: History,
    extrapolated: Vec<Extrapolated>,
    dynamic_walls: DynamicWalls,
    displaced: bool,
    screens: Vec<Screen>,
    projection: Projection,
    /// The lists of that moment, once others have taken their place.
    search: Option<Arc<Search>>,
}

impl Fluid {
    /// Remember the present state, above those remembered before. The walls are their owners' to remember: all of
    /// [`Walls`](crate::Walls).
    pub fn save(&mut self) {
        self.saved.push(Saved {
            particles: self.particles.clone(),
            derived: self.derived.clone(),
            time: self.time,
            steps: self.steps,
            history: self.history.clone(),
            extrapolated: self.extrapolated.clone(),
            dynamic_walls: self.dynamic_walls.clone(),
            displaced: self.displaced,
            screens: self.rows.screens.clone(),
            projection: self.projection.clone(),
            search: None,
        });
    }

    /// Return to the state last saved, as often as needed; without one nothing happens.
    pub fn restore(&mut self) {
        let Some(saved) = self.saved.last_mut() else { return };
        self.particles.clone_from(&saved.particles);
        self.derived.clone_from(&saved.derived);
        (self.time, self.steps, self.displaced) = (saved.time, saved.steps, saved.displaced);
        self.history.clone_from(&saved.history);
        self.extrapolated.clone_from(&saved.extrapolated);
        self.dynamic_walls.clone_from(&saved.dynamic_walls);
        self.rows.screens.clone_from(&saved.screens);
        self.projection.clone_from(&saved.projection);
        if let Some(search) = saved.search.take() {
            self.search = Arc::unwrap_or_clone(search);
        }
    }

    /// Forget the state last saved.
    pub fn forget(&mut self) {
        self.saved.pop();
    }
}

/// The lists are about to be remade: set them aside for the saved states that need them.
pub(crate) fn set_lists_aside(saved: &mut [Saved], search: &mut Search) {
    if saved.iter().all(|s| s.search.is_some()) {
        return;
    }
    let rebuilds = search.rebuilds;
    let aside = Arc::new(std::mem::take(search));
    search.rebuilds = rebuilds;
    for state in saved.iter_mut().filter(|s| s.search.is_none()) {
        state.search = Some(aside.clone());
    }
}
