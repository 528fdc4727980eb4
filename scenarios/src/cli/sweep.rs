//! `splashdown sweep`.

mod point;
mod report;

use std::ffi::OsString;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use super::shared::{DONE, Output, Stop, to_json};
use point::{IMPATIENT, INTERRUPTED_CODE};

use crate::sweep::engines::Engine;
use crate::sweep::pool::Pool;
use crate::sweep::{
    Collected, Outcome, Plan, Program, Progress, State, SweepError, SweepFile, SweepFolder, write_results,
};

/// Interval between lines of progress where no bar is drawn.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// What runs the points.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum EngineName {
    /// Processes of this machine.
    Local,
    /// HyperQueue (PyPI package hyperqueue), by the script run_hyperqueue.py in the folder.
    Hyperqueue,
    /// Write an array script for Slurm's sbatch; nothing is run.
    Slurm,
}

#[derive(Args)]
pub(super) struct SweepArgs {
    /// The sweep file, or the folder of a sweep that was started.
    sweep: PathBuf,
    /// Folder for the sweep's files (default: runs/NAME_sweep).
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Processes at the same time (default: one for each core). Each has its share of the threads.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Say how far the sweep is, and run nothing.
    #[arg(long)]
    status: bool,
    /// Continue a sweep, which the folder must hold. (Without this option too, points that have ended are not run again.)
    #[arg(long, conflicts_with = "force")]
    resume: bool,
    /// Run points that have ended again.
    #[arg(long)]
    force: bool,
    /// Keep the table and each point's numbers and curves, but neither pages nor logs; points by a theory start no process.
    /// `splashdown report DIR/points/ID` makes a page later.
    #[arg(long)]
    lean: bool,
    /// What runs the points.
    #[arg(long, value_enum, default_value_t = EngineName::Local)]
    engine: EngineName,
    /// Run one point of a planned sweep, in the folder DIR/points/ID: what the engines start.
    #[arg(long, value_name = "ID", conflicts_with_all = ["out", "jobs", "status", "resume", "force", "engine"])]
    point: Option<String>,
}

impl From<SweepError> for Stop {
    fn from(error: SweepError) -> Stop {
        match error {
            SweepError::Scene(error) => error.into(),
            SweepError::Input(text) => Stop::Input(text),
            other => Stop::Failed(other.to_string()),
        }
    }
}

pub(super) fn run_sweep(
    output: &Output,
    args: &SweepArgs,
    threads: Option<usize>,
    program: &[OsString],
) -> Result<u8, Stop> {
    if let Some(id) = &args.point {
        return point::run(&args.sweep, id, args.lean);
    }
    if args.lean && !matches!(args.engine, EngineName::Local) {
        return Err(Stop::Input("--lean: expected with --engine local; other engines keep pages and logs".into()));
    }
    let (file, folder) = places(args)?;
    let cores = threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    let jobs = args.jobs.map_or(cores, usize::from);
    let threads = (cores / jobs).max(1);
    if args.status {
        let plan = match folder.plan()? {
            Some(plan) => plan,
            None => Plan::of(&SweepFile::read(&file)?, jobs)?,
        };
        let progress = Progress::of(&plan, &folder);
        output.result(&progress, &progress.to_text());
        return Ok(DONE);
    }
    let _lock = folder.lock()?;
    let planned = folder.plan()?;
    refuse_other(args, &folder, planned.as_ref(), &file)?;
    let plan = Plan::of(&SweepFile::read(&file)?, jobs)?;
    folder.write("sweep.json", &(to_json(&plan) + "\n"))?;
    let left = points_left(&plan, &folder, args.force)?;
    let engine = Engine { folder: &folder, program: Program::of(program)?, jobs, threads };
    let (start, distinct) = (Instant::now(), plan.distinct().len());
    output.progress(format_args!(
        "{} points, {} different ones, {} to run: {jobs} at a time, {threads} threads each",
        plan.points.len(),
        distinct,
        left.len()
    ));
    let stopped = match args.engine {
        EngineName::Local => run_local(output, &engine, &left, args.lean)?,
        EngineName::Hyperqueue => {
            engine.hyperqueue(&left)?;
            false
        }
        EngineName::Slurm => {
            let script = engine.slurm(&plan.name(), &left)?;
            let script = script.display();
            let value =
                serde_json::json!({"script": script.to_string(), "points": plan.points.len(), "to_run": left.len()});
            let next = "then run this sweep again for its tables";
            output.result(&value, &format!("{} points to run: submit with `sbatch {script}`, {next}", left.len()));
            return Ok(DONE);
        }
    };
    let collected = Collected::read(&plan, &folder);
    write_results(&collected, &folder)?;
    let ended = report::Ended { left: &left, distinct, jobs, threads, wall_time_s: start.elapsed().as_secs_f64() };
    let (failed, all) = (collected.failed().count(), collected.points.len());
    if stopped {
        let ended = collected.completed().count() + failed;
        return Err(Stop::Failed(format!(
            "interrupted: {ended} of {all} points have ended; the same command continues"
        )));
    }
    report::show(output, &collected, &folder, &ended);
    match failed {
        0 => Ok(DONE),
        _ => Err(Stop::Failed(format!("{failed} of {all} points failed: {}", folder.file("sweep.html").display()))),
    }
}

/// The sweep file and the folder.
fn places(args: &SweepArgs) -> Result<(PathBuf, SweepFolder), Stop> {
    if !args.sweep.is_dir() {
        let out = args.out.clone().unwrap_or_else(|| Plan::default_folder(&args.sweep));
        return Ok((args.sweep.clone(), SweepFolder::new(out)));
    }
    let folder = SweepFolder::new(&args.sweep);
    let shown = args.sweep.display();
    match folder.plan()? {
        Some(plan) if args.out.is_none() => Ok((plan.file, folder)),
        Some(_) => Err(Stop::Input(format!("--out: expected no other folder than {shown}, which holds the sweep"))),
        None => Err(Stop::Input(format!("{shown} holds no sweep: expected a sweep file, or a folder with sweep.json"))),
    }
}

/// Refuses a folder that holds another sweep, and with `--resume` one that holds none.
fn refuse_other(args: &SweepArgs, folder: &SweepFolder, planned: Option<&Plan>, file: &Path) -> Result<(), Stop> {
    let shown = folder.path().display();
    let whole = std::fs::canonicalize(file).unwrap_or_else(|_| file.to_path_buf());
    match planned {
        None if args.resume => {
            Err(Stop::Input(format!("--resume: {shown} holds no sweep: expected one that was started")))
        }
        Some(plan) if plan.file != whole => {
            let other = plan.file.display();
            Err(Stop::Input(format!("{shown} already holds the sweep of {other}: choose another --out")))
        }
        _ => Ok(()),
    }
}

/// The points to run, with their folders ready.
fn points_left<'a>(plan: &'a Plan, folder: &SweepFolder, force: bool) -> Result<Vec<&'a str>, Stop> {
    let mut left = Vec::new();
    for (id, task) in plan.distinct() {
        let point = folder.point(id);
        if force {
            point.reopen()?;
        }
        if !matches!(point.state(), State::Ended(_)) {
            point.prepare(task)?;
            left.push(id);
        }
    }
    Ok(left)
}

/// Run points by the local pool: whether it was stopped.
fn run_local(output: &Output, engine: &Engine<'_>, left: &[&str], lean: bool) -> Result<bool, Stop> {
    static STOPPED: AtomicBool = AtomicBool::new(false);
    let mut first: Option<Instant> = None;
    let handler = move || {
        STOPPED.store(true, Ordering::Relaxed);
        if first.get_or_insert_with(Instant::now).elapsed() > IMPATIENT {
            std::process::exit(INTERRUPTED_CODE);
        }
    };
    ctrlc::set_handler(handler).map_err(|e| Stop::Failed(format!("cannot listen for Ctrl-C: {e}")))?;
    let lines = Lines::new(output, left.len());
    let pool = Pool {
        folder: engine.folder,
        program: engine.program.clone(),
        jobs: engine.jobs,
        threads: engine.threads,
        lean,
        stop: &STOPPED,
        ended: &|id, outcome| lines.take(id, outcome),
    };
    let ran = pool.run(left);
    lines.bar.finish_and_clear();
    ran?;
    Ok(STOPPED.load(Ordering::Relaxed))
}

/// Progress on stderr: a bar on a terminal, else a line now and then.
struct Lines<'a> {
    output: &'a Output,
    bar: ProgressBar,
    start: Instant,
    all: usize,
    counted: Mutex<Counted>,
}

struct Counted {
    done: usize,
    failed: usize,
    said: Instant,
}

impl<'a> Lines<'a> {
    fn new(output: &'a Output, all: usize) -> Lines<'a> {
        let bar = match output.quiet || !std::io::stderr().is_terminal() {
            true => ProgressBar::hidden(),
            false => ProgressBar::new(all as u64),
        };
        let style = ProgressStyle::with_template("{bar:32} {pos} of {len}  {elapsed} elapsed, {eta} to go  {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        let start = Instant::now();
        Lines { output, bar, start, all, counted: Mutex::new(Counted { done: 0, failed: 0, said: start }) }
    }

    /// A point has ended; `None` if it was stopped.
    fn take(&self, id: &str, outcome: Option<&Outcome>) {
        let Some(outcome) = outcome else { return };
        let mut counted = self.counted.lock().unwrap_or_else(PoisonError::into_inner);
        counted.done += 1;
        self.bar.inc(1);
        if !outcome.is_completed() {
            counted.failed += 1;
            let (failed, why) = (counted.failed, outcome.message.as_deref().unwrap_or_default());
            self.bar.set_message(format!("{failed} failed"));
            self.bar.suspend(|| self.output.progress(format_args!("points/{id}: {}: {why}", outcome.status)));
        }
        if self.bar.is_hidden() && (counted.said.elapsed() > LINE_EVERY || counted.done == self.all) {
            counted.said = Instant::now();
            let elapsed = self.start.elapsed().as_secs_f64();
            let left = elapsed * (self.all - counted.done) as f64 / counted.done as f64;
            let (done, all, failed) = (counted.done, self.all, counted.failed);
            self.output
                .progress(format_args!("{done} of {all} ended, {failed} failed; {elapsed:.0} s, {left:.0} s to go"));
        }
    }
}
