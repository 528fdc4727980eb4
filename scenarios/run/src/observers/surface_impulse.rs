//! The impulse handed to each body against that of the pressure on its outline (THEORY CO39).

use fsi_coupling::Coupled;
use fsi_coupling::coupling::force_rules::reaction_and_pressure;
use serde::{Deserialize, Serialize};

/// Both forces on a body [N/m], and what they add up to [N s/m].
#[derive(Clone, Default, Serialize, Deserialize)]
struct OfBody {
    last: [[f64; 2]; 2],
    impulses: [[f64; 2]; 2],
    magnitude: f64,
}

/// Sampled impulses of every body.
#[derive(Clone, Default, Serialize, Deserialize)]
pub(super) struct SurfaceImpulse {
    time: Option<f64>,
    bodies: Vec<OfBody>,
}

impl SurfaceImpulse {
    /// Take a sample; by trapezoids from the one before.
    pub fn sample(&mut self, system: &Coupled) {
        let time = system.fluid.time();
        let step = self.time.replace(time).map_or(0.0, |last| time - last);
        let forces: Vec<[[f64; 2]; 2]> =
            (0..system.bodies().count()).filter_map(|k| reaction_and_pressure(system, k)).collect();
        self.bodies.resize(forces.len(), OfBody::default());
        for (body, now) in self.bodies.iter_mut().zip(forces) {
            for (impulse, (last, now)) in body.impulses.iter_mut().zip(body.last.iter().zip(&now)) {
                *impulse = [0, 1].map(|c| impulse[c] + 0.5 * step * (last[c] + now[c]));
            }
            let size = |[x, y]: [f64; 2]| x.hypot(y);
            body.magnitude += 0.5 * step * (size(body.last[0]) + size(now[0]));
            body.last = now;
        }
    }

    /// The largest |∫F dt − ∫F_p dt|/∫|F| dt of a body [-]; `None` where no water pressed on any.
    pub fn gap(&self) -> Option<f64> {
        let of_body = |body: &OfBody| {
            let [reaction, pressure] = body.impulses;
            let gap = (reaction[0] - pressure[0]).hypot(reaction[1] - pressure[1]);
            (body.magnitude > 0.0).then_some(gap / body.magnitude)
        };
        self.bodies.iter().filter_map(of_body).reduce(f64::max)
    }
}
