//! `splashdown chart`: files, stored charts, and what it refuses.

use serde_json::Value;

use crate::command::Workplace;

const CASE: &str = r#"
about = "Two coarse wedges"
scene = "wedge_constant"
set = ["time.end=0.3"]
quantity = "similarity/force_coefficient"
scatter = "similarity/force_coefficient_sd"
reference = 14.0201
source = "exact"

[[family]]
name = "coarse"
vary = "resolution.spacing"
values = [0.1, 0.07]

[[family]]
name = "incompressible"
set = ["solver=incompressible"]
vary = "resolution.spacing"
values = [0.1]
"#;

/// Three files; errors are against the reference; a stored chart draws itself again to the byte.
#[test]
fn a_chart_is_measured_once_and_drawn_again() {
    let place = Workplace::new();
    std::fs::write(place.path("two.toml"), CASE).expect("written");
    let ended = place.run(&["chart", "two.toml", "--out", "out", "--json", "--quiet"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let stored: Value = serde_json::from_str(&place.text("out/two.json")).expect("JSON");
    assert_eq!(serde_json::from_str::<Value>(&ended.stdout).expect("JSON on stdout")[0], stored);
    let points = stored["points"].as_array().expect("a list");
    assert_eq!(points.len(), 3);
    for p in points {
        let number = |key: &str| p[key].as_f64().unwrap_or_else(|| panic!("{key} in {p}"));
        let bias = number("value") / 14.0201 - 1.0;
        assert!((number("bias") - bias).abs() < 1e-12 && bias.abs() < 0.5, "{p}");
        assert!((number("error") - bias.hypot(number("scatter"))).abs() < 1e-12 && number("core_seconds") > 0.0, "{p}");
    }
    assert!(place.text("out/two.html").contains("(front)"));

    let again = place.run(&["chart", "--from", "out/two.json", "--out", "again", "--table", "two.md", "--quiet"]);
    assert_eq!(again.code, Some(0), "{}", again.message);
    assert_eq!(place.text("again/two.svg"), place.text("out/two.svg"));
    assert_eq!(place.text("two.md").matches("| incompressible").count(), 1);
}

#[test]
fn a_chart_refuses_what_it_cannot_use() {
    let place = Workplace::new();
    std::fs::write(place.path("wrong.toml"), CASE.replace("about", "abuot")).expect("written");
    std::fs::write(
        place.path("key.toml"),
        CASE.replace("vary = \"resolution.spacing\"", "vary = \"resolution.space\""),
    )
    .expect("written");
    let refused = |arguments: &[&str], says: &[&str]| {
        let ended = place.run(&[&["chart"], arguments, &["--out", "out", "--quiet"]].concat());
        assert_eq!(ended.code, Some(2), "{}", ended.message);
        ended.says(says);
        assert!(!place.path("out").exists());
    };
    std::fs::write(place.path("zero.toml"), CASE.replace("reference = 14.0201", "reference = 0.0")).expect("written");
    refused(&["zero.toml"], &["`reference` = 0", "other than 0"]);
    refused(&["nothing"], &["no chart `nothing`", "wedge_30_force"]);
    refused(&["wrong.toml"], &["wrong.toml", "abuot", "line 2"]);
    refused(&["key.toml"], &["resolution.space"]);
    refused(&["--from", "wrong.toml"], &["wrong.toml", "expected the JSON file of a chart"]);
    refused(&["absent.toml"], &["absent.toml"]);
}
