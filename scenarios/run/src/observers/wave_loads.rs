//! A body in regular waves: harmonics and means of its loads and motions, and the waves before and behind it (THEORY GE29).

use fsi_coupling::geometry::polygon;
use scene::{Motion, Scene};
use serde::Serialize;
use water_entry::waves::linear_wave::LinearWave;
use water_entry::waves::separation::{Amplitude, separate};

use super::harmonics::{Harmonics, MeanBand, harmonics, over_a_period};
use super::series::Series;
use super::wave_theory::wave_theory;

/// Fewest spacings in the draught of a body for which bands were measured.
const LEAST_SPACINGS: f64 = 12.0;
/// Band of a mean vertical force over the buoyancy: the water swells by a part in 2000. Runs gave up to +1.2 N/m of 785 where NTNU measured −0.2 to −2.1 [-].
const OF_BUOYANCY: f64 = 0.005;
/// Fewest periods that a mean is taken over.
const FEWEST: usize = 2;

/// Loads and motions of a body in the regular waves of a wave maker, over the whole periods in which neither the front of the waves nor waves
/// that come back from the piston are at the body.
#[derive(Clone, Debug, Serialize)]
pub struct BodyInWaves {
    /// Its name.
    pub body: String,
    /// First and last time of the periods [s].
    pub window_s: [f64; 2],
    /// Their number.
    pub periods: usize,
    /// Amplitude of the waves that arrive, from the gauges before it [m]; absent with fewer than two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub incident_m: Option<f64>,
    /// Amplitude of the waves that it sends back [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reflected_m: Option<f64>,
    /// Amplitude of the waves that run on behind it, from the gauges there [m]; absent with fewer than two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub transmitted_m: Option<f64>,
    /// Force along x [N/m].
    #[serde(rename = "fx_N_per_m")]
    pub fx: Harmonics,
    /// Force along y [N/m].
    #[serde(rename = "fy_N_per_m")]
    pub fy: Harmonics,
    /// Moment about its centre of mass [N].
    #[serde(rename = "moment_N")]
    pub moment: Harmonics,
    /// Displacement of its centre of mass along x [m].
    #[serde(rename = "x_m")]
    pub x: Harmonics,
    /// Displacement of its centre of mass along y [m].
    #[serde(rename = "y_m")]
    pub y: Harmonics,
    /// Rotation, counter-clockwise [deg].
    #[serde(rename = "angle_deg")]
    pub angle: Harmonics,
}

/// The periods that count, and the time before waves.
struct Window {
    to: f64,
    periods: usize,
    /// While the water before the body is still [s].
    rest: [f64; 2],
}

impl Series {
    /// GE29: each body in the waves of a run's wave maker; a body without two periods is left out.
    pub fn bodies_in_waves(&self, scene: &Scene) -> Vec<BodyInWaves> {
        scene.all_bodies().filter_map(|body| self.body_in_waves(scene, body)).collect()
    }

    fn body_in_waves(&self, scene: &Scene, body: &scene::Body) -> Option<BodyInWaves> {
        let (wave, [min, max]) = (scene.wave()?, polygon::bounding_box(&body.placed_outline()));
        // a body that is towed meets the waves at another frequency
        let towed = matches!(body.motion, Motion::ConstantVelocity) && body.velocity != [0.0; 2];
        (!towed).then_some(())?;
        // gauges up to the next body, the relaxation zone or the beach
        let others = scene.all_bodies().map(|other| polygon::bounding_box(&other.placed_outline()));
        let (mut clear, mut end) =
            (scene.relaxation().map_or(f64::NEG_INFINITY, |zone| zone.zone.from), calm_end(scene));
        for [least, most] in others.filter(|[least, _]| least[0] != min[0]) {
            if most[0] <= min[0] {
                clear = clear.max(most[0]);
            } else if least[0] >= max[0] {
                end = end.min(least[0]);
            }
        }
        let gauges = &scene.observe.level;
        let before: Vec<f64> = gauges.iter().copied().filter(|x| *x < min[0] && *x >= clear).collect();
        let behind: Vec<f64> = gauges.iter().copied().filter(|x| *x > max[0] && *x <= end).collect();
        let farthest = before.iter().copied().fold(min[0], f64::min);
        let window = window(scene, &wave, min[0], min[0] - farthest, self.rows().last()?[0])?;
        let omega = wave.angular_frequency;
        let amplitudes = |places: &[f64]| {
            let found = places.iter().map(|x| Some((*x, self.mean_amplitude(scene, *x, omega, &window)?)));
            separate(wave.wave_number, &found.collect::<Option<Vec<_>>>()?)
                .map(|both| both.map(|[re, im]| re.hypot(im)))
        };
        let (arriving, leaving) = (amplitudes(&before), amplitudes(&behind));
        let incident = arriving.map(|[right, _]| right);
        let theory = wave_theory(scene).filter(|_| scene.bodies.is_empty()).unwrap_or_default();
        let of = |value: &dyn Fn(&[f64]) -> f64, theory: [Option<f64>; 2], drifts: bool| {
            let curve: Vec<[f64; 2]> = self.rows().iter().map(|row| [row[0], value(row)]).collect();
            let still: Vec<f64> =
                curve.iter().filter(|p| p[0] >= window.rest[0] && p[0] <= window.rest[1]).map(|p| p[1]).collect();
            let rest =
                if still.is_empty() { curve.first()?[1] } else { still.iter().sum::<f64>() / still.len() as f64 };
            harmonics(&curve, omega, window.to, window.periods, rest, drifts).map(|found| found.over(incident, theory))
        };
        let column = |name: &str| {
            let name = format!("{}.{name}", body.name);
            self.columns().iter().position(|column| *column == name)
        };
        let plain = |name: &str, theory| column(name).and_then(|column| of(&|row| row[column], theory, false));
        let ([fx, fy, moment], [of_x, of_y, of_angle]) = (theory.loads, theory.motions);
        let spacings = -min[1] / scene.resolution.spacing;
        // what was measured: incompressible water and a relaxation zone
        let known = spacings >= LEAST_SPACINGS && scene.solver.is_incompressible() && scene.relaxation().is_some();
        let banded =
            |found: Harmonics, mean: Option<MeanBand>| if known { found.banded(spacings, mean) } else { found };
        let moved = |found: Harmonics| if body.motion == Motion::Fixed { found } else { banded(found, None) };
        let buoyancy = scene.water().density * scene.gravity[1].abs() * (max[0] - min[0]) * -min[1];
        let (x, y, angle, [cx, cy]) = (column("x_m")?, column("y_m")?, column("angle_deg")?, body.center_of_mass);
        let arm = |row: &[f64]| {
            let (sin, cos) = row[angle].to_radians().sin_cos();
            [cx * cos - cy * sin, cx * sin + cy * cos]
        };
        let [at_origin, along_x, along_y] = [column("moment_N")?, column("fx_N_per_m")?, column("fy_N_per_m")?];
        let about = |row: &[f64]| arm(row)[0] * row[along_y] - arm(row)[1] * row[along_x];
        Some(BodyInWaves {
            body: body.name.clone(),
            window_s: [window.to - window.periods as f64 * wave.period(), window.to],
            periods: window.periods,
            incident_m: incident,
            reflected_m: arriving.map(|[_, left]| left),
            transmitted_m: leaving.map(|[right, _]| right),
            fx: banded(plain("fx_N_per_m", [fx, theory.drift])?, Some(MeanBand::BySpacings)),
            fy: banded(plain("fy_N_per_m", [fy, None])?, Some(MeanBand::Of(OF_BUOYANCY * buoyancy))),
            moment: banded(of(&|row| row[at_origin] - about(row), [moment, None], false)?, None),
            x: moved(of(&|row| row[x] + arm(row)[0], [of_x, None], true)?),
            y: moved(of(&|row| row[y] + arm(row)[1], [of_y, None], true)?),
            angle: moved(of(&|row| row[angle], [of_angle, None], true)?),
        })
    }

    /// Mean over the window of the first harmonic at a gauge [m].
    fn mean_amplitude(&self, scene: &Scene, x: f64, omega: f64, window: &Window) -> Option<Amplitude> {
        let gauge = scene.observe.level.iter().position(|at| *at == x)?;
        let column = self.columns().iter().position(|column| column == "level1_m")? + gauge;
        let curve: Vec<[f64; 2]> = self.rows().iter().map(|row| [row[0], row[column]]).collect();
        let (period, count) = (std::f64::consts::TAU / omega, window.periods);
        let each = (0..count).map(|k| Some(over_a_period(&curve, omega, window.to - (k + 1) as f64 * period, 0.0)?[1]));
        let each: Vec<Amplitude> = each.collect::<Option<_>>()?;
        Some([0, 1].map(|part| each.iter().map(|a| a[part]).sum::<f64>() / count as f64))
    }
}

/// Where the beach begins [m], or infinity.
pub(super) fn calm_end(scene: &Scene) -> f64 {
    scene.beach().map_or(f64::INFINITY, |beach| beach.from)
}

/// From when full waves, and those that the body sent back, have passed the gauges up to `reach` [m] before the body at x [m], to the end of the run or
/// to when waves from the body are back from the piston.
fn window(scene: &Scene, wave: &LinearWave, x: f64, reach: f64, end: f64) -> Option<Window> {
    let maker = scene.tank.wave_maker?;
    let (way, speed, period) = (x + 0.5 * scene.tank.width, wave.group_speed(), wave.period());
    let absorbed = scene.relaxation().is_some();
    let to = if absorbed { end } else { end.min(3.0 * way / speed) };
    let from = (way + reach) / speed + (maker.ramp + 1.0) * period;
    let periods = ((to - from) / period).floor();
    let first = way / (scene.gravity[1].abs() * wave.depth).sqrt();
    (periods >= FEWEST as f64).then_some(Window { to, periods: periods as usize, rest: [0.5 * first, first] })
}
