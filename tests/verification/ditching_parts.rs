//! Parts of an aeroplane that meet the water, bounds of suction, and section forces of the fuselage (THEORY EN25–EN29).

use evidence::landing::{self as plain, CENTRE, RHO};
use scenarios::ditching::{self, Landed};
use water_entry::EntryModel;
use water_entry::ditching::{Attitude, Bending, Hull, Landing, Masses, Nacelle, Panel, Rib, Surface, Swell};

/// A prismatic hull of 20 m.
fn prism() -> Hull {
    plain::prism(EntryModel::Mlm, 25.0)
}

/// With friction and gravity.
fn landing(hull: &Hull) -> Landing<'_> {
    let mut landing = plain::landing(hull, 9.81, 5e4);
    landing.water.friction = 0.003;
    (landing.strips, landing.step, landing.sample_every, landing.end) = (200, 5e-4, 5, 0.4);
    landing
}

/// At a forward speed and a pitch, with a place of the aeroplane a depth under water.
fn immersed(place: [f64; 2], depth: f64, speed: f64, pitch: f64) -> Attitude {
    let mut now = Attitude { place: [0.0, 0.0, pitch], rate: [speed, 0.0, 0.0], ..Attitude::default() };
    now.place[1] = -depth - now.of_point(CENTRE, place)[1];
    now
}

/// A rectangular plate that planes: span 2b, wetted chord d/sin τ, Shuford's coefficient, force across the chord.
#[test]
fn a_plate_planes_with_shufords_force() {
    let rib = |y: f64| Rib { leading_edge: [12.0, y, -1.0], chord: 3.0 };
    let plate = Surface { name: "plate".into(), ribs: [rib(0.0), rib(4.0)], incidence: 0.05, breaks_at: None };
    let (speed, pitch, depth) = (30.0, 0.1_f64, 0.2);
    let trim: f64 = pitch + 0.05;
    let trailing_edge = [12.0 + 3.0 * 0.05_f64.cos(), -1.0 - 3.0 * 0.05_f64.sin()];
    let now = immersed(trailing_edge, depth, speed, pitch);
    let chord = depth / trim.sin();
    let aspect = 8.0 / chord;
    let shuford =
        0.5 * std::f64::consts::PI * aspect / (1.0 + aspect) * trim * trim.cos() + 4.0 / 3.0 * trim.sin().powi(2);
    let normal = 0.5 * RHO * speed * speed * 8.0 * chord * shuford;
    let forces = plate.water(CENTRE, &now, &Swell::default(), RHO);
    let sum = forces.iter().fold([0.0; 3], |sum, p| [0, 1, 2].map(|k| sum[k] + p.force[k]));
    assert!((sum[1] / (normal * trim.cos()) - 1.0).abs() < 1e-9, "{sum:?}");
    assert!((sum[0] / (-normal * trim.sin()) - 1.0).abs() < 1e-9, "{sum:?}");
    // it stands at the middle of the wetted chord
    let s = 3.0 - 0.5 * chord;
    let [px, pz] = now.of_point(CENTRE, [12.0 + s * 0.05_f64.cos(), -1.0 - s * 0.05_f64.sin()]);
    let moment = (px - now.place[0]) * sum[1] - (pz - now.place[1]) * sum[0];
    assert!((sum[2] / moment - 1.0).abs() < 1e-9, "{sum:?} {moment}");
    let above = immersed(trailing_edge, -0.01, speed, pitch);
    assert!(plate.water(CENTRE, &above, &Swell::default(), RHO).is_empty(), "above the water nothing");
}

/// Half a face under water has half its drag, all of it no more than the whole.
#[test]
fn a_nacelles_face_has_the_drag_of_what_is_immersed() {
    let of = |depth: f64| {
        let nacelle = Nacelle::new("n".into(), 2.0, [8.0, -1.0], 1.5, 4.0, 0.8, None, EntryModel::Mlm).expect("a body");
        let now = immersed([8.0, -1.75], depth, 40.0, 0.0);
        nacelle.face_drag(CENTRE, &now, &Swell::default(), RHO).map_or([0.0; 3], |p| p.force)
    };
    let whole = 0.5 * RHO * 0.8 * 2.0 * std::f64::consts::PI * 0.75 * 0.75 * 1600.0;
    for (depth, share) in [(0.75, 0.5), (1.5, 1.0), (4.0, 1.0), (-0.1, 0.0)] {
        let [drag, up, _] = of(depth);
        assert!((drag + share * whole).abs() < 1e-9 * whole && up == 0.0, "{depth}: {drag}, {up}");
    }
}

/// The force of the water is the sum of those on strips and parts.
#[test]
fn forces_of_strips_and_parts_add_up_to_that_of_the_water() {
    let hull = prism();
    let mut landing = landing(&hull);
    let rib = |y: f64| Rib { leading_edge: [9.0, y, 0.2], chord: 3.0 };
    landing.aeroplane.surfaces =
        vec![Surface { name: "wing".into(), ribs: [rib(2.0), rib(8.0)], incidence: 0.03, breaks_at: None }];
    landing.aeroplane.nacelles =
        vec![Nacelle::new("n".into(), 2.0, [6.0, 0.3], 1.2, 4.0, 0.8, None, EntryModel::Mlm).expect("a body")];
    let run = landing.solve();
    let deep = run.moments.iter().filter(|m| m.parts.iter().all(|p| !p.is_empty())).count();
    assert!(deep > 5, "the parts meet the water: {deep} of {}", run.moments.len());
    for m in &run.moments {
        let mut sum = [0.0; 3];
        for (strip, f) in &m.strips {
            let lever = strip.entry.map_or([0.0; 3], |e| [0, 1, 2].map(|k| f * e.lever[k]));
            let rub = strip.rubbing(0.5 * RHO * 0.003);
            (0..3).for_each(|k| sum[k] += lever[k] + rub[k] + strip.floating()[k]);
        }
        m.parts.iter().flatten().for_each(|p| (0..3).for_each(|k| sum[k] += p.force[k]));
        let size = m.force[0].hypot(m.force[1]) * 10.0 + 1.0;
        (0..3).for_each(|k| assert!((sum[k] - m.force[k]).abs() < 1e-9 * size, "{sum:?} {:?}", m.force));
    }
}

fn mercure(sets: &[&str]) -> Landed {
    let sets: Vec<String> = sets.iter().map(|s| s.to_string()).collect();
    ditching::follow(&ditching::load("mercure", &sets).expect("a landing"))
}

/// A largest suction of 0 is water without suction; a large one is the theory's.
#[test]
fn suction_is_bounded() {
    let z = |sets: &[&str]| mercure(&[&["landing.end=1.0"], sets].concat()).series.column("z_m").expect("a column");
    assert_eq!(z(&["water.largest_suction=0.0"]), z(&["water.suction=0.0"]));
    let (bounded, free) = (z(&["water.largest_suction=2e4"]), z(&["water.largest_suction=1e9"]));
    assert_ne!(bounded, free);
    let run = mercure(&["landing.end=1.0", "water.largest_suction=2e4"]).run;
    let pulls = run.moments.iter().flat_map(|m| &m.strips).filter_map(|(s, f)| Some(f / s.entry?.still_area));
    let most = pulls.filter(|p| p.is_finite()).fold(0.0, f64::min);
    assert!(most > -2e4 * (1.0 + 1e-9) && most < -1.9e4, "{most} Pa");
}

/// A part is lost at the load that it holds, and then has no load; a bottom that gives way leaves a frame in the water.
#[test]
fn parts_are_lost_at_their_loads() {
    let landed = mercure(&["landing.end=0.5"]);
    let flaps = landed.summary.structure.parts.iter().find(|p| p.name == "flaps").expect("flaps");
    let lost = flaps.lost_at_s.expect("lost");
    let (times, force) = (landed.series.column("time_s").unwrap(), landed.series.column("flaps.fz_N").unwrap());
    times.iter().zip(&force).for_each(|(t, f)| assert!((*t < lost) == (*f != 0.0) || *f == 0.0, "{t}: {f}"));
    assert!(flaps.force_n.value > 0.7 * 1.8e5 && flaps.force_n.value < 1.1 * 1.8e5, "{flaps:?}");

    let hull = prism();
    let mut landing = landing(&hull);
    let panel =
        |limit: f64| Panel { name: "p".into(), ends: [8.0, 14.0], gives_way_at: limit, frame_height: 0.5, drag: 0.8 };
    let speed = |landing: &Landing<'_>| landing.solve().moments.last().expect("an end").attitude.rate[0];
    landing.aeroplane.panels = vec![panel(1e9)];
    let whole = speed(&landing);
    landing.aeroplane.panels = vec![panel(1e3)];
    let open = landing.solve();
    assert!(open.moments.last().is_some_and(|m| m.lost[0]), "it gives way");
    assert!(open.moments.last().is_some_and(|m| m.strips.iter().all(|(s, _)| !(8.01..13.99).contains(&s.wet.x))));
    assert!(speed(&landing) < whole - 0.5, "and stops it: {} against {whole} m/s", speed(&landing));
}

/// Afloat at rest, uniform masses on a uniform hull: no cut has a force. A mass at its middle bends the ends upwards: with the weight P there and
/// the rest spread, M = P L/8.
#[test]
fn cuts_of_a_floating_hull_have_the_forces_of_statics() {
    let hull = prism();
    let mut landing = landing(&hull);
    landing.water.friction = 0.0;
    (landing.aeroplane.mass, landing.aeroplane.inertia) = (2e4, 2e4 * 25.0); // its chines are dry
    let draught = (2e4 / (20.0 * RHO) * 25f64.to_radians().tan()).sqrt();
    let now = Attitude { place: [0.0, 0.5 - draught, 0.0], ..Attitude::default() };
    let node = |k: usize| 20.0 * k as f64 / 60.0;
    let uniform =
        |total: f64| (0..61).map(|k| total / 60.0 * if k % 60 == 0 { 0.5 } else { 1.0 }).collect::<Vec<f64>>();
    let mut masses = Masses { x: (0..61).map(node).collect(), mass: uniform(2e4) };
    // half the way between two nodes, where lumps and strips are in balance
    let places: Vec<f64> = (0..60).map(|k| node(k) + 1.0 / 6.0).collect();
    let state = landing.moment(0.0, now, &[]);
    assert!(state.acceleration[1].abs() < 1e-6 && state.acceleration[2].abs() < 1e-9, "{:?}", state.acceleration);
    let weight = 2e4 * 9.81;
    for cut in landing.section_forces(&state, &masses, &places) {
        assert!(cut.shear.abs() < 1e-2 * weight && cut.bending.abs() < 1e-3 * weight * 20.0, "{cut:?}");
    }
    masses.mass = uniform(1e4);
    masses.mass[30] += 1e4;
    let cuts = landing.section_forces(&state, &masses, &[10.0 - 1e-6, 10.0 + 1e-6, 20.0 + 1e-6]);
    let exact = 0.5 * weight * 20.0 / 8.0;
    assert!((cuts[0].bending / exact - 1.0).abs() < 0.01, "{cuts:?}, exact {exact}");
    assert!((cuts[1].shear - cuts[0].shear - 0.5 * weight).abs() < 0.02 * weight, "{cuts:?}");
    assert!(cuts[2].shear.abs() < 1e-9 * weight && cuts[2].bending.abs() < 1e-8 * weight * 20.0, "{cuts:?}");
}

/// A very stiff fuselage lands as a rigid one; one that bends takes nothing from nowhere: its cuts are in balance, and its modes' energy
/// is less than what the water gave.
#[test]
fn a_stiff_fuselage_lands_as_a_rigid_one() {
    let hull = prism();
    let mut landing = landing(&hull);
    landing.strips = 100;
    let rigid = landing.solve();
    let masses = Masses::new([0.0, 20.0], 5e4, 10.0, 5e4 * 25.0, &[]).expect("masses");
    let end = |run: &water_entry::ditching::LandingResult| run.moments.last().expect("an end").attitude;
    landing.aeroplane.bending = Some(Bending::new(&masses, |_| 2e11, 0.02).expect("modes"));
    landing.step = 2e-4;
    landing.sample_every = 12;
    let stiff = end(&landing.solve());
    for k in 0..3 {
        let (a, b) = (end(&rigid).rate[k], stiff.rate[k]);
        println!("{k} {a} {b} {}", (a - b).abs() / (1.0 + a.abs()));
        assert!((a - b).abs() < 2e-3 * (1.0 + a.abs()), "{k}: {a} rigid, {b} stiff");
    }
    landing.aeroplane.bending = Some(Bending::new(&masses, |_| 5e8, 0.02).expect("modes"));
    let soft = landing.solve();
    let bent = soft.moments.iter().map(|m| m.attitude.bend[0].abs()).fold(0.0, f64::max);
    assert!(bent > 10.0 * stiff.bend[0].abs(), "{bent}");
    for m in &soft.moments {
        let cuts = landing.section_forces(m, &masses, &[10.0, 20.0 + 1e-6]);
        assert!(cuts[1].shear.abs() < 1e-6 * 5e4 * 9.81, "{cuts:?}");
    }
}

/// The built-in landing with a bending fuselage is in balance. The largest deceleration comes before 2.5 s.
#[test]
fn a_bending_mercure_is_in_balance() {
    let usual = ["landing.strips=100", "landing.end=2.5"];
    let landed = mercure(&[&usual[..], &["beam.stiffness=[1e9, 3e9, 3e9, 1e9]"]].concat());
    let s = &landed.summary.structure;
    assert!(s.balance_error < 1e-6, "{}", s.balance_error);
    assert!((3.0..8.0).contains(&s.frequencies_hz[0]), "{:?}", s.frequencies_hz);
    let rigid = mercure(&usual).summary;
    println!(
        "{:?} {:?} {} {}",
        landed.summary.deceleration_g, rigid.deceleration_g, s.balance_error, rigid.structure.balance_error
    );
    assert!(rigid.structure.balance_error < 1e-9);
    assert!((landed.summary.deceleration_g.value / rigid.deceleration_g.value - 1.0).abs() < 0.05);
}

#[test]
fn wrong_parts_are_refused_with_key_and_place() {
    let refused = |sets: &[&str], says: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|s| s.to_string()).collect();
        let text = ditching::load("mercure", &sets).expect_err("refused").to_string();
        says.iter().for_each(|s| assert!(text.contains(s), "{text} does not say {s}"));
    };
    refused(&["surfaces[0].tip=[18.9, 1.0, -0.4]"], &["surfaces[0].tip", "further from the plane of symmetry"]);
    refused(&["surfaces[0].chords=[6.0, 0.0]"], &["surfaces[0].chords", "above 0"]);
    refused(&["surfaces[1].name=wing"], &["surfaces[1].name", "nothing else has"]);
    refused(&["nacelles[0].diameter=-1.0"], &["nacelles[0].diameter"]);
    refused(&["nacelles[0].number=0"], &["nacelles[0].number"]);
    refused(&["accelerometers[0].bandwidth=90.0"], &["accelerometers[0].bandwidth", "40 Hz", "sample_every"]);
    refused(&["aeroplane.radius_of_gyration=15.0"], &["aeroplane.radius_of_gyration", "radius of gyration of 0."]);
    refused(&["beam.stiffness=[0.0]"], &["beam.stiffness", "above 0"]);
    refused(&["beam.stiffness=[1e3]"], &["beam.stiffness", "a slowest mode of at least", "bending is linear"]);
    refused(&["beam.stiffness=[9e11]"], &["landing.step", "Hz is to be followed"]);
    refused(&["water.largest_suction=-1.0"], &["water.largest_suction"]);
    refused(&["masses=[{x=5.0,mass=9e4}]"], &["masses[0].mass", "leave something of aeroplane.mass"]);
    refused(&["masses=[{x=50.0,mass=9e2}]"], &["masses[0].x", "from 0 to 34.8 m"]);
    refused(&["nacelles[0].length=0.0"], &["nacelles[0].length"]);
}
