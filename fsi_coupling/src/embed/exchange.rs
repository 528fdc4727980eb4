//! What an element and the body inside its [`Coupled`](crate::Coupled) share.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde::{Deserialize, Serialize};

use sph_core::state_bytes::{StateError, expect_count};

use super::nodes::Path;

/// What the element and the body inside its [`Coupled`](crate::Coupled) share: the way of the nodes goes in, what the water
/// gave them comes out.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Exchanged {
    /// How the nodes move in this step of the host.
    pub path: Path,
    /// Time since its start [s].
    pub elapsed: f64,
    /// Impulses on the nodes since its start, `[nodes][J_x, J_y, L]` [N s/m, N s/m, N s].
    pub impulse: Vec<[f64; 3]>,
    /// Forces on the nodes now [N/m, N/m, N].
    pub now: Vec<[f64; 3]>,
    /// Work done on the nodes since the start of the run [J/m].
    pub work: f64,
    /// Impulse given to the system from outside since the start of the run [N s/m].
    pub external: [f64; 2],
    /// Mean forces of the step just taken on the boundary particles, and forces now [N/m].
    pub pushed: Vec<[[f64; 2]; 2]>,
}

impl Exchanged {
    /// An error unless there are as many nodes as in `like`, and `particles` of the boundary, or none.
    pub fn check(&self, like: &Exchanged, particles: usize) -> Result<(), StateError> {
        expect_count("nodes with an impulse", self.impulse.len(), like.impulse.len())?;
        expect_count("nodes with a force", self.now.len(), like.now.len())?;
        self.path.check_like(&like.path)?;
        match self.pushed.len() {
            0 => Ok(()),
            found => expect_count("boundary particles", found, particles),
        }
    }
}

/// One exchange, held at both ends.
#[derive(Clone)]
pub(super) struct Shared(Arc<Mutex<Exchanged>>);

impl Shared {
    /// Before the first step.
    pub fn new(path: Path) -> Shared {
        let none = vec![[0.0; 3]; path.end().len()];
        let (impulse, now) = (none.clone(), none);
        let (elapsed, work, external, pushed) = (0.0, 0.0, [0.0; 2], Vec::new());
        Shared(Arc::new(Mutex::new(Exchanged { path, elapsed, impulse, now, work, external, pushed })))
    }

    /// To be read and written; one end at a time.
    pub fn open(&self) -> MutexGuard<'_, Exchanged> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
