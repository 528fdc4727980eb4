//! The same scene gives the same bytes: with any number of threads, again, and from the scene that a run resolved.

use crate::command::Workplace;

const RUN: [&str; 10] = [
    "run",
    "wedge",
    "--quiet",
    "--set",
    "resolution.spacing=0.012",
    "--set",
    "time.end=0.006",
    "--set",
    "time.sample_every=0.0005",
    "--out",
];

/// Curves and log are the same, byte for byte, with one thread, two, and two again.
#[test]
fn threads_and_repetition_do_not_change_a_byte() {
    let place = Workplace::new();
    for (out, threads) in [("one", "1"), ("two", "2"), ("again", "2")] {
        let ended = place.run(&[&RUN[..], &[out, "--threads", threads]].concat());
        assert_eq!(ended.code, Some(0), "{}", ended.message);
    }
    assert_eq!(place.summary("one")["threads"], 1);
    assert_eq!(place.summary("two")["threads"], 2);
    assert!(place.text("one/series.csv").lines().count() > 10);
    for other in ["two", "again"] {
        for file in ["series.csv", "log.mcap", "scene.resolved.toml"] {
            let (ours, theirs) = (place.read(&format!("one/{file}")), place.read(&format!("{other}/{file}")));
            assert!(ours == theirs, "{file} of `one` and `{other}` differ");
        }
    }
}

/// `scene.resolved.toml` is a scene file: it runs to the same curves and the same log, and resolves to itself.
#[test]
fn the_resolved_scene_runs_to_the_same_bytes() {
    let place = Workplace::new();
    let first = place.run(&[&RUN[..], &["first"]].concat());
    assert_eq!(first.code, Some(0), "{}", first.message);
    let second = place.run(&["run", "first/scene.resolved.toml", "--quiet", "--out", "second"]);
    assert_eq!(second.code, Some(0), "{}", second.message);
    for file in ["series.csv", "log.mcap", "scene.resolved.toml"] {
        assert!(place.read(&format!("first/{file}")) == place.read(&format!("second/{file}")), "{file} differs");
    }
}

/// A gate that bends, wet on both sides: threads and repetition do not change a byte, and the resolved scene gives it again.
#[test]
fn a_body_that_bends_gives_the_same_bytes() {
    let place = Workplace::new();
    let run = ["--quiet", "--set", "resolution.spacing=0.004", "--set", "time.end=0.05", "--out"];
    for (out, threads) in [("one", "1"), ("two", "2")] {
        let ended = place.run(&[&["run", "elastic_gate"], &run[..], &[out, "--threads", threads]].concat());
        assert_eq!(ended.code, Some(0), "{}", ended.message);
    }
    let again = place.run(&["run", "one/scene.resolved.toml", "--quiet", "--out", "resolved"]);
    assert_eq!(again.code, Some(0), "{}", again.message);
    assert!(place.text("one/series.csv").contains("gate.at100.dx_m"));
    for other in ["two", "resolved"] {
        for file in ["series.csv", "log.mcap", "scene.resolved.toml"] {
            let (ours, theirs) = (place.read(&format!("one/{file}")), place.read(&format!("{other}/{file}")));
            assert!(ours == theirs, "{file} of `one` and `{other}` differ");
        }
    }
}
