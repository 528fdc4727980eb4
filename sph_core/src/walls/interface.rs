//! WallInterface dynamics: owners of walls whose acceleration follows from the force of the fluid (THEORY CO4–CO9).

use std::fmt;
use std::ops::Range;

use crate::walls::{WallForces, WallsMut};

/// The force on a wall particle, and its change with the particle's acceleration: δF = push (arm·δa) (THEORY CO4).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ParticleLoad {
    /// Where it is [m].
    pub at: [f64; 2],
    /// Force of the fluid on it [N/m].
    pub force: [f64; 2],
    /// ρ₀ V_w G_w [kg/m²].
    pub push: [f64; 2],
    /// m_w [m].
    pub arm: [f64; 2],
}

/// The load of the fluid on an owner of walls.
#[derive(Clone, Copy, Debug)]
pub struct InterfaceLoad<'a> {
    /// Loads on its particles, in its order.
    pub particles: &'a [ParticleLoad],
    /// Time of the load, from the step's end [s]; not positive.
    pub offset: f64,
    /// True when the particles are the right half of an owner that is symmetric about x = 0.
    pub mirrored: bool,
}

/// WallInterface residual: implied minus trial acceleration (THEORY CO8) [m/s²].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InterfaceResidual {
    /// r(x), one entry per unknown.
    pub residual: Vec<f64>,
    /// The share of the fluid's forces in r(x) + x, one entry per unknown.
    pub driving: Vec<f64>,
}

/// An owner of walls that a force accelerates, as it will be at the end of a step. Its unknowns are accelerations x, all
/// scaled to [m/s²]; in the beginning those that its particles' kinematics were written with.
pub trait InterfaceDynamics: Send + Sync {
    /// CO5: take as unknowns those that fit the forces which they cause; write what that adds to the accelerations that its
    /// particles' kinematics were written with [m/s²].
    fn solve_acceleration(&mut self, load: &InterfaceLoad<'_>, change: &mut [[f64; 2]]);

    /// The unknowns [m/s²].
    fn unknowns(&self) -> Vec<f64>;

    /// CO8: residual of the unknowns under forces at the step's end.
    fn residual(&self, forces: &WallForces<'_>) -> InterfaceResidual;

    /// The same under the mean forces of the step, which act where its particles began: what a projection's body obeys (CO21).
    fn residual_in_mean(&self, forces: &WallForces<'_>) -> InterfaceResidual {
        self.residual(forces)
    }

    /// CO23: velocities of its particles at the step's start [m/s], where their kinematics do not tell them; left as they are if
    /// they do.
    fn velocities_at_start(&self, _velocities: &mut [[f64; 2]]) {}

    /// Take other unknowns; add to the accelerations of its particles, as their kinematics were first written, what is new.
    /// Positions and velocities stay.
    fn accelerate(&mut self, unknowns: &[f64], walls: WallsMut<'_>);
}

/// An owner with its particles.
pub struct WallInterface {
    /// Its particles.
    pub range: Range<usize>,
    /// True when they are the right half of an owner that is symmetric about x = 0.
    pub mirrored: bool,
    /// The owner.
    pub owner: Box<dyn InterfaceDynamics>,
}

impl fmt::Debug for WallInterface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let WallInterface { range, mirrored, owner } = self;
        write!(f, "WallInterface {{ {range:?}, mirrored: {mirrored}, unknowns: {:?} }}", owner.unknowns())
    }
}
