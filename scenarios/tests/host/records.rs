//! Records of a hosted run: those of a run without rejected steps, and those of a failed one.

use std::fs;
use std::path::Path;

use serde_json::Value;
use temp_dir::TempDir;

use super::*;

const DT: f64 = 2e-4;
/// Numbers of a summary that depend on the machine.
const VOLATILE: [&str; 4] = ["wall_time_s", "particle_updates_per_s", "threads", "phases"];

fn summary(dir: &Path) -> Value {
    let text = fs::read_to_string(dir.join("summary.json")).expect("a summary");
    let mut summary: Value = serde_json::from_str(&text).expect("JSON");
    let table = summary.as_object_mut().expect("a table");
    VOLATILE.iter().for_each(|key| drop(table.remove(*key)));
    table.remove("log");
    summary
}

fn recorded(case: Case, dir: &Path, tries: bool) {
    let scene = case
        .open(&["time.sample_every=2e-4", "time.frame_every=1e-3"])
        .recording(dir.to_owned(), false)
        .with_page(report::page_of_run);
    let start = scene.nodes().clone();
    let mut run = scene.build(&start).expect("water");
    for step in 1..=20 {
        run.save();
        if tries && step % 3 == 0 {
            stepped(&mut run, &start, f64::from(step + 2) * DT, 3.0 * DT);
            run.restore().expect("a saved state");
        }
        stepped(&mut run, &start, f64::from(step) * DT, DT);
    }
    assert!(run.finish().expect("a report").expect("records").summary.status.is_completed());
}

#[test]
fn rejected_steps_are_not_in_the_records() {
    for case in [CASES[0], CASES[3], CASES[8]] {
        let folder = TempDir::new().expect("a folder");
        let (a, b) = (folder.path().join("a"), folder.path().join("b"));
        recorded(case, &a, false);
        recorded(case, &b, true);
        let read = |dir: &Path, name: &str| fs::read(dir.join(name)).expect("a file");
        assert!(read(&a, "series.csv") == read(&b, "series.csv"), "{case:?}, {}", "series.csv");
        assert!(read(&a, "log.mcap") == read(&b, "log.mcap"), "{case:?}, {}", "log.mcap");
        assert_eq!(summary(&a), summary(&b), "{case:?}");
        assert!(read(&a, "report.html").len() > 50_000);
        let rows = String::from_utf8(read(&a, "series.csv")).expect("text").lines().count();
        assert!(rows >= 20, "{case:?}: {rows} rows");
        assert!(summary(&a)["warnings"].to_string().contains("a host program moved the body"));
    }
}

/// A step that breaks the water, or that moves a body faster than sound would allow, leaves a readable record.
#[test]
fn a_failed_run_has_a_summary_that_tells_why() {
    let folder = TempDir::new().expect("a folder");
    let dir = folder.path().join("failed");
    let scene = CASES[0].open(&[]).recording(dir.clone(), false).with_page(report::page_of_run);
    let start = scene.nodes().clone();
    let mut run = scene.build(&start).expect("water");
    stepped(&mut run, &start, DT, DT);
    let mut forces = [[0.0; 3]];
    let mut nodes = moved(&start, DT);
    let broken = (0..400).find_map(|_| {
        nodes.position[0][1] -= 5e-3;
        nodes.velocity[0][1] = -25.0;
        run.contribute(DT, &nodes, &mut forces).err()
    });
    let error = broken.expect("the body meets the floor");
    assert_eq!(error.kind(), run::host::ErrorKind::Step, "{error}");
    assert_eq!(run.contribute(DT, &nodes, &mut forces).unwrap_err().kind(), run::host::ErrorKind::Failed);
    run.finish().expect("records");
    let summary = summary(&dir);
    assert_eq!(summary["status"], "failed");
    assert_eq!(summary["message"], error.to_string());
    for (name, quantity) in summary["results"].as_object().expect("results") {
        assert!(quantity.get("verdict").is_none_or(|verdict| verdict == "not_resolved"), "{name}: {quantity}");
    }
}

/// A run that was dropped before its end has a page about the host's motion as well.
#[test]
fn a_hosted_run_that_did_not_end_is_reported_as_one() {
    let folder = TempDir::new().expect("a folder");
    let dir = folder.path().join("dropped");
    let scene = CASES[0].open(&["time.sample_every=2e-4"]).recording(dir.clone(), false).with_page(report::page_of_run);
    let start = scene.nodes().clone();
    let mut run = scene.build(&start).expect("water");
    (1..=10).for_each(|step| drop(stepped(&mut run, &start, f64::from(step) * DT, DT)));
    drop(run);
    assert!(!dir.join("summary.json").exists());
    let mut report = std::process::Command::new(env!("CARGO_BIN_EXE_splashdown"));
    assert!(report.arg("report").arg(&dir).output().expect("the program").status.success());
    let page = fs::read_to_string(dir.join("report.html")).expect("a page");
    for absent in ["To repeat this run", "von Karman", "Wagner"] {
        assert!(!page.contains(absent), "{absent}");
    }
    assert!(page.contains("moved by a host program"));
}

/// What the host did is reported, and what the scene would have done is not in the page.
#[test]
fn a_hosted_report_is_about_the_hosts_motion() {
    let folder = TempDir::new().expect("a folder");
    let (slow, expected) = (folder.path().join("slow"), folder.path().join("expected"));
    for (dir, share) in [(&slow, 0.3), (&expected, 1.0)] {
        let scene = CASES[0].open(&[]).recording(dir.clone(), false).with_page(report::page_of_run);
        let mut start = scene.nodes().clone();
        start.velocity[0][1] *= share;
        let mut run = scene.build(&start).expect("water");
        (1..=100).for_each(|step| drop(stepped(&mut run, &start, f64::from(step) * DT, DT)));
        run.finish().expect("records");
        let (summary, page) = (summary(dir), fs::read_to_string(dir.join("report.html")).expect("a page"));
        assert_eq!(summary["host"], "body");
        assert_eq!(summary["comparison"].as_array().map(Vec::len), Some(0));
        for absent in ["To repeat this run", "von Karman", "Wagner"] {
            assert!(!page.contains(absent), "{absent}");
        }
        assert!(page.contains("moved by a host program"));
        let doubted = summary["doubts"].to_string().contains("met the water at");
        assert_eq!(doubted, share < 1.0, "{}", summary["doubts"]);
    }
}

#[cfg(unix)]
const FULL: &str = "records::a_full_disk_ends_the_records_and_not_the_run";

/// In a process whose files may not grow beyond 100 or 200 kB: the same forces as without records, and the first error at the end.
#[test]
#[cfg(unix)]
fn a_full_disk_ends_the_records_and_not_the_run() {
    if std::env::var_os("SPLASHDOWN_FULL").is_some() {
        return full();
    }
    let mut limited = std::process::Command::new("sh");
    limited.args(["-c", "trap '' XFSZ; ulimit -f 200; exec \"$0\" --exact \"$1\""]).env("SPLASHDOWN_FULL", "1");
    let ended = limited.arg(std::env::current_exe().expect("a test")).arg(FULL).output().expect("a shell");
    let said = String::from_utf8_lossy(&ended.stdout);
    assert!(ended.status.success() && said.contains("1 passed"), "{said}");
}

#[cfg(unix)]
fn full() {
    let folder = TempDir::new().expect("a folder");
    let often = ["time.sample_every=1e-4", "time.frame_every=1e-4"];
    let scene = CASES[0].open(&often).recording(folder.path().join("run"), false).with_page(report::page_of_run);
    let start = scene.nodes().clone();
    let mut recorded = scene.build(&start).expect("water");
    let (mut plain, _) = CASES[0].build(&often);
    for step in 1..=40 {
        let take = |run: &mut HostedRun| {
            if step % 5 == 0 {
                run.save();
                stepped(run, &start, f64::from(step + 2) * DT, 3.0 * DT);
                run.restore().expect("a saved state");
            }
            stepped(run, &start, f64::from(step) * DT, DT)
        };
        assert_eq!(take(&mut recorded), take(&mut plain), "step {step}");
    }
    let error = recorded.finish().err().expect("a full disk");
    assert_eq!(error.kind(), run::host::ErrorKind::File, "{error}");
    assert!(error.to_string().contains("log.mcap"), "{error}");
}
