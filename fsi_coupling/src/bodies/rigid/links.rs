//! A rigid body as joints and other solids meet it (THEORY CO36).

use sph_core::walls::Resultant;

use super::RigidBody2d;
use crate::bodies::body::Linked;
use crate::bodies::state::Solid;

impl Linked for RigidBody2d {
    fn solid(&self) -> Option<Solid> {
        let spec = &self.spec;
        let inverse = [spec.mass, spec.mass, spec.inertia].map(|inertia| 1.0 / inertia);
        Some(Solid {
            motion: self.motion_under(self.state.now),
            inverse_mass: [0, 1, 2].map(|k| if spec.free[k] { inverse[k] } else { 0.0 }),
            halves: if spec.half { 2.0 } else { 1.0 },
        })
    }

    fn apply_link_impulse(&mut self, impulse: Resultant) {
        self.apply(impulse);
        // the water's half of the step acts at the same time: work is that on the way from the mean velocity of the step to the one now
        let (now, [x, y], drift) = (self.motion_now(), impulse.force, self.state.drift);
        let along = [(x, now.velocity[0]), (y, now.velocity[1]), (impulse.moment, now.angular_velocity)];
        let work = along.into_iter().zip(drift).map(|((impulse, now), mean)| 0.5 * impulse * (mean + now));
        self.state.work_of_links += work.sum::<f64>();
        for (k, impulse) in [x, y].into_iter().enumerate() {
            self.state.external[k] -= if self.spec.free[k] { 0.0 } else { impulse };
        }
    }

    fn set_reaction(&mut self, reaction: Resultant) {
        self.state.reaction = reaction;
    }
}
