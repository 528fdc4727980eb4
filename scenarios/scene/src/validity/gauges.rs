//! What a gauge of a scene reads wrongly, before the run.

use settings::significant;

use crate::bottom::Bottom;
use crate::impact::Entry;
use crate::keys::{Gauge, GaugeFrame, Scene, Symmetry};

/// Samples in a period of a gauge's bandwidth.
const SAMPLES_PER_PERIOD: f64 = 5.0;
/// A gauge so near to the floor, at the foot of a wall, reads too much where weakly compressible water arrives [spacings].
const FOOT: f64 = 4.0;
/// The pressure rises so far ahead of the spray root, at most: a gauge at 10 degrees [spacings].
const EARLY: f64 = 4.0;
/// A share of a gauge's time of arrival that is reported [-].
const REPORTED: f64 = 0.1;

/// Gauges so near to the keel that the pressure rises notably before the spray root is there.
fn early_arrivals(scene: &Scene) -> Vec<String> {
    let straight = |entry: &Entry| !entry.is_flat() && matches!(entry.bottom, Bottom::Wedge { .. });
    let Some(entry) = scene.entry().filter(straight).filter(|_| !scene.model.is_theory()) else { return Vec::new() };
    let early = |gauge: &Gauge| {
        let share = EARLY * scene.resolution.spacing / gauge.at[0].abs();
        let passed = gauge.on == GaugeFrame::Body && gauge.at[0].abs() < entry.half_breadth;
        (passed && share > REPORTED && share < 1.0).then(|| {
            format!(
                "gauge `{}` is {} spacings from the keel: the pressure rises up to {EARLY} spacings ahead of the spray root, {:.0} % of \
                 its time of arrival",
                gauge.name,
                significant(gauge.at[0].abs() / scene.resolution.spacing),
                100.0 * share
            )
        })
    };
    scene.gauges.iter().filter_map(early).collect()
}

/// Gauges at the foot of a wall in weakly compressible water.
fn feet_of_walls(scene: &Scene) -> Vec<String> {
    let tank = &scene.tank;
    if tank.water_width >= tank.width || scene.solver.is_incompressible() || scene.model.is_theory() {
        return Vec::new();
    }
    let near = FOOT * scene.resolution.spacing;
    let at_foot = |gauge: &&Gauge| {
        let [x, y] = gauge.at;
        gauge.on == GaugeFrame::Fixed && 0.5 * tank.width - x.abs() < near && y + tank.depth < near
    };
    let warned = |gauge: &Gauge| {
        format!(
            "gauge `{}` is at the foot of a wall: where moving water arrives, weakly compressible water reads 10 to 25 % too much impulse \
             there and a peak that is noise; solver = \"incompressible\" does not",
            gauge.name
        )
    };
    scene.gauges.iter().filter(at_foot).map(warned).collect()
}

/// Gauges and levels in the water that a beach damps (THEORY WA15).
fn on_beach(scene: &Scene) -> Vec<String> {
    let Some(beach) = scene.beach() else { return Vec::new() };
    let both = scene.symmetry == Symmetry::X;
    let is_damped = |x: f64| if both { x.abs() > beach.from } else { x > beach.from };
    let warned = |what: String| {
        format!(
            "{what} is on the beach, from x = {} m on, where the water is braked: it shows no wave of the tank",
            significant(beach.from)
        )
    };
    let gauges = scene.gauges.iter().filter(|gauge| gauge.on == GaugeFrame::Fixed && is_damped(gauge.at[0]));
    let levels = scene.observe.level.iter().enumerate().filter(|(_, x)| is_damped(**x));
    let gauges = gauges.map(|gauge| warned(format!("gauge `{}`", gauge.name)));
    gauges.chain(levels.map(|(k, x)| warned(format!("observe.level[{k}] = {x} m")))).collect()
}

/// Warnings about what gauges read wrongly.
pub(crate) fn gauge_warnings(scene: &Scene) -> Vec<String> {
    [early_arrivals(scene), feet_of_walls(scene), on_beach(scene)].concat()
}

/// A filtered curve is shown whole by samples at more than twice its bandwidth (Shannon 1949); 5 times for its shape.
pub(crate) fn coarse_samples(scene: &Scene, gauge: &Gauge) -> Option<String> {
    let (bandwidth, every) = (gauge.bandwidth?, scene.time.sample_every);
    (every * bandwidth > 1.0 / SAMPLES_PER_PERIOD).then(|| {
        format!(
            "{} has a bandwidth of {} Hz and is sampled at {} Hz: the filter sees every step, but the series misses peaks; \
             {} s would do for time.sample_every",
            gauge.name,
            significant(bandwidth),
            significant(1.0 / every),
            significant(1.0 / (SAMPLES_PER_PERIOD * bandwidth))
        )
    })
}

#[cfg(test)]
mod tests {
    use crate::load;

    #[test]
    fn an_early_arrival_is_reported() {
        let warned = |at: &str| {
            let gauge = format!("gauges=[{{ name = 'g', at = {at} }}]");
            let warnings = load("wedge_constant", &[gauge]).expect("a scene").warnings;
            warnings.iter().any(|w| w.contains("ahead of the spray root"))
        };
        let slope = 30.0_f64.to_radians().tan();
        assert!(warned(&format!("[0.3, {}]", 0.3 * slope)));
        assert!(!warned(&format!("[2.0, {}]", 2.0 * slope)));
    }

    /// The beach of `wave_maker` begins its length before the right wall.
    #[test]
    fn a_gauge_on_the_beach_is_reported() {
        let scene = load("wave_maker", &[]).expect("a scene").scene;
        let from = scene.beach().expect("a beach").from;
        let warned = |x: f64| {
            let sets =
                [format!("gauges=[{{ name = 'g', on = 'fixed', at = [{x}, -0.05] }}]"), format!("observe.level=[{x}]")];
            let warnings = load("wave_maker", &sets).expect("a scene").warnings;
            ["gauge `g` is on the beach", "observe.level[0]"].map(|words| warnings.iter().any(|w| w.contains(words)))
        };
        assert_eq!(warned(from + 0.1), [true, true]);
        assert_eq!(warned(from - 0.1), [false, false]);
    }

    #[test]
    fn the_foot_of_a_wall_is_reported() {
        let warned = |at: &str, solver: &str| {
            let gauge = format!("gauges=[{{ name = 'p3', on = 'fixed', at = {at} }}]");
            let warnings = load("dam_break_lobovsky", &[gauge, solver.to_string()]).expect("a scene").warnings;
            warnings.iter().any(|w| w.contains("foot of a wall"))
        };
        assert!(warned("[0.805, -0.297]", "solver=weakly_compressible"));
        assert!(!warned("[0.805, -0.297]", "solver=incompressible"));
        assert!(!warned("[0.805, -0.22]", "solver=weakly_compressible"));
    }
}
