//! Handles: numbers in the form of pointers, which stand for what the library keeps for the caller.
//!
//! A handle is looked up, never read through, so that one that was freed, consumed or made up is an error and not a fault. One
//! call at a time has what a handle stands for.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError, RwLock, TryLockError};

use crate::status::Failure;
use crate::status::splashdown_status::{
    SPLASHDOWN_AFTER_PANIC, SPLASHDOWN_BUSY, SPLASHDOWN_NO_HANDLE, SPLASHDOWN_NULL,
};

/// The next handle. No number is given twice, also not of two kinds.
static NEXT: AtomicUsize = AtomicUsize::new(1);

/// What a handle stands for; empty once it is consumed.
type Held<T> = Arc<Mutex<Option<T>>>;

/// All handles of one kind.
pub(crate) struct Handles<T> {
    /// "scene" or "element".
    kind: &'static str,
    held: RwLock<BTreeMap<usize, Held<T>>>,
}

impl<T> Handles<T> {
    /// None yet.
    pub const fn new(kind: &'static str) -> Handles<T> {
        Handles { kind, held: RwLock::new(BTreeMap::new()) }
    }

    /// A new handle for `value`.
    pub fn add<Opaque>(&self, value: T) -> *mut Opaque {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let mut held = self.held.write().unwrap_or_else(PoisonError::into_inner);
        held.insert(number, Arc::new(Mutex::new(Some(value))));
        std::ptr::without_provenance_mut(number)
    }

    /// Do `call` with what `handle` stands for; a panic in it leaves the handle good for [`Self::free`] only.
    pub fn with<R, Opaque>(
        &self,
        handle: *const Opaque,
        call: impl FnOnce(&mut T) -> Result<R, Failure>,
    ) -> Result<R, Failure> {
        self.with_slot(handle, |slot| call(slot.as_mut().ok_or_else(|| self.gone())?))
    }

    /// The same where `call` may consume what the handle stands for.
    pub fn with_slot<R, Opaque>(
        &self,
        handle: *const Opaque,
        call: impl FnOnce(&mut Option<T>) -> Result<R, Failure>,
    ) -> Result<R, Failure> {
        let held = self.find(handle)?;
        let (done, empty) = match held.try_lock() {
            Ok(mut slot) => (call(&mut slot), slot.is_none()),
            Err(TryLockError::WouldBlock) => return Err(self.busy()),
            Err(TryLockError::Poisoned(_)) => {
                let message = format!("{}: an earlier call with this handle ended by an internal error", self.kind);
                return Err(Failure::new(SPLASHDOWN_AFTER_PANIC, message));
            }
        };
        if empty {
            self.forget(handle);
        }
        done
    }

    /// Drop what `handle` stands for; nothing to do for NULL.
    pub fn free<Opaque>(&self, handle: *const Opaque) -> Result<(), Failure> {
        if handle.is_null() {
            return Ok(());
        }
        let held = self.find(handle)?;
        let value = match held.try_lock() {
            Ok(mut slot) => slot.take(),
            Err(TryLockError::Poisoned(slot)) => slot.into_inner().take(),
            Err(TryLockError::WouldBlock) => return Err(self.busy()),
        };
        self.forget(handle);
        drop(value);
        Ok(())
    }

    fn find<Opaque>(&self, handle: *const Opaque) -> Result<Held<T>, Failure> {
        if handle.is_null() {
            let message = format!("{}: given NULL, expected a handle", self.kind);
            return Err(Failure::new(SPLASHDOWN_NULL, message));
        }
        let held = self.held.read().unwrap_or_else(PoisonError::into_inner);
        held.get(&handle.addr()).cloned().ok_or_else(|| self.gone())
    }

    fn forget<Opaque>(&self, handle: *const Opaque) {
        self.held.write().unwrap_or_else(PoisonError::into_inner).remove(&handle.addr());
    }

    fn gone(&self) -> Failure {
        let kind = self.kind;
        let message = format!("{kind}: given a handle that was freed or consumed, or is of something else");
        Failure::new(SPLASHDOWN_NO_HANDLE, message)
    }

    fn busy(&self) -> Failure {
        Failure::new(SPLASHDOWN_BUSY, format!("{}: another call with this handle is running", self.kind))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::border::guarded;
    use crate::status::splashdown_status::{SPLASHDOWN_OK, SPLASHDOWN_PANIC};

    static NUMBERS: Handles<i32> = Handles::new("number");

    #[test]
    fn a_handle_is_busy_within_a_call_and_can_only_be_freed_after_a_panic() {
        let handle: *mut u8 = NUMBERS.add(5);
        let change = |n: &mut i32, k: i32| {
            *n += k;
            Ok(())
        };
        let add = |k: i32| guarded(|| NUMBERS.with(handle, |n| change(n, k)));
        assert_eq!(add(2), SPLASHDOWN_OK);
        let within = NUMBERS.with(handle, |n| {
            assert_eq!((*n, add(1)), (7, SPLASHDOWN_BUSY));
            assert_eq!(guarded(|| NUMBERS.free(handle)), SPLASHDOWN_BUSY);
            Ok(())
        });
        assert!(within.is_ok());
        assert_eq!(guarded(|| NUMBERS.with(handle, |_| panic!("wrong"))), SPLASHDOWN_PANIC);
        assert_eq!(add(1), SPLASHDOWN_AFTER_PANIC);
        assert_eq!(guarded(|| NUMBERS.free(handle)), SPLASHDOWN_OK);
        assert_eq!((add(1), guarded(|| NUMBERS.free(handle))), (SPLASHDOWN_NO_HANDLE, SPLASHDOWN_NO_HANDLE));
    }

    #[test]
    fn a_consumed_value_takes_its_handle_along_and_a_null_handle_has_its_own_error() {
        let handle: *mut u8 = NUMBERS.add(5);
        assert_eq!(NUMBERS.with_slot(handle, |slot| Ok(slot.take())).ok(), Some(Some(5)));
        assert_eq!(guarded(|| NUMBERS.with(handle, |_| Ok(()))), SPLASHDOWN_NO_HANDLE);
        let null: *const u8 = std::ptr::null();
        assert_eq!(guarded(|| NUMBERS.with(null, |_| Ok(()))), SPLASHDOWN_NULL);
        assert_eq!(guarded(|| NUMBERS.free(null)), SPLASHDOWN_OK);
    }
}
