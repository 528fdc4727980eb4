//! Functions of the interface: a panic in one is an error of its caller; the message of the last error.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::buffers;
use crate::status::splashdown_status::{SPLASHDOWN_OK, SPLASHDOWN_PANIC};
use crate::status::{Failure, splashdown_status};

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
    use crate::status::splashdown_status::SPLASHDOWN_INPUT;

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
