//! Air under flat bottoms and vapour: what the program chooses, and what it says.

use run::load;
use scene::Scene;

use super::sets;

fn opened(changes: &[&str]) -> (Scene, String) {
    let loaded = load("flat_bottom", &sets(changes)).expect("a scene");
    (loaded.scene, loaded.warnings.join("\n"))
}

/// Speeds of sound of WC27: 101.8 m/s less twice the speed of the body, in water of 1000 kg/m³.
#[test]
fn water_under_a_flat_bottom_is_as_soft_as_its_air() {
    for (changes, sound) in [
        (&[][..], 97.79),
        (&["body.velocity=[0, -8]"], 85.79),
        (&["body.angle_deg=0.9"], 97.79),
        (&["fluid.density=1025"], 95.31),
        (&["body.velocity=[3, -2]"], 97.79),
    ] {
        let (scene, warnings) = opened(changes);
        assert!((scene.sound_speed() - sound).abs() < 0.02, "{changes:?}: {}", scene.sound_speed());
        assert!(scene.is_cushioned(&scene.entry().expect("an entry")), "{changes:?}");
        assert!(!warnings.contains("refused") && !warnings.contains("spacings"), "{changes:?}: {warnings}");
    }
}

#[test]
fn where_water_is_not_as_soft_the_peaks_are_refused() {
    #[rustfmt::skip]
    let table: &[(&[&str], &[&str])] = &[
        (&["fluid.sound_speed=300"], &["bounds the pressure at about 203.6 kPa for 2.986 ms", "fluid.sound_speed = 97.79 m/s"]),
        (&["solver=incompressible"], &["solver = \"weakly_compressible\" and fluid.sound_speed = 97.79 m/s"]),
        (&["body.velocity=[0, -9]"], &["916", "too fast"]),
        (&["body.motion=free", "body.mass=40", "body.inertia=1"], &["lighter than half of the water"]),
        (&["body.velocity=[20, -2]"], &["too fast"]),
        (&["body.motion=free", "body.mass=400", "body.inertia=20", "body.angular_velocity_deg_per_s=250", "body.free=[\"x\", \"y\", \"angle\"]"], &["within 4 deg"]),
        (&["body.angle_deg=2"], &["within 4 deg", "impulse_N_s_per_m"]),
        (&["body.position=[0, 0.1]"], &["within 4 deg", "impulse_N_s_per_m"]),
    ];
    for (changes, fragments) in table {
        let (scene, warnings) = opened(changes);
        assert!(!scene.is_cushioned(&scene.entry().expect("an entry")), "{changes:?}");
        for fragment in *fragments {
            assert!(warnings.contains(fragment), "{changes:?}: no {fragment:?} in {warnings}");
        }
    }
    let (_, coarse) = opened(&["resolution.spacing=0.04"]);
    assert!(coarse.contains("0.0254 m would do for resolution.spacing"), "{coarse}");
}

#[test]
fn tension_beyond_the_vapour_pressure_is_reported() {
    let bound = "fluid.cavitation_pressure = -99000 bounds it";
    assert!(!opened(&["body.velocity=[0, -14]"]).1.contains("vapour"));
    assert!(opened(&["body.velocity=[0, -20]"]).1.contains(bound));
    assert!(!opened(&["body.velocity=[0, -20]", "fluid.cavitation_pressure=-99000"]).1.contains("vapour"));
    assert!(opened(&["body.velocity=[0, -20]", "solver=incompressible"]).1.contains("has fluid.cavitation_pressure"));
}
