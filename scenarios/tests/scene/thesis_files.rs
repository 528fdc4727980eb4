//! INDAT and IPART of a scene, and the scene made of them again.

use run::{RunOptions, load, load_text, run};
use scenarios::thesis_files::{Indat, Ipart, Particle, files_of, scene_of};
use scene::Shape;

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

/// A row of mobile limit particles across the water, at rest.
fn add_paddle(indat: &mut Indat, ipart: &mut Ipart) {
    let (dx, fixed) = (indat.get("dx"), indat.get("NBF") as usize);
    let at = |k: usize| Particle { position: [-0.3, (k as f64 + 4.0) * dx, 0.0], ..Particle::default() };
    let paddle: Vec<Particle> = (0..18).map(at).collect();
    for name in ["NP", "NB"] {
        indat.set(name, indat.get(name) + paddle.len() as f64);
    }
    ipart.particles.splice(fixed..fixed, paddle);
}

/// A deck of each kind of case of the thesis: what it is made of, what its scene must have, and settings that a user adds.
#[test]
fn a_deck_of_each_kind_of_case_of_the_thesis_runs() {
    let coarse = "resolution.spacing=0.05";
    let dihedral = ["tank.width=3.0", "tank.depth=0.6", "resolution.growth=1.0", "resolution.spacing=0.03"];
    let oscillates = ["body.motion=oscillating", "body.amplitude=[0.05, 0]", "body.period=0.5"];
    for (case, from, changes, expected, added) in [
        ("column", "column", &[][..], "width = 0.1\n", &[][..]),
        ("tank", "hydrostatic_tank", &[coarse], "depth = 1.0\n", &[]),
        ("sloshing", "unlevel_tank", &[coarse], "surface_tilt_deg", &[]),
        ("dam_break", "dam_break", &[coarse], "water_width = 1.2", &[]),
        ("wave_generator", "hydrostatic_tank", &[coarse], "shape = \"polyline\"", &oscillates),
        ("dihedral", "wedge25", &dihedral, "velocity = [0.0, -4.9", &[]),
    ] {
        let scene = load(from, &sets(changes)).unwrap_or_else(|e| panic!("{case}: {e}")).scene;
        let (mut indat, mut ipart, _) = files_of(&scene).expect("files");
        if case == "wave_generator" {
            add_paddle(&mut indat, &mut ipart);
        }
        assert_eq!(indat.get("NP") as usize, ipart.particles.len(), "{case}");
        let imported = scene_of(case, &indat, &ipart, ["INDAT", "IPART"]).expect("a scene");
        assert!(imported.text.contains(expected), "{case}: {expected}\n{}", imported.text);
        let short = [&["time.end=0.01"], added].concat();
        let again = load_text(case, &imported.text, &sets(&short)).unwrap_or_else(|e| panic!("{e}\n{}", imported.text));
        let summary = run(&again.scene, &RunOptions::default()).expect("a run").summary;
        assert!(summary.status.is_completed(), "{case}: {:?}", summary.message);
    }
}

/// The outline of the mobile particles is that of the body that they were made of, half a spacing inside.
#[test]
fn a_dihedral_comes_back_with_its_deadrise() {
    let changes = ["tank.width=3.0", "tank.depth=0.6", "resolution.growth=1.0", "resolution.spacing=0.03"];
    let scene = load("wedge25", &sets(&changes)).expect("a built-in scene").scene;
    let (indat, ipart, _) = files_of(&scene).expect("files");
    let imported = scene_of("dihedral", &indat, &ipart, ["INDAT", "IPART"]).expect("a scene");
    let again = load_text("dihedral", &imported.text, &[]).expect("a scene that loads").scene;
    let Some(Shape::Polygon { points }) = again.body.map(|body| body.shape) else { panic!("{}", imported.text) };
    // a free wedge starts 2.5 spacings above the water
    let expected = 0.03 * (2.5 + 0.5 / 25_f64.to_radians().cos());
    let keel = points.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1])).expect("points");
    let chine = points.iter().copied().max_by(|a, b| (a[0] - a[1]).total_cmp(&(b[0] - b[1]))).expect("points");
    let deadrise = (chine[1] - keel[1]).atan2(chine[0] - keel[0]).to_degrees();
    assert!(
        (deadrise - 25.0).abs() < 1.5 && keel[0].abs() < 0.015 && (keel[1] - expected).abs() < 1e-3,
        "{deadrise} deg, keel {keel:?}, expected {expected}"
    );
    assert!((chine[0] - 0.6).abs() < 0.03, "{chine:?}");
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
