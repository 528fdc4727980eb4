//! The files of a run, by their contract: names and types that scripts outside depend on.

use serde_json::Value;

use crate::command::{Workplace, read_log};

/// A body with a gauge, for a moment.
const SECTION: [&str; 8] = [
    "run",
    "fuselage_section",
    "--set",
    "resolution.spacing=0.02",
    "--set",
    "time.end=0.004",
    "--set",
    "time.sample_every=0.0005",
];

/// Five files, and no other.
#[test]
fn a_run_writes_its_five_files() {
    let place = Workplace::new();
    let ended = place.run(&[&SECTION[..], &["--out", "out"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let mut names: Vec<String> = std::fs::read_dir(place.path("out"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert_eq!(names, ["log.mcap", "report.html", "scene.resolved.toml", "series.csv", "summary.json"]);
    let log = read_log(&place.read("out/log.mcap"));
    assert!(log.complete && log.fluid_frames > 1, "{} frames", log.fluid_frames);
    let report = place.text("out/report.html");
    let outside = ["src=\"http", "href=\"http", "@import", "url(http"];
    assert!(outside.iter().all(|link| !report.contains(link)), "the report needs the network");
}

/// The header of `series.csv` is time, then ten columns a body, then one a gauge; every row is as long and finite.
#[test]
fn the_series_has_the_columns_of_the_contract() {
    let place = Workplace::new();
    place.run(&[&SECTION[..], &["--out", "out", "--quiet"]].concat());
    let series = place.text("out/series.csv");
    let mut lines = series.lines();
    assert_eq!(
        lines.next(),
        Some(
            "time_s,section.x_m,section.y_m,section.angle_deg,section.vx_m_per_s,section.vy_m_per_s,\
             section.ax_m_per_s2,section.ay_m_per_s2,section.fx_N_per_m,section.fy_N_per_m,section.moment_N,keel.p_Pa"
        )
    );
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect()).collect();
    assert!(rows.len() >= 8, "{} rows for 8 sampling intervals", rows.len());
    assert!(rows.iter().all(|row| row.len() == 12 && row.iter().all(|v| v.is_finite())));
    assert!(rows.windows(2).all(|pair| pair[1][0] > pair[0][0]), "time does not run forward");
    let summary = place.summary("out");
    for key in ["peak_pa", "peak_time_s", "impulse_pa_s", "length_m"] {
        has(&summary, &format!("/gauges/keel/{key}"), Value::is_f64);
    }
    for key in ["rise_time_s", "bandwidth_hz"] {
        has(&summary, &format!("/gauges/keel/{key}"), |v| v.is_f64() || v.is_null());
    }
    assert_eq!(summary["gauges"]["keel"]["peak_pa"], summary["peaks"]["keel.p_Pa"]["value"]);
    assert!(place.text("out/report.html").contains("takes"), "no sentence on compressibility");
}

/// Asserts the type of the value at a path of `summary.json`.
fn has(summary: &Value, path: &str, is: fn(&Value) -> bool) {
    let value = summary.pointer(path).unwrap_or_else(|| panic!("{path} is missing in {summary}"));
    assert!(is(value), "{path} = {value}");
}

/// `summary.json` holds the keys of the contract with their types; `--json` prints the same on stdout.
#[test]
fn the_summary_has_the_keys_of_the_contract() {
    let place = Workplace::new();
    let short = ["run", "wedge_constant", "--set", "resolution.spacing=0.1", "--json", "--out", "out"];
    let ended = place.run(&short);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let summary = place.summary("out");
    assert_eq!(serde_json::from_str::<Value>(&ended.stdout).expect("JSON on stdout"), summary);
    for path in ["/scene", "/status", "/model"] {
        has(&summary, path, Value::is_string);
    }
    for path in ["/particles/fluid", "/particles/wall", "/steps", "/audit/penetrated"] {
        has(&summary, path, Value::is_u64);
    }
    for path in [
        "/time_end_s",
        "/wall_time_s",
        "/particle_updates_per_s",
        "/peaks/wedge.fy_N_per_m/value",
        "/peaks/wedge.fy_N_per_m/time_s",
        "/phases/density/seconds",
        "/phases/density/share",
        "/phases/momentum/seconds",
        "/phases/observers/seconds",
        "/phases/log/seconds",
        "/audit/momentum",
        "/audit/energy",
        "/audit/volume",
        "/similarity/cp_max",
        "/similarity/z_max_over_vt",
        "/similarity/force_coefficient",
        "/similarity/impulse_coefficient",
        "/similarity/profile_error_snapshot",
        "/similarity/cp_noise",
        "/similarity/z_max_error",
        "/coupling/iterations_mean",
        "/coupling/residual_worst",
        "/compressibility/mach_reached",
        "/compressibility/force_error_estimate",
        "/compressibility/force_corrected",
        "/comparison/0/ours",
        "/comparison/0/theirs",
        "/comparison/0/error",
        "/comparison/0/tolerance",
    ] {
        has(&summary, path, Value::is_f64);
    }
    let phases = summary["phases"].as_object().expect("phases");
    let shares: f64 = phases.values().map(|phase| phase["share"].as_f64().expect("a share")).sum();
    let seconds: f64 = phases.values().map(|phase| phase["seconds"].as_f64().expect("seconds")).sum();
    let wall = summary["wall_time_s"].as_f64().expect("a number");
    assert!(
        (shares - 1.0).abs() < 1e-9 && seconds > 0.3 * wall && seconds <= wall,
        "{seconds} of {wall} s: {phases:?}"
    );
    assert!(place.text("out/report.html").contains(">momentum "), "no bar of the parts of the run");
    has(&summary, "/similarity/window_s", |v| {
        v.as_array().is_some_and(|a| a.len() == 2 && a.iter().all(Value::is_f64))
    });
    has(&summary, "/coupling/scheme", |v| v == "weak");
    has(&summary, "/coupling/iterations_max", Value::is_u64);
    has(&summary, "/comparison/0/reference", Value::is_string);
    has(&summary, "/comparison/0/quantity", Value::is_string);
    // so coarse that the largest pressure is not resolved
    has(&summary, "/similarity/cp_max_unresolved", Value::is_string);
    has(&summary, "/doubts/0", |v| v.as_str().is_some_and(|why| why.contains("similarity.cp_max")));
    assert_eq!([&summary["scene"], &summary["model"]], ["wedge_constant", "wcsph"]);
    assert_eq!(summary["status"], "completed_with_doubts");
}

/// Every built-in scene is listed with what it shows, can be checked, and every key is described.
#[test]
fn list_check_and_keywords_speak_for_every_scene() {
    let place = Workplace::new();
    let listed: Value = serde_json::from_str(&place.run(&["list", "--json"]).stdout).expect("JSON");
    let scenes = listed.as_array().expect("a list");
    assert!(scenes.len() >= 7, "{} scenes", scenes.len());
    for scene in scenes {
        has(scene, "/description", |d| d.as_str().is_some_and(|text| !text.is_empty()));
        let ended = place.run(&["check", scene["scene"].as_str().expect("a name"), "--json"]);
        assert_eq!(ended.code, Some(0), "{scene}: {}", ended.message);
        serde_json::from_str::<Value>(&ended.stdout).expect("JSON");
    }
    let keywords = place.run(&["keywords", "--json"]).stdout;
    for line in keywords.lines() {
        let keyword: Value = serde_json::from_str(line).expect("JSON, a key a line");
        has(&keyword, "/doc", |d| d.as_str().is_some_and(|text| !text.is_empty()));
    }
    assert!(keywords.contains("\"resolution.spacing\""));
}
