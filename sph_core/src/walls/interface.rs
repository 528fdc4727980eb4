//! Walls that yield: what the fluid asks of the owners of walls that a force accelerates (THEORY C1–C7).

use std::fmt;
use std::ops::Range;

use crate::walls::{WallForces, WallsMut};

/// A wall particle, the force on it, and how that answers to its acceleration: δF = push (arm·δa) (THEORY C1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Touch {
    /// Where it is [m].
    pub at: [f64; 2],
    /// Force of the fluid on it [N/m].
    pub force: [f64; 2],
    /// ρ₀ V_w G_w [kg/m²].
    pub push: [f64; 2],
    /// m_w [m].
    pub arm: [f64; 2],
}

/// What an owner of walls meets in the fluid.
#[derive(Clone, Copy, Debug)]
pub struct Encounter<'a> {
    /// Its particles, in its order.
    pub touches: &'a [Touch],
    /// Time of the encounter, from the step's end [s]; not positive.
    pub offset: f64,
    /// True when the particles are the right half of an owner that is symmetric about x = 0.
    pub mirrored: bool,
}

/// What accelerations lack of those that the forces cause, and these (THEORY C5) [m/s²].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lack {
    /// r(x), an entry an unknown.
    pub lack: Vec<f64>,
    /// The share of the fluid's forces in r(x) + x, an entry an unknown.
    pub caused: Vec<f64>,
}

/// An owner of walls that a force accelerates, as it will be at the end of a step. Its unknowns are accelerations x, all
/// scaled to [m/s²]; in the beginning those that its particles' kinematics were written with.
pub trait Yields: Send + Sync {
    /// C2: take as unknowns those that fit the forces which they cause; write what that adds to the accelerations that its
    /// particles' kinematics were written with [m/s²].
    fn answer(&mut self, encounter: &Encounter<'_>, change: &mut [[f64; 2]]);

    /// The unknowns [m/s²].
    fn unknowns(&self) -> Vec<f64>;

    /// C5: what the unknowns lack under forces at the step's end.
    fn lack(&self, forces: &WallForces<'_>) -> Lack;

    /// The same under the mean forces of the step, which act where its particles began: what a projection's body obeys (PB3).
    fn lack_in_mean(&self, forces: &WallForces<'_>) -> Lack {
        self.lack(forces)
    }

    /// PB6: velocities of its particles at the step's start [m/s], where their kinematics do not tell them; left as they are if
    /// they do.
    fn velocities_at_start(&self, _velocities: &mut [[f64; 2]]) {}

    /// Take other unknowns; add to the accelerations of its particles, as their kinematics were first written, what is new.
    /// Positions and velocities stay.
    fn accelerate(&mut self, unknowns: &[f64], walls: WallsMut<'_>);
}

/// An owner with its particles.
pub struct Yielding {
    /// Its particles.
    pub range: Range<usize>,
    /// True when they are the right half of an owner that is symmetric about x = 0.
    pub mirrored: bool,
    /// The owner.
    pub owner: Box<dyn Yields>,
}

impl fmt::Debug for Yielding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Yielding { range, mirrored, owner } = self;
        write!(f, "Yielding {{ {range:?}, mirrored: {mirrored}, unknowns: {:?} }}", owner.unknowns())
    }
}
