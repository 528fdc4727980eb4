//! What every call returns, the message of the last error, and the border that no panic crosses.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};

use scenarios::host::{ErrorKind, HostedError};

use crate::buffers;

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
    status: splashdown_status,
    message: String,
}

impl Failure {
    /// With the message for the caller: what was given, what was expected.
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

thread_local! {
    /// Text of this thread's last error.
    static LAST: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Do `call`; keep the message of its failure or of its panic for the calling thread.
pub(crate) fn guarded(call: impl FnOnce() -> Result<(), Failure>) -> splashdown_status {
    let failure = match catch_unwind(AssertUnwindSafe(call)) {
        Ok(Ok(())) => return SPLASHDOWN_OK,
        Ok(Err(failure)) => failure,
        Err(panic) => Failure::new(SPLASHDOWN_PANIC, format!("internal error: {}", text_of(&*panic))),
    };
    // a thread that is ending has no message any more
    let _ = LAST.try_with(|last| *last.borrow_mut() = failure.message);
    failure.status
}

fn text_of(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("without a text")
}

/// The text of the last error of the calling thread, UTF-8, ended by a zero; empty if there was none.
///
/// Returns the bytes that the whole text needs with its zero. A shorter buffer gets the beginning of the text, ended by a zero;
/// NULL or a length of 0 gets nothing. A call that succeeds leaves the text as it is.
///
/// Memory: `buffer` is NULL or points to `length` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_message(buffer: *mut c_char, length: usize) -> usize {
    // SAFETY: passed on to the caller.
    let write = |last: &RefCell<String>| unsafe { buffers::write_cut(&last.borrow(), buffer, length) };
    LAST.try_with(write).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message() -> String {
        let mut buffer = [1; 200];
        // SAFETY: the length is that of the buffer.
        let needed = unsafe { splashdown_message(buffer.as_mut_ptr(), buffer.len()) };
        let bytes: Vec<u8> = buffer.iter().take(needed - 1).map(|&byte| byte as u8).collect();
        String::from_utf8(bytes).expect("UTF-8")
    }

    #[test]
    fn a_panic_is_a_status_and_a_message_and_a_success_keeps_the_message() {
        assert_eq!(guarded(|| panic!("node {}", 3)), SPLASHDOWN_PANIC);
        assert_eq!(message(), "internal error: node 3");
        assert_eq!(guarded(|| Ok(())), SPLASHDOWN_OK);
        assert_eq!(message(), "internal error: node 3");
        assert_eq!(guarded(|| Err(Failure::new(SPLASHDOWN_INPUT, "given 1, expected 2"))), SPLASHDOWN_INPUT);
        assert_eq!(message(), "given 1, expected 2");
        let of_another = std::thread::spawn(message).join();
        assert_eq!(of_another.ok().as_deref(), Some(""), "messages are of one thread each");
    }
}
