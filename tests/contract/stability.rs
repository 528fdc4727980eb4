//! `splashdown stability`: files, stored maps, points by their commands, and what it refuses.

use serde_json::Value;

use crate::command::Workplace;

const MAP: &str = r#"
about = "A coarse tank over two steps and two sound speeds"
scene = "hydrostatic_tank"
set = ["resolution.spacing=0.1", "time.end=0.4", "fluid.shifting=false", "fluid.artificial_viscosity=0"]
most_steps = 200
most_energy_gain = 0.05
theory = "courant"

[[inaccurate]]
quantity = "means/floor.p_Pa"
least = 9614.0
most = 10006.0
meaning = "within 2 %"

[x]
label = "time step [ms]"
values = [1.0, 4.0, 16.0]
keys = [{ path = "time.step", factor = 1e-3 }]

[y]
label = "sound speed"
choices = [{ name = "slow", set = ["fluid.sound_speed=10"] }, { name = "fast", set = ["fluid.sound_speed=30"] }]
"#;

/// Three files; the same bytes with one thread and with two; drawn again from what is stored; each point's verdict and reason
/// come back from the command that stands at it.
#[test]
fn a_map_is_made_once_and_every_point_comes_back_by_its_command() {
    let place = Workplace::new();
    std::fs::write(place.path("two.toml"), MAP).expect("written");
    let ended = place.run(&["stability", "two.toml", "--out", "out", "--json", "--quiet", "--threads", "1"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let stored: Value = serde_json::from_str(&place.text("out/two.json")).expect("JSON");
    assert_eq!(serde_json::from_str::<Value>(&ended.stdout).expect("JSON on stdout")[0], stored);
    let parallel = place.run(&["stability", "two.toml", "--out", "parallel", "--quiet", "--threads", "2"]);
    assert_eq!(parallel.code, Some(0), "{}", parallel.message);
    assert_eq!(place.text("parallel/two.json"), place.text("out/two.json"));

    let page = place.text("out/two.html");
    let points = stored["points"].as_array().expect("a list");
    let mut seen = Vec::new();
    for point in points {
        let at = format!("{},{}", point["x"].as_str().expect("a place"), point["y"].as_str().expect("a place"));
        assert!(page.contains(&format!("splashdown stability two.toml --point {at}")), "{at} is not on the page");
        let again = place.run(&["stability", "two.toml", "--point", &at, "--json"]);
        assert_eq!(again.code, Some(0), "{}", again.message);
        assert_eq!(serde_json::from_str::<Value>(&again.stdout).expect("JSON"), *point);
        seen.push(point["verdict"].as_str().expect("a word").to_string());
    }
    // at 10 m/s water is compressed by 5 %; 400 steps are more than the map allows; 16 ms are beyond the limit at 30 m/s
    assert_eq!(seen, ["failed", "inaccurate", "failed", "failed", "stable", "failed"]);
    assert!(
        points[0]["why"].as_str().expect("a reason").contains("end time not reached after 200 steps"),
        "{}",
        points[0]
    );

    let drawn = place.run(&["stability", "--from", "out/two.json", "--out", "again", "--table", "two.md", "--quiet"]);
    assert_eq!(drawn.code, Some(0), "{}", drawn.message);
    assert_eq!(place.text("again/two.svg"), place.text("out/two.svg"));
    assert!(place.text("two.md").contains("| fast | "));
}

#[test]
fn a_map_refuses_what_it_cannot_use() {
    let place = Workplace::new();
    let write = |name: &str, from: &str, to: &str| {
        assert!(MAP.contains(from), "{from}");
        std::fs::write(place.path(name), MAP.replace(from, to)).expect("written");
    };
    write("wrong.toml", "about", "abuot");
    write("key.toml", "time.step", "time.stepp");
    write("theory.toml", "\"courant\"", "\"guess\"");
    write("bound.toml", "least = 9614.0\nmost = 10006.0\n", "");
    write("falling.toml", "[1.0, 4.0, 16.0]", "[4.0, 1.0]");
    write("map.toml", "about", "about");
    let refused = |arguments: &[&str], says: &[&str]| {
        let ended = place.run(&[&["stability"], arguments, &["--out", "out", "--quiet"]].concat());
        assert_eq!(ended.code, Some(2), "{}", ended.message);
        ended.says(says);
        assert!(!place.path("out").exists());
    };
    refused(&["nothing"], &["no map `nothing`", "coupling_mass"]);
    refused(&["wrong.toml"], &["wrong.toml", "abuot", "line 2"]);
    refused(&["key.toml"], &["time.stepp"]);
    refused(&["theory.toml"], &["theory.toml", "guess", "courant"]);
    refused(&["bound.toml"], &["means/floor.p_Pa", "expected `least` or `most`"]);
    refused(&["falling.toml"], &["time step [ms]", "expected rising numbers"]);
    refused(&["absent.toml"], &["absent.toml"]);
    refused(&["--from", "wrong.toml"], &["wrong.toml", "expected the JSON file of a map"]);
    refused(&["map.toml", "--point", "1.0,medium"], &["`medium`", "sound speed", "slow, fast"]);
    refused(&["map.toml", "--point", "often,slow"], &["`often`", "time step", "a finite number"]);
    refused(&["--point", "1.0,slow"], &["expected one map, 0 given"]);
}
