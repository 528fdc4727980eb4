//! What accelerometers on the aeroplane show: as real ones do, the acceleration less that of free fall.

use std::f64::consts::{PI, SQRT_2};

use water_entry::ditching::{Bending, LandingState, MODES};

use super::model::Scene;
use super::parts::AccelerometerKeys;

/// The two signals of one over g at the moments: upwards from the body axis, and backwards along it.
pub(super) fn signals(
    scene: &Scene,
    keys: &AccelerometerKeys,
    moments: &[LandingState],
    bending: Option<&Bending>,
) -> [Vec<f64>; 2] {
    let interval = moments.get(1).map_or(1.0, |m| m.time);
    [0, 1].map(|k| {
        let raw = moments.iter().map(|m| along_axes(scene, keys, m, bending)[k] / scene.water.gravity);
        low_pass(raw.collect(), keys.bandwidth * interval)
    })
}

/// Acceleration of a place less that of free fall, upwards from the body axis and backwards along it [m/s²].
fn along_axes(scene: &Scene, keys: &AccelerometerKeys, now: &LandingState, bending: Option<&Bending>) -> [f64; 2] {
    let centre = scene.aeroplane.center_of_mass;
    let [px, pz] = now.attitude.of_point(centre, keys.at);
    let (rx, rz) = (px - now.attitude.place[0], pz - now.attitude.place[1]);
    let (turning, q) = (now.acceleration[2], now.attitude.rate[2]);
    let forward = now.acceleration[0] - turning * rz - q * q * rx;
    let up = now.acceleration[1] + turning * rx - q * q * rz + scene.water.gravity;
    let (sin, cos) = now.attitude.place[2].sin_cos();
    let modes = bending.map_or([[0.0; 3]; MODES], |bending| bending.at(keys.at[0]));
    let of_modes: f64 = (0..MODES).map(|k| modes[k][0] * now.acceleration[3 + k]).sum();
    [cos * up - sin * forward + of_modes, -(cos * forward + sin * up)]
}

/// Butterworth's filter of second order by the bilinear transformation, at rest at the first value; `cutoff` is over the frequency of
/// the samples.
fn low_pass(raw: Vec<f64>, cutoff: f64) -> Vec<f64> {
    let Some(&first) = raw.first() else { return raw };
    let k = (PI * cutoff).tan();
    let whole = 1.0 + SQRT_2 * k + k * k;
    let (b, a1, a2) = (k * k / whole, 2.0 * (k * k - 1.0) / whole, (1.0 - SQRT_2 * k + k * k) / whole);
    let (mut x1, mut x2, mut y1, mut y2) = (first, first, first, first);
    let filtered = raw.into_iter().map(|x| {
        let y = b * (x + 2.0 * x1 + x2) - a1 * y1 - a2 * y2;
        (x2, x1, y2, y1) = (x1, x, y1, y);
        y
    });
    filtered.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half the power passes at the cut-off frequency; a constant passes whole.
    #[test]
    fn the_filter_is_butterworths() {
        let of = |frequency: f64| {
            let wave = (0..4000).map(|k| (2.0 * PI * frequency * f64::from(k)).sin());
            let out = low_pass(wave.collect(), 0.05);
            out[2000..].iter().map(|v| v * v).sum::<f64>() / 2000.0 * 2.0
        };
        assert!((of(0.05) - 0.5).abs() < 0.01 && of(0.005) > 0.999 && of(0.2) < 0.01, "{} {}", of(0.05), of(0.2));
        assert!(low_pass(vec![3.0; 50], 0.05).iter().all(|v| (v - 3.0).abs() < 1e-12));
    }
}
