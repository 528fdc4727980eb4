//! How calls from Python run: one at a time for each object, and ended by Ctrl-C.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, MutexGuard, OnceLock, TryLockError};
use std::time::Duration;
use std::{process, thread};

use pyo3::prelude::*;

use crate::errors;

/// Interval at which a long call looks for Ctrl-C.
pub const POLL: Duration = Duration::from_millis(50);

/// The process that computed first: its threads are not in a process that is forked from it.
static PROCESS: OnceLock<u32> = OnceLock::new();

/// An error in a process that was forked from one that has computed: it would wait for threads that it does not have.
pub fn refuse_fork() -> PyResult<()> {
    let (own, first) = (process::id(), *PROCESS.get_or_init(process::id));
    match own == first {
        true => Ok(()),
        false => Err(errors::step(format!(
            "process {own} was forked from process {first}, whose threads it does not have: expected \
             multiprocessing.get_context(\"spawn\")"
        ))),
    }
}

/// A state that one call at a time may use. No call waits for another, so that none waits for ever.
pub struct Guarded<T>(Mutex<T>);

impl<T> Guarded<T> {
    /// A state.
    pub fn new(state: T) -> Guarded<T> {
        Guarded(Mutex::new(state))
    }

    /// The state for this call.
    pub fn open(&self) -> PyResult<MutexGuard<'_, T>> {
        refuse_fork()?;
        self.0.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => {
                errors::step("another thread is in a call of this object: expected one call at a time")
            }
            TryLockError::Poisoned(_) => errors::step("an earlier call of this object broke off: make a new one"),
        })
    }
}

/// Do `work` on a thread of its own, without the interpreter's lock. Ctrl-C sets the flag that `work` is given, and is raised once
/// `work` has ended.
pub fn interruptible<T: Send>(py: Python<'_>, work: impl FnOnce(&AtomicBool) -> T + Send) -> PyResult<T> {
    refuse_fork()?;
    let stop = AtomicBool::new(false);
    py.detach(|| {
        thread::scope(|scope| {
            let (running, ended) = mpsc::channel::<()>();
            let worker = scope.spawn(|| {
                let result = work(&stop);
                drop(running);
                result
            });
            let mut raised = None;
            while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(POLL) {
                if raised.is_none() {
                    raised = Python::attach(|py| py.check_signals()).err();
                    stop.store(raised.is_some(), Ordering::Relaxed);
                }
            }
            let result = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
            raised.map_or(Ok(result), Err)
        })
    })
}
