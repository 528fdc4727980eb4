//! A body with prescribed motion: a function of time.

use serde::{Deserialize, Serialize};

use sph_core::state_bytes::{StateError, decode, encode};
use sph_core::walls::Resultant;
use sph_core::{PlateMidline, WallForces, WallPoint, WallsMut};

use crate::bodies::body::{Contact, Inspect, Linked, WettedBody};
use crate::bodies::error::BodyError;
use crate::bodies::rigid_motion::RigidMotion;
use crate::bodies::rigid_surface::RigidSurface;
use crate::bodies::state::{ContactImpulse, Energy, Momentum, Motion, Solid, SurfacePoint};
use crate::geometry::hermite::{hermite, hermite_rate, hermite_second_rate};
use crate::geometry::outline::Outline;
use crate::geometry::rows::WallRows;
use crate::geometry::vector::dot;

/// A motion law: time [s] → motion of the body's origin.
pub type Law = Box<dyn Fn(f64) -> RigidMotion + Send + Sync>;

/// A rigid body that follows a motion law.
pub struct PrescribedBody {
    name: String,
    surface: RigidSurface,
    law: Law,
    state: State,
    checkpoint: Option<State>,
}

/// What a step changes.
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
struct State {
    time: f64,
    now: Resultant,
    mean: Resultant,
    external: [f64; 2],
    work: f64,
    /// Of links, in the first half of the next step.
    reaction: Resultant,
    /// Work of links on the body [J/m].
    work_of_links: f64,
}

impl PrescribedBody {
    /// A body that follows `law`; with `half`, only its half x > 0 is simulated.
    pub fn new(name: &str, outline: Outline, half: bool, law: Law) -> PrescribedBody {
        let surface = RigidSurface::new(outline, [0.0, 0.0], half);
        PrescribedBody { name: name.into(), surface, law, state: State::default(), checkpoint: None }
    }

    /// The same, with a clock that starts at `time` [s]: the law begins then.
    pub fn starting_at(mut self, time: f64) -> PrescribedBody {
        let law = self.law;
        self.law = Box::new(move |t| law(t - time));
        self.state.time = time;
        self
    }

    /// The law of constant velocity [m/s] and angular velocity [rad/s] from a start position [m] and angle [rad].
    pub fn steady(start: [f64; 2], angle: f64, velocity: [f64; 2], angular_velocity: f64) -> Law {
        let first = RigidMotion { position: start, angle, velocity, angular_velocity, ..RigidMotion::default() };
        Box::new(move |t| first.ahead(t))
    }

    /// CO3: the law x₀ + A r(t) sin(2π t/T), with r = s²(3 − 2s), s = min(t/T, 1): at rest at t = 0, harmonic after a
    /// period; x₀, A [m], T [s], at a constant angle [rad].
    pub fn oscillating(middle: [f64; 2], angle: f64, amplitude: [f64; 2], period: f64) -> Law {
        let omega = std::f64::consts::TAU / period;
        Box::new(move |t| {
            let s = (t / period).clamp(0.0, 1.0);
            let ease = [s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / period, (6.0 - 12.0 * s) / period.powi(2)];
            let curvature = if t < period { ease[2] } else { 0.0 };
            let (sin, cos) = (omega * t).sin_cos();
            let place = ease[0] * sin;
            let speed = ease[1] * sin + ease[0] * omega * cos;
            let rate = curvature * sin + 2.0 * ease[1] * omega * cos - ease[0] * omega * omega * sin;
            RigidMotion {
                position: [0, 1].map(|k| middle[k] + amplitude[k] * place),
                angle,
                velocity: amplitude.map(|a| a * speed),
                acceleration: amplitude.map(|a| a * rate),
                ..RigidMotion::default()
            }
        })
    }

    /// The law through tabulated motions (time [s], motion), in order of time: cubic between two rows, so that positions, angles and
    /// velocities are those of the table; before and after the table at constant velocity. `None` without rows.
    pub fn tabulated(rows: Vec<(f64, RigidMotion)>) -> Option<Law> {
        let (first, last) = (*rows.first()?, *rows.last()?);
        Some(Box::new(move |t| {
            let k = rows.partition_point(|(time, _)| *time <= t);
            if k == 0 || k == rows.len() {
                let (time, end) = if k == 0 { first } else { last };
                return RigidMotion { acceleration: [0.0; 2], angular_acceleration: 0.0, ..end }.ahead(t - time);
            }
            let ((start, a), (end, b)) = (rows[k - 1], rows[k]);
            let values = |m: &RigidMotion| {
                [[m.position[0], m.position[1], m.angle], [m.velocity[0], m.velocity[1], m.angular_velocity]]
            };
            let ([x0, v0], [x1, v1]) = (values(&a), values(&b));
            let cubic = |weights: [f64; 4]| {
                [0, 1, 2].map(|i| weights[0] * x0[i] + weights[1] * v0[i] + weights[2] * x1[i] + weights[3] * v1[i])
            };
            let [s, length] = [(t - start) / (end - start), end - start];
            let ([x, y, angle], [u, v, angular_velocity]) = (cubic(hermite(s, length)), cubic(hermite_rate(s, length)));
            let [ax, ay, angular_acceleration] = cubic(hermite_second_rate(s, length));
            RigidMotion {
                position: [x, y],
                angle,
                velocity: [u, v],
                angular_velocity,
                acceleration: [ax, ay],
                angular_acceleration,
            }
        }))
    }

    fn motion_now(&self) -> RigidMotion {
        (self.law)(self.state.time)
    }
}

impl WettedBody for PrescribedBody {
    fn sample(&mut self, rows: &WallRows) -> Result<Vec<WallPoint>, BodyError> {
        Ok(self.surface.sample(&self.motion_now(), rows))
    }

    /// The law is replaced by a motion of constant acceleration that ends exactly where the law does.
    fn kinematics(&self, ahead: f64, out: WallsMut<'_>) -> Vec<PlateMidline> {
        let (now, then) = (self.motion_now(), (self.law)(self.state.time + ahead));
        let mut fitted = now;
        if ahead > 0.0 {
            let mean = |k: usize| (then.position[k] - now.position[k]) / ahead;
            fitted = RigidMotion {
                velocity: [0, 1].map(|k| mean(k) - 0.5 * ahead * then.acceleration[k]),
                angular_velocity: (then.angle - now.angle) / ahead - 0.5 * ahead * then.angular_acceleration,
                acceleration: then.acceleration,
                angular_acceleration: then.angular_acceleration,
                ..now
            };
        }
        self.surface.kinematics(&fitted, ahead.max(0.0), out);
        self.surface.midlines(&now, &then)
    }

    fn load(&mut self, force: WallForces<'_>) {
        let about = self.motion_now().position;
        (self.state.now, self.state.mean) = (force.resultant(about), force.mean_resultant(about));
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        let (now, then) = (self.motion_now(), (self.law)(self.state.time + dt));
        let moved = [0, 1].map(|k| then.position[k] - now.position[k]);
        let (mean, state) = (self.state.mean, &mut self.state);
        for k in 0..2 {
            state.work += mean.force[k] * moved[k];
            state.work_of_links += 0.5 * state.reaction.force[k] * moved[k];
            state.external[k] -= dt * (mean.force[k] + 0.5 * state.reaction.force[k]);
        }
        state.work_of_links += 0.5 * state.reaction.moment * (then.angle - now.angle);
        // the mean moment, about the reference point in the middle of the step
        state.work += mean.about(moved.map(|d| 0.5 * d)).moment * (then.angle - now.angle);
        state.now = state.now.about(moved);
        state.time += dt;
        Ok(())
    }

    fn checkpoint(&mut self) {
        self.checkpoint = Some(self.state);
    }

    fn restore(&mut self) {
        self.state = self.checkpoint.unwrap_or(self.state);
    }

    fn to_bytes(&self) -> Vec<u8> {
        encode(&self.state)
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        self.state = decode("a body with prescribed motion", bytes)?;
        Ok(())
    }
}

impl Contact for PrescribedBody {
    fn signed_distance(&self, at: [f64; 2]) -> f64 {
        self.surface.signed_distance(&self.motion_now(), at)
    }

    fn surface(&self, at: [f64; 2]) -> SurfacePoint {
        self.surface.nearest(&self.motion_now(), at)
    }

    fn apply_impulse(&mut self, contact: &ContactImpulse) {
        let (at, impulse) = contact.resultant();
        let now = self.motion_now();
        let v = now.point_velocity(now.local(at));
        self.state.work += impulse[0] * v[0] + impulse[1] * v[1];
        self.state.external = [0, 1].map(|k| self.state.external[k] - impulse[k]);
    }
}

impl Linked for PrescribedBody {
    fn solid(&self) -> Option<Solid> {
        let halves = if self.surface.is_half() { 2.0 } else { 1.0 };
        Some(Solid { motion: self.motion_now(), inverse_mass: [0.0; 3], halves })
    }

    fn apply_link_impulse(&mut self, Resultant { force, moment }: Resultant) {
        let now = self.motion_now();
        self.state.work_of_links += dot(force, now.velocity) + moment * now.angular_velocity;
        self.state.external = [0, 1].map(|k| self.state.external[k] - force[k]);
    }

    fn set_reaction(&mut self, reaction: Resultant) {
        self.state.reaction = reaction;
    }
}

impl Inspect for PrescribedBody {
    fn name(&self) -> &str {
        &self.name
    }

    fn motion(&self) -> Option<Motion> {
        Some(Motion::new(&self.motion_now(), self.state.now))
    }

    fn outline(&self) -> Option<&Outline> {
        Some(&self.surface.outline)
    }

    fn energy(&self) -> Energy {
        Energy { work: self.state.work, links: self.state.work_of_links, ..Energy::default() }
    }

    fn momentum(&self) -> Momentum {
        Momentum { momentum: [0.0; 2], external: self.state.external }
    }

    fn is_prescribed(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_oscillation_starts_at_rest_and_its_derivatives_are_its_own() {
        let law = PrescribedBody::oscillating([0.3, -0.1], 0.0, [0.1, 0.02], 1.25);
        assert_eq!((law(0.0).position, law(0.0).velocity), ([0.3, -0.1], [0.0; 2]));
        for t in [0.2, 0.9, 1.2, 1.7, 3.0] {
            let (before, now, after) = (law(t - 1e-5), law(t), law(t + 1e-5));
            for k in 0..2 {
                let speed = (after.position[k] - before.position[k]) / 2e-5;
                let rate = (after.velocity[k] - before.velocity[k]) / 2e-5;
                assert!((speed - now.velocity[k]).abs() < 1e-7, "t = {t}: {speed} {:?}", now.velocity);
                assert!((rate - now.acceleration[k]).abs() < 1e-6, "t = {t}: {rate} {:?}", now.acceleration);
            }
        }
        assert!((law(1.25 * 2.25).position[0] - 0.4).abs() < 1e-12, "the amplitude after the first period");
    }

    /// Motions that are cubic in time come back exactly between the rows, with their derivatives.
    #[test]
    fn a_table_of_a_cubic_motion_is_exact() {
        let exact = |t: f64| RigidMotion {
            position: [0.2 - t * t, 0.5 * t + t * t * t],
            angle: 0.3 * t * t,
            velocity: [-2.0 * t, 0.5 + 3.0 * t * t],
            angular_velocity: 0.6 * t,
            acceleration: [-2.0, 6.0 * t],
            angular_acceleration: 0.6,
        };
        let law = PrescribedBody::tabulated([0.0, 0.3, 1.0].map(|t| (t, exact(t))).to_vec()).expect("three rows");
        for t in [0.0, 0.1, 0.3, 0.8] {
            let (now, then) = (law(t), exact(t));
            for k in 0..2 {
                assert!((now.position[k] - then.position[k]).abs() < 1e-14, "t = {t}: {now:?}");
                assert!((now.velocity[k] - then.velocity[k]).abs() < 1e-13, "t = {t}: {now:?}");
                assert!((now.acceleration[k] - then.acceleration[k]).abs() < 1e-12, "t = {t}: {now:?}");
            }
            assert!((now.angular_acceleration - 0.6).abs() < 1e-12);
        }
        assert!(
            (law(2.0).position[0] - (exact(1.0).position[0] - 2.0)).abs() < 1e-14,
            "constant velocity after the table"
        );
    }
}
