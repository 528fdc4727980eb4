//! Rigid kinematics of boundary particles.

use sph_core::{Screen, WallPoint, WallsMut};

use crate::bodies::body::Surface;
use crate::geometry::outline::Outline;
use crate::geometry::rows::Arrangement;
use crate::geometry::thin_plate::{self, Plate};

/// State of a rigid motion about a pole.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rigid {
    /// Pole [m].
    pub pole: [f64; 2],
    /// Angle [rad].
    pub angle: f64,
    /// Velocity of the pole [m/s].
    pub velocity: [f64; 2],
    /// Angular velocity [rad/s].
    pub spin: f64,
    /// Acceleration of the pole [m/s²].
    pub acceleration: [f64; 2],
    /// Angular acceleration [rad/s²].
    pub spin_rate: f64,
}

impl Rigid {
    /// The motion `dt` [s] later at constant acceleration.
    pub fn ahead(&self, dt: f64) -> Rigid {
        let move_by = |x: f64, v: f64, a: f64| x + dt * (v + 0.5 * dt * a);
        Rigid {
            pole: [0, 1].map(|k| move_by(self.pole[k], self.velocity[k], self.acceleration[k])),
            angle: move_by(self.angle, self.spin, self.spin_rate),
            velocity: [0, 1].map(|k| self.velocity[k] + dt * self.acceleration[k]),
            spin: self.spin + dt * self.spin_rate,
            ..*self
        }
    }

    /// Position [m] of the body point `arm` [m, body frame, from the pole].
    pub fn point(&self, arm: [f64; 2]) -> [f64; 2] {
        let r = rotate(arm, self.angle);
        [self.pole[0] + r[0], self.pole[1] + r[1]]
    }

    /// Velocity [m/s] of the body point `arm`.
    pub fn point_velocity(&self, arm: [f64; 2]) -> [f64; 2] {
        let r = rotate(arm, self.angle);
        [self.velocity[0] - self.spin * r[1], self.velocity[1] + self.spin * r[0]]
    }

    /// Acceleration [m/s²] of the body point `arm`.
    pub fn point_acceleration(&self, arm: [f64; 2]) -> [f64; 2] {
        let (r, s2) = (rotate(arm, self.angle), self.spin * self.spin);
        [
            self.acceleration[0] - self.spin_rate * r[1] - s2 * r[0],
            self.acceleration[1] + self.spin_rate * r[0] - s2 * r[1],
        ]
    }
}

/// Turn a vector by an angle [rad].
pub fn rotate(v: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]]
}

/// A rigid shape: its outline, and its boundary particles relative to the pole.
#[derive(Clone)]
pub struct Shape {
    /// Outline in the body's frame [m].
    pub outline: Outline,
    /// The pole in the body's frame [m].
    pub pole: [f64; 2],
    /// Only the half x > 0 is sampled.
    pub half: bool,
    /// How the rows of boundary particles lie.
    pub arrangement: Arrangement,
    points: Vec<WallPoint>,
    /// The plate that it is sampled as, where it is a thin one (THEORY T2).
    plate: Option<Plate>,
}

impl Shape {
    /// A shape about a pole, not yet sampled.
    pub fn new(outline: Outline, pole: [f64; 2], half: bool) -> Shape {
        Shape { outline, pole, half, arrangement: Arrangement::default(), points: Vec::new(), plate: None }
    }

    /// Boundary particles where `motion` puts them; kept in the body's frame.
    pub fn sample(&mut self, motion: &Rigid, spacing: f64, layers: usize) -> Vec<WallPoint> {
        self.plate = self.outline.plate().filter(|plate| plate.is_thin(spacing, layers)).cloned();
        self.points = match &self.plate {
            None => crate::geometry::sampling::sample(&self.outline, spacing, layers, self.half, self.arrangement),
            Some(plate) => {
                let points = thin_plate::sample(&plate.line(), plate.thickness, spacing, layers);
                if self.half { thin_plate::right_half(points, spacing) } else { points }
            }
        };
        for p in &mut self.points {
            p.at = [p.at[0] - self.pole[0], p.at[1] - self.pole[1]];
        }
        let put = |p: &WallPoint| WallPoint { at: motion.point(p.at), normal: rotate(p.normal, motion.angle), ..*p };
        self.points.iter().map(put).collect()
    }

    /// H for rigid motion: positions `ahead`, mean velocity until then, acceleration.
    pub fn place(&self, now: &Rigid, ahead: f64, out: WallsMut<'_>) {
        let (then, mean) = (now.ahead(ahead), now.ahead(0.5 * ahead));
        for (k, p) in self.points.iter().enumerate() {
            [out.x[k], out.y[k]] = then.point(p.at);
            [out.u[k], out.v[k]] = mean.point_velocity(p.at);
            [out.ax[k], out.ay[k]] = then.point_acceleration(p.at);
            [out.nx[k], out.ny[k]] = rotate(p.normal, then.angle);
        }
    }

    /// The middle line of a thin plate (THEORY T1), which moves from `now` to `then`; nothing for other shapes.
    pub fn screens(&self, now: &Rigid, then: &Rigid) -> Vec<Screen> {
        let place = |motion: &Rigid, p: [f64; 2]| motion.point([p[0] - self.pole[0], p[1] - self.pole[1]]);
        let screen = |plate: &Plate| plate.screen(|p| place(then, p), |p| place(now, p), self.half);
        self.plate.iter().map(screen).collect()
    }

    /// Distance of a point in space from the surface [m], positive outside the body.
    pub fn clearance(&self, now: &Rigid, at: [f64; 2]) -> f64 {
        let r = rotate([at[0] - now.pole[0], at[1] - now.pole[1]], -now.angle);
        self.outline.signed_distance([r[0] + self.pole[0], r[1] + self.pole[1]])
    }

    /// The place of the surface nearest to a point in space, and how it moves.
    pub fn surface(&self, now: &Rigid, at: [f64; 2]) -> Surface {
        let r = rotate([at[0] - now.pole[0], at[1] - now.pole[1]], -now.angle);
        let (found, normal) = self.outline.nearest([r[0] + self.pole[0], r[1] + self.pole[1]]);
        let arm = [found[0] - self.pole[0], found[1] - self.pole[1]];
        Surface { at: now.point(arm), normal: rotate(normal, now.angle), velocity: now.point_velocity(arm) }
    }

    /// The body frame's origin relative to the pole.
    pub fn origin(&self) -> [f64; 2] {
        [-self.pole[0], -self.pole[1]]
    }
}
