//! Arrays whose parts are changed by the threads of a team, each by one.

use std::marker::PhantomData;

use super::each_chunk;

/// An array cut into parts of one length.
struct Parts<'a, T> {
    start: *mut T,
    length: usize,
    part: usize,
    array: PhantomData<&'a mut [T]>,
}

// SAFETY: by the contract of `get` it hands out each part once, and parts do not overlap.
unsafe impl<T: Send> Sync for Parts<'_, T> {}

impl<'a, T> Parts<'a, T> {
    fn of(array: &'a mut [T], part: usize) -> Parts<'a, T> {
        Parts { start: array.as_mut_ptr(), length: array.len(), part, array: PhantomData }
    }

    fn count(&self) -> usize {
        self.length.div_ceil(self.part)
    }

    /// Part c.
    ///
    /// # Safety
    /// No part may be asked for twice.
    #[allow(clippy::mut_from_ref)]
    unsafe fn get(&self, c: usize) -> &'a mut [T] {
        let from = c * self.part;
        assert!(from < self.length, "part {c} of {}", self.count());
        // SAFETY: within the array, and parts do not overlap.
        unsafe { std::slice::from_raw_parts_mut(self.start.add(from), self.part.min(self.length - from)) }
    }
}

/// `change(c, part)` for every part of `length` of an array.
pub(crate) fn each_part<T: Send>(array: &mut [T], length: usize, change: &(dyn Fn(usize, &mut [T]) + Sync)) {
    let parts = Parts::of(array, length);
    // SAFETY: `each_chunk` asks for each c once.
    each_chunk(parts.count(), &|c| change(c, unsafe { parts.get(c) }));
}

/// What is done with part c of two arrays.
type OnBoth<'a, A, B> = dyn Fn(usize, &mut [A], &mut [B]) + Sync + 'a;

/// The same of two arrays, cut into as many parts.
pub(crate) fn each_part_of_both<A: Send, B: Send>(
    (a, length_a): (&mut [A], usize),
    (b, length_b): (&mut [B], usize),
    change: &OnBoth<'_, A, B>,
) {
    let (a, b) = (Parts::of(a, length_a), Parts::of(b, length_b));
    assert_eq!(a.count(), b.count());
    // SAFETY: `each_chunk` asks for each c once.
    each_chunk(a.count(), &|c| unsafe { change(c, a.get(c), b.get(c)) });
}
