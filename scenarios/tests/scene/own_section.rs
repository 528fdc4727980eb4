//! The section of the guide: its points in each format, its panel, its picture.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use report::section_picture;
use run::{RunOptions, load, load_text, run};
use scenarios::preflight::preflight;
use scene::{Loaded, Shape, panel_length};

const POINTS: &str = include_str!("../../../docs/src/guide/hull_section.csv");
const GUIDE: &str = include_str!("../../../docs/src/guide/own-section.md");

/// The guide's scene with its points in another file.
fn loaded(folder: &Path, file: &str, text: &str) -> Loaded {
    let start = GUIDE.find("# hull.toml").expect("the guide's scene");
    let scene = &GUIDE[start..start + GUIDE[start..].find("```").expect("its end")];
    fs::write(folder.join(file), text).expect("a file");
    let path = folder.join("hull.toml");
    fs::write(&path, scene.replace("hull_section.csv", file)).expect("a file");
    load(path.to_str().expect("a printable path"), &[]).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// The points in the order of the file [mm].
fn points() -> Vec<[f64; 2]> {
    let rows = POINTS.lines().skip(2).map(|line| line.split(',').map(|cell| cell.trim().parse().expect("a number")));
    rows.map(|mut cells| [cells.next().expect("x"), cells.next().expect("y")]).collect()
}

fn outline(loaded: &Loaded) -> Vec<[f64; 2]> {
    let Some(Shape::Polygon { points }) = loaded.scene.body.as_ref().map(|body| &body.shape) else {
        panic!("a polygon")
    };
    points.clone()
}

#[test]
fn the_guides_section_is_understood_in_every_format() {
    let folder = temp_dir::TempDir::new().expect("a folder");
    let of = |file: &str, text: &str| loaded(folder.path(), file, text);
    let csv = of("a.csv", POINTS);
    let report = csv.outline.clone().expect("an outline");
    assert_eq!((report.points_in_file, report.points, report.orientation_changed), (40, 40, false));
    let body = csv.scene.body.as_ref().expect("a body");
    let length = panel_length(body, &body.panels[0]);
    assert!((length - 0.3533).abs() < 1e-3, "{length}");
    assert_eq!((body.panels[0].thickness, body.panels[0].youngs_modulus), (0.004, 72.4e9));
    let reversed: Vec<[f64; 2]> = points().into_iter().rev().collect();
    let (mut dat, mut dxf, mut svg) = ("Hull\n".to_string(), String::new(), String::new());
    for [x, y] in points() {
        let _ = writeln!(dat, "{} {}", x / 1000.0, y / 1000.0);
        let _ = writeln!(dxf, "10\n{x}\n20\n{y}");
        let _ = write!(svg, "{x},{} ", -y);
    }
    let header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n90\n40\n70\n1\n";
    let dxf = format!("{header}{dxf}0\nENDSEC\n0\nEOF\n");
    let svg = format!("<svg width=\"1100mm\" viewBox=\"0 0 1100 500\"><polygon points=\"{svg}\"/></svg>");
    for (file, text) in [("a.dat", dat), ("a.dxf", dxf), ("a.svg", svg)] {
        let found = outline(&of(file, &text));
        let gap = found.iter().zip(outline(&csv)).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max);
        assert!(found.len() == 40 && gap < 1e-12, "{file}: {gap}");
    }
    // clockwise: the same body, and with the points counted from the other end the same panel
    let text: String = reversed.iter().map(|[x, y]| format!("{x};{y}\n")).collect();
    let scene = fs::read_to_string(folder.path().join("hull.toml")).expect("the scene");
    let scene = scene.replace("a.svg", "b.csv").replace("outline =", "outline_unit = \"mm\"\noutline =");
    let scene = scene.replace("from_point = 3 ", "from_point = 29").replace("to_point = 12", "to_point = 38");
    fs::write(folder.path().join("b.csv"), text).expect("a file");
    let path = folder.path().join("turned.toml");
    fs::write(&path, scene).expect("a file");
    let turned = load(path.to_str().expect("a printable path"), &[]).expect("it loads");
    assert!(turned.outline.as_ref().is_some_and(|outline| outline.orientation_changed));
    let panel = |loaded: &Loaded| {
        let panel = loaded.scene.body.as_ref().expect("a body").panels[0].clone();
        [panel.from, panel.to]
    };
    assert_eq!(panel(&turned), panel(&csv));
    let picture = section_picture(&csv.scene);
    assert!(picture.starts_with("<svg") && picture.contains("panel bottom") && picture.contains(">37</text>"));
}

/// Points rounded to 0.01 mm, as drawings have them, leave dents of that size in a convex bottom: theories hold all the same.
#[test]
fn a_convex_section_with_rounded_points_has_its_theories() {
    let folder = temp_dir::TempDir::new().expect("a folder");
    let face = |k: u32| {
        let x = 550.0 * f64::from(k) / 60.0;
        [x, 0.30 * x + 1e-5 * x * x].map(|value| (100.0 * value).round() / 100.0)
    };
    let side: Vec<[f64; 2]> = (1..=60).map(face).chain([[550.0, 400.0]]).collect();
    let slope = |w: &[[f64; 2]]| (w[1][1] - w[0][1]) / (w[1][0] - w[0][0]);
    let slopes: Vec<f64> = side[..60].windows(2).map(slope).collect();
    assert!(slopes.windows(2).any(|w| w[1] < w[0] - 1e-4), "no dents");
    let mirrored = side.iter().rev().map(|[x, y]| [-x, *y]);
    let points: Vec<[f64; 2]> = [[0.0, 0.0]].into_iter().chain(side.iter().copied()).chain(mirrored).collect();
    let text: String = points.iter().map(|[x, y]| format!("{x},{y}\n")).collect();
    fs::write(folder.path().join("a.csv"), format!("x [mm],y [mm]\n{text}")).expect("a file");
    let scene = "name = \"hull\"\nsymmetry = \"x\"\n[time]\nend = 0.02\n[resolution]\nspacing = 0.01\n[body]\nshape = \"polygon\"\n\
                 outline = \"a.csv\"\nmass = 100.0\nfree = [\"y\"]\nvelocity = [0.0, -5.0]\n";
    let path = folder.path().join("hull.toml");
    fs::write(&path, scene).expect("a file");
    let loaded = load(path.to_str().expect("a printable path"), &[]).expect("it loads");
    let theories = preflight(&loaded.scene, &[]).theories;
    let said: Vec<_> = theories.iter().filter_map(|theory| Some((theory.model, theory.obstacle.clone()?))).collect();
    let of_wedges_only = ["similarity", "boundary_element"];
    assert!(said.iter().all(|(model, _)| of_wedges_only.contains(&model.name())), "{said:?}");
}

#[test]
fn a_motion_from_a_table_is_that_of_its_rows() {
    let folder = temp_dir::TempDir::new().expect("a folder");
    fs::write(folder.path().join("drop.csv"), "t [ms], y [mm]\n0, 3\n5, -22\n10, -47\n").expect("a file");
    let scene = "name = \"m\"\ntime = { end = 0.01 }\nresolution = { spacing = 0.01 }\ntank = { width = 2.0, depth = 1.0 }\n\
                 [body]\nshape = \"box\"\nbreadth = \"40 cm\"\nheight = \"20 cm\"\nmotion_file = \"drop.csv\"\n";
    let path = folder.path().join("m.toml");
    fs::write(&path, scene).expect("a file");
    let loaded = load(path.to_str().expect("a printable path"), &[]).expect("it loads");
    let text = loaded.scene.to_toml();
    assert!(text.contains("motion = \"tabulated\"") && text.contains("breadth = 0.4"), "{text}");
    let again = run::load_text("again", &text, &[]).expect("the resolved scene loads");
    assert_eq!(again.scene, loaded.scene);
}

/// A float of 18 deg with a keel of 80 mm radius, drawn by this number of chords to each side; `more` ends the table of the body.
fn float(chords: u32, more: &str) -> String {
    let slope = 18.0_f64.to_radians();
    let arc = |k: u32| {
        let angle = slope * f64::from(k) / f64::from(chords);
        [0.08 * angle.sin(), 0.08 * (1.0 - angle.cos())]
    };
    let chine = [0.56, arc(chords)[1] + (0.56 - arc(chords)[0]) * slope.tan()];
    let right: Vec<[f64; 2]> = (0..=chords).map(arc).chain([chine, [0.56, 0.5]]).collect();
    let points: Vec<[f64; 2]> = right.iter().copied().chain(right[1..].iter().rev().map(|[x, y]| [-x, *y])).collect();
    format!(
        "name = \"float\"\nsymmetry = \"x\"\ntime = {{ end = 0.02 }}\nresolution = {{ spacing = 0.006 }}\n\
         [body]\nshape = \"polygon\"\npoints = {points:?}\n{more}"
    )
}

const FALLING: &str = "mass = 300.0\nfree = [\"y\"]\nvelocity = [0.0, -4.0]\n";

/// Neither the speed of sound nor the warnings depend on how finely a small round keel is drawn.
#[test]
fn the_chords_of_a_small_round_keel_change_nothing() {
    let of = |chords: u32| load_text("float", &float(chords, FALLING), &[]).expect("it loads");
    let one = of(1);
    assert!((250.0..800.0).contains(&one.scene.sound_speed()), "{}", one.scene.sound_speed());
    for chords in [2, 3, 4, 8] {
        let more = of(chords);
        let ratio = more.scene.sound_speed() / one.scene.sound_speed();
        assert!((ratio - 1.0).abs() < 0.01, "{chords} chords: {ratio}");
        assert_eq!(more.warnings.len(), one.warnings.len(), "{chords} chords: {:?}", more.warnings);
        assert!(!more.warnings.iter().any(|warning| warning.contains("meets it at once")), "{:?}", more.warnings);
    }
}

/// A wide flat keel is no blunt one.
#[test]
fn a_flat_bottom_stays_flat() {
    let flat = "name = \"flat\"\ntime = { end = 0.02 }\nresolution = { spacing = 0.006 }\n[body]\nshape = \"polygon\"\n\
                points = [[-0.1, 0.0], [0.1, 0.0], [0.5, 0.2], [0.5, 0.4], [-0.5, 0.4], [-0.5, 0.2]]\n";
    let loaded = load_text("flat", &format!("{flat}{FALLING}"), &[]).expect("it loads");
    assert!(loaded.warnings.iter().any(|warning| warning.contains("meets it at once")), "{:?}", loaded.warnings);
}

/// Panels of a body that starts at the speed of its table start at that speed.
#[test]
fn a_given_motion_carries_its_panels() {
    let more = "motion = \"tabulated\"\ndisplacements = [[0, 0, 0, 0], [0.01, 0, -0.04, 0], [0.02, 0, -0.07, 0]]\n\
                [[body.panels]]\nfrom_point = 3\nto_point = 4\nthickness = \"4 mm\"\nmaterial = \"aluminium_2024_t3\"\n";
    let scene = load_text("float", &float(2, more), &["time.end=0.001".to_string()]).expect("it loads").scene;
    assert!(scene.sound_speed() > 250.0, "{}", scene.sound_speed());
    let summary = run(&scene, &RunOptions::default()).expect("a run").summary;
    assert!(summary.status.is_completed(), "{:?}", summary.message);
    assert!(summary.results.panels["panel1"][&scene::vocabulary::ResultName::PeakStress].value < 1e9);
}
