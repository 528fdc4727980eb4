//! The library itself: its versions and its threads.

use std::ffi::c_char;

use crate::border::guarded;
use crate::status::splashdown_status::SPLASHDOWN_THREADS;
use crate::status::{Failure, splashdown_status};

/// Version of this interface. It grows when a program compiled against an earlier header would no longer work.
pub const SPLASHDOWN_ABI_VERSION: u32 = 1;

/// Version of the interface in the library at run time; compare it with SPLASHDOWN_ABI_VERSION of the header.
#[unsafe(no_mangle)]
pub extern "C" fn splashdown_abi_version() -> u32 {
    SPLASHDOWN_ABI_VERSION
}

/// Version of splashdown, such as "0.1.0". The text belongs to the library and stays.
#[unsafe(no_mangle)]
pub extern "C" fn splashdown_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

/// Threads of the pool that all elements share; 0 for one per core, as it is without this call.
///
/// Call it once, before the first scene is opened. Results do not depend on the number.
#[unsafe(no_mangle)]
pub extern "C" fn splashdown_set_threads(count: usize) -> splashdown_status {
    guarded(|| {
        let made = rayon::ThreadPoolBuilder::new().num_threads(count).build_global();
        let refused = |error| {
            let message = format!("threads: given {count}, expected a call before the first use of the pool ({error})");
            Failure::new(SPLASHDOWN_THREADS, message)
        };
        made.map_err(refused)
    })
}
