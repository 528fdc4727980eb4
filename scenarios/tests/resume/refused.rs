//! What cannot be resumed is refused, with what was found and what is expected; nothing is changed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use temp_dir::TempDir;

use super::{broken_off, complete, scene_of};

/// A folder with a run that can be resumed.
fn broken(place: &TempDir) -> PathBuf {
    let scene = scene_of("dam_break", &["time.end=0.02", "resolution.spacing=0.06"]);
    let dir = place.path().join("run");
    let steps = complete(&scene, &place.path().join("whole"));
    broken_off(&scene, &dir, 3.0, steps - 1);
    dir
}

/// The message of a resume that is refused as wrong input.
fn refusal(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_splashdown")).arg("resume").args(arguments).output();
    let output = output.expect("the program");
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {text}");
    assert!(!text.contains("panicked"), "{text}");
    text
}

fn assert_says(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "no {part:?} in {message:?}");
    }
}

fn name(path: &Path) -> &str {
    path.to_str().expect("a name")
}

#[test]
fn a_damaged_checkpoint_is_refused_by_name() {
    let place = TempDir::new().expect("a folder");
    let dir = broken(&place);
    let file = dir.join("checkpoint.bin");
    let bytes = fs::read(&file).expect("a checkpoint");
    for part in 0..20 {
        fs::write(&file, &bytes[..bytes.len() * part / 20]).expect("a file");
        assert_says(&refusal(&[name(&dir)]), &["checkpoint.bin", "expected"]);
    }
    for part in 0..20 {
        let mut other = bytes.clone();
        other[(bytes.len() - 1) * part / 19] ^= 0x10;
        fs::write(&file, other).expect("a file");
        assert_says(&refusal(&[name(&dir)]), &["checkpoint.bin", "expected"]);
    }
    for header in 0..30 {
        let mut other = bytes.clone();
        other[header] ^= 0xff;
        fs::write(&file, other).expect("a file");
        assert_says(&refusal(&[name(&dir)]), &["checkpoint.bin", "expected"]);
    }
    fs::write(&file, [&bytes[..], &[0]].concat()).expect("a file");
    assert_says(&refusal(&[name(&dir)]), &["checkpoint.bin", "expected"]);
    let mut newer = bytes.clone();
    newer[8] = 9;
    fs::write(&file, newer).expect("a file");
    assert_says(&refusal(&[name(&dir)]), &["checkpoint.bin has format 9", "expected format 4"]);
    fs::write(&file, "time_s,x_m\n").expect("a file");
    assert_says(&refusal(&[name(&dir)]), &["is not a checkpoint of splashdown"]);
    fs::remove_file(&file).expect("a file");
    assert_says(&refusal(&[name(&dir)]), &["checkpoint.bin", "--checkpoint-every"]);
    fs::write(&file, bytes).expect("a file");
    super::resumed(&dir, None);
}

#[test]
fn other_files_that_do_not_fit_are_refused() {
    let place = TempDir::new().expect("a folder");
    let dir = broken(&place);
    let [scene, log] = ["scene.resolved.toml", "log.mcap"].map(|file| dir.join(file));
    let text = fs::read_to_string(&scene).expect("a scene");
    for (other, said) in [
        (text.replace("density = 1000.0", "density = 1025.0"), "is not the scene of checkpoint.bin"),
        ("not a scene".into(), "expected the scene as the run wrote it"),
    ] {
        assert_ne!(other, text);
        fs::write(&scene, other).expect("a file");
        assert_says(&refusal(&[name(&dir)]), &["scene.resolved.toml", said]);
    }
    fs::write(&scene, text).expect("a file");
    let bytes = fs::read(&log).expect("a log");
    for part in 0..5 {
        fs::write(&log, &bytes[..bytes.len() * part / 20]).expect("a file");
        assert_says(&refusal(&[name(&dir)]), &["log.mcap"]);
    }
    fs::remove_file(&log).expect("a file");
    assert_says(&refusal(&[name(&dir)]), &["log.mcap"]);
    fs::write(&log, bytes).expect("a file");
    assert!(!dir.join("log.mcap.part").exists());
    super::resumed(&dir, None);
}

#[test]
fn ends_and_intervals_that_make_no_sense_are_refused() {
    let place = TempDir::new().expect("a folder");
    let dir = broken(&place);
    for until in ["0.001", "-1", "nan", "inf"] {
        let until = format!("--until={until}");
        assert_says(&refusal(&[name(&dir), &until]), &["--until", "expected a time after t ="]);
    }
    for every in ["0", "-1", "nan", "inf"] {
        let every = format!("--checkpoint-every={every}");
        assert_says(&refusal(&[name(&dir), &every]), &["--checkpoint-every", "expected a simulated time above 0 s"]);
    }
    assert_says(&refusal(&[name(place.path())]), &["checkpoint.bin"]);
    super::resumed(&dir, None);
}

/// A theory has no steps; a forced run removes the checkpoint of the one before.
#[test]
fn checkpoints_belong_to_runs_of_particles() {
    let place = TempDir::new().expect("a folder");
    let dir = broken(&place);
    let program = || Command::new(env!("CARGO_BIN_EXE_splashdown"));
    let theory = ["run", "wedge", "--set", "model=wagner", "--checkpoint-every", "0.1", "--out"];
    let said = program().args(theory).arg(place.path().join("theory")).output().expect("the program");
    assert_eq!(said.status.code(), Some(2));
    assert_says(&String::from_utf8_lossy(&said.stderr), &["model = \"wagner\" has no steps"]);
    let forced = ["run", "wedge", "--set", "model=wagner", "--force", "--quiet", "--out", name(&dir)];
    assert!(program().args(forced).status().expect("the program").success());
    assert!(!dir.join("checkpoint.bin").exists());
}

/// 30 for 30 ms of a run of 20 ms is an hour of computing.
#[test]
fn an_end_in_milliseconds_is_refused_without_force() {
    let place = TempDir::new().expect("a folder");
    let dir = broken(&place);
    let parts = ["--until 30: expected at most 2 s", "100 times the end so far, 0.02 s", "--until 30ms", "--force"];
    assert_says(&refusal(&[name(&dir), "--until", "30"]), &parts);
    assert_says(&refusal(&[name(&dir), "--until", "1e30"]), &["--force"]);
    assert_says(&refusal(&[name(&dir), "--until", "1e30", "--force"]), &["expected a time after t ="]);
    assert_says(&refusal(&[name(&dir), "--until", "3 m"]), &["--until", "another quantity"]);
    assert_says(&refusal(&[name(&dir), "--force"]), &["--until"]);
    super::resumed(&dir, None);
}
