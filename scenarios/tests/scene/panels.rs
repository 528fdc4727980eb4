//! Panels that are refused or doubted before a run.

use run::load;

fn message(scene: &str, sets: &[&str]) -> String {
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    load(scene, &sets).map_or_else(|error| error.to_string(), |_| "it loads".into())
}

#[test]
fn a_bad_panel_is_refused_with_key_given_and_expected() {
    #[rustfmt::skip]
    let table: &[(&str, &[&str])] = &[
        ("thickness=0", &["`body.panels[0].thickness` = 0", "above 0"]),
        ("thickness=-0.01", &["`body.panels[0].thickness` = -0.01", "above 0"]),
        ("thickness=0.2", &["`body.panels[0].thickness` = 0.2", "half the panel's length of 0.3193 m"]),
        ("elements=1", &["`body.panels[0].elements` = 1", "2 to 2000"]),
        ("elements=100000", &["`body.panels[0].elements` = 100000", "2 to 2000"]),
        ("youngs_modulus=0", &["`body.panels[0].youngs_modulus` = 0", "above 0"]),
        ("poissons_ratio=0.5", &["`body.panels[0].poissons_ratio` = 0.5", "below 0.5"]),
        ("density=nan", &["`body.panels[0].density` = NaN", "finite"]),
        ("from=[0.1, 0.5]", &["`body.panels[0].from` = [0.1, 0.5]", "a point on the body's line", "m away"]),
        ("from=[-0.1, 0.0364]", &["`body.panels[0].from`", "x >= 0 with symmetry"]),
        ("to=[0.0, 0.0]", &["`body.panels[0].to`", "another point than from"]),
        ("ends=[\"free\", \"sliding\"]", &["`body.panels[0].ends` = [free, sliding]", "at least one end clamped or pinned"]),
        ("ends=[\"guided\", \"guided\"]", &["`body.panels[0].ends` = [guided, guided]", "at least one end clamped or pinned"]),
        ("ends=[\"free\", \"guided\"]", &["`body.panels[0].ends` = [free, guided]", "at least one end clamped or pinned"]),
        ("end_springs=[[1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]", &["`body.panels[0].end_springs[0]` = [1.0, 0.0, 0.0]", "clamped and guided"]),
        ("end_dampers=[[0.0, 0.0, 0.0], [0.0, 0.0, -1.0]]", &["`body.panels[0].end_dampers[1]`", "[0, 0, 0] at this end"]),
        ("end_springs=[[1.0, 0.0, 0.0]]", &["body.panels[0].end_springs", "2"]),
        ("plane=shell", &["body.panels", "shell", "strain", "stress"]),
        ("ends=[\"clamped\", \"mirror\"]", &["`body.panels[0].ends`", "mirror only at x = 0"]),
        ("ends=[\"clamped\", \"welded\"]", &["body.panels", "clamped"]),
        ("watch=[0.5, 1.2]", &["`body.panels[0].watch[1]` = 1.2", "0 to 1"]),
        ("name=wedge", &["`body.panels[0].name` = \"wedge\"", "a name that no other panel or body has"]),
        ("hardening_modulus=1e9", &["`body.panels[0].hardening_modulus`", "only with body.panels[0].yield_stress"]),
        ("rupture_strain=-1", &["`body.panels[0].rupture_strain` = -1", "above 0"]),
        ("colour=red", &["colour"]),
    ];
    for (set, parts) in table {
        let message = message("flexible_wedge", &[&format!("body.panels[0].{set}")]);
        for part in *parts {
            assert!(message.contains(part), "{set}: {part:?} is not in: {message}");
        }
    }
    let ends = |ends: &str, springs: &str| {
        message(
            "flexible_wedge",
            &[&format!("body.panels[0].ends={ends}"), &format!("body.panels[0].end_springs={springs}")],
        )
    };
    let pinned = ends("[\"pinned\", \"clamped\"]", "[[0.0, 5.0, 1.0], [0.0, 0.0, 0.0]]");
    assert!(pinned.contains("`body.panels[0].end_springs[0]`") && pinned.contains("holds its place"), "{pinned}");
    let loose = ends("[\"free\", \"free\"]", "[[0.0, 5.0, 1.0], [0.0, 0.0, 0.0]]");
    assert!(loose.contains("`body.panels[0].ends` = [free, free]") && loose.contains("end_springs"), "{loose}");
    assert_eq!(ends("[\"free\", \"free\"]", "[[5.0, 5.0, 1.0], [0.0, 0.0, 0.0]]"), "it loads");
    let both = message("flexible_wedge", &["body.panels[0].theory=timoshenko", "body.panels[0].yield_stress=1e8"]);
    assert!(both.contains("`body.panels[0].theory`") && both.contains("euler_bernoulli"), "{both}");
    let damped = message("wedge", &["body.damping=[1.0, 0.0]"]);
    assert!(damped.contains("`body.damping`") && damped.contains("only with body.panels"), "{damped}");
}

/// A panel that would be unstable, a membrane, or stepped over gets a warning with a number and a remedy.
#[test]
fn a_doubtful_panel_is_warned_about() {
    let warned = |scene: &str, sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
        load(scene, &sets).expect("it loads").warnings.join("\n")
    };
    let sound = warned("flexible_wedge", &[]);
    assert!(!sound.contains("plate"), "{sound}");
    let light = warned("flexible_wedge", &["coupling.scheme=weak", "body.panels[0].thickness=0.001"]);
    assert!(light.contains("plate is light for coupling.scheme = \"weak\"") && light.contains("added_mass"), "{light}");
    let thin = warned("flexible_wedge", &["body.panels[0].thickness=0.0002"]);
    assert!(thin.contains("plate is so thin that") && thin.contains("as a membrane"), "{thin}");
    let slow = warned(
        "flexible_wedge",
        &["time.step=1e-5", "body.panels[0].density=0.001", "body.panels[0].youngs_modulus=1e12"],
    );
    assert!(slow.contains("of the period of plate's first dry mode"), "{slow}");
    let projection = |step: &str| warned("hydrostatic_plate", &["solver=incompressible", step]);
    let coarse = projection("time.step=1e-3");
    assert!(coarse.contains("of plate's first wet period, about 0.005") && coarse.contains(" s would do"), "{coarse}");
    assert!(!projection("time.step=1.9e-4").contains("wet period") && !projection("time.end=1").contains("wet period"));
    assert!(!warned("hydrostatic_plate", &["time.step=1e-4"]).contains("wet period"), "sound takes shorter steps");
}
