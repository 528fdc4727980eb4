//! What an incompressible solver makes of a scene: its defaults, its table, its warnings.

use run::{RunOptions, load, load_text, run};
use scenarios::preflight::preflight;
use scene::{Scene, SolverSettings, builtin};

use super::{DROP, TANK, changed, drop_with, warnings_with};

const SOLVERS: [&str; 3] = ["incompressible", "incompressible_explicit", "incompressible_thesis"];

fn with(solver: &str, changes: &[&str]) -> Scene {
    let solver = format!("solver={solver}");
    drop_with(&[&[solver.as_str()], changes].concat())
}

#[test]
fn defaults_follow_the_solver() {
    assert_eq!(drop_with(&[]).courant_number(), 0.6);
    for (solver, expected) in SOLVERS.into_iter().zip([0.4, 0.4, 0.6]) {
        assert_eq!(with(solver, &[]).courant_number(), expected, "{solver}");
    }
    assert_eq!(with("incompressible", &["fluid.cfl=0.2"]).courant_number(), 0.2);
}

fn projection(scene: &Scene) -> sph_core::projection::Settings {
    match &scene.solver {
        SolverSettings::Incompressible { projection, .. }
        | SolverSettings::IncompressibleExplicit { projection, .. } => *projection,
        solver => panic!("{} has no table [projection]", solver.name()),
    }
}

#[test]
fn a_table_of_the_projection_is_what_the_fluid_takes() {
    let table = "projection={ tolerance = 1e-6, most_iterations = 77, relaxation = 3.0, calming = 0.0, shift = 0.5 }";
    for solver in ["incompressible", "incompressible_explicit"] {
        let settings = projection(&with(solver, &[table]));
        assert_eq!(
            [settings.tolerance, settings.relaxation, settings.viscosity_coefficient, settings.shift],
            [1e-6, 3.0, 0.0, 0.5]
        );
        assert_eq!(settings.most_iterations, 77);
    }
    assert_eq!(projection(&with("incompressible", &[])), sph_core::projection::Settings::default());
}

#[test]
fn a_resolved_incompressible_scene_loads_again_to_itself() {
    for solver in SOLVERS {
        let mut sets = vec![format!("solver={solver}")];
        // only the first of them finds accelerations and pressures together, which some scenes ask for
        sets.extend((solver != SOLVERS[0]).then(|| "coupling.scheme=weak".to_string()));
        // the thesis's solver is refused with a wave maker
        let refused = |text: &str| solver == "incompressible_thesis" && text.contains("[tank.wave_maker]");
        for (name, _) in builtin().iter().filter(|(_, text)| !refused(text)) {
            let loaded = load(name, &sets).unwrap_or_else(|error| panic!("{name}, {solver}: {error}"));
            let scene = loaded.scene;
            let text = scene.to_toml();
            let again = load_text("again", &text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert_eq!(again.scene, scene, "{text}");
        }
    }
}

#[test]
fn no_doubt_about_an_incompressible_scene_and_no_line_of_check_speaks_of_sound() {
    for solver in SOLVERS {
        for set in ["fluid.sound_speed=20", "coupling.scheme=iqn_ils"] {
            let sets = [format!("solver={solver}"), set.to_string(), "tank.width=3".into(), "tank.depth=1.5".into()];
            let loaded = load_text("drop.toml", DROP, &sets).expect("the scene loads");
            let text = preflight(&loaded.scene, &loaded.warnings).to_text();
            for word in ["Mach", "sound", "compressib", "echo", "c0"] {
                let said = text.replace("incompressible", "");
                assert!(!said.contains(word), "{solver}, {set}: {word} in {text}");
            }
        }
    }
}

#[test]
fn check_counts_steps_of_the_spray() {
    let scene = with("incompressible", &[]);
    let f = preflight(&scene, &[]);
    let step = 0.4 * 1.5 * 0.005 / scene.projection_speed();
    assert!((f.step_s / step - 1.0).abs() < 1e-12, "{} {step}", f.step_s);
    assert_eq!(f.steps, (1.8 * 0.02 / step).ceil() as u64); // the spray is faster
    let cost = 2.5e-6 * f.fluid_particles as f64 * f.steps as f64;
    assert!((f.core_seconds / cost - 1.0).abs() < 1e-12);
    assert!(f.sound_speed_m_per_s.is_none() && f.mach.is_none() && f.compressibility_error.is_none());
    assert_eq!(preflight(&with("incompressible", &["time.step=1e-4"]), &[]).steps, 200);
}

#[test]
fn warnings_about_an_incompressible_scene_name_a_remedy() {
    let doubt = |changes: &[&str]| warnings_with(DROP, &[&["solver=incompressible"], changes].concat());
    let near = doubt(&["tank.width=1.2", "tank.depth=0.6"]);
    assert!(near.contains("draughts away") && near.contains("answers at once"), "{near}");
    let long = doubt(&["time.step=2e-3"]);
    assert!(long.contains("time.step = 0.002 s") && long.contains("smoothing lengths"), "{long}");
    for (key, solver) in [("ventilation", "incompressible_thesis"), ("wall_stretch", "incompressible")] {
        let idle = doubt(&[&format!("solver={solver}"), &format!("fluid.{key}=true")]);
        assert!(idle.contains(&format!("fluid.{key} = true does nothing")), "{idle}");
    }
    let hasty = doubt(&["fluid.cfl=0.9"]);
    assert!(hasty.contains("fluid.cfl = 0.9") && hasty.contains("gained energy"), "{hasty}");
    let weak = doubt(&["coupling.scheme=weak"]);
    assert!(weak.contains("coupling.scheme = \"weak\"") && weak.contains("\"added_mass\" holds"), "{weak}");
    let quiet = doubt(&["fluid.ventilation=true"]);
    for word in ["draughts", "time.step", "fluid.cfl", "does nothing", "weak"] {
        assert!(!quiet.contains(word), "{quiet}");
    }
    assert!(changed(TANK, &["solver=incompressible", "fluid.cfl=1.0"]).is_ok());
}

/// The summary names the solver, says nothing of sound, and a fixed step is kept.
#[test]
fn a_summary_says_which_solver_ran() {
    for solver in SOLVERS.into_iter().chain(["weakly_compressible"]) {
        let sets = [&format!("solver={solver}"), "resolution.spacing=0.05", "time.end=0.01", "time.step=1e-3"];
        let scene = changed(TANK, &sets).expect("the scene loads");
        let summary = run(&scene, &RunOptions::default()).expect("it runs").summary;
        let carries_sound = solver == "weakly_compressible";
        assert_eq!(summary.model, if carries_sound { "wcsph" } else { solver });
        assert_eq!(summary.compressibility.is_some(), carries_sound, "{solver}");
        assert_eq!(summary.to_json().contains("sound_speed"), carries_sound, "{solver}");
        assert_eq!(summary.steps, 10, "{solver}: {:?}", summary.message);
    }
}

/// From 1.19 on the incompressible pressures of a wedge were three times too large.
#[test]
fn rows_that_grow_fast_are_refused() {
    let sets = |growth: f64| ["solver=incompressible".to_string(), format!("resolution.growth={growth}")];
    assert!(load("wedge_constant", &sets(1.17)).is_ok());
    let error = load("wedge_constant", &sets(1.2)).expect_err("a fast growth").to_string();
    assert!(error.contains("`resolution.growth` = 1.2") && error.contains("at most 1.17"), "{error}");
}
