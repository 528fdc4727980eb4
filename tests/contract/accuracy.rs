//! `splashdown run --to`: the cheapest model and spacing at which each quoted result is within a share of its value.

use serde_json::Value;

use crate::command::{Ended, Workplace};

fn outcome(place: &Workplace, folder: &str) -> Value {
    serde_json::from_str(&place.text(&format!("{folder}/accuracy.json"))).expect("JSON")
}

/// A scene that names no model is answered by the cheapest theory whose bands are narrow enough.
#[test]
fn a_theory_that_is_near_enough_is_taken_before_particles() {
    let place = Workplace::new();
    let ended = place.run(&["run", "wedge", "--to", "5%", "--out", "a"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let done = outcome(&place, "a");
    assert_eq!((done["model"].as_str(), done["within"].as_bool()), (Some("boundary_element"), Some(true)));
    let results = done["results"].as_array().expect("a list");
    assert!(results.len() >= 3 && results.iter().all(|r| r["share"].as_f64().is_some_and(|share| share <= 0.05)));
    let text = place.text("a/boundary_element/summary.json");
    let summary: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(summary["results"]["peak_force_N_per_m"]["value"], results[0]["value"]);
}

/// Particles are run at three spacings, the finest of which has the study's error bars; a second call runs nothing again.
#[test]
fn particles_are_refined_and_their_runs_are_kept() {
    let place = Workplace::new();
    let asked = [
        "run",
        "wedge_constant",
        "--set",
        "model=wcsph",
        "--set",
        "resolution.spacing=0.05",
        "--quantity",
        "impulse_N_s_per_m",
    ];
    let run = |share: &str| place.run(&[&asked[..], &["--to", share, "--out", "b"]].concat());
    let ended = run("30%");
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let done = outcome(&place, "b");
    assert_eq!((done["model"].as_str(), done["spacing_m"].as_f64()), (Some("wcsph"), Some(0.05)));
    let stated = [&done["estimated_core_seconds"], &done["core_seconds"]].map(|v| v.as_f64().expect("a number"));
    assert!(stated.iter().all(|s| *s > 0.0), "{stated:?}");
    let folder = "b/spacing_0.050000/summary.json";
    let summary: Value = serde_json::from_str(&place.text(folder)).expect("JSON");
    let again = run("30%");
    assert_eq!(again.code, Some(0), "{}", again.message);
    let kept: Value = serde_json::from_str(&place.text(folder)).expect("JSON");
    assert_eq!(kept["wall_time_s"], summary["wall_time_s"], "it was run again");
    let (done, nothing) = (outcome(&place, "b"), Some(0.0));
    let costs = ["estimated_core_seconds", "core_seconds"].map(|key| done[key].as_f64());
    assert_eq!(costs, [nothing; 2], "runs that were found cost nothing");
}

#[test]
fn what_cannot_be_reached_is_refused_before_a_run() {
    let place = Workplace::new();
    for (more, expected) in [
        (&["--to", "0"][..], "expected a number of percent from 0.1 to 50"),
        (&["--to", "5%", "--converge"], "cannot be used with"),
        (&["--to", "5%", "--quantity", "foo"], "peak_force_N_per_m"),
        (&["--to", "5%", "--set", "model=wagner"], "expected a model with results within 5 %"),
    ] {
        let ended = place.run(&[&["run", "wedge"], more].concat());
        assert_eq!(ended.code, Some(2), "{more:?} {}", ended.message);
        assert!(ended.message.contains(expected), "{more:?} {}", ended.message);
    }
}

/// Ctrl-C keeps a checkpoint of the present run; the same command continues it, to the same numbers.
#[cfg(unix)]
#[test]
fn an_interrupted_refinement_continues() {
    let place = Workplace::new();
    let asked = |out: &'static str| {
        let scene = ["run", "wedge_constant", "--set", "model=wcsph", "--set", "resolution.spacing=0.02"];
        [&scene[..], &["--set", "time.end=0.7", "--quantity", "impulse_N_s_per_m", "--to", "40%", "--out", out]]
            .concat()
    };
    let child = place.start_until(&asked("c"), "c/spacing_0.020000/series.csv", 10_000);
    let id = child.id().to_string();
    assert!(std::process::Command::new("kill").args(["-INT", &id]).status().expect("the kill command").success());
    let ended = Ended::from(child.wait_with_output().expect("a child to wait for"));
    assert_eq!(ended.code, Some(1), "{}", ended.message);
    ended.says(&["interrupted at t = ", "the same command continues"]);
    for out in ["c", "d"] {
        let ended = place.run(&asked(out));
        assert_eq!(ended.code, Some(0), "{}", ended.message);
    }
    assert_eq!(outcome(&place, "c")["results"], outcome(&place, "d")["results"]);
}
