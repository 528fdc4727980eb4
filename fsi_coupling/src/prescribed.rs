//! A body whose motion is given as a function of time.

use sph_core::walls::Resultant;
use sph_core::{WallForces, WallPoint, WallsMut};

use crate::body::{BodyError, Energy, Ledger, Motion, Surface, WettedBody};
use crate::outline::Outline;
use crate::pose::{Rigid, Shape};
use crate::rows::Arrangement;

/// A motion law: time [s] → motion of the body's origin.
pub type Law = Box<dyn Fn(f64) -> Rigid + Send>;

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
        let v = r.point_velocity(crate::pose::rotate([at[0] - r.pole[0], at[1] - r.pole[1]], -r.angle));
        self.state.work += impulse[0] * v[0] + impulse[1] * v[1];
        self.state.external = [0, 1].map(|k| self.state.external[k] - impulse[k]);
    }

    fn prescribed(&self) -> bool {
        true
    }
}
