//! A body whose motion is given as a function of time.

use sph_core::walls::Resultant;
use sph_core::{Screen, WallForces, WallPoint, WallsMut};

use crate::bodies::body::{BodyError, Energy, Ledger, Motion, Surface, WettedBody};
use crate::bodies::rigid_motion::{Rigid, Shape};
use crate::geometry::outline::Outline;
use crate::geometry::rows::Arrangement;

/// A motion law: time [s] → motion of the body's origin.
pub type Law = Box<dyn Fn(f64) -> Rigid + Send + Sync>;

/// See the module's text.
pub struct PrescribedBody {
    name: String,
    shape: Shape,
    law: Law,
    state: State,
    saved: State,
}

/// What a step changes.
#[derive(Clone, Copy, Default)]
struct State {
    time: f64,
    now: Resultant,
    mean: Resultant,
    external: [f64; 2],
    work: f64,
}

impl PrescribedBody {
    /// A body that follows `law`; with `half`, only its half x > 0 is simulated.
    pub fn new(name: &str, outline: Outline, half: bool, law: Law) -> PrescribedBody {
        let shape = Shape::new(outline, [0.0, 0.0], half);
        PrescribedBody { name: name.into(), shape, law, state: State::default(), saved: State::default() }
    }

    /// The law of constant velocity [m/s] and spin [rad/s] from a start position [m] and angle [rad].
    pub fn steady(start: [f64; 2], angle: f64, velocity: [f64; 2], spin: f64) -> Law {
        let first = Rigid { pole: start, angle, velocity, spin, ..Rigid::default() };
        Box::new(move |t| first.ahead(t))
    }

    /// V4: the law x₀ + A r(t) sin(2π t/T), with r = s²(3 − 2s), s = min(t/T, 1): at rest at t = 0, harmonic after a
    /// period; x₀, A [m], T [s], at a constant angle [rad].
    pub fn oscillating(middle: [f64; 2], angle: f64, amplitude: [f64; 2], period: f64) -> Law {
        let omega = std::f64::consts::TAU / period;
        Box::new(move |t| {
            let s = (t / period).clamp(0.0, 1.0);
            let ease = [s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / period, (6.0 - 12.0 * s) / period.powi(2)];
            let bend = if t < period { ease[2] } else { 0.0 };
            let (sin, cos) = (omega * t).sin_cos();
            let place = ease[0] * sin;
            let speed = ease[1] * sin + ease[0] * omega * cos;
            let rate = bend * sin + 2.0 * ease[1] * omega * cos - ease[0] * omega * omega * sin;
            Rigid {
                pole: [0, 1].map(|k| middle[k] + amplitude[k] * place),
                angle,
                velocity: amplitude.map(|a| a * speed),
                acceleration: amplitude.map(|a| a * rate),
                ..Rigid::default()
            }
        })
    }

    fn rigid(&self) -> Rigid {
        (self.law)(self.state.time)
    }
}

impl WettedBody for PrescribedBody {
    fn name(&self) -> &str {
        &self.name
    }

    fn arrange(&mut self, arrangement: Arrangement) {
        self.shape.arrangement = arrangement;
    }

    fn sample(&mut self, spacing: f64, layers: usize) -> Result<Vec<WallPoint>, BodyError> {
        Ok(self.shape.sample(&self.rigid(), spacing, layers))
    }

    fn place(&self, ahead: f64, out: WallsMut<'_>) {
        // the law, made a motion of constant acceleration that ends exactly where the law says
        let (now, then) = (self.rigid(), (self.law)(self.state.time + ahead));
        if ahead <= 0.0 {
            return self.shape.place(&now, 0.0, out);
        }
        let mean = |k: usize| (then.pole[k] - now.pole[k]) / ahead;
        let fitted = Rigid {
            velocity: [0, 1].map(|k| mean(k) - 0.5 * ahead * then.acceleration[k]),
            spin: (then.angle - now.angle) / ahead - 0.5 * ahead * then.spin_rate,
            acceleration: then.acceleration,
            spin_rate: then.spin_rate,
            ..now
        };
        self.shape.place(&fitted, ahead, out);
    }

    fn screens(&self, ahead: f64) -> Vec<Screen> {
        self.shape.screens(&self.rigid(), &(self.law)(self.state.time + ahead))
    }

    fn load(&mut self, force: WallForces<'_>) {
        let pole = self.rigid().pole;
        (self.state.now, self.state.mean) = (force.resultant(pole), force.mean_resultant(pole));
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        let (now, then) = (self.rigid(), (self.law)(self.state.time + dt));
        let moved = [0, 1].map(|k| then.pole[k] - now.pole[k]);
        let (mean, state) = (self.state.mean, &mut self.state);
        for k in 0..2 {
            state.work += mean.force[k] * moved[k];
            state.external[k] -= dt * mean.force[k];
        }
        // the mean moment about the pole, which moves through the step
        state.work += mean.about(moved.map(|d| 0.5 * d)).moment * (then.angle - now.angle);
        state.now = state.now.about(moved);
        state.time += dt;
        Ok(())
    }

    fn save(&mut self) {
        self.saved = self.state;
    }

    fn restore(&mut self) {
        self.state = self.saved;
    }

    fn energy(&self) -> Energy {
        Energy { work: self.state.work, ..Energy::default() }
    }

    fn ledger(&self) -> Ledger {
        Ledger { momentum: [0.0; 2], external: self.state.external }
    }

    fn motion(&self) -> Option<Motion> {
        let r = self.rigid();
        Some(Motion {
            position: r.pole,
            angle: r.angle,
            velocity: r.velocity,
            spin: r.spin,
            acceleration: r.acceleration,
            force: self.state.now.force,
            moment: self.state.now.moment,
        })
    }

    fn outline(&self) -> Option<&Outline> {
        Some(&self.shape.outline)
    }

    fn clearance(&self, at: [f64; 2]) -> f64 {
        self.shape.clearance(&self.rigid(), at)
    }

    fn surface(&self, at: [f64; 2]) -> Surface {
        self.shape.surface(&self.rigid(), at)
    }

    fn strike(&mut self, at: [f64; 2], impulse: [f64; 2]) {
        let r = self.rigid();
        let v = r.point_velocity(crate::bodies::rigid_motion::rotate([at[0] - r.pole[0], at[1] - r.pole[1]], -r.angle));
        self.state.work += impulse[0] * v[0] + impulse[1] * v[1];
        self.state.external = [0, 1].map(|k| self.state.external[k] - impulse[k]);
    }

    fn prescribed(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_oscillation_starts_at_rest_and_its_derivatives_are_its_own() {
        let law = PrescribedBody::oscillating([0.3, -0.1], 0.0, [0.1, 0.02], 1.25);
        assert_eq!((law(0.0).pole, law(0.0).velocity), ([0.3, -0.1], [0.0; 2]));
        for t in [0.2, 0.9, 1.2, 1.7, 3.0] {
            let (before, now, after) = (law(t - 1e-5), law(t), law(t + 1e-5));
            for k in 0..2 {
                let speed = (after.pole[k] - before.pole[k]) / 2e-5;
                let rate = (after.velocity[k] - before.velocity[k]) / 2e-5;
                assert!((speed - now.velocity[k]).abs() < 1e-7, "t = {t}: {speed} {:?}", now.velocity);
                assert!((rate - now.acceleration[k]).abs() < 1e-6, "t = {t}: {rate} {:?}", now.acceleration);
            }
        }
        assert!((law(1.25 * 2.25).pole[0] - 0.4).abs() < 1e-12, "the amplitude after the first period");
    }
}
