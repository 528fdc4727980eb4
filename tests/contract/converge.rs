//! `splashdown run --converge` and `splashdown bands`: error bars, and what they refuse.

use serde_json::Value;

use crate::command::Workplace;

const RUN: [&str; 10] = [
    "run",
    "wedge_constant",
    "--set",
    "time.end=0.5",
    "--set",
    "resolution.spacing=0.04",
    "--out",
    "out",
    "--threads",
    "1",
];

/// The finest run's files, with a bar for each main number: its middle is the value that the study extrapolates to.
#[test]
fn a_converged_run_has_error_bars() {
    let place = Workplace::new();
    let ended = place.run(&[&RUN[..], &["--converge"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    ended.says(&["coarser run 1 of 2: spacing 0.16", "coarser run 2 of 2: spacing 0.08"]);
    let summary = place.summary("out");
    let bars = summary["error_bars"].as_object().expect("bars");
    assert_eq!(bars.len(), 3, "{bars:?}");
    for (path, bar) in bars {
        let number = |key: &str| bar[key].as_f64().unwrap_or_else(|| panic!("{key} in {bar}"));
        assert_eq!(summary.pointer(&format!("/{path}")).and_then(Value::as_f64), Some(number("value")), "{path}");
        assert!(number("band") > 0.0 && (number("extrapolated") / number("value") - 1.0).abs() < 0.3, "{path}: {bar}");
        assert!(bar["verdict"].as_str().is_some_and(|v| v.contains("converged")), "{bar}");
        assert!(ended.stdout.contains(path), "{path}");
    }
    let page = place.text("out/report.html");
    for words in ["Force coefficient", "Largest pressure coefficient", "Impulse coefficient"] {
        assert!(page.contains(words), "{words} is not on the page");
    }

    let again = place.run(&[&RUN[..], &["--converge"]].concat());
    assert_eq!(again.code, Some(2));
    again.says(&["already holds a run", "--force"]);
    assert!(!again.message.contains("coarser run"), "refused before any run");
}

/// Without a study a run near a charted one has the chart's bars, and one far from all has none.
#[test]
fn a_run_near_a_charted_one_has_its_error_bar() {
    let place = Workplace::new();
    let near = place.run(&["run", "wedge_constant", "--set", "resolution.spacing=0.06", "--out", "near", "--quiet"]);
    assert_eq!(near.code, Some(0), "{}", near.message);
    let bars = place.summary("near")["error_bars"].clone();
    let force = &bars["similarity/force_coefficient"];
    let share = force["band"].as_f64().expect("a band") / force["value"].as_f64().expect("a value");
    assert!((0.003..0.1).contains(&share) && force.get("extrapolated").is_none(), "{force}");
    assert!(force["method"].as_str().is_some_and(|m| m.contains("wedge_30")), "{force}");
    let coarse = ["run", "wedge_constant", "--set", "resolution.spacing=0.12", "--out", "far", "--quiet"];
    assert_eq!(place.run(&coarse).code, Some(0));
    assert!(place.summary("far").get("error_bars").is_none());
}

#[test]
fn error_bars_refuse_what_they_cannot_use() {
    let place = Workplace::new();
    let refused = |arguments: &[&str], says: &[&str]| {
        let ended = place.run(arguments);
        assert_eq!(ended.code, Some(2), "{}", ended.message);
        ended.says(says);
        assert!(!place.path("out").exists());
    };
    let unknown = [&RUN[..], &["--converge", "--quantity", "similarity/force", "--set", "resolution.spacing=0.04"]];
    refused(&unknown.concat(), &["--quantity similarity/force", "expected the path of a number", "similarity/cp_max"]);
    refused(&[&RUN[..], &["--quantity", "time_end_s"]].concat(), &["--converge"]);
    let coarse = [&RUN[..], &["--converge", "--set", "resolution.spacing=0.4"]].concat();
    refused(&coarse, &["--converge of a spacing of 0.4 m", "4 times as coarse", "`resolution.spacing` = 1.6"]);
    refused(&["bands", "nothing"], &["case of bands `nothing`", "wedge_30"]);
}
