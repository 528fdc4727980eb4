//! Waves that are made at the left end of the tank and absorbed at the right.

use fsi_coupling::RelaxationZone;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sph_core::DampingZone;
use water_entry::waves::incident_wave::IncidentWave;
use water_entry::waves::linear_wave::LinearWave;
use water_entry::waves::piston_motion::PistonMotion;

use super::Scene;

/// A piston for a wall: it makes regular waves (THEORY WA14).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WaveMaker {
    /// Height of the waves, from trough to crest [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub height: f64,
    /// Period of the waves [s]. absent: that of their length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required without length"))]
    pub period: Option<f64>,
    /// Length of the waves [m]. absent: that of their period.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required without period"))]
    pub length: Option<f64>,
    /// Periods in which the stroke grows from 0 to its full length, 0.5 to 20 [-].
    #[serde(default = "usual::ramp")]
    #[schemars(range(min = 0.5, max = 20.0))]
    pub ramp: f64,
    /// The piston's second harmonic of Madsen (1971), without which a free wave of half the period runs behind the waves.
    #[serde(default = "usual::second_order")]
    pub second_order: bool,
    /// Length from the piston in which the velocity is relaxed to that of the incident wave, once full waves fill it, so that waves that
    /// come back are absorbed (THEORY WA16) [m]. absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub relaxation: Option<f64>,
}

/// Water whose motion is damped before the right wall, and before both with symmetry = x (THEORY WA15).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Beach {
    /// Its length from the wall [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: f64,
    /// Rate of the damping at the wall; towards the water it falls with the square of the distance from the beach's start [1/s].
    /// absent: 8 sqrt(g depth)/length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "8 sqrt(g depth)/length"))]
    pub rate: Option<f64>,
}

/// Rate of an automatic beach over √(g d)/L [-].
const BEACH_RATE: f64 = 8.0;
/// Rate of a relaxation zone at the piston over c_g/L [-]: waves that come back leave it with exp(−⅔ of it) of their height.
const RELAXATION_RATE: f64 = 6.0;

mod usual {
    pub fn ramp() -> f64 {
        2.0
    }
    pub fn second_order() -> bool {
        true
    }
}

impl Scene {
    /// The waves of the wave maker; `None` without one.
    pub fn wave(&self) -> Option<LinearWave> {
        let WaveMaker { period, length, .. } = self.tank.wave_maker?;
        let (depth, g) = (self.tank.depth, self.gravity[1].abs());
        let of_period = period.map(|period| LinearWave::of_period(period, depth, g));
        of_period.or_else(|| length.map(|length| LinearWave::of_length(length, depth, g)))
    }

    /// The motion of the wave maker's piston; `None` without one.
    pub fn piston(&self) -> Option<PistonMotion> {
        let WaveMaker { height, ramp, second_order, .. } = self.tank.wave_maker?;
        Some(PistonMotion::of(&self.wave()?, height, ramp, second_order))
    }

    /// WA16: the zone before the wave maker in which the water is led to its waves; `None` without one.
    pub fn relaxation(&self) -> Option<RelaxationZone> {
        let WaveMaker { height, ramp, relaxation, second_order, .. } = self.tank.wave_maker?;
        let (length, wave, piston) = (relaxation?, self.wave()?, -0.5 * self.tank.width);
        let rate = RELAXATION_RATE * wave.group_speed() / length;
        Some(RelaxationZone {
            zone: DampingZone { from: piston + length, length: -length, rate },
            wave: IncidentWave::of(wave, height, piston, second_order),
            growth: [ramp * wave.period() + length / wave.group_speed(), wave.period()],
        })
    }

    /// The water that a beach damps; `None` without one.
    pub fn beach(&self) -> Option<DampingZone> {
        let Beach { length, rate } = self.tank.beach?;
        let usual = BEACH_RATE * (self.gravity[0].hypot(self.gravity[1]) * self.tank.depth).sqrt() / length;
        Some(DampingZone { from: 0.5 * self.tank.width - length, length, rate: rate.unwrap_or(usual) })
    }
}
