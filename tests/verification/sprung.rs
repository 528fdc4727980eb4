//! Springs and water: a rigid plate on springs, and a mass on a spring that stands on a rigid body (THEORY CO35).

use evidence::load::Handled;
use evidence::systems::{advance, of_text, system};
use fsi_coupling::{Inspect, Outline, RigidBody2d, RigidSpec, Shape, SprungSpec, WettedBody};
use run::build::build;
use run::load;
use scenarios::preflight::preflight;
use sph_core::Walls;
use water_entry::{EntryModel, Loads, Section};

/// Force of a wedge of 30° at constant speed, over rho V^3 t (Zhao & Faltinsen 1993, table 1) [-].
const SIMILARITY: f64 = 14.139;
/// Frame and springs, of the whole body [kg/m, N/m²].
const FRAME: f64 = 60.0;
const SPRINGS: f64 = 4e6;

/// Largest deceleration of the frame [m/s²] before `end` [s]: the faces take the momentum ½ C rho z² z' of the water (von Karman's
/// argument with the similarity solution's coefficient C).
fn of_two_masses(faces: f64, speed: f64, end: f64) -> f64 {
    let (dt, steps) = (1e-6, (end / 1e-6) as usize);
    let ([mut z, mut y], [mut rate, mut frame_rate], mut most) = ([0.0_f64; 2], [speed; 2], 0.0_f64);
    for _ in 0..steps {
        let (added, spring) = (0.5 * SIMILARITY * 1000.0 * z * z, SPRINGS * (y - z));
        rate += dt * (spring - SIMILARITY * 1000.0 * z * rate * rate) / (faces + added);
        frame_rate -= dt * spring / FRAME;
        (z, y, most) = (z + dt * rate, y + dt * frame_rate, most.max(spring / FRAME));
    }
    most
}

#[test]
fn a_frame_over_rigid_faces_on_springs_decelerates_like_two_masses() {
    let text = format!(
        "name = \"two\"\nsymmetry = \"x\"\ngravity = [0.0, 0.0]\n[time]\nend = 0.01\n[tank]\nwidth = 1.2\ndepth = 0.5\n\
         [resolution]\nspacing = 0.004\n[body]\nname = \"frame\"\nshape = \"wedge\"\ndeadrise_deg = 30.0\nbreadth = 0.4\n\
         mass = {FRAME}\nvelocity = [0.0, -6.0]\n[[body.panels]]\nname = \"face\"\nfrom = [0.0, 0.0]\nto = [0.2, 0.11547]\n\
         thickness = 0.04\nyoungs_modulus = 1e12\npoissons_ratio = 0.0\ndensity = 800.0\nends = [\"mirror\", \"free\"]\n\
         end_springs = [[{0}, {0}, 0.0], [0.0, 0.0, 0.0]]\n",
        0.5 * SPRINGS
    );
    let mut system = of_text(&text, &[]);
    let mut most = 0.0_f64;
    advance(&mut system, 0.01, |s| {
        let frame = s.bodies().find_map(|body| body.motion()).expect("a frame");
        most = most.max(frame.acceleration[1]);
    })
    .expect("a stable run");
    let expected = of_two_masses(2.0 * 0.04 * 0.2_f64.hypot(0.11547) * 800.0, 6.0, 0.01);
    println!("{most} m/s², of two masses {expected} m/s²");
    assert!((most / expected - 1.0).abs() < 0.04, "{most} m/s² instead of {expected} m/s²");
}

fn seat(mass: f64, stiffness: f64, damping: f64) -> SprungSpec {
    SprungSpec { name: "seat".into(), mass, stiffness, damping }
}

fn upright(sprung: SprungSpec, speed: f64) -> RigidBody2d {
    let spec = RigidSpec {
        name: "box".into(),
        outline: Outline::of(&Shape::Box { breadth: 1.0, height: 0.4 }).expect("a box"),
        mass: 5.0,
        inertia: 0.0,
        center_of_mass: [0.0; 2],
        free: [false, true, false],
        position: [0.0; 2],
        angle: 0.0,
        velocity: [0.0, speed],
        angular_velocity: 0.0,
        gravity: [0.0; 2],
        half: false,
        sprung: vec![sprung],
    };
    RigidBody2d::new(spec).expect("a sound body")
}

/// A body that is stopped at t = 0 by a contact impulse and its mass swing about their common centre: e = −V sin(ωt)/ω, ω² = k (1/M + 1/m), with a damper
/// of δ = ½c (1/M + 1/m) e = −V e^(−δt) sin(ω_d t)/ω_d. Momentum is kept, and the damper's energy is the one that is missing.
#[test]
fn two_masses_swing_about_their_centre() {
    let (body_mass, mass, stiffness, speed, dt) = (5.0, 2.0, 300.0, -3.0, 1e-4);
    let over = 1.0 / body_mass + 1.0 / mass;
    for damping in [0.0, 4.0] {
        let mut body = upright(seat(mass, stiffness, damping), speed);
        let mut handled = Handled::new(&mut body, 0.1, false);
        let none = |_: usize, _: &Walls| [0.0; 2];
        handled.start(&mut body, none);
        // it stops the body but not the mass
        let at = fsi_coupling::ContactImpulse { at: [0.0, -0.2], impulse: [0.0, -body_mass * speed], mirrored: false };
        fsi_coupling::Contact::apply_impulse(&mut body, &at);
        let start = (body.momentum(), body.energy());
        let delta = 0.5 * damping * over;
        let omega = (stiffness * over - delta * delta).sqrt();
        for step in 1..=5000 {
            handled.step(&mut body, dt, none);
            let t = f64::from(step) * dt;
            let exact = speed * (-delta * t).exp() * (omega * t).sin() / omega;
            let now = &body.sprung()[0];
            assert!(
                (now.extension - exact).abs() < 2e-4 * (speed / omega).abs(),
                "{t} s: {} for {exact}",
                now.extension
            );
        }
        let (momentum, energy) = (body.momentum(), body.energy());
        assert!((momentum.momentum[1] - start.0.momentum[1]).abs() < 1e-10, "{momentum:?}");
        let all = |e: &fsi_coupling::Energy| e.kinetic + e.elastic + e.dissipated;
        assert!((all(&energy) / all(&start.1) - 1.0).abs() < 1e-3, "{energy:?}, before {:?}", start.1);
    }
}

#[test]
fn a_step_too_long_for_a_spring_is_refused_with_the_one_that_would_do() {
    let mut body = upright(seat(2.0, 3e6, 0.0), -1.0);
    let refused = body.advance(0.01).expect_err("too long").to_string();
    assert!(refused.contains("seat") && refused.contains("expected at most"), "{refused}");
}

/// CO35: half of √(μ/k) of 10 kg/m on a box of 40 kg/m.
#[test]
fn a_mass_on_a_stiff_spring_shortens_the_steps() {
    let sets =
        ["body.free=[\"y\"]", "body.sprung_masses=[{name=\"seat\",mass=10,stiffness=2e5}]", "solver=incompressible"];
    let loaded = load("floating_box", &sets.map(String::from)).expect("a sound scene");
    let longest = 0.5 * (8.0_f64 / 2e5).sqrt();
    let given = preflight(&loaded.scene, &loaded.warnings).step_s;
    assert!((given / longest - 1.0).abs() < 1e-12, "check gives {given} s, {longest} s would do");
    let mut system = build(&loaded.scene).expect("a system");
    for _ in 0..3 {
        let step = system.stable_dt().expect("a step");
        assert!(step <= longest, "{step} s, {longest} s would do");
        system.step(step).expect("a step that the spring allows");
    }
    let fixed = [&sets[..], &["time.step=0.004"]].concat();
    let refused = load("floating_box", &fixed.into_iter().map(String::from).collect::<Vec<_>>());
    let words = refused.expect_err("a step too long for the spring").to_string();
    assert!(words.contains("`time.step`") && words.contains("seat") && words.contains("0.003162"), "{words}");
}

/// A wedge of 20° with a mass on a spring, by particles, against two masses under the load of the modified Logvinovich model (Korobkin 2004),
/// which is within 2 % there.
#[test]
fn a_mass_on_a_falling_wedge_goes_like_two_masses_under_the_theorys_load() {
    let ([body_mass, mass], stiffness, damping, gravity) = ([60.0, 40.0], 4e5, 300.0, 9.81);
    let (spacing, end) = (0.004, 0.0224);
    let sprung = format!("body.sprung_masses=[{{name=\"seat\",mass={mass},stiffness={stiffness},damping={damping}}}]");
    let sets = [&sprung, "body.mass=60.0", &format!("resolution.spacing={spacing}")];
    let mut system = system("wedge_drop_20", &sets.map(|set| set as &str));
    let loads = Loads::new(EntryModel::Mlm, &Section::wedge(20.0, 0.6).expect("a section")).expect("in range");
    // [draught, speed, extension, speed of the mass], downwards but for the extension
    let rates = |[h, v, e, u]: [f64; 4]| {
        let load = loads.at(h.max(0.0));
        let spring = stiffness * e + damping * (v - u); // upwards on the body
        let water = 1000.0 * (load.slam * v * v + gravity * Section::wedge(20.0, 0.6).map_or(0.0, |s| s.still_area(h)));
        [
            v,
            (body_mass * gravity - water - spring) / (body_mass + 1000.0 * load.added_mass),
            v - u,
            gravity + spring / mass,
        ]
    };
    let (mut now, mut time, dt) = ([0.0, 4.0, 0.0, 4.0], 0.0, 2e-5);
    let (mut squares, mut count, mut peaks) = ([0.0; 2], 0.0, [0.0_f64; 2]);
    advance(&mut system, end, |s| {
        let t = s.fluid.time();
        while time + dt <= t {
            let k = rates(now);
            let middle = rates(std::array::from_fn(|i| now[i] + 0.5 * dt * k[i]));
            now = std::array::from_fn(|i| now[i] + dt * middle[i]);
            time += dt;
        }
        let body = s.bodies().find(|body| body.motion().is_some()).expect("a wedge");
        let (seat, motion) = (&body.sprung()[0], body.motion().expect("a motion"));
        if t > 0.002 {
            let [_, v, e, _] = now;
            squares[0] += (-motion.velocity[1] - v).powi(2);
            squares[1] += (seat.extension - e).powi(2);
            count += 1.0;
            peaks = [peaks[0].min(seat.extension), peaks[1].min(e)];
        }
    })
    .expect("a stable run");
    let [of_speed, of_extension] = squares.map(|sum| (sum / count).sqrt());
    let [ours, theirs] = peaks;
    println!(
        "speed {:.4} of that at contact, extension {:.4} of the largest; largest {ours} for {theirs} m",
        of_speed / 4.0,
        of_extension / theirs.abs()
    );
    assert!(of_speed / 4.0 < 0.03 && of_extension / theirs.abs() < 0.03, "{of_speed}, {of_extension}");
    assert!((ours / theirs - 1.0).abs() < 0.03, "{ours} for {theirs} m");
}
