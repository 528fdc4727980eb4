//! Runs that are continued from a checkpoint: the same bits as without a break, whatever broke them; files that are refused.

mod bits;
mod killed;
mod later;
mod refused;

use std::fs;
use std::path::Path;

use run::{Checkpoints, Resumable, RunOptions, run};
use scene::Scene;
use scene::vocabulary::Status;
use serde_json::Value;
use sph_core::parallel::on_threads;
use temp_dir::TempDir;

/// Numbers of a summary that depend on the machine and on the time of day.
const VOLATILE: [&str; 4] = ["wall_time_s", "particle_updates_per_s", "threads", "phases"];

fn scene_of(name: &str, sets: &[&str]) -> Scene {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    run::load(name, &sets).unwrap_or_else(|error| panic!("{name} {sets:?}: {error:?}")).scene
}

/// At its end time, or at a rupture.
fn has_ended(status: Status) -> bool {
    status.is_completed() || status == Status::Ruptured
}

/// Run a scene in a folder without a break; the number of steps.
fn complete(scene: &Scene, dir: &Path) -> u64 {
    let options = RunOptions { out: Some(dir.to_owned()), ..RunOptions::default() };
    let summary = run(scene, &options).expect("a run").summary;
    assert!(has_ended(summary.status), "{}: {:?}", scene.name, summary.message);
    summary.steps
}

/// Run a scene that writes `checkpoints` of its time, and stop it after this number of steps as if it had been killed.
fn broken_off(scene: &Scene, dir: &Path, checkpoints: f64, steps: u64) {
    let every = Some((scene.time.end - scene.time.start) / checkpoints);
    let options = RunOptions {
        out: Some(dir.to_owned()),
        checkpoints: Some(Checkpoints { every }),
        most_steps: Some(steps),
        ..RunOptions::default()
    };
    let summary = run(scene, &options).expect("a run").summary;
    assert_eq!(summary.status, Status::Failed);
}

/// Continue the run of a folder to its end, or until a later one.
fn resumed(dir: &Path, until: Option<f64>) {
    let resumable = Resumable::open(dir, until).unwrap_or_else(|error| panic!("{}: {error}", dir.display()));
    let every = resumable.checkpoint_interval();
    let options = RunOptions { checkpoints: Some(Checkpoints { every }), ..RunOptions::default() };
    let summary = resumable.resume(&options).unwrap_or_else(|error| panic!("{}: {error}", dir.display())).summary;
    assert!(has_ended(summary.status), "{:?}", summary.message);
}

fn summary_of(dir: &Path) -> Value {
    let text = fs::read_to_string(dir.join("summary.json")).expect("a summary");
    let mut summary: Value = serde_json::from_str(&text).expect("JSON");
    let table = summary.as_object_mut().expect("a table");
    VOLATILE.iter().for_each(|key| drop(table.remove(*key)));
    summary
}

/// The two folders hold the same run, to the bit.
fn assert_same(case: &str, one: &Path, other: &Path) {
    let (first, second) = (summary_of(one), summary_of(other));
    for (key, value) in first.as_object().expect("a table") {
        assert_eq!(Some(value), second.get(key), "{case}: {key}");
    }
    for file in ["series.csv", "scene.resolved.toml", "log.mcap"] {
        let [first, second] = [one, other].map(|dir| fs::read(dir.join(file)).expect("a file of the run"));
        assert!(first == second, "{case}: {file} differs: {} and {} bytes", first.len(), second.len());
    }
}

/// A run that is broken off after a share of its steps and continued on another number of threads has the bits of a run without a break.
fn continues(name: &str, sets: &[&str], share: f64, threads: [usize; 2]) {
    let (scene, place) = (scene_of(name, sets), TempDir::new().expect("a folder"));
    let [whole, parts] = ["whole", "parts"].map(|dir| place.path().join(dir));
    let steps = on_threads(threads[0], || complete(&scene, &whole));
    on_threads(threads[0], || broken_off(&scene, &parts, 7.0, (share * steps as f64) as u64));
    on_threads(threads[1], || resumed(&parts, None));
    assert_same(&format!("{name} {sets:?}"), &whole, &parts);
}
