//! `splashdown certify`: the list of cases, resuming to the same bytes, the dossier, and what it refuses.

use serde_json::Value;

use crate::command::Workplace;

/// A small aeroplane whose landings take a fraction of a second.
const SMALL: &str = r#"name = "small"
[landing]
angle_of_attack_deg = 10.0
flight_path_deg = -2.0
end = 0.4
strips = 60
[aeroplane]
mass = 9e3
radius_of_gyration = 3.6
center_of_mass = [8.5, -0.2]
[wing]
area = 40.0
chord = 2.2
lift_slope = 4.6
zero_lift_deg = -9.0
[[windows]]
name = "hatch"
from = 8.0
to = 12.0
girth = [0.2, 0.8]
[[nacelles]]
name = "engines"
number = 2
face = [10.0, -1.5]
diameter = 0.8
length = 2.0
[[openings]]
name = "exit"
sill = [14.0, 0.3]
area = 0.0
[[stations]]
x = 0.0
keel = -0.5
breadth = 0.6
radius = 0.5
[[stations]]
x = 3.0
keel = -1.4
breadth = 1.8
radius = 1.4
[[stations]]
x = 12.0
keel = -1.5
breadth = 1.9
radius = 1.5
[[stations]]
x = 18.0
keel = 0.0
breadth = 1.0
radius = 0.8
[certify]
pitches_deg = [7.0, 9.0]
sink_speeds = [0.8, 2.0]
headings_deg = [180.0]
phases_deg = [0.0, 90.0]
[[certify.seas]]
height = 1.0
length = 60.0
[[certify.failures]]
name = "damaged"
lost = ["engines", "exit"]
open_area = 0.2
"#;

/// Files that must not depend on a break.
const FILES: [&str; 5] = ["cases.jsonl", "cases.csv", "certify.json", "certify.html", "pressure_envelope.csv"];

fn small(place: &Workplace) {
    std::fs::write(place.path("small.toml"), SMALL).expect("a file");
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

/// The built-in example: every combination, and what it would cost; a part of it is spread over the list.
#[test]
fn the_list_is_every_combination() {
    let place = Workplace::new();
    let ended = place.run(&["certify", "made_twin", "--list"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    assert_eq!(ended.stdout.lines().count(), 2026);
    assert!(ended.stdout.contains("2025 cases of 2025 combinations; at most"), "{}", ended.stdout.len());
    let part = place.run(&["certify", "made_twin", "--set", "certify.cases=90", "--list", "--json"]);
    let part = json(&part.stdout);
    let cases = part["cases"].as_array().expect("cases");
    assert_eq!((cases.len(), &part["combinations"]), (90, &2025.into()));
    for key in ["loading", "pitch_deg", "sink_m_per_s", "wave_height_m", "state"] {
        let mut values: Vec<String> = cases.iter().map(|case| case[key].to_string()).collect();
        values.sort();
        values.dedup();
        assert_eq!(values.len(), 3, "{key}: {values:?}");
    }
    assert!(part["core_seconds_at_most"].as_f64().expect("a number") > 90.0);
    let command = place.run(&["certify", "made_twin", "--case", "812"]);
    assert!(command.stdout.starts_with("splashdown ditch made_twin --set"), "{}", command.stdout);
    let none = place.run(&["certify", "made_twin", "--case", "2026"]);
    assert_eq!(none.code, Some(2));
    none.says(&["--case 2026", "a number of the list"]);
}

/// A run that is killed and continued, by another number of threads, leaves the bytes of one without a break; the files of other cases are not replaced.
#[test]
fn a_killed_list_goes_on_to_the_same_bytes() {
    let place = Workplace::new();
    small(&place);
    let ended = place.run(&["certify", "small.toml", "--out", "whole", "--json"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let found = json(&ended.stdout);
    // 2 pitches, 2 speeds, calm water and 2 phases, 2 states
    assert_eq!(found["cases"], 24);

    let arguments = ["certify", "small.toml", "--out", "cut", "--threads", "1"];
    let mut child = place.start_until(&arguments, "cut/cases.jsonl", 20_000);
    child.kill().expect("a child");
    child.wait().expect("an end");
    let lines = place.text("cut/cases.jsonl").lines().count();
    assert!((3..25).contains(&lines), "{lines}");
    let cut: String = place.text("cut/cases.jsonl") + "{\"case\":9,\"ended\":\"comp";
    std::fs::write(place.path("cut/cases.jsonl"), cut).expect("a file");
    let again = place.run(&["certify", "small.toml", "--out", "cut", "--threads", "2"]);
    assert_eq!(again.code, Some(0), "{}", again.message);
    again.says(&["of 24 cases are known"]);
    for file in FILES {
        assert_eq!(place.read(&format!("cut/{file}")), place.read(&format!("whole/{file}")), "{file}");
    }
    let other = place.run(&["certify", "small.toml", "--set", "aeroplane.mass=9.1e3", "--out", "cut"]);
    assert_eq!(other.code, Some(2));
    other.says(&["holds the cases of another", "--force"]);
    let known = place.run(&["certify", "small.toml", "--out", "cut"]);
    known.says(&["24 of 24 cases are known"]);
}

/// Envelopes are the worst of the table of cases, a case is a landing that `ditch` repeats, and none is lost.
#[test]
fn the_worst_case_is_that_of_the_table_and_of_its_command() {
    let place = Workplace::new();
    small(&place);
    let ended = place.run(&["certify", "small.toml", "--out", "out", "--json"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let found = json(&ended.stdout);
    let table = place.text("out/cases.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 25);
    let column = rows[0].iter().position(|name| *name == "upward_acceleration_g").expect("a column");
    let from_end = rows[0].len() - column;
    let number = |row: &Vec<&str>| row[row.len() - from_end].parse::<f64>().ok();
    let largest = rows[1..].iter().filter_map(number).fold(0.0, f64::max);
    let worst = &found["envelope"]["numbers"]["upward_acceleration"];
    assert_eq!(worst["value"].as_f64(), Some(largest));
    let counts = &found["counts"];
    let count = |name: &str| counts[name].as_u64().expect("a count");
    assert_eq!(count("completed") + count("doubtful") + count("failed") + count("outside"), 24);
    // at phase 90, against the waves, the surface falls faster than the aeroplane at 0.8 m/s
    assert!(count("outside") >= 4 && found["reasons"].to_string().contains("sea.touchdown"), "{}", found["reasons"]);

    let list = json(&place.run(&["certify", "small.toml", "--list", "--json"]).stdout);
    let case = worst["case"].as_u64().expect("a case") as usize;
    let sets = list["cases"][case - 1]["sets"].as_array().expect("overrides").clone();
    let sets = sets.iter().flat_map(|set| ["--set", set.as_str().expect("a text")]);
    let arguments: Vec<&str> = ["ditch", "small.toml", "--out", "one", "--quiet"].into_iter().chain(sets).collect();
    let repeated = place.run(&arguments);
    assert!(repeated.code == Some(0), "{}", repeated.message);
    let again = place.summary("one")["az_g"]["value"].as_f64().expect("a number");
    assert!((again / largest - 1.0).abs() < 1e-5, "{again} {largest}");

    // a part that is gone carries nothing, an exit that is open lets water in
    let lines: Vec<Value> = place.text("out/cases.jsonl").lines().skip(1).map(json).collect();
    let whole = lines.iter().find(|line| line["case"] == 1).expect("a case");
    let damaged = lines.iter().find(|line| line["case"] == 2).expect("a case");
    let of = |line: &Value, name: &str| line["numbers"][name][0].as_f64().expect("a number");
    assert!(of(damaged, "part.engines.force") < 0.01 * of(whole, "part.engines.force"), "{damaged}");
    assert!(of(whole, "flotation.exit.over_water") > 0.0);
}

/// Each paragraph of each rule is in the dossier, answered in part or named; a rotorcraft's speeds below the model's range are rows with that reason.
#[test]
fn every_paragraph_is_answered_or_named() {
    let place = Workplace::new();
    small(&place);
    for (rule, paragraphs) in [
        ("25.801", &["25.801(a)", "25.801(b)", "25.801(c)", "25.801(d)", "25.801(e)", "25.563"][..]),
        (
            "29.563",
            &[
                "29.563(a)",
                "29.563(b)(1)",
                "29.563(b)(2)",
                "29.801(a)",
                "29.801(b)",
                "29.801(c)",
                "29.801(d)",
                "29.801(e)",
            ],
        ),
        ("29.519", &["29.519(a)", "29.519(b)", "29.519(c)", "29.519(d)"]),
    ] {
        let (set, out) = (format!("certify.rule=\"{rule}\""), format!("out{rule}"));
        let given = ["certify", "small.toml", "--set", "landing.end=0.1", "--set", &set, "--out", &out, "--json"];
        let ended = place.run(&given);
        assert_eq!(ended.code, Some(0), "{rule}: {}", ended.message);
        let found = json(&ended.stdout);
        let answers = found["paragraphs"].as_array().expect("answers");
        let named: Vec<&str> = answers.iter().filter_map(|answer| answer["paragraph"].as_str()).collect();
        assert_eq!(named, paragraphs);
        let page = place.text(&format!("{out}/certify.html"));
        for paragraph in paragraphs {
            assert!(page.contains(&format!("<td>{paragraph}</td>")), "{paragraph}");
        }
        for part in ["Statement of use", "@media print", "SHA-256", "σ model", "no load has a known band", "--set"] {
            assert!(page.contains(part), "{part}");
        }
        assert!(!page.contains("src=\"http") && !page.contains("href=\"http"), "no network");
        for answer in answers {
            let not_given = answer["not_given"].as_str().expect("a text");
            assert!(!not_given.is_empty() && (answer["answer"] == "not answered" || answer["gives"] != ""), "{answer}");
        }
        if rule != "25.801" {
            let reasons = found["reasons"].to_string();
            assert!(reasons.contains("outside the model's range: a forward speed of"), "{reasons}");
            assert!(page.contains("0 to 30 kn"), "the rule's own speeds");
        }
    }
    // without flotation and windows, (d) and (e) are named
    let bare = place.run(&[
        "certify",
        "mercure",
        "--set",
        "landing.end=0.05",
        "--set",
        "certify={cases=3}",
        "--out",
        "bare",
        "--json",
    ]);
    let found = json(&bare.stdout);
    let answer = |k: usize| found["paragraphs"][k]["answer"].clone();
    assert_eq!((answer(3), answer(4)), ("not answered".into(), "not answered".into()));
}

/// The dossier's errors of landings are those of the page that `validate` writes.
#[test]
fn evidence_is_that_of_the_validation() {
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src/validation/quantities.md");
    let page = std::fs::read_to_string(page).expect("the page");
    for of in scenarios::certify::evidence() {
        let start = format!("| {} | {} | {} | {} | {} |", of.quantity, of.points, of.cases, of.bias, of.scatter);
        let row = page.lines().find(|line| line.starts_with(&start));
        assert!(row.is_some_and(|row| row.contains(&of.worst) && row.contains(&of.factor)), "{start}");
    }
}

/// A dive is a row with its reason and its numbers so far, which stand apart; where no case completes the command ends with 1 and has its files.
#[test]
fn failed_cases_are_rows() {
    let place = Workplace::new();
    small(&place);
    let keys = "certify={pitches_deg=[1.0],sink_speeds=[2.0],seas=[{height=4,length=60}],headings_deg=[180]}";
    let given = ["--set", keys, "--set", "landing.end=2.0", "--json"];
    let ended = place.run(&[&["certify", "small.toml", "--out", "dive"], &given[..]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let found = json(&ended.stdout);
    assert_eq!((&found["cases"], &found["counts"]["failed"]), (&5.into(), &1.into()), "{}", found["reasons"]);
    let records: Vec<Value> = place.text("dive/cases.jsonl").lines().skip(1).map(json).collect();
    let dive = records.iter().find(|record| record["ended"] == "failed").expect("a dive");
    assert!(dive["message"].as_str().is_some_and(|why| why.contains("the nose goes under")), "{}", dive["message"]);
    assert!(dive["numbers"]["water_force"][0].as_f64().is_some_and(|force| force > 0.0));
    for (_, worst) in found["envelope"]["numbers"].as_object().expect("an envelope") {
        assert_ne!(worst["case"], dive["case"], "a dive is in the envelope of completed cases");
    }
    assert!(place.text("dive/certify.html").contains("the nose goes under"));
    let calm = place.run(&["certify", "small.toml", "--set", "certify.seas=[]", "--list", "--json"]);
    assert_eq!(json(&calm.stdout)["combinations"], 8, "calm water alone");

    let slow = ["certify", "mercure", "--set", "certify.rule=29.563", "--out", "slow"];
    let ended = place.run(&slow);
    assert_eq!(ended.code, Some(1), "{}", ended.message);
    ended.says(&["no case completed"]);
    assert!(place.text("slow/certify.html").contains("outside the model"), "files are there");
}

/// Wrong keys: file, line, key, what was expected; nothing is written.
#[test]
fn keys_of_the_list_are_refused() {
    let place = Workplace::new();
    for (from, to, says) in [
        ("sink_speeds = [0.8, 2.0]", "sink_speeds = [0.8, -2.0]", &["certify.sink_speeds[1]", "from 0.01 to 50"][..]),
        ("sink_speeds = [0.8, 2.0]", "sink_speeds = []", &["certify.sink_speeds", "at least one number"]),
        ("sink_speeds = [0.8, 2.0]", "sink_speed = [0.8]", &["unknown key `certify.sink_speed`", "sink_speeds"]),
        ("pitches_deg = [7.0, 9.0]", "pitches_deg = [40.0]", &["certify.pitches_deg[0]", "from 0 to 30"]),
        ("[certify]", "[certify]\nrule = \"25.802\"", &["certify.rule", "25.801"]),
        ("[certify]", "[certify]\ncases = 0", &["certify.cases", "from 1"]),
        ("lost = [\"engines\", \"exit\"]", "lost = [\"engine\"]", &["certify.failures[0].lost[0]", "engines, exit"]),
        ("open_area = 0.2", "", &["certify.failures[0].open_area", "an area through which water runs"]),
        ("length = 60.0", "", &["certify.seas[0].length", "missing", "beside height"]),
        ("length = 60.0", "length = 60.0\npeak_period = 6.0", &["certify.seas[0].peak_period", "not both"]),
        ("name = \"damaged\"", "name = \"two words\"", &["certify.failures[0].name", "a word"]),
    ] {
        assert!(SMALL.contains(from), "{from}");
        std::fs::write(place.path("bad.toml"), SMALL.replace(from, to)).expect("a file");
        let ended = place.run(&["certify", "bad.toml", "--out", "none"]);
        assert_eq!(ended.code, Some(2), "{to}: {}", ended.message);
        ended.says(says);
        assert!(ended.message.contains("bad.toml:"), "{to}: {}", ended.message);
        assert!(!place.path("none").exists());
    }
    let many = "certify.phases_deg=[0";
    let many = format!("{many}{}]", ",1".repeat(20_000));
    small(&place);
    let ended = place.run(&["certify", "small.toml", "--set", &many, "--out", "none"]);
    assert_eq!(ended.code, Some(2));
    ended.says(&["combinations", "at most 100000"]);
    let missing = place.run(&["certify", "mercury"]);
    assert_eq!(missing.code, Some(2));
    missing.says(&["mercure"]);
    let scene = place.run(&["ditch", "small.toml", "--out", "landed", "--quiet"]);
    assert_eq!(scene.code, Some(0), "a landing takes no notice of the list: {}", scene.message);
}
