//! `splashdown bands --drops`: how often the band of a quoted force or impulse contains the value of boundary elements, for drops at random.
//!
//! A force is that of the impact's own bandwidth: where the spacing resolves less, what the longer averaging takes off is within the band
//! (THEORY GE19).

use std::f64::consts::PI;

use run::error_bar::ErrorBar;
use run::observers::Series;
use run::results::time_of_impact;
use run::{RunOptions, run};
use scene::vocabulary::{ResultName, Verdict};
use scene::{Scene, SceneError};

use super::ExperimentError;
use super::coverage::Line;
use super::runs::{run_to_end, scene_with};
use super::uncharted::{SOLVERS, numbers};

/// Ranges that drops are drawn from, evenly in the logarithm: breadth [m], speed [m/s], mass over ρ₀ breadth² [-], deadrise [deg], radius of an
/// arc over its breadth [-], spacings in the draught at the peak of a wedge and in the radius of an arc [-].
const BREADTH: [f64; 2] = [0.3, 3.0];
const SPEED: [f64; 2] = [1.5, 9.0];
const MASS: [f64; 2] = [0.15, 1.2];
const DEADRISE: [f64; 2] = [12.0, 44.0];
const RADIUS: [f64; 2] = [0.6, 1.4];
const SPACINGS: [f64; 2] = [8.0, 30.0];
const SPACINGS_OF_RADIUS: [f64; 2] = [40.0, 160.0];
/// End of a run over the time in which the spray root would reach the chines without being slowed (Wagner 1932) [-].
const END: [f64; 2] = [0.7, 1.3];
/// One in this number is an arc.
const ARCS: usize = 4;

/// A drop: the name of its scene and the overrides.
pub type Drop = (&'static str, Vec<String>);

/// Drop `k` of a seed.
pub fn draw(seed: u64, k: usize) -> Drop {
    let mut of = numbers(seed, k);
    let (breadth, speed, mass, end) = (of(BREADTH), of(SPEED), of(MASS), of(END));
    let (deadrise, ratio) = (of(DEADRISE), of(RADIUS));
    let slope = deadrise.to_radians().tan();
    let radius = ratio * breadth;
    let is_arc = k % ARCS == ARCS - 1;
    // draught at which the spray root is at the chines, and at which a wedge has the largest force (GE22)
    let chines = if is_arc { breadth * breadth / (16.0 * radius) } else { slope * breadth / PI };
    let added = 0.5 * PI * (0.5 * PI / slope).powi(2);
    let spacing = match is_arc {
        true => radius / of(SPACINGS_OF_RADIUS),
        false => chines.min((mass * breadth * breadth / (5.0 * added)).sqrt()) / of(SPACINGS),
    };
    let shape = match is_arc {
        true => format!("body.radius={radius:.5}"),
        false => format!("body.deadrise_deg={deadrise:.3}"),
    };
    let sets = vec![
        format!("solver={}", SOLVERS[(k / 2) % SOLVERS.len()]),
        shape,
        format!("body.breadth={breadth:.5}"),
        format!("body.mass={:.5}", 1000.0 * mass * breadth * breadth),
        format!("body.velocity=[0.0, {:.4}]", -speed),
        format!("time.end={:.7}", end * chines / speed),
        format!("resolution.spacing={spacing:.7}"),
    ];
    (if is_arc { "fuselage_section" } else { "wedge" }, sets)
}

/// Refuses drops that cannot be read, before the first runs.
///
/// # Errors
/// The first that is wrong.
pub fn read_all(drops: &[Drop]) -> Result<(), SceneError> {
    drops.iter().try_for_each(|drop| {
        scene_with(drop.0, &drop.1, &[])?;
        reference_of(drop).map(|_| ())
    })
}

/// The same drop by boundary elements.
fn reference_of((name, sets): &Drop) -> Result<Scene, SceneError> {
    let without_solver: Vec<String> = sets.iter().filter(|set| !set.starts_with("solver=")).cloned().collect();
    scene_with(name, &without_solver, &["model=boundary_element".into()])
}

/// Run a drop by particles and by boundary elements: a line for the force and for the impulse, where they have a band.
///
/// # Errors
/// The scene is wrong, or a run ended early.
pub fn cover(drop: &Drop) -> Result<Vec<Line>, ExperimentError> {
    let (name, sets) = drop;
    let particles = run_to_end(&scene_with(name, sets, &[])?)?;
    let other = reference_of(drop)?;
    let reference = run(&other, &RunOptions::default())?;
    let line = |result: ResultName, exact: f64| {
        let quantity = particles.summary.results.get(result)?;
        let band = quantity.band.filter(|_| quantity.verdict == Verdict::Resolved)?;
        let bar = ErrorBar {
            value: quantity.value,
            extrapolated: None,
            band,
            order: None,
            verdict: quantity.verdict.name().into(),
            method: "band of the run".into(),
        };
        Some(Line {
            case: format!("{name} {}", sets.join(" ")),
            path: result.name().into(),
            exact,
            holds: bar.holds(exact),
            bar,
            core_seconds: particles.core_seconds(),
            source: "boundary elements".into(),
        })
    };
    let force = other.entry().as_ref().and_then(time_of_impact);
    let force = force.and_then(|time| line(ResultName::PeakForce, largest_mean(&other, &reference.series, time)));
    let impulse = impulse(&other, &reference.series, particles.summary.time_end_s);
    Ok(force.into_iter().chain(line(ResultName::Impulse, impulse)).collect())
}

/// Times and upward force of a run.
fn force(scene: &Scene, series: &Series) -> [Vec<f64>; 2] {
    let times = series.times();
    let body = scene.body.as_ref().map_or("", |body| &body.name);
    let force = series.column(&format!("{body}.fy_N_per_m")).unwrap_or_else(|| vec![0.0; times.len()]);
    [times, force]
}

/// Impulse of a run up to a time [s].
fn impulse(scene: &Scene, series: &Series, end: f64) -> f64 {
    let [times, force] = force(scene, series);
    integral(&times, &force, end)
}

/// Largest mean of the force over a time [s].
fn largest_mean(scene: &Scene, series: &Series, over: f64) -> f64 {
    let [times, force] = force(scene, series);
    let up_to = |end: f64| integral(&times, &force, end);
    times.iter().map(|end| (up_to(*end) - up_to(end - over)) / over).fold(0.0, f64::max)
}

/// Integral of a curve up to a time, by trapezoids.
fn integral(times: &[f64], values: &[f64], end: f64) -> f64 {
    let mut sum = 0.0;
    for k in 1..times.len() {
        let length = times[k] - times[k - 1];
        let share = ((end - times[k - 1]) / length).clamp(0.0, 1.0);
        let last = values[k - 1] + share * (values[k] - values[k - 1]);
        sum += 0.5 * share * length * (values[k - 1] + last);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drops_are_the_same_for_a_seed_and_can_be_read() {
        let drops: Vec<_> = (0..200).map(|k| draw(7, k)).collect();
        assert_eq!(draw(7, 3), drops[3]);
        assert_ne!(draw(8, 3), drops[3]);
        read_all(&drops).expect("scenes");
    }

    #[test]
    fn a_ramp_is_integrated_up_to_a_time_between_its_points() {
        let times: Vec<f64> = (0..=10).map(|k| 0.1 * f64::from(k)).collect();
        let values: Vec<f64> = times.iter().map(|t| 2.0 * t).collect();
        assert!((integral(&times, &values, 0.55) - 0.55 * 0.55).abs() < 1e-12);
    }
}
