//! A body whose motion is given as a function of time.

use sph_core::walls::Resultant;
use sph_core::{WallForces, WallPoint, WallsMut};

use crate::body::{BodyError, Energy, Ledger, Motion, WettedBody};
use crate::outline::Outline;
use crate::pose::{Rigid, Shape};

/// A motion law: time [s] → motion of the body's origin.
pub type Law = Box<dyn Fn(f64) -> Rigid + Send>;

/// See the module's text.
pub struct PrescribedBody {
    name: String,
    shape: Shape,
    law: Law,
    time: f64,
    saved: f64,
    now: Resultant,
    mean: Resultant,
    external: [f64; 2],
    work: f64,
}

impl PrescribedBody {
    /// A body that follows `law`; with `half`, only its half x > 0 is simulated.
    pub fn new(name: &str, outline: Outline, half: bool, law: Law) -> PrescribedBody {
        let shape = Shape::new(outline, [0.0, 0.0], half);
        let (now, mean) = (Resultant::default(), Resultant::default());
        PrescribedBody {
            name: name.into(),
            shape,
            law,
            time: 0.0,
            saved: 0.0,
            now,
            mean,
            external: [0.0; 2],
            work: 0.0,
        }
    }

    /// The law of constant velocity [m/s] and spin [rad/s] from a start position [m] and angle [rad].
    pub fn steady(start: [f64; 2], angle: f64, velocity: [f64; 2], spin: f64) -> Law {
        let first = Rigid { pole: start, angle, velocity, spin, ..Rigid::default() };
        Box::new(move |t| first.ahead(t))
    }
}

impl WettedBody for PrescribedBody {
    fn name(&self) -> &str {
        &self.name
    }

    fn sample(&mut self, spacing: f64, layers: usize) -> Result<Vec<WallPoint>, BodyError> {
        Ok(self.shape.sample(&(self.law)(self.time), spacing, layers))
    }

    fn place(&self, ahead: f64, out: WallsMut<'_>) {
        // the law, made a motion of constant acceleration that ends exactly where the law says
        let (now, then) = ((self.law)(self.time), (self.law)(self.time + ahead));
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
        let pole = (self.law)(self.time).pole;
        (self.now, self.mean) = (force.resultant(pole), force.mean_resultant(pole));
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        let (now, then) = ((self.law)(self.time), (self.law)(self.time + dt));
        for k in 0..2 {
            self.work += self.mean.force[k] * (then.pole[k] - now.pole[k]);
            self.external[k] -= dt * self.mean.force[k];
        }
        self.work += self.mean.moment * (then.angle - now.angle);
        self.time += dt;
        Ok(())
    }

    fn save(&mut self) {
        self.saved = self.time;
    }

    fn restore(&mut self) {
        self.time = self.saved;
    }

    fn energy(&self) -> Energy {
        Energy { work: self.work, ..Energy::default() }
    }

    fn ledger(&self) -> Ledger {
        Ledger { momentum: [0.0; 2], external: self.external }
    }

    fn motion(&self) -> Option<Motion> {
        let r = (self.law)(self.time);
        Some(Motion {
            position: r.pole,
            angle: r.angle,
            velocity: r.velocity,
            spin: r.spin,
            acceleration: r.acceleration,
            force: self.now.force,
            moment: self.now.moment,
        })
    }

    fn outline(&self) -> Option<&Outline> {
        Some(&self.shape.outline)
    }

    fn clearance(&self, at: [f64; 2]) -> f64 {
        self.shape.clearance(&(self.law)(self.time), at)
    }

    fn prescribed(&self) -> bool {
        true
    }
}
