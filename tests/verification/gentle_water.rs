//! Energy of gently moving water: it may be lost, and must not come from nowhere (THEORY WC10).

use evidence::statistics::mean;
use evidence::systems::scene;
use run::{RunOptions, run};

use crate::standing_wave::COARSE_WAVE;

fn energy(name: &str, sets: &[&str]) -> f64 {
    let outcome = run(&scene(name, sets), &RunOptions::default()).expect("a run");
    outcome.summary.audit.energy
}

/// Coarse waves: shifted at the surface they gained 83 and 87 % of the energy exchanged.
#[test]
fn waves_gain_no_energy() {
    let wave = COARSE_WAVE.audit.energy;
    let tank = energy("unlevel_tank", &["resolution.spacing=0.05"]);
    let shifted = energy("standing_wave", &["resolution.spacing=0.05", "fluid.shifting_at_surface=true"]);
    println!("{wave:+.3}, {tank:+.3}, shifted at the surface {shifted:+.3}");
    assert!(wave < 0.02 && tank < 0.02 && shifted > 0.5, "{wave:+.3} {tank:+.3} {shifted:+.3}");
}

/// Still water for twenty seconds: the gauges stay where they are.
#[test]
fn still_water_does_not_rise() {
    let outcome = run(&scene("hydrostatic_tank", &["time.end=20", "resolution.spacing=0.04"]), &RunOptions::default());
    let outcome = outcome.expect("a run");
    let curve = outcome.series.column("middle.p_Pa").expect("a gauge");
    let tenth = curve.len() / 10;
    let (early, late) = (mean(&curve[tenth..2 * tenth]), mean(&curve[curve.len() - tenth..]));
    println!("{early:.1} and {late:.1} Pa, energy {:+.3}", outcome.summary.audit.energy);
    assert!((late / early - 1.0).abs() < 0.003 && outcome.summary.audit.energy < 0.02, "{early} {late}");
}
