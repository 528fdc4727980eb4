//! `splashdown ditch`: files, keys, exit codes, and what it refuses.

use serde_json::Value;

use crate::command::Workplace;

const SHORT: [&str; 6] = ["ditch", "mercure", "--set", "landing.end=0.5", "--out", "out"];

/// Four files; the summary on stdout; the resolved landing lands to the same bits; a second one does not replace the first.
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
        let draught = -number("velocity") * number("end");
        assert!(draught / number("spacing") > 19.0, "{draught} m in spacings of {} m", number("spacing"));
        let checked = place.run(&["check", file.path().to_str().expect("a path")]);
        assert_eq!(checked.code, Some(0), "{}", checked.message);
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
    refused(&["mercury"], &["neither a built-in scene nor a file", "mercure"]);
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
