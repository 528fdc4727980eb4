//! Water that does not start as a level rectangle, and what is read off it.

use run::build;
use scene::layout;

use super::{TANK, changed, load, particle_estimate, sets};

#[test]
fn surfaces_blocks_and_levels_that_do_not_fit_are_refused() {
    let block = |from: &str, to: &str| [format!("tank.block_from={from}"), format!("tank.block_to={to}")];
    let low = block("[0, -0.1]", "[0.2, 0.1]");
    let flat = block("[0, 0]", "[0.2, 0.01]");
    let wide = block("[0, 0]", "[0.7, 0.1]");
    let high = block("[0, 0]", "[0.2, 0.3]");
    let mirrored = block("[0, 0]", "[0.2, 0.1]");
    let both = |pair: &'static str, block: &[String; 2]| [vec![pair.to_string()], block.to_vec()].concat();
    let one = |set: &str| vec![set.to_string()];
    let two = |a: &str, b: &str| vec![a.to_string(), b.to_string()];
    #[rustfmt::skip]
    let table: &[(Vec<String>, &[&str])] = &[
        (one("tank.surface_amplitude=0.26"), &["`tank.surface_amplitude` = 0.26", "no more than 0.25 m, half the depth"]),
        (one("tank.surface_amplitude=inf"), &["`tank.surface_amplitude` = inf", "a finite number"]),
        (one("tank.surface_tilt_deg=30"), &["`tank.surface_tilt_deg` = 30", "half the depth: this one may by 0.2887 m"]),
        (one("tank.surface_tilt_deg=50"), &["`tank.surface_tilt_deg` = 50", "from -45 to 45"]),
        (one("tank.surface_mode=0"), &["`tank.surface_mode` = 0", "at least 1"]),
        (two("tank.surface_amplitude=0.01", "tank.surface_mode=13"), &["`tank.surface_mode` = 13", "one half wave to 4 spacings"]),
        (two("tank.surface_amplitude=0.1", "tank.height=0.55"), &["`tank.height` = 0.55", "at least 0.6 m"]),
        (two("tank.surface_amplitude=0.1", "tank.water_width=0.5"), &["`tank.water_width` = 0.5", "not level"]),
        (two("tank.surface_amplitude=0.1", "symmetry=x"), &["`tank.surface_mode` = 1", "an even number"]),
        (two("tank.surface_tilt_deg=2", "symmetry=x"), &["`tank.surface_tilt_deg` = 2", "0 with symmetry"]),
        (one("tank.block_from=[0, 0]"), &["`tank.block_to` is missing"]),
        (one("tank.block_velocity=[1, 0]"), &["`tank.block_from` is missing"]),
        (low.to_vec(), &["`tank.block_from`", "y of at least 0 m"]),
        (flat.to_vec(), &["`tank.block_to`", "at least 4 spacings, 0.08 m"]),
        (wide.to_vec(), &["`tank.block_to`", "x of at most 0.5 m"]),
        (high.to_vec(), &["`tank.block_to`", "0.125 m, the walls' rim"]),
        (both("tank.surface_tilt_deg=5", &mirrored), &["`tank.block_from`", "where the water below ends"]),
        ([both("symmetry=x", &mirrored), one("tank.block_velocity=[1, 0]")].concat(), &["`tank.block_velocity`", "on the mirror"]),
        (two("body={ shape = \"polyline\", points = [[0, 0], [0.3, 0]], thickness = 0.1, motion = \"fixed\" }", "resolution.packing=true"), &["`resolution.packing` = true", "false with a polyline"]),
        (one("observe.level=[0.6]"), &["`observe.level` = 0.6", "from -0.5 to 0.5 m"]),
        (two("observe.level=[-0.1]", "symmetry=x"), &["`observe.level` = -0.1", "from 0 to 0.5 m"]),
    ];
    for (changes, fragments) in table {
        let changes: Vec<&str> = changes.iter().map(String::as_str).collect();
        let message = match changed(TANK, &changes) {
            Err(error) => error.to_string(),
            Ok(_) => panic!("{changes:?} must be refused"),
        };
        for fragment in *fragments {
            assert!(message.contains(fragment), "{changes:?}: {fragment:?} is not in: {message}");
        }
    }
}

#[test]
fn a_tilted_tank_and_a_block_have_the_mass_pressure_and_velocity_asked_for() {
    let changes = [
        "tank.surface_tilt_deg=10",
        "tank.height=1",
        "tank.block_from=[-0.2, 0.1]",
        "tank.block_to=[0.2, 0.3]",
        "tank.block_velocity=[1, -2]",
    ];
    let scene = changed(TANK, &changes).expect("a sound scene");
    let system = build::build(&scene).expect("a tank");
    let p = system.fluid.particles();
    let (in_air, in_tank): (Vec<usize>, Vec<usize>) = (0..p.len()).partition(|&k| p.v[k] != 0.0);
    let mass = |of: &[usize]| of.iter().map(|&k| p.mass[k]).sum::<f64>();
    assert!((mass(&in_air) / 80.0 - 1.0).abs() < 1e-12, "{}", mass(&in_air));
    assert_eq!(in_air.len(), 200);
    assert!(in_air.iter().all(|&k| [p.u[k], p.v[k]] == [1.0, -2.0] && p.rho[k] == 1000.0));
    // masses at the density of their pressure: a ten-thousandth more than at rest
    assert!((mass(&in_tank) / 500.0 - 1.0).abs() < 3e-3, "{}", mass(&in_tank));
    for &k in &in_tank {
        let depth = 10.0_f64.to_radians().tan() * p.x[k] - p.y[k];
        let pressure = scene.sound_speed().powi(2) * 1000.0 / 7.0 * ((p.rho[k] / 1000.0).powi(7) - 1.0);
        assert!(depth > 0.0 && (pressure - 9810.0 * depth).abs() < 1.0, "{pressure} Pa at {depth} m");
    }
    assert!((particle_estimate(&scene).0 as f64 / p.len() as f64 - 1.0).abs() < 0.02);
    // water that falls from higher is faster: the speed of sound follows
    let still = changed(TANK, &[]).expect("a sound scene").sound_speed();
    assert!(scene.sound_speed() > 1.2 * still, "{} m/s, {still} m/s", scene.sound_speed());
}

#[test]
fn a_level_surface_changes_nothing() {
    let of = |changes: &[&str]| load("dam_break", &sets(changes)).expect("a built-in scene").scene;
    assert_eq!(of(&["tank.surface_tilt_deg=0", "tank.surface_amplitude=0"]), of(&[]));
    assert!(of(&[]).tank.surface().is_none());
}

/// Water is fine where a body touches it first. Under the edge of a pitched plate it had sixteen times the spacing, because the zone was in the
/// middle of the plate.
#[test]
fn water_is_fine_under_the_lowest_point() {
    let rolled = ["body.angle_deg=15", "symmetry=none"].map(String::from);
    let short = ["solver=incompressible", "time.end=0.06", "resolution.fine_zone=[0.6, 0.07]"].map(String::from);
    let scenes = [("plate_pitched", &[][..]), ("plate_pitched", &short), ("wedge", &rolled), ("fuselage_section", &[])];
    for (name, sets) in scenes {
        let scene = load(name, sets).expect("a scene").scene;
        let body = scene.body.as_ref().expect("a body");
        let lowest = body.placed_outline().into_iter().min_by(|a, b| a[1].total_cmp(&b[1])).expect("points");
        let finest = layout(&scene).spacing_at([lowest[0], -0.5 * scene.resolution.spacing]);
        assert!(finest < 1.01 * scene.resolution.spacing, "{name} {sets:?}: {finest} m");
    }
}
