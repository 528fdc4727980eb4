//! The coupling schemes agree with each other, and a light box with Archimedes (THEORY CO4–CO9).

use evidence::light::{BREADTH, DRAUGHT, HEIGHT, light_box, settle};
use evidence::systems::{scene, system, take};
use fsi_coupling::{Coupled, CouplingError, Motion};
use run::build;

const STRONG: [&str; 2] = ["coupling.scheme=added_mass", "coupling.scheme=iqn_ils"];

fn motion(system: &Coupled) -> Motion {
    system.bodies().find_map(|body| body.motion()).expect("a body")
}

/// Everything that a step leaves behind, bit by bit.
fn bits(system: &Coupled) -> Vec<u64> {
    let (p, w, m) = (system.fluid.particles(), &system.walls, motion(system));
    let mut bits: Vec<u64> = p.id.iter().map(|id| u64::from(*id)).collect();
    for array in [&p.x, &p.y, &p.u, &p.v, &p.rho, &p.ax, &p.ay, &w.x, &w.y, &w.pressure, &w.fx, &w.mean_fy] {
        bits.extend(array.iter().map(|value| value.to_bits()));
    }
    for value in
        [m.position[0], m.position[1], m.angle, m.velocity[1], m.angular_velocity, m.force[1], system.fluid.time()]
    {
        bits.push(value.to_bits());
    }
    bits.push(system.momentum_audit().worst.to_bits());
    bits
}

/// Save, step on through remade neighbour lists, go back, step on: the same bits, twice; for every integrator, wall and
/// coupling that keeps something from step to step.
#[test]
fn steps_taken_back_come_again_to_the_same_bits() {
    let moving =
        ["resolution.spacing=0.033", "body.position=[0.0, 0.05]", "body.angle_deg=8", "body.velocity=[0.3, -1.0]"];
    let options: [&[&str]; 10] = [
        &[],
        &["fluid.integrator=predictor_corrector"],
        &["fluid.integrator=verlet"],
        &["fluid.integrator=beeman"],
        &["fluid.walls=dynamic"],
        &["fluid.walls=mirror_point"],
        &["fluid.wall_stretch=true", "fluid.density_filter=mls", "fluid.density_filter_every=3"],
        &["coupling.scheme=added_mass"],
        &["coupling.scheme=iqn_ils", "coupling.tolerance=1e-3"],
        &["coupling.scheme=iqn_ils"],
    ];
    for sets in options {
        let mut system = system("floating_box", &[&moving[..], sets].concat());
        take(&mut system, 20).expect("a stable run");
        system.checkpoint();
        let (rebuilds, mut steps) = (system.fluid.neighbours().rebuilds, 0);
        while system.fluid.neighbours().rebuilds < rebuilds + 2 {
            take(&mut system, 1).expect("a stable run");
            steps += 1;
        }
        let first = bits(&system);
        for _ in 0..2 {
            system.restore();
            take(&mut system, steps).expect("a stable run");
            assert!(bits(&system) == first, "{sets:?}: other bits");
        }
    }
}

/// A light tilted box, free in all directions: the accelerations of one step, found at once or by iterations, are the same,
/// and those that its forces cause. Weak coupling has others. (Trial accelerations also bend the walls' path within the
/// step, by Δt²/8 of them at its middle: at once and by iterations differ by some 10⁻⁴.)
#[test]
fn the_three_ways_to_agree_find_the_same_accelerations() {
    let accelerations = |scheme: &str| {
        let sets = [
            "resolution.spacing=0.02",
            "body.mass=4",
            "body.position=[0.05, -0.2]",
            "body.angle_deg=20",
            "body.inertia=0.0667",
        ];
        let tight: &[&str] = if scheme.ends_with("iqn_ils") { &["coupling.tolerance=1e-10"] } else { &[] };
        let mut system = system("floating_box", &[&sets[..], &[scheme], tight].concat());
        take(&mut system, 3).expect("three steps");
        let (m, agreement) = (motion(&system), system.statistics());
        println!("{scheme}: {:?} {:?}", m.acceleration, agreement);
        assert!(system.momentum_audit().worst < 1e-12);
        ([m.acceleration[0], m.acceleration[1], m.angular_velocity], agreement)
    };
    let [(at_once, solved), (newton, iterated)] = STRONG.map(accelerations);
    assert!(solved.worst_residual < 1e-12, "{solved:?}");
    assert!(iterated.most_iterations <= 6, "{iterated:?}");
    for k in 0..3 {
        assert!((newton[k] - at_once[k]).abs() < 5e-4 * at_once[1].abs(), "{newton:?} {at_once:?}");
    }
    let (_, weak) = accelerations("coupling.scheme=weak");
    assert!(weak.worst_residual > 0.1, "{weak:?}");
}

/// A step that does not agree in time is an error that says when and by how much.
#[test]
fn a_step_that_does_not_converge_is_an_error() {
    let sets = ["body.mass=4", "body.position=[0.05, -0.2]", "coupling.scheme=iqn_ils", "coupling.max_iterations=2"];
    let refused = build::build(&scene("floating_box", &sets)).map(|_| ());
    let Err(CouplingError::NotConverged { iterations, residual, tolerance, time }) = refused else {
        panic!("two iterations are too few for three unknowns: {refused:?}");
    };
    assert_eq!((iterations, tolerance, time), (2, 1e-6, 0.0));
    assert!(residual > tolerance);
}

/// Where weak coupling is stable the schemes agree: velocity lost and largest force of two wedges, within 0.1 %.
#[test]
fn wedges_do_not_notice_the_scheme() {
    for name in ["wedge", "wedge25"] {
        let run = |scheme: &str| {
            let mut system = system(name, &["resolution.spacing=0.02", "fluid.acoustic_steps=1", scheme]);
            let (start, mut peak) = (motion(&system).velocity[1], 0.0_f64);
            evidence::systems::advance(&mut system, 0.02, |s| peak = peak.max(motion(s).force[1]))
                .expect("a stable run");
            println!("{name} {scheme} {:?} momentum {:.1e}", system.statistics(), system.momentum_audit().worst);
            [motion(&system).velocity[1] - start, peak]
        };
        let weak = run("coupling.scheme=weak");
        for scheme in STRONG {
            let found = run(scheme);
            for k in 0..2 {
                let gap = (found[k] / weak[k] - 1.0).abs();
                println!("   {k}: {} {} {gap:.2e}", found[k], weak[k]);
                assert!(gap < 1e-3, "{name}, {scheme}: {found:?}, weak {weak:?}");
            }
        }
    }
}

/// A box of a twentieth of the water's density that starts afloat at its draught stays there, within 2 % of two spacings'
/// draught and of four's; momentum closes, and energy within 2 % of its weight times its draught. (In disordered water: see `stability`.)
#[test]
fn a_light_box_floats_at_its_draught() {
    let depth = 0.12;
    for (spacing, end) in [(0.01, 0.4), (0.005, 0.2)] {
        for scheme in STRONG {
            let (centre, weighed) = (0.5 * HEIGHT - DRAUGHT, 9.81 * 1000.0 * BREADTH * DRAUGHT * DRAUGHT); // m g T
            let mut system = light_box(centre, depth, spacing, &[scheme, "fluid.kinematic_viscosity=0.02"]);
            let rest = settle(&mut system, depth, spacing, [0.7 * end, end]);
            let (momentum, lost) = (system.momentum_audit().worst, system.energy_drift());
            println!(
                "{spacing} {scheme}: {:.4} of exact, swing {:.4}, {:?}, momentum {momentum:.0e}, energy {lost:.5} J/m",
                rest.draught / DRAUGHT,
                rest.swing / DRAUGHT,
                system.statistics()
            );
            assert!((rest.draught / DRAUGHT - 1.0).abs() < 0.02, "{scheme}: {} m", rest.draught);
            assert!(momentum < 1e-10, "{scheme}: momentum {momentum}");
            assert!(lost.abs() < 0.02 * weighed, "{scheme}: energy {lost} J/m of {weighed}");
        }
    }
}
