//! INDAT and IPART of a scene, and the scene made of them again.

use scenarios::scene::{load, load_text};
use scenarios::thesis_files::{Indat, Ipart, files_of, scene_of};

fn sets(sets: &[&str]) -> Vec<String> {
    sets.iter().map(|set| set.to_string()).collect()
}

#[test]
fn a_tank_comes_back_from_its_files_and_the_files_from_that_tank() {
    for changes in [
        &["resolution.spacing=0.05"][..],
        &["resolution.spacing=0.05", "solver=incompressible_thesis", "fluid.smoothing_ratio=1.2"],
    ] {
        let scene = load("unlevel_tank", &sets(changes)).expect("a built-in scene").scene;
        let (indat, ipart, notes) = files_of(&scene).expect("files");
        assert!(!notes.is_empty() && indat.get("NP") == ipart.particles.len() as f64);
        let (indat_text, ipart_text) = (indat.to_text(), ipart.to_text());
        let read = Indat::parse("INDAT", &indat_text).expect("our own text");
        let particles = Ipart::parse("IPART", &ipart_text).expect("our own text");
        assert_eq!((read.to_text(), particles.to_text()), (indat_text, ipart_text));
        let imported = scene_of("again", &read, &particles, ["INDAT", "IPART"]).expect("a scene");
        let again = load_text("again", &imported.text, &[]).unwrap_or_else(|e| panic!("{e}\n{}", imported.text)).scene;
        assert_eq!((again.tank.width, again.tank.depth, again.tank.height), (1.0, 1.0, scene.tank.height));
        assert!((again.tank.surface_tilt_deg + 5.0).abs() < 0.5, "{}", again.tank.surface_tilt_deg);
        assert_eq!(again.solver.kind(), scene.solver.kind());
        assert!(imported.notes.iter().any(|note| note.contains("visc_wall")));
    }
}

#[test]
fn files_that_contradict_each_other_are_refused() {
    let scene = load("hydrostatic_tank", &sets(&["resolution.spacing=0.1"])).expect("a built-in scene").scene;
    let (indat, ipart, _) = files_of(&scene).expect("files");
    let refused = |name: &str, value: f64| {
        let mut indat = indat.clone();
        indat.set(name, value);
        scene_of("x", &indat, &ipart, ["INDAT", "IPART"]).expect_err(name).to_string()
    };
    assert!(refused("NP", 5.0).contains("NBF <= NB <= NP"));
    assert!(refused("NP", 1e6).contains("expected NP = 1000000 of INDAT"));
    assert!(refused("dx", 0.0).contains("dx = 0"));
    assert!(refused("i_kernel", 4.0).contains("one of 1, 2, 3, 5"));
}
