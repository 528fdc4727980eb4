//! The local engine: a few processes at a time, each with its share of the threads.

use std::fs::{self, File};
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::{Child, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use std::{io, thread};

use super::error::SweepError;
use super::folder::{KILLED, Outcome, PointFolder, State, SweepFolder};
use super::plan::Resolved;
use super::program::Program;
use super::worker::run_point;

/// How many processes are started for a point; it has failed when all of them have died.
const ATTEMPTS: usize = 2;
/// The line sent to a process's standard input to make it end after the present step.
pub const STOP: &str = "stop";
/// A process that did not stop at that line is killed after this time.
const GRACE: Duration = Duration::from_secs(20);

/// A pool of processes.
pub struct Pool<'a> {
    /// The sweep.
    pub folder: &'a SweepFolder,
    /// This program.
    pub program: Program,
    /// Processes at the same time.
    pub jobs: usize,
    /// Threads of each.
    pub threads: usize,
    /// Keep neither pages nor logs, and run theories without a process.
    pub lean: bool,
    /// Set from outside to end all processes.
    pub stop: &'a AtomicBool,
    /// Receives the id of each point that ended and how; `None` for one that was stopped.
    pub ended: &'a (dyn Fn(&str, Option<&Outcome>) + Sync),
}

impl Pool<'_> {
    /// Run the points of these ids until each has an outcome, or until stopped.
    ///
    /// # Errors
    /// No process can be started, or the disk refuses; points that failed are no error.
    pub fn run(&self, ids: &[&str]) -> Result<(), SweepError> {
        let next = AtomicUsize::new(0);
        let work = || {
            while let Some(id) = ids.get(next.fetch_add(1, Ordering::Relaxed)) {
                if self.stop.load(Ordering::Relaxed) {
                    return Ok(());
                }
                let outcome = self.run_point(id)?;
                (self.ended)(id, outcome.as_ref());
            }
            Ok(())
        };
        thread::scope(|scope| {
            let slots: Vec<_> = (0..self.jobs.min(ids.len())).map(|_| scope.spawn(work)).collect();
            let gone = |_| Err(SweepError::Failed("a thread of the coordinator ended early".into()));
            slots.into_iter().try_for_each(|slot| slot.join().unwrap_or_else(gone))
        })
    }

    /// Run a point, again if its process dies; wait for one that a process of an earlier coordinator still runs.
    fn run_point(&self, id: &str) -> Result<Option<Outcome>, SweepError> {
        let point = self.folder.point(id);
        let mut pause = Pause::default();
        while point.is_locked() {
            if self.stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            pause.wait();
        }
        if let State::Ended(outcome) = point.state() {
            return Ok(Some(outcome));
        }
        point.reopen()?;
        if self.lean
            && let Some(outcome) = self.here(id, &point)
        {
            return Ok(Some(outcome));
        }
        let start = Instant::now();
        let mut message = String::new();
        for _ in 0..ATTEMPTS {
            let ended = self.process(id, &point)?;
            if let Some(outcome) = point.outcome() {
                return Ok(Some(outcome));
            }
            if self.stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            message = format!("its process ended {ATTEMPTS} times without a result ({ended}){}", first_words(&point));
        }
        let wall_time_s = start.elapsed().as_secs_f64();
        let outcome = Outcome { status: KILLED.into(), message: Some(message), wall_time_s, threads: self.threads };
        point.end(&outcome)?;
        Ok(Some(outcome))
    }

    /// Run a theory, whose run is shorter than the start of a process, in this one. `None` for particles, and where it fails: then a
    /// process of its own says why.
    fn here(&self, id: &str, point: &PointFolder) -> Option<Outcome> {
        match point.task().ok()?.resolve().ok()? {
            Resolved::Scene(loaded) if loaded.scene.model.is_theory() => (),
            _ => return None,
        }
        let run = || run_point(self.folder, id, u64::MAX, true, self.stop, &AtomicBool::new(false));
        catch_unwind(AssertUnwindSafe(run)).ok()?.ok()?
    }

    /// Starts a process and waits for its end; where it must stop, it ends after the present step.
    fn process(&self, id: &str, point: &PointFolder) -> Result<ExitStatus, SweepError> {
        let path = point.file("stderr.txt");
        let stderr = File::create(&path).map_err(|e| SweepError::write(&path, e))?;
        let mut command = self.program.command();
        command.arg("sweep").arg(self.folder.path()).args([
            "--point",
            id,
            "--threads",
            &self.threads.to_string(),
            "--quiet",
        ]);
        command.args(self.lean.then_some("--lean"));
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(stderr);
        let program = &self.program;
        let mut child = command.spawn().map_err(|e| SweepError::Failed(format!("cannot start {program}: {e}")))?;
        let ended = self.wait(&mut child).map_err(|e| SweepError::Failed(format!("cannot wait for {program}: {e}")))?;
        if fs::metadata(&path).is_ok_and(|file| file.len() == 0) {
            let _ = fs::remove_file(&path); // an empty file says nothing
        }
        Ok(ended)
    }

    fn wait(&self, child: &mut Child) -> io::Result<ExitStatus> {
        let mut stopped: Option<Instant> = None;
        let mut pause = Pause::default();
        loop {
            if let Some(ended) = child.try_wait()? {
                return Ok(ended);
            }
            match stopped {
                None if self.stop.load(Ordering::Relaxed) => {
                    stopped = Some(Instant::now());
                    if let Some(stdin) = &mut child.stdin {
                        let _ = writeln!(stdin, "{STOP}"); // it may have ended meanwhile
                    }
                }
                Some(since) if since.elapsed() > GRACE => child.kill()?,
                _ => {}
            }
            pause.wait();
        }
    }
}

/// Waiting that costs little: short at first, for short runs.
struct Pause(Duration);

impl Default for Pause {
    fn default() -> Pause {
        Pause(Duration::from_micros(200))
    }
}

impl Pause {
    fn wait(&mut self) {
        thread::sleep(self.0);
        self.0 = self.0.mul_f64(1.05).min(Duration::from_millis(10));
    }
}

/// What a process wrote on stderr first.
fn first_words(point: &PointFolder) -> String {
    const LINES: usize = 3;
    let text = fs::read(point.file("stderr.txt")).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty()).take(LINES);
    match lines.collect::<Vec<_>>().join(" ") {
        text if text.is_empty() => text,
        text => format!(": {text}"),
    }
}
