//! What an input does to the process: panics are caught, hangs and huge allocations are reported.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use std::{fs, process, thread};

use crate::targets::Input;

/// Longest time for an input: of a process that has the machine to itself, and of one among others.
const LONGEST: [Duration; 2] = [Duration::from_secs(5), Duration::from_secs(60)];
/// Largest growth of the address space by an input [KiB].
const LARGEST: u64 = 768 << 10;

thread_local! {
    static PANIC: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Judges inputs one after another.
pub struct Watch {
    /// The input that is judged, and since when.
    running: Arc<Mutex<Option<(Instant, Input)>>>,
    keep: Option<PathBuf>,
}

impl Watch {
    /// Inputs that end the process are kept in a folder, if one is given.
    pub fn start(keep: Option<PathBuf>) -> Watch {
        let running: Arc<Mutex<Option<(Instant, Input)>>> = Arc::default();
        let (seen, folder) = (running.clone(), keep.clone());
        let longest = LONGEST[usize::from(keep.is_none())]; // `nightly` keeps its inputs
        thread::spawn(move || {
            loop {
                thread::sleep(Duration::from_millis(200));
                let held = seen.lock().expect("no panic while locked").clone();
                if let Some((_, input)) = held.filter(|(since, _)| since.elapsed() > longest) {
                    let place = folder.as_ref().map(|folder| input.keep(folder).display().to_string());
                    eprintln!("HANGS {}", place.unwrap_or(format!("{:?}", input.text)));
                    process::abort();
                }
            }
        });
        let others = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let place = info.location().map_or(String::new(), |at| format!("{}:{}", at.file(), at.line()));
            let text = info.payload();
            let text = text.downcast_ref::<&str>().copied().or(text.downcast_ref::<String>().map(|text| &**text));
            let text = text.unwrap_or("?");
            PANIC.set(Some(format!("panic at {place}: {text}")));
            if !thread::current().name().is_some_and(|name| name.contains("accepted_or_refused")) {
                others(info);
            }
        }));
        Watch { running, keep }
    }

    /// True for an input that is accepted, false for one that is refused as it should be.
    ///
    /// # Errors
    /// What is wrong with how it ended.
    pub fn judge(&self, input: &Input) -> Result<bool, String> {
        *self.running.lock().expect("no panic while locked") = Some((Instant::now(), input.clone()));
        // an abort leaves the input behind: the next start of `nightly` finds it
        let left = self.keep.as_ref().map(|folder| folder.join(format!("running-{}", input.target.name())));
        if let Some(left) = &left {
            fs::write(left, &input.text).expect("written");
        }
        let before = address_space();
        let judged = panic::catch_unwind(AssertUnwindSafe(|| input.judge()));
        *self.running.lock().expect("no panic while locked") = None;
        if let Some(left) = &left {
            fs::remove_file(left).expect("removed");
        }
        let judged = judged.unwrap_or_else(|_| Err(PANIC.take().unwrap_or("panic on another thread".into())));
        match address_space().saturating_sub(before) {
            grown if judged.is_ok() && grown > LARGEST => Err(format!("allocates {} MiB", grown >> 10)),
            _ => judged,
        }
    }
}

/// Largest size of the address space so far [KiB]; 0 where the system does not give it.
fn address_space() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmPeak:"));
    line.and_then(|line| line.split_whitespace().next()?.parse().ok()).unwrap_or(0)
}
