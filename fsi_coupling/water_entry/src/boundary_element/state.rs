//! The state of the flow: the wedge, its surfaces and its speed.

use faer::c64;

use super::elements::Sizes;
use super::face::Face;
use super::lower_side::LowerSide;
use super::surface::FreeSurface;

/// What is kept of the body's motion at an earlier instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Past {
    /// How long ago it was [s].
    pub ago: f64,
    /// Downward speed of the bottom, and of its keel [m/s].
    pub speeds: [f64; 2],
    /// Downward acceleration [m/s²].
    pub acceleration: f64,
}

/// The water about a symmetric wedge that moves downwards.
#[derive(Clone, Debug)]
pub struct EntryFlow {
    pub(super) face: Face,
    pub(super) surface: FreeSurface,
    /// The surface that left a wet chine.
    pub(super) underside: Option<FreeSurface>,
    /// Draught of the bottom [m].
    pub(super) draught: f64,
    /// Downward speed [m/s].
    pub(super) speed: f64,
    /// Constant speed outwards [m/s]: the axes move with it.
    pub(super) drift: f64,
    /// Gravity in the water [m/s²].
    pub(super) gravity: f64,
    pub(super) sizes: Sizes,
    /// What the next step needs of earlier ones, the last first.
    pub(super) past: Vec<Past>,
}

impl EntryFlow {
    /// Draught of the keel below still water [m].
    pub fn draught(&self) -> f64 {
        self.draught
    }

    /// Downward speed [m/s].
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Downward speed of the keel [m/s].
    pub(super) fn keel_speed(&self) -> f64 {
        self.speed * self.face.keel_speed(self.half_width())
    }

    /// Velocity of the keel [m/s].
    pub(super) fn keel_velocity(&self) -> c64 {
        c64::new(self.drift, -self.keel_speed())
    }

    /// Velocity of the bottom at a distance from the keel [m/s].
    pub(super) fn body_velocity(&self, along: f64) -> c64 {
        self.keel_velocity() + self.face.velocity(along)
    }

    /// Half breadth between the ends of the jets [m].
    pub fn half_width(&self) -> f64 {
        self.lower_side().nearest(self.surface.end()).foot.re
    }

    /// True once the flow has left the chines.
    pub fn chines_wet(&self) -> bool {
        self.underside.is_some()
    }

    /// The right half of the free surface from far away to the jet's cut, and from there to a wet chine, [x, y] [m], shape (n, 2).
    pub fn surface(&self) -> Vec<[f64; 2]> {
        let below = self.underside.iter().flat_map(|underside| &underside.z);
        self.surface.z.iter().chain(below).map(|z| [z.re, z.im]).collect()
    }

    pub(super) fn lower_side(&self) -> LowerSide<'_> {
        LowerSide {
            face: &self.face,
            underside: self.underside.as_ref().map(|surface| &surface.z[..]),
            sizes: self.sizes,
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        self.speed.is_finite() && self.surface.is_finite() && self.underside.iter().all(FreeSurface::is_finite)
    }
}
