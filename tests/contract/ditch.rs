//! `splashdown ditch`: files, keys, exit codes, and what it refuses.

use serde_json::Value;

use crate::command::Workplace;

const SHORT: [&str; 6] = ["ditch", "mercure", "--set", "landing.end=0.5", "--out", "out"];

/// Five files; the summary on stdout; the resolved landing lands to the same bits; a second one does not replace the first.
#[test]
fn a_landing_writes_its_files() {
    let place = Workplace::new();
    let ended = place.run(&[&SHORT[..], &["--json"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let summary = place.summary("out");
    let printed = place.run(&["ditch", "mercure", "--set", "landing.end=0.5", "--out", "printed"]);
    assert!(printed.stdout.contains("no band of these loads"), "{}", printed.stdout);
    assert_eq!(serde_json::from_str::<Value>(&ended.stdout).expect("JSON on stdout"), summary);
    assert_eq!((&summary["status"], &summary["model"]), (&"completed".into(), &"mlm".into()));
    assert!(summary["load_factor"]["value"].as_f64().expect("a number") > 1.0);
    let series = place.text("out/series.csv");
    assert!(series.starts_with("time_s,x_m,z_m,pitch_deg,") && series.lines().count() == 102, "{}", series.len());
    let page = place.text("out/report.html");
    assert!(page.matches("<svg").count() >= 10 && !page.contains("src=\"http"), "charts and side views, no network");
    for part in ["status doubtful", "no band known", "factor of 1.5", "<summary>scene.resolved.toml", "at 0.395\u{a0}s"]
    {
        assert!(page.contains(part), "{part}");
    }
    for internal in ["az_m_per_s2", "line_load_N_per_m", "e5"] {
        assert!(!page.contains(&format!(">{internal}")), "{internal} is no word of a reader");
    }

    let again = place.run(&["ditch", "out/scene.resolved.toml", "--out", "again", "--quiet"]);
    assert_eq!(again.code, Some(0), "{}", again.message);
    assert_eq!(place.text("again/series.csv"), series);
    let occupied = place.run(&SHORT);
    assert_eq!(occupied.code, Some(2));
    occupied.says(&["already holds a run", "--force"]);
    assert_eq!(place.run(&[&SHORT[..], &["--force", "--quiet"]].concat()).code, Some(0));
}

/// On waves: phase of the first contact in summary and report, elevation below the centre of mass in the series; the resolved landing is the same.
#[test]
fn a_landing_on_waves_reports_where_it_touched() {
    let place = Workplace::new();
    let sea = "sea={height=1.0,length=100.0,heading_deg=180,touchdown=\"up_slope\"}";
    let ended = place.run(&[&SHORT[..], &["--set", sea]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    assert!(ended.stdout.contains("at phase 270 degrees"), "{}", ended.stdout);
    let phase = place.summary("out")["sea"]["touchdown_phase_deg"].as_f64().expect("a number");
    assert!((phase - 270.0).abs() < 1.0, "{phase}");
    let series = place.text("out/series.csv");
    let header = series.lines().next().expect("a header");
    assert!(header.contains(",elevation_m,phase_deg,"), "{header}");
    let page = place.text("out/report.html");
    for part in ["Phase of the waves at the first contact", "water below it", "regular waves of linear theory"] {
        assert!(page.contains(part), "{part}");
    }
    let again = place.run(&["ditch", "out/scene.resolved.toml", "--out", "again", "--quiet"]);
    assert_eq!(again.code, Some(0), "{}", again.message);
    assert_eq!(place.text("again/series.csv"), series);
    let refused = place.run(&[&SHORT[..4], &["--set", sea, "--set", "sea.height=15", "--out", "none"]].concat());
    assert_eq!(refused.code, Some(2), "{}", refused.message);
    refused.says(&["sea.height", "below 14.2 m"]);
}

/// What a file assumes stands with its results, and so does a fuselage that bends too far for linear bending.
#[test]
fn a_landing_reports_its_assumptions() {
    let place = Workplace::new();
    let sets = ["landing.end=1.8", "assumptions=[\"keel < line & mass\"]", "beam.stiffness=[8e6]"];
    let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
    let ended = place.run(&[&SHORT[..], &sets[..]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    for said in ["assumed: keel < line & mass", "bending is linear up to about 6 degrees"] {
        assert!(ended.stdout.contains(said), "{said}: {}", ended.stdout);
    }
    let summary = place.summary("out");
    assert_eq!(summary["assumptions"][0], "keel < line & mass");
    assert!(summary["deflection_m"]["value"].as_f64().expect("a number").abs() > 0.5, "{}", summary["deflection_m"]);
    assert!(place.text("out/report.html").contains("<li>keel &lt; line &amp; mass</li>"));
    for (set, key, expected) in [
        ("assumptions=[\" \"]", "assumptions[0]", "words on one line"),
        ("accelerometers[0].at=[100,0]", "accelerometers[0].at", "a place on the fuselage, from 0 to"),
    ] {
        let refused = place.run(&[&SHORT[..4], &["--set", set, "--out", "none"]].concat());
        assert_eq!(refused.code, Some(2), "{}", refused.message);
        refused.says(&[key, expected]);
    }
}

#[test]
fn sections_of_a_landing_can_be_checked_and_run() {
    let place = Workplace::new();
    let ended = place.run(&[&SHORT[..], &["--export-sections", "sections", "--sections", "2", "--quiet"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let files: Vec<_> = std::fs::read_dir(place.path("sections")).expect("a folder").flatten().collect();
    assert_eq!(files.len(), 2);
    for file in files {
        let text = std::fs::read_to_string(file.path()).expect("a scene");
        let number = |key: &str| {
            let line = text.lines().find(|line| line.starts_with(&format!("{key} = "))).expect(key);
            line.rsplit(' ').next().and_then(|word| word.trim_end_matches(']').parse::<f64>().ok()).expect("a number")
        };
        let (_, draught) = text.split_once("its draught is ").expect("a draught");
        let draught: f64 = draught.split(' ').next().expect("a word").parse().expect("a number");
        assert!(draught / number("spacing") > 15.9, "{draught} m in spacings of {} m", number("spacing"));
        let checked = place.run(&["check", file.path().to_str().expect("a path")]);
        assert_eq!(checked.code, Some(0), "{}", checked.message);
    }
}

fn write(place: &Workplace, name: &str, text: &str) {
    std::fs::write(place.path(name), text).expect("a file");
}

/// Frames of a fuselage in files of their own, whole and half, and what stands beside them: struts, windows, exits.
fn own_landing(place: &Workplace) {
    let mut scene = String::from(OWN);
    for (k, (x, radius, keel)) in
        [(0.0, 0.5, -0.5), (3.0, 1.4, -1.4), (12.0, 1.5, -1.5), (18.0, 0.8, 0.0)].into_iter().enumerate()
    {
        let whole = k % 2 == 0;
        let count = if whole { 72 } else { 37 };
        let point = |j: i32| {
            let angle = std::f64::consts::PI * f64::from(j) / 36.0;
            format!("{:.3},{:.3}\n", 1e3 * radius * f64::sin(angle), 1e3 * (keel + radius - radius * f64::cos(angle)))
        };
        let points: String = (0..count).map(point).collect();
        write(place, &format!("frame{k}.csv"), &format!("x [mm],y [mm]\n{points}"));
        scene += &format!("\n[[stations]]\nx = {x:?}\noutline = \"frame{k}.csv\"\n");
    }
    write(place, "own.toml", &scene);
}

const OWN: &str = r#"name = "own"
[landing]
angle_of_attack_deg = 10.0
flight_path_deg = -2.0
end = 0.8
[aeroplane]
mass = 9e3
radius_of_gyration = 3.6
center_of_mass = [8.5, -0.2]
[wing]
area = 40.0
chord = 2.2
lift_slope = 4.6
zero_lift_deg = -9.0
[[struts]]
name = "gear"
number = 2
foot = [9.5, -2.4]
mass = 150.0
stroke = 0.3
preload = 1e4
gas_length = 0.35
face = [0.4, 0.9]
[[windows]]
name = "hatch"
from = 1.0
to = 4.0
girth = [0.2, 0.8]
[[openings]]
name = "exit"
sill = [14.0, 0.3]
area = 0.0
[[openings]]
name = "valve"
sill = [12.0, -1.0]
area = 0.05
"#;

/// Stations from files; loads along the girth, windows, flotation in summary, page and map; the resolved landing needs no files and gives the same bits.
#[test]
fn a_landing_of_outlines_shows_pressures_and_flotation() {
    let place = Workplace::new();
    own_landing(&place);
    let ended = place.run(&["ditch", "own.toml", "--out", "out"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    assert!(
        ended.stdout.contains("window hatch: largest mean pressure") && ended.stdout.contains("valve"),
        "{}",
        ended.stdout
    );
    let summary = place.summary("out");
    let window = &summary["windows"][0];
    assert!(window["mean_pressure_pa"]["value"].as_f64().expect("a number") > 1e3, "{window}");
    let afloat = &summary["flotation"];
    assert!(afloat["floats"] == true && afloat["reserve"].as_f64().expect("a number") > 5.0, "{afloat}");
    assert!(
        afloat["openings"][1]["reached_s"] == 0.0 && afloat["inside_m3"].as_f64().expect("a number") > 1.0,
        "{afloat}"
    );
    let map = place.text("out/pressure_map.csv");
    assert!(map.starts_with("x_from_m,x_to_m,breadth_m,girth_from,") && map.lines().count() == 321, "{map}");
    let page = place.text("out/report.html");
    for part in
        ["Windows: largest mean pressure", "smaller cells and the times", "Flotation: openings", "skipping of tyres"]
    {
        assert!(page.contains(part), "{part}");
    }
    let again = place.run(&["ditch", "out/scene.resolved.toml", "--out", "again", "--quiet"]);
    assert_eq!(again.code, Some(0), "{}", again.message);
    assert_eq!(place.text("again/series.csv"), place.text("out/series.csv"));
    assert_eq!(place.text("again/pressure_map.csv"), map);
    let sections = place.run(&[
        "ditch",
        "own.toml",
        "--out",
        "cut",
        "--export-sections",
        "sections",
        "--sections",
        "1",
        "--quiet",
    ]);
    assert_eq!(sections.code, Some(0), "{}", sections.message);
    let file = std::fs::read_dir(place.path("sections")).expect("a folder").flatten().next().expect("a scene");
    let checked = place.run(&["check", file.path().to_str().expect("a path")]);
    assert_eq!(checked.code, Some(0), "{}", checked.message);
}

/// A sea of a spectrum: the same seed gives the same bits on any number of threads, another seed another landing.
#[test]
fn an_irregular_sea_is_known_by_its_seed() {
    let place = Workplace::new();
    let landed = |seed: &str, threads: &str, out: &str| {
        let sea =
            format!("sea={{spectrum=\"jonswap\",significant_height=1.0,peak_period=7.0,heading_deg=180,seed={seed}}}");
        let ended = place.run(&[
            "ditch",
            "mercure",
            "--set",
            "landing.end=0.5",
            "--set",
            &sea,
            "--threads",
            threads,
            "--out",
            out,
        ]);
        assert_eq!(ended.code, Some(0), "{}", ended.message);
        assert!(ended.stdout.contains("one sample of many"), "{}", ended.stdout);
        place.text(&format!("{out}/series.csv"))
    };
    let first = landed("3", "1", "a");
    assert_eq!(landed("3", "2", "b"), first);
    assert_ne!(landed("4", "1", "c"), first);
    assert!(place.summary("a")["sea"]["closing_speed_m_per_s"].as_f64().expect("a number") > 0.0);
}

/// Wrong values of stations with outlines, windows, struts, exits and seas: line, key, value, what was expected.
#[test]
fn keys_of_outlines_struts_windows_and_seas_are_refused() {
    let place = Workplace::new();
    own_landing(&place);
    write(&place, "flat.csv", "x,y\n-1,0\n1,0\n1,2\n-1,2\n");
    write(&place, "lopsided.csv", "x,y\n-1,0.9\n0.1,0\n1,0.4\n1,2\n-1,2\n");
    write(&place, "bad.csv", "x,y\n0,0\none,2\n");
    for (set, says) in [
        ("stations[1].outline=\"none.csv\"", ["stations[1].outline", "that can be read"]),
        ("stations[1].outline=\"bad.csv\"", ["stations[1].outline", "bad.csv:3"]),
        ("stations[1].outline=\"lopsided.csv\"", ["stations[1].outline", "symmetric"]),
        ("stations[1].outline=\"flat.csv\"", ["stations[1]", "a flat keel"]),
        ("stations[1].outline_unit=\"yd\"", ["stations[1].outline_unit", "a unit of length"]),
        ("stations[1].breadth=4.0", ["stations[1].breadth", "the breadth of the outline"]),
        ("stations[1].radius=2.0", ["stations[1].radius", "none beside an outline"]),
        ("windows[0].to=0.5", ["windows[0].to", "more than windows[0].from"]),
        ("windows[0].girth=[0.5,1.5]", ["windows[0].girth", "shares from 0 to 1"]),
        ("windows[0].height=[0.0,1.0]", ["windows[0].girth", "not both"]),
        ("model=\"von_karman\"", ["model", "beside windows"]),
        ("struts[0].gas_length=0.2", ["struts[0].gas_length", "more than struts[0].stroke"]),
        ("struts[0].stiffness=1e5", ["struts[0].gas_length", "not both"]),
        ("struts[0].preload=0.0", ["struts[0].preload", "the load of the gas"]),
        ("struts[0].mass=0.01", ["landing.step", "the foot of"]),
        ("struts[0].foot=[99.0,-2.0]", ["struts[0].foot", "a place on the fuselage"]),
        ("openings[0].sill=[99.0,0.0]", ["openings[0].sill", "a place on the fuselage"]),
        ("openings[0].discharge=2.0", ["openings[0].discharge", "from 0.1 to 1"]),
        (
            "sea={spectrum=\"jonswap\",significant_height=9.0,peak_period=7.0,heading_deg=0}",
            ["sea.significant_height", "steeper seas break"],
        ),
        ("sea={spectrum=\"jonswap\",heading_deg=0}", ["sea.significant_height", "missing"]),
        (
            "sea={height=1.0,length=80.0,heading_deg=0,touchdown=\"crest\",seed=2}",
            ["sea.seed", "none without sea.spectrum"],
        ),
        ("sea={heading_deg=0}", ["sea.height", "missing"]),
    ] {
        let ended = place.run(&["ditch", "own.toml", "--set", set, "--out", "none"]);
        assert_eq!(ended.code, Some(2), "{set}: {}", ended.message);
        ended.says(&says);
        assert!(!place.path("none").exists());
    }
}

/// Wrong input ends with 2 and leaves nothing; a landing that leaves the method's range ends with 1 and keeps what it had.
#[test]
fn a_landing_refuses_what_it_cannot_use() {
    let place = Workplace::new();
    let refused = |arguments: &[&str], says: &[&str]| {
        let ended = place.run(&[&["ditch"], arguments, &["--out", "none"]].concat());
        assert_eq!(ended.code, Some(2), "{}", ended.message);
        ended.says(says);
        assert!(!place.path("none").exists());
    };
    refused(&["mercury"], &["neither a built-in landing nor a file", "mercure"]);
    refused(&["mercure", "--set", "landing.end=-1"], &["landing.end", "above 0"]);
    refused(&["mercure", "--set", "landing.speeed=70"], &["unknown key", "landing.speed"]);
    let similarity = ["mercure", "--set", "model=similarity"];
    refused(&similarity, &["`model` = `similarity`", "`mlm`"]);
    let flies = place.run(&["ditch", "mercure", "--set", "landing.speed=90", "--out", "off"]);
    assert_eq!(flies.code, Some(0), "{}", flies.message);
    assert!(flies.stdout.contains("has left the water: at t = 0.9"), "{}", flies.stdout);
    assert_eq!(place.summary("off")["status"], "completed_with_doubts");
    let unstable = ["--set", "wing.pitch_stiffness=100", "--out", "up"];
    let ended = place.run(&[&["ditch", "mercure"], &unstable[..]].concat());
    assert_eq!(ended.code, Some(1), "{}", ended.message);
    ended.says(&["the nose goes under", "at t ="]);
    assert_eq!(place.summary("up")["status"], "failed");
    assert!(place.text("up/report.html").contains("the nose goes under"));
}
