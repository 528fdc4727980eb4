//! What a structure that bends does for its body.

use serde::Serialize;
use serde::de::DeserializeOwned;
use sph_core::InterfaceDynamics;
use sph_core::state_bytes::StateError;
use structure_fe::{Break, Error};

use crate::bodies::bending::bending_surface::{BendingSurface, NodalMotion};
use crate::bodies::bending::state::BendingState;
use crate::bodies::modes_state::ModesState;
use crate::bodies::panel_state::PanelState;
use crate::bodies::rigid_motion::RigidMotion;

/// Accelerations as a function of the fluid's forces.
pub type Interface = Box<dyn InterfaceDynamics>;

/// State of the body of a model.
pub type StateOf<M> = BendingState<<M as BendingModel>::Motion, <M as BendingModel>::Extremes>;

/// The equations of a structure whose nodes carry a surface; one node is the rigid frame's.
pub trait BendingModel {
    /// Its motion.
    type Motion: Clone + Serialize + DeserializeOwned;
    /// What was largest so far.
    type Extremes: Clone + Serialize + DeserializeOwned;
    /// What errors call its body.
    const BODY: &'static str;

    /// Motion of the nodes.
    fn nodes(motion: &Self::Motion) -> NodalMotion<'_>;

    /// Time of a motion [s].
    fn time(motion: &mut Self::Motion) -> &mut f64;

    /// An error unless a stored motion and its extremes have as many parts as those of `like`.
    fn check(state: &StateOf<Self>, like: &StateOf<Self>) -> Result<(), StateError>;

    /// Displacements of the nodes `ahead` [s] from now, at constant acceleration.
    fn ahead(&self, motion: &Self::Motion, ahead: f64) -> Vec<[f64; 3]>;

    /// CO18: the accelerations at the end of a step of `dt` [s] under the fluid's forces.
    fn interface(&mut self, surface: &BendingSurface, motion: &Self::Motion, dt: f64) -> Result<Interface, Error>;

    /// Prescribe the motion of the frame at the end of the next step.
    fn prescribe(&mut self, surface: &BendingSurface, frame: &RigidMotion) -> Result<(), Error>;

    /// Advance by `dt` [s] under the loads and impulses of a state, and add to its sums.
    fn step(&mut self, state: &mut StateOf<Self>, dt: f64) -> Result<(), Error>;

    /// Largest stable step [s].
    fn stable_dt(&self) -> f64 {
        f64::INFINITY
    }

    /// Follow a motion that was stored.
    fn resume(&mut self, _: &Self::Motion) -> Result<(), Error> {
        Ok(())
    }

    /// After a step or a stored motion: the structure may have broken, which changes the surface.
    fn update(&mut self, _: &mut BendingSurface) {}

    /// Velocities of the nodes under impulses on them within a step of `dt` [s]; zero where the equations have no solution.
    fn velocities_under(&mut self, motion: &Self::Motion, impulses: &[[f64; 3]], dt: f64) -> Vec<[f64; 3]>;

    /// Σ impulse · velocity of the nodes under impulses on them within a step of `dt` [s].
    fn response(&mut self, motion: &Self::Motion, impulses: &[[f64; 3]], dt: f64) -> f64;

    /// Kinetic, potential and elastic energy [J/m].
    fn energies(&self, motion: &Self::Motion) -> [f64; 3];

    /// Linear momentum [N s/m].
    fn momentum(&self, motion: &Self::Motion) -> [f64; 2];

    /// State of its panels.
    fn panels(&self, _: &BendingSurface, _: &StateOf<Self>, _frame: &RigidMotion) -> Vec<PanelState> {
        Vec::new()
    }

    /// The first end of a panel that broke off, with the panel's name.
    fn first_rupture(&self, _: &Self::Motion) -> Option<(&str, Break)> {
        None
    }

    /// Its modes.
    fn modes(&self, _: &StateOf<Self>) -> Option<ModesState> {
        None
    }
}
