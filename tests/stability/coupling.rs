//! Coupling: where explicit coupling fails, and the schemes that hold there (THEORY CO4–CO10).

use evidence::light::{DRAUGHT, light_box, settle};
use evidence::systems::{advance, scene, system};
use scene::ExchangeRatio;
/// The schemes of `coupling.scheme`; all but the first hold for light bodies.
const SCHEMES: [&str; 3] = ["weak", "added_mass", "iqn_ils"];

/// Largest acceleration [m/s²] of a box of 0.1 m, ten spacings, in the first 0.05 s after its release under water, tilted
/// by ten degrees and free in all directions; infinite where the run broke down. And CO10's spectral radius.
fn released(density: f64, scheme: &str) -> (f64, f64) {
    let mass = 0.01 * density;
    let sets = [
        "body.breadth=0.1".to_string(),
        "body.height=0.1".to_string(),
        format!("body.mass={mass}"),
        format!("body.inertia={}", mass * 0.01 / 6.0),
        "body.position=[0.0, -0.15]".to_string(),
        "body.angle_deg=10".to_string(),
        "tank.width=0.4".to_string(),
        "tank.depth=0.3".to_string(),
        "resolution.spacing=0.01".to_string(),
        "resolution.packing=false".to_string(),
        "fluid.sound_speed=20".to_string(),
        format!("coupling.scheme={scheme}"),
    ];
    let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
    let radius = ExchangeRatio::of(&scene("floating_box", &sets)).expect("a free body").spectral_radius();
    let mut system = system("floating_box", &sets);
    let mut wildest = 0.0_f64;
    let ended = advance(&mut system, 0.05, |s| {
        let motion = s.bodies().find_map(|body| body.motion()).expect("a box");
        wildest = wildest.max(motion.acceleration[0].hypot(motion.acceleration[1]));
    });
    assert!(system.momentum_audit().worst < 1e-10, "{scheme}: momentum {}", system.momentum_audit().worst);
    (if ended.is_ok() { wildest } else { f64::INFINITY }, radius)
}

/// The stability map: density of the body over the water's × scheme. Failure: weak coupling, where half a layer of water has
/// more inertia than the body (CO10 above 1). Remedy: any other scheme, down to a thousandth of the water's density.
#[test]
fn weak_coupling_fails_where_the_estimate_says_and_the_others_nowhere() {
    for density in [1000.0, 300.0, 150.0, 120.0, 80.0, 50.0, 20.0, 5.0, 1.0] {
        let found = SCHEMES.map(|scheme| released(density, scheme));
        let radius = found[0].1;
        println!("{density:6} kg/m^3, ratio {radius:7.3}: {:.3e} {:.3e} {:.3e}", found[0].0, found[1].0, found[2].0);
        if radius > 1.2 {
            assert!(found[0].0 > 1e4, "{density} kg/m^3: weak coupling now survives, {} m/s^2", found[0].0);
        }
        for ((wildest, _), scheme) in found.iter().zip(SCHEMES) {
            let stable = scheme != "weak" || radius < 0.84;
            assert!(!stable || *wildest < 300.0, "{density} kg/m^3, {scheme}: up to {wildest} m/s^2");
        }
    }
}

/// A box of a twentieth of the water's density, released under water at two spacings: weak coupling breaks down at once;
/// with the others it floats up, leaves the water and falls back, and never meets more than a few hundred m/s².
#[test]
fn a_light_box_floats_up_and_out_where_weak_coupling_breaks_down() {
    let (depth, thick) = (0.5, "fluid.kinematic_viscosity=0.02");
    for spacing in [1.0 / 60.0, 1.0 / 70.0] {
        let mut weak = light_box(-0.25, depth, spacing, &[thick]);
        let ended = advance(&mut weak, 0.05, |_| ());
        let spin = weak.bodies().find_map(|body| body.motion()).expect("a box").acceleration;
        assert!(ended.is_err() || spin[0].hypot(spin[1]) > 1e4, "{spacing} m: weak coupling now survives, {spin:?}");
        for scheme in &SCHEMES[1..] {
            let scheme = format!("coupling.scheme={scheme}");
            let mut system = light_box(-0.25, depth, spacing, &[thick, &scheme]);
            let mut top = f64::NEG_INFINITY;
            let up = settle(&mut system, depth, spacing, [0.0, 0.6]);
            top = top.max(-up.least);
            let rest = settle(&mut system, depth, spacing, [0.8, 1.0]);
            let (momentum, lost) = (system.momentum_audit().worst, system.energy_drift());
            println!(
                "{spacing} {scheme}: {:?}, {:.0} m/s^2, bottom up to {top:.3} m over the water, draught {:.2} +- {:.2} of exact, \
                 momentum {momentum:.0e}, energy {lost:.1} J/m",
                system.statistics(),
                up.wildest,
                rest.draught / DRAUGHT,
                rest.swing / DRAUGHT
            );
            // as it falls back: 107 m/s^2 at one spacing with WC29, below 100 without; it leaps to the same height with both
            assert!(up.wildest < 400.0 && rest.wildest < 120.0, "{scheme}: {} then {} m/s^2", up.wildest, rest.wildest);
            assert!(top > 0.0, "{scheme}: the box stays in the water, {top} m");
            assert!(momentum < 1e-10 && lost < 0.0, "{scheme}: momentum {momentum}, energy {lost} J/m");
        }
    }
}

/// Failure: a light box in water that it has disordered floats too high by about half a spacing (disordered water stands off
/// the walls), whatever the scheme, weak coupling included where it is stable (heave only): dropped from 50 mm with a
/// draught of two spacings it stands 28 % too high, with one of four 14 %. Remedy: spacing; or let it down gently, see
/// `verification`.
#[test]
fn a_box_in_disordered_water_floats_too_high_whatever_the_scheme() {
    let (depth, spacing) = (0.2, 0.01);
    let draughts = ["weak", "added_mass", "iqn_ils"].map(|scheme| {
        let scheme = format!("coupling.scheme={scheme}");
        let sets = [scheme.as_str(), "fluid.kinematic_viscosity=0.02", "body.free=[\"y\"]"];
        let mut system = light_box(0.25, depth, spacing, &sets);
        let rest = settle(&mut system, depth, spacing, [0.8, 1.0]);
        println!(
            "{scheme}: {:.4} of exact, {:?}, momentum {:.0e}, energy {:.2} J/m",
            rest.draught / DRAUGHT,
            system.statistics(),
            system.momentum_audit().worst,
            system.energy_drift()
        );
        assert!(rest.wildest < 400.0 && system.momentum_audit().worst < 1e-10);
        rest.draught
    });
    for draught in draughts {
        assert!((draught / draughts[0] - 1.0).abs() < 0.01, "{draughts:?}: the schemes differ");
        let gap = (DRAUGHT - draught) / spacing;
        assert!((0.3..0.8).contains(&gap), "too high by {gap} spacings");
    }
}
