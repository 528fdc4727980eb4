//! What a numerical scheme is to the rest of the program.

use std::any::Any;

use crate::domain::Domain;
use crate::error::Breakdown;
use crate::particles::Seed;
use crate::state_bytes::StateError;
use crate::system::ParticleSystem;
use crate::walls::interface::WallInterface;
use crate::walls::{WallLayout, Walls};

/// The particles and the walls around them.
pub struct Flow<'a> {
    /// The particles with their neighbours.
    pub system: &'a mut ParticleSystem,
    /// All boundary particles.
    pub walls: &'a mut Walls,
    /// The owners of walls whose accelerations are found with the pressures (THEORY CO5); those of all others are given.
    pub interfaces: &'a mut [WallInterface],
}

/// A scheme that advances a [`ParticleSystem`]. It owns all state that the system does not hold.
///
/// A new scheme is a folder of its own: a settings struct that implements [`SchemeSettings`], and a type that implements this.
pub trait Scheme: Any + Send + Sync {
    /// Find the accelerations and the forces on the walls at the start. Before: the walls stand where they start.
    fn initialise(&mut self, flow: &mut Flow<'_>) -> Result<(), Breakdown>;

    /// Advance by `dt` [s]. Before: the walls' kinematics are those of the step's end. After: the walls carry the force at the
    /// step's end and the mean force of the step.
    fn step(&mut self, flow: &mut Flow<'_>, dt: f64) -> Result<(), Breakdown>;

    /// The largest stable step [s].
    fn stable_dt(&self, system: &ParticleSystem, walls: &Walls) -> Result<f64, Breakdown>;

    /// Refuse a state that the scheme cannot continue from.
    fn check(&self, system: &ParticleSystem) -> Result<(), Breakdown>;

    /// A copy of the scheme's state, to return to.
    fn checkpoint(&self) -> Box<dyn Scheme>;

    /// The state that a step changes and does not recompute, as bytes.
    fn to_bytes(&self) -> Vec<u8>;

    /// Take that state. Before: the scheme is made from the same settings and initialised in the same system.
    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError>;

    /// Particle `id` has changed places with its image in the plane of symmetry.
    fn reflected(&mut self, _id: u32) {}

    /// True where the tank carries a part of the water that differs from step to step (THEORY WC29).
    fn external_force_varies(&self) -> bool {
        false
    }

    /// True where pairs are held from step to step: particles that crossed a plane of symmetry are left to the scheme.
    fn holds_pairs(&self) -> bool {
        false
    }

    /// Energy of particle `k` beside its kinetic and potential energy [J/kg]; 0 where the fluid is incompressible.
    fn internal_energy(&self, _system: &ParticleSystem, _k: usize) -> f64 {
        0.0
    }

    /// True where the force on a wall is constant over a step, so that the step's mean force is all that a body feels.
    fn force_is_constant_in_step(&self) -> bool {
        false
    }

    /// Range of 2 Σ V W [-] on a flat face beside water, for schemes that keep the kernel sums of a lattice (GE2).
    fn face_kernel_sum(&self) -> Option<[f64; 2]> {
        None
    }

    /// How near the free surface each particle is, 1 at it and 0 far from it [-]; empty where the scheme does not find it.
    fn surface_indicator(&self) -> &[f64] {
        &[]
    }

    /// Memory that the scheme's arrays occupy [bytes].
    fn bytes(&self) -> usize {
        0
    }
}

/// Settings from which a scheme is made.
pub trait SchemeSettings {
    /// The scheme, for a domain and the seeds of its particles.
    fn scheme(&self, domain: &Domain) -> Box<dyn Scheme>;

    /// Density [kg/m³] and specific internal energy [J/kg] of a seed; `None` for a fluid without an energy equation.
    fn state(&self, domain: &Domain, seed: &Seed) -> (f64, Option<f64>);

    /// Rows of boundary particles that the scheme's walls need.
    fn wall_layout(&self, domain: &Domain) -> WallLayout {
        WallLayout::filling_support(domain.fluid.smoothing_ratio)
    }

    /// True where particles keep the volumes of their seeds, and pressures those of the seeds until the first step.
    fn keeps_volumes(&self) -> bool {
        false
    }
}
