//! `results`, `doubts` and `status` of `summary.json`: names and types that scripts outside depend on.

use serde_json::Value;

use crate::command::Workplace;

/// A section with a gauge that meets the water early.
const SECTION: [&str; 7] =
    ["run", "fuselage_section", "--quiet", "--set", "resolution.spacing=0.02", "--set", "time.end=0.02"];

/// Each result has these members.
fn is_result(result: &Value) {
    for key in ["value", "raw"] {
        assert!(result[key].is_f64(), "{key} of {result}");
    }
    for key in ["time_s", "band", "cutoff_hz"] {
        assert!(result[key].is_f64() || result[key].is_null() && result.get(key).is_some(), "{key} of {result}");
    }
    let verdict = result["verdict"].as_str().expect("a word");
    assert!(["resolved", "no_band", "acoustic", "not_resolved", "beyond_allowable"].contains(&verdict), "{verdict}");
    assert!(verdict != "resolved" || result["band"].is_f64(), "resolved without a band: {result}");
}

#[test]
fn every_result_has_value_time_band_cutoff_raw_and_verdict() {
    let place = Workplace::new();
    place.run(&[&SECTION[..], &["--set", "time.start=0", "--out", "out"]].concat());
    let summary = place.summary("out");
    for name in ["peak_force_N_per_m", "peak_acceleration_g", "peak_pressure_Pa", "impulse_N_s_per_m"] {
        is_result(&summary["results"][name]);
    }
    let peak = &summary["results"]["peak_force_N_per_m"];
    assert_eq!(peak["verdict"], "acoustic", "a round bottom that starts on the water");
    assert_eq!(summary["status"], "completed_with_doubts");
    let doubts = summary["doubts"].as_array().expect("sentences");
    assert!(doubts.iter().any(|doubt| doubt.as_str().is_some_and(|text| text.contains("time.start"))), "{doubts:?}");
    assert!(place.text("out/report.html").contains("Completed with doubts"));
}

/// A flexible section whose stress passes its allowable one says so in status, panel and page.
#[test]
fn a_stress_beyond_the_allowable_one_is_the_status() {
    let place = Workplace::new();
    let sets =
        ["--set", "body.panels[0].allowable_stress=1e5", "--set", "time.end=0.004", "--set", "resolution.spacing=0.02"];
    let ended = place.run(&[&["run", "flexible_wedge", "--quiet"][..], &sets, &["--out", "out"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let summary = place.summary("out");
    assert_eq!(summary["status"], "beyond_allowable");
    let panels = summary["results"]["panels"].as_object().expect("panels");
    assert!(panels.values().any(|panel| panel["reserve_factor"]["verdict"] == "beyond_allowable"), "{panels:?}");
    panels.values().for_each(|panel| is_result(&panel["peak_stress_Pa"]));
}

/// A theory has results too, with the band that was measured for it.
#[test]
fn a_theory_has_results() {
    let place = Workplace::new();
    place.run(&["run", "wedge", "--quiet", "--set", "model=mlm", "--out", "out"]);
    let summary = place.summary("out");
    let peak = &summary["results"]["peak_force_N_per_m"];
    is_result(peak);
    assert_eq!((peak["value"].as_f64(), &summary["status"]), (peak["raw"].as_f64(), &"completed".into()));
    assert!(peak["band"].as_f64().is_some_and(|band| band > 0.0));
    let far = ["--set", "body.deadrise_deg=40", "--set", "compare=[]", "--out", "far"];
    place.run(&[&["run", "wedge", "--quiet", "--set", "model=mlm"][..], &far].concat());
    let results = &place.summary("far")["results"];
    for name in ["peak_force_N_per_m", "peak_acceleration_g", "impulse_N_s_per_m"] {
        assert!(
            results[name]["band"].is_null() && results[name]["verdict"] == "no_band",
            "measured nowhere near: {results}"
        );
    }
}
