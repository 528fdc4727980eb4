//! What the commands share: exit codes, output, arguments that name a scene.

use std::io::Write;
use std::net::SocketAddr;
use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use run::RunError;
use run::memory::available_memory;
use scene::{Loaded, SceneError};
use serde::Serialize;
use settings::{Problem, convert};

/// Exit code: done.
pub(super) const DONE: u8 = 0;
/// Exit code: the run failed.
pub(super) const FAILED: u8 = 1;
/// Exit code: the input was wrong.
pub(super) const INPUT: u8 = 2;

/// How a command prints.
#[derive(Args)]
pub(super) struct Output {
    /// Print errors only.
    #[arg(long, global = true)]
    pub quiet: bool,
    /// Print machine-readable output on stdout.
    #[arg(long, global = true)]
    pub json: bool,
}

impl Output {
    /// Print a result: `value` as JSON with `--json`, else `text`.
    pub fn result(&self, value: &impl Serialize, text: &str) {
        match self.json {
            true => say(to_json(value)),
            false => say(text.trim_end()),
        }
    }

    /// Print progress on stderr, unless `--quiet`.
    pub fn progress(&self, text: std::fmt::Arguments<'_>) {
        if !self.quiet {
            complain(text);
        }
    }
}

/// Print a line on stdout; a reader that closed the pipe does not stop the command.
///
/// One that cannot take it, as a full disk, is reported at the end ([`unsaid`]).
pub(super) fn say(text: impl std::fmt::Display) {
    SAID.store(true, Ordering::Relaxed);
    if let Err(error) = writeln!(std::io::stdout(), "{text}")
        && error.kind() != std::io::ErrorKind::BrokenPipe
    {
        UNSAID.get_or_init(|| error.to_string());
    }
}

/// Whether a line was printed on stdout.
static SAID: AtomicBool = AtomicBool::new(false);

/// True once a line was printed on stdout: a second document of JSON would not be read.
pub(super) fn was_said() -> bool {
    SAID.load(Ordering::Relaxed)
}

/// Why a line could not be printed, the first time.
static UNSAID: OnceLock<String> = OnceLock::new();

/// What ends a command whose lines could not all be printed.
pub(super) fn unsaid() -> Option<String> {
    let left = std::io::stdout().flush().err().filter(|error| error.kind() != std::io::ErrorKind::BrokenPipe);
    UNSAID.get().cloned().or(left.map(|error| error.to_string()))
}

/// Print a line on stderr; a reader that is gone does not change the exit code.
pub(super) fn complain(text: impl std::fmt::Display) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Indented JSON.
pub(super) fn to_json(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value).unwrap_or_default()
}

/// Write a text file.
pub(super) fn write(path: &Path, text: &str) -> Result<(), Stop> {
    std::fs::write(path, text).map_err(|e| Stop::Failed(format!("cannot write {}: {e}", path.display())))
}

#[derive(Args, Clone)]
pub(super) struct SceneArgs {
    /// Name of a built-in scene, or path of a TOML file.
    pub scene: String,
    /// Override a key, e.g. --set body.deadrise_deg=20 (repeatable).
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub sets: Vec<String>,
}

#[derive(Args, Clone)]
pub(super) struct LiveArgs {
    /// Show the run to Foxglove or Lichtblick while it goes on, at ws://ADDRESS; a port alone, as --live=9123, is one of this machine.
    #[arg(long, value_name = "ADDRESS", num_args = 0..=1, default_missing_value = "127.0.0.1:8765", require_equals = true, value_parser = address)]
    pub live: Option<SocketAddr>,
}

/// The address of `--live`.
fn address(text: &str) -> Result<SocketAddr, String> {
    let port = text.strip_prefix("localhost").unwrap_or(text);
    if let Ok(port) = port.strip_prefix(':').unwrap_or(port).parse::<u16>() {
        return Ok(SocketAddr::from(([127, 0, 0, 1], port)));
    }
    text.parse().map_err(|_| "expected a port, or an address and a port: --live=9123, --live=0.0.0.0:9123".to_string())
}

/// A simulated time [s], with or without a unit.
pub(super) fn seconds(text: &str) -> Result<f64, String> {
    let said = |why: String| format!("expected a time in seconds, or one with a unit such as 30ms: {why}");
    text.trim().parse().or_else(|_| convert(text, "s").map_err(said))
}

/// Load a scene and refuse one that does not fit in memory.
pub(super) fn load(args: &SceneArgs) -> Result<Loaded, Stop> {
    let loaded = run::load(&args.scene, &args.sets)?;
    loaded.fits_in_memory(available_memory())?;
    Ok(loaded)
}

/// Why the process ends with a code other than 0.
pub(super) enum Stop {
    Scene(SceneError),
    /// A line of another file than a scene.
    Line(Box<Problem>),
    Input(String),
    Failed(String),
}

impl Stop {
    /// The error as an object of JSON: message, file, line, key, given, expected, help; null where there is none.
    pub fn to_json(&self) -> serde_json::Value {
        match self {
            Stop::Scene(error) => error.to_json(),
            Stop::Line(problem) => serde_json::json!({
                "message": problem.sentence, "file": problem.line.as_ref().map(|at| &at.file),
                "line": problem.line.as_ref().map(|at| at.line), "key": null, "given": problem.given,
                "expected": problem.expected, "help": null
            }),
            Stop::Input(message) | Stop::Failed(message) => serde_json::json!({
                "message": message, "file": null, "line": null, "key": null, "given": null, "expected": null, "help": null
            }),
        }
    }
}

impl From<SceneError> for Stop {
    fn from(error: SceneError) -> Stop {
        Stop::Scene(error)
    }
}

impl From<RunError> for Stop {
    fn from(error: RunError) -> Stop {
        if error.is_input() { Stop::Input(error.to_string()) } else { Stop::Failed(error.to_string()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_port_alone_is_one_of_this_machine() {
        for (given, wanted) in [
            ("9123", "127.0.0.1:9123"),
            (":9123", "127.0.0.1:9123"),
            ("localhost:9123", "127.0.0.1:9123"),
            ("0.0.0.0:9000", "0.0.0.0:9000"),
            ("[::1]:9000", "[::1]:9000"),
        ] {
            assert_eq!(address(given).map(|address| address.to_string()), Ok(wanted.to_string()));
        }
        for given in ["99999", "here", "127.0.0.1", ""] {
            assert!(address(given).is_err_and(|why| why.contains("--live=9123")), "{given}");
        }
    }

    #[test]
    fn times_are_seconds_or_have_a_unit() {
        assert_eq!([seconds("0.03"), seconds("30ms"), seconds("30 ms")], [Ok(0.03), Ok(0.03), Ok(0.03)]);
        assert!(seconds("30 m").is_err() && seconds("soon").is_err());
    }
}
