//! `splashdown sweep`: points, tables, and what happens to them when processes die.

mod engines;
mod killed;
mod refused;
mod table;

use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};
use std::{fs, thread};

use serde_json::Value;
use temp_dir::TempDir;

/// Longest wait for anything.
const PATIENCE: Duration = Duration::from_secs(60);

/// A folder with a sweep file.
struct Place(TempDir);

impl Place {
    fn new(sweep: &str) -> Place {
        let place = Place(TempDir::new().expect("a temporary folder"));
        place.write("drops.toml", sweep);
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("a file");
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// The command, not started.
    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_splashdown"));
        command.arg("sweep").args(arguments).current_dir(self.0.path()).stdin(Stdio::null());
        command
    }

    /// `splashdown sweep drops.toml --out out` with more arguments: exit code, JSON of stdout, stderr.
    fn sweep(&self, arguments: &[&str]) -> (Option<i32>, Value, String) {
        let all = [&["drops.toml", "--out", "out", "--json"], arguments].concat();
        let Output { status, stdout, stderr } = self.command(&all).output().expect("the command starts");
        let value = serde_json::from_slice(&stdout).unwrap_or_default();
        (status.code(), value, String::from_utf8_lossy(&stderr).into_owned())
    }

    /// Folders of points that hold a file.
    fn points_with(&self, file: &str) -> Vec<PathBuf> {
        let entries = fs::read_dir(self.path("out/points")).map(|entries| entries.flatten().collect::<Vec<_>>());
        let folders = entries.unwrap_or_default().into_iter().map(|entry| entry.path());
        folders.filter(|folder| folder.join(file).exists()).collect()
    }
}

/// Wait until something holds.
fn wait_until(what: &str, holds: impl Fn() -> bool) {
    let start = Instant::now();
    while !holds() {
        assert!(start.elapsed() < PATIENCE, "{what}: not within {PATIENCE:?}");
        thread::sleep(Duration::from_millis(5));
    }
}

/// A table of CSV without quoted cells: heading and rows.
fn csv(text: &str) -> (Vec<&str>, Vec<Vec<&str>>) {
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    (rows.next().expect("a heading"), rows.collect())
}
