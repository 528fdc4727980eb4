//! A finished run goes on to a later end, with the bits of a run that always had that end.

use std::fs;
use std::path::Path;

use run::{Checkpoints, Resumable, RunOptions, run};
use scene::Scene;
use temp_dir::TempDir;

use super::{assert_same, complete, resumed, scene_of};

/// Run to the scene's end, then to `later`; compare with a run of the resolved scene to there.
fn goes_on(name: &str, sets: &[&str], later: f64) {
    let place = TempDir::new().expect("a folder");
    let [whole, parts] = ["whole", "parts"].map(|dir| place.path().join(dir));
    let scene = scene_of(name, sets);
    let checkpoints = Some(Checkpoints { every: Some(scene.time.end) });
    let options = RunOptions { out: Some(parts.clone()), checkpoints, ..RunOptions::default() };
    let summary = run(&scene, &options).expect("a run").summary;
    assert!(summary.status.is_completed());
    let refused = Resumable::open(&parts, None).expect("a checkpoint").resume(&RunOptions::default());
    let said = refused.err().expect("a run without an end to go on to").to_string();
    assert!(said.contains("expected --until with a later time"), "{said}");
    resumed(&parts, Some(later));
    let resolved = fs::read_to_string(parts.join("scene.resolved.toml")).expect("a resolved scene");
    let longer = Scene::from_toml(&resolved).expect("a scene");
    assert_eq!(longer.time.end, later);
    complete(&longer, &whole);
    assert_same(&format!("{name} {sets:?}"), &whole, &parts);
}

#[test]
fn a_finished_run_goes_on() {
    goes_on("dam_break", &["time.end=0.03", "resolution.spacing=0.05"], 0.05);
    goes_on("sloshing", &["time.end=0.05", "resolution.spacing=0.08", "time.sample_every=0.007"], 0.08);
}

/// The zone of fine water and the similarity window go with the end.
#[test]
fn an_impact_goes_on_deeper() {
    goes_on("wedge_constant", &["resolution.spacing=0.1", "time.end=0.45"], 0.5);
    goes_on("wedge_constant", &["resolution.spacing=0.1", "time.end=0.3", "resolution.follow=false"], 0.5);
    goes_on("floating_box", &["time.end=0.03", "resolution.spacing=0.033", "solver=incompressible"], 0.05);
}

/// A resolved scene is read back as it was, whatever it has: the checkpoint knows it by its text.
#[test]
fn every_resolved_scene_is_read_back() {
    for (name, _) in scene::builtin() {
        let text = scene_of(name, &[]).to_toml();
        let back = Scene::from_toml(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(back.to_toml(), text, "{name}");
    }
}

/// A run of the same scene, whatever became of its folder's files after the checkpoint, is whole again.
#[test]
fn files_that_went_on_are_cut_back() {
    let place = TempDir::new().expect("a folder");
    let [whole, parts] = ["whole", "parts"].map(|dir| place.path().join(dir));
    let scene = scene_of("dam_break", &["time.end=0.03", "resolution.spacing=0.05"]);
    let steps = complete(&scene, &whole);
    super::broken_off(&scene, &parts, 3.0, steps - 1);
    let append = |file: &str, text: &[u8]| {
        let path: &Path = &parts.join(file);
        let bytes = [&fs::read(path).expect("a file")[..], text].concat();
        fs::write(path, bytes).expect("a file");
    };
    append("series.csv", b"1,2,3\n4,");
    append("log.mcap", &[7; 100]);
    resumed(&parts, None);
    assert_same("dam_break", &whole, &parts);
}

/// A later end may need more water, or a finer one: what is doubtful then is a warning, and in the summary.
#[test]
fn warnings_are_those_of_the_later_end() {
    let place = TempDir::new().expect("a folder");
    let dir = place.path().join("run");
    let scene = scene_of("wedge", &["resolution.spacing=0.02", "time.end=0.002", "compare=[]"]);
    let checkpoints = Some(Checkpoints { every: Some(scene.time.end) });
    let warnings = vec!["a warning of the command line".to_string()];
    run(&scene, &RunOptions { out: Some(dir.clone()), checkpoints, warnings, ..RunOptions::default() }).expect("a run");
    let said = |run: &Resumable| run.warnings().join("\n");
    let later = Resumable::open(&dir, Some(0.02)).expect("a checkpoint");
    assert!(said(&later).contains("the echo from the tank's walls"), "{}", said(&later));
    assert!(said(&later).contains("a warning of the command line"), "{}", said(&later));
    drop(later);
    let mut program = std::process::Command::new(env!("CARGO_BIN_EXE_splashdown"));
    let output = program.arg("resume").arg(&dir).args(["--until", "4ms"]).output().expect("the program");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && stderr.contains("WARN"), "{stderr}");
    let summary = fs::read_to_string(dir.join("summary.json")).expect("a summary");
    let echo = "the echo from the tank's walls";
    assert!(stderr.contains(echo) && summary.contains(echo), "{stderr}");
}
