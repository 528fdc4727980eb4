//! Bodies that are joined, that collide afloat and that land on the floor (THEORY CO36–CO38).

use evidence::systems::{advance, of_text, system};
use fsi_coupling::{Coupled, Motion};

/// A wedge that falls into water; more of it follows.
const WEDGE: &str = "name = \"joined\"\nsolver = \"SOLVER\"\n[time]\nend = 0.05\nstart = 0.0\n[tank]\nwidth = 1.6\ndepth = 0.5\n\
    [resolution]\nspacing = 0.02\n[body]\nname = \"wedge\"\nshape = \"wedge\"\ndeadrise_deg = 30.0\nbreadth = 0.4\n\
    velocity = [0.0, -4.0]\nposition = [0.0, 0.0]\nangle_deg = 5.0\n";

/// A body far off in the air on a spring without force: with it, a scene of one body has the settings of one of joined bodies.
const POST: &str = "[[bodies]]\nname = \"post\"\nshape = \"box\"\nbreadth = 0.16\nheight = 0.16\nmotion = \"fixed\"\n\
    position = [0.6, 0.5]\n[[joints]]\nname = \"slack\"\nkind = \"spring\"\nbodies = [\"wedge\", \"post\"]\nat = [0.0, 0.3]\n\
    to = [0.6, 0.5]\nstiffness = 1e-9\n";

fn motion(system: &Coupled, k: usize) -> Motion {
    system.bodies().nth(k).and_then(|body| body.motion()).expect("a body that moves")
}

fn wedge(solver: &str, more: &str) -> Coupled {
    of_text(&(WEDGE.replace("SOLVER", solver) + more), &[])
}

/// Two bodies on two hinges move as one body of their mass, centre and inertia, under slamming at 5° of roll.
#[test]
fn two_bodies_on_two_hinges_slam_as_one() {
    // the projection finds accelerations with the reactions of the step before
    for (solver, within) in [("weakly_compressible", [1e-6, 1e-5]), ("incompressible", [1e-3, 0.06])] {
        let [m, j, h, k]: [f64; 4] = [30.0, 0.5, 0.1, 0.6]; // wedge: mass, inertia, height of its centre; k: that of the box's
        let (box_mass, box_inertia) = (20.0, 0.3);
        let (mass, center) = (m + box_mass, (m * h + box_mass * k) / (m + box_mass));
        let inertia = j + box_inertia + m * (center - h).powi(2) + box_mass * (k - center).powi(2);
        let one = format!("mass = {mass}\ninertia = {inertia}\ncenter_of_mass = [0.0, {center}]\n{POST}");
        let tilt = 5.0_f64.to_radians();
        let place = |y: f64| [-y * tilt.sin(), y * tilt.cos()];
        let ([x, y], [low, high]) = (place(k), [place(0.3), place(0.5)]);
        let hinge = |name: &str, [x, y]: [f64; 2]| {
            format!("[[joints]]\nname = \"{name}\"\nkind = \"hinge\"\nbodies = [\"wedge\", \"top\"]\nat = [{x}, {y}]\n")
        };
        let two = format!(
            "mass = {m}\ninertia = {j}\ncenter_of_mass = [0.0, {h}]\n[[bodies]]\nname = \"top\"\nshape = \"box\"\nbreadth = 0.2\n\
             height = 0.2\nmass = {box_mass}\ninertia = {box_inertia}\nposition = [{x}, {y}]\nangle_deg = 5.0\n\
             velocity = [0.0, -4.0]\n{}{}",
            hinge("low", low),
            hinge("high", high)
        );
        let (mut one, mut two) = (wedge(solver, &one), wedge(solver, &two));
        // the same steps: a light box lets none be longer
        let dt = 0.5 * one.stable_dt().expect("a step").min(two.stable_dt().expect("a step"));
        for _ in 0..(0.04 / dt) as usize {
            one.step(dt).expect("one body");
            two.step(dt).expect("two bodies");
        }
        let (a, b) = (motion(&one, 0), motion(&two, 0));
        println!("{solver}: {a:?}\n{b:?}");
        let changed = (a.velocity[1] + 4.0).abs();
        assert!(changed > 0.5, "the water decelerates the wedge: {a:?}");
        for axis in 0..2 {
            let gap = (a.velocity[axis] - b.velocity[axis]).abs();
            assert!(gap < within[0] * changed, "{solver}: {gap} m/s of {changed} m/s along {axis}");
        }
        let turned = (a.angular_velocity - b.angular_velocity).abs() / a.angular_velocity.abs();
        assert!(turned < within[1], "{solver}: {turned} of the angular velocity");
        assert!(two.momentum_audit().worst < 1e-10, "{}", two.momentum_audit().worst);
    }
}

/// A mass on a slider with a spring is the mass of CO35, which is held against the exact solution for two masses in `sprung.rs`.
#[test]
fn a_mass_on_a_slider_is_a_sprung_mass() {
    let upright = "free = [\"y\"]\nmass = 40.0\n";
    let sprung = "[[body.sprung_masses]]\nname = \"seat\"\nmass = 10.0\nstiffness = 2e4\ndamping = 20.0\n";
    let sprung = format!("{sprung}{POST}");
    let slider = "[[bodies]]\nname = \"seat\"\nshape = \"box\"\nbreadth = 0.2\nheight = 0.2\nmass = 10.0\nfree = [\"y\"]\n\
        position = [0.0, 0.6]\nvelocity = [0.0, -4.0]\n[[joints]]\nname = \"spring\"\nkind = \"slider\"\n\
        bodies = [\"wedge\", \"seat\"]\nat = [0.0, 0.6]\naxis = [0.0, 1.0]\nstiffness = 2e4\ndamping = 20.0\n";
    let flat = |more: &str| {
        let text = WEDGE.replace("SOLVER", "weakly_compressible").replace("angle_deg = 5.0\n", "") + upright + more;
        of_text(&text, &[])
    };
    let (mut exact, mut joined) = (flat(&sprung), flat(slider));
    let dt = 0.5 * exact.stable_dt().expect("a step").min(joined.stable_dt().expect("a step"));
    let mut most = [0.0_f64; 2];
    for _ in 0..(0.045 / dt) as usize {
        exact.step(dt).expect("a mass on a spring");
        joined.step(dt).expect("a mass on a slider");
        let seat = exact.bodies().next().expect("a wedge").sprung()[0].extension;
        most = [most[0].max(seat.abs()), most[1].max((seat - joined.joints()[0].value).abs())];
    }
    println!("extension up to {} m, difference {} m", most[0], most[1]);
    assert!(most[0] > 1e-3 && most[1] < 0.01 * most[0], "{most:?}");
}

/// A box that falls on another one afloat: momentum closes, energy falls.
#[test]
fn boxes_that_collide_afloat_keep_momentum_and_gain_no_energy() {
    for solver in ["incompressible", "weakly_compressible"] {
        let falls = ["body.position=[0.0, 0.35]", "body.velocity=[0.0, -1.5]"];
        let mut system = system("two_boxes", &[&format!("solver={solver}"), falls[0], falls[1]]);
        let mut before_contact = None;
        advance(&mut system, 0.15, |s| {
            if s.touched().is_empty() {
                before_contact = Some(s.energy_drift());
            }
        })
        .expect("a stable run");
        let touched = system.touched();
        println!("{solver}: {touched:?}, energy {:?} -> {}", before_contact, system.energy_drift());
        assert_eq!(touched.len(), 1, "{solver}: {touched:?}");
        assert!(touched[0].impulse > 1.0 && touched[0].deepest < 0.02, "{solver}: {touched:?}");
        assert!(system.momentum_audit().worst < 1e-10, "{solver}: {}", system.momentum_audit().worst);
        assert!(system.energy_drift() < before_contact.expect("a way to go"), "{solver}: contact adds energy");
        assert_eq!(system.penetration().count, 0);
    }
}

/// A box that sinks onto the floor lies there on a film of two spacings; the contact carries it: its impulse per time is the weight, and what
/// stopped the box, less the force of the water, which is the buoyancy.
#[test]
fn a_box_that_lands_on_the_floor_lies_there() {
    for solver in ["incompressible", "weakly_compressible"] {
        let mut system = system("box_on_floor", &[&format!("solver={solver}"), "time.end=2"]);
        let buoyancy = 1000.0 * 9.81 * 0.4 * 0.2;
        advance(&mut system, 0.8, |_| {}).expect("a stable run");
        let start = (system.fluid.time(), system.touched()[0].impulse, motion(&system, 0).velocity[1]);
        let mut water = 0.0;
        let mut last = start.0;
        advance(&mut system, 1.2, |s| {
            water += (s.fluid.time() - last) * motion(s, 0).force[1];
            last = s.fluid.time();
        })
        .expect("a stable run");
        let (m, time) = (motion(&system, 0), system.fluid.time() - start.0);
        let carried = (system.touched()[0].impulse - start.1) / time;
        let expected = 160.0 * ((m.velocity[1] - start.2) / time + 9.81) - water / time;
        println!(
            "{solver}: carried {carried} N/m, weight less water {expected} N/m, water {water}; {m:?}",
            water = water / time / buoyancy
        );
        assert!((m.position[1] + 0.66).abs() < 0.005 && m.angle.abs() < 0.02, "{m:?}");
        assert!(system.momentum_audit().worst < 1e-10);
        assert!(system.penetration().count <= 1, "{:?}", system.penetration());
        assert!((water / time / buoyancy - 1.0).abs() < 0.2, "{solver}: {} of {buoyancy} N/m", water / time);
        assert!((carried / expected - 1.0).abs() < 0.03, "{solver}: {carried} N/m instead of {expected} N/m");
    }
}

/// Boxes of other breadths, masses, tilts and spacings: thrown up or broken down with a film of one layer (`contact.gap = 1`).
#[test]
fn no_box_that_lands_is_ejected() {
    let cases = [(250.0, 0.05, 0.0), (400.0, 0.05, 0.0), (250.0, 0.05, 5.0), (400.0, 0.033, 12.0), (400.0, 0.03, 0.0)];
    for (mass, spacing, angle) in cases {
        let text = format!(
            "name = \"landing\"\nsolver = \"incompressible\"\n[time]\nend = 2.0\n[resolution]\nspacing = {spacing}\ngrowth = 1.0\n\
             [tank]\nwidth = 1.6\ndepth = 0.8\nheight = 2.0\n[body]\nname = \"box\"\nshape = \"box\"\nbreadth = 0.4\nheight = 0.4\n\
             mass = {mass}\ninertia = {}\nposition = [0.0, -0.3]\nangle_deg = {angle}\n",
            mass * 0.16 / 6.0
        );
        let mut system = of_text(&text, &[]);
        let (mut water, mut time) = (0.0, 0.0);
        advance(&mut system, 2.0, |s| {
            let dt = s.fluid.time() - time;
            time += dt;
            water += if time > 1.5 { dt * motion(s, 0).force[1] } else { 0.0 };
        })
        .expect("a stable run");
        let (m, share) = (motion(&system, 0), water / 0.5 / (1000.0 * 9.81 * 0.16));
        println!("{mass} kg/m, {spacing} m, {angle} deg: water's force over buoyancy {share}; {m:?}");
        assert!((m.position[1] + 0.6 - 2.0 * spacing).abs() < 0.01 && m.angle.abs() < 0.03, "{m:?}");
        assert!((share - 1.0).abs() < 0.1, "{mass} kg/m, {spacing} m, {angle} deg: {share} of the buoyancy");
    }
}
