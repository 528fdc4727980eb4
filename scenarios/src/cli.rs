//! The command line: parse, call, print, exit code. No physics and no files here.

mod bench;
mod ditch;
mod experiments;

use std::io::{IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use clap::{Args, Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};
use tracing_subscriber::EnvFilter;

use self::experiments::{convergence, coverage, stability, validation, work_precision};
use crate::error_bar::ErrorBars;
use crate::preflight::preflight;
use crate::run::{RunError, RunOptions, run};
use crate::scene::{self, Loaded, SceneError};
use crate::summary::{Status, Summary};

/// Done.
const DONE: u8 = 0;
/// The run failed.
const FAILED: u8 = 1;
/// The input was wrong.
const INPUT: u8 = 2;

/// A second Ctrl-C or SIGTERM after this long means: at once. Sooner it is the same request, sent to the process and
/// to its group.
const IMPATIENT: Duration = Duration::from_secs(1);

/// Memory taken for granted where the system does not say how much there is [bytes].
const USUAL_MEMORY: u64 = 8 << 30;

#[derive(Parser)]
#[command(name = "splashdown", version, about = "Water impact and ditching of sections, in two dimensions")]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Threads to use (default: all cores). Results do not depend on it.
    #[arg(long, global = true, value_name = "N")]
    threads: Option<usize>,
    /// Say nothing but errors.
    #[arg(long, global = true)]
    quiet: bool,
    /// Print machine-readable output on stdout.
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Subcommand)]
enum Command {
    /// List the built-in scenes.
    List,
    /// Run a scene and write log, curves, summary and report.
    Run(RunArgs),
    /// Say what a run would cost and how far it can be trusted, without running it.
    Check(SceneArgs),
    /// Run a scene at several spacings and sound speeds and say what a number tends to.
    Study(convergence::StudyArgs),
    /// Chart error against cost: each way to a number whose value is known.
    Chart(work_precision::ChartArgs),
    /// Map where runs are stable, inaccurate or fail, over two parameters, with the theory's boundary.
    Stability(stability::StabilityArgs),
    /// Land an aeroplane on water by its sections (2D+t).
    Ditch(ditch::DitchArgs),
    /// Measure the speed of this machine and of the steps on it, as ratios in one run.
    Bench(bench::BenchArgs),
    /// Hold scenes against others' data.
    Validate(validation::ValidateArgs),
    /// Count how often the error bars of `run --converge` hold an exact value.
    Bands(coverage::BandsArgs),
    /// Describe every key of a scene file.
    Keywords {
        /// As a page of Markdown, with the keys of landings and of embedded elements.
        #[arg(long)]
        markdown: bool,
    },
    /// Print the JSON Schema (draft 2020-12) of a scene file.
    Schema,
}

#[derive(Args, Clone)]
struct SceneArgs {
    /// Name of a built-in scene, or path of a TOML file.
    scene: String,
    /// Override a key, e.g. --set body.deadrise_deg=20 (repeatable).
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<String>,
}

#[derive(Args)]
struct RunArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Folder for the run's files (default: runs/SCENE).
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace a run that the folder holds.
    #[arg(long)]
    force: bool,
    /// Keep log.mcap below this size, with fewer frames of particles: the key report.log_budget.
    #[arg(long, value_name = "MB")]
    log_budget: Option<f64>,
    /// Run at 4 and 2 times the spacing first, and say what the main numbers tend to, with error bars.
    #[arg(long)]
    converge: bool,
    /// A number for an error bar, by its path in summary.json (repeatable; default: the scene's main ones).
    #[arg(long = "quantity", value_name = "PATH", requires = "converge")]
    quantities: Vec<String>,
}

/// Print a line; a reader that has gone away is no reason to stop.
fn say(text: std::fmt::Arguments<'_>) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// What the process ends with.
enum Stop {
    Scene(SceneError),
    Input(String),
    Failed(String),
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

/// Entry point of the binary.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    trace(cli.quiet);
    let code = start(&cli).unwrap_or_else(|stop| match stop {
        Stop::Scene(error) => {
            eprintln!("{:?}", miette::Report::new(error));
            INPUT
        }
        Stop::Input(text) => {
            eprintln!("error: {text}");
            INPUT
        }
        Stop::Failed(text) => {
            eprintln!("error: {text}");
            FAILED
        }
    });
    ExitCode::from(code)
}

/// Events of a run go to stderr; `SPLASHDOWN_LOG=debug` (or any tracing filter) shows more than warnings.
fn trace(quiet: bool) {
    let usual = if quiet { "error" } else { "warn" };
    let filter = EnvFilter::try_from_env("SPLASHDOWN_LOG").unwrap_or_else(|_| EnvFilter::new(usual));
    tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(std::io::stderr)
        .without_time()
        .with_target(false)
        .init();
}

fn start(cli: &Cli) -> Result<u8, Stop> {
    if let Some(n) = cli.threads {
        if n == 0 {
            return Err(Stop::Input("--threads 0: expected at least 1".into()));
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build_global();
        pool.map_err(|e| Stop::Failed(format!("cannot start {n} threads: {e}")))?;
    }
    match &cli.command {
        Command::List => list(cli),
        Command::Run(args) => run_scene(cli, args),
        Command::Check(args) => check(cli, args),
        Command::Study(args) => convergence::run_study(cli, args),
        Command::Chart(args) => work_precision::run_charts(cli, args),
        Command::Stability(args) => stability::run_maps(cli, args),
        Command::Ditch(args) => ditch::run_ditch(cli, args),
        Command::Bench(args) => bench::run_bench(cli, args),
        Command::Validate(args) => validation::run_validation(cli, args),
        Command::Bands(args) => coverage::run_bands(cli, args),
        Command::Keywords { markdown: true } => {
            say(format_args!("{}", crate::reference_page::reference_page().trim_end()));
            Ok(DONE)
        }
        Command::Keywords { markdown: false } => keywords(cli),
        Command::Schema => {
            say(format_args!("{:#}", scene::schema().to_json()));
            Ok(DONE)
        }
    }
}

fn list(cli: &Cli) -> Result<u8, Stop> {
    let mut scenes = Vec::new();
    for (name, _) in scene::builtin() {
        scenes.push((name, scene::load(name, &[])?.scene.description));
    }
    if cli.json {
        let names: Vec<_> = scenes.iter().map(|(n, d)| serde_json::json!({"scene": n, "description": d})).collect();
        say(format_args!("{}", serde_json::Value::from(names)));
    } else {
        scenes.iter().for_each(|(name, description)| say(format_args!("{name:<20} {description}")));
    }
    Ok(DONE)
}

fn keywords(cli: &Cli) -> Result<u8, Stop> {
    for k in scene::schema().keywords() {
        if cli.json {
            say(format_args!("{}", serde_json::json!(k)));
        } else {
            say(format_args!("{}\n    {}; {} (unit: {}; default: {})", k.path, k.doc, k.takes, k.unit, k.default));
        }
    }
    Ok(DONE)
}

fn load(args: &SceneArgs) -> Result<Loaded, Stop> {
    let loaded = scene::load(&args.scene, &args.sets)?;
    loaded.fits_in_memory(available_memory())?;
    Ok(loaded)
}

/// Memory that is free to take [bytes].
fn available_memory() -> u64 {
    let said = std::fs::read_to_string("/proc/meminfo").unwrap_or_default();
    let line = said.lines().find_map(|l| l.strip_prefix("MemAvailable:"));
    let kib = line.and_then(|l| l.trim().trim_end_matches("kB").trim().parse::<u64>().ok());
    kib.map_or(USUAL_MEMORY, |k| k * 1024)
}

fn check(cli: &Cli, args: &SceneArgs) -> Result<u8, Stop> {
    let loaded = load(args)?;
    let preflight = preflight(&loaded.scene, &loaded.warnings);
    if cli.json {
        say(format_args!("{}", serde_json::to_string_pretty(&preflight).unwrap_or_default()));
    } else {
        say(format_args!("{}", preflight.to_text()));
    }
    Ok(DONE)
}

fn run_scene(cli: &Cli, args: &RunArgs) -> Result<u8, Stop> {
    static INTERRUPTED: AtomicBool = AtomicBool::new(false);
    static STEPPING: AtomicBool = AtomicBool::new(false);
    let SceneArgs { scene, mut sets } = args.scene.clone();
    sets.extend(args.log_budget.map(|megabytes| format!("report.log_budget={megabytes:?}")));
    let given = SceneArgs { scene, sets };
    let loaded = load(&given)?;
    loaded.warnings.iter().for_each(|w| tracing::warn!("{w}"));
    let mut first: Option<Instant> = None;
    let handler = move || {
        INTERRUPTED.store(true, Ordering::Relaxed);
        let asked_again = first.get_or_insert_with(Instant::now).elapsed() > IMPATIENT;
        if asked_again || !STEPPING.load(Ordering::Relaxed) {
            std::process::exit(130); // asked twice, or nothing to keep yet: at once
        }
    };
    ctrlc::set_handler(handler).map_err(|e| Stop::Failed(format!("cannot listen for Ctrl-C: {e}")))?;
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(&loaded.scene.name));
    let coarser = match args.converge {
        true if loaded.scene.model.is_theory() => {
            let text = format!(
                "--converge: expected a model of particles, not {}: it has no spacing",
                loaded.scene.model.name()
            );
            return Err(Stop::Input(text));
        }
        true => Some(convergence::coarser_runs(cli, &given, &args.quantities, &out, args.force)?),
        false => None,
    };
    let studied =
        coarser.as_ref().map(|runs| |summary: &Summary| runs.error_bars(&loaded.scene, summary, &args.quantities));
    let bar = progress_bar(cli);
    let tell = |time: f64, steps: u64| {
        STEPPING.store(true, Ordering::Relaxed);
        bar.set_position((1000.0 * time / loaded.scene.time.end) as u64);
        bar.set_message(format!("t = {time:.5} s, step {steps}"));
    };
    let options = RunOptions {
        out: Some(out.clone()),
        force: args.force,
        without_log: false,
        interrupt: Some(&INTERRUPTED),
        most_steps: None,
        progress: Some(&tell),
        warnings: loaded.warnings.clone(),
        error_bars: studied.as_ref().map(|of| of as &(dyn Fn(&Summary) -> ErrorBars + Sync)),
    };
    let outcome = run(&loaded.scene, &options);
    bar.finish_and_clear();
    let summary = outcome?.summary;
    if cli.json {
        say(format_args!("{}", summary.to_json()));
    } else if !cli.quiet {
        say(format_args!("{}", in_words(&summary)));
        say(format_args!("files in {}: open report.html", out.display()));
    }
    match summary.status {
        Status::Completed => Ok(DONE),
        Status::Failed => Err(Stop::Failed(summary.message.unwrap_or_default())),
        Status::Interrupted => Err(Stop::Failed(format!("interrupted at t = {:.6} s", summary.time_end_s))),
    }
}

fn progress_bar(cli: &Cli) -> ProgressBar {
    if cli.quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(1000);
    let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {elapsed} elapsed, {eta} to go  {msg}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}

fn in_words(s: &Summary) -> String {
    let theory = s.particles.fluid == 0;
    let mut lines = vec![match theory {
        true => format!("{}: {}, {:.1} ms of wall time", s.scene, s.model, 1e3 * s.wall_time_s),
        false => format!(
            "{}: {} particles, {} steps, {:.1} s of wall time",
            s.scene, s.particles.fluid, s.steps, s.wall_time_s
        ),
    }];
    lines.extend(s.choice.iter().map(|why| format!("  model chosen: {why}")));
    for c in &s.comparison {
        let verdict = match c.tolerance {
            None => "drawn only".to_string(),
            Some(t) => format!("{} {t}", if c.passes() { "within" } else { "OUTSIDE" }),
        };
        lines.push(format!("  {} against {}: error {:.4} ({verdict})", c.quantity, c.reference, c.error));
    }
    lines.extend(s.error_bars.iter().map(|(path, bar)| {
        let order = bar.order.map_or(String::new(), |p| format!(", order {p:.2}"));
        format!("  {path}: {:.5e} ± {:.1e}{order}; {} ({})", bar.middle(), bar.band, bar.verdict, bar.method)
    }));
    if theory {
        return lines.join("\n");
    }
    lines.push(format!(
        "  audit: momentum {:.1e}, energy {:+.3}, volume {:+.1e}, penetrated {}",
        s.audit.momentum, s.audit.energy, s.audit.volume, s.audit.penetrated
    ));
    lines.extend(s.audit.worst_penetration.iter().map(|worst| format!("  NOT TIGHT: {worst}")));
    lines.join("\n")
}
