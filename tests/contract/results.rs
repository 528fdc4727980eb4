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
    assert!(["resolved", "no_band", "acoustic", "not_resolved"].contains(&verdict), "{verdict}");
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

/// A run that ends before the peak of a free body has no peak; a body too heavy for the water to slow has no acceleration but that of its fall.
#[test]
fn a_run_that_ends_too_early_and_a_body_that_only_falls_have_no_peaks() {
    let place = Workplace::new();
    let run = |sets: &[&str]| {
        let ended =
            place.run(&[&["run", "wedge", "--quiet", "--force", "--out", "out", "--set", "model=mlm"], sets].concat());
        assert_eq!(ended.code, Some(0), "{}", ended.message);
        let Value::Object(summary) = place.summary("out") else { panic!("no summary") };
        let verdict = |name: &str| summary["results"][name]["verdict"].as_str().expect("a word").to_string();
        ([verdict("peak_force_N_per_m"), verdict("peak_acceleration_g")], summary["doubts"].to_string())
    };
    let (verdicts, doubts) = run(&["--set", "time.end=0.008"]);
    assert_eq!(verdicts, ["not_resolved", "not_resolved"]);
    assert!(doubts.contains("a later time.end would show it"), "{doubts}");
    let (verdicts, doubts) = run(&["--set", "time.end=0.02", "--set", "body.mass=1e5"]);
    assert_eq!(verdicts, ["resolved", "not_resolved"]);
    assert!(doubts.contains("free fall"), "{doubts}");
}

/// Panels in a flow by boundary elements: a stress that is largest at the end of the run, and loads after suction, are not quoted.
#[test]
fn doubts_about_panels_in_a_flow_that_was_followed() {
    let place = Workplace::new();
    let run = |set: &str| {
        let sets = ["--set", "model=boundary_element", "--set", set];
        let ended = place.run(&[&["run", "flexible_wedge", "--quiet", "--force", "--out", "out"], &sets[..]].concat());
        assert_eq!(ended.code, Some(0), "{}", ended.message);
        let summary = place.summary("out");
        assert_eq!(summary["status"], "completed_with_doubts", "{set}");
        summary
    };
    let doubts = |summary: &Value| summary["doubts"].to_string();
    let early = run("time.end=0.004");
    assert_eq!(early["results"]["panels"]["plate"]["peak_stress_Pa"]["verdict"], "not_resolved");
    assert_eq!(early["results"]["peak_force_N_per_m"]["verdict"], "resolved");
    assert!(doubts(&early).contains("at the end of the run"), "{}", doubts(&early));
    let soft = run("body.panels.0.thickness=0.001");
    let force = &soft["results"]["peak_force_N_per_m"];
    assert_eq!(force["verdict"], "resolved", "before the suction");
    assert_eq!(soft["results"]["impulse_N_s_per_m"]["verdict"], "not_resolved");
    assert!(doubts(&soft).contains("suction takes up to"), "{}", doubts(&soft));
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
    for panel in panels.values() {
        for result in ["reserve_factor", "peak_stress_Pa"] {
            assert_eq!(panel[result]["allowed"], false, "{panel}");
            is_result(&panel[result]);
        }
        // the verdict says whether it is resolved: this force is not, at a draught of few spacings
        assert_eq!(panel["peak_stress_Pa"]["verdict"], summary["results"]["peak_force_N_per_m"]["verdict"]);
    }
    assert!(summary["results"]["peak_force_N_per_m"]["allowed"].is_null());
}

/// A run ends where the first end of a panel breaks off, and status, message, doubts and page say where, when and at which strain.
#[test]
fn a_run_ends_at_the_first_rupture_and_reports_it() {
    let place = Workplace::new();
    let sets = ["--set", "body.panels[0].rupture_strain=3e-4", "--set", "resolution.spacing=0.012"];
    let ended = place.run(&[&["run", "flexible_wedge"][..], &sets, &["--out", "out"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let summary = place.summary("out");
    let broken = &summary["panels"]["plate"]["ruptures"][0];
    assert_eq!((&summary["status"], &broken["time_s"]), (&"ruptured".into(), &summary["time_end_s"]));
    assert!(broken["strain"].as_f64().is_some_and(|strain| strain > 3e-4), "{broken}");
    let message = summary["message"].as_str().expect("a message");
    assert!(message.starts_with("plate broke off at (") && message.ends_with("the run ends there"), "{message}");
    let doubts = summary["doubts"].to_string();
    for name in ["peak_force_N_per_m", "impulse_N_s_per_m", "plate.peak_stress_Pa", "broke off"] {
        assert!(doubts.contains(name), "{name} is missing: {doubts}");
    }
    let page = place.text("out/report.html");
    assert!(page.contains("class=\"status failed\"><strong>Rupture: plate broke off at ("));
    assert!(!page.contains("stays bent"));
}

/// Water in the film between a body and the floor pulled with twice as much at two thirds of the spacing, as a peak without a doubt.
#[test]
fn forces_of_a_body_that_touches_the_floor_are_not_resolved() {
    let place = Workplace::new();
    let sets = ["--set", "resolution.spacing=0.025"];
    let ended = place.run(&[&["run", "box_on_floor"][..], &sets, &["--out", "out"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let summary = place.summary("out");
    for name in ["peak_force_N_per_m", "impulse_N_s_per_m"] {
        assert_eq!(summary["results"][name]["verdict"], "not_resolved", "{name}");
    }
    let doubts = summary["doubts"].to_string();
    assert!(doubts.contains("peak_force_N_per_m, ") && doubts.contains("`tank` and `box` touch at"), "{doubts}");
}

/// A panel that yields is judged by its strain: its stress is nowhere above the law of its material.
#[test]
fn a_panel_that_yields_has_a_strain_for_a_result() {
    let place = Workplace::new();
    let size =
        ["--set", "time.end=0.006", "--set", "resolution.spacing=0.016", "--set", "body.panels[0].yield_stress=2e7"];
    let run = |sets: &[&str], out: &str| {
        place.run(&[&["run", "flexible_wedge", "--quiet"][..], &size, sets, &["--out", out]].concat());
        place.summary(out)
    };
    let summary = run(&[], "out");
    let (panel, result) = (&summary["panels"]["plate"], &summary["results"]["panels"]["plate"]);
    let law = 2e7 * 2.0 / 3.0_f64.sqrt();
    for end in ["least", "most"] {
        assert!(panel["stress_pa"][end].as_f64().is_some_and(|stress| stress.abs() < 1.000_001 * law), "{panel}");
    }
    is_result(&result["peak_strain"]);
    assert_eq!(
        (&panel["yielded"], &panel["allowed"], &summary["status"]),
        (&true.into(), &false.into(), &"beyond_allowable".into())
    );
    assert!(result.get("reserve_factor").is_none() && panel["envelope"].get("reserve_factor").is_none(), "{result}");
    assert!(place.text("out/report.html").contains("Panel beyond the allowable: plate yields, to a strain of"));
    let held = run(&["--set", "body.panels[0].rupture_strain=0.1"], "held");
    let result = &held["results"]["panels"]["plate"];
    let [factor, strain] =
        ["reserve_factor", "peak_strain"].map(|name| result[name]["value"].as_f64().expect("a number"));
    assert!((factor * strain / 0.1 - 1.0).abs() < 1e-12 && result["peak_strain"]["allowed"] == true, "{result}");
    assert_ne!(held["status"], "beyond_allowable");
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
