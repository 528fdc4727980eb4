//! A process that is killed at any moment loses no more than what it computed since its checkpoint.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use temp_dir::TempDir;

use super::{assert_same, complete, scene_of};

const SCENE: &str = "dam_break";
const SETS: [&str; 3] = ["time.end=0.25", "resolution.spacing=0.025", "time.frame_every=0.005"];

/// Bytes by which a log has grown when the run is interrupted.
const SOME_FRAMES: u64 = 600_000;

fn start(arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_splashdown"));
    command.args(arguments).arg("--quiet").stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().expect("the program")
}

/// Wait until a file has been written this number of times, or the child has ended; no one of its checkpoints has the bytes of another.
fn wait_for(times: u32, file: &Path, child: &mut Child) {
    let content = || std::fs::read(file).ok();
    let (start, mut last, mut seen) = (Instant::now(), content(), 0);
    while seen < times && child.try_wait().expect("a child").is_none() {
        assert!(start.elapsed() < Duration::from_secs(60), "{} does not change", file.display());
        sleep(Duration::from_micros(500));
        let now = content();
        seen += u32::from(now != last);
        last = now;
    }
}

/// Killed again and again, each time after one checkpoint more and a little later in its step, the run ends with the bits of one without a
/// break.
#[test]
fn a_run_that_is_killed_again_and_again_has_the_same_bits() {
    let place = TempDir::new().expect("a folder");
    let [whole, parts] = ["whole", "parts"].map(|dir| place.path().join(dir));
    complete(&scene_of(SCENE, &SETS), &whole);
    let folder = parts.to_str().expect("a name");
    let sets: Vec<&str> = SETS.iter().flat_map(|set| ["--set", set]).collect();
    let first = [&["run", SCENE, "--out", folder, "--checkpoint-every", "0.002"][..], &sets].concat();
    let mut child = start(&first);
    let mut kills = 0;
    loop {
        wait_for(2 + kills, &parts.join("checkpoint.bin"), &mut child);
        sleep(Duration::from_micros(700) * kills);
        let ended = child.try_wait().expect("a child");
        if let Some(status) = ended {
            // a kill may come when all is written and the program has not ended yet: there is nothing to resume
            assert!(status.success() || parts.join("report.html").exists(), "{status}");
            break;
        }
        child.kill().expect("a child to kill");
        child.wait().expect("a child to wait for");
        kills += 1;
        child = start(&["resume", folder]);
    }
    assert!(kills > 2, "the run was killed {kills} times");
    assert_same(SCENE, &whole, &parts);
}

/// Ctrl-C writes a checkpoint, whether asked for checkpoints or not.
#[cfg(unix)]
#[test]
fn an_interrupted_run_continues() {
    let place = TempDir::new().expect("a folder");
    let [whole, parts] = ["whole", "parts"].map(|dir| place.path().join(dir));
    complete(&scene_of(SCENE, &SETS), &whole);
    let folder = parts.to_str().expect("a name");
    let sets: Vec<&str> = SETS.iter().flat_map(|set| ["--set", set]).collect();
    let mut child = start(&[&["run", SCENE, "--out", folder][..], &sets].concat());
    let mut interrupts = 0;
    loop {
        let size = || std::fs::metadata(parts.join("log.mcap")).map_or(0, |file| file.len());
        while size() < (interrupts + 1) * SOME_FRAMES && child.try_wait().expect("a child").is_none() {
            sleep(Duration::from_millis(1));
        }
        if child.try_wait().expect("a child").is_none() {
            let id = child.id().to_string();
            Command::new("kill").args(["-TERM", &id]).status().expect("the kill command");
        }
        if child.wait().expect("a child").success() {
            break;
        }
        assert!(parts.join("checkpoint.bin").exists(), "no checkpoint of an interrupted run");
        interrupts += 1;
        child = start(&["resume", folder]);
    }
    assert!(interrupts > 0, "the run was not interrupted");
    assert_same(SCENE, &whole, &parts);
}
