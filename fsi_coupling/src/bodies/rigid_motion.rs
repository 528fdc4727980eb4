//! Motion of a rigid body in the plane.

use crate::geometry::vector::rotate;

/// A rigid motion at an instant, of a reference point and about it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RigidMotion {
    /// The reference point [m].
    pub position: [f64; 2],
    /// Angle [rad].
    pub angle: f64,
    /// Velocity of the reference point [m/s].
    pub velocity: [f64; 2],
    /// Angular velocity [rad/s].
    pub angular_velocity: f64,
    /// Acceleration of the reference point [m/s²].
    pub acceleration: [f64; 2],
    /// Angular acceleration [rad/s²].
    pub angular_acceleration: f64,
}

impl RigidMotion {
    /// The motion `dt` [s] later at constant acceleration.
    pub fn ahead(&self, dt: f64) -> RigidMotion {
        let move_by = |x: f64, v: f64, a: f64| x + dt * (v + 0.5 * dt * a);
        RigidMotion {
            position: [0, 1].map(|k| move_by(self.position[k], self.velocity[k], self.acceleration[k])),
            angle: move_by(self.angle, self.angular_velocity, self.angular_acceleration),
            velocity: [0, 1].map(|k| self.velocity[k] + dt * self.acceleration[k]),
            angular_velocity: self.angular_velocity + dt * self.angular_acceleration,
            ..*self
        }
    }

    /// Position [m] of the body point `lever_arm` [m, body frame, from the reference point].
    pub fn point(&self, lever_arm: [f64; 2]) -> [f64; 2] {
        let r = rotate(lever_arm, self.angle);
        [self.position[0] + r[0], self.position[1] + r[1]]
    }

    /// Velocity [m/s] of the body point `lever_arm`.
    pub fn point_velocity(&self, lever_arm: [f64; 2]) -> [f64; 2] {
        let r = rotate(lever_arm, self.angle);
        [self.velocity[0] - self.angular_velocity * r[1], self.velocity[1] + self.angular_velocity * r[0]]
    }

    /// Acceleration [m/s²] of the body point `lever_arm`.
    pub fn point_acceleration(&self, lever_arm: [f64; 2]) -> [f64; 2] {
        let (r, s2) = (rotate(lever_arm, self.angle), self.angular_velocity * self.angular_velocity);
        [
            self.acceleration[0] - self.angular_acceleration * r[1] - s2 * r[0],
            self.acceleration[1] + self.angular_acceleration * r[0] - s2 * r[1],
        ]
    }

    /// A point in space [m] relative to the reference point, in the body's axes [m].
    pub fn local(&self, at: [f64; 2]) -> [f64; 2] {
        rotate([at[0] - self.position[0], at[1] - self.position[1]], -self.angle)
    }
}
