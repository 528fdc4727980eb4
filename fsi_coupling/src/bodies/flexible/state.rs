//! What a step changes in a flexible body.

use structure_fe::{Envelope, State};

/// What a step changes.
#[derive(Clone)]
pub(crate) struct Moving {
    pub nodes: State,
    /// Load of the fluid on the nodes: the mean over the step, and now.
    pub mean: Vec<[f64; 3]>,
    pub now: Vec<[f64; 3]>,
    /// Where the fluid last saw the boundary particles [m]: where they were expected. What the expectation missed is made
    /// up in the next step's velocity, so that the fluid sees a path without jumps (K5).
    pub shown: Vec<[f64; 2]>,
    /// Impulses of blows that the next step takes up.
    pub struck: Vec<[f64; 3]>,
    /// What these blows will have made of the velocities.
    pub shaken: Vec<[f64; 3]>,
    /// Length of the step that they are taken up in, by the last one [s].
    pub dt: f64,
    /// Resultant force of the fluid now [N/m], and its moment about the tank's origin [N].
    pub force: [f64; 3],
    pub external: [f64; 2],
    pub work: f64,
    pub support: f64,
    pub dissipated: f64,
    /// What the panels have borne so far.
    pub envelope: Envelope,
}

impl Moving {
    /// At the start: nothing has acted yet.
    pub fn new(nodes: State, envelope: Envelope) -> Moving {
        let still = vec![[0.0; 3]; nodes.displacement.len()];
        Moving {
            nodes,
            mean: still.clone(),
            now: still.clone(),
            shown: Vec::new(),
            struck: still.clone(),
            shaken: still,
            dt: 0.0,
            force: [0.0; 3],
            external: [0.0; 2],
            work: 0.0,
            support: 0.0,
            dissipated: 0.0,
            envelope,
        }
    }
}

/// Σ a·b over the nodes: of loads with displacements, work [J/m].
pub(crate) fn pairing(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}
