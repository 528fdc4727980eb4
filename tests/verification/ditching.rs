//! 2D+t (THEORY EN14–EN19): exact limits of planing, what is conserved, trends of model tests, refusals.

use std::sync::LazyLock;

use evidence::landing::{RHO, landing, prism, tapered_hull};
use evidence::long::long;
use rayon::prelude::*;
use scenarios::ditching::{self, Accelerometer, Landed, Summary};
use scene::vocabulary::Status;
use water_entry::ditching::{Aeroplane, Attitude, LandingEnd, LandingState};
use water_entry::{EntryModel, Loads, Section};

/// The pressure of entry on all strips at no acceleration: forward, up, nose up.
fn pressing(now: &LandingState) -> [f64; 3] {
    let entries = now.strips.iter().filter_map(|(s, _)| s.entry);
    entries.fold([0.0; 3], |sum, e| [0, 1, 2].map(|k| sum[k] + e.pressing * e.lever[k]))
}

/// A wedge hull that planes at constant speed and trim τ: per length ρ A U² tan² τ, A in proportion to the draught, which falls
/// from h at the transom to nothing: ∫ = ½ ρ (A/h) h² U² tan τ upwards, and its tangent backwards. Its centre is h/(3 tan τ) ahead of the
/// transom. For von Karman A/h = π/tan² β, for Wagner π³/(4 tan² β).
#[test]
fn a_prismatic_wedge_planes_as_the_integral_over_its_length_says() {
    let (deadrise, pitch, speed, draught) = (25.0_f64, 0.1_f64, 40.0, 0.3);
    let tan2 = deadrise.to_radians().tan().powi(2);
    let pi = std::f64::consts::PI;
    for (model, per_draught) in [
        (EntryModel::VonKarman, pi / tan2),
        (EntryModel::Wagner, pi.powi(3) / (4.0 * tan2)),
        (EntryModel::Mlm, slope_of_mlm(deadrise)),
    ] {
        let hull = prism(model, deadrise);
        let landing = landing(&hull, 0.0, 5e4);
        let mut attitude = Attitude { place: [0.0, 0.0, pitch], rate: [speed, 0.0, 0.0], ..Attitude::default() };
        attitude.place[1] = -draught - attitude.of_point([10.0, 0.5], [20.0, 0.0])[1];
        let [fx, fz, moment] = pressing(&landing.moment(0.0, attitude, &[]));
        let exact = 0.5 * RHO * per_draught * draught * draught * speed * speed * pitch.tan();
        assert!((fz / exact - 1.0).abs() < 1e-3, "{model:?}: {fz}, exact {exact}");
        assert!((fx / (-exact * pitch.tan()) - 1.0).abs() < 1e-3, "{model:?}: {fx}");
        // the force stands across the keel, a distance s ahead of the transom along it
        let (ahead, above) = (-10.0 + draught / (3.0 * pitch.sin()), -0.5);
        let lever =
            ahead * pitch.cos() - above * pitch.sin() + (ahead * pitch.sin() + above * pitch.cos()) * pitch.tan();
        assert!((moment / (exact * lever) - 1.0).abs() < 1e-3, "{model:?}: {moment}, exact {}", exact * lever);
    }
}

fn slope_of_mlm(deadrise: f64) -> f64 {
    Loads::new(EntryModel::Mlm, &Section::wedge(deadrise, 4.0).expect("a section")).expect("in range").at(0.1).slam
        / 0.1
}

/// A hull that tapers, curves and pitches: what it loses in upward momentum the planes of water hold, those it has left too, and what
/// it loses in energy is the work Σ f ḣ.
#[test]
fn momentum_and_energy_go_to_the_water() {
    let hull = tapered_hull();
    let mut landing = landing(&hull, 0.0, 5e4);
    (landing.strips, landing.step, landing.sample_every) = (1000, 1e-3, 1);
    let run = landing.solve();
    assert_eq!(run.ended, LandingEnd::Time);
    let Aeroplane { mass, inertia, .. } = landing.aeroplane;
    let energy = |m: &LandingState| {
        let [u, w, q] = m.attitude.rate;
        0.5 * mass * (u * u + w * w) + 0.5 * inertia * q * q
    };
    let held = |m: &LandingState| -> f64 {
        let entries = m.strips.iter().filter_map(|(s, _)| s.entry);
        entries.map(|e| e.mass * e.at.speed).sum()
    };
    let left_behind = |m: &LandingState| {
        let last = m.strips.iter().filter_map(|(s, _)| s.entry).next_back();
        last.map_or(0.0, |e| if e.at.x > 19.9 { e.mass / e.length * e.at.speed * e.at.velocity[0] } else { 0.0 })
    };
    let power = |m: &LandingState| m.strips.iter().filter_map(|(s, f)| Some(f * s.entry?.at.speed)).sum::<f64>();
    let (mut wake, mut work) = (0.0, 0.0);
    for pair in run.moments.windows(2) {
        wake += 0.5 * landing.step * (left_behind(&pair[0]) + left_behind(&pair[1]));
        work += 0.5 * landing.step * (power(&pair[0]) + power(&pair[1]));
    }
    let (first, last) = (&run.moments[0], &run.moments[run.moments.len() - 1]);
    let gained = mass * (last.attitude.rate[1] - first.attitude.rate[1]);
    let given = held(last) + wake;
    println!("momentum {:.5} energy {:.6}", given / gained - 1.0, work / (energy(first) - energy(last)) - 1.0);
    assert!(gained > 0.3 * mass, "the water stops it: {gained}");
    assert!(wake > 0.2 * given, "planes are left behind: {wake} of {given}");
    assert!((given / gained - 1.0).abs() < 0.01, "{given} in the water, {gained} gained");
    let lost = energy(first) - energy(last);
    assert!((work / lost - 1.0).abs() < 1e-3, "{work} of work, {lost} lost");
}

fn loaded(name: &str, sets: &[&str]) -> ditching::Scene {
    let sets: Vec<String> = sets.iter().map(|s| s.to_string()).collect();
    ditching::load(name, &sets).expect("a landing")
}

fn landed(name: &str, sets: &[&str]) -> Landed {
    ditching::follow(&loaded(name, sets))
}

fn mercure(sets: &[&str]) -> Landed {
    landed("mercure", sets)
}

/// Half the strips and half the steps of a landing as it is: largest loads change by less than 5 %, which
/// `a_landing_has_no_grid_in_it_and_ends_slow_where_it_may` proves.
const COARSE: [&str; 3] = ["landing.strips=100", "landing.step=0.002", "landing.sample_every=0.004"];

/// Strips and steps of these tests: coarse ones, and in the long variant those of a landing as it is.
fn strips_and_steps() -> &'static [&'static str] {
    if long() { &[] } else { &COARSE }
}

/// A landing up to the largest loads, which come before 2.7 s, in 5 s of the landings too; in the long variant up to 5 s. At an angle of
/// attack [deg], a path [deg] and a mass [kg].
fn mercure_at(attack: f64, path: f64, mass: f64, more: &[&str]) -> Landed {
    let keys = [
        format!("landing.angle_of_attack_deg={attack:?}"),
        format!("landing.flight_path_deg={path:?}"),
        format!("aeroplane.mass={mass:?}"),
    ];
    let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
    let end = if long() { "landing.end=5.0" } else { "landing.end=3.0" };
    mercure(&[&keys[..], strips_and_steps(), &[end], more].concat())
}

/// Angle of attack and path [deg], mass [kg], ranges of the largest vertical and longitudinal acceleration [g].
type ModelTest = (f64, f64, f64, [f64; 2], [f64; 2]);

/// Table 1 of Pilorget (2010), after the IMFL: angle of attack, path, a lighter and a heavier model, then the ranges of the largest vertical and
/// longitudinal accelerations [g].
const MODEL_TESTS: [ModelTest; 14] = [
    (18.0, -1.0, 44.7e3, [2.9, 3.1], [1.0, 1.7]),
    (18.0, -2.0, 44.7e3, [2.9, 3.7], [1.3, 1.9]),
    (18.0, -1.0, 49.0e3, [3.4, 4.1], [1.7, 1.9]),
    (18.0, -2.0, 49.0e3, [3.1, 3.6], [1.1, 1.2]),
    (15.0, -1.0, 44.7e3, [2.5, 3.5], [1.5, 1.7]),
    (15.0, -2.0, 44.7e3, [3.3, 4.1], [1.6, 1.7]),
    (15.0, -1.0, 49.0e3, [4.0, 4.5], [1.8, 2.0]),
    (15.0, -2.0, 49.0e3, [4.1, 4.7], [1.9, 2.6]),
    (12.0, -1.0, 44.7e3, [4.5, 5.3], [2.0, 5.0]),
    (12.0, -2.0, 44.7e3, [4.8, 5.3], [2.2, 2.5]),
    (12.0, -1.0, 49.0e3, [4.7, 5.0], [2.1, 5.5]),
    (12.0, -2.0, 49.0e3, [4.8, 7.5], [2.7, 3.7]),
    (9.0, -1.0, 44.7e3, [5.7, 5.7], [7.5, 7.5]),
    (9.0, -2.0, 44.7e3, [7.5, 7.5], [7.5, 7.5]),
];

/// Angle of attack and path [deg], mass [kg].
type FirstTouch = (f64, f64, f64);

/// A landing that was not tested: the third of its row.
const UNTESTED: FirstTouch = (9.0, -1.0, 49.0e3);

/// The landings of the model tests and the one that was not tested, by angle of attack, path and mass.
static LANDINGS: LazyLock<Vec<(FirstTouch, Summary)>> = LazyLock::new(|| {
    let tested = MODEL_TESTS.iter().map(|(attack, path, mass, ..)| (*attack, *path, *mass));
    let all: Vec<_> = tested.chain([UNTESTED]).collect();
    all.into_par_iter().map(|at| (at, mercure_at(at.0, at.1, at.2, &[]).summary)).collect()
});

/// The landing at an angle of attack, a path and a mass.
fn landing_at(at: FirstTouch) -> &'static Summary {
    LANDINGS.iter().find(|(of, _)| *of == at).map(|(_, summary)| summary).expect("a landing")
}

/// The file's coefficients stand for all cells: longitudinal accelerations within a factor 1.5 in 10 of 14, vertical ones in 7; none above
/// the tests by more than 2.2, none below by more than 2.8; the pitch never passes that of the first touch by a degree.
#[test]
fn loads_of_a_mercure_against_model_tests() {
    let mut within = [0, 0];
    for (attack, path, mass, vertical, longitudinal) in MODEL_TESTS {
        let s = landing_at((attack, path, mass));
        assert!(
            s.status == Status::Completed && s.pitch_deg[2] < s.pitch_deg[0] + 1.0,
            "{attack}, {path}: {:?}",
            s.pitch_deg
        );
        let shown = &s.structure.accelerometers;
        let most = |of: fn(&Accelerometer) -> f64| shown.iter().map(of).fold(0.0, f64::max);
        let pairs = [(most(|a| a.normal_g.value), vertical), (most(|a| a.longitudinal_g.value), longitudinal)];
        for (count, (ours, [low, high])) in within.iter_mut().zip(pairs) {
            assert!(ours > low / 2.8 && ours < 2.2 * high, "{attack}, {path}, {mass}: {ours}, tests {low} to {high}");
            *count += usize::from(ours > low / 1.5 && ours < 1.5 * high);
        }
    }
    println!("{within:?}");
    assert!(within[0] >= 7 && within[1] >= 10, "{within:?}");
}

/// Longitudinal accelerations rise as the angle of attack falls, with the steepness of the path and with the mass, as in the tests.
#[test]
fn decelerations_of_a_mercure_follow_the_trends_of_model_tests() {
    let at = |attack: f64, path: f64, mass: f64| landing_at((attack, path, mass)).deceleration_g.value;
    let row = |path: f64, mass: f64| [18.0, 15.0, 12.0, 9.0].map(|attack| at(attack, path, mass));
    let (flat, steep, heavy) = (row(-1.0, 44.7e3), row(-2.0, 44.7e3), row(-1.0, 49.0e3));
    println!("{flat:.4?} {steep:.4?} {heavy:.4?}");
    for row in [&flat, &steep, &heavy] {
        assert!(row.windows(2).all(|w| w[1] > 1.02 * w[0]), "{row:?}");
    }
    for k in 0..4 {
        assert!(steep[k] > 1.02 * flat[k] && heavy[k] > 1.02 * flat[k], "{flat:?} {steep:?} {heavy:?}");
    }
}

/// NACA tests of three models: longitudinal deceleration within a factor 1.5, and the same behaviour: the bomb bays give way, the run is short.
#[test]
fn decelerations_of_the_nacas_models() {
    for (name, longitudinal, lengths, length) in
        [("xp2v", 4.0, 2.0, 23.0), ("b36", 3.0, 4.5, 49.4), ("constellation", 4.0, f64::NAN, 29.0)]
    {
        let s = landed(name, strips_and_steps()).summary;
        let ratio = s.deceleration_g.value / longitudinal;
        assert!((1.0 / 1.5..1.5).contains(&ratio), "{name}: {:?}, tests {longitudinal} g", s.deceleration_g);
        let run = s.run_length_m / length;
        println!("{name}: {ratio} of the tests' deceleration, {run} lengths");
        assert!(
            lengths.is_nan() || (lengths / 2.0..2.0 * lengths).contains(&run),
            "{name}: {run} lengths, tests {lengths}"
        );
        assert!(s.structure.parts.iter().any(|p| p.lost_at_s.is_some()), "{name}: {:?}", s.structure.parts);
    }
}

/// Without suction nothing holds the tail: the nose comes down and slams, the harder the higher it was.
#[test]
fn without_suction_the_nose_comes_down_and_slams() {
    let cockpit = |suction: &str| {
        let s = mercure_at(18.0, -1.0, 44.7e3, &[suction]).summary;
        s.structure.accelerometers[0].normal_g.value
    };
    let [none, half, whole] = ["water.suction=0.0", "water.suction=0.5", "water.suction=1.0"].map(cockpit);
    println!("{none} {half} {whole}");
    assert!(none > 1.2 * half && half > 1.2 * whole, "{none} {half} {whole}");
}

/// Largest loads are within 5 % of those with half the strips and steps; in the long variant, of those with twice as many. The same landing
/// has the same bits.
#[test]
fn a_landing_has_no_grid_in_it_and_ends_slow_where_it_may() {
    let usual = mercure(&[]).summary;
    let finer = ["landing.strips=400", "landing.step=0.0005"];
    let other = if long() { mercure(&finer).summary } else { landing_at((12.0, -1.0, 44.7e3)).clone() };
    println!("{} strips: {:?} {:?}, {:?} {:?}", other.strips, usual.az_g, other.az_g, usual.fz_n, other.fz_n);
    assert!((usual.az_g.value / other.az_g.value - 1.0).abs() < 0.05, "{:?} {:?}", usual.az_g, other.az_g);
    assert!((usual.fz_n.value / other.fz_n.value - 1.0).abs() < 0.05, "{:?} {:?}", usual.fz_n, other.fz_n);
    let [slow, again] = [0, 1].map(|_| mercure(&["landing.least_speed=55.0"]));
    assert_eq!(slow.run.ended, LandingEnd::Slow);
    assert!(slow.summary.time_end_s < 5.0 && slow.summary.speed_m_per_s[1] < 55.0);
    assert_eq!(again.summary.az_g.value.to_bits(), slow.summary.az_g.value.to_bits());
    assert_eq!(again.run.moments.last(), slow.run.moments.last());
}

/// At rest on the water, level, the weight is that of the water displaced.
#[test]
fn it_floats_at_its_weight() {
    let hull = prism(EntryModel::Wagner, 25.0);
    let landing = landing(&hull, 9.81, 5e4);
    let attitude = Attitude { place: [0.0, 0.5 - 0.4, 0.0], ..Attitude::default() };
    let [fx, fz, moment] = landing.moment(0.0, attitude, &[]).force;
    let area = 0.4 * 0.4 / 25f64.to_radians().tan();
    assert!((fz / (RHO * 9.81 * area * 20.0) - 1.0).abs() < 1e-9 && fx == 0.0, "{fx} {fz}");
    assert!(moment.abs() < 1e-6 * fz, "{moment}");
}

#[test]
fn sections_are_scenes_that_can_be_run() {
    let scene = loaded("mercure", &COARSE);
    let sections = ditching::section_scenes(&scene, &ditching::follow(&scene), 3);
    assert_eq!(sections.len(), 3);
    for section in &sections {
        let loaded = run::load_text(&section.name, &section.text, &[]).expect("a scene");
        assert_eq!(loaded.scene.name, section.name);
        let (_, rates) = section.text.split_once("displacement_rates = [\n    [0.0, ").expect("rates");
        let at_contact: f64 = rates.split(',').next().expect("a rate").parse().expect("a number");
        assert!(at_contact < -1.0 && section.time_s < loaded.scene.time.end, "{}", section.text);
    }
}

#[test]
fn wrong_landings_are_refused_with_key_and_place() {
    let refused = |sets: &[&str], says: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|s| s.to_string()).collect();
        let text = ditching::load("mercure", &sets).expect_err("refused").to_string();
        says.iter().for_each(|s| assert!(text.contains(s), "{text} does not say {s}"));
    };
    refused(&["landing.flight_path_deg=1.0"], &["landing.flight_path_deg", "a number from -15"]);
    refused(&["landing.angle_of_attack_deg=0.5"], &["landing.angle_of_attack_deg", "an attitude of 0 to 30 degrees"]);
    refused(&["landing.angle_of_atack_deg=9"], &["unknown key", "landing.angle_of_attack_deg"]);
    refused(&["water.suction=2"], &["water.suction", "from 0 to 1"]);
    refused(&["stations[3].x=1.0"], &["stations[3]", "expected more than the 1.6 m before"]);
    refused(&["stations[4].radius=0.5"], &["stations[4]", "at least half the breadth"]);
    refused(&["stations[6].breadth=3.89"], &["stations[6]", "faces of 4 to 60 degrees"]);
    refused(&["stations[12].keel=9.0"], &["stations[", "to the axis: expected up to 60"]);
    refused(&["stations[2].deadrise_deg=20"], &["stations[2].deadrise_deg", "not both"]);
    refused(&["model=wcsph"], &["model", "`von_karman`, `wagner`, `mlm`"]);
    refused(&["model=similarity"], &["model", "`von_karman`, `wagner`, `mlm`"]);
    refused(&["landing.least_speed=90"], &["landing.least_speed", "less than the speed of landing"]);
    refused(&["wing.lift_slope=0"], &["landing.angle_of_attack_deg", "landing.speed"]);
    let text = "name = \"a\"\n[landing]\nangle_of_attack_deg = 9\nflight_path_deg = -40\nend = 1\n[aeroplane]\nmass = 1e4\n\
                radius_of_gyration = 3\ncenter_of_mass = [5, 0]\n[wing]\narea = 40\nchord = 2\nlift_slope = 4\nzero_lift_deg = -5\n\
                [[stations]]\nx = 0\nkeel = 0\nbreadth = 1\ndeadrise_deg = 20\n";
    let error = ditching::load_text("mine.toml", text, &[]).expect_err("refused").to_string();
    assert!(error.contains("mine.toml:4"), "{error}");
}
