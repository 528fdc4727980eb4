//! What `run` and `resume` share: requests to end, progress, results in words.

use std::io::IsTerminal;
use std::net::SocketAddr;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use run::log::{LogError, Viewers};
use run::summary::Summary;
use run::{Outcome, RunError, RunOptions};
use scene::Scene;
use scene::vocabulary::{Quantity, ResultId, Status};
use settings::significant;

use super::shared::{DONE, Output, Stop, complain, say};
use crate::live::LiveView;

/// A second Ctrl-C or SIGTERM after this time ends the process at once. An earlier one is the same request, sent to the
/// process and to its group.
const IMPATIENT: Duration = Duration::from_secs(1);
/// A request to end waits so long for the end of a step.
const LONGEST_STEP: Duration = Duration::from_secs(10);
/// Exit code of a run that was ended within a step, as of a shell's Ctrl-C.
const INTERRUPTED_CODE: i32 = 130;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);
static STEPPING: AtomicBool = AtomicBool::new(false);
static STEPPED: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C and SIGTERM end the run after a step, once it steps.
pub(super) fn listen() -> Result<(), Stop> {
    let mut first: Option<Instant> = None;
    let handler = move || {
        INTERRUPTED.store(true, Ordering::Relaxed);
        let asked_again = first.get_or_insert_with(Instant::now).elapsed() > IMPATIENT;
        if asked_again || !STEPPING.load(Ordering::Relaxed) {
            std::process::exit(INTERRUPTED_CODE); // requested twice, or nothing to keep yet
        }
        std::thread::spawn(|| {
            std::thread::sleep(LONGEST_STEP);
            if !STEPPED.load(Ordering::Relaxed) {
                let seconds = LONGEST_STEP.as_secs();
                complain(format_args!(
                    "error: interrupted within a step of more than {seconds} s: the log ends before it"
                ));
                std::process::exit(INTERRUPTED_CODE);
            }
        });
    };
    ctrlc::set_handler(handler).map_err(|e| Stop::Failed(format!("cannot listen for Ctrl-C: {e}")))
}

/// Starts the server of a live view, and says where it is.
pub(super) fn viewers_at(
    output: &Output,
    address: SocketAddr,
) -> impl Fn(&Scene) -> Result<Box<dyn Viewers>, LogError> + Sync {
    move |scene| {
        let view = LiveView::start(address, &scene.name)?;
        let address = SocketAddr::new(address.ip(), view.port());
        output.progress(format_args!("live: connect Foxglove or Lichtblick to ws://{address}"));
        Ok(Box::new(view))
    }
}

/// The interval of checkpoints as given [s].
pub(super) fn interval(given: Option<f64>) -> Result<Option<f64>, Stop> {
    match given {
        Some(every) if !(every > 0.0 && every.is_finite()) => {
            Err(Stop::Input(format!("--checkpoint-every {every}: expected a simulated time above 0 s")))
        }
        given => Ok(given),
    }
}

/// Run to `end` [s], showing how far it is, and tell its results. Before: [`listen`].
pub(super) fn step_to_end(
    output: &Output,
    out: &Path,
    end: f64,
    options: RunOptions<'_>,
    run: impl FnOnce(&RunOptions<'_>) -> Result<Outcome, RunError>,
) -> Result<u8, Stop> {
    let bar = progress_bar(output);
    let tell = |time: f64, steps: u64| {
        STEPPING.store(true, Ordering::Relaxed);
        bar.set_position((1000.0 * time / end) as u64);
        bar.set_message(format!("t = {time:.5} s, step {steps}"));
    };
    let (interrupt, stepped) = (Some(&INTERRUPTED), Some(&STEPPED));
    let outcome = run(&RunOptions { interrupt, stepped, progress: Some(&tell), ..options });
    bar.finish_and_clear();
    let summary = outcome?.summary;
    if output.json {
        say(summary.to_json());
    } else if !output.quiet {
        say(if summary.status == Status::Failed { without_results(&summary) } else { in_words(&summary) });
        say(format_args!("files in {}: open report.html", out.display()));
    }
    if output.quiet && summary.status != Status::Failed {
        summary.doubts.iter().for_each(|doubt| complain(format_args!("warning: {doubt}")));
    }
    match summary.status {
        Status::Completed | Status::CompletedWithDoubts | Status::BeyondAllowable | Status::Ruptured => Ok(DONE),
        Status::Failed => Err(Stop::Failed(summary.message.unwrap_or_default())),
        Status::Interrupted | Status::NotFinished => {
            Err(Stop::Failed(format!("interrupted at t = {:.6} s", summary.time_end_s)))
        }
    }
}

fn progress_bar(output: &Output) -> ProgressBar {
    if output.quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(1000);
    let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {elapsed} elapsed, {eta} to go  {msg}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}

/// A result on a line.
fn result_in_words((name, quantity): (ResultId, &Quantity)) -> String {
    if quantity.is_withheld() {
        return format!("  {name}: withheld, {}: its band is as large as itself", quantity.verdict.name());
    }
    let band = quantity.band.map_or(String::new(), |band| format!(" ± {}", significant(band)));
    let allowed = if quantity.allowed == Some(false) { ", NOT ALLOWED" } else { "" };
    let time = quantity.time_s.map_or(String::new(), |time| format!(" at {time:.5} s"));
    let raw = quantity
        .cutoff_hz
        .map_or(String::new(), |f| format!(", mean below {f:.0} Hz (single step: {})", significant(quantity.raw)));
    format!("  {name}: {}{band}{time}, {}{allowed}{raw}", significant(quantity.value), quantity.verdict.name())
}

/// A run that broke down: what it computed before is no result.
fn without_results(s: &Summary) -> String {
    format!("{}: failed at t = {:.6} s, step {}: no results", s.scene, s.time_end_s, s.steps)
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
    lines.extend(s.message.iter().filter(|_| s.status == Status::Ruptured).map(|what| format!("  RUPTURE: {what}")));
    lines.extend(s.results.named().map(result_in_words));
    lines.extend(s.results.bandwidth_by.map(|by| format!("  bandwidth of the force: {}", by.words())));
    lines.extend(s.doubts.iter().map(|doubt| format!("  DOUBT: {doubt}")));
    lines.extend(s.choice.iter().map(|why| format!("  model chosen: {why}")));
    for c in &s.comparison {
        let verdict = match c.tolerance {
            None => "drawn only".to_string(),
            Some(t) => format!("{} {t}", if c.passes() { "within" } else { "OUTSIDE" }),
        };
        lines.push(format!("  {} against {}: error {:.4} ({verdict})", c.quantity, c.reference, c.error));
    }
    lines.extend(s.not_compared.iter().map(|why| format!("  NOT COMPARED: {why}")));
    lines.extend(s.error_bars.iter().map(|(path, bar)| {
        let order = bar.order.map_or(String::new(), |p| format!(", order {p:.2}"));
        format!("  {path}: {:.5e} ± {:.1e}{order}; {} ({})", bar.middle(), bar.band, bar.verdict, bar.method)
    }));
    if theory {
        return lines.join("\n");
    }
    lines.push(format!(
        "  audit: momentum {:.1e}, energy {:+.3}, volume {:+.1e}, surface {}, penetrated {}",
        s.audit.momentum,
        s.audit.energy,
        s.audit.volume,
        s.audit.surface.map_or("-".into(), |gap| format!("{gap:.1e}")),
        s.audit.penetrated
    ));
    lines.extend(s.audit.worst_penetration.iter().map(|worst| format!("  PENETRATION: {worst}")));
    lines.join("\n")
}
