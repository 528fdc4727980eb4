//! What a wetted body is: three verbs (place, load, advance) with contracts, and what observers may ask.

use sph_core::{Screen, WallForces, WallPoint, WallsMut, Yields};

use crate::bodies::flexible::panel_state::PanelState;
use crate::geometry::outline::Outline;
use crate::geometry::rows::Arrangement;

/// A body that cannot be built or cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BodyError {
    /// The shape is not a shape.
    #[error("{0}")]
    Outline(String),
    /// Mass or inertia that no body has.
    #[error("body `{name}`: {quantity} is {given}, expected a positive finite number")]
    Inertia {
        /// The body.
        name: String,
        /// What is wrong.
        quantity: &'static str,
        /// What was given, in SI units.
        given: f64,
    },
    /// The structure's equations cannot be set up or solved.
    #[error("body `{name}`: {reason}")]
    Structure {
        /// The body.
        name: String,
        /// What its finite elements say.
        reason: String,
    },
    /// The rigid-body engine met a number that is not finite.
    #[error("body `{name}`: its motion is no longer finite at t = {time:.6e} s")]
    NotFinite {
        /// The body.
        name: String,
        /// Time [s].
        time: f64,
    },
}

impl BodyError {
    /// What finite elements say of a body.
    pub(crate) fn structure(name: &str, error: &structure_fe::Error) -> BodyError {
        BodyError::Structure { name: name.into(), reason: error.to_string() }
    }
}

/// Energies of a body per metre of span [J/m].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// ½ m v² + ½ I ω².
    pub kinetic: f64,
    /// −m g·r.
    pub potential: f64,
    /// Strain energy.
    pub elastic: f64,
    /// Work that the fluid's load has done on the body since the start.
    pub work: f64,
    /// Work that supports whose motion is given have done on it since the start.
    pub support: f64,
    /// What damping, yielding and its time steps have taken from it since the start.
    pub dissipated: f64,
}

/// Rigid motion of the body's frame, and the fluid's load on it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Origin of the body's frame [m].
    pub position: [f64; 2],
    /// Angle of the body's frame [rad], counter-clockwise.
    pub angle: f64,
    /// Velocity of the origin [m/s].
    pub velocity: [f64; 2],
    /// Angular velocity [rad/s].
    pub spin: f64,
    /// Acceleration of the origin [m/s²].
    pub acceleration: [f64; 2],
    /// Force of the fluid per metre of span [N/m].
    pub force: [f64; 2],
    /// Moment of the fluid about the origin, per metre of span [N].
    pub moment: f64,
}

/// A body's momentum and the impulses it has had from anything but the fluid (THEORY E21).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Linear momentum [N s/m]; zero for a body whose motion is prescribed.
    pub momentum: [f64; 2],
    /// Impulses of gravity, guides, supports and contacts since the start [N s/m].
    pub external: [f64; 2],
}

/// A place on a body's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Where [m].
    pub at: [f64; 2],
    /// Unit normal out of the body [-].
    pub normal: [f64; 2],
    /// Velocity of the body there [m/s].
    pub velocity: [f64; 2],
}

/// A body in the fluid. One coupled step calls `place`, then the fluid steps, then `load`, then `advance`.
pub trait WettedBody: Send + Sync {
    /// Name, as in output columns.
    fn name(&self) -> &str;

    /// How the rows of boundary particles are to lie; before `sample`.
    fn arrange(&mut self, arrangement: Arrangement);

    /// Boundary particles at the spacing [m] in `layers` rows; once, before time starts.
    /// After: `place` writes exactly as many, in this order.
    fn sample(&mut self, spacing: f64, layers: usize) -> Result<Vec<WallPoint>, BodyError>;

    /// H: write where the boundary particles will be `ahead` [s] from now, their mean velocity until
    /// then, and their acceleration. After `advance(ahead)` the body is there, to second order.
    fn place(&self, ahead: f64, out: WallsMut<'_>);

    /// Middle lines of the body's thin walls (THEORY T1) `ahead` [s] from now and now, as many and in the same order every
    /// time; after `sample`, whose particles say which screen they belong to.
    fn screens(&self, _ahead: f64) -> Vec<Screen> {
        Vec::new()
    }

    /// How a force at the end of a step of `ahead` [s] accelerates the body (THEORY C2): as `place` writes its motion.
    /// `None` for a body whose motion is given. The body itself need not be told what is found: after `load` and `advance` it
    /// has the acceleration that the owner returned here finds under the same forces, as far as the step resolves it.
    fn yielding(&mut self, _ahead: f64) -> Result<Option<Box<dyn Yields>>, BodyError> {
        Ok(None)
    }

    /// Hᵀ: take the fluid's force; replaces the previous load. The mean force is what momentum obeys,
    /// the force now is what the next acceleration is predicted from.
    fn load(&mut self, force: WallForces<'_>);

    /// Move on by `dt` [s] under the load.
    fn advance(&mut self, dt: f64) -> Result<(), BodyError>;

    /// Largest step the body itself allows [s]; infinity where it sets no limit.
    fn stable_dt(&self) -> f64 {
        f64::INFINITY
    }

    /// Remember the present state.
    fn save(&mut self);

    /// Return to the state last saved.
    fn restore(&mut self);

    /// Energies, and the work of the load.
    fn energy(&self) -> Energy;

    /// Momentum and impulses, for the audit.
    fn ledger(&self) -> Ledger;

    /// What its panels do, of a body that bends.
    fn panels(&self) -> Vec<PanelState> {
        Vec::new()
    }

    /// Rigid motion for output; `None` for a body that only holds water (a tank).
    fn motion(&self) -> Option<Motion>;

    /// Shape in the body's frame, for pictures.
    fn outline(&self) -> Option<&Outline>;

    /// Where in space [m] the surface of a body that bends crosses itself, if it does.
    fn crossing(&self) -> Option<[f64; 2]> {
        None
    }

    /// Distance of a point from the body's surface [m], positive in the fluid.
    fn clearance(&self, at: [f64; 2]) -> f64;

    /// The place of the surface that is nearest to a point in space.
    fn surface(&self, at: [f64; 2]) -> Surface;

    /// Where a place of the undeformed surface [m, body's frame] is now, and its acceleration [m/s²]; `None` for a rigid body,
    /// whose motion says it.
    fn ride(&self, _at: [f64; 2]) -> Option<(Surface, [f64; 2])> {
        None
    }

    /// Velocity along a unit normal that a blow of unit impulse gives a place in space, within a step of `dt` [s] [m/kg]; 0 for a
    /// body that is taken as too heavy to feel a particle.
    fn mobility(&mut self, _at: [f64; 2], _normal: [f64; 2], _dt: f64) -> f64 {
        0.0
    }

    /// A blow: an impulse [N s/m] at a place in space, at once, besides the load.
    fn strike(&mut self, at: [f64; 2], impulse: [f64; 2]);

    /// A blow and its image in the plane of symmetry x = 0.
    fn strike_both(&mut self, at: [f64; 2], impulse: [f64; 2]) {
        self.strike([0.0, at[1]], [0.0, 2.0 * impulse[1]]);
    }

    /// True for a body whose motion is given: the load's work on it leaves the system.
    fn prescribed(&self) -> bool;
}
