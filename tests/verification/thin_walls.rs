//! Thin walls (THEORY WA8–WA11): plates of any thickness, wet on both sides.

use evidence::plates::{DENSITY, GRAVITY, Submerged, face_forces, paddled, separated, sides};
use evidence::statistics::mean;
use evidence::systems::{advance, system, take};
use fsi_coupling::{Coupled, PrescribedBody, RigidBody2d, RigidSpec};
use rayon::ThreadPoolBuilder;
use sph_core::Probe;

const SPACING: f64 = 0.02;

/// ½ρgh² [N/m].
fn push(height: f64) -> f64 {
    0.5 * DENSITY * GRAVITY * height * height
}

/// Two still waters, 24 and 12 spacings deep, on the two sides of a plate that stands on the floor, a fifth of a spacing, one
/// spacing, two and a half thick: each face carries ½ρgh² within 1 % (measured: +0.3 to +0.7 %, as the tank's own walls do), gauges
/// on the faces at half depth read ρgh within 2 %, no particle changes sides or needs to be stopped, and the water stays at rest.
#[test]
fn a_plate_parts_two_still_waters() {
    let rows = [24, 12];
    for thickness in [0.2, 1.0, 2.5] {
        let mut system = separated(thickness, 16, rows, SPACING);
        let (before, depth) = (sides(&system), rows.map(|n| n as f64 * SPACING));
        let (mut forces, mut gauged, mut kinetic) = ([vec![], vec![]], [vec![], vec![]], 0.0_f64);
        advance(&mut system, 2.0, |s| {
            if s.fluid.time() < 1.0 {
                return;
            }
            kinetic = kinetic.max(s.fluid_energy().kinetic);
            let [left, right] = face_forces(s);
            forces[0].push(left);
            forces[1].push(-right);
            if s.fluid.steps() % 100 == 0 {
                let probe = Probe::new(&s.fluid);
                for (k, sign) in [(0, -1.0), (1, 1.0)] {
                    let at = [sign * 0.5 * thickness * SPACING, 0.5 * depth[k]];
                    gauged[k].push(probe.on_flat_face(at, [sign, 0.0], 0.0));
                }
            }
        })
        .expect("a stable run");
        for k in 0..2 {
            let force = mean(&forces[k]) / push(depth[k]) - 1.0;
            let gauge = mean(&gauged[k]) / (0.5 * DENSITY * GRAVITY * depth[k]) - 1.0;
            println!("t = {thickness}, face {k}: force {:+.2} %, gauge {:+.2} %", 100.0 * force, 100.0 * gauge);
            assert!(force.abs() < 0.01, "t = {thickness}, face {k}: force off by {:.2} %", 100.0 * force);
            assert!(gauge.abs() < 0.02, "t = {thickness}, face {k}: gauge off by {:.2} %", 100.0 * gauge);
        }
        println!("kinetic {kinetic:.2e} J/m, stopped {}", system.stopped());
        assert!(kinetic < 1e-5 * DENSITY * GRAVITY * depth[0].powi(2), "t = {thickness}: {kinetic:.2e} J/m");
        assert_eq!(sides(&system), before, "t = {thickness}: water changed sides");
        assert_eq!((system.stopped(), system.penetration().count), (0, 0), "t = {thickness}");
    }
}

/// A plate under still water, wet all around and free at both ends, carries no more than its buoyancy: within 2 % of what
/// one of its faces carries (measured: 0.1 to 0.9 %), and the water's mean speed stays within 4 % of √(gL) (measured: 2 to 3 %:
/// water that has lost its lattice next to a free end does not come to rest altogether).
#[test]
fn a_plate_under_still_water_carries_no_force() {
    for (thickness, turned) in [(0.2, 0.0), (0.2, 0.6), (1.0, 0.6)] {
        let plate = Submerged { thickness, cells: 12.0, turned, spacing: SPACING };
        let law = PrescribedBody::steady(plate.middle(), 0.0, [0.0; 2], 0.0);
        let body = PrescribedBody::new("plate", plate.outline(), false, law);
        let mut system = plate.with(Box::new(body), 30.0);
        let (mut forces, mut kinetic) = ([vec![], vec![]], vec![]);
        advance(&mut system, 2.0, |s| {
            if s.fluid.time() > 1.0 {
                let force = s.bodies().find_map(|b| b.motion()).expect("a plate").force;
                (0..2).for_each(|k| forces[k].push(force[k]));
                kinetic.push(s.fluid_energy().kinetic);
            }
        })
        .expect("a stable run");
        let length = 12.0 * SPACING;
        let (face, buoyancy) = (DENSITY * GRAVITY * length * length, DENSITY * GRAVITY * thickness * SPACING * length);
        let net = mean(&forces[0]).hypot(mean(&forces[1]) - buoyancy);
        let speed = (2.0 * mean(&kinetic) / system.fluid.mass()).sqrt() / (GRAVITY * length).sqrt();
        println!("t = {thickness}, {turned} rad: {net:.2} of {face:.0} N/m, speed {speed:.4}");
        assert!(net < 0.02 * face, "t = {thickness}, {turned} rad: {net:.2} N/m, one face carries {face:.0} N/m");
        assert!(speed < 0.04, "t = {thickness}, {turned} rad: water moves at {speed:.3} of √(gL)");
        assert_eq!(system.penetration().count, 0);
    }
}

/// A free plate, a fifth of a spacing thick and four times as heavy as its own volume of water, let go askew and turning.
fn falling() -> Coupled {
    let plate = Submerged { thickness: 0.2, cells: 12.0, turned: 0.6, spacing: SPACING };
    let length = 12.0 * SPACING;
    let mass = 20.0 * DENSITY * 0.2 * SPACING * length;
    let body = RigidBody2d::new(RigidSpec {
        name: "plate".into(),
        outline: plate.outline(),
        mass,
        inertia: mass * length * length / 12.0,
        center_of_mass: [0.0; 2],
        free: [true; 3],
        position: plate.middle(),
        angle: 0.0,
        velocity: [0.3, -0.2],
        angular_velocity: 2.0,
        gravity: [0.0, -GRAVITY],
        half: false,
        sprung: Vec::new(),
    });
    plate.with(Box::new(body.expect("a sound plate")), 30.0)
}

/// Momentum closes in every step while a free plate falls and turns in the water, and the bits are the same with one thread
/// and with three.
#[test]
fn momentum_closes_around_a_free_plate_and_bits_do_not_depend_on_threads() {
    let run = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
        pool.install(|| {
            let mut system = falling();
            take(&mut system, 250).expect("a stable run");
            let worst = system.momentum_audit().worst;
            assert!(worst > 0.0 && worst < 1e-10, "momentum open by {worst:e}");
            assert_eq!(system.penetration().count, 0);
            let motion = system.bodies().find_map(|b| b.motion()).expect("a plate");
            assert!(motion.angle.abs() > 0.02, "the plate turns: {} rad", motion.angle);
            let p = system.fluid.particles();
            p.x.iter().chain(&p.y).chain(&p.u).chain(&p.rho).map(|v| v.to_bits()).collect::<Vec<u64>>()
        })
    };
    assert!(run(1) == run(3), "other bits with three threads");
}

/// A step that is taken back comes again to the same bits, with a thin plate too.
#[test]
fn a_step_next_to_a_plate_comes_again_to_the_same_bits() {
    let mut system = falling();
    take(&mut system, 60).expect("a stable run");
    system.checkpoint();
    let mut go = || {
        take(&mut system, 30).expect("a stable run");
        let bits: Vec<u64> = system.fluid.particles().x.iter().map(|v| v.to_bits()).collect();
        system.restore();
        bits
    };
    assert!(go() == go(), "other bits");
}

/// A plate a fifth of a spacing thick is driven by d = 3 spacings into the water on its right: the centre of that water moves
/// by d/2 within 10 %, that of the water on its left follows; no particle changes sides. With nothing on its left, its left face
/// carries nothing at all.
#[test]
fn a_paddle_pushes_the_water_before_it() {
    for rows in [[12, 12], [0, 12]] {
        let travel = 3.0 * SPACING;
        let mut system = paddled(0.2, 16, rows, travel, SPACING);
        let (before, start) = (sides(&system), centres(&system));
        let mut later = [vec![], vec![]];
        advance(&mut system, 2.0, |s| {
            if rows[0] == 0 {
                assert_eq!(face_forces(s)[0], 0.0, "a dry face");
            }
            if s.fluid.time() > 0.7 {
                centres(s).into_iter().zip(&mut later).for_each(|(x, all)| all.push(x));
            }
        })
        .expect("a stable run");
        assert_eq!(sides(&system), before, "water changed sides");
        assert_eq!(system.penetration().count, 0);
        assert!(system.momentum_audit().worst < 1e-10);
        let end = [mean(&later[0]), mean(&later[1])]; // over two periods of the waves
        for k in (0..2).filter(|&k| rows[k] > 0) {
            let moved = (end[k] - start[k]) / (0.5 * travel);
            println!("{rows:?}: water {k} moved {moved:.3} of half the travel");
            assert!((moved - 1.0).abs() < 0.1, "{rows:?}: water {k} moved {moved:.3} of half the travel");
        }
    }
}

/// Mean x of the water left and right of the plate at its place at the start [m].
fn centres(system: &Coupled) -> [f64; 2] {
    let (p, mut sum) = (system.fluid.particles(), [[0.0; 2]; 2]);
    let left = sides(system);
    for k in 0..p.len() {
        let side = usize::from(!left[p.id[k] as usize]);
        sum[side] = [sum[side][0] + p.x[k], sum[side][1] + 1.0];
    }
    sum.map(|[x, n]| x / n)
}

/// A thin bent plate that goes into the water at constant speed: the half of it with a plane of symmetry carries what the
/// whole one carries, within 3 % of the largest force.
#[test]
fn half_a_bent_plate_is_half_of_the_whole() {
    let force = |symmetry: &str| {
        let shape = "body={ name = \"wedge\", shape = \"polyline\", points = [[-0.3, 0.1], [0.0, 0.0], [0.3, 0.1]], thickness = 0.002, \
                     motion = \"constant_velocity\", velocity = [0.0, -1.0] }";
        let sets = [shape, symmetry, "resolution.spacing=0.01", "time.end=0.06", "tank.width=1.6", "tank.depth=0.4"];
        let mut system = system("wedge", &sets);
        let mut lifts = vec![];
        advance(&mut system, 0.06, |s| lifts.push((s.fluid.time(), evidence::systems::lift(s)))).expect("a stable run");
        let late = lifts.iter().filter(|(t, _)| *t > 0.03).map(|(_, f)| *f);
        mean(&late.collect::<Vec<f64>>())
    };
    let [half, whole] = [force("symmetry=x"), force("symmetry=none")];
    println!("half {half:.1} N/m, whole {whole:.1} N/m");
    assert!(whole > 50.0 && (half / whole - 1.0).abs() < 0.03, "half {half:.1} N/m, whole {whole:.1} N/m");
}
