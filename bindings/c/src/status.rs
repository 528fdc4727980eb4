//! What every call returns.

use run::host::{ErrorKind, HostedError};

/// How a call ended. The numbers never change; a later version may add some.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(clippy::enum_variant_names, clippy::upper_case_acronyms)]
pub enum splashdown_status {
    /// Done.
    SPLASHDOWN_OK = 0,
    /// A pointer is NULL, or not aligned for what it points to.
    SPLASHDOWN_NULL = 1,
    /// A length is not the expected one, or a buffer is too short.
    SPLASHDOWN_LENGTH = 2,
    /// A text is not UTF-8.
    SPLASHDOWN_NOT_UTF8 = 3,
    /// The scene, a setting or a value is wrong; nothing has changed.
    SPLASHDOWN_INPUT = 4,
    /// The water broke down within the step: restore a saved state, or free the element.
    SPLASHDOWN_STEP = 5,
    /// The step before failed, and no saved state was restored since.
    SPLASHDOWN_FAILED = 6,
    /// Nothing was saved.
    SPLASHDOWN_NOTHING_SAVED = 7,
    /// The bytes are not a state of this element, which has failed.
    SPLASHDOWN_STATE = 8,
    /// A file or a folder cannot be read or written.
    SPLASHDOWN_FILE = 9,
    /// Another call with this handle is running; this one did nothing.
    SPLASHDOWN_BUSY = 10,
    /// No such handle: it was freed or consumed, or is not one of this library.
    SPLASHDOWN_NO_HANDLE = 11,
    /// An internal error in this call. Please report it with the message.
    SPLASHDOWN_PANIC = 12,
    /// An internal error in an earlier call with this handle, which can only be freed.
    SPLASHDOWN_AFTER_PANIC = 13,
    /// The pool of threads is already in use, or cannot be made.
    SPLASHDOWN_THREADS = 14,
}
use splashdown_status::*;

/// A call that does not succeed.
#[derive(Debug)]
pub(crate) struct Failure {
    /// For the caller.
    pub status: splashdown_status,
    /// What was given, what was expected.
    pub message: String,
}

impl Failure {
    /// With its message.
    pub fn new(status: splashdown_status, message: impl Into<String>) -> Failure {
        Failure { status, message: message.into() }
    }
}

impl From<HostedError> for Failure {
    fn from(error: HostedError) -> Failure {
        let status = match error.kind() {
            ErrorKind::Input => SPLASHDOWN_INPUT,
            ErrorKind::Step => SPLASHDOWN_STEP,
            ErrorKind::Failed => SPLASHDOWN_FAILED,
            ErrorKind::NothingSaved => SPLASHDOWN_NOTHING_SAVED,
            ErrorKind::State => SPLASHDOWN_STATE,
            ErrorKind::File => SPLASHDOWN_FILE,
        };
        Failure::new(status, error.to_string())
    }
}
