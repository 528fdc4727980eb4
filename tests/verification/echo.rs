//! Echoes: the tank that a scene gets by default is not felt before the end of the run.

use evidence::systems::scene;
use run::observers::SimilarityResult;
use run::{RunOptions, run};

/// The 30° wedge to Vt/Δx = 20 in a tank `factor` times as wide and deep as the default.
fn entry(factor: f64) -> SimilarityResult {
    let spacing = "resolution.spacing=0.05";
    let tank = scene("wedge_constant", &[spacing]).tank;
    let [width, depth] = [factor * tank.width, factor * tank.depth];
    let sets = [spacing, &format!("tank.width={width:?}"), &format!("tank.depth={depth:?}")];
    let summary = run(&scene("wedge_constant", &sets), &RunOptions::default()).expect("a run").summary;
    summary.similarity.expect("a wedge at constant speed")
}

/// A tank half as wide and deep again gives the same impulse to 0.2 %, and the same force over the last fifth of the
/// run, when an echo would be back, to the scatter of such short runs (1 %). Half a tank is felt: 0.7 % of the impulse,
/// 1.5 % of the late force.
#[test]
fn the_default_tank_sends_no_echo_before_the_end() {
    let [half, usual, wide] = [0.5, 1.0, 1.5].map(entry);
    let impulse = |s: &SimilarityResult| s.impulse_coefficient / usual.impulse_coefficient - 1.0;
    let force = |s: &SimilarityResult| s.force_coefficient / usual.force_coefficient - 1.0;
    assert!(impulse(&wide).abs() < 0.002, "impulse {:+.2} %", 100.0 * impulse(&wide));
    assert!(force(&wide).abs() < 0.01, "force {:+.2} %", 100.0 * force(&wide));
    assert!(impulse(&half) > 0.007, "half a tank: impulse {:+.2} %", 100.0 * impulse(&half));
    assert!(force(&half) > 0.015, "half a tank: force {:+.2} %", 100.0 * force(&half));
}
