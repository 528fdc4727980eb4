//! The state of an element as bytes, to continue in another process.

use crate::border::guarded;
use crate::buffers;
use crate::element::{ELEMENTS, splashdown_element};
use crate::status::splashdown_status;

/// Bytes of the present state. They are kept until splashdown_state_write has written them, or the state has changed.
///
/// Memory: `size` is NULL or points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_state_size(
    element: *mut splashdown_element,
    size: *mut usize,
) -> splashdown_status {
    // SAFETY: a number by the contract of the caller.
    guarded(|| ELEMENTS.with(element, |element| unsafe { buffers::write_one("size", element.bytes()?.len(), size) }))
}

/// Write the present state into `buffer` of at least splashdown_state_size bytes.
///
/// Memory: `buffer` is NULL or points to `length` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_state_write(
    element: *mut splashdown_element,
    buffer: *mut u8,
    length: usize,
) -> splashdown_status {
    guarded(|| {
        ELEMENTS.with(element, |element| {
            let bytes = element.bytes()?;
            buffers::expect("buffer", buffer)?;
            buffers::expect_room("buffer, bytes", length, bytes.len())?;
            // SAFETY: not NULL, and of `length` bytes by the contract of the caller.
            unsafe { buffers::write(bytes, buffer) };
            element.clear_bytes();
            Ok(())
        })
    })
}

/// Take a state of an element that was built of the same scene, settings, interface and nodes; the next step gives the same bits.
///
/// `length` is that of the state. A state saved before is gone. After SPLASHDOWN_STATE the element has failed. A
/// run that is recorded takes no state: SPLASHDOWN_INPUT.
///
/// Memory: `buffer` is NULL or points to `length` readable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_state_read(
    element: *mut splashdown_element,
    buffer: *const u8,
    length: usize,
) -> splashdown_status {
    guarded(|| {
        ELEMENTS.with(element, |element| {
            buffers::expect("buffer", buffer)?;
            let mut bytes = vec![0; length];
            // SAFETY: `length` bytes by the contract of the caller.
            unsafe { buffers::read("buffer", buffer, &mut bytes)? };
            Ok(element.run().restore_bytes(&bytes)?)
        })
    })
}
