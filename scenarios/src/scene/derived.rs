//! What follows from a scene's settings: the entry of its body, and speeds of its flow.

use super::auto::fastest_speed;
use super::impact::Entry;
use super::settings::Scene;

impl Scene {
    /// How the body meets the water; `None` where no body falls or moves down into it.
    pub fn entry(&self) -> Option<Entry> {
        let body = self.body.as_ref()?;
        Entry::of(body, self.gravity, self.water().density, self.time.end)
    }

    /// Fastest speed of the flow that is known before the run [m/s].
    pub fn fastest_speed(&self) -> f64 {
        let entry = self.entry();
        fastest_speed(entry.as_ref(), self.body.as_ref(), self.gravity, self.tank.fall()) + self.tank.block_speed()
    }

    /// Speed by which the steps of a projection are limited before anything moves [m/s]: the fastest that is known, but for
    /// the root of a spray no more than four times the body's speed, which a round body exceeds at first touch.
    pub fn projection_speed(&self) -> f64 {
        const ROOT_OVER_BODY: f64 = 4.0;
        let fastest = self.fastest_speed();
        self.entry().map_or(fastest, |entry| fastest.min(ROOT_OVER_BODY * entry.speed))
    }
}
