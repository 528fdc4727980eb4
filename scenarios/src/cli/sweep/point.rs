//! `splashdown sweep DIR --point ID`: the process of a point.

use std::io::BufRead;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use run::memory::available_memory;

use crate::cli::shared::{DONE, Stop};
use crate::sweep::pool::STOP;
use crate::sweep::{SweepFolder, run_point};

/// A second Ctrl-C or SIGTERM after this time ends the process at once.
pub(super) const IMPATIENT: Duration = Duration::from_secs(1);
/// Exit code of a process that was ended within a step.
pub(super) const INTERRUPTED_CODE: i32 = 130;
/// A request to end waits so long for the end of a step.
const LONGEST_STEP: Duration = Duration::from_secs(10);

static INTERRUPTED: AtomicBool = AtomicBool::new(false);
static STEPPED: AtomicBool = AtomicBool::new(false);
static FIRST: Mutex<Option<Instant>> = Mutex::new(None);

/// Run a point. A coordinator that ends leaves the process running: its result counts when the sweep continues.
pub(super) fn run(folder: &Path, id: &str, lean: bool) -> Result<u8, Stop> {
    if id.is_empty() || !id.chars().all(|c| c.is_ascii_hexdigit()) {
        return Err(Stop::Input(format!("--point {id}: expected the name of a folder in {}/points", folder.display())));
    }
    ctrlc::set_handler(end).map_err(|e| Stop::Failed(format!("cannot listen for Ctrl-C: {e}")))?;
    thread::spawn(|| {
        let lines = std::io::stdin().lock().lines();
        lines.map_while(Result::ok).filter(|line| line == STOP).for_each(|_| end());
    });
    let ended = run_point(&SweepFolder::new(folder), id, available_memory(), lean, &INTERRUPTED, &STEPPED)?;
    match ended {
        Some(outcome) if outcome.is_completed() => Ok(DONE),
        Some(outcome) => Err(Stop::Failed(outcome.message.unwrap_or(outcome.status))),
        None => Err(Stop::Failed("interrupted".into())),
    }
}

/// End the run after the present step; asked again a second later, at once.
fn end() {
    INTERRUPTED.store(true, Ordering::Relaxed);
    let mut first = FIRST.lock().unwrap_or_else(PoisonError::into_inner);
    match *first {
        Some(since) if since.elapsed() > IMPATIENT => std::process::exit(INTERRUPTED_CODE),
        Some(_) => {}
        None => {
            *first = Some(Instant::now());
            thread::spawn(|| {
                thread::sleep(LONGEST_STEP);
                if !STEPPED.load(Ordering::Relaxed) {
                    std::process::exit(INTERRUPTED_CODE);
                }
            });
        }
    }
}
