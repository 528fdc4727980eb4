//! Values that can be run, but are hardly meant: warnings with their numbers and the likely unit.

use std::fs;

use run::load;
use scene::builtin;

/// A section 1.2 m wide, its points in mm.
const POINTS: [[f64; 2]; 5] = [[0.0, 0.0], [600.0, 200.0], [600.0, 500.0], [-600.0, 500.0], [-600.0, 200.0]];

/// Warnings about a section with a mass, from a file with a header and points.
fn warnings(keys: &str, header: &str, points: &[[f64; 2]]) -> Vec<String> {
    let folder = temp_dir::TempDir::new().expect("a folder");
    let rows: String = points.iter().map(|[x, y]| format!("{x}, {y}\n")).collect();
    fs::write(folder.path().join("hull.csv"), format!("{header}\n{rows}")).expect("a file");
    let scene = format!(
        "name = \"hull\"\n[time]\nend = 0.02\n[resolution]\nspacing = 0.01\n[body]\nshape = \"polygon\"\noutline = \"hull.csv\"\n\
         free = [\"y\"]\nvelocity = [0.0, -5.0]\n{keys}"
    );
    let path = folder.path().join("hull.toml");
    fs::write(&path, scene).expect("a file");
    load(path.to_str().expect("a printable path"), &[]).unwrap_or_else(|error| panic!("{keys}: {error}")).warnings
}

fn assert_warned(said: &[String], parts: &[&str]) {
    let found = said.iter().any(|warning| parts.iter().all(|part| warning.contains(part)));
    assert!(found, "{parts:?} in {said:?}");
}

#[test]
fn a_mean_density_that_no_body_has_is_reported_with_the_likely_unit() {
    let of = |keys: &str, header: &str| warnings(keys, header, &POINTS);
    let in_metres = of("mass = 300.0", "x, y");
    assert_warned(
        &in_metres,
        &["mean density", "body.mass = 300 kg/m on 480000 m²", "1200 m wide", "body.outline_unit = \"mm\""],
    );
    assert_warned(&of("mass = 0.3", "x [mm], y [mm]"), &["mean density", "0.625 kg/m³", "body.mass = \"0.3 t/m\""]);
    assert_warned(&of("mass = 3e5", "x [mm], y [mm]"), &["mean density", "625000 kg/m³", "expected 1 to 20000"]);
    let sound = of("mass = 300.0", "x [mm], y [mm]");
    assert!(!sound.iter().any(|warning| warning.contains("mean density")), "{sound:?}");
}

#[test]
fn a_body_lighter_than_its_own_panels_is_reported() {
    let panel = "[[body.panels]]\nname = \"bottom\"\nfrom_point = 1\nto_point = 2\nthickness = \"4 mm\"\nmaterial = \"steel_s235\"\n";
    let of = |mass: &str| warnings(&format!("mass = {mass}\n{panel}"), "x [mm], y [mm]", &POINTS);
    assert_warned(&of("0.3"), &["body.mass = 0.3 kg/m", "less than their 19.8", "\"0.3 t/m\""]);
    assert!(!of("300.0").iter().any(|warning| warning.contains("without its panels")));
    let in_metres = warnings(&format!("mass = 300.0\n{panel}"), "x, y", &POINTS);
    assert_warned(&in_metres, &["mean density", "body.outline_unit = \"mm\""]);
    assert!(!in_metres.iter().any(|warning| warning.contains("t/m")), "{in_metres:?}");
}

#[test]
fn half_a_section_in_a_scene_without_symmetry_is_reported() {
    let half = [&POINTS[..3], &[[0.0, 500.0]]].concat();
    assert_warned(
        &warnings("mass = 100.0", "x [mm], y [mm]", &half),
        &["hull.csv may be half a section", "both halves"],
    );
}

#[test]
fn a_class_that_sae_j211_does_not_have_is_reported() {
    let of = |class: &str| load("wedge", &[format!("report.acceleration_cfc={class}")]).expect("a scene").warnings;
    assert_warned(&of("100"), &["acceleration_cfc = 100 Hz", "60, 180, 600, 1000"]);
    assert!(!of("180").iter().any(|warning| warning.contains("acceleration_cfc")));
}

/// But for a plate that is so heavy that it keeps its speed.
#[test]
fn no_other_scene_of_ours_is_implausible() {
    for (name, _) in builtin().iter().filter(|(name, _)| *name != "plate_drop") {
        let said = load(name, &[]).expect("a built-in scene").warnings;
        let doubtful = |warning: &&String| ["mean density", "its panels"].iter().any(|part| warning.contains(part));
        assert_eq!(said.iter().find(doubtful), None, "{name}");
    }
}
