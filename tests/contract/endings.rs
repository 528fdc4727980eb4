//! However a run ends, what it has written can be read.

use crate::command::{Ended, Workplace, binary, read_log};

/// A run that takes long and writes a frame every few steps.
const LONG: [&str; 6] =
    ["run", "wedge_constant", "--set", "resolution.spacing=0.02", "--set", "time.frame_every=0.002"];
const OUT: [&str; 3] = ["--out", "out", "--quiet"];
/// Bytes that a log has grown to once it holds some frames of that run.
const SOME_FRAMES: u64 = 500_000;

/// Killed without a chance to tidy up, a run leaves a log whose whole chunks a reader without need of a summary reads.
#[test]
fn a_killed_run_leaves_a_log_that_can_be_read() {
    let place = Workplace::new();
    let mut child = place.start_until(&[&LONG[..], &OUT].concat(), "out/log.mcap", SOME_FRAMES);
    child.kill().expect("a child to kill");
    let ended = Ended::from(child.wait_with_output().expect("a child to wait for"));
    #[cfg(unix)]
    assert_eq!(ended.code, None, "the run ended by itself: {}", ended.message);
    let log = read_log(&place.read("out/log.mcap"));
    assert!(log.fluid_frames >= 1, "no frame of the fluid can be read");
    assert!(!log.complete, "the run was killed after its end");
    let series = place.text("out/series.csv");
    assert!(series.starts_with("time_s,") && series.lines().count() > 1, "{series}");
    assert!(!place.path("out/summary.json").exists(), "a killed run has no summary");
}

/// Ctrl-C ends a run cleanly: exit 1, status "interrupted", all files there, the log complete.
#[cfg(unix)]
#[test]
fn an_interrupted_run_finishes_its_files() {
    let place = Workplace::new();
    let child = place.start_until(&[&LONG[..], &OUT].concat(), "out/log.mcap", SOME_FRAMES);
    let id = child.id().to_string();
    let sent = std::process::Command::new("kill").args(["-INT", &id]).status().expect("the kill command");
    assert!(sent.success(), "no signal was sent");
    let ended = Ended::from(child.wait_with_output().expect("a child to wait for"));
    assert_eq!(ended.code, Some(1), "{}", ended.message);
    ended.says(&["interrupted at t = "]);
    let summary = place.summary("out");
    assert_eq!(summary["status"], "interrupted");
    let time = summary["time_end_s"].as_f64().expect("a number");
    assert!(time > -0.1 && time < 1.0, "{time} s");
    let log = read_log(&place.read("out/log.mcap"));
    assert!(log.complete && log.fluid_frames > 1);
    assert!(log.notes.iter().any(|note| contains(note, "interrupted")), "the log does not say why it ends");
    for file in ["series.csv", "scene.resolved.toml", "report.html"] {
        assert!(!place.read(&format!("out/{file}")).is_empty(), "{file}");
    }
}

/// A run that breaks down numerically (Verlet's leapfrog without its Euler step, LE3) says which particle, where and when; its
/// log is complete, shows the state that broke, and says the same.
#[test]
fn a_run_that_breaks_down_reports_what_where_and_when() {
    let place = Workplace::new();
    let leapfrog = ["--set", "fluid.integrator=verlet", "--set", "fluid.verlet_correction_every=0"];
    let sets = [&["run", "wedge_constant", "--set", "resolution.spacing=0.1"], &leapfrog[..]].concat();
    let ended = place.run(&[&sets[..], &OUT].concat());
    assert_eq!(ended.code, Some(1), "{}", ended.message);
    ended.says(&["particle ", " at (", ") m ", " at t = "]);
    let summary = place.summary("out");
    assert_eq!(summary["status"], "failed");
    let message = summary["message"].as_str().expect("a message");
    assert!(ended.message.contains(message), "{message:?} is not {:?}", ended.message);
    let log = read_log(&place.read("out/log.mcap"));
    assert!(log.complete && log.fluid_frames > 1);
    assert!(log.notes.iter().any(|note| contains(note, message)), "the log does not say what broke");
    assert!(place.text("out/report.html").contains("particle"));
}

/// A pressure equation that no shorter step makes converge (THEORY LS11, CO26: three iterations for a tolerance of 1e-12) gives the residual
/// that it reached, in which particle, where and when; the log is complete, holds the state before, and says the same.
#[test]
fn a_pressure_that_does_not_converge_fails_with_the_log_intact() {
    let place = Workplace::new();
    let strict = ["--set", "projection.tolerance=1e-12", "--set", "projection.most_iterations=3"];
    let scene = ["run", "unlevel_tank", "--set", "solver=incompressible", "--set", "resolution.spacing=0.05"];
    let ended = place.run(&[&scene[..], &strict, &OUT].concat());
    assert_eq!(ended.code, Some(1), "{}", ended.message);
    // a solve, one from no pressure, one of four times as many iterations
    ended.says(&["did not converge at t = 0", "after 18 iterations", "1.0e-12 was asked", "at particle ", " at ("]);
    let summary = place.summary("out");
    assert_eq!(summary["status"], "failed");
    assert_eq!(summary["steps"], 0);
    let message = summary["message"].as_str().expect("a message");
    assert!(ended.message.contains(message), "{message:?} is not {:?}", ended.message);
    let log = read_log(&place.read("out/log.mcap"));
    assert!(log.complete && log.fluid_frames >= 1);
    assert!(log.notes.iter().any(|note| contains(note, message)), "the log does not say what failed");
    assert!(place.text("out/report.html").contains("did not converge"));
}

/// A disk that takes no more (a limit on the size of files) ends the run with exit 1 and the file's name; what is in the log can be
/// read.
#[cfg(unix)]
#[test]
fn a_full_disk_ends_the_run() {
    let place = Workplace::new();
    // 512 or 1024 bytes a block, as the shell has it: less than three frames in either case
    let limited = "trap '' XFSZ; ulimit -f 1200; exec \"$0\" \"$@\"";
    let output = std::process::Command::new("sh")
        .args(["-c", limited])
        .arg(binary())
        .args(LONG)
        .args(OUT)
        .current_dir(place.path("."))
        .output()
        .expect("a shell");
    let ended = Ended::from(output);
    assert_eq!(ended.code, Some(1), "{}", ended.message);
    ended.says(&["cannot write the log", "log.mcap", "File too large"]);
    let log = read_log(&place.read("out/log.mcap"));
    assert!(log.fluid_frames >= 1 && !log.complete, "{} frames", log.fluid_frames);
}

/// `--log-budget` keeps the log small with fewer frames, the last one among them, and the summary says how many are missing.
#[test]
fn a_budget_keeps_the_log_small() {
    let place = Workplace::new();
    let tank = ["run", "hydrostatic_tank", "--set", "resolution.spacing=0.02", "--set", "time.end=0.1"];
    let ended = place.run(&[&tank[..], &["--log-budget", "1.5"], &OUT].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let (summary, bytes) = (place.summary("out"), place.read("out/log.mcap"));
    let log = read_log(&bytes);
    assert!(log.complete && bytes.len() <= 1_500_000, "{} bytes", bytes.len());
    assert_eq!(summary["log"]["bytes"], bytes.len());
    assert_eq!(summary["log"]["frames"], log.fluid_frames);
    assert_eq!(summary["log"]["budget_megabytes"], 1.5);
    let left_out = summary["log"]["frames_left_out"].as_u64().expect("a count");
    assert!(left_out > 10 && log.fluid_frames >= 3, "{left_out} left out, {} kept", log.fluid_frames);
    assert!(place.text("out/scene.resolved.toml").contains("log_budget = 1.5"));
    let refused = place.run(&[&tank[..], &["--log-budget", "0"], &OUT].concat());
    assert_eq!(refused.code, Some(2), "{}", refused.message);
    refused.says(&["report.log_budget", "above 0"]);
}

fn contains(bytes: &[u8], text: &str) -> bool {
    bytes.windows(text.len()).any(|window| window == text.as_bytes())
}
