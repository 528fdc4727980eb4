//! The rapier body against mechanics that has closed forms (THEORY CO2).

use evidence::load::Handled;
use evidence::statistics::Noise;
use fsi_coupling::{Inspect, Outline, RigidBody2d, RigidSpec, Shape};
use sph_core::Walls;
use sph_core::walls::Resultant;

const MASS: f64 = 5.0;
const INERTIA: f64 = 0.8;

/// A box of 1 m by 0.4 m about its centre of mass, off the origin.
fn spec() -> RigidSpec {
    RigidSpec {
        name: "box".into(),
        outline: Outline::of(&Shape::Box { breadth: 1.0, height: 0.4 }).expect("a box"),
        mass: MASS,
        inertia: INERTIA,
        center_of_mass: [0.0, 0.0],
        free: [true; 3],
        position: [1.5, -0.5],
        angle: 0.3,
        velocity: [0.0; 2],
        angular_velocity: 0.0,
        gravity: [0.0; 2],
        half: false,
        sprung: Vec::new(),
    }
}

fn body(spec: RigidSpec) -> (RigidBody2d, Handled) {
    let mut body = RigidBody2d::new(spec).expect("a sound body");
    let handled = Handled::new(&mut body, 0.1, false);
    (body, handled)
}

fn motion(body: &RigidBody2d) -> fsi_coupling::Motion {
    body.motion().expect("a rigid body has a motion")
}

fn none(_: usize, _: &Walls) -> [f64; 2] {
    [0.0; 2]
}

/// y = y₀ + v₀ t − ½ g t², exactly for any step: a kick–drift–kick step is exact under a constant force.
#[test]
fn free_fall_is_exact_whatever_the_step() {
    for dt in [0.1, 0.001] {
        let (mut body, mut handled) = body(RigidSpec { velocity: [2.0, 3.0], gravity: [0.0, -9.81], ..spec() });
        handled.start(&mut body, none);
        let steps = (1.0_f64 / dt).round() as usize;
        for _ in 0..steps {
            handled.step(&mut body, dt, none);
        }
        let (m, e) = (motion(&body), body.energy());
        let exact = [1.5 + 2.0, -0.5 + 3.0 - 0.5 * 9.81];
        for k in 0..2 {
            assert!((m.position[k] - exact[k]).abs() < 1e-12, "{dt}: {:?} against {exact:?}", m.position);
        }
        let start = 0.5 * MASS * 13.0 - MASS * 9.81 * 0.5;
        assert!((e.kinetic + e.potential - start).abs() < 1e-11, "energy {} J/m", e.kinetic + e.potential);
    }
}

/// End of a run of 1 s from rest under a constant force and a constant moment about the centre of mass.
fn pushed(dt: f64, angle: f64) -> (fsi_coupling::Motion, fsi_coupling::Energy) {
    let total = Resultant { force: [3.0, -2.0], moment: 1.1 };
    let (mut body, mut handled) = body(RigidSpec { angle, ..spec() });
    let forces = handled.spread(total, [1.5, -0.5]);
    handled.start(&mut body, |k, _| forces[k]);
    for n in 1..=(1.0 / dt).round() as usize {
        let t = n as f64 * dt;
        handled.place(&body, dt);
        let pole = [0, 1].map(|k| [1.5, -0.5][k] + 0.5 * total.force[k] / MASS * t * t);
        let forces = handled.spread(total, pole);
        handled.step(&mut body, dt, |k, _| forces[k]);
    }
    (motion(&body), body.energy())
}

/// x = x₀ + ½ F/m t² exactly; spin M/I t, angle ½ M/I t² and the moment's work to second order in the step: the forces
/// turn with the body during it, and the rigid-body engine turns a body by atan(ω Δt).
#[test]
fn a_constant_force_and_moment_give_the_parabola() {
    let error = |dt: f64| {
        let (m, e) = pushed(dt, 0.3);
        let exact = [1.5 + 0.5 * 3.0 / MASS, -0.5 - 0.5 * 2.0 / MASS];
        for k in 0..2 {
            assert!((m.position[k] - exact[k]).abs() < 1e-12, "{:?} against {exact:?}", m.position);
            assert!((m.velocity[k] - [3.0, -2.0][k] / MASS).abs() < 1e-12, "{:?}", m.velocity);
        }
        let spin = 1.1 / INERTIA;
        [m.angular_velocity - spin, m.angle - 0.3 - 0.5 * spin, e.work - e.kinetic].map(f64::abs)
    };
    let (coarse, fine) = (error(0.02), error(0.01));
    for (what, k) in [("spin", 0), ("angle", 1), ("work against kinetic energy", 2)] {
        let order = (coarse[k] / fine[k]).log2();
        assert!(coarse[k] < 1e-3, "{what}: off by {}", coarse[k]);
        assert!((order - 2.0).abs() < 0.2, "{what}: observed order {order:.2}");
    }
}

/// The work of a moment is that of the angle turned, also across the half turn where an angle's sign jumps.
#[test]
fn work_does_not_jump_where_the_angle_does() {
    let (_, across) = pushed(0.01, std::f64::consts::PI - 0.3);
    let (_, within) = pushed(0.01, 0.0);
    assert!((across.work - within.work).abs() < 1e-9, "{} J/m across, {} J/m within", across.work, within.work);
}

/// A body that turns freely keeps its spin to rounding and its angle to second order in the step; its centre of mass
/// moves on a straight line although its frame's origin does not.
#[test]
fn a_free_spin_is_constant_and_its_angle_of_second_order() {
    let error = |dt: f64| {
        let start = RigidSpec { center_of_mass: [0.2, 0.1], velocity: [0.4, 0.0], angular_velocity: 2.0, ..spec() };
        let (mut body, mut handled) = body(start);
        handled.start(&mut body, none);
        let at_start = body.energy().kinetic;
        for _ in 0..(1.0 / dt).round() as usize {
            handled.step(&mut body, dt, none);
        }
        let m = motion(&body);
        assert!((m.angular_velocity - 2.0).abs() < 1e-13, "spin {}", m.angular_velocity);
        assert!((body.energy().kinetic / at_start - 1.0).abs() < 1e-13);
        let arm = fsi_coupling::geometry::vector::rotate([0.2, 0.1], 0.3);
        let (vx, vy) = (0.4 - 2.0 * arm[1], 2.0 * arm[0]);
        let now = fsi_coupling::geometry::vector::rotate([0.2, 0.1], m.angle);
        let line = [1.5 + arm[0] + vx - now[0], -0.5 + arm[1] + vy - now[1]];
        for k in 0..2 {
            assert!((m.position[k] - line[k]).abs() < 1e-12, "{:?} off the line {line:?}", m.position);
        }
        (m.angle - 2.3).abs()
    };
    let (coarse, fine) = (error(0.02), error(0.01));
    let order = (coarse / fine).log2();
    assert!(coarse < 2e-3 && (order - 2.0).abs() < 0.1, "off by {coarse}, observed order {order:.2}");
}

/// Largest change of the energy of a body on a spring over ten periods, relative to its start [-].
fn spring_drift(steps_per_period: f64) -> f64 {
    let stiffness = 4000.0;
    let (mut body, mut handled) = body(RigidSpec { velocity: [0.0, 0.7], free: [true, true, false], ..spec() });
    let n = handled.walls.len() as f64;
    let rest = handled.walls.y.clone();
    let spring = |k: usize, w: &Walls| [0.0, -stiffness / n * (w.y[k] - rest[k])];
    handled.start(&mut body, spring);
    let start = body.energy().kinetic;
    let period = 2.0 * std::f64::consts::PI * (MASS / stiffness).sqrt();
    let mut worst = 0.0_f64;
    for _ in 0..(10.0 * steps_per_period) as usize {
        handled.step(&mut body, period / steps_per_period, spring);
        let stretch = motion(&body).position[1] + 0.5;
        let energy = body.energy().kinetic + 0.5 * stiffness * stretch * stretch;
        worst = worst.max((energy / start - 1.0).abs());
    }
    worst
}

/// A stiff external force must not feed energy into a body, as the engine's own integrator does: over ten periods the
/// energy stays within a bound that falls as Δt².
#[test]
fn a_stiff_spring_load_does_not_feed_energy() {
    let (coarse, fine) = (spring_drift(20.0), spring_drift(40.0));
    let order = (coarse / fine).log2();
    assert!(coarse < 0.05, "energy off by {coarse:.4} of the start");
    assert!((order - 2.0).abs() < 0.2, "{coarse:.5}, then {fine:.5}: observed order {order:.2}");
}

/// Guides hold what is not free to the last bit, whatever pushes, and the momentum balance contains what they took: momentum equals
/// the impulses of load, gravity and guides.
#[test]
fn guides_hold_to_the_bit_and_the_momentum_balance_closes() {
    for free in [[false, true, false], [true, false, false], [true, true, true], [false, false, true]] {
        let start = RigidSpec { free, gravity: [1.0, -9.81], ..spec() };
        let (mut body, mut handled) = body(start);
        let mut noise = Noise::new(17);
        handled.start(&mut body, none);
        let (first, held) = (motion(&body), body.momentum().momentum);
        let mut given = [0.0; 2];
        for _ in 0..200 {
            let forces: Vec<[f64; 2]> = (0..handled.walls.len()).map(|_| [noise.draw(), noise.draw()]).collect();
            handled.step(&mut body, 0.01, |k, _| forces[k]);
            given[0] += 0.01 * handled.walls.mean_fx.iter().sum::<f64>();
            given[1] += 0.01 * handled.walls.mean_fy.iter().sum::<f64>();
            let now = motion(&body);
            for k in 0..2 {
                assert!(free[k] || now.position[k].to_bits() == first.position[k].to_bits(), "{free:?}: axis {k}");
                assert!(free[k] || now.velocity[k] == 0.0, "{free:?}: axis {k}");
            }
            assert!(free[2] || now.angle.to_bits() == first.angle.to_bits(), "{free:?}: angle {}", now.angle);
        }
        let moved = motion(&body);
        assert!((0..2).all(|k| !free[k] || moved.position[k] != first.position[k]), "{free:?}: a free axis stuck");
        let held_by = body.momentum();
        for k in 0..2 {
            let gap = held_by.momentum[k] - held[k] - held_by.external[k] - given[k];
            assert!(gap.abs() < 1e-11, "{free:?}, axis {k}: {gap} N s/m are unaccounted for");
        }
    }
}
