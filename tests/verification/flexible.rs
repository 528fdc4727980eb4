//! Bodies with panels: what they must do whatever the water does.

use evidence::systems::{advance, of_text, scene, system};
use fsi_coupling::{Body, Coupled};

/// A wedge with a bottom plate, coarse, for the first part of its entry.
const WEDGE: [&str; 3] = ["resolution.spacing=0.012", "time.end=0.006", "tank.height=3.0"];

fn body(system: &Coupled) -> &dyn Body {
    system.bodies().find(|body| body.motion().is_some()).expect("a body")
}

fn position_and_speed(system: &Coupled) -> [f64; 2] {
    let motion = body(system).motion().expect("a motion");
    [motion.position[1], motion.velocity[1]]
}

fn deflection(system: &Coupled, panel: usize, place: usize) -> f64 {
    body(system).panels()[panel].watched[place].deflection
}

/// A panel that hardly bends moves with its frame as a rigid body of the same mass does: one is finite elements under the
/// trapezoidal rule, the other rapier.
#[test]
fn a_stiff_panel_on_a_light_frame_moves_as_the_rigid_body() {
    let stiff = [&WEDGE[..], &["body.panels[0].youngs_modulus=1e12", "body.panels[0].thickness=0.03"]].concat();
    let mut flexible = system("flexible_wedge", &stiff);
    let panels = 2.0 * 0.03 * 2700.0 * 0.3_f64.hypot(0.109191);
    let text = scene("flexible_wedge", &WEDGE).to_toml();
    let rigid_text = &text[..text.find("[[body.panels]]").expect("a panel")];
    let rest = &text[text.find("[observe]").expect("what follows the body")..];
    let rigid_text = format!("{rigid_text}\n{rest}").replace("damping = [0.0, 0.0]\n", "");
    let mut rigid = of_text(&rigid_text, &[&format!("body.mass={}", 40.0 + panels), "coupling.scheme=added_mass"]);
    advance(&mut flexible, 0.006, |_| ()).expect("a stable run");
    advance(&mut rigid, 0.006, |_| ()).expect("a stable run");
    let (ours, theirs) = (position_and_speed(&flexible), position_and_speed(&rigid));
    println!("flexible {ours:?}, rigid {theirs:?}");
    assert!(theirs[1] > -3.9, "the wedge is slowed down: {theirs:?}");
    assert!((ours[0] - theirs[0]).abs() < 1e-5 && (ours[1] / theirs[1] - 1.0).abs() < 1e-3, "{ours:?} {theirs:?}");
}

/// The half x > 0 with its image bends as the whole does.
#[test]
fn a_half_bends_as_the_whole() {
    let mut half = system("flexible_wedge", &WEDGE);
    let text = scene("flexible_wedge", &WEDGE).to_toml().replace("symmetry = \"x\"", "symmetry = \"none\"");
    let start = text.find("[[body.panels]]").expect("a panel");
    let end = text.find("[observe]").expect("what follows the body");
    let left = text[start..end]
        .replace("name = \"plate\"", "name = \"left\"")
        .replace("to = [0.3, 0.109191]", "to = [0.0, 0.0]")
        .replace("from = [0.0, 0.0]", "from = [-0.3, 0.109191]");
    let text = format!("{}{left}{}", &text[..end], &text[end..]);
    let mut whole = of_text(&text, &[]);
    advance(&mut half, 0.006, |_| ()).expect("a stable run");
    advance(&mut whole, 0.006, |_| ()).expect("a stable run");
    let (ours, theirs) = (position_and_speed(&half), position_and_speed(&whole));
    let bent = [deflection(&half, 0, 1), deflection(&whole, 0, 1), deflection(&whole, 1, 1)];
    println!("half {ours:?}, whole {theirs:?}, deflections {bent:?} m");
    assert!(bent[0] > 1e-4, "the plate bends: {bent:?}");
    assert!((ours[1] / theirs[1] - 1.0).abs() < 5e-4, "{ours:?} {theirs:?}");
    assert!((bent[1] / bent[0] - 1.0).abs() < 1e-3 && (bent[2] / bent[0] - 1.0).abs() < 1e-3, "{bent:?}");
}

/// Work that the water does arrives; it becomes motion, strain and what damping takes; momentum closes: panel and free frame
/// together, in every scheme.
#[test]
fn work_and_momentum_close_in_every_scheme() {
    for scheme in ["weak", "added_mass", "iqn_ils"] {
        let set = format!("coupling.scheme={scheme}");
        let mut system = system("flexible_wedge", &[&WEDGE[..], &["body.panels[0].thickness=0.01", &set]].concat());
        let held = |s: &Coupled| {
            let e = body(s).energy();
            (e.kinetic + e.potential + e.elastic + e.dissipated, e.work + e.support)
        };
        let (start, _) = held(&system);
        advance(&mut system, 0.006, |_| ()).expect("a stable run");
        let ((end, done), audit) = (held(&system), system.work_audit(0));
        let gap = (end - start - done) / audit.exchanged;
        println!(
            "{scheme}: work {:.3e} J/m, lost on the way {:.1e}, in the body {gap:.1e}",
            audit.given,
            audit.residual()
        );
        assert!(audit.exchanged > 1.0 && audit.residual() < 2e-3, "{scheme}: {audit:?}");
        assert!(gap.abs() < 1e-9, "{scheme}: {gap}");
        assert!(system.momentum_audit().worst < 1e-10, "{scheme}: {}", system.momentum_audit().worst);
    }
}

/// A step that is taken back and taken again gives the same bits, of water, plate and frame.
#[test]
fn a_step_taken_again_gives_the_same_bits() {
    let mut system = system("flexible_wedge", &WEDGE);
    advance(&mut system, 0.004, |_| ()).expect("a stable run");
    let dt = 0.5 * system.stable_dt().expect("a step");
    let bits = |s: &Coupled| {
        let motion = body(s).motion().expect("a motion");
        let p = s.fluid.particles();
        let sum: f64 = p.x.iter().zip(&p.rho).map(|(x, rho)| x * rho).sum();
        [motion.position[1], motion.velocity[1], deflection(s, 0, 0), deflection(s, 0, 2), sum].map(f64::to_bits)
    };
    system.checkpoint();
    for _ in 0..3 {
        system.step(dt).expect("a stable step");
    }
    let first = bits(&system);
    system.restore();
    assert_ne!(first, bits(&system));
    for _ in 0..3 {
        system.step(dt).expect("a stable step");
    }
    assert_eq!(first, bits(&system));
}

/// A gauge's place is where the plate has taken it.
#[test]
fn a_gauge_rides_on_its_panel() {
    let mut system = system("hydrostatic_plate", &["time.end=0.05", "resolution.spacing=0.06"]);
    advance(&mut system, 0.05, |_| ()).expect("a stable run");
    let (surface, _) = body(&system).material_point([0.0, 0.2]).expect("a panel");
    let sunk = -2.0 - surface.at[1];
    let shown = deflection(&system, 0, 0);
    assert!(shown > 1e-5 && (sunk / shown - 1.0).abs() < 1e-6, "{sunk} {shown}");
    assert!(surface.normal[1] > 0.99);
}

/// A plate that yields keeps a dent and its energy still closes; the same plate, elastic, comes back.
#[test]
fn a_plate_that_yields_keeps_a_dent() {
    let end = |sets: &[&str]| {
        let mut system = system("flexible_wedge", &[&WEDGE[..], sets].concat());
        let held = |s: &Coupled| {
            let e = body(s).energy();
            e.kinetic + e.potential + e.elastic + e.dissipated - e.work - e.support
        };
        let start = held(&system);
        advance(&mut system, 0.006, |_| ()).expect("a stable run");
        let panel = body(&system).panels().remove(0);
        (panel, (held(&system) - start) / system.work_audit(0).exchanged)
    };
    let (elastic, _) = end(&[]);
    let soft = ["body.panels[0].yield_stress=30e6", "body.panels[0].hardening_modulus=1e9"];
    let (yielding, gap) = end(&soft);
    println!("elastic {:?}\nyielding {:?}, energy gap {gap:.1e}", elastic.worst, yielding.worst);
    assert_eq!(elastic.worst.plastic_curvature, 0.0);
    assert!(elastic.worst.stress.largest() > 40e6, "the load is beyond the yield stress: {:?}", elastic.worst.stress);
    assert!(yielding.worst.plastic_curvature > 0.02 && yielding.worst.allowed == Some(false));
    assert!(yielding.worst.strain.largest() > elastic.worst.strain.largest());
    assert!(gap.abs() < 1e-6, "{gap}");
}

/// An end that is strained too far breaks off: it is said when and where, what is free keeps its momentum, and the run goes on;
/// taken back, it is whole again.
#[test]
fn an_end_that_is_strained_too_far_breaks_off() {
    let mut system = system("flexible_wedge", &[&WEDGE[..], &["body.panels[0].rupture_strain=3e-4"]].concat());
    let ruptures = |s: &Coupled| body(s).panels()[0].ruptures.clone();
    while ruptures(&system).is_empty() {
        assert!(system.fluid.time() < 0.006, "nothing broke");
        system.checkpoint();
        let dt = system.stable_dt().expect("a step");
        system.step(dt).expect("a stable step");
    }
    let first = ruptures(&system)[0];
    println!("{first:?}");
    assert!(first.value > 3e-4 && (first.time - system.fluid.time()).abs() < 1e-12);
    system.restore();
    assert!(ruptures(&system).is_empty());
    let end = system.fluid.time() + 2e-4;
    advance(&mut system, end, |_| ()).expect("a stable run");
    assert_eq!(ruptures(&system)[0], first);
    assert!(system.momentum_audit().worst < 1e-10, "{}", system.momentum_audit().worst);
}

/// What has broken off still weighs what it weighed: weight and potential energy close through a rupture.
#[test]
fn a_rupture_changes_neither_weight_nor_energy() {
    let mut system =
        system("flexible_wedge", &[&WEDGE[..], &["body.panels[0].rupture_strain=3e-4", "time.start=0"]].concat());
    let held = |s: &Coupled| {
        let e = body(s).energy();
        e.kinetic + e.potential + e.elastic + e.dissipated - e.work - e.support
    };
    let start = held(&system);
    advance(&mut system, 0.001, |_| ()).expect("a stable run");
    assert!(!body(&system).panels()[0].ruptures.is_empty());
    let gap = (held(&system) - start) / system.work_audit(0).exchanged;
    println!("gap {gap:.1e} of {:.2} J/m", system.work_audit(0).exchanged);
    assert!(gap.abs() < 1e-6, "{gap}");
}

/// BE13: damping by mass damps the bending of the panels alone. A wedge that falls in the air falls freely, and in the water the
/// momentum of both closes.
#[test]
fn damping_by_mass_does_not_brake_the_body() {
    let damped = [&WEDGE[..], &["body.damping=[10.0, 0.0]"]].concat();
    let mut falling = system("flexible_wedge", &[&damped[..], &["body.position=[0.0, 0.5]", "time.start=0"]].concat());
    let (start, [from, speed]) = (falling.fluid.time(), position_and_speed(&falling));
    advance(&mut falling, 0.006, |_| ()).expect("a stable run");
    let (time, [to, end]) = (falling.fluid.time() - start, position_and_speed(&falling));
    println!("{speed} m/s and {end} m/s after {time} s, {} m", to - from);
    assert!((end - speed + 9.81 * time).abs() < 1e-10, "{speed} m/s and {end} m/s");
    assert!(falling.momentum_audit().worst < 1e-10, "{}", falling.momentum_audit().worst);
    let mut entering = system("flexible_wedge", &damped);
    advance(&mut entering, 0.006, |_| ()).expect("a stable run");
    assert!(deflection(&entering, 0, 1) > 1e-4, "the plate bends");
    assert!(entering.momentum_audit().worst < 1e-10, "{}", entering.momentum_audit().worst);
}

/// A guided end holds rotation and deflection like a clamped one, and lets the panel slide: a thin plate under water carries no
/// membrane force and sinks deeper; a thick one, whose deflection is small, sinks as far.
#[test]
fn a_guided_end_carries_no_membrane_force() {
    let sunk = |ends: &str, thickness: &str, modulus: &str| {
        let sets = ["solver=incompressible", "time.end=0.05", ends, thickness, modulus];
        let mut system = system("hydrostatic_plate", &sets);
        let mut most = 0.0_f64;
        advance(&mut system, 0.05, |s| most = most.max(deflection(s, 0, 0).abs())).expect("a stable run");
        (most, body(&system).panels().remove(0).worst)
    };
    let [clamped, guided] =
        ["body.panels[0].ends=[\"clamped\", \"clamped\"]", "body.panels[0].ends=[\"clamped\", \"guided\"]"];
    let thin = ["body.panels[0].thickness=0.01", "body.panels[0].youngs_modulus=3e10"];
    let [(held, of_held), (free, of_free)] = [clamped, guided].map(|ends| sunk(ends, thin[0], thin[1]));
    println!("clamped {held} m, {:?}; guided {free} m, {:?}", of_held.normal, of_free.normal);
    let [pull, none] = [of_held.normal.largest(), of_free.normal.largest()];
    assert!(none < 0.02 * pull && free > 1.1 * held, "{none} N/m of {pull} N/m, {free} m and {held} m");
    let [ours, theirs] = [of_free.moment.largest(), of_held.moment.largest()];
    assert!(ours > 0.7 * theirs, "the ends hold their rotation: {ours} N of {theirs} N");
    let thick = ["body.panels[0].thickness=0.05", "body.panels[0].youngs_modulus=67.5e9"];
    let [(held, _), (free, _)] = [clamped, guided].map(|ends| sunk(ends, thick[0], thick[1]));
    assert!((free / held - 1.0).abs() < 1e-3, "{free} m and {held} m");
}
