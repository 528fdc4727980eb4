//! `splashdown plane`: files, numbers, bands, and what it refuses.

use serde_json::Value;

use crate::command::Workplace;

/// Three files; the summary on stdout; bands in the range of towing tanks; the resolved hull has the same load; files are not replaced.
#[test]
fn a_hull_in_a_towing_tank_writes_its_files() {
    let place = Workplace::new();
    let ended = place.run(&["plane", "planing_hull", "--out", "out", "--json"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let summary = place.summary("out");
    assert_eq!(serde_json::from_str::<Value>(&ended.stdout).expect("JSON on stdout"), summary);
    let number = |of: &Value, key: &str| of[key].as_f64().expect("a number");
    let coefficient = &summary["lift_coefficient"];
    assert!((number(coefficient, "value") / 0.0879 - 1.0).abs() < 0.11, "{coefficient}");
    assert_eq!((&coefficient["verdict"], &summary["status"]), (&"resolved".into(), &"completed".into()));
    assert!((number(coefficient, "band") / number(coefficient, "value") - 0.09).abs() < 1e-9);
    assert!((number(&summary["center_of_pressure_m"], "value") - 2.0 * 0.738).abs() < 0.11, "{summary}");
    assert_eq!(summary["drag_n"]["verdict"], "no_band");
    assert!(summary.get("no_band_because").is_none());
    let [keel, chine] = ["wetted_keel_m", "wetted_chine_m"].map(|key| number(&summary, key));
    assert!(keel > chine && (0.5 * (keel + chine) - 2.0).abs() < 1e-9);
    let slices = place.text("out/slices.csv");
    assert!(slices.starts_with("ahead_of_step_m,lift_N_per_m,") && slices.lines().count() == 61, "{slices}");

    let again = place.run(&["plane", "out/scene.resolved.toml", "--out", "again", "--quiet"]);
    assert_eq!(again.code, Some(0), "{}", again.message);
    assert_eq!(place.text("again/summary.json"), place.text("out/summary.json"));
    assert_eq!(place.text("again/slices.csv"), slices);
    let occupied = place.run(&["plane", "planing_hull", "--out", "out"]);
    assert_eq!(occupied.code, Some(2));
    occupied.says(&["already holds a run", "--force"]);

    let outside = place.run(&["plane", "planing_hull", "--set", "hull.deadrise_deg=40", "--out", "steep"]);
    assert_eq!(outside.code, Some(0), "{}", outside.message);
    for said in ["no_band", "a deadrise of 40", "10 to 30"] {
        assert!(outside.stdout.contains(said), "{said}: {}", outside.stdout);
    }
    let summary = place.summary("steep");
    assert_eq!(summary["lift_n"]["verdict"], "no_band");
    assert!(summary["lift_n"].get("band").is_none() && summary["no_band_because"].is_string());
}

#[test]
fn a_draught_gives_the_wetted_length() {
    let place = Workplace::new();
    let shown = place.run(&["show", "planing_hull"]);
    let text = shown.stdout.replace("wetted_length = 2.0", "draught = 0.25");
    std::fs::write(place.path("hull.toml"), text).expect("a file");
    let ended = place.run(&["plane", "hull.toml", "--out", "out", "--quiet"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let summary = place.summary("out");
    assert!((summary["draught_m"].as_f64().expect("a number") - 0.25).abs() < 1e-12);
    let keel = summary["wetted_keel_m"].as_f64().expect("a number");
    assert!((keel - 0.25 / 6.0_f64.to_radians().sin()).abs() < 1e-9, "{keel}");
}

/// Wrong input ends with 2, names key and range, and leaves nothing.
#[test]
fn a_planing_hull_refuses_what_it_cannot_use() {
    let place = Workplace::new();
    let refused = |arguments: &[&str], says: &[&str]| {
        let ended = place.run(&[&["plane"], arguments, &["--out", "none"]].concat());
        assert_eq!(ended.code, Some(2), "{}", ended.message);
        ended.says(says);
        assert!(!place.path("none").exists());
    };
    refused(&["planing_hul"], &["planing_hull"]);
    refused(&["planing_hull", "--set", "draught=0.2"], &["draught", "not both"]);
    refused(&["planing_hull", "--set", "trim_deg=0"], &["trim_deg", "0.5"]);
    refused(&["planing_hull", "--set", "speed=1"], &["speed", "at least 1.8793 m/s"]);
    refused(&["planing_hull", "--set", "hull.deadrise_deg=2"], &["hull.deadrise_deg", "4"]);
    refused(&["planing_hull", "--set", "hull.breadht=2"], &["unknown key", "hull.breadth"]);
    refused(&["mercure"], &["mercure"]);
    let landing = place.run(&["show", "mercure"]);
    std::fs::write(place.path("landing.toml"), landing.stdout).expect("a file");
    refused(&["landing.toml"], &["a landing", "splashdown ditch"]);
    let hull = place.run(&["show", "planing_hull"]);
    std::fs::write(place.path("hull.toml"), hull.stdout).expect("a file");
    let ended = place.run(&["ditch", "hull.toml", "--out", "none"]);
    assert_eq!(ended.code, Some(2));
    ended.says(&["a planing hull", "splashdown plane"]);
}
