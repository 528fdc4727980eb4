//! Parallel sweeps: every target gathers its own sum in a fixed order.
//!
//! The only module that knows of threads. Targets are cut into chunks of fixed length, so the bits of a
//! result never depend on the number of threads; nothing is scattered, so there are no locks or atomics.

use rayon::prelude::*;

/// Targets per chunk.
pub const CHUNK: usize = 128;

/// Do `task` on a thread of the pool: the sweeps inside then start without waking the pool each time.
pub fn within_pool<T: Send>(task: impl FnOnce() -> T + Send) -> T {
    if rayon::current_thread_index().is_some() { task() } else { rayon::scope(|_| task()) }
}

/// `out[k] ← gather(k)` for every target k.
pub fn gather_into<T: Send>(out: &mut [T], gather: impl Fn(usize) -> T + Sync) {
    out.par_chunks_mut(CHUNK).enumerate().for_each(|(c, chunk)| {
        for (k, slot) in chunk.iter_mut().enumerate() {
            *slot = gather(c * CHUNK + k);
        }
    });
}

/// `change(k, out[k])` for every target k.
pub fn update<T: Send>(out: &mut [T], change: impl Fn(usize, &mut T) + Sync) {
    out.par_chunks_mut(CHUNK).enumerate().for_each(|(c, chunk)| {
        for (k, slot) in chunk.iter_mut().enumerate() {
            change(c * CHUNK + k, slot);
        }
    });
}

/// The least `value(k)` of `n` (infinity when there are none); `min` is exact, so any order gives the same bits.
pub fn least(n: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|c| (c * CHUNK..((c + 1) * CHUNK).min(n)).map(&value).fold(f64::INFINITY, f64::min))
        .reduce(|| f64::INFINITY, f64::min)
}

/// Fill a list for every chunk of `n` targets.
pub fn for_each_chunk<T: Send>(lists: &mut [T], n: usize, fill: impl Fn(std::ops::Range<usize>, &mut T) + Sync) {
    lists.par_iter_mut().enumerate().for_each(|(c, list)| fill(c * CHUNK..((c + 1) * CHUNK).min(n), list));
}

/// `parts[c] ← change(targets, chunk)` for every chunk of `out`: changes targets and gives the chunk's part of a sum. Add
/// the parts in order, and the bits of the sum do not depend on the number of threads.
pub fn update_chunks<T: Send, S: Send>(
    parts: &mut [S],
    out: &mut [T],
    change: impl Fn(std::ops::Range<usize>, &mut [T]) -> S + Sync,
) {
    debug_assert_eq!(parts.len(), out.len().div_ceil(CHUNK));
    parts.par_iter_mut().zip(out.par_chunks_mut(CHUNK)).enumerate().for_each(|(c, (part, chunk))| {
        *part = change(c * CHUNK..c * CHUNK + chunk.len(), chunk);
    });
}

/// `change(k, a[k], b[k])` for every target k.
pub fn update_both<T: Send>(a: &mut [T], b: &mut [T], change: impl Fn(usize, &mut T, &mut T) + Sync) {
    a.par_chunks_mut(CHUNK).zip(b.par_chunks_mut(CHUNK)).enumerate().for_each(|(c, (a, b))| {
        for (k, (a, b)) in a.iter_mut().zip(b).enumerate() {
            change(c * CHUNK + k, a, b);
        }
    });
}

/// [`update_chunks`] of two arrays at once.
pub fn update_both_chunks<T: Send, S: Send>(
    parts: &mut [S],
    a: &mut [T],
    b: &mut [T],
    change: impl Fn(std::ops::Range<usize>, &mut [T], &mut [T]) -> S + Sync,
) {
    debug_assert_eq!(parts.len(), a.len().div_ceil(CHUNK));
    let chunks = a.par_chunks_mut(CHUNK).zip(b.par_chunks_mut(CHUNK));
    parts.par_iter_mut().zip(chunks).enumerate().for_each(|(c, (part, (a, b)))| {
        *part = change(c * CHUNK..c * CHUNK + a.len(), a, b);
    });
}

/// `change(c, piece)` for every piece of `length` of `out`.
pub fn update_pieces<T: Send>(out: &mut [T], length: usize, change: impl Fn(usize, &mut [T]) + Sync) {
    out.par_chunks_mut(length).enumerate().for_each(|(c, piece)| change(c, piece));
}
