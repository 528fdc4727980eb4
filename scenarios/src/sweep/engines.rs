//! Engines beside the local pool: HyperQueue by a driver script, Slurm by an array script.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::error::SweepError;
use super::folder::{KILLED, Outcome, SweepFolder, json};
use super::program::Program;

/// Version of the PyPI package that the driver was written for.
const PACKAGE: &str = "hyperqueue==0.27.0";
/// Exit code of the driver when tasks have failed.
const TASKS_FAILED: i32 = 3;
/// Most tasks of an array: Slurm's MaxArraySize is 1001 where it is not set.
const MOST_TASKS: usize = 1000;

/// What an engine is given.
pub struct Engine<'a> {
    /// The sweep.
    pub folder: &'a SweepFolder,
    /// This program.
    pub program: Program,
    /// Processes at the same time.
    pub jobs: usize,
    /// Threads of each.
    pub threads: usize,
}

impl Engine<'_> {
    /// Write `run_hyperqueue.py` and `commands.json`, run the points by them, and return when all have ended.
    ///
    /// # Errors
    /// `python3` cannot import the module, or the driver fails; points that failed are no error.
    pub fn hyperqueue(&self, ids: &[&str]) -> Result<(), SweepError> {
        let python = || Command::new("python3");
        let module = python().args(["-c", "import hyperqueue"]).stdin(Stdio::null()).stderr(Stdio::null()).status();
        if !module.is_ok_and(|status| status.success()) {
            return Err(SweepError::Input(format!(
                "--engine hyperqueue: python3 cannot import hyperqueue: expected `python3 -m pip install {PACKAGE}`, or a python3 \
                 on PATH that has it"
            )));
        }
        let path = self.folder_path()?;
        let command = |id: &&str| {
            let own = ["sweep".into(), path.to_string_lossy().into_owned(), "--point".into()];
            let threads = self.threads.to_string();
            let words = self.program.words().into_iter().chain(own);
            words.chain([id.to_string(), "--threads".into(), threads, "--quiet".into()]).collect::<Vec<_>>()
        };
        let commands: Vec<Vec<String>> = ids.iter().map(command).collect();
        self.folder.write("commands.json", &json(&commands))?;
        self.folder.write("run_hyperqueue.py", include_str!("run_hyperqueue.py"))?;
        let mut driver = python();
        driver.arg(path.join("run_hyperqueue.py")).arg(path.join("commands.json"));
        driver.args([(self.jobs * self.threads).to_string(), self.threads.to_string()]);
        driver.current_dir(&path).stdin(Stdio::null()).stdout(Stdio::null());
        let ended = driver.status().map_err(|e| SweepError::Failed(format!("cannot start python3: {e}")))?;
        match ended.code() {
            Some(0 | TASKS_FAILED) => {}
            _ => {
                return Err(SweepError::Failed(format!(
                    "{}: the driver failed ({ended})",
                    path.join("run_hyperqueue.py").display()
                )));
            }
        }
        for id in ids {
            let point = self.folder.point(id);
            if point.outcome().is_none() {
                let message = Some("its process ended without a result under HyperQueue".into());
                point.end(&Outcome { status: KILLED.into(), message, wall_time_s: 0.0, threads: self.threads })?;
            }
        }
        Ok(())
    }

    /// Write `slurm.sh` and `ids.txt`; the script to submit.
    ///
    /// # Errors
    /// The disk's.
    pub fn slurm(&self, name: &str, ids: &[&str]) -> Result<PathBuf, SweepError> {
        let path = self.folder_path()?;
        let per_task = ids.len().div_ceil(MOST_TASKS).max(1);
        let text = format!(
            include_str!("slurm.sh"),
            name = word(name),
            tasks = ids.len().div_ceil(per_task).max(1),
            threads = self.threads,
            folder = path.display(),
            points = ids.len(),
            per_task = per_task,
            program = self.program.words().iter().map(|word| quoted(Path::new(word))).collect::<Vec<_>>().join(" "),
            quoted_folder = quoted(&path),
            ids = quoted(&path.join("ids.txt")),
        );
        self.folder.write("ids.txt", &ids.iter().map(|id| format!("{id}\n")).collect::<String>())?;
        self.folder.write("slurm.sh", &text)?;
        Ok(path.join("slurm.sh"))
    }

    /// The sweep's folder from the root.
    fn folder_path(&self) -> Result<PathBuf, SweepError> {
        let path = self.folder.path();
        std::fs::canonicalize(path).map_err(|e| SweepError::write(path, e))
    }
}

/// A path as a word of the shell.
fn quoted(path: &Path) -> String {
    format!("'{}'", path.to_string_lossy().replace('\'', "'\\''"))
}

/// A name without what Slurm or the shell could take otherwise.
fn word(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() || c == '_' || c == '-' { c } else { '_' }).collect()
}
