//! The report page: made from the folder alone, of one run or of several, whole or cut.

use serde_json::Value;

use crate::command::Workplace;

const SHORT: [&str; 4] = ["--set", "resolution.spacing=0.02", "--set", "time.end=0.006"];

fn run(place: &Workplace, scene: &str, sets: &[&str], out: &str) {
    let ended = place.run(&[&["run", scene][..], &SHORT, sets, &["--out", out, "--quiet"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
}

/// The page of a run is made again from its files, byte for byte, with every figure in it as a file where that is asked for.
#[test]
fn a_page_is_made_again_from_its_folder() {
    let place = Workplace::new();
    run(&place, "wedge", &["--set", "report.acceleration_cfc=600"], "out");
    let first = place.read("out/report.html");
    std::fs::remove_file(place.path("out/report.html")).expect("a page to remove");
    let ended = place.run(&["report", "out", "--figures"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    assert!(place.read("out/report.html") == first, "the page differs");
    for figure in ["vertical_force_on_the_wedge.svg", "flow_at_the_peak.png"] {
        assert!(!place.read(&format!("out/figures/{figure}")).is_empty() && ended.stdout.contains(figure), "{figure}");
    }
    let page = String::from_utf8(first).expect("text");
    for text in ["Vertical force on the wedge", "[kN/m]", "time [ms]", "filtered, CFC 600", "id=\"flow-data\""] {
        assert!(page.contains(text), "{text} is missing");
    }
    let filtered = &place.summary("out")["acceleration_filtered"];
    assert!(filtered["cfc"] == 600.0 && filtered["peak_g"].as_f64().is_some_and(|g| g > 0.0), "{filtered}");
}

/// A run that was killed has no summary, and its log ends anywhere: the page shows what there is, and says what is missing.
#[test]
fn what_is_left_of_a_killed_run_has_a_page() {
    let place = Workplace::new();
    run(&place, "wedge", &[], "out");
    std::fs::remove_file(place.path("out/summary.json")).expect("a summary to remove");
    let log = place.read("out/log.mcap");
    for (length, animated) in [(log.len() * 2 / 3, true), (100, false), (0, false)] {
        std::fs::write(place.path("out/log.mcap"), &log[..length]).expect("a shorter log");
        let ended = place.run(&["report", "out"]);
        assert_eq!(ended.code, Some(0), "{}", ended.message);
        let page = place.text("out/report.html");
        assert!(page.contains("Not finished") && page.contains("there is no summary.json"), "{length} bytes");
        assert_eq!(page.contains("id=\"flow-data\""), animated, "{length} bytes");
    }
}

/// Several runs stand on one page: results side by side, the keys that differ.
#[test]
fn runs_are_compared_on_one_page() {
    let place = Workplace::new();
    run(&place, "wedge", &[], "usual");
    run(&place, "wedge", &["--set", "body.deadrise_deg=25"], "flatter");
    let ended = place.run(&["report", "usual", "flatter", "--out", "both.html"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let page = place.text("both.html");
    for text in ["Comparison of 2 runs", "/ usual", "body.deadrise_deg", "Vertical force on the wedge"] {
        assert!(page.contains(text), "{text} is missing");
    }
    assert!(!page.contains("time.end</td>"), "a key that is the same");
}

/// A folder without a run, or with a summary that is not one, is named.
#[test]
fn folders_without_a_run_are_refused() {
    let place = Workplace::new();
    let ended = place.run(&["report", "nowhere"]);
    assert_eq!(ended.code, Some(2), "{}", ended.message);
    ended.says(&["nowhere", "scene.resolved.toml"]);
    run(&place, "wedge", &[], "out");
    std::fs::write(place.path("out/summary.json"), "{").expect("a broken summary");
    let ended = place.run(&["report", "out"]);
    assert_eq!(ended.code, Some(2), "{}", ended.message);
    ended.says(&["summary.json", "expected"]);
}

/// The extremes along a panel hold those over all of it; a stress beyond the allowable one is the headline.
#[test]
fn panels_have_envelopes_and_an_overstress_is_the_headline() {
    let place = Workplace::new();
    run(&place, "flexible_wedge", &["--set", "body.panels[0].allowable_stress=1e5"], "out");
    let panel = &place.summary("out")["panels"]["plate"];
    let envelope = &panel["envelope"];
    let stations = envelope["station_m"].as_array().expect("stations");
    assert!((stations[stations.len() - 1].as_f64().expect("a number") - 0.319_25).abs() < 1e-3, "{stations:?}");
    for name in ["normal_n_per_m", "shear_n_per_m", "moment_n", "stress_pa"] {
        let each = envelope[name].as_array().expect("extremes");
        assert_eq!(each.len(), stations.len(), "{name}");
        let most = each.iter().filter_map(|e| e["most"].as_f64()).fold(f64::MIN, f64::max);
        assert_eq!(Some(most), panel[name]["most"].as_f64(), "{name}");
    }
    let least = envelope["reserve_factor"].as_array().expect("factors").iter().filter_map(Value::as_f64);
    assert_eq!(Some(least.fold(f64::MAX, f64::min)), panel["reserve_factor"].as_f64());
    let page = place.text("out/report.html");
    assert!(page.contains("class=\"status failed\"><strong>Stress beyond the allowable: plate reaches"));
    assert!(page.contains("Bending moment along plate"));
}
