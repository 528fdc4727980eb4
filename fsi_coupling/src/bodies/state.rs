//! What a body reports: motion, energies, momentum, a point of its surface.

use sph_core::walls::Resultant;

use crate::bodies::rigid_motion::RigidMotion;
use crate::geometry::vector::rotate;

/// Energies of a body per metre of span [J/m].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// ½ m v² + ½ I ω².
    pub kinetic: f64,
    /// −m g·r.
    pub potential: f64,
    /// Strain energy.
    pub elastic: f64,
    /// Work of the fluid's load on the body since the start.
    pub work: f64,
    /// Work of supports with prescribed motion on the body since the start.
    pub support: f64,
    /// Work of links (joints, other solids) on the body since the start.
    pub links: f64,
    /// Energy dissipated by damping, plasticity and the time integration since the start.
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
    pub angular_velocity: f64,
    /// Acceleration of the origin [m/s²].
    pub acceleration: [f64; 2],
    /// Force of the fluid per metre of span [N/m].
    pub force: [f64; 2],
    /// Moment of the fluid about the origin, per metre of span [N].
    pub moment: f64,
}

impl Motion {
    /// Motion of a frame about its origin, and the load about the same point.
    pub fn new(frame: &RigidMotion, Resultant { force, moment }: Resultant) -> Motion {
        let RigidMotion { position, angle, velocity, angular_velocity, acceleration, .. } = *frame;
        Motion { position, angle, velocity, angular_velocity, acceleration, force, moment }
    }

    /// Position [m] of a point of the body's frame [m].
    pub fn point(&self, in_frame: [f64; 2]) -> [f64; 2] {
        let r = rotate(in_frame, self.angle);
        [self.position[0] + r[0], self.position[1] + r[1]]
    }
}

/// A body's momentum, and the impulses on it that are not the fluid's (THEORY CO27).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Momentum {
    /// Linear momentum [N s/m]; zero for a body whose motion is prescribed.
    pub momentum: [f64; 2],
    /// Impulses of gravity, guides, supports and contact since the start [N s/m].
    pub external: [f64; 2],
}

/// A point of a body's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Position [m].
    pub at: [f64; 2],
    /// Unit normal out of the body [-].
    pub normal: [f64; 2],
    /// Velocity of the body at this point [m/s].
    pub velocity: [f64; 2],
}

/// An impulse of the fluid on a body at one point, in addition to the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactImpulse {
    /// Point of the surface [m].
    pub at: [f64; 2],
    /// Impulse on the body [N s/m].
    pub impulse: [f64; 2],
    /// True where the fluid's half x > 0 alone is simulated: the mirror image acts on the body too.
    pub mirrored: bool,
}

impl ContactImpulse {
    /// Point of action and resultant of the impulse and of its mirror image.
    pub fn resultant(&self) -> ([f64; 2], [f64; 2]) {
        match self.mirrored {
            true => ([0.0, self.at[1]], [0.0, 2.0 * self.impulse[1]]),
            false => (self.at, self.impulse),
        }
    }
}

/// A body as links and other solids meet it: rigid, about a reference point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Solid {
    /// Motion of the reference point (a free body's centre of mass), with accelerations that leave out the reactions of links.
    pub motion: RigidMotion,
    /// Inverse of mass, mass and moment of inertia [m/kg, m/kg, 1/(kg m)]; 0 where it is held.
    pub inverse_mass: [f64; 3],
    /// 2 where only the half x > 0 of a symmetric body is simulated: an impulse has its mirror image; else 1.
    pub halves: f64,
}

impl Solid {
    /// From the reference point to a point in space [m].
    pub fn arm(&self, at: [f64; 2]) -> [f64; 2] {
        [at[0] - self.motion.position[0], at[1] - self.motion.position[1]]
    }

    /// Velocity [m/s] of the body at a point in space.
    pub fn velocity_at(&self, at: [f64; 2]) -> [f64; 2] {
        let (r, turn) = (self.arm(at), self.motion.angular_velocity);
        [self.motion.velocity[0] - turn * r[1], self.motion.velocity[1] + turn * r[0]]
    }

    /// Centripetal acceleration [m/s²] of the body at a point in space.
    pub fn centripetal(&self, at: [f64; 2]) -> [f64; 2] {
        self.arm(at).map(|r| -r * self.motion.angular_velocity.powi(2))
    }

    /// Add the accelerations that a force [N/m] and a moment [N] about the reference point cause.
    pub fn accelerate(&mut self, force: Resultant) {
        for k in 0..2 {
            self.motion.acceleration[k] += self.inverse_mass[k] * force.force[k];
        }
        self.motion.angular_acceleration += self.inverse_mass[2] * force.moment;
    }

    /// Velocity per unit impulse along x, y and angle [m/kg, m/kg, 1/(kg m)]; of both halves' impulses.
    pub fn response(&self) -> [f64; 3] {
        self.inverse_mass.map(|inverse| self.halves * inverse)
    }

    /// An impulse or force on it with its mirror image, about the reference point.
    pub fn whole(&self, own: Resultant) -> Resultant {
        match self.halves > 1.0 {
            true => Resultant { force: [0.0, self.halves * own.force[1]], moment: 0.0 },
            false => own,
        }
    }
}
