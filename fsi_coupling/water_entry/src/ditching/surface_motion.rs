//! The motion of the water's surface at a place.

/// The water's surface at a place, and how the water there moves; forward and up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceMotion {
    /// Height over still water [m].
    pub elevation: f64,
    /// Velocity of a plane of water, and of the surface in it [m/s].
    pub velocity: [f64; 2],
    /// Their accelerations [m/s²].
    pub acceleration: [f64; 2],
}
