//! `splashdown size`, `splashdown fit` and `splashdown scatter`: answers that are known, files, and what they refuse.

use serde_json::Value;

use crate::command::Workplace;

fn number(of: &Value, key: &str) -> f64 {
    of[key].as_f64().unwrap_or_else(|| panic!("no number {key} in {of}"))
}

/// The deadrise for a force is that of the wedge which has it (Dobrovolskaya 1969).
#[test]
fn a_deadrise_for_a_force_is_that_of_the_wedge_with_this_force() {
    let place = Workplace::new();
    let scene = ["wedge_constant", "--set", "model=similarity"];
    let known = ["--set", "body.deadrise_deg=26.5", "--out", "run", "--quiet"];
    let run = place.run(&[&["run"], &scene[..], &known[..]].concat());
    assert_eq!(run.code, Some(0), "{}", run.message);
    let summary = place.summary("run");
    let result = &summary["results"]["peak_force_N_per_m"];
    let limit = format!("peak_force_N_per_m={}", number(result, "value") + number(result, "band"));

    let given = ["--for", "body.deadrise_deg", "--from", "12", "--to", "44", "--limit", &limit, "--out", "deadrise"];
    let ended = place.run(&[&["size"], &scene[..], &given[..], &["--json"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let answer: Value = serde_json::from_str(&ended.stdout).expect("JSON on stdout");
    let value = number(&answer, "value");
    assert!((26.5..26.5 * 1.003).contains(&value), "{answer}");
    assert_eq!(
        (&answer["is_largest"], &answer["decided"]["decided_by"]),
        (&false.into(), &"peak_force_N_per_m".into())
    );
    let table = place.text("deadrise/trials.csv");
    assert!(table.starts_with("value,model,margin,") && table.lines().count() > 7, "{table}");

    let again = place.run(&[&["size"], &scene[..], &given[..]].concat());
    assert_eq!(again.code, Some(2));
    again.says(&["deadrise", "--force"]);
}

/// The thickness of a plate: the smallest of a list is that which a run of each value allows.
#[test]
fn the_smallest_gauge_is_the_first_that_is_allowed() {
    let place = Workplace::new();
    let fixed = ["--set", "body.panels[0].allowable_stress=180e6", "--set", "model=boundary_element"];
    let gauges = ["0.002", "0.003", "0.004"];
    let reserve = |thickness: &str| {
        let set = format!("body.panels[0].thickness={thickness}");
        let given = [&["run", "flexible_wedge"], &fixed[..], &["--set", &set, "--out", "run", "--force", "--quiet"]];
        let ended = place.run(&given.concat());
        assert_eq!(ended.code, Some(0), "{}", ended.message);
        let of = place.summary("run")["results"]["panels"]["plate"]["reserve_factor"].clone();
        number(&of, "value") - of["band"].as_f64().unwrap_or(0.0)
    };
    let reserves = gauges.map(reserve);
    let wanted = 0.5 * (reserves[0] + reserves[1]);
    assert!(reserves[0] < reserves[1], "{reserves:?}");
    let (values, factor) = (gauges.join(","), wanted.to_string());
    let given =
        ["--for", "panels.plate.thickness", "--values", &values, "--reserve", &factor, "--out", "size", "--json"];
    let ended = place.run(&[&["size", "flexible_wedge"], &fixed[..], &given[..]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let answer: Value = serde_json::from_str(&ended.stdout).expect("JSON on stdout");
    assert_eq!(number(&answer, "value"), 0.003);
    assert!((number(&answer["decided"], "margin") - (reserves[1] / wanted - 1.0)).abs() < 1e-9, "{answer}");
    let mass = 2.0 * 0.003 * 2700.0 * 0.3_f64.hypot(0.109191);
    assert!((number(&answer["decided"], "panel_mass_kg_per_m") / mass - 1.0).abs() < 1e-3, "{answer}");
}

/// Two limits allow masses between 185 and 275 kg/m; ends that no limit decides, or that are too early for the panel, are named.
#[test]
fn the_smallest_value_between_two_limits_and_what_no_limit_decides() {
    let place = Workplace::new();
    let size = |given: &[&str]| {
        let ended = place.run(&[&["size"], given, &["--json", "--force"]].concat());
        assert_eq!(ended.code, Some(0), "{given:?}: {}", ended.message);
        serde_json::from_str::<Value>(&ended.stdout).expect("JSON on stdout")
    };
    let limits = ["--limit", "peak_acceleration_g=12", "--limit", "peak_force_N_per_m=26000"];
    let between = size(&[&["wedge", "--for", "body.mass", "--values=100,200,300 kg/m"], &limits[..]].concat());
    assert_eq!((number(&between, "value"), &between["is_largest"]), (200.0, &false.into()));
    assert!(between["notes"].to_string().contains("300 and larger values are not allowed"), "{between}");

    let panel = place.run(&["new", "panel"]);
    std::fs::write(place.path("panel.toml"), panel.stdout).expect("a file");
    let thickness = |more: &[&str]| size(&[&["panel.toml", "--for", "panels.bottom.thickness"], more].concat());
    // a thickness that cannot be run is no end of the search
    let usual = number(&thickness(&["--reserve", "2"]), "value");
    let wide = thickness(&["--reserve", "2", "--from", "0.2 mm", "--to", "20 mm"]);
    assert!((number(&wide, "value") / usual - 1.0).abs() < 4e-3 && wide["at_end"] == false, "{usual} {wide}");
    assert!(wide["notes"].to_string().contains("cannot be run"), "{wide}");
    let early = thickness(&["--reserve", "1.2", "--set", "time.end=0.006"]);
    let notes = early["notes"].to_string();
    assert!(
        notes.contains("not resolved") && notes.contains("over most of the panel by the end of the run"),
        "{early}"
    );
}

/// Mass and speed of a drop are found from its velocity with a known error added; what the data do not determine is named.
#[test]
fn a_fit_finds_the_values_of_a_drop() {
    let place = Workplace::new();
    let drop = ["wedge", "--set", "model=mlm", "--set", "time.end=0.02"];
    let given = ["--set", "body.mass=180", "--set", "body.velocity=[0,-5.2]", "--out", "drop", "--quiet"];
    let ended = place.run(&[&["run"], &drop[..], &given[..]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let series = place.text("drop/series.csv");
    let mut rows = series.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = rows.next().expect("a head");
    let column = head.iter().position(|name| *name == "wedge.vy_m_per_s").expect("a velocity");
    let noise = |k: usize| 0.02 * ((7.3 * k as f64).sin() + (3.1 * (k * k) as f64).cos()); // without memory
    let measured = rows.enumerate().filter(|(k, _)| k % 3 == 0);
    let lines: Vec<String> = measured
        .map(|(k, row)| format!("{},{}", row[0], row[column].parse::<f64>().expect("a number") + noise(k)))
        .collect();
    std::fs::write(place.path("test.csv"), format!("time_s,wedge.vy_m_per_s\n{}\n", lines.join("\n"))).expect("a file");

    let keys = ["--to", "test.csv", "--for", "body.mass,body.velocity.1", "--out", "fit", "--json"];
    let ended = place.run(&[&["fit"], &drop[..], &keys[..]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let answer: Value = serde_json::from_str(&ended.stdout).expect("JSON on stdout");
    for (k, exact) in [180.0, -5.2].into_iter().enumerate() {
        let estimate = &answer["estimates"][k];
        let (value, interval) = (number(estimate, "value"), number(estimate, "interval"));
        assert!((value - exact).abs() < 2.0 * interval && interval < 0.05 * exact.abs(), "{estimate}");
        let ends = [0, 1].map(|end| estimate["range"][end].as_f64().expect("an end"));
        let farther = (value - ends[0]).max(ends[1] - value);
        assert!(ends[0] < value && value < ends[1] && (farther / interval - 1.0).abs() < 1e-9, "{estimate}");
    }
    assert!(place.text("fit/fit.html").contains("wedge.vy_m_per_s: measured less fitted"));
    assert!(place.text("fit/curves.csv").lines().count() == lines.len() + 1);

    // the height of the sides has no effect on the drop
    let keys = ["--to", "test.csv", "--for", "body.mass,body.side_height", "--out", "unknown", "--json"];
    let ended = place.run(&[&["fit"], &drop[..], &keys[..]].concat());
    if ended.code == Some(0) {
        assert!(ended.stdout.contains("these data do not determine it"), "{}", ended.stdout);
        let answer: Value = serde_json::from_str(&ended.stdout).expect("JSON on stdout");
        assert!(answer["estimates"][1]["range"][1].is_null(), "{}", ended.stdout);
    } else {
        assert_eq!(ended.code, Some(2), "{}", ended.message);
    }
}

/// The force on a wedge at a time grows with V² h, which is V³: its quantiles are those of the speed, all its variance is the speed's, and a scatter that was
/// cut goes on to the same answer.
#[test]
fn a_force_scatters_as_the_cube_of_the_speed() {
    let place = Workplace::new();
    let text = "scene = \"wedge_constant\"\nsamples = 400\nseed = 3\n[set]\nmodel = \"similarity\"\n[inputs]\n\
                body.velocity.1 = { normal = [-2.0, 0.05] }\nbody.side_height = { uniform = [0.3, 0.4] }\n";
    std::fs::write(place.path("drop.toml"), text).expect("a file");
    let ended = place.run(&["scatter", "drop.toml", "--out", "out", "--json"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let answer: Value = serde_json::from_str(&ended.stdout).expect("JSON on stdout");
    let fixed = ["--set", "model=similarity", "--set", "body.velocity=[0,-2]", "--out", "run", "--quiet"];
    assert_eq!(place.run(&[&["run", "wedge_constant"], &fixed[..]].concat()).code, Some(0));
    let summary = place.summary("run");
    let result = &summary["results"]["peak_force_N_per_m"];
    let force = &answer["results"]["peak_force_N_per_m"];
    assert_eq!(number(&answer, "failed"), 0.0, "{answer}");
    for (k, normal) in [0.0_f64, 1.6449, 2.3263].into_iter().enumerate() {
        let exact = number(result, "value") * (1.0 + 0.025 * normal).powi(3);
        let quantile = &force["quantiles"][k];
        assert!((number(quantile, "value") / exact - 1.0).abs() < 0.01, "{exact}: {quantile}");
    }
    let share = |k: usize| force["indices"]["first"][k].as_f64().expect("an index");
    // inputs are in the order of their names
    assert!(share(0) < 0.01 && share(1) > 0.98, "{force}");

    let whole = place.text("out/samples.jsonl");
    let cut: String = whole.lines().take(101).map(|line| format!("{line}\n")).collect();
    std::fs::write(place.path("out/samples.jsonl"), cut + "{\"inputs\":[-2.0").expect("a file");
    let again = place.run(&["scatter", "drop.toml", "--out", "out", "--json"]);
    assert_eq!((again.code, &again.stdout), (Some(0), &ended.stdout));
    again.says(&["100 of 400"]);
    assert_eq!(place.text("out/samples.jsonl"), whole);
    assert_eq!(place.text("out/table.csv").lines().count(), 401);
    std::fs::write(place.path("drop.toml"), text.replace("400", "300")).expect("a file");
    let other = place.run(&["scatter", "drop.toml", "--out", "out"]);
    assert_eq!(other.code, Some(2));
    other.says(&["another scatter", "--force"]);
}

#[test]
fn wrong_questions_are_refused() {
    let place = Workplace::new();
    std::fs::write(place.path("bad.csv"), "time_s,wedge.vy_m_per_s\n0,fast\n").expect("a file");
    std::fs::write(place.path("other.csv"), "time_s,boat.vy_m_per_s\n0,1\n0.01,2\n0.02,3\n0.03,4\n").expect("a file");
    std::fs::write(place.path("s.toml"), "scene = \"wedge\"\n[inputs]\nbody.mass = { normal = [1, -1] }\n")
        .expect("a file");
    std::fs::write(place.path("k.toml"), "scene = \"wedge\"\n[inputs]\nbody.name = { normal = [1, 1] }\n")
        .expect("a file");
    std::fs::write(place.path("own.csv"), "time_s,wedge.vy_m_per_s\n0,-6\n0.005,-5.9\n0.01,-5.5\n0.015,-5\n")
        .expect("a file");
    let inputs = "scene = \"wedge\"\n[inputs]\nbody.mass = { normal = [200, 1] }\n";
    std::fs::write(place.path("u.toml"), format!("{inputs}body.masss = {{ normal = [1, 1] }}\n")).expect("a file");
    std::fs::write(place.path("g.toml"), "scene = \"wedge\"\n[grid]\nbody.mass = { normal = [200, 1] }\n")
        .expect("a file");
    std::fs::write(place.path("late.csv"), "time_s,wedge.vy_m_per_s\n5,-6\n5.01,-5\n5.02,-4\n").expect("a file");
    let late = ["fit", "wedge", "--set", "model=mlm", "--to", "late.csv", "--for", "body.mass"];
    for (arguments, said) in [
        (&["scatter", "s.toml"][..], &["s.toml:3", "body.mass", "standard deviation above 0"][..]),
        (&["scatter", "k.toml"], &["body.name", "no number there"]),
        (&["scatter", "none.toml"], &["cannot read none.toml"]),
        (&["scatter", "u.toml"], &["u.toml:4", "body.masss"]),
        (&["sweep", "g.toml"], &["g.toml:3", "splashdown scatter"]),
        (&["certify", "wedge"], &["neither a built-in landing nor a file"]),
        (&["size", "wedge", "--for", "body.mass", "--values=-8,-4"], &["body.mass", "-8", "above 0"]),
        (&["size", "wedge", "--for", "body.mass", "--from", "nan", "--to", "2"], &["body.mass"]),
        (&late, &["no point of the data", "shift=TIME"]),
        (&["size", "wedge", "--set", "model=mlm", "--for", "body.deadrise_deg"][..], &["no result has a limit"][..]),
        (&["size", "wedge", "--for", "panels.belly.thickness"], &["no panel `belly`"]),
        (&["size", "wedge", "--for", "body.name"], &["no number there"]),
        (&["size", "wedge", "--for", "body.mass", "--from", "3", "--to", "1"], &["--from 3 --to 1"]),
        (&["size", "wedge", "--for", "body.mass", "--reserve", "0"], &["--reserve 0", "above 0"]),
        (&["size", "wedge", "--for", "body.mass", "--limit", "force"], &["--limit force", "RESULT=VALUE"]),
        (&["size", "wedge", "--for", "body.mass", "--values", "3"], &["two or more"]),
        (&["fit", "wedge", "--to", "bad.csv", "--for", "body.mass"], &["bad.csv:2", "\"fast\"", "a number"]),
        (&["fit", "wedge", "--to", "none.csv", "--for", "body.mass"], &["cannot read none.csv"]),
        (
            &["fit", "wedge", "--set", "model=mlm", "--to", "other.csv", "--for", "body.mass"],
            &["no column `boat.vy_m_per_s`", "wedge.vy_m_per_s"],
        ),
        (&["fit", "wedge", "--set", "model=mlm", "--to", "own.csv", "--for", "body.velocity.0"], &["0 in the scene"]),
    ] {
        let ended = place.run(arguments);
        assert_eq!(ended.code, Some(2), "{arguments:?}: {}", ended.message);
        ended.says(said);
    }
    let ended = place.run(&["fit", "wedge", "--to", "bad.csv", "--for", "body.mass", "--json"]);
    let error: Value = serde_json::from_str(&ended.stdout).expect("JSON");
    assert_eq!(
        [&error["error"]["file"], &error["error"]["line"]],
        [&Value::from("bad.csv"), &Value::from(2)],
        "{error}"
    );
}
