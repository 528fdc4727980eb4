//! Mutexes.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// The content of a mutex; a thread that broke down while it held it left a whole one.
pub fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
