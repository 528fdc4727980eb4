//! A zone in which the water is led to an incident wave: the wave is made there, and waves that come back are absorbed (THEORY WA16).

use sph_core::{Damped, DampingZone, Fluid};
use water_entry::waves::incident_wave::IncidentWave;

/// A relaxation zone (Jacobsen, Fuhrman & Fredsøe 2012), which acts from a time on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelaxationZone {
    /// Where, and at what rate what differs from the wave is damped.
    pub zone: DampingZone,
    /// The wave.
    pub wave: IncidentWave,
    /// When the rate begins to grow, and how long it grows to its full value [s].
    pub growth: [f64; 2],
}

impl RelaxationZone {
    /// WA16: over a step of `dt` [s] that has ended; what was taken from the water.
    pub fn relax(&self, fluid: &mut Fluid, dt: f64) -> Damped {
        let time = fluid.time();
        let [begin, duration] = self.growth;
        let share = ((time - begin) / duration).clamp(0.0, 1.0);
        if share == 0.0 {
            return Damped::default();
        }
        let zone = DampingZone { rate: share * self.zone.rate, ..self.zone };
        fluid.relax(&zone, |at| self.wave.velocity(at, time), dt)
    }
}
