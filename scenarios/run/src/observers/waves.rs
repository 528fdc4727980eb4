//! Heights, speed and reflection of regular waves, from the levels of a run with a wave maker (THEORY GE26).

use std::f64::consts::{PI, TAU};

use fsi_coupling::geometry::polygon;
use scene::vocabulary::Doubt;
use scene::{Scene, full_waves_by, waves_end_early};
use serde::Serialize;
use settings::significant;
use water_entry::waves::separation::{Amplitude, separate};

use super::harmonics::over_a_period;
use super::series::Series;
use super::wave_loads::{BodyInWaves, calm_end};

/// Periods at the end of the run over which harmonics are taken.
const PERIODS: f64 = 4.0;
/// Gauges, the last ones, that tell waves that run back from those that run on.
const PROBES: usize = 3;

/// The regular waves of a run with a wave maker, over its last four periods.
#[derive(Clone, Debug, Serialize)]
pub struct Waves {
    /// Height that the scene asks for [m].
    pub height_m: f64,
    /// Period [s].
    pub period_s: f64,
    /// Length by linear theory [m].
    pub length_m: f64,
    /// Stroke of the piston [m].
    pub stroke_m: f64,
    /// First harmonic at each place of observe.level, in its order.
    pub gauges: Vec<WaveGauge>,
    /// Phase speed over that of linear theory, from the phases of the gauges that four full periods have passed [-]; absent with fewer than two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phase_speed_ratio: Option<f64>,
    /// Share of its height that the wave loses in a wavelength, from the heights of the same gauges [-]; absent with fewer than two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decay_per_length: Option<f64>,
    /// Height of the waves that come back over that of those that arrive, from the last three of them [-]; absent with fewer, or where
    /// they are half a wavelength apart.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reflection: Option<f64>,
    /// Bodies in them, where two whole periods count.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<BodyInWaves>,
}

/// The wave at a place.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct WaveGauge {
    /// Where [m].
    pub x_m: f64,
    /// Height of the first harmonic, twice its amplitude [m].
    pub height_m: f64,
    /// The same over that asked for [-].
    pub height_ratio: f64,
}

/// Growth of a regular wave in a wavelength from which its height is doubted [-].
const GROWS: f64 = 0.01;

/// Why the waves of a run are unlikely: it ended early, or they grow on their way, which nothing makes them do.
pub(crate) fn unlikely_waves(scene: &Scene, waves: Option<&Waves>) -> Vec<Doubt> {
    let growing = waves.and_then(Waves::grow);
    waves_end_early(scene).into_iter().chain(growing).map(|why| Doubt::about("waves", why)).collect()
}

impl Waves {
    /// That they grow on their way.
    fn grow(&self) -> Option<String> {
        let growth = self.decay_per_length.map(|decay| -decay).filter(|growth| *growth > GROWS)?;
        Some(format!(
            "their height grows by {} % in a wavelength along the gauges, and regular waves lose height: waves that come back, a gauge on \
             the beach or too short a run may be why",
            significant(100.0 * growth)
        ))
    }
}

impl Series {
    /// GE26: the waves of a run; `None` without a wave maker, or before four periods have passed.
    pub fn waves(&self, scene: &Scene) -> Option<Waves> {
        let (maker, wave, piston) = (scene.tank.wave_maker?, scene.wave()?, scene.piston()?);
        let (k, places) = (wave.wave_number, &scene.observe.level);
        let first = self.columns().iter().position(|column| column == "level1_m");
        let harmonic = |j: usize| {
            let column = first? + j;
            let curve: Vec<[f64; 2]> = self.rows().iter().map(|row| [row[0], row[column]]).collect();
            first_harmonic(&curve, wave.angular_frequency)
        };
        let amplitudes: Vec<(f64, Amplitude)> =
            places.iter().enumerate().map(|(j, x)| Some((*x, harmonic(j)?))).collect::<Option<_>>()?;
        let gauges: Vec<WaveGauge> = amplitudes.iter().map(|(x, a)| gauge(*x, a, maker.height)).collect();
        // before the full wave has passed a place, what is there is not regular
        let settled = |x: f64| full_waves_by(scene, x).is_some_and(|by| by <= scene.time.end);
        // waves that a body sends back stand before it: without bodies all gauges count, else those behind the last one
        let behind = scene
            .all_bodies()
            .map(|b| polygon::bounding_box(&b.placed_outline())[1][0])
            .fold(f64::NEG_INFINITY, f64::max);
        let counts = |x: f64| settled(x) && x > behind && x <= calm_end(scene);
        let regular: Vec<(f64, Amplitude)> = amplitudes.iter().filter(|(x, _)| counts(*x)).copied().collect();
        let of_regular = gauges.iter().filter(|g| counts(g.x_m));
        let decays: Vec<[f64; 2]> = of_regular.map(|g| [g.x_m, g.height_m.ln()]).collect();
        let probes = &regular[regular.len().saturating_sub(PROBES)..];
        let separated = Some(probes).filter(|probes| probes.len() == PROBES).and_then(|probes| separate(k, probes));
        Some(Waves {
            height_m: maker.height,
            period_s: wave.period(),
            length_m: wave.length(),
            stroke_m: piston.stroke,
            gauges,
            phase_speed_ratio: slope(&phases(k, &regular)).map(|late| k / (k + late)),
            decay_per_length: slope(&decays).map(|rate| 1.0 - (rate * wave.length()).exp()),
            reflection: separated.map(|[right, left]| left[0].hypot(left[1]) / right[0].hypot(right[1])),
            bodies: self.bodies_in_waves(scene),
        })
    }
}

fn gauge(x_m: f64, [re, im]: &Amplitude, asked: f64) -> WaveGauge {
    let height_m = 2.0 * re.hypot(*im);
    WaveGauge { x_m, height_m, height_ratio: height_m / asked }
}

/// Places [m] and phases behind the wave of linear theory [rad], from gauge to gauge within half a period.
fn phases(k: f64, amplitudes: &[(f64, Amplitude)]) -> Vec<[f64; 2]> {
    let mut sorted: Vec<[f64; 2]> = amplitudes.iter().map(|(x, [re, im])| [*x, -im.atan2(*re) - k * x]).collect();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    for j in 1..sorted.len() {
        let step = sorted[j][1] - sorted[j - 1][1];
        sorted[j][1] -= TAU * ((step + PI) / TAU).floor();
    }
    sorted
}

/// Slope of the straight line through points by least squares; `None` with fewer than two places.
fn slope(points: &[[f64; 2]]) -> Option<f64> {
    let n = points.len() as f64;
    let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / n;
    let (x, y) = (mean(0), mean(1));
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>();
    let (above, below) = (sum(&|p| (p[0] - x) * (p[1] - y)), sum(&|p| (p[0] - x).powi(2)));
    (points.len() >= 2 && below > 0.0).then(|| above / below)
}

/// (2/nT) ∫ η exp(−iωt) dt over the last n periods T of a curve (time, η), by the trapezoidal rule, of η less its mean in each.
fn first_harmonic(curve: &[[f64; 2]], omega: f64) -> Option<Amplitude> {
    let (end, period) = (curve.last()?[0], TAU / omega);
    let each = (1..=PERIODS as usize).map(|k| Some(over_a_period(curve, omega, end - k as f64 * period, 0.0)?[1]));
    let each: Vec<Amplitude> = each.collect::<Option<_>>()?;
    Some([0, 1].map(|part| each.iter().map(|a| a[part]).sum::<f64>() / PERIODS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waves_that_grow_on_their_way_are_reported() {
        let notes = |decay: f64| {
            let waves = Waves {
                height_m: 0.02,
                period_s: 1.0,
                length_m: 1.5,
                stroke_m: 0.02,
                gauges: Vec::new(),
                phase_speed_ratio: None,
                decay_per_length: Some(decay),
                reflection: None,
                bodies: Vec::new(),
            };
            waves.grow().is_some_and(|why| why.contains("grows by 5 %"))
        };
        assert!(notes(-0.05) && !notes(0.05) && !notes(-0.005));
    }

    /// A wave with a mean and a second harmonic: amplitude and phase of the first are found.
    #[test]
    fn the_first_harmonic_is_found() {
        let omega = 4.0;
        let eta = |t: f64| 0.3 + 0.02 * (omega * t - 1.0).cos() + 0.005 * (2.0 * omega * t).sin();
        let curve: Vec<[f64; 2]> = (0..1000).map(|k| [0.01 * f64::from(k), eta(0.01 * f64::from(k))]).collect();
        let [re, im] = first_harmonic(&curve, omega).expect("six periods");
        assert!((re - 0.02 * 1.0_f64.cos()).abs() < 1e-5 && (im + 0.02 * 1.0_f64.sin()).abs() < 1e-5, "{re} {im}");
        assert_eq!(first_harmonic(&curve[..500], omega), None);
    }

    /// A wave that is a hundredth slower than theory, read at places a whole wavelength apart.
    #[test]
    fn speed_is_found_from_phases() {
        let k = 2.0;
        let at = |x: f64| (x, [(1.01 * k * x).cos(), -(1.01 * k * x).sin()]);
        let gauges: Vec<_> = (0..8).map(|j| at(PI * f64::from(j))).collect();
        let late = slope(&phases(k, &gauges)).expect("eight places");
        assert!((k / (k + late) - 1.0 / 1.01).abs() < 1e-12, "{late}");
        assert_eq!(slope(&[[1.0, 2.0]]), None);
    }
}
