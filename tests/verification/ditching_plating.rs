//! Plating of a landing (THEORY EN63, EN64): the way of a section into its plane of water, its stresses, refusals.

use std::path::Path;

use evidence::landing::{landing, tapered_hull};
use run::{RunOptions, load_text};
use scenarios::ditching::{self, PlatingStress};
use water_entry::ditching::{PlaneHistory, Swell};

/// In calm water and in waves, the rate of the draught in a plane of water is its speed, and the rate of that its acceleration: over each step of
/// the landing, by the trapezoidal rule.
#[test]
fn draught_speed_and_acceleration_in_a_plane_of_water_fit() {
    let hull = tapered_hull();
    for swell in [Swell::default(), Swell::new(0.8, 30.0, 2.6, 9.81).with_phase_at(0.0, 4.0)] {
        let mut landing = landing(&hull, 9.81, 5e4);
        (landing.swell, landing.step, landing.sample_every) = (swell, 5e-4, 10);
        let run = landing.solve();
        let heaviest = run.moments.iter().max_by(|a, b| a.force[1].total_cmp(&b.force[1])).expect("moments");
        let entries: Vec<f64> = heaviest.strips.iter().filter_map(|(s, _)| Some(s.entry?.at.x)).collect();
        let x = entries[entries.len() / 3];
        let PlaneHistory { rows } = landing.plane_history(&run.flight, heaviest.time, x).expect("a way");
        assert!(rows.len() > 20 && rows[0].draught == 0.0, "{} rows", rows.len());
        assert!(rows.windows(2).all(|pair| pair[1].x > pair[0].x), "the plane goes aft");
        let (mut of_draught, mut of_speed) = (0.0, 0.0);
        for pair in rows.windows(2) {
            let dt = pair[1].time - pair[0].time;
            of_draught += pair[1].draught - pair[0].draught - 0.5 * dt * (pair[0].speed + pair[1].speed);
            of_speed += pair[1].speed - pair[0].speed - 0.5 * dt * (pair[0].rate + pair[1].rate);
        }
        let last = rows[rows.len() - 1];
        let most = rows.iter().map(|row| row.speed.abs()).fold(0.0, f64::max);
        assert!(of_draught.abs() < 1e-4 * last.draught, "{of_draught} of {} m", last.draught);
        assert!(of_speed.abs() < 1e-3 * most, "{of_speed} of {most} m/s");
    }
}

/// A fuselage whose keel is level falls flat at 8 m/s: a wedge of 20 degrees whose plates bend, as a scene has it. The nose is raised.
const FLAT_FALL: &str = r#"
name = "flat_fall"
[landing]
angle_of_attack_deg = 11.3
flight_path_deg = -11.3
speed = 40.82624
end = 0.02
least_speed = 1.0
[aeroplane]
mass = 1e9
radius_of_gyration = 2.5
center_of_mass = [5.0, 1.0]
[wing]
area = 1.0
chord = 1.0
lift_slope = 4.0
zero_lift_deg = 11.3
[[stations]]
x = 0.0
keel = 0.5
breadth = 1.2
deadrise_deg = 20.0
[[stations]]
x = 1.0
keel = 0.0
breadth = 1.2
deadrise_deg = 20.0
[[stations]]
x = 10.0
keel = 0.0
breadth = 1.2
deadrise_deg = 20.0
"#;

fn plating(more: &str) -> String {
    format!(
        "{FLAT_FALL}[[plating]]\nname = \"side\"\nfrom = 3.0\nto = 9.0\nsupports = [0.0, 1.0]\nthickness = 0.02\n\
         youngs_modulus = 70e9\ndensity = 2700.0\nallowable_stress = 2e8\nsections = 1\n{more}"
    )
}

fn stresses(name: &str, text: &str) -> (Vec<PlatingStress>, String) {
    let scene = ditching::load_text("flat_fall.toml", text, &[]).expect("a landing");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let landed = ditching::run(&scene, &folder, true).expect("files");
    let map = std::fs::read_to_string(folder.join("stress_map.csv")).expect("a map");
    (landed.summary.structure.plating, map)
}

#[test]
fn a_fuselage_that_falls_flat_has_the_stress_of_a_wedge() {
    let (found, map) = stresses("flat_fall", &plating(""));
    let [side] = &found[..] else { panic!("one plating") };
    assert!(side.sections.iter().all(|section| section.refused.is_none()), "{:?}", side.sections);
    let [bay] = &side.bays[..] else { panic!("one bay") };
    let stress = bay.stress_pa.as_ref().expect("a stress").value;
    let edge = 0.6 * 20_f64.to_radians().tan();
    let wedge = format!(
        "name = \"wedge\"\nmodel = \"boundary_element\"\nsymmetry = \"x\"\n[time]\nend = 0.018\nsample_every = 2e-5\n\
         [resolution]\nspacing = 0.01\n[fluid]\ndensity = 1000.0\n[body]\nname = \"section\"\nshape = \"wedge\"\nbreadth = 1.2\n\
         deadrise_deg = 20.0\nside_height = 0.3\nmass = 1e9\nfree = [\"y\"]\nvelocity = [0.0, -8.0]\n\
         [[body.panels]]\nname = \"plate\"\nfrom = [0.0, 0.0]\nto = [0.6, {edge}]\nelements = 16\nthickness = 0.02\n\
         youngs_modulus = 70e9\ndensity = 2700.0\n"
    );
    let scene = load_text("wedge.toml", &wedge, &[]).expect("a scene").scene;
    let alone = run::run(&scene, &RunOptions::default()).expect("a run").series;
    let end = side.sections[0].time_s;
    let rows = alone.times().into_iter().zip(alone.column("plate.stress_Pa").expect("a column"));
    let expected = rows.fold(0.0_f64, |most, (_, stress)| most.max(stress.abs()));
    assert!((stress / expected - 1.0).abs() < 0.01, "{stress}, the wedge alone {expected} Pa; load largest at {end} s");
    assert!((bay.reserve_factor.expect("a reserve") * stress / 2e8 - 1.0).abs() < 1e-12);
    assert_eq!(map.lines().count(), 2, "{map}");
}

/// Pressures are those of the landing's theory: EN64 of twice the thickness has a quarter of the stress, of pinned plates one and a half times.
#[test]
fn stresses_at_rest_follow_the_plate() {
    let at_rest = |text: &str| stresses("flat_fall_at_rest", text).0[0].bays[0].static_stress_pa.expect("a load").value;
    let (thin, thick) = (at_rest(&plating("")), at_rest(&plating("").replace("thickness = 0.02", "thickness = 0.04")));
    assert!((thin / thick - 4.0).abs() < 1e-9);
    assert!((at_rest(&plating("ends = \"pinned\"\n")) / thin - 1.5).abs() < 1e-9);
}

#[test]
fn wrong_plating_is_refused_with_key_and_place() {
    let refused = |text: &str, says: &[&str]| {
        let error = ditching::load_text("flat_fall.toml", text, &[]).expect_err("refused").to_string();
        says.iter().for_each(|s| assert!(error.contains(s), "{error} does not say {s}"));
    };
    let with = |from: &str, to: &str| plating("").replace(from, to);
    refused(&with("from = 3.0", "from = 12.0"), &["plating[0].from", "a place from 0 to 10 m"]);
    refused(&with("to = 9.0", "to = 2.0"), &["plating[0].to", "more than plating[0].from"]);
    refused(&with("[0.0, 1.0]", "[0.0, 1.2]"), &["plating[0].supports", "shares of the girth from 0 to 1"]);
    refused(&with("[0.0, 1.0]", "[0.5, 0.2]"), &["plating[0].supports", "in order"]);
    refused(&with("[0.0, 1.0]", "[]"), &["plating[0].supports", "1 to 12 bays"]);
    refused(&with("density = 2700.0\n", ""), &["plating[0].density", "a material by name"]);
    refused(&with("thickness = 0.02", "thickness = 0.0"), &["plating[0].thickness"]);
    refused(
        &with("thickness = 0.02", "thickness = 0.4"),
        &["plating[0].thickness", "at most half the shortest bay, 0.3193 m"],
    );
    refused(&with("name = \"side\"", "name = \"two words\""), &["plating[0].name"]);
    refused(&plating("ends = \"free\"\n"), &["plating[0].ends", "clamped", "pinned"]);
    refused(&plating("thicknes = 1\n"), &["plating[0].thicknes", "thickness"]);
    refused(
        &with("name = \"flat_fall\"", "name = \"flat_fall\"\nmodel = \"von_karman\""),
        &["model", "beside plating"],
    );
}
