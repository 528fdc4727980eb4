//! What the page asks, and what it is answered.

use std::thread;
use std::time::Duration;

use serde_json::{Value, json};

use super::{Studio, wedge};

fn of_model<'a>(answers: &'a Value, model: &str) -> &'a Value {
    answers.as_array().expect("a list").iter().find(|answer| answer["model"] == model).expect("the model")
}

#[test]
fn the_curve_of_a_theory_is_that_of_the_library() {
    let studio = Studio::open(&["wedge"]);
    let text = studio.text();
    assert_eq!(text, wedge());
    let answers = studio.post("/api/theories", &json!({"text": text}));
    let mlm = of_model(&answers, "mlm");
    let scene = run::load("wedge", &["model=mlm".into()]).expect("a scene").scene;
    let outcome = run::run(&scene, &run::RunOptions::default()).expect("a run");
    let force = outcome.series.column("wedge.fy_N_per_m").expect("a column");
    let (times, found) = (outcome.series.times(), &mlm["curves"][0]);
    assert_eq!((found["title"].as_str(), found["si"].as_str()), (Some("Force"), Some("N/m")));
    let shown = mlm["time"].as_array().expect("times").iter().zip(found["values"].as_array().expect("values"));
    let mut compared = 0;
    for (time, value) in shown {
        let k = times.iter().position(|own| Some(*own) == time.as_f64()).expect("a row of the library");
        assert_eq!(value.as_f64(), Some(force[k]));
        compared += 1;
    }
    assert!(compared > 100, "{compared}");
    let peak =
        outcome.summary.results.named().find(|(id, _)| id.to_string() == "peak_force_N_per_m").expect("a force").1;
    assert!(peak.shown().is_some());
    assert_eq!(mlm["quote"]["value"].as_f64(), peak.shown());
    assert_eq!(of_model(&answers, "similarity")["ok"], false, "a body that slows down is outside its range");
}

#[test]
fn a_mistake_stands_at_its_key_and_an_edit_keeps_the_other_lines() {
    let studio = Studio::open(&["wedge"]);
    let edit = |key: &str, value: &str| json!({"text": wedge(), "edits": [{"key": key, "value": value}]});
    let wrong = studio.post("/api/scene", &edit("body.deadrise_deg", "120"));
    assert_eq!(wrong["error"]["key"], "body.deadrise_deg");
    assert!(wrong["error"]["expected"].as_str().is_some_and(|text| text.contains("80")), "{wrong}");
    assert!(wrong["error"]["line"].as_u64().is_some_and(|line| line > 1));
    assert_eq!(wrong["written"]["body.deadrise_deg"], "120");
    let right = studio.post("/api/scene", &edit("body.deadrise_deg", "25"));
    assert_eq!(right["error"], Value::Null);
    let text = right["text"].as_str().expect("a text");
    let differing: Vec<_> =
        text.lines().zip(wedge().lines().map(String::from).collect::<Vec<_>>()).filter(|(a, b)| a != b).collect();
    assert_eq!(differing.len(), 1, "{differing:?}");
    assert!(right["section"]["bodies"][0]["outline"].as_array().is_some_and(|points| points.len() >= 5));
    let broken = studio.post("/api/scene", &json!({"text": "name = \n"}));
    assert!(broken["error"]["message"].as_str().is_some_and(|text| text.contains("TOML")), "{broken}");
}

#[test]
fn warnings_of_check_come_with_the_scene() {
    let studio = Studio::open(&["wedge"]);
    let edits = [("body.mass", "0.001")].map(|(key, value)| json!({"key": key, "value": value}));
    let view = studio.post("/api/scene", &json!({"text": wedge(), "edits": edits}));
    let text = view["text"].as_str().expect("a text");
    let loaded = run::load_text("scene.toml", text, &[]).expect("a scene");
    assert_eq!(view["warnings"], json!(loaded.warnings));
    assert!(!loaded.warnings.is_empty());
}

#[test]
fn boundary_elements_answer_with_a_band_and_a_later_request_ends_an_earlier() {
    let studio = Studio::open(&["wedge"]);
    let asked = |deadrise: &str| {
        let text = wedge().replace("deadrise_deg = 30", &format!("deadrise_deg = {deadrise}"));
        assert!(text.contains(&format!("deadrise_deg = {deadrise}")), "the scene has the key");
        json!({"text": text, "page": "one"})
    };
    let earlier = thread::scope(|scope| {
        // flat faces take seconds
        let earlier = scope.spawn(|| studio.post("/api/flow", &asked("10")));
        thread::sleep(Duration::from_millis(300));
        let later = studio.post("/api/flow", &asked("30"));
        assert_eq!(
            (later["ok"].as_bool(), later["quote"]["verdict"].as_str()),
            (Some(true), Some("resolved")),
            "{later}"
        );
        earlier.join().expect("an answer")
    });
    assert_eq!(earlier["stale"], true, "{earlier}");
}

#[test]
fn an_outline_of_a_file_is_read_and_its_mistake_has_a_line() {
    let studio = Studio::open(&[]);
    let token = [("X-Splashdown-Token", studio.token.as_str())];
    let post = |path: &str, body: &str| {
        let answer = studio.with(&format!("POST {path}"), &token, body);
        serde_json::from_str::<Value>(&answer.body).expect("JSON")
    };
    let points = post("/api/outline?name=hull.csv&unit=mm", "-1000,500\n0,0\n1000,500\n1000,900\n-1000,900\n");
    assert_eq!(points["points"].as_array().map(Vec::len), Some(5), "{points}");
    assert_eq!(points["points"][0].as_array().map(|p| p[0].as_f64().map(f64::abs)), Some(Some(1.0)));
    let wrong = post("/api/outline?name=hull.csv", "x,y\n0,0\n1,here\n");
    assert!(wrong["error"].as_str().is_some_and(|text| text.contains("hull.csv") && text.contains("here")), "{wrong}");
    assert_eq!(std::fs::read_dir(studio.folder.path()).expect("the folder").count(), 0, "nothing is left");
}

#[test]
fn runs_are_kept_stopped_and_compared() {
    let studio = Studio::open(&["wedge"]);
    let theory = studio.post("/api/scene", &json!({"text": wedge(), "edits": [{"key": "model", "value": "wagner"}]}));
    let first = studio.post("/api/runs", &json!({"text": theory["text"]}));
    let second = studio.post("/api/runs", &json!({"text": theory["text"]}));
    assert_eq!((first["name"].as_str(), second["name"].as_str()), (Some("wedge"), Some("wedge_2")));
    let done = studio.wait(|run| run["name"] == "wedge_2" && run["state"] == "ended");
    assert_eq!((done["has_results"].as_bool(), &done["fingerprint"]), (Some(true), &theory["fingerprint"]));
    let long = studio.post("/api/runs", &json!({"text": wedge()}));
    let name = long["name"].as_str().expect("a name").to_string();
    studio.wait(|run| run["name"] == name.as_str() && run["share"].as_f64().is_some_and(|share| share > 0.0));
    assert_eq!(studio.post(&format!("/api/runs/{name}/stop"), &json!({}))["stopped"], true);
    let stopped = studio.wait(|run| run["name"] == name.as_str() && run["state"] == "ended");
    assert_eq!(stopped["status"], "interrupted", "{stopped}");
    assert!(studio.folder.path().join("runs").join(&name).join("checkpoint.bin").is_file());
    let answer = studio.json("/api/runs/wedge/answer");
    assert_eq!((answer["ok"].as_bool(), answer["model"].as_str()), (Some(true), Some("wagner")));
    let page = studio.get("/api/compare?run=wedge&run=wedge_2");
    assert!(page.status == 200 && page.body.contains("Comparison of 2 runs") && page.head.contains("sandbox"));
    assert!(studio.get("/runs/wedge/report.html").body.contains("<h1>"));
    let refused = studio.post("/api/runs", &json!({"text": wedge().replace("deadrise_deg = 30", "deadrise_deg = 0")}));
    assert_eq!((&refused["name"], refused["error"]["key"].as_str()), (&Value::Null, Some("body.deadrise_deg")));
}

#[test]
fn a_grid_has_the_results_of_each_point() {
    let studio = Studio::open(&["wedge"]);
    let ranges = json!([{"key": "body.deadrise_deg", "from": 20, "to": 40, "count": 3}, {"key": "body.velocity[1]", "from": -4, "to": -6, "count": 2}]);
    let begun = studio.post("/api/grid", &json!({"text": wedge(), "model": "mlm", "ranges": ranges}));
    assert_eq!(begun["error"], Value::Null);
    let progress = || studio.json(&format!("/api/grid?id={}", begun["id"]));
    let mut found = progress();
    while found["done"] != 6 {
        thread::sleep(Duration::from_millis(20));
        found = progress();
    }
    let sets = ["model=mlm", "body.deadrise_deg=30", "body.velocity=[0, -6]"].map(String::from);
    let outcome =
        run::run(&run::load("wedge", &sets).expect("a scene").scene, &run::RunOptions::default()).expect("a run");
    let peak =
        outcome.summary.results.named().find(|(id, _)| id.to_string() == "peak_force_N_per_m").expect("a force").1;
    let of_point = found["points"][3]["results"].as_array().expect("results");
    let force = of_point.iter().find(|result| result["name"] == "peak_force_N_per_m").expect("a force");
    assert_eq!(force["value"].as_f64(), peak.shown());
    let refused = studio.post("/api/grid", &json!({"text": wedge(), "model": "wcsph", "ranges": ranges}));
    assert!(refused["error"].as_str().is_some_and(|why| why.contains("expected a theory")));
    let many = json!([{"key": "body.mass", "from": 1, "to": 2, "count": 100_000}]);
    assert!(studio.post("/api/grid", &json!({"text": wedge(), "model": "mlm", "ranges": many}))["error"].is_string());
}
