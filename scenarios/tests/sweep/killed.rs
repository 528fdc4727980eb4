//! Killed and interrupted sweeps go on, and lose nothing.
#![cfg(unix)]

use std::fs;
use std::process::{Child, Command, Stdio};
use std::time::SystemTime;

use super::{Place, wait_until};

/// One point of about a second.
const SLOW: &str = r#"
scene = "wedge"
[set]
resolution.spacing = 0.012
time.end = 0.02
[grid]
body.mass = [200]
"#;
/// One point of some minutes.
const ENDLESS: &str =
    "scene = \"wedge_constant\"\n[set]\nresolution.spacing = 0.01\n[grid]\nbody.deadrise_deg = [30]\n";
const START: [&str; 5] = ["drops.toml", "--out", "out", "--jobs", "2"];

/// Points of a killed sweep: five, and eight in the long variant.
fn several() -> u64 {
    if std::env::var("LONG").is_ok_and(|value| value == "1") { 8 } else { 5 }
}

/// A sweep of points like [`SLOW`].
fn slow(points: u64) -> String {
    let masses: Vec<u64> = (0..points).map(|k| 200 + 10 * k).collect();
    SLOW.replace("[200]", &format!("{masses:?}"))
}

fn start(place: &Place) -> Child {
    place.command(&START).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the command starts")
}

fn signal(name: &str, id: u32) {
    let sent = Command::new("kill").args([name, &id.to_string()]).status().expect("the kill command");
    assert!(sent.success(), "no signal was sent");
}

/// Processes that a process has started.
fn children(id: u32) -> Vec<u32> {
    let listed = Command::new("ps").args(["-A", "-o", "ppid=,pid="]).output().expect("the ps command");
    let text = String::from_utf8_lossy(&listed.stdout).into_owned();
    let pairs = text.lines().filter_map(|line| {
        let mut words = line.split_whitespace().map(|word| word.parse::<u32>().ok());
        Some((words.next()??, words.next()??))
    });
    pairs.filter(|(parent, _)| *parent == id).map(|(_, child)| child).collect()
}

fn ends(place: &Place) -> Vec<(std::path::PathBuf, SystemTime)> {
    let date = |path: &std::path::PathBuf| fs::metadata(path.join("point.json")).and_then(|m| m.modified()).ok();
    place.points_with("point.json").into_iter().filter_map(|path| Some((path.clone(), date(&path)?))).collect()
}

/// kill -9 of a worker: its point runs again, the sweep ends as if nothing had happened.
#[test]
fn a_killed_worker_is_replaced() {
    let place = Place::new(&slow(several()));
    let mut coordinator = start(&place);
    wait_until("a worker writes", || !place.points_with("series.csv").is_empty());
    signal("-KILL", children(coordinator.id())[0]);
    assert_eq!(coordinator.wait().expect("a child").code(), Some(0));
    assert_eq!(place.points_with("point.json").len() as u64, several());
    assert_eq!(place.text("out/table.csv").lines().count() as u64, several() + 1);
}

/// A worker that dies each time is reported, and the next call tries again.
#[test]
fn a_worker_that_dies_each_time_is_reported() {
    let place = Place::new(ENDLESS);
    let mut coordinator = start(&place);
    let mut dead = 0;
    for _ in 0..2 {
        wait_until("a new worker", || children(coordinator.id()).iter().any(|id| *id != dead));
        dead = children(coordinator.id()).into_iter().find(|id| *id != dead).expect("a worker");
        signal("-KILL", dead);
    }
    assert_eq!(coordinator.wait().expect("a child").code(), Some(1));
    let table = place.text("out/table.csv");
    assert!(table.contains(",killed,") && table.contains("signal: 9"), "{table}");
    let (_, status, _) = place.sweep(&["--status"]);
    assert_eq!((&status["failed"], &status["waiting"]), (&1.into(), &0.into()));
    place.write("drops.toml", &ENDLESS.replace("[set]", "[set]\nmodel = \"similarity\""));
    assert_eq!(place.sweep(&[]).0, Some(0));
}

/// kill -9 of the coordinator: its workers end their points; the next call runs the others only. A second coordinator is refused.
#[test]
fn a_killed_coordinator_loses_nothing() {
    let place = Place::new(&slow(several()));
    let mut coordinator = start(&place);
    wait_until("a point has ended", || !place.points_with("point.json").is_empty());
    let (code, _, message) = place.sweep(&[]);
    assert_eq!(code, Some(2));
    assert!(message.contains("another `splashdown sweep` runs this sweep"), "{message}");
    let (_, status, _) = place.sweep(&["--status"]);
    assert_eq!((&status["points"], &status["coordinator"]), (&several().into(), &true.into()));
    signal("-KILL", coordinator.id());
    coordinator.wait().expect("a child");
    let before = ends(&place);
    let (code, said, message) = place.sweep(&["--resume", "--jobs", "2"]);
    assert_eq!((code, &said["done"]), (Some(0), &several().into()), "{message}");
    // workers may have ended between the two
    assert!(said["reused"].as_u64() >= Some(before.len() as u64), "{said}");
    let after = ends(&place);
    assert!(before.iter().all(|end| after.contains(end)), "a point that had ended ran again");
    assert_eq!(after.len() as u64, several());
}

/// Workers of a killed coordinator are waited for, not doubled: their processes stay the only ones.
#[test]
fn points_of_a_killed_coordinator_run_once() {
    let place = Place::new(&slow(2));
    let mut coordinator = start(&place);
    wait_until("both workers write", || place.points_with("series.csv").len() == 2);
    signal("-KILL", coordinator.id());
    coordinator.wait().expect("a child");
    let starts = || -> Vec<SystemTime> {
        let files =
            place.points_with("scene.resolved.toml").into_iter().map(|folder| folder.join("scene.resolved.toml"));
        files.filter_map(|file| fs::metadata(file).and_then(|m| m.modified()).ok()).collect()
    };
    let before = starts();
    let (code, said, message) = place.sweep(&["--jobs", "2"]);
    assert_eq!((code, &said["done"]), (Some(0), &2.into()), "{message}");
    assert_eq!(starts(), before, "a point was started twice");
}

/// Ctrl-C: workers end after their step, the coordinator says how to continue, and no process is left.
#[test]
fn an_interrupted_sweep_continues() {
    let place = Place::new(ENDLESS);
    let mut coordinator = start(&place);
    wait_until("the worker steps", || place.points_with("series.csv").len() == 1);
    let worker = children(coordinator.id())[0];
    signal("-TERM", coordinator.id());
    assert_eq!(coordinator.wait().expect("a child").code(), Some(1));
    let alive = Command::new("kill").args(["-0", &worker.to_string()]).stderr(Stdio::null()).status();
    assert!(!alive.expect("the kill command").success(), "a worker is left");
    assert!(place.points_with("point.json").is_empty());
    let (_, status, _) = place.sweep(&["--status"]);
    assert_eq!((&status["waiting"], &status["coordinator"]), (&1.into(), &false.into()));
}

/// A point that was interrupted goes on from its checkpoint, to the bits that it has without a break.
#[test]
fn an_interrupted_point_goes_on_from_its_checkpoint() {
    let (place, whole) = (Place::new(SLOW), Place::new(SLOW));
    let mut coordinator = start(&place);
    wait_until("the worker steps", || place.points_with("series.csv").len() == 1);
    signal("-TERM", coordinator.id());
    coordinator.wait().expect("a child");
    let checkpoints = place.points_with("checkpoint.bin");
    assert_eq!((checkpoints.len(), place.points_with("point.json").len()), (1, 0));
    for sweep in [&place, &whole] {
        assert_eq!(sweep.sweep(&[]).0, Some(0));
    }
    // a run from the start removes the checkpoint
    assert_eq!(place.points_with("checkpoint.bin").len(), 1);
    let series = |sweep: &Place| fs::read(sweep.points_with("point.json")[0].join("series.csv")).expect("a series");
    assert!(series(&place) == series(&whole));
}
