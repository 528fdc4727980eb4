//! A tank with a piston and a beach (THEORY WA13–WA15): still water stays still, both audits close, the beach keeps the waves.

use evidence::systems::{advance, scene, system};
use run::{RunOptions, build, run};
use sph_core::state_bytes::StateError;

/// A short tank: waves of 3 m, four of them before a beach of two.
const SHORT: [&str; 5] = [
    "tank.width=18",
    "resolution.spacing=0.05",
    "time.end=20",
    "observe.level=[-3.0, 0.0, 1.8, 2.25, 2.55]",
    "time.sample_every=0.04",
];

/// Both solvers, with the acoustic steps and the speed of sound for waves.
const SOLVERS: [&[&str]; 2] = [&[], &["solver=weakly_compressible", "fluid.sound_speed=15", "fluid.acoustic_steps=4"]];

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    SHORT.iter().chain(more).copied().collect()
}

/// A beach in still water absorbs no more than 2 % of what a wave as high as a spacing holds, ½ρgΔx² per metre, and no particle leaves
/// its place.
#[test]
fn still_water_with_a_beach_stays_still() {
    for solver in [&[][..], &["solver=incompressible"]] {
        let sets = [&["resolution.spacing=0.05", "tank.beach={ length = 0.5 }"][..], solver].concat();
        let mut system = system("hydrostatic_tank", &sets);
        let top = |s: &fsi_coupling::Coupled| s.fluid.particles().y.iter().copied().fold(f64::MIN, f64::max);
        let before = top(&system);
        advance(&mut system, 1.0, |_| {}).expect("a stable run");
        let taken = system.absorbed().energy;
        let ripple = 0.5 * 1000.0 * 9.81 * 0.05 * 0.05;
        println!("{solver:?}: absorbed {taken} J/m, ripple {ripple} J/m");
        assert!((0.0..0.02 * ripple).contains(&taken), "{solver:?}: absorbed {taken} J/m");
        assert!((top(&system) - before).abs() < 0.0125, "{solver:?}: level {} m", top(&system));
        assert!(system.momentum_audit().worst < 1e-10);
    }
}

/// Momentum closes to rounding with piston and beach, so does the work of the piston, and no water is behind it. The energy that
/// neither holds is a share of the work; waves of 1.8 spacings gain 3 % of it (incompressible) and 8 %.
#[test]
fn audits_close_with_a_piston_and_a_beach() {
    for solver in SOLVERS {
        let mut system = system(
            "wave_maker",
            &[&["tank.width=6", "tank.beach.length=3", "observe.level=[]", "resolution.spacing=0.05"][..], solver]
                .concat(),
        );
        advance(&mut system, 8.0, |_| {}).expect("a stable run");
        let (work, taken) = (-system.work_audit(0).received, system.absorbed());
        let drift = system.energy_drift();
        println!("{solver:?}: work {work}, absorbed {taken:?}, drift {drift}");
        assert!(system.momentum_audit().worst < 1e-10, "{solver:?}: momentum {:e}", system.momentum_audit().worst);
        assert!(system.work_audit(0).residual() < 1e-10, "{solver:?}: work {:e}", system.work_audit(0).residual());
        assert_eq!(system.penetration().count, 0, "{solver:?}");
        assert!(work > 0.0 && taken.energy > 0.1 * work, "{solver:?}: {taken:?} of {work} J/m");
        assert!(drift < 0.1 * work && drift > -0.4 * work, "{solver:?}: drift {drift} of {work} J/m");
    }
}

/// A state that was stored goes on with the same bits in a tank that was made again.
#[test]
fn a_stored_wave_tank_goes_on_with_the_same_bits() -> Result<(), StateError> {
    for solver in SOLVERS {
        let sets =
            [&["tank.width=4", "tank.beach.length=2", "observe.level=[]", "resolution.spacing=0.05"][..], solver]
                .concat();
        let (mut first, mut second) = (system("wave_maker", &sets), system("wave_maker", &sets));
        advance(&mut first, 1.0, |_| {}).expect("a stable run");
        second.restore_bytes(&first.to_bytes())?;
        for tank in [&mut first, &mut second] {
            advance(tank, 1.3, |_| {}).expect("a stable run");
        }
        let bits = |tank: &fsi_coupling::Coupled| {
            let p = tank.fluid.particles();
            let sums = [tank.absorbed().energy, tank.energy_drift(), tank.work_audit(0).received];
            [&p.x[..], &p.y, &p.u, &p.v, &p.rho, &sums].concat().iter().map(|x| x.to_bits()).collect::<Vec<_>>()
        };
        assert!(bits(&first) == bits(&second), "{solver:?}");
    }
    Ok(())
}

/// The beach sends back less than 5 % of the waves.
#[test]
fn a_beach_of_two_wavelengths_sends_back_less_than_five_per_cent() {
    let outcome =
        run(&scene("wave_maker", &with(&["resolution.spacing=0.06"])), &RunOptions::default()).expect("a run");
    let waves = outcome.summary.waves.expect("waves of a wave maker");
    let reflection = waves.reflection.expect("three gauges");
    println!("{reflection}, {:?}", waves.phase_speed_ratio);
    assert!(reflection < 0.05, "reflection {reflection}");
    assert!((waves.phase_speed_ratio.expect("gauges") - 1.0).abs() < 0.03);
}

/// A run that ends before full waves have passed the gauges gives heights, and no reflection, speed or loss.
#[test]
fn a_short_run_gives_no_reflection() {
    let outcome = run(&scene("wave_maker", &with(&["time.end=6.5"])), &RunOptions::default()).expect("a run");
    let waves = outcome.summary.waves.expect("waves of a wave maker");
    let ratios = [waves.reflection, waves.phase_speed_ratio, waves.decay_per_length];
    assert!(!waves.gauges.is_empty() && ratios == [None; 3], "{waves:?}");
}

/// The scene's numbers are those of theory.
#[test]
fn a_scene_takes_its_waves_from_their_length_or_period() {
    let by_length = scene("wave_maker", &[]);
    let wave = by_length.wave().expect("a wave maker");
    let set = format!("tank.wave_maker={{ height = 0.075, period = {} }}", wave.period());
    let by_period = scene("wave_maker", &[&set]).wave().expect("a wave maker");
    assert!((by_period.length() - 3.0).abs() < 1e-12);
    let tank = build::build(&by_length).expect("a tank");
    assert_eq!(tank.absorbed().energy, 0.0);
}
