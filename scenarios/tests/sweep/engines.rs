//! The scripts of other engines.

use std::process::Command;

use super::Place;

const DROPS: &str = "scene = \"wedge\"\n[set]\nmodel = \"wagner\"\ntime.end = 0.01\n[grid]\nbody.deadrise_deg = { from = 20, to = 40, count = 5 }\n";

/// The array script has the shape that Slurm and bash expect, and runs the points as Slurm would start it.
#[cfg(unix)]
#[test]
fn the_array_script_runs_the_points() {
    let place = Place::new(DROPS);
    let (code, said, message) = place.sweep(&["--engine", "slurm", "--jobs", "1", "--threads", "2"]);
    assert_eq!((code, &said["to_run"]), (Some(0), &5.into()), "{message}");
    let script = place.text("out/slurm.sh");
    assert!(script.starts_with("#!/bin/bash\n#SBATCH --job-name=drops\n#SBATCH --array=1-5\n"), "{script}");
    assert!(script.contains("#SBATCH --cpus-per-task=2\n"), "{script}");
    let bash = |arguments: &[&str]| Command::new("bash").args(arguments).arg(place.path("out/slurm.sh")).status();
    assert!(bash(&["-n"]).expect("bash").success());
    for task in 1..=5 {
        let mut command = Command::new("bash");
        command.arg(place.path("out/slurm.sh")).env("SLURM_ARRAY_TASK_ID", task.to_string());
        assert!(command.status().expect("bash").success());
        assert_eq!(place.points_with("point.json").len(), task);
    }
    let (code, said, message) = place.sweep(&[]);
    assert_eq!((code, &said["done"], &said["run"]), (Some(0), &5.into(), &0.into()), "{message}");
}

/// Without the Python module the engine says what to install.
#[cfg(unix)]
#[test]
fn hyperqueue_is_asked_for_where_it_is_missing() {
    let place = Place::new(DROPS);
    let mut command = place.command(&["drops.toml", "--out", "out", "--engine", "hyperqueue"]);
    let ended = command.env("PATH", "/nowhere").output().expect("the command starts");
    assert_eq!(ended.status.code(), Some(2));
    let message = String::from_utf8_lossy(&ended.stderr).into_owned();
    assert!(message.contains("pip install hyperqueue=="), "{message}");
}
