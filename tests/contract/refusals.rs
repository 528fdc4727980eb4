//! Wrong input: exit 2, a message with key, given and expected, and nothing touched.

use std::fs;

use crate::command::Workplace;

/// A complete scene; tests count its lines.
const DROP: &str = r#"name = "drop"
[time]
end = 0.001
[resolution]
spacing = 0.02
[body]
shape = "wedge"
deadrise_deg = 30.0
breadth = 0.5
side_height = 0.2
mass = 100.0
free = ["y"]
velocity = [0.0, -5.0]
"#;

/// A mistake in a file is told with file, line, key, what was given and what was expected.
#[test]
fn a_wrong_file_is_refused_with_line_key_given_and_expected() {
    #[rustfmt::skip]
    let mistakes: &[(&str, &str, &str, &[&str])] = &[
        ("breadth = 0.5", "breadht = 0.5", "drop.toml:9:", &["unknown key `body.breadht`", "expected", "body.breadth"]),
        ("mass = 100.0", "mass = -3", "drop.toml:11:", &["`body.mass` = -3", "expected a finite number above 0"]),
        ("end = 0.001", "end = nan", "drop.toml:3:", &["`time.end` = NaN", "expected a finite number"]),
        ("spacing = 0.02", "spacing = 0", "drop.toml:5:", &["`resolution.spacing` = 0", "expected a finite number above 0"]),
        ("spacing = 0.02", "spacing = 0.2", "drop.toml:5:", &["`resolution.spacing` = 0.2", "expected at most", "thinner than 6 spacings"]),
        ("spacing = 0.02", "spacing = 1e-6\nfine_zone = [1.0, 1.0]", "drop.toml:5:", &["`resolution.spacing` = 0.000001", "expected a spacing that fits in", "GiB"]),
        ("[time]", "[tank]\ndepth = 0.01\n[time]", "drop.toml:3:", &["`tank.depth` = 0.01", "expected at least 4 spacings of water"]),
        ("[time]", "[tank]\nwidth = 0.4\n[time]", "drop.toml:", &["`body.position` = a body from x = -0.25 to 0.25 m", "overlapping a tank wall", "expected a body between the walls"]),
        ("[time]", "[tank]\nwidth = 4\ndepth = 0.3\n[time]", "drop.toml:", &["`body.position` = a body down to y = -0.5 m", "overlapping the floor", "expected a body above"]),
        ("[time]", "symmetry = \"x\"\ngravity = [1.0, -9.81]\n[time]", "drop.toml:3:", &["`gravity` = [1, -9.81]", "expected [0, ...]"]),
        ("[time]\nend = 0.001\n[resolution]\nspacing = 0.02\n[body]", "symmetry = \"x\"\n[time]\nend = 0.001\n[resolution]\nspacing = 0.02\n[body]\ncenter_of_mass = [0.1, 0.1]", "drop.toml:8:", &["`body.center_of_mass` = [0.1, 0.1]", "expected [0, ...]"]),
        ("spacing = 0.02", "spacing = 0.02\nlattice = \"staggered\"", "drop.toml:6:", &["`resolution.lattice` = \"staggered\"", "expected \"square\" with resolution.growth = 1.1"]),
        ("[time]", "[fluid]\nlimit_pressure = 2\n[time]", "drop.toml:3:", &["`fluid.limit_pressure` = 2", "expected 0 or 1"]),
        ("[time]", "[fluid]\nwalls = \"brick\"\n[time]", "drop.toml:3:", &["`fluid.walls`", "brick", "expected"]),
        ("[time]", "[gauges]\nname = \"g\"\n[time]", "drop.toml:2:", &["`gauges`", "expected a list"]),
        ("[time]", "[[compare]]\nreference = \"none.csv\"\nx = \"t_s\"\ny = \"v\"\nquantity = \"body.vy_m_per_s\"\nnorm = \"rms\"\n[time]", "drop.toml:3:", &["`compare[0].reference` = \"none.csv\"", "expected a table that can be used"]),
        ("end = 0.001", "end = ", "drop.toml:3:", &["not valid TOML"]),
    ];
    let place = Workplace::new();
    for (from, to, at, fragments) in mistakes {
        assert!(DROP.contains(from), "{from}");
        let mut text = DROP.replacen(from, to, 1);
        if to.contains("depth = 0.3") {
            text += "position = [0.0, -0.5]\n";
        }
        fs::write(place.path("drop.toml"), text).expect("a file");
        for verb in [&["run", "drop.toml", "--out", "out"][..], &["check", "drop.toml"]] {
            let ended = place.run(verb);
            assert_eq!(ended.code, Some(2), "{to:?}: {}", ended.message);
            ended.says(&[at]);
            ended.says(fragments);
            assert!(ended.stdout.is_empty(), "{to:?} printed {:?}", ended.stdout);
        }
        assert!(!place.path("out").exists(), "{to:?} made an output folder");
    }
}

/// A mistake on the command line is told with the argument that makes it.
#[test]
fn a_wrong_argument_is_refused_and_named() {
    #[rustfmt::skip]
    let mistakes: &[(&[&str], &[&str])] = &[
        (&["run", "wegde"], &["`wegde` is neither a built-in scene nor a file", "wedge_constant"]),
        (&["run", "wedge", "--set", "body.mass"], &["--set body.mass:", "expected the form key.path=value"]),
        (&["run", "wedge", "--set", "body.mass=heavy"], &["--set body.mass=heavy:", "`body.mass`", "expected a number"]),
        (&["run", "wedge", "--set", "body.mas=3"], &["--set body.mas=3:", "unknown key `body.mas`", "body.mass"]),
        (&["run", "wedge", "--set", "body.mass=-1"], &["--set body.mass=-1:", "`body.mass` = -1", "expected a finite number above 0"]),
        (&["run", "wedge", "--threads", "0"], &["--threads 0", "expected at least 1"]),
        (&["run", "wedge", "--thread", "1"], &["--thread"]),
        (&["run"], &["SCENE"]),
        (&["swim"], &["swim"]),
        (&["validate", "nothing"], &["`nothing`", "wedge_constant_30"]),
    ];
    let place = Workplace::new();
    for (arguments, fragments) in mistakes {
        let ended = place.run(arguments);
        assert_eq!(ended.code, Some(2), "{arguments:?}: {}", ended.message);
        ended.says(fragments);
        assert!(!place.path("runs").exists(), "{arguments:?} made an output folder");
    }
}

/// A reference that a scene names and that is not there is wrong input, found before anything is written.
#[test]
fn a_missing_reference_is_refused_before_the_run() {
    let place = Workplace::new();
    let compare = "[[compare]]\nreference = \"nowhere.csv\"\nquantity = \"body.vy_m_per_s\"\nx = \"t\"\ny = \"v\"\n";
    fs::write(place.path("drop.toml"), format!("{DROP}{compare}")).expect("a file");
    let ended = place.run(&["run", "drop.toml", "--out", "out"]);
    assert_eq!(ended.code, Some(2), "{}", ended.message);
    ended.says(&["`nowhere.csv`", "neither a built-in table nor a readable file"]);
    assert!(!place.path("out").exists());
}

/// A folder that holds any file of a run is left as it is, byte for byte, unless `--force` says otherwise.
#[test]
fn an_occupied_folder_is_not_overwritten_without_force() {
    let place = Workplace::new();
    fs::write(place.path("drop.toml"), DROP).expect("a file");
    fs::create_dir(place.path("out")).expect("a folder");
    fs::write(place.path("out/series.csv"), "precious").expect("a file");
    fs::write(place.path("out/notes.txt"), "mine").expect("a file");
    let ended = place.run(&["run", "drop.toml", "--out", "out"]);
    assert_eq!(ended.code, Some(2), "{}", ended.message);
    ended.says(&["out already holds a run (series.csv)", "--force"]);
    assert_eq!(place.text("out/series.csv"), "precious");
    assert_eq!(fs::read_dir(place.path("out")).expect("a folder").count(), 2, "a file was added");

    let forced = place.run(&["run", "drop.toml", "--out", "out", "--force", "--quiet"]);
    assert_eq!(forced.code, Some(0), "{}", forced.message);
    assert!(place.text("out/series.csv").starts_with("time_s,"));
    assert_eq!(place.text("out/notes.txt"), "mine", "a file that is no run's was touched");
}
