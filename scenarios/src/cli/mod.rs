//! The command line: parse, call, print, exit code. No physics and no files here.

mod about;
mod bench;
mod ditch;
mod experiments;
mod progress;
mod resume;
mod run;
mod shared;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use tracing_subscriber::filter::{LevelFilter, Targets};
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;

use experiments::{convergence, stability, work_precision};
use shared::{DONE, FAILED, INPUT, Output, SceneArgs, Stop, complain, unsaid};

/// Threads for each core, at most: more only wait for each other.
const MOST_THREADS: usize = 8;

#[derive(Parser)]
#[command(name = "splashdown", version, about = "Water impact and ditching of sections, in two dimensions")]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Threads to use (default: all cores). Results do not depend on it.
    #[arg(long, global = true, value_name = "N")]
    threads: Option<usize>,
    #[command(flatten)]
    output: Output,
}

#[derive(Subcommand)]
enum Command {
    /// List the built-in scenes.
    List,
    /// Run a scene and write log, curves, summary and report.
    Run(run::RunArgs),
    /// Continue a run from its checkpoint, to the same bits as without a break.
    Resume(resume::ResumeArgs),
    /// Print what a run would cost and its known limits, without running it.
    Check(SceneArgs),
    /// Run a scene at several spacings and sound speeds and extrapolate a number.
    Study(convergence::StudyArgs),
    /// Chart error against cost, for numbers whose value is known.
    Chart(work_precision::ChartArgs),
    /// Map where runs are stable, inaccurate or fail, over two parameters, with the theory's boundary.
    Stability(stability::StabilityArgs),
    /// Land an aeroplane on water by its sections (2D+t).
    Ditch(ditch::DitchArgs),
    /// Measure the speed of this machine and of the steps on it, as ratios in one run.
    Bench(bench::BenchArgs),
    /// Compare scenes with published data.
    Validate(experiments::ValidateArgs),
    /// Count how often the error bars of `run --converge` contain an exact value.
    Bands(experiments::BandsArgs),
    /// Describe every key of a scene file.
    Keywords {
        /// As a page of Markdown, with the keys of landings and of embedded elements.
        #[arg(long)]
        markdown: bool,
    },
    /// Print the JSON Schema (draft 2020-12) of a scene file.
    Schema,
}

/// Entry point of the binary.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    trace(cli.output.quiet);
    let code = start(&cli).unwrap_or_else(|stop| match stop {
        Stop::Scene(error) => {
            complain(format_args!("{:?}", miette::Report::new(error)));
            INPUT
        }
        Stop::Input(text) => {
            complain(format_args!("error: {text}"));
            INPUT
        }
        Stop::Failed(text) => {
            complain(format_args!("error: {text}"));
            FAILED
        }
    });
    match unsaid().filter(|_| code == DONE) {
        Some(why) => {
            complain(format_args!("error: cannot write to stdout: {why}"));
            ExitCode::from(FAILED)
        }
        None => ExitCode::from(code),
    }
}

/// Events of a run go to stderr. `SPLASHDOWN_LOG=debug` shows more than warnings; `MODULE=LEVEL,…` selects by module.
fn trace(quiet: bool) {
    let default = Targets::new().with_default(if quiet { LevelFilter::ERROR } else { LevelFilter::WARN });
    let asked = std::env::var("SPLASHDOWN_LOG").ok().and_then(|filter| filter.parse::<Targets>().ok());
    let lines = tracing_subscriber::fmt::layer().with_writer(std::io::stderr).without_time().with_target(false);
    tracing_subscriber::registry().with(asked.unwrap_or(default)).with(lines).init();
}

fn start(cli: &Cli) -> Result<u8, Stop> {
    if let Some(n) = cli.threads {
        let most = MOST_THREADS * std::thread::available_parallelism().map_or(1, usize::from);
        if n == 0 || n > most {
            return Err(Stop::Input(format!("--threads {n}: expected 1 to {most}, {MOST_THREADS} for each core")));
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build_global();
        pool.map_err(|e| Stop::Failed(format!("cannot start {n} threads: {e}")))?;
    }
    let output = &cli.output;
    match &cli.command {
        Command::List => about::list(output),
        Command::Run(args) => run::run_scene(output, args),
        Command::Resume(args) => resume::resume_run(output, args),
        Command::Check(args) => about::check(output, args),
        Command::Study(args) => convergence::run_study(output, args),
        Command::Chart(args) => work_precision::run_charts(output, args),
        Command::Stability(args) => stability::run_maps(output, args),
        Command::Ditch(args) => ditch::run_ditch(output, args),
        Command::Bench(args) => bench::run_bench(output, args),
        Command::Validate(args) => experiments::run_validation(output, args),
        Command::Bands(args) => experiments::run_bands(output, args),
        Command::Keywords { markdown } => about::keywords(output, *markdown),
        Command::Schema => about::schema(),
    }
}
