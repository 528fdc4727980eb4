//! Arrays that are used again: allocating new ones at each step takes a third of its time.

use std::cell::RefCell;
use std::ops::{Deref, DerefMut};

/// Most arrays that are kept.
const KEPT: usize = 8;

thread_local! {
    static FREE: RefCell<Vec<Vec<f64>>> = const { RefCell::new(Vec::new()) };
}

/// An array that goes back to the store of its thread when it is dropped.
pub(crate) struct Buffer(Vec<f64>);

impl Buffer {
    /// Zeros.
    pub fn zeros(length: usize) -> Buffer {
        let mut numbers = FREE.with_borrow_mut(Vec::pop).unwrap_or_default();
        numbers.clear();
        numbers.resize(length, 0.0);
        Buffer(numbers)
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        let numbers = std::mem::take(&mut self.0);
        FREE.with_borrow_mut(|free| {
            if free.len() < KEPT {
                free.push(numbers);
            }
        });
    }
}

impl Deref for Buffer {
    type Target = [f64];
    fn deref(&self) -> &[f64] {
        &self.0
    }
}

impl DerefMut for Buffer {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.0
    }
}
