//! The contract of a body: transfer and dynamics ([`WettedBody`]), contact with single particles ([`Contact`]), links with
//! other bodies ([`Linked`]) and output ([`Inspect`]).
//!
//! A coupled step of length `dt` calls, for each body: `kinematics(dt)`, `interface(dt)`; then the fluid steps; then `load`,
//! `advance(dt)`, those of [`Linked`] where bodies are linked, and those of [`Contact`] for single particles.

use sph_core::walls::Resultant;
use sph_core::{InterfaceDynamics, PlateMidline, StateError, WallForces, WallPoint, WallsMut};
use structure_fe::Break;

use crate::bodies::error::BodyError;
use crate::bodies::modes_state::ModesState;
use crate::bodies::panel_state::PanelState;
use crate::bodies::sprung::SprungState;
use crate::bodies::state::{ContactImpulse, Energy, Momentum, Motion, Solid, SurfacePoint};
use crate::geometry::outline::Outline;
use crate::geometry::rows::WallRows;

/// Transfer between a body and the fluid, and the body's own dynamics.
///
/// H is the transfer operator from the body's degrees of freedom to its boundary particles. `kinematics` applies H, `load` applies
/// Hᵀ, so that Σ f·(H q̇) = (Hᵀ f)·q̇: work and momentum are conserved.
pub trait WettedBody {
    /// Boundary particles of the body where it is now. After: `kinematics` writes as many particles in this order. A later call replaces
    /// the particles of an earlier one.
    fn sample(&mut self, rows: &WallRows) -> Result<Vec<WallPoint>, BodyError>;

    /// H: write position and normal of the boundary particles at `ahead` [s] from now, their mean velocity until then, and their
    /// acceleration then. Return the midlines of the body's thin plates now and then (THEORY WA8), always the same number in the same
    /// order. Before: `sample`. After `advance(ahead)` the body is there to second order in `ahead`.
    fn kinematics(&self, ahead: f64, out: WallsMut<'_>) -> Vec<PlateMidline>;

    /// The accelerations of the body at the end of a step of `ahead` [s] as a function of the fluid's forces (THEORY CO5); `None` for
    /// a body with prescribed motion. The solution is not handed back: after `load` and `advance` with the same
    /// forces the body has the accelerations that the interface found, to the accuracy of the step.
    fn interface(&mut self, _ahead: f64) -> Result<Option<Box<dyn InterfaceDynamics>>, BodyError> {
        Ok(None)
    }

    /// Hᵀ: take the fluid's forces on the boundary particles; they replace the previous load. The mean force over the step determines the
    /// momentum, the force at its end predicts the next acceleration.
    fn load(&mut self, force: WallForces<'_>);

    /// Advance by `dt` [s] under the load.
    fn advance(&mut self, dt: f64) -> Result<(), BodyError>;

    /// Largest step that is stable for the body [s]; infinity where it has no limit.
    fn stable_dt(&self) -> f64 {
        f64::INFINITY
    }

    /// Store the present state; it replaces the one stored before.
    fn checkpoint(&mut self);

    /// Return to the state last stored; without one nothing changes. A step repeated from there gives the same bits.
    fn restore(&mut self);

    /// The state that a step changes, as bytes.
    fn to_bytes(&self) -> Vec<u8>;

    /// Take such a state: a step gives the same bits as it gave there. Before: a body made of the same input, sampled.
    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError>;
}

/// Contact of single fluid particles with the body's surface (THEORY WA7).
pub trait Contact {
    /// Distance of a point from the surface [m], positive outside the body.
    fn signed_distance(&self, at: [f64; 2]) -> f64;

    /// The point of the surface nearest to a point in space.
    fn surface(&self, at: [f64; 2]) -> SurfacePoint;

    /// Velocity in the direction of a unit normal per unit impulse in the same direction at a point of the surface, within a step of `dt`
    /// [s] [m/kg]; 0 for a body that is much heavier than a particle.
    fn inverse_effective_mass(&mut self, _at: [f64; 2], _normal: [f64; 2], _dt: f64) -> f64 {
        0.0
    }

    /// Distance of a solid's point [m], positive outside, and the point of the surface that it meets (THEORY CO37). As a particle's, where
    /// a body does not say otherwise.
    fn met_by_solid(&self, at: [f64; 2]) -> (f64, SurfacePoint) {
        (self.signed_distance(at), self.surface(at))
    }

    /// Corners on which a solid may lie [m], of a body without an outline.
    fn rims(&self) -> Vec<[f64; 2]> {
        Vec::new()
    }

    /// Apply an impulse at once. After: momentum, work and surface velocities include it.
    fn apply_impulse(&mut self, contact: &ContactImpulse);
}

/// A body that other solids may touch and joints may hold (THEORY CO36).
pub trait Linked {
    /// The body as links meet it; `None` for one that they cannot hold: it bends, or a host moves it.
    fn solid(&self) -> Option<Solid> {
        None
    }

    /// Apply an impulse [N s/m, N s] of links about the reference point of [`Linked::solid`], at once. It is not work of the fluid.
    fn apply_link_impulse(&mut self, _impulse: Resultant) {}

    /// Reactions of links [N/m, N] about the reference point that act now: in accelerations from now on, and in the first half of the
    /// next step. They replace the previous ones.
    fn set_reaction(&mut self, _reaction: Resultant) {}
}

/// What observers may read of a body.
pub trait Inspect {
    /// Name in output columns.
    fn name(&self) -> &str;

    /// Rigid motion of the body's frame; `None` for a tank.
    fn motion(&self) -> Option<Motion> {
        None
    }

    /// Outline in the body's frame; `None` for a tank.
    fn outline(&self) -> Option<&Outline> {
        None
    }

    /// State of the panels of a flexible body.
    fn panels(&self) -> Vec<PanelState> {
        Vec::new()
    }

    /// The first end of a panel that broke off, with the panel's name.
    fn first_rupture(&self) -> Option<(&str, Break)> {
        None
    }

    /// Modes of a body that bends in them.
    fn modes(&self) -> Option<ModesState> {
        None
    }

    /// Masses on springs that stand on it.
    fn sprung(&self) -> Vec<SprungState> {
        Vec::new()
    }

    /// A point of the undeformed surface [m, body's frame] where it is now, and its acceleration [m/s²]; `None` for a rigid body.
    fn material_point(&self, _at: [f64; 2]) -> Option<(SurfacePoint, [f64; 2])> {
        None
    }

    /// Energies, and the work of the load.
    fn energy(&self) -> Energy;

    /// Momentum and external impulses.
    fn momentum(&self) -> Momentum;

    /// True for a body with prescribed motion: the load's work on it leaves the system.
    fn is_prescribed(&self) -> bool {
        false
    }

    /// A point in space [m] where the deformed outline crosses itself.
    fn self_intersection(&self) -> Option<[f64; 2]> {
        Some(self.motion()?.point(self.outline()?.crossing()?))
    }
}

/// A body in the fluid.
pub trait Body: WettedBody + Contact + Linked + Inspect + Send + Sync {}

impl<T: WettedBody + Contact + Linked + Inspect + Send + Sync> Body for T {}
