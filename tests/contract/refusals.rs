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

/// The error of a file gives file, line, key, what was given and what was expected.
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
        ("spacing = 0.02", "spacing = 0.02\nfollow = true\ngrowth = 1.0", "drop.toml:6:", &["`resolution.follow` = true", "expected false with resolution.growth = 1"]),
        ("spacing = 0.02", "spacing = 0.02\nfollow = true\n[fluid]\nintegrator = \"verlet\"", "drop.toml:6:", &["`resolution.follow` = true", "expected false with this fluid.integrator"]),
        ("spacing = 0.02", "spacing = 0.02\nfollow = true\n[fluid]\nequation_of_state = \"ideal_gas\"", "drop.toml:6:", &["`resolution.follow` = true", "expected false with an ideal gas"]),
        ("[time]", "[fluid]\nlimit_pressure = 2\n[time]", "drop.toml:3:", &["`fluid.limit_pressure` = 2", "expected a whole number from 0 to 1"]),
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

/// The same for the newest keys, each with a value that it cannot have.
#[test]
fn a_bad_value_of_a_new_key_is_refused_with_line_key_given_and_expected() {
    const OSCILLATING: &str = "motion = \"oscillating\"\namplitude = [0.0, 0.01]\nperiod = 0.1\n";
    let fluid = |line: &str| DROP.replace("[body]", &format!("[fluid]\n{line}\n[body]"));
    let time = |line: &str| DROP.replace("end = 0.001", &format!("end = 0.001\n{line}"));
    let swing = |from: &str, to: &str| {
        let free = "mass = 100.0\nfree = [\"y\"]\nvelocity = [0.0, -5.0]\n";
        assert!(DROP.contains(free) && OSCILLATING.contains(from));
        let water = "[tank]\nwidth = 2.0\ndepth = 1.0\n[body]";
        DROP.replace(free, &OSCILLATING.replace(from, to)).replace("[body]", water)
    };
    let report = |line: &str| format!("{DROP}[report]\n{line}\n");
    let rule = |line: &str| format!("{DROP}[rule]\n{line}\n");
    let gauge = |line: &str| format!("{DROP}[[gauges]]\nname = \"keel\"\nat = [0.0, 0.0]\n{line}\n");
    let coupling = |line: &str| DROP.replace("[body]", &format!("[coupling]\n{line}\n[body]"));
    let whole = "expected a whole number from 0 to 4294967295";
    #[rustfmt::skip]
    let mistakes: &[(String, u32, &[&str])] = &[
        (fluid("density_filter_every = 0"), 7, &["`fluid.density_filter_every` = 0", "expected a whole number of at least 1"]),
        (fluid("density_filter_every = -5"), 7, &["`fluid.density_filter_every`", "-5", "expected a whole number of at least 1"]),
        (fluid("density_filter_every = 2.5"), 7, &["`fluid.density_filter_every`", "2.5", "expected a whole number of at least 1"]),
        (fluid("verlet_correction_every = -1"), 7, &["`fluid.verlet_correction_every`", "-1", whole]),
        (fluid("verlet_correction_every = \"often\""), 7, &["`fluid.verlet_correction_every`", "often", whole]),
        (fluid("xsph = -0.1"), 7, &["`fluid.xsph` = -0.1", "expected a number from 0 to 1"]),
        (fluid("xsph = 1.5"), 7, &["`fluid.xsph` = 1.5", "expected a number from 0 to 1"]),
        (fluid("temperature = 0"), 7, &["`fluid.temperature` = 0", "expected a finite number above 0"]),
        (fluid("molar_mass = -0.03"), 7, &["`fluid.molar_mass` = -0.03", "expected a finite number above 0"]),
        (fluid("cfl = 0"), 7, &["`fluid.cfl` = 0", "expected a finite number above 0"]),
        (fluid("cfl = 1.2"), 7, &["`fluid.cfl` = 1.2", "expected a number above 0 and below 1.2, where symplectic breaks down"]),
        (fluid("cfl = 1.2\nintegrator = \"predictor_corrector\""), 7, &["`fluid.cfl` = 1.2", "below 1.2, where predictor_corrector"]),
        (fluid("cfl = 1.4\nintegrator = \"beeman\""), 7, &["`fluid.cfl` = 1.4", "below 1.4, where beeman"]),
        (fluid("cfl = 0.7\nintegrator = \"verlet\""), 7, &["`fluid.cfl` = 0.7", "below 0.7, where verlet"]),
        (time("step = 0"), 4, &["`time.step` = 0", "expected an interval above 0"]),
        (time("step = 0.01"), 4, &["`time.step` = 0.01", "up to time.end = 0.001"]),
        (time("step = 5e-4"), 4, &["`time.step` = 0.0005", "expected an interval below", "1.2 h/c0, where symplectic breaks down"]),
        (swing("amplitude = [0.0, 0.01]\n", ""), 9, &["`body.amplitude` is missing", "[m]"]),
        (swing("[0.0, 0.01]", "0.01"), 15, &["`body.amplitude`", "0.01", "expected an array of length 2"]),
        (swing("[0.0, 0.01]", "[0.0, 0.0]"), 15, &["`body.amplitude` = [0.0, 0.0]", "expected other than [0, 0]", "fixed"]),
        (swing("[0.0, 0.01]", "[0.9, 0.0]"), 15, &["`body.amplitude` = [0.9, 0.0]", "expected at most 0.73 m along x"]),
        (swing("[0.0, 0.01]", "[0.0, -1.5]"), 15, &["`body.amplitude` = [0.0, -1.5]", "expected less than 1 m along y"]),
        (swing("period = 0.1", "period = 0"), 16, &["`body.period` = 0", "expected a finite number above 0"]),
        (swing("period = 0.1", "period = -2"), 16, &["`body.period` = -2", "expected a finite number above 0"]),
        (gauge("length = -0.1"), 17, &["`gauges[0].length` = -0.1", "expected a number of at least 0"]),
        (gauge("length = \"wide\""), 17, &["`gauges[0].length`", "wide", "expected a number"]),
        (gauge("bandwidth = 0"), 17, &["`gauges[0].bandwidth` = 0", "expected a finite number above 0"]),
        (gauge("bandwidth = -50"), 17, &["`gauges[0].bandwidth` = -50", "expected a finite number above 0"]),
        (report("length = 0"), 15, &["`report.length` = 0", "expected a finite number above 0"]),
        (report("length = \"long\""), 15, &["`report.length` = \"long\"", "expected a finite number above 0"]),
        (rule("takeoff_speed = -1"), 15, &["`rule.takeoff_speed` = -1", "expected a finite number above 0"]),
        (rule("takeoff_speed = 30\nk2 = 2.5"), 16, &["`rule.k2` = 2.5", "2"]),
        (rule("takeoff_speed = 30\nstep_deadrise_deg = 2"), 16, &["`rule.step_deadrise_deg` = 2", "expected a number from 4 to 60"]),
        (rule("landing_speed = 30"), 14, &["`rule.landing_mass` is missing", "[kg]"]),
        (rule("landing_mass = 2700"), 14, &["`rule.landing_speed` is missing", "V_S0"]),
        (rule("takeoff_mass = 2700"), 15, &["`rule.takeoff_mass` = 2700", "no effect here, only with rule.takeoff_speed"]),
        (rule("limit_load_factor = 3"), 14, &["`rule.rotorcraft_mass` is missing", "[kg]"]),
        (rule("rotorcraft_mass = 3000"), 14, &["`rule.limit_load_factor` is missing", "[-]"]),
        (rule("limit_load_factor = 3\nrotorcraft_mass = 3000\nfloats = 0"), 17, &["`rule.floats` = 0", "expected a whole number of at least 1"]),
        (rule("k2 = 1.0"), 14, &["`rule` = a table without a load", "expected takeoff_speed, landing_speed and landing_mass"]),
        (coupling("scheme = \"strong\""), 7, &["`coupling.scheme`", "strong", "iqn_ils"]),
        (coupling("scheme = \"aitken\""), 7, &["`coupling.scheme`", "aitken was dropped: \"iqn_ils\" needs no more iterations"]),
        (coupling("scheme = \"iqn_ils\"\n[fluid]\nwalls = \"mirror_point\""), 7, &["`coupling.scheme` = \"iqn_ils\"", "expected \"weak\" with these fluid.walls"]),
        (coupling("scheme = \"iqn_ils\"\n[fluid]\nintegrator = \"predictor_corrector\""), 7, &["`coupling.scheme` = \"iqn_ils\"", "expected \"added_mass\" with fluid.integrator"]),
        (coupling("tolerance = 0"), 7, &["`coupling.tolerance` = 0", "expected a number from"]),
        (coupling("max_iterations = 0"), 7, &["`coupling.max_iterations` = 0", "expected a whole number of at least 1"]),
        (coupling("max_iterations = -3"), 7, &["`coupling.max_iterations`", "-3", "expected a whole number of at least 1"]),
    ];
    let place = Workplace::new();
    for (text, line, fragments) in mistakes {
        fs::write(place.path("drop.toml"), text).expect("a file");
        for verb in [&["run", "drop.toml", "--out", "out"][..], &["check", "drop.toml"]] {
            let ended = place.run(verb);
            assert_eq!(ended.code, Some(2), "{fragments:?}: {}", ended.message);
            ended.says(&[&format!("drop.toml:{line}:")]);
            ended.says(fragments);
            assert!(ended.stdout.is_empty(), "{fragments:?} printed {:?}", ended.stdout);
        }
        assert!(!place.path("out").exists(), "{fragments:?} made an output folder");
    }
}

/// The error of a command line gives the argument that is wrong.
#[test]
fn a_wrong_argument_is_refused_and_named() {
    #[rustfmt::skip]
    let mistakes: &[(&[&str], &[&str])] = &[
        (&["run", "wegde"], &["`wegde` is neither a built-in scene nor a file", "wedge_constant"]),
        (&["run", "wedge", "--set", "body.mass"], &["--set body.mass:", "expected the form key.path=value"]),
        (&["run", "wedge", "--set", "body.mass=heavy"], &["--set body.mass=heavy:", "`body.mass`", "expected a finite number"]),
        (&["run", "wedge", "--set", "body.mas=3"], &["--set body.mas=3:", "unknown key `body.mas`", "body.mass"]),
        (&["run", "wedge", "--set", "body.mass=-1"], &["--set body.mass=-1:", "`body.mass` = -1", "expected a finite number above 0"]),
        (&["run", "wedge", "--threads", "0"], &["--threads 0", "expected 1 to"]),
        (&["run", "wedge", "--threads", "5000"], &["--threads 5000", "expected 1 to"]),
        (&["run", "wedge", "--thread", "1"], &["--thread"]),
        (&["run"], &["SCENE"]),
        (&["swim"], &["swim"]),
        (&["bands", "--uncharted", "100000000"], &["--uncharted", "1..=10000"]),
        (&["run", "hydrostatic_tank", "--set", "fluid.sound_speed=1"], &["`fluid.sound_speed` = 1", "expected at least"]),
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
/// A line as long as no terminal is, and a stderr that is full: the exit code stays.
#[test]
fn a_message_that_cannot_be_drawn_or_written_keeps_its_exit_code() {
    let place = Workplace::new();
    fs::write(place.path("wide.toml"), format!("name = \"{}\" x = 3\n", "a".repeat(70_000))).expect("a file");
    let ended = place.run(&["check", "wide.toml"]);
    assert_eq!(ended.code, Some(2), "{}", ended.message);
    ended.says(&["wide.toml:1", "not valid TOML"]);
    let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("/dev/full");
    let status = place.command(&["check", "nosuch"]).stderr(full).status().expect("a status");
    assert_eq!(status.code(), Some(2));
}

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
