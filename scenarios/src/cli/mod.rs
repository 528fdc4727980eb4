//! The command line: parse, call, print, exit code. No physics and no files here.

mod about;
mod bench;
mod certify;
mod decisions;
mod ditch;
mod experiments;
mod export;
mod fit;
mod keywords;
mod plane;
mod progress;
mod report;
mod resume;
mod run;
mod scatter;
mod shared;
mod size;
mod studio;
mod sweep;
mod thesis_files;
mod tips;

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use experiments::{convergence, stability, work_precision};
use shared::{DONE, FAILED, INPUT, Output, Stop, complain, say, unsaid, was_said};
use tips::tips;
use tracing_subscriber::filter::{LevelFilter, Targets};
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;

/// Threads for each core, at most: more only wait for each other.
const MOST_THREADS: usize = 8;

/// Commands that the list leaves out.
const FOR_DEVELOPERS: &str = "For developers and packagers: validate, chart, stability, bands, bench; schema, completions, man.\n\
    `splashdown COMMAND --help` describes each.";

#[derive(Parser)]
#[command(name = "splashdown", version, about = "Water impact and ditching of sections, in two dimensions", after_help = FOR_DEVELOPERS)]
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
    /// Print the text of a built-in scene, landing or planing hull.
    Show(about::ShowArgs),
    /// Print a scene to start from: wedge, section, panel or ditching.
    New(about::NewArgs),
    /// Run a scene and write log, curves, summary and report.
    Run(run::RunArgs),
    /// Continue a run from its checkpoint, to the same bits as without a break.
    Resume(resume::ResumeArgs),
    /// Print what a run would cost and its known limits, without running it.
    Check(about::CheckArgs),
    /// Say in plain words what a scene is, what is modelled and what not, and what the answer will be worth.
    Explain(about::ExplainArgs),
    /// Run a scene at several spacings and sound speeds and extrapolate a number.
    Study(convergence::StudyArgs),
    /// Chart error against cost, for numbers whose value is known.
    #[command(hide = true)]
    Chart(work_precision::ChartArgs),
    /// Map where runs are stable, inaccurate or fail, over two parameters, with the theory's boundary.
    #[command(hide = true)]
    Stability(stability::StabilityArgs),
    /// Run a scene or a landing at many points, each in a process of its own, and tabulate the results.
    Sweep(sweep::SweepArgs),
    /// Find the smallest value of a key with which results stay allowed, with their bands.
    Size(size::SizeArgs),
    /// Find the values of keys with which a scene gives measured curves.
    Fit(fit::FitArgs),
    /// Run a scene with inputs that scatter: quantiles of its results, and which input matters.
    Scatter(scatter::ScatterArgs),
    /// Land an aeroplane on water by its sections (2D+t).
    Ditch(ditch::DitchArgs),
    /// Run the landings that a ditching rule asks for: envelopes, worst cases, a dossier.
    Certify(certify::CertifyArgs),
    /// Compute the steady load of a hull that planes, as in a towing tank.
    Plane(plane::PlaneArgs),
    /// Measure the speed of this machine and of the steps on it, as ratios in one run.
    #[command(hide = true)]
    Bench(bench::BenchArgs),
    /// Make the page of a run again from its folder, or one page that compares several runs.
    Report(report::ReportArgs),
    /// Open a page on this machine where a scene is edited, computed as one types, run and compared.
    Studio(studio::StudioArgs),
    /// Compare scenes with published data.
    #[command(hide = true)]
    Validate(experiments::ValidateArgs),
    /// Count how often the error bars of `run --converge` contain an exact value.
    #[command(hide = true)]
    Bands(experiments::BandsArgs),
    /// Describe every key of scenes, landings and planing hulls, or those that start with a prefix.
    Keywords(keywords::KeywordsArgs),
    /// Make a scene of INDAT and IPART, the files of the solver of 2010.
    Import(thesis_files::ImportArgs),
    /// Write the frames of a run for ParaView or as tables, or a scene as INDAT and IPART.
    Export(export::ExportArgs),
    /// Print the JSON Schema (draft 2020-12) of a scene file.
    #[command(hide = true)]
    Schema,
    /// Print the completions of a shell, to be loaded by it.
    #[command(hide = true)]
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page (roff), with all commands.
    #[command(hide = true)]
    Man,
}

/// Entry point of the binary.
pub fn main() -> ExitCode {
    let program: Vec<OsString> = std::env::current_exe().into_iter().map(PathBuf::into_os_string).collect();
    ExitCode::from(execute(&std::env::args_os().collect::<Vec<_>>(), &program))
}

/// The command with these arguments, of which the first is a name for the program, and its exit code. `program` starts it as a process
/// of its own: the points of a sweep are such processes.
pub fn execute(arguments: &[OsString], program: &[OsString]) -> u8 {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => return refused(error, arguments),
    };
    trace(cli.output.quiet);
    let code = start(&cli, program).unwrap_or_else(|stop| {
        if cli.output.json && !was_said() {
            say(serde_json::json!({"error": stop.to_json()}));
        }
        match stop {
            Stop::Scene(error) => {
                complain(format_args!("{:?}", miette::Report::new(error)));
                INPUT
            }
            Stop::Line(problem) => {
                complain(format_args!("error: {problem}"));
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
        }
    });
    match unsaid().filter(|_| code == DONE) {
        Some(why) => {
            complain(format_args!("error: cannot write to stdout: {why}"));
            FAILED
        }
        None => code,
    }
}

/// What clap refuses, in its words, and tips; with `--json` as JSON too. Help and version are no errors.
fn refused(mut error: clap::Error, arguments: &[OsString]) -> u8 {
    let arguments: Vec<String> = arguments.iter().skip(1).map(|a| a.to_string_lossy().into_owned()).collect();
    let (code, tips) = (error.exit_code(), tips(&Cli::command(), &mut error, &arguments));
    if code != 0 && arguments.iter().any(|argument| argument == "--json") {
        let text = error.render().to_string();
        let text = text.trim_start_matches("error: ").split("\n\nUsage").next().unwrap_or_default().trim();
        let said = [&[text.to_string()], tips.as_slice()].concat().join("; ");
        say(serde_json::json!({"error": Stop::Input(said).to_json()}));
    }
    let _ = error.print();
    tips.iter().for_each(|tip| complain(format_args!("  tip: {tip}")));
    u8::try_from(code).unwrap_or(INPUT)
}

/// Events of a run go to stderr. `SPLASHDOWN_LOG=debug` shows more than warnings; `MODULE=LEVEL,…` selects by module.
fn trace(quiet: bool) {
    let default = Targets::new().with_default(if quiet { LevelFilter::ERROR } else { LevelFilter::WARN });
    let asked = std::env::var("SPLASHDOWN_LOG").ok().and_then(|filter| filter.parse::<Targets>().ok());
    let lines = tracing_subscriber::fmt::layer().with_writer(std::io::stderr).without_time().with_target(false);
    tracing_subscriber::registry().with(asked.unwrap_or(default)).with(lines).try_init().unwrap_or_default(); // a second command of one process has the first one's
}

fn start(cli: &Cli, program: &[OsString]) -> Result<u8, Stop> {
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
        Command::Show(args) => about::show(args),
        Command::New(args) => about::new_scene(output, args),
        Command::Run(args) => run::run_scene(output, args),
        Command::Resume(args) => resume::resume_run(output, args),
        Command::Explain(args) => about::explain(output, args),
        Command::Check(args) => about::check(output, args),
        Command::Study(args) => convergence::run_study(output, args),
        Command::Chart(args) => work_precision::run_charts(output, args),
        Command::Stability(args) => stability::run_maps(output, args),
        Command::Sweep(args) => sweep::run_sweep(output, args, cli.threads, program),
        Command::Size(args) => size::run_size(output, args),
        Command::Fit(args) => fit::run_fit(output, args),
        Command::Scatter(args) => scatter::run_scatter(output, args),
        Command::Ditch(args) => ditch::run_ditch(output, args),
        Command::Certify(args) => certify::run_certify(output, args),
        Command::Plane(args) => plane::run_plane(output, args),
        Command::Bench(args) => bench::run_bench(output, args),
        Command::Report(args) => report::make_report(output, args),
        Command::Studio(args) => studio::run_studio(output, args, program),
        Command::Validate(args) => experiments::run_validation(output, args),
        Command::Bands(args) => experiments::run_bands(output, args),
        Command::Keywords(args) => keywords::keywords(output, args),
        Command::Import(args) => thesis_files::import(output, args),
        Command::Export(args) => export::export(output, args),
        Command::Schema => keywords::schema(),
        Command::Completions { shell } => {
            let mut text = Vec::new();
            clap_complete::generate(*shell, &mut Cli::command(), "splashdown", &mut text);
            print_text(text)
        }
        Command::Man => manual().and_then(print_text),
    }
}

/// The manual page of the program, and after it one of each command.
fn manual() -> Result<Vec<u8>, Stop> {
    let (mut text, program) = (Vec::new(), Cli::command());
    let wrong = |error: std::io::Error| Stop::Failed(error.to_string());
    clap_mangen::Man::new(program.clone()).render(&mut text).map_err(wrong)?;
    for command in program.get_subcommands() {
        let name = format!("splashdown-{}", command.get_name());
        clap_mangen::Man::new(command.clone().display_name(name)).render(&mut text).map_err(wrong)?;
    }
    Ok(text)
}

fn print_text(text: Vec<u8>) -> Result<u8, Stop> {
    say(String::from_utf8_lossy(&text).trim_end());
    Ok(DONE)
}
