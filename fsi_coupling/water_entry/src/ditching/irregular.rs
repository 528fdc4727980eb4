//! Irregular, long-crested waves of a spectrum (THEORY EN59).

use std::f64::consts::TAU;

use super::surface_motion::SurfaceMotion;

/// Waves of a sea.
const WAVES: usize = 40;
/// Ends of the band of frequencies over that of the peak [-].
const BAND: [f64; 2] = [0.6, 2.5];
/// Steps of the integration over the band.
const STEPS: usize = 20_000;

/// A spectrum of waves (Hasselmann et al. 1973).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jonswap {
    /// Significant height, four times the standard deviation of the surface [m].
    pub significant_height: f64,
    /// Period of the peak [s].
    pub peak_period: f64,
    /// Peak enhancement γ [-]; 1 is the spectrum of Pierson & Moskowitz.
    pub gamma: f64,
    /// Seed of the phases.
    pub seed: u64,
}

/// The waves of a sea: all of one amplitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Components {
    /// Amplitude of each [m].
    pub amplitude: f64,
    /// Angular frequency [rad/s], rate of the phase with x [rad/m] and phase at x = 0 and t = 0 [rad] of each.
    waves: [[f64; 3]; WAVES],
}

impl Jonswap {
    /// EN59: density of the spectrum at a frequency over that of the peak [-], not scaled.
    pub fn density(&self, ratio: f64) -> f64 {
        let width = if ratio <= 1.0 { 0.07 } else { 0.09 };
        let near = (-0.5 * ((ratio - 1.0) / width).powi(2)).exp();
        ratio.powi(-5) * (-1.25 * ratio.powi(-4)).exp() * self.gamma.powf(near)
    }

    /// EN59: waves of equal energy, their phases by the seed; `along_flight` is the cosine of the heading.
    pub fn waves(&self, along_flight: f64, gravity: f64) -> Components {
        let step = (BAND[1] - BAND[0]) / STEPS as f64;
        let ratio = |k: usize| BAND[0] + step * (k as f64 + 0.5);
        let whole: f64 = (0..STEPS).map(|k| self.density(ratio(k))).sum();
        let (mut sum, mut random) = (0.0, SplitMix64(self.seed));
        let mut ratios = [0.0; WAVES];
        let mut next = 0;
        for k in 0..STEPS {
            sum += self.density(ratio(k));
            while next < WAVES && sum >= whole * (next as f64 + 0.5) / WAVES as f64 {
                ratios[next] = ratio(k);
                next += 1;
            }
        }
        let waves = ratios.map(|ratio| {
            let omega = ratio * TAU / self.peak_period;
            [omega, along_flight * omega * omega / gravity, TAU * random.share()]
        });
        Components { amplitude: self.significant_height / (8.0 * WAVES as f64).sqrt(), waves }
    }
}

impl Components {
    /// EN36 for the sum of all waves: the surface at x [m] and a time [s], and its motion in the plane of water there; `cos` is that of the heading.
    pub fn water(&self, x: f64, time: f64, cos: f64) -> SurfaceMotion {
        let phases = self.waves.map(|[omega, kappa, phase]| (kappa * x - omega * time + phase).sin_cos());
        let sum = |of: &dyn Fn([f64; 3], f64, f64) -> f64| -> f64 {
            self.amplitude * self.waves.iter().zip(&phases).map(|(wave, (s, c))| of(*wave, *s, *c)).sum::<f64>()
        };
        let forward = cos * sum(&|[omega, ..], _, c| omega * c);
        let rate = |[omega, kappa, _]: [f64; 3]| kappa * forward - omega;
        let forward_acceleration = -cos * sum(&|wave, s, _| wave[0] * rate(wave) * s);
        SurfaceMotion {
            elevation: sum(&|_, _, c| c),
            velocity: [forward, -sum(&|wave, s, _| rate(wave) * s)],
            acceleration: [
                forward_acceleration,
                -sum(&|wave, s, c| c * rate(wave).powi(2) + s * wave[1] * forward_acceleration),
            ],
        }
    }

    /// Slope of the surface there, upwards ahead [-].
    pub fn slope(&self, x: f64, time: f64) -> f64 {
        -self.amplitude
            * self
                .waves
                .iter()
                .map(|[omega, kappa, phase]| kappa * (kappa * x - omega * time + phase).sin())
                .sum::<f64>()
    }
}

/// Numbers by Steele, Lea & Flood (2014).
struct SplitMix64(u64);

impl SplitMix64 {
    /// A number from 0 to below 1.
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ditching::Swell;

    const SEA: Jonswap = Jonswap { significant_height: 2.0, peak_period: 7.0, gamma: 3.3, seed: 5 };

    /// Significant height of the surface in time, and mean period of the waves against the integral of the spectrum.
    #[test]
    fn the_surface_has_the_moments_of_the_spectrum() {
        for seed in [1, 2] {
            let waves = Jonswap { seed, ..SEA }.waves(1.0, 9.81);
            let count = 400_000;
            let squares = (0..count).map(|k| waves.water(0.0, 0.25 * f64::from(k), 1.0).elevation.powi(2));
            let height = 4.0 * (squares.sum::<f64>() / f64::from(count)).sqrt();
            println!("significant height {height} m");
            assert!((height / 2.0 - 1.0).abs() < 0.01, "{height}");
            let moment = |power: i32| -> f64 {
                (0..STEPS)
                    .map(|k| BAND[0] + (BAND[1] - BAND[0]) * (k as f64 + 0.5) / STEPS as f64)
                    .map(|r| SEA.density(r) * r.powi(power))
                    .sum()
            };
            let peak = TAU / 7.0;
            for power in [1, 2] {
                let ours: f64 = waves.waves.iter().map(|w| (w[0] / peak).powi(power)).sum::<f64>() / WAVES as f64;
                let exact = moment(power) / moment(0);
                assert!((ours / exact - 1.0).abs() < 0.01, "moment {power}: {ours}, exact {exact}");
            }
        }
        assert_eq!(SEA.waves(1.0, 9.81), SEA.waves(1.0, 9.81));
        assert_ne!(SEA.waves(1.0, 9.81), Jonswap { seed: 6, ..SEA }.waves(1.0, 9.81));
    }

    /// Velocity and acceleration are the derivatives of what a plane of water that moves with the water goes through.
    #[test]
    fn the_irregular_surface_moves_as_its_velocity_says() {
        for heading in [0.0, 60.0, 180.0_f64] {
            let swell = Swell::irregular(&SEA, heading.to_radians(), 9.81).later(13.0);
            let dt = 1e-4;
            let moved = |by: f64| {
                let middle = 0.5 * by * swell.water(0.0).velocity[0];
                by * swell.later(0.5 * by).water(middle).velocity[0]
            };
            let [before, now, after] = [-dt, 0.0, dt].map(|by| swell.later(by).water(moved(by)));
            assert!(((after.elevation - before.elevation) / (2.0 * dt) - now.velocity[1]).abs() < 1e-6);
            for k in 0..2 {
                let rate = (after.velocity[k] - before.velocity[k]) / (2.0 * dt);
                assert!((rate - now.acceleration[k]).abs() < 1e-6, "{heading}, {k}: {rate}, {:?}", now.acceleration);
            }
            let rise = (swell.water(1e-5).elevation - swell.water(-1e-5).elevation) / 2e-5;
            assert!((rise - swell.slope(0.0)).abs() < 1e-8);
        }
    }
}
