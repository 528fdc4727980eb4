//! Long-crested swell on deep water, in the plane of flight: regular (THEORY EN36), or of a spectrum (EN59).

use std::f64::consts::{PI, TAU};

use super::irregular::{Components, Jonswap};
use super::surface_motion::SurfaceMotion;
use crate::waves::linear_wave::LinearWave;

/// Regular, long-crested swell on deep water (THEORY EN36). The default is calm water.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Swell {
    /// Half the height between crest and trough [m].
    pub amplitude: f64,
    /// Angular frequency ω [rad/s].
    pub angular_frequency: f64,
    /// Wave number k [rad/m].
    pub wave_number: f64,
    /// Cosine of the angle χ from the waves' direction to that of flight [-].
    pub along_flight: f64,
    /// Phase at x = 0, 0 at a crest [rad].
    pub phase: f64,
    /// Waves of a spectrum instead, of which the numbers above are significant height, peak frequency and its wave number.
    pub components: Option<Components>,
    /// Time since their phases were given [s].
    pub elapsed: f64,
    /// Place where x = 0 is in their phases [m].
    pub origin: f64,
}

impl Swell {
    /// EN36: of a height and a length [m], both above 0; `heading` [rad] is the angle from the waves' direction to that of flight.
    pub fn new(height: f64, length: f64, heading: f64, gravity: f64) -> Swell {
        let wave = LinearWave::of_length(length, f64::INFINITY, gravity);
        Swell {
            amplitude: 0.5 * height,
            angular_frequency: wave.angular_frequency,
            wave_number: wave.wave_number,
            along_flight: heading.cos(),
            ..Swell::default()
        }
    }

    /// EN59: of a spectrum; `heading` as in [`Swell::new`]. Its `amplitude` is the significant height: few crests are higher.
    pub fn irregular(spectrum: &Jonswap, heading: f64, gravity: f64) -> Swell {
        let angular_frequency = TAU / spectrum.peak_period;
        Swell {
            amplitude: spectrum.significant_height,
            angular_frequency,
            wave_number: angular_frequency * angular_frequency / gravity,
            along_flight: heading.cos(),
            components: Some(spectrum.waves(heading.cos(), gravity)),
            ..Swell::default()
        }
    }

    /// The swell a time [s] later.
    pub fn later(self, time: f64) -> Swell {
        Swell { phase: self.phase - self.angular_frequency * time, elapsed: self.elapsed + time, ..self }
    }

    /// The swell of a spectrum whose place `x` [m] is now x = 0.
    pub(super) fn seen_from(self, x: f64) -> Swell {
        Swell { origin: self.origin + x, ..self }
    }

    /// Rate of the phase with x [rad/m].
    fn forward_wave_number(&self) -> f64 {
        self.wave_number * self.along_flight
    }

    /// Phase at x, counted in the direction of flight, from 0 to 2π: 0 crest, ½π down slope, π trough, 1½π up slope [rad]. Along the crests
    /// it is counted in the waves' direction.
    pub fn phase_at(&self, x: f64) -> f64 {
        (self.sense() * (self.phase + self.forward_wave_number() * x)).rem_euclid(TAU)
    }

    /// The swell whose phase at x is as given, counted as in [`Swell::phase_at`] [rad].
    pub fn with_phase_at(self, x: f64, phase: f64) -> Swell {
        Swell { phase: self.sense() * phase - self.forward_wave_number() * x, ..self }
    }

    /// Sign of the phase with the direction of flight: -1 against the waves.
    fn sense(&self) -> f64 {
        if self.along_flight < 0.0 { -1.0 } else { 1.0 }
    }

    /// Slope of the surface at x, upwards ahead [-].
    pub fn slope(&self, x: f64) -> f64 {
        if let Some(waves) = &self.components {
            return waves.slope(self.origin + x, self.elapsed);
        }
        -self.amplitude * self.forward_wave_number() * (self.phase + self.forward_wave_number() * x).sin()
    }

    /// EN36: angular frequency at which an aeroplane meets the waves [rad/s], ω − k V cos χ; below 0 where it overtakes them.
    pub fn encounter_frequency(&self, speed: f64) -> f64 {
        self.angular_frequency - self.forward_wave_number() * speed
    }

    /// Height between crest and trough over length [-].
    pub fn steepness(&self) -> f64 {
        self.amplitude * self.wave_number / PI
    }

    /// EN36: the surface at x [m] and its motion in the plane of water there.
    pub fn water(&self, x: f64) -> SurfaceMotion {
        if self.amplitude == 0.0 {
            return SurfaceMotion::default(); // calm
        }
        if let Some(waves) = &self.components {
            return waves.water(self.origin + x, self.elapsed, self.along_flight);
        }
        let (sin, cos) = (self.phase + self.forward_wave_number() * x).sin_cos();
        let forward = self.amplitude * self.angular_frequency * self.along_flight;
        // rate of the phase in a plane of water, and of this rate
        let rate = self.forward_wave_number() * forward * cos - self.angular_frequency;
        let forward_acceleration = -forward * sin * rate;
        let change = self.forward_wave_number() * forward_acceleration;
        SurfaceMotion {
            elevation: self.amplitude * cos,
            velocity: [forward * cos, -self.amplitude * sin * rate],
            acceleration: [forward_acceleration, -self.amplitude * (cos * rate * rate + sin * change)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Velocity and acceleration are the derivatives of what a plane of water that moves with the water goes through.
    #[test]
    fn the_surface_moves_as_its_velocity_says() {
        for heading in [0.0, 40.0, 90.0, 130.0, 180.0_f64] {
            let swell = Swell::new(4.0, 60.0, heading.to_radians(), 9.81).with_phase_at(0.0, 1.1);
            let dt = 1e-4;
            let moved = |x: f64, from: f64, by: f64| {
                let middle = x + 0.5 * by * swell.later(from).water(x).velocity[0];
                x + by * swell.later(from + 0.5 * by).water(middle).velocity[0]
            };
            let (before, now, after) = (
                swell.later(-dt).water(moved(0.0, 0.0, -dt)),
                swell.water(0.0),
                swell.later(dt).water(moved(0.0, 0.0, dt)),
            );
            let rate = (after.elevation - before.elevation) / (2.0 * dt);
            assert!((rate - now.velocity[1]).abs() < 1e-6, "{heading}: {rate}, {:?}", now.velocity);
            for k in 0..2 {
                let rate = (after.velocity[k] - before.velocity[k]) / (2.0 * dt);
                assert!((rate - now.acceleration[k]).abs() < 1e-6, "{heading}, {k}: {rate}, {:?}", now.acceleration);
            }
        }
    }

    #[test]
    fn phases_are_counted_in_the_direction_of_flight() {
        for heading in [0.0_f64, 60.0, 120.0, 180.0] {
            let swell = Swell::new(2.0, 100.0, heading.to_radians(), 9.81);
            let at = |quarter: f64| swell.with_phase_at(7.0, quarter * 0.5 * PI);
            assert!(
                (at(0.0).water(7.0).elevation - 1.0).abs() < 1e-12
                    && (at(2.0).water(7.0).elevation + 1.0).abs() < 1e-12
            );
            assert!(at(1.0).slope(7.0) < -0.03 && at(3.0).slope(7.0) > 0.03, "{heading}");
            assert!((at(3.0).phase_at(7.0) - 1.5 * PI).abs() < 1e-12);
        }
    }
}
