//! A free rigid body to be built.

use crate::bodies::sprung::SprungSpec;
use crate::geometry::outline::Outline;

/// A rigid body to be built; everything per metre of span.
#[derive(Clone)]
pub struct RigidSpec {
    /// Name, as in output columns.
    pub name: String,
    /// Outline in the body's frame [m].
    pub outline: Outline,
    /// Mass [kg/m].
    pub mass: f64,
    /// Moment of inertia about the centre of mass [kg m²/m].
    pub inertia: f64,
    /// Centre of mass in the body's frame [m].
    pub center_of_mass: [f64; 2],
    /// Which of x, y, angle are free; the others are held by a guide.
    pub free: [bool; 3],
    /// Origin of the body's frame at the start [m].
    pub position: [f64; 2],
    /// Angle at the start [rad].
    pub angle: f64,
    /// Velocity of the origin at the start [m/s].
    pub velocity: [f64; 2],
    /// Angular velocity at the start [rad/s].
    pub angular_velocity: f64,
    /// Gravity [m/s²].
    pub gravity: [f64; 2],
    /// Simulate the half x > 0 of a symmetric body.
    pub half: bool,
    /// Masses on springs that stand on it; only on a body that is free in y alone.
    pub sprung: Vec<SprungSpec>,
}
