//! Scene files: what loads, what is refused and how, what is left to the program.

mod air;
mod guide_examples;
mod legacy;
mod own_section;
mod panels;
mod plausible;
mod projection;
mod reference_page;
mod refused;
mod several_bodies;
mod start;
mod thesis_files;
mod waves;

use run::{load, load_text};
use scenarios::preflight::preflight;
use scene::{
    Motion, Scene, SceneError, Symmetry, apply_set, builtin, compressibility_error, particle_estimate, schema,
};

/// A small complete scene; the tests below count its lines.
const DROP: &str = r#"name = "drop"
gravity = [0.0, -9.81]
[time]
end = 0.02
[resolution]
spacing = 0.005
[body]
shape = "wedge"
deadrise_deg = 30.0
breadth = 0.5
side_height = 0.1
mass = 100.0
free = ["y"]
velocity = [0.0, -5.0]
[[gauges]]
name = "face"
at = [0.1, 0.0577]
[[compare]]
reference = "external/wedge25_yettou2006_velocity_exp.csv"
quantity = "body.vy_m_per_s"
x = "t_ms"
y = "v_m_s"
"#;

/// A tank without a body.
const TANK: &str = r#"name = "tank"
time = { end = 1.0 }
resolution = { spacing = 0.02 }
[tank]
width = 1.0
depth = 0.5
"#;

fn sets(sets: &[&str]) -> Vec<String> {
    sets.iter().map(|set| set.to_string()).collect()
}

fn changed(text: &str, changes: &[&str]) -> Result<Scene, SceneError> {
    load_text("drop.toml", text, &sets(changes)).map(|loaded| loaded.scene)
}

fn drop_with(changes: &[&str]) -> Scene {
    changed(DROP, changes).expect("the scene loads")
}

fn warnings_with(text: &str, changes: &[&str]) -> String {
    let loaded = load_text("drop.toml", text, &sets(changes)).expect("the scene loads");
    loaded.warnings.join("\n")
}

#[test]
fn resolved_scene_loads_again_to_itself() {
    let plate = [
        "symmetry=x",
        "body={ shape = \"polyline\", points = [[-0.3, 0.1], [0.0, 0.0], [0.3, 0.1]], thickness = 0.05, mass = 50, velocity = [0.0, -2.0] }",
        "gauges=[]",
    ];
    let thin = [
        plate[0],
        "body={ shape = \"polyline\", points = [[-0.3, 0.1], [0.0, 0.0], [0.3, 0.1]], thickness = 0.0005, mass = 50, velocity = [0.0, -2.0] }",
        plate[2],
    ];
    let gas = drop_with(&["fluid.equation_of_state=ideal_gas", "time.step=1e-5"]);
    let riemann = drop_with(&["fluid.dissipation=riemann"]);
    let scheme = riemann.solver.weakly_compressible().expect("a weakly compressible scene").scheme;
    assert_eq!([scheme.density_diffusion, scheme.artificial_viscosity], [0.0; 2], "no coefficients");
    let mut scenes = vec![drop_with(&[]), drop_with(&plate), drop_with(&thin), gas, riemann];
    for (name, _) in builtin() {
        scenes.push(load(name, &[]).expect("a built-in scene loads").scene);
    }
    for scene in scenes {
        let text = scene.to_toml();
        let again = load_text("again", &text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(again.scene, scene, "{text}");
    }
}

#[test]
fn every_built_in_scene_says_where_it_comes_from() {
    for (name, text) in builtin() {
        let scene = load(name, &[]).expect("a built-in scene loads").scene;
        assert_eq!(scene.name, *name);
        assert!(text.starts_with('#') && !scene.source.is_empty() && !scene.description.is_empty(), "{name}");
    }
}

#[test]
fn built_in_scenes_have_the_numbers_of_their_sources() {
    let body = |name: &str| load(name, &[]).expect("a built-in scene loads").scene.body.expect("it has a body");
    for (name, mass, speed) in [("wedge", 241.0, 6.15), ("wedge25", 78.3, 5.05)] {
        let body = body(name);
        assert!(matches!(&body.motion, Motion::Free(free) if free.mass == mass && free.inertia.is_none()));
        assert_eq!(body.velocity, [0.0, -speed]);
    }
    // The wetted part of the box weighs as much as the box.
    let floating = body("floating_box");
    let Motion::Free(freedom) = &floating.motion else { panic!("the box floats freely") };
    assert!((freedom.mass - 0.5 * 1000.0 * floating.shape.area()).abs() < 1e-9);
    assert_eq!(load("wedge_constant", &[]).expect("it loads").scene.gravity, [0.0, 0.0]);
}

#[test]
fn a_set_of_the_table_alone_leaves_reading_to_load() {
    let mut table = toml::Table::new();
    apply_set(&mut table, "fluid.kernel = cubic_spline").expect("a bare word is a string");
    assert_eq!(table["fluid"]["kernel"].as_str(), Some("cubic_spline"));
}

#[test]
fn a_scene_file_loads_by_its_path() {
    let folder = temp_dir::TempDir::new().expect("a folder");
    let path = folder.path().join("drop.toml");
    std::fs::write(&path, DROP).expect("a file");
    let loaded = load(path.to_str().expect("a printable path"), &[]).expect("the scene loads");
    assert_eq!(loaded.scene, drop_with(&[]));
    assert_eq!(loaded.source_name(), path.to_str().expect("a printable path"));
    let mistaken = load(folder.path().to_str().expect("a printable path"), &[]).expect_err("a folder is no file");
    assert!(matches!(mistaken, SceneError::Mistaken { .. }), "{mistaken}");
}

/// Defaults that depend on other keys, in words or formulas.
const DEFAULTS_IN_WORDS: [&str; 26] = [
    "0.02; 0.005 with a rigid body that starts under water",
    "false; true with a rigid body that starts under water",
    "0 for a rigid wedge whose chines get wet, not lighter than 0.4 of its added mass, and for a round bottom deeper than 0.15 radii or with wet chines; -density (V^2/2 + g L) for another free wedge from the air; else absent",
    "false; true if incompressible with a body, and for a body under water",
    "true; false in a tank of water without a body",
    "absent",
    "end/500",
    "end/50",
    "[0.0, end]",
    "width",
    "8 sqrt(g depth)/length",
    "0.15; 0.02 with tank.wave_maker or a rigid body that starts under water",
    "1; 3 with a rigid body that starts under water",
    "1.25 depth, 3 depth for a dam break; 1.25 times the crests of a wave maker",
    "breadth/4",
    "centroid of the outline",
    "all; [\"y\"] with symmetry",
    "panel1, ...",
    "24, none shorter than 2 spacings, at least 8",
    "yield_stress",
    "xy with structure_file",
    "m_kg_s with structure_file",
    "1 with structure_file",
    "weak; added_mass with body.panels, and for free bodies with solver = incompressible",
    "wcsph; the solver's where there is one",
    "true where it is possible, for a rigid body and an automatic fine zone; else false",
];

/// A panel for the body of `DROP`.
const PANEL: &str = "
[[body.panels]]
from = [0.0, 0.0]
to = [0.25, 0.144338]
thickness = 0.01
youngs_modulus = 70e9
density = 2700.0
yield_stress = 250e6
";

/// A rotorcraft whose float loads are stated.
const RULE: &str = "
[rule]
limit_load_factor = 3.0
rotorcraft_mass = 3000.0
";

/// A mass on a spring over it.
const SPRUNG_MASS: &str = "
[[body.sprung_masses]]
name = \"seat\"
mass = 10.0
stiffness = 1e4
";

/// A tank with a wave maker and a beach.
const WAVES: &str = "
name = \"drop\"
time = { end = 1.0 }
resolution = { spacing = 0.05 }
[tank]
width = 6.0
depth = 0.5
wave_maker = { height = 0.1, period = 1.5 }
beach = { length = 3.0 }
";

/// A joint that holds it.
const JOINT: &str = "
[[joints]]
name = \"hinge\"
kind = \"hinge\"
bodies = [\"tank\", \"body\"]
at = [0.0, 1.0]
";

/// The same as modes.
const MODES: &str = "
[body.modal]
nodes = [[0.0, 0.0], [0.125, 0.072169], [0.25, 0.144338]]
masses = [1.0, 2.0, 1.0]
[[body.modal.modes]]
frequency = 100.0
mass = 2.0
shape = [[0.0, 0.0, 0.0], [-0.5, 0.866, 0.0], [0.0, 0.0, 0.0]]
";

#[test]
fn a_key_left_out_has_the_default_that_its_keyword_declares() {
    for keyword in schema().keywords() {
        // the keys of further bodies are those of the first
        let further = keyword.path.starts_with("bodies");
        if further || keyword.default.starts_with("required") || DEFAULTS_IN_WORDS.contains(&keyword.default.as_str()) {
            continue;
        }
        // Without a velocity the wedge needs a tank; with one the tank is left to the program.
        let silent = match keyword.path.starts_with("tank.") {
            true => DROP.replace("gravity = [0.0, -9.81]\n", ""),
            false => DROP
                .replace("gravity = [0.0, -9.81]\n", "tank = { width = 2.0, depth = 1.0 }\n")
                .replace("velocity = [0.0, -5.0]\n", ""),
        };
        let silent = match &keyword.path {
            path if path.starts_with("tank.wave_maker") || path.starts_with("tank.beach") => WAVES.to_string(),
            path if path.starts_with("body.panels") => format!("{silent}{PANEL}"),
            path if path.starts_with("body.sprung_masses") => format!("{silent}{SPRUNG_MASS}"),
            path if path.starts_with("joints") => format!("{silent}{JOINT}"),
            path if path.starts_with("body.modal") => format!("{silent}{MODES}"),
            path if path.starts_with("rule") => format!("{silent}{RULE}"),
            _ => silent,
        };
        let silent = match keyword.path.split('.').next() {
            Some("projection") => format!("solver = \"incompressible\"\n{silent}"),
            Some("want" | "within") => format!("model = \"auto\"\n{silent}"),
            Some("thesis") => format!("solver = \"incompressible_thesis\"\n{silent}"),
            _ => silent,
        };
        let left_out = changed(&silent, &[]).expect("the scene loads");
        let set = format!("{}={}", keyword.path.replace("[]", "[0]"), keyword.default);
        let spelled_out = changed(&silent, &[&set]);
        assert_eq!(spelled_out.map_err(|error| error.to_string()), Ok(left_out), "{set}");
    }
}

#[test]
fn auto_sound_speed_costs_the_admitted_share_of_the_force() {
    for error in [0.002, 0.01, 0.03] {
        let scene = drop_with(&[&format!("fluid.compressibility_error={error}")]);
        let entry = scene.entry().expect("the wedge enters the water");
        let cost = compressibility_error(entry.root_speed(), scene.sound_speed());
        assert!((cost / error - 1.0).abs() < 1e-9, "{cost}");
    }
}

/// A slow body is given its fall, the water its weight, and nothing a faster sound than water's.
#[test]
fn auto_sound_speed_covers_the_fall_and_the_weight_of_the_water() {
    for speed in [0.1, 0.03, 0.01] {
        let slow = drop_with(&[&format!("body.velocity=[0, -{speed}]"), "time.end=0.3", "body.side_height=0.5"]);
        let entry = slow.entry().expect("it sinks in");
        assert!((1.0..3.0).contains(&entry.fastest) && entry.attached_speed <= entry.fastest, "{entry:?}");
        assert!(slow.sound_speed() >= 10.0 * entry.root_speed().max(entry.fastest), "{speed}");
        assert!(slow.sound_speed().powi(2) >= 20.0 * 9.81 * slow.tank.depth * (1.0 - 1e-12), "{speed}");
    }
    let still = ["body.velocity=[0, -0.01]", "body.motion=\"constant_velocity\"", "time.end=3"];
    let deep = drop_with(&[&still[..], &["tank.depth=5", "tank.width=4"]].concat());
    assert!((deep.sound_speed() - (20.0 * 9.81 * 5.0_f64).sqrt()).abs() < 1e-9);
    assert_eq!(drop_with(&["body.velocity=[0, -60]", "time.end=0.002"]).sound_speed(), 1480.0);
}

#[test]
fn auto_sound_speed_covers_the_front_of_a_dam_broken_before_a_body() {
    let [still, broken] = [&[][..], &["tank.water_width=0.3"]].map(|sets| changed(TANK, sets).expect("a tank"));
    for tank in [&still, &broken] {
        assert!((tank.sound_speed() - 10.0 * (2.0 * 9.81 * 0.5_f64).sqrt()).abs() < 1e-9);
    }
    let baffle = load("dam_break_baffle", &[]).expect("a built-in scene").scene;
    assert!((baffle.sound_speed() / (20.0 * (9.81 * baffle.tank.depth).sqrt()) - 1.0).abs() < 1e-9);
    // a gate at the water is no obstacle of the front
    let gate = load("elastic_gate", &[]).expect("a built-in scene").scene;
    assert!((gate.sound_speed() / (10.0 * (2.0 * 9.81 * gate.tank.depth).sqrt()) - 1.0).abs() < 1e-9);
}

#[test]
fn auto_tank_lies_outside_acoustic_reach_wherever_the_body_is() {
    for x in [0.0, 1.5] {
        let scene = drop_with(&[&format!("body.position=[{x}, 0]")]);
        let reach = 0.65 * scene.sound_speed() * scene.time.end;
        assert!((0.5 * scene.tank.width - x - reach).abs() < 1e-12 * reach);
        assert_eq!(scene.tank.depth, reach);
    }
}

#[test]
fn touching_puts_the_lowest_point_on_the_water() {
    for angle in [0.0, 20.0, -75.0] {
        let scene = drop_with(&[&format!("body.angle_deg={angle}"), "gauges=[]"]);
        let outline = scene.body.expect("a wedge").placed_outline();
        let lowest = outline.iter().fold(f64::INFINITY, |low, p| low.min(p[1]));
        assert!(lowest.abs() < 1e-15, "{angle}: {lowest}");
    }
}

#[test]
fn a_fall_through_air_counts_with_its_speed_at_contact() {
    let change = ["body.velocity=[0, 0]", "body.position=[0, 0.05]", "time.end=0.2"];
    let entry = drop_with(&change).entry().expect("the wedge falls into the water");
    assert!((entry.speed - (2.0 * 9.81 * 0.05_f64).sqrt()).abs() < 1e-12);
    assert!(entry.final_draught > 0.0);
}

#[test]
fn warnings_come_with_their_cause_and_go_with_its_cure() {
    #[rustfmt::skip]
    let table: &[(&[&str], &[&str], &str)] = &[
        (&["fluid.cfl=0.9"], &[], "0.8 ran, 1.2 blew up"),
        (&["time.step=2.5e-5"], &["time.step=1e-5"], "time.step = 0.000025 s is"),
        (&["fluid.integrator=verlet", "fluid.verlet_correction_every=0"], &["fluid.integrator=verlet"], "drift apart"),
        (&["fluid.integrator=verlet", "fluid.cfl=0.1"], &["fluid.integrator=verlet", "fluid.cfl=0.1", "fluid.verlet_correction_every=10"], "drift apart"),
        (&["fluid.integrator=verlet", "fluid.dissipation=riemann", "fluid.cfl=0.1"], &["fluid.integrator=verlet", "fluid.dissipation=riemann"], "drift apart"),
        (&["fluid.dissipation=riemann", "fluid.cfl=0.75"], &["fluid.dissipation=riemann"], "0.75 did not"),
        (&["fluid.wall_stretch=true", "fluid.cfl=0.6"], &["fluid.wall_stretch=true"], "broke into oscillation"),
        (&["fluid.density_evolution=summation"], &[], "fails at a free surface"),
        (&["body.mass=0.5"], &[], "the body is light for coupling.scheme"),
        (&["body.mass=2.7"], &[], "draught of about 1.363 spacings, and the run will not give it as resolved: 0.001136 m"),
        (&["body.angle_deg=27"], &["body.angle_deg=15"], "the peak force will be refused: a face within 4 deg"),
        (&["body.velocity=[0, -60]", "time.end=0.002"], &[], "sound is as fast as in water, where the force is lower as well"),
        (&["resolution.growth=1.5"], &[], "9 % of the force"),
        (&["resolution.spacing=0.009"], &["resolution.spacing=0.002"], "peak pressure unreliable"),
        (&["time.end=0.005"], &[], "the draught at the end is 4."),
        (&["fluid.sound_speed=100"], &[], "compressibility takes about"),
        (&["fluid.sound_speed=100"], &[], "times the flow's fastest known speed"),
        (&["fluid.sound_speed=130"], &["fluid.sound_speed=140"], "nearly incompressible from 10 times on, up to Mach 0.1"),
        (&["gauges[0].bandwidth=9e3"], &["gauges[0].bandwidth=4e3"], "face has a bandwidth of 9000 Hz and is sampled at 25000 Hz"),
        (&["tank.width=3"], &["tank.width=300"], "the echo from the tank's walls, 1.5 m away"),
        (&["resolution.fine_zone=[0.1, 0.1]"], &["resolution.fine_zone=[0.5, 0.1]"], "leaves the fine zone"),
        (&["tank.depth=0.05"], &[], "may reach the floor"),
        (&["body.position=[0, 1]", "body.velocity=[0, -1]"], &[], "does not reach the water"),
        (&["compare[0].window=[0.1, 0.2]"], &[], "after the end of the run"),
    ];
    for (cause, cure, warning) in table {
        assert!(warnings_with(DROP, cause).contains(warning), "{cause:?}: {}", warnings_with(DROP, cause));
        assert!(!warnings_with(DROP, cure).contains(warning), "{cure:?}: {}", warnings_with(DROP, cure));
    }
    let (_, text) = builtin().iter().find(|(name, _)| *name == "wedge_constant").expect("it is built in");
    // 30 deg: the root goes out to 2.72 m in the run's second, the jet's tip to 4.907 m, of 6 m
    assert!(warnings_with(text, &["body.breadth=5"]).contains("past the chine at 2.5 m"));
    let tip = warnings_with(text, &["body.breadth=6"]);
    assert!(tip.contains("the jet's tip passes the chine at 0.6116 s") && tip.contains("body.breadth = 9.8"), "{tip}");
    assert!(warnings_with(text, &["body.deadrise_deg=20"]).contains("the jet's tip passes the chine at 0.73"));
    assert_eq!(warnings_with(text, &["body.deadrise_deg=20", "body.breadth=18"]), "");
    // without the similarity solution the water leaves the bottom all the same; a free wedge is meant to go on
    assert!(warnings_with(text, &["body.breadth=6", "body.velocity=[0, -1.0]"]).contains("the jet's tip"));
    assert!(!warnings_with(DROP, &["body.breadth=0.1", "gauges=[]"]).contains("chine"));
    assert_eq!(warnings_with(text, &[]), "");
}

/// What `check` prints: the Mach number, the share of the force lost, and above Mach 0.1 a warning with that number.
#[test]
fn check_says_mach_number_and_compressible_share() {
    let said = |sound: f64| {
        let set = format!("fluid.sound_speed={sound}");
        let loaded = load_text("drop.toml", DROP, &sets(&[&set])).expect("the scene loads");
        let entry = loaded.scene.entry().expect("it falls in");
        let share = 100.0 * compressibility_error(entry.root_speed(), sound);
        let (text, mach) = (preflight(&loaded.scene, &loaded.warnings).to_text(), entry.root_speed() / sound);
        assert!(text.contains(&format!("Mach {mach:.3}")), "{text}");
        assert!(text.contains(&format!("compressible share of the force about {share:.2} %")), "{text}");
        (mach, text.lines().any(|l| l.starts_with("warning") && l.contains(&format!("Mach {:.2}", mach - 0.005))))
    };
    let [(slow, warned), (fast, silent)] = [100.0, 400.0].map(said);
    assert!(slow > 0.1 && warned, "Mach {slow}");
    assert!(fast < 0.1 && !silent, "Mach {fast}");
}

#[test]
fn estimate_counts_a_uniform_tank_exactly() {
    let (fluid, wall) = particle_estimate(&changed(TANK, &["resolution.growth=1"]).expect("it loads"));
    // 50 by 25; three rows along 1 m of floor and two sides of 0.625 m.
    assert_eq!((fluid, wall), (1250, 338));
}

#[test]
fn estimate_agrees_with_a_graded_lattice_row_by_row() {
    // Without side limits the water below the fine zone is rows of height dx gʲ across the width.
    let change = ["resolution.fine_zone=[0.5, 0.1]", "resolution.spacing=0.002", "resolution.growth=1.05"];
    let scene = changed(TANK, &change).expect("it loads");
    let mut rows = 50.0 / 0.002;
    let (mut depth, mut row) = (0.1, 0.002 * 1.05);
    while depth < 0.5 {
        rows += (0.5_f64 - depth).min(row) / (row * row);
        depth += row;
        row *= 1.05;
    }
    let (fluid, _) = particle_estimate(&scene);
    assert!((fluid as f64 / rows - 1.0).abs() < 0.02, "{fluid} {rows}");
}

#[test]
fn mirror_symmetry_halves_the_particles() {
    let whole = particle_estimate(&drop_with(&[]));
    let half = particle_estimate(&drop_with(&["symmetry=x"]));
    for (whole, half) in [(whole.0, half.0), (whole.1, half.1)] {
        assert!((whole as f64 / half as f64 - 2.0).abs() < 0.01, "{whole} {half}");
    }
}

#[test]
fn mirror_plane_is_off_by_default() {
    assert_eq!(drop_with(&[]).symmetry, Symmetry::None);
    assert_eq!(drop_with(&["symmetry=x"]).water_sides()[0], 0.0);
}

#[test]
fn a_gas_has_the_sound_speed_of_its_temperature_and_airs_exponent() {
    let scene = drop_with(&["fluid.equation_of_state=ideal_gas", "fluid.temperature=300"]);
    assert_eq!(scene.solver.weakly_compressible().expect("a gas").scheme.eos_exponent, 1.4);
    let exact = (1.4 * 8.314_462_618_f64 * 300.0 / 0.028_964_4).sqrt();
    assert!((scene.sound_speed() / exact - 1.0).abs() < 1e-9, "{} m/s", scene.sound_speed());
}
