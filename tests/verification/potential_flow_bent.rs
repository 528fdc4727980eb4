//! Potential flow about bent bottoms (THEORY EN39–EN41) against wedges, the exact solution, formulae and this project's particles.

use water_entry::{EntryFlow, EntryModel, FlowEntry, Instant, Loads, Section, SectionMotion, SimilarityFlow};

const SPEED: f64 = 1.0;

/// The corners of faces, each given by the distance of its end from the middle [m] and its deadrise [deg].
fn corners(faces: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut corners = vec![[0.0, 0.0]];
    for [x, deadrise] in faces {
        let [from, y] = corners[corners.len() - 1];
        corners.push([*x, y + (x - from) * deadrise.to_radians().tan()]);
    }
    corners
}

fn bent(faces: &[[f64; 2]]) -> Section {
    Section::new(&corners(faces)).expect("a section")
}

/// Draught, force and added mass, step by step, at constant speed without gravity.
pub fn loads(section: &Section, from: f64, to: f64, speed: f64) -> Vec<[f64; 3]> {
    let mut flow = EntryFlow::new(section, from, speed, 0.0).expect("in range");
    let mut loads = Vec::new();
    while flow.draught() < to {
        let draught = flow.draught();
        let (_, load) = flow.step(|_| 0.0).expect("a step");
        loads.push([draught, load.force, load.added_mass]);
    }
    loads
}

/// Values of rows at a draught.
fn at(rows: &[[f64; 3]], draught: f64) -> [f64; 2] {
    let after = rows.partition_point(|row| row[0] <= draught).clamp(1, rows.len() - 1);
    let [a, b] = [rows[after - 1], rows[after]];
    let share = (draught - a[0]) / (b[0] - a[0]);
    [a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])]
}

/// Knuckles that do not turn change nothing, with dry and with wet chines.
#[test]
fn faces_in_line_are_a_wedge() {
    let [whole, parts] = [&[[1.0, 28.0]][..], &[[0.35, 28.0], [0.6, 28.0], [1.0, 28.0]]].map(bent);
    let [whole, parts] = [whole, parts].map(|section| loads(&section, 0.1, 0.55, SPEED));
    for k in 0..=20 {
        let draught = 0.12 + 0.42 * f64::from(k) / 20.0;
        let ([force, mass], [of_parts, mass_of_parts]) = (at(&whole, draught), at(&parts, draught));
        // the instant of separation is known to a step
        let within = if draught < 0.3 { 0.002 } else { 0.012 };
        assert!((of_parts / force - 1.0).abs() < within, "{draught} m: {of_parts} for {force}");
        assert!((mass_of_parts / mass - 1.0).abs() < 0.5 * within, "{draught} m: {mass_of_parts} for {mass}");
    }
}

/// Before the jet is at the knuckle the flow is that of the keel's wedge; long after it, that of the outer face's wedge, whose keel lies where the
/// outer faces meet.
#[test]
fn at_both_ends_the_flow_is_similar() {
    for [keel, outer] in [[20.0, 28.0], [35.0, 25.0], [30.0, 45.0], [38.0, 30.0]] {
        let exact = |deadrise: f64| SimilarityFlow::solve(deadrise).expect("a solution").force_coefficient;
        let knuckle = 0.1;
        let section = bent(&[[knuckle, keel], [1.2, outer]]);
        let first = std::f64::consts::FRAC_2_PI * knuckle * keel.to_radians().tan();
        let rows = loads(&section, 0.5 * first, 0.3, SPEED);
        let early = at(&rows, 0.75 * first)[0] / (0.75 * first);
        assert!((early / exact(keel) - 1.0).abs() < 0.005, "{keel}°: {early} for {}", exact(keel));
        let (deep, higher) = (0.28, knuckle * (keel.to_radians().tan() - outer.to_radians().tan()));
        let late = at(&rows, deep)[0] / (deep - higher);
        assert!((late / exact(outer) - 1.0).abs() < 0.02, "{keel}°, then {outer}°: {late} for {}", exact(outer));
    }
}

/// All lengths times 3 and all speeds times 2: forces are 12 times as large, and with gravity at the same Froude number too.
#[test]
fn forces_scale_with_length_and_speed() {
    let faces = [[0.3, 22.0], [0.6, 36.0], [1.0, 24.0]];
    let large = faces.map(|[x, deadrise]| [3.0 * x, deadrise]);
    let follow = |faces: &[[f64; 2]], length: f64, speed: f64| {
        let gravity = 9.81 * speed * speed / length;
        let mut flow = EntryFlow::new(&bent(faces), 0.05 * length, speed, gravity).expect("in range");
        (0..260).map(|_| flow.step(|_| 0.0).expect("a step").1.force).collect::<Vec<_>>()
    };
    for (small, large) in follow(&faces, 1.0, 1.0).into_iter().zip(follow(&large, 3.0, 2.0)) {
        assert!((large / (12.0 * small) - 1.0).abs() < 1e-6, "{large} for {small}");
    }
}

/// At small deadrises the force is within a few per cent of the modified Logvinovich model's (Korobkin 2004), as a wedge's is, while the chines
/// are dry.
#[test]
fn a_flat_bent_bottom_is_near_the_formula() {
    let section = bent(&[[0.4, 15.0], [1.0, 20.0]]);
    let formula = Loads::new(EntryModel::Mlm, &section).expect("in range");
    let mut range = [1.0, 1.0];
    for [draught, force, _] in loads(&section, 0.03, 0.198, SPEED) {
        let share = force / formula.at(draught).slam;
        let c = formula.at(draught).wetted;
        if (c - 0.4).abs() > 0.08 {
            assert!((share - 1.0_f64).abs() < 0.04, "{draught} m, {c} m wet: {share} of the formula");
            range = [share.min(range[0]), share.max(range[1])];
        }
    }
    println!("{range:.3?} of the formula");
}

/// Faces, end [s], and the mean force of particles in five windows of the last four fifths of the run [kN/m].
type Case = (&'static [[f64; 2]], f64, [f64; 5]);

/// Particles, 10 mm, on sections 2 m wide of 6000 t/m (at constant speed, but for gravity) that enter at 5 m/s:
/// `resolution.fine_zone = [1.5, 0.5]`.
const PARTICLES: [Case; 9] = [
    (&[[0.5, 20.0], [1.0, 35.0]], 0.09, [102.7, 108.4, 132.0, 118.2, 100.9]),
    (&[[0.5, 30.0], [1.0, 20.0]], 0.08, [46.2, 91.6, 185.4, 244.5, 146.1]),
    (&[[0.4, 20.0], [1.0, 45.0]], 0.12, [54.3, 66.5, 84.5, 90.6, 84.1]),
    (&[[0.6, 35.0], [1.0, 55.0]], 0.12, [44.2, 62.7, 53.4, 61.1, 68.7]),
    (&[[0.6, 25.0], [1.0, 15.0]], 0.066, [63.4, 107.6, 223.1, 308.5, 161.7]),
    (&[[0.3, 15.0], [0.6, 25.0], [1.0, 40.0]], 0.094, [100.2, 98.4, 110.8, 100.7, 90.4]),
    (&[[0.35, 38.0], [1.0, 28.0]], 0.106, [32.5, 80.3, 141.0, 172.5, 122.0]),
    (&[[0.3, 15.0], [1.0, 48.0]], 0.12, [39.6, 50.4, 65.2, 81.2, 82.6]),
    (&[[0.7, 25.0], [1.0, 32.0]], 0.088, [84.9, 130.2, 154.0, 137.9, 109.2]),
];

/// Mean force between two times [N/m].
fn mean(instants: &[Instant], from: f64, to: f64) -> f64 {
    let within = instants.windows(2).filter(|w| w[0].time >= from - 1e-9 && w[1].time <= to + 1e-9);
    let impulse: f64 = within.map(|w| 0.5 * (w[0].force + w[1].force) * (w[1].time - w[0].time)).sum();
    impulse / (to - from)
}

#[test]
fn bent_bottoms_are_near_particles() {
    for (faces, end, particles) in PARTICLES {
        let section = bent(faces);
        let motion = SectionMotion::Free(6e6);
        let entry = FlowEntry { section: &section, motion, draught: 0.0, speed: 5.0, gravity: 9.81, density: 1000.0 };
        let times: Vec<f64> = (0..=1000).map(|k| end * f64::from(k) / 1000.0).collect();
        let (instants, _, over) = entry.solve(&times).expect("in range");
        assert!(over.is_none(), "{faces:?}: {over:?}");
        let window = |k: usize| end * (0.2 + 0.16 * k as f64);
        let ours: Vec<f64> = (0..5).map(|k| 1e-3 * mean(&instants, window(k), window(k + 1))).collect();
        println!("{faces:?}: {:+.1?} %", [0, 1, 2, 3, 4].map(|k| 100.0 * (particles[k] / ours[k] - 1.0)));
        for (ours, particles) in ours.iter().zip(particles) {
            assert!((particles / ours - 1.0).abs() < 0.05, "{faces:?}: {ours} kN/m, particles {particles}");
        }
        let [of_ours, of_particles] = [ours.iter().sum::<f64>(), particles.iter().sum()];
        assert!((of_particles / of_ours - 1.0_f64).abs() < 0.025, "{faces:?}: impulse {of_ours} for {of_particles}");
    }
}

/// A knuckle next to the chine changes little once the chine is wet: the force is near that about the bottom without it. With elements on the
/// last face shorter than those of the surface that leaves it, the potential at the chine oscillated and the force was two to five times as large.
#[test]
fn a_knuckle_next_to_a_wet_chine_changes_little() {
    for (near, plain) in [
        ([[0.93, 43.4], [1.0, 51.2]], 43.4),
        ([[0.96, 30.0], [1.0, 40.0]], 30.0),
        ([[0.95, 30.0], [1.0, 25.0]], 30.0),
        ([[0.95, 20.0], [1.0, 30.0]], 20.0),
        ([[0.85, 30.0], [1.0, 40.0]], 30.0),
    ] {
        let wet = |deadrise: f64| std::f64::consts::FRAC_2_PI * deadrise.to_radians().tan();
        let chines = wet(plain);
        assert!(EntryModel::BoundaryElement.covers(&bent(&near), 1.5).is_ok(), "{near:?}");
        let [near_rows, plain_rows] =
            [bent(&near), bent(&[[1.0, plain]])].map(|section| loads(&section, 0.05, 2.0 * chines, 2.0));
        for share in [1.4, 1.6, 1.8, 1.95] {
            let ([near_force, _], [plain_force, _]) = (at(&near_rows, share * chines), at(&plain_rows, share * chines));
            let ratio = near_force / plain_force;
            println!("{near:?}, {share}: {ratio:.3}");
            assert!((0.7..1.3).contains(&ratio), "{near:?}, {share}: {ratio:.3} of the plain bottom's force");
        }
    }
}

/// The force about a steep wedge goes on without a bend after its chines are wet.
#[test]
fn a_steep_wedge_with_wet_chines_has_a_steady_force() {
    let section = Section::wedge(59.1, 2.0).expect("a section");
    let motion = SectionMotion::Constant;
    let entry = FlowEntry { section: &section, motion, draught: 0.0, speed: 4.0, gravity: 9.81, density: 1000.0 };
    let times: Vec<f64> = (0..=400).map(|k| 1e-3 * f64::from(k)).collect();
    let (instants, _, over) = entry.solve(&times).expect("in range");
    assert!(over.is_none(), "{over:?}");
    let force = |time: usize| instants[time].force;
    let [first, second] = [force(360) - force(330), force(400) - force(360)];
    assert!(first > 0.0 && first < 0.06 * force(330), "{first} after {}", force(330));
    assert!(second > 0.0 && second < 0.08 * force(360), "{second} after {}", force(360));
}

/// What is outside the range is refused, with the next model that can.
#[test]
fn bottoms_that_are_not_followed_are_refused() {
    let refused = |faces: &[[f64; 2]]| {
        EntryModel::BoundaryElement.covers(&bent(faces), 0.0).expect_err("out of range").to_string()
    };
    let flat = refused(&[[0.5, 7.0], [1.0, 9.0]]);
    assert!(flat.contains("one with a face of 7.00 degrees") && flat.contains("\"mlm\""), "{flat}");
    let flared = refused(&[[0.5, 30.0], [1.0, 8.0]]);
    assert!(flared.contains("one with a face of 8.00 degrees") && flared.contains("\"wcsph\""), "{flared}");
    let steep = refused(&[[0.5, 65.0], [1.0, 70.0]]);
    assert!(steep.contains("65.00 degrees") && steep.contains("\"wcsph\""), "{steep}");
    let hollow = EntryModel::Mlm.covers(&bent(&[[0.5, 30.0], [1.0, 20.0]]), 0.0).expect_err("a hollow").to_string();
    assert!(hollow.contains("hollow") && hollow.contains("\"boundary_element\""), "{hollow}");
}

/// A bottom that turns up by little to a face that is too steep is followed until that face is wet; one that turns up sharply has a chine there.
#[test]
fn a_flow_ends_at_a_steep_face_or_leaves_the_bottom_there() {
    let follow = |faces: &[[f64; 2]]| {
        let section = bent(faces);
        let motion = SectionMotion::Constant;
        let entry = FlowEntry { section: &section, motion, draught: 0.0, speed: 2.0, gravity: 9.81, density: 1000.0 };
        let times: Vec<f64> = (0..=200).map(|k| 1.5e-3 * f64::from(k)).collect();
        entry.solve(&times).expect("in range")
    };
    let (instants, _, over) = follow(&[[0.5, 52.0], [1.0, 66.0]]);
    let why = over.expect("an end").to_string();
    assert!(why.contains("turns up by 14.0 degrees to 66.0 degrees at 0.5 m") && why.contains("wcsph"), "{why}");
    assert!(instants.len() > 50 && instants.iter().all(|now| now.wetted < 0.52), "{}", instants.len());
    let (instants, _, over) = follow(&[[0.5, 40.0], [0.6, 75.0]]);
    assert!(over.is_none() && instants.len() == 201, "{over:?}");
}

/// A section with a step is its lower part alone until the water comes to the step; this project's particles at 2 mm have the same mean forces until
/// then, 23.1 and 9.68 kN/m.
#[test]
fn a_step_is_dry_until_the_water_comes_to_it() {
    let half = [[0.0, 0.0], [0.2, 0.0728], [0.2, 0.11], [0.32, 0.16], [0.32, 0.4]];
    let whole: Vec<[f64; 2]> = half.into_iter().chain(half[1..].iter().rev().map(|[x, y]| [-x, *y])).collect();
    let [stepped, lower] =
        [Section::of_polygon(&whole), Section::new(&half[..2])].map(|section| section.expect("a section"));
    let times: Vec<f64> = (0..=150).map(|k| 2e-4 * f64::from(k)).collect();
    let followed = |section: &Section| {
        let (motion, gravity, density) = (SectionMotion::Free(150.0), 9.81, 998.2);
        FlowEntry { section, motion, draught: 0.0, speed: 5.0, gravity, density }.solve(&times).expect("a flow")
    };
    let ((with, _, end), (without, _, _)) = (followed(&stepped), followed(&lower));
    let end = end.expect("an end").to_string();
    assert!(end.contains("reaches a side or an outer part") && end.contains("\"wcsph\""), "{end}");
    for (a, b) in with.iter().zip(&without) {
        assert!((a.force - b.force).abs() <= 1e-9 * b.force.abs(), "{a:?} {b:?}");
    }
    let last = with[with.len() - 1];
    assert!((0.010..0.016).contains(&last.time) && last.draught < 0.11, "{last:?}");
    let mean = |from: f64| {
        let within = with.iter().filter(|now| (from..from + 0.001).contains(&(now.time + 1e-9)));
        let [sum, count] = within.fold([0.0; 2], |[sum, count], now| [sum + now.force, count + 1.0]);
        sum / count
    };
    for (from, particles) in [(0.006, 23_085.0), (0.012, 9675.0)] {
        assert!((mean(from) / particles - 1.0).abs() < 0.02, "{} for {particles}", mean(from));
    }
}
