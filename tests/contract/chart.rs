//! `splashdown chart`: files, stored charts, and what it refuses.

use serde_json::Value;

use crate::command::Workplace;

const CASE: &str = r#"
about = "Coarse wedges"
scene = "wedge_constant"
set = ["time.end=0.3"]

[[quantity]]
name = "force"
value = "similarity/force_coefficient"
scatter = "similarity/force_coefficient_sd"
reference = 14.0201
source = "exact"

[[quantity]]
name = "compared"
comparison = "similarity.cp_max"
against = "wedge_similarity/summary.csv"
source = "exact"

[[family]]
name = "coarse"
vary = "resolution.spacing"
values = [0.1, 0.08, 0.07]

[[family]]
name = "kernels"
set = ["resolution.spacing=0.1", "fluid.smoothing_ratio=1.75"]
vary = "fluid.kernel"
values = ["wendland_c4"]

[[family]]
name = "alone"
set = ["solver=incompressible", "resolution.spacing=0.1"]

[[family]]
name = "breaks"
set = ["resolution.spacing=0.1", "time.end=1.0", "fluid.integrator=verlet"]
vary = "fluid.verlet_correction_every"
values = [0]
"#;

/// Several numbers from the same runs; a run that fails is reported and loses nothing else; single runs and words as settings; a
/// stored chart draws itself again to the byte, and is taken up where it ended.
#[test]
fn a_chart_is_measured_once_and_drawn_again() {
    let place = Workplace::new();
    std::fs::write(place.path("four.toml"), CASE).expect("written");
    let chart = ["chart", "four.toml", "--out", "out", "--json", "--threads", "1"];
    let ended = place.run(&chart);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let stored: Value = serde_json::from_str(&place.text("out/four.json")).expect("JSON");
    assert_eq!(serde_json::from_str::<Value>(&ended.stdout).expect("JSON on stdout")[0], stored);
    let points = stored["points"].as_array().expect("a list");
    assert_eq!(points.len(), 6);
    let (done, failed): (Vec<&Value>, Vec<&Value>) = points.iter().partition(|p| p["outcome"]["done"].is_object());
    for p in &done {
        let run = &p["outcome"]["done"];
        let force = &run["readings"]["force"];
        let number = |v: &Value, key: &str| v[key].as_f64().unwrap_or_else(|| panic!("{key} in {p}"));
        let bias = number(force, "value") / 14.0201 - 1.0;
        assert!((number(force, "bias") - bias).abs() < 1e-12 && bias.abs() < 0.5, "{p}");
        assert!((number(force, "error") - bias.hypot(number(force, "scatter"))).abs() < 1e-12, "{p}");
        assert!(number(run, "core_seconds") > 0.0 && number(&run["readings"]["compared"], "error") > 0.0, "{p}");
    }
    assert_eq!(failed.len(), 1, "the leapfrog without its Euler step breaks down (THEORY LE3)");
    let why = failed[0]["outcome"]["failed"].as_str().expect("a reason");
    let page = place.text("out/four.html");
    assert!(!why.is_empty() && page.contains("breaks at 0") && page.contains("(front)"), "{why}");
    assert!(page.contains("kernels") && page.contains("wendland_c4") && page.contains("alone"));

    let from = ["chart", "--from", "out/four.json", "--out", "again", "--table", "four.md", "--fits", "fits.json"];
    let again = place.run(&[&from[..], &["--quiet"]].concat());
    assert_eq!(again.code, Some(0), "{}", again.message);
    assert_eq!(place.text("again/four_force.svg"), place.text("out/four_force.svg"));
    assert_eq!(place.text("again/four.html"), page);
    assert_eq!(place.text("four.md").matches("| alone").count(), 2, "a row for each number");
    let fits: Value = serde_json::from_str(&place.text("fits.json")).expect("JSON");
    assert_eq!(
        fits.as_array().map(Vec::len),
        Some(1),
        "one family of three spacings, one number that others have: {fits}"
    );

    // the failed run is tried again, no other
    let resumed = place.run(&[&chart[..], &["--resume"]].concat());
    assert_eq!(resumed.code, Some(0), "{}", resumed.message);
    assert!(resumed.message.contains("run 6 of 6") && !resumed.message.contains("run 1 of 6"), "{}", resumed.message);
    assert_eq!(place.text("out/four.html"), page);
    let others = place.run(&["chart", "four.toml", "--out", "out", "--threads", "2", "--resume"]);
    assert_eq!(others.code, Some(2));
    others.says(&["--resume", "1 threads", "2 threads"]);
}

#[test]
fn a_chart_refuses_what_it_cannot_use() {
    let place = Workplace::new();
    let refused = |arguments: &[&str], says: &[&str]| {
        let ended = place.run(&[&["chart"], arguments, &["--out", "out", "--quiet"]].concat());
        assert_eq!(ended.code, Some(2), "{}", ended.message);
        ended.says(says);
        assert!(!place.path("out").exists());
    };
    let wrong = |from: &str, to: &str, says: &[&str]| {
        assert!(CASE.contains(from), "{from}");
        std::fs::write(place.path("wrong.toml"), CASE.replacen(from, to, 1)).expect("written");
        refused(&["wrong.toml"], says);
    };
    wrong("about", "abuot", &["wrong.toml", "abuot", "line 2"]);
    wrong("vary = \"resolution.spacing\"", "vary = \"resolution.space\"", &["resolution.space"]);
    wrong("reference = 14.0201", "reference = 0.0", &["`reference` = 0", "`force`", "other than 0"]);
    wrong("reference = 14.0201", "against = \"a.csv\"", &["`force`", "expected `value` and `reference`"]);
    wrong("name = \"compared\"", "name = \"force\"", &["two of `quantity`", "`force`"]);
    wrong("values = [0]", "values = []", &["`values` of `breaks` is empty", "`fluid.verlet_correction_every`"]);
    wrong("vary = \"fluid.verlet_correction_every\"", "", &["`values` of `breaks` belong to no key", "`vary`"]);
    refused(&["nothing"], &["no chart `nothing`", "wedge_30"]);
    refused(&["--from", "wrong.toml"], &["wrong.toml", "expected the JSON file of a chart"]);
    refused(&["absent.toml"], &["absent.toml"]);
}
