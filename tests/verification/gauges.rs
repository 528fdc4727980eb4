//! Gauges of a length and a bandwidth (THEORY GE3, GE4), in water at rest.

use evidence::systems::scene;
use run::observers::LowPass;
use run::{Outcome, RunOptions, run};

/// Half depth of the tank [m] times ρ g: the mean pressure of every gauge centred there [Pa].
const MEAN: f64 = 1000.0 * 9.81 * 0.5;

fn tank(sets: &[&str]) -> Outcome {
    run(&scene("hydrostatic_tank", sets), &RunOptions::default()).expect("a run")
}

/// Means over the last fifth of the run [Pa].
fn mean(outcome: &Outcome, gauge: &str) -> f64 {
    outcome.summary.means[&format!("{gauge}.p_Pa")]
}

/// Water at rest: a gauge of any length on a wall shows the pressure at its middle, that of the floor ρ g H, to 0.4 %.
/// Measured: 0.12 % (0.1 m long), 0.29 % (0.6 m), 0.31 % (floor). On a lattice the half kernel of GE2 sums up to 1.003 on
/// average along a wall, whatever the spacing: that is the reading's bias and not the averaging's.
/// As its length goes to 0 it shows what the point shows. It says the length that a corner leaves it.
#[test]
fn a_gauge_shows_the_mean_pressure_over_its_length() {
    let gauges = "gauges=[
        { name = 'point', on = 'fixed', at = [0.5, -0.5] },
        { name = 'tiny', on = 'fixed', at = [0.5, -0.5], length = 1e-9 },
        { name = 'short', on = 'fixed', at = [0.5, -0.5], length = 0.1 },
        { name = 'long', on = 'fixed', at = [0.5, -0.5], length = 0.6 },
        { name = 'left', on = 'fixed', at = [-0.5, -0.5], length = 0.3 },
        { name = 'floor', on = 'fixed', at = [0.0, -1.0], length = 0.5 },
        { name = 'corner', on = 'fixed', at = [0.5, -0.9], length = 0.4 }]";
    let outcome = tank(&[gauges, "time.end=1.0"]);
    for (gauge, exact) in [("short", MEAN), ("long", MEAN), ("left", MEAN), ("floor", 2.0 * MEAN)] {
        let error = mean(&outcome, gauge) / exact - 1.0;
        assert!(error.abs() < 0.004, "{gauge}: {:.3} %", 100.0 * error);
    }
    let (tiny, point) = (mean(&outcome, "tiny"), mean(&outcome, "point"));
    assert!((tiny / point - 1.0).abs() < 1e-6, "{tiny} Pa, {point} Pa");
    // from 0.7 to 1 m deep
    let (corner, exact) = (mean(&outcome, "corner"), 1.7 * MEAN);
    assert!((corner / exact - 1.0).abs() < 0.01, "{corner} Pa, {exact} Pa");
    let lengths = ["point", "long", "corner"].map(|g| outcome.summary.gauges[g].length_m);
    assert!(lengths.iter().zip([0.0, 0.6, 0.3]).all(|(a, b)| (a - b).abs() < 1e-9), "{lengths:?}");
}

/// The filter gets every step: its value at a time does not depend on the times at which it is read, and is that of
/// the formula for the unfiltered pressure of every step.
#[test]
fn a_filtered_gauge_does_not_alias() {
    let gauges = "gauges=[{ name = 'raw', on = 'fixed', at = [0.0, -1.0] },
        { name = 'slow', on = 'fixed', at = [0.0, -1.0], bandwidth = 20.0 }]";
    // still water does not move at first: a heavier fluid than its filling makes it ring
    let sets = [
        "resolution.spacing=0.05",
        "time.end=0.3",
        "tank.height=1.5",
        "body={ name = 'lid', shape = 'box', \
        breadth = 0.4, height = 0.4, mass = 100, free = ['y'], position = [0.0, 0.25], velocity = [0.0, -1.0] }",
    ];
    let run_with = |every: &str| tank(&[&sets[..], &[gauges, every]].concat());
    let (fine, coarse) = (run_with("time.sample_every=1e-7"), run_with("time.sample_every=0.05"));
    let column = |o: &Outcome, name: &str| o.series.column(name).expect("a column");
    let (times, raw, slow) = (fine.series.times(), column(&fine, "raw.p_Pa"), column(&fine, "slow.p_Pa"));
    assert_eq!(times.len() as u64, fine.summary.steps + 1, "a row a step");
    let mut filter = LowPass::new(20.0);
    for ((t, raw), slow) in times.iter().zip(&raw).zip(&slow) {
        filter.take(*t, *raw);
        assert!((filter.value() - slow).abs() < 1e-9 * MEAN, "t = {t}: {} {slow}", filter.value());
    }
    let rough = raw.iter().zip(&slow).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(rough > 0.02 * MEAN, "the filter has nothing to do: {rough} Pa");
    for (t, slow_then) in coarse.series.times().iter().zip(column(&coarse, "slow.p_Pa")) {
        let k = times.iter().position(|x| x == t).expect("the same steps");
        assert_eq!(slow[k], slow_then, "t = {t}");
    }
    // peak and impulse are of every step too, so they do not depend on the samples
    for (gauge, body) in [("slow", "lid.fy_N_per_m"), ("raw", "lid.ay_m_per_s2")] {
        assert_eq!(fine.summary.gauges[gauge], coarse.summary.gauges[gauge]);
        assert_eq!(fine.summary.peaks[body].value, coarse.summary.peaks[body].value);
    }
    let sampled = column(&coarse, "raw.p_Pa").into_iter().fold(0.0, f64::max);
    assert!(sampled < coarse.summary.gauges["raw"].peak_pa, "samples miss peaks");
}

/// Where half of the flow is simulated, the other half of a gauge's face reads the images: a face about the keel shows
/// what its right half shows.
#[test]
fn a_face_across_the_plane_of_symmetry_reads_both_halves() {
    let (radius, length) = (1.0_f64, 0.2);
    let angle = 0.25 * length / radius;
    let [x, y] = [radius * angle.sin(), radius * (1.0 - angle.cos())];
    let gauges = format!(
        "gauges=[{{ name = 'both', at = [0.0, 0.0], length = {length} }}, \
         {{ name = 'right', at = [{x}, {y}], length = {} }}]",
        0.5 * length
    );
    let sets = ["resolution.spacing=0.02", "time.end=0.01", "body.radius=1.0", &gauges];
    let scene = scene("fuselage_section", &sets);
    assert_eq!(scene.symmetry, scene::Symmetry::X);
    let outcome = run(&scene, &RunOptions::default()).expect("a run");
    let (both, right) = (mean(&outcome, "both"), mean(&outcome, "right"));
    assert!(right > 1000.0, "no impact: {right} Pa");
    assert!((both / right - 1.0).abs() < 0.01, "{both} Pa over both halves, {right} Pa over the right one");
}
