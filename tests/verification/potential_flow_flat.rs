//! Potential flow about flat and nearly flat keels (THEORY EN50): against the exact solution, momentum, scaling and this project's particles.

use water_entry::{EntryModel, FlowEntry, FlowHistory, Instant, Section, SectionMotion, SimilarityFlow};

/// A bottom of faces, each given by the distance of its end from the middle [m] and its deadrise [deg].
fn faces(faces: &[[f64; 2]]) -> Section {
    let mut corners = vec![[0.0, 0.0]];
    for [x, deadrise] in faces {
        let [from, y] = corners[corners.len() - 1];
        corners.push([*x, y + (x - from) * deadrise.to_radians().tan()]);
    }
    Section::new(&corners).expect("a section")
}

/// The section followed from contact at `speed` to `end` [s], and its history.
fn follow(section: &Section, mass: Option<f64>, speed: f64, end: f64) -> (Vec<Instant>, FlowHistory) {
    let motion = mass.map_or(SectionMotion::Constant, SectionMotion::Free);
    let gravity = if mass.is_some() { 9.81 } else { 0.0 };
    let entry = FlowEntry { section, motion, draught: 0.0, speed, gravity, density: 1000.0 };
    let times: Vec<f64> = (0..=800).map(|k| end * f64::from(k) / 800.0).collect();
    let (instants, history, over) = entry.solve(&times).expect("in range");
    assert!(over.is_none(), "{over:?}");
    (instants, history)
}

/// Mean force between two times [N/m].
fn mean(instants: &[Instant], from: f64, to: f64) -> f64 {
    let within = instants.windows(2).filter(|w| w[0].time >= from - 1e-9 && w[1].time <= to + 1e-9);
    let [impulse, time] = within.fold([0.0; 2], |[impulse, time], w| {
        let dt = w[1].time - w[0].time;
        [impulse + 0.5 * (w[0].force + w[1].force) * dt, time + dt]
    });
    impulse / time
}

/// Long after contact the flow is that of the outer face's wedge, whose keel lies where the faces meet.
#[test]
fn a_flat_keel_is_forgotten() {
    for deadrise in [20.0, 30.0, 40.0] {
        let (half_width, end) = (0.1, 0.3);
        let lowest = half_width * f64::to_radians(deadrise).tan();
        let (instants, _) = follow(&faces(&[[half_width, 0.0], [2.0, deadrise]]), None, 1.0, end);
        let exact = SimilarityFlow::solve(deadrise).expect("a solution").force_coefficient;
        let found = mean(&instants, 0.9 * end, end) / (1000.0 * (0.95 * end + lowest));
        println!("{deadrise} degrees: {:+.2} %", 100.0 * (found / exact - 1.0));
        assert!((found / exact - 1.0).abs() < 0.01, "{deadrise} degrees: {found} for {exact}");
    }
}

/// Faces, mass [kg/m] of a free body, speed [m/s], start and length of the windows [s], and the mean force of particles in them [N/m].
type Case = (&'static [[f64; 2]], Option<f64>, f64, [f64; 2], &'static [f64]);

/// Particles, `solver = "incompressible"`, without gravity at constant speed: 7.8 mm in the first case, 10 mm in the others.
const PARTICLES: [Case; 4] = [
    (&[[0.5, 0.0], [1.2, 20.0]], None, 1.0, [0.025, 0.025], &[9990.0, 10802.0, 11763.0]),
    (&[[0.4, 0.0], [1.1, 30.0]], None, 1.0, [0.032, 0.032], &[4360.0, 4582.0, 5036.0, 5426.0]),
    (&[[0.4, 4.0], [1.1, 25.0]], None, 1.0, [0.031, 0.031], &[5664.0, 5840.0, 6453.0, 7182.0]),
    (&[[0.5, 0.0], [1.2, 20.0]], Some(2000.0), 2.0, [0.012, 0.012], &[23853.0, 23893.0, 23892.0, 24191.0]),
];

/// From a wetted half width of 1.4 to 1.5 times that of the flat keel on, to the chines.
#[test]
fn flat_keels_are_near_particles() {
    for (of_faces, mass, speed, [start, window], particles) in PARTICLES {
        let end = start + window * particles.len() as f64;
        let (instants, _) = follow(&faces(of_faces), mass, speed, end * 1.01);
        let at = |k: usize| start + window * k as f64;
        let ours: Vec<f64> = (0..particles.len()).map(|k| mean(&instants, at(k), at(k + 1))).collect();
        let errors: Vec<f64> = ours.iter().zip(particles).map(|(ours, theirs)| ours / theirs - 1.0).collect();
        let impulse = ours.iter().sum::<f64>() / particles.iter().sum::<f64>() - 1.0;
        println!("{of_faces:?}: {errors:+.4?}, impulse {impulse:+.4}");
        assert!(errors.iter().all(|error| error.abs() < 0.03) && impulse.abs() < 0.02, "{of_faces:?}: {errors:?}");
    }
}

/// A free body keeps its momentum with that of the water's added mass ½πρf² at contact; at a given speed the water takes ½πρf² V.
#[test]
fn a_flat_keel_gives_its_momentum_at_contact() {
    let (half_width, mass, speed) = (0.4_f64, 700.0, 3.0);
    let added = 0.5 * std::f64::consts::PI * 1000.0 * half_width.powi(2);
    let section = faces(&[[half_width, 0.0], [1.2, 25.0]]);
    let (instants, history) = follow(&section, Some(mass), speed, 0.002);
    let kept = mass * speed / (mass + added);
    let lost = mass * speed - (mass * instants[0].speed + history.impulse_at_contact());
    assert!(lost.abs() < 1e-9 * mass * speed, "{lost} N s/m");
    assert!((instants[0].speed / kept - 1.0).abs() < 1e-9, "{} for {kept}", instants[0].speed);
    // afterwards the forces and the weight change it
    let [first, last] = [instants[0], instants[instants.len() - 1]];
    let impulse = mean(&instants, 0.0, last.time) * last.time;
    let change = mass * (first.speed - last.speed + 9.81 * last.time);
    assert!((impulse / change - 1.0).abs() < 0.02, "{impulse} for {change} N s/m");
    let (_, at_given_speed) = follow(&section, None, speed, 0.002);
    assert!((at_given_speed.impulse_at_contact() / (added * speed) - 1.0).abs() < 1e-12);
    let (_, of_keel) = follow(&faces(&[[half_width, 20.0], [1.2, 25.0]]), Some(mass), speed, 0.002);
    assert!(of_keel.impulse_at_contact() == 0.0);
}

/// A keel of half a degree is nearly a flat one, once it is wet, and so is one of 0.1 degrees.
#[test]
fn nearly_flat_keels_come_to_flat_ones() {
    let force = |deadrise: f64| {
        let section = faces(&[[0.4, deadrise], [1.1, 25.0]]);
        let (instants, _) = follow(&section, None, 1.0, 0.12);
        [[0.04, 0.06], [0.06, 0.09], [0.09, 0.12]].map(|[from, to]| mean(&instants, from, to))
    };
    let flat = force(0.0);
    for (deadrise, within) in [(0.1, 0.02), (0.5, 0.04)] {
        for (flat, found) in flat.iter().zip(force(deadrise)) {
            println!("{deadrise} degrees: {:+.2} %", 100.0 * (found / flat - 1.0));
            assert!((found / flat - 1.0).abs() < within, "{deadrise} degrees: {found} for {flat}");
        }
    }
}

/// All lengths times 3 and the speed times 2: forces are 12 times as large.
#[test]
fn forces_about_a_flat_keel_scale() {
    let of = |length: f64, speed: f64| {
        let section = faces(&[[0.4 * length, 0.0], [1.1 * length, 25.0]]);
        follow(&section, None, speed, 0.06 * length / speed).0
    };
    for (small, large) in of(1.0, 1.0).iter().zip(of(3.0, 2.0)).skip(20).step_by(40) {
        assert!((large.force / (12.0 * small.force) - 1.0).abs() < 1e-6, "{large:?} for {small:?}");
    }
}

/// What has no steep enough face beyond its flat keel is refused, and formulas refuse flat and nearly flat keels; the next model is named.
#[test]
fn bottoms_without_a_steeper_face_are_refused() {
    let refused = |model: EntryModel, of: &[[f64; 2]]| model.covers(&faces(of), 0.0).expect_err("refused").to_string();
    let flat = refused(EntryModel::BoundaryElement, &[[0.5, 0.0], [1.0, 8.0]]);
    assert!(flat.contains("one with a face of 0.00 degrees") && flat.contains("\"wcsph\""), "{flat}");
    let after = refused(EntryModel::BoundaryElement, &[[0.5, 0.0], [0.8, 20.0], [1.0, 8.0]]);
    assert!(after.contains("one with a face of 8.00 degrees") && after.contains("\"wcsph\""), "{after}");
    let nearly = refused(EntryModel::Mlm, &[[0.5, 2.0], [1.0, 25.0]]);
    assert!(nearly.contains("one of 2.00 degrees") && nearly.contains("\"boundary_element\""), "{nearly}");
    let formula = refused(EntryModel::Mlm, &[[0.5, 0.0], [1.0, 25.0]]);
    assert!(formula.contains("a flat keel") && formula.contains("\"boundary_element\""), "{formula}");
}
