//! Parallel loops: every target gathers its own sum in a fixed order.
//!
//! Targets are cut into chunks of fixed length, so the bits of a result never depend on the number of threads. Sums are not
//! scattered, so they need no locks and no atomics. The threads are those of `team`.

use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::simd::with_simd;
use crate::team::{each_chunk, each_part, each_part_of_both};
pub use crate::team::{on_threads, within_pool};

/// Targets per chunk.
pub(crate) const CHUNK: usize = 128;

/// `of(c)` for each of `n`, in order.
fn collect_of<T: Send>(n: usize, of: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    let mut all: Vec<Option<T>> = (0..n).map(|_| None).collect();
    each_part(&mut all, 1, &|c, slot| slot[0] = Some(of(c)));
    all.into_iter().flatten().collect()
}

/// `change(c, pieces[c])` for every piece.
fn pieces_of<T: Send>(pieces: Vec<T>, change: &(dyn Fn(usize, T) + Sync)) {
    let mut pieces: Vec<Option<T>> = pieces.into_iter().map(Some).collect();
    each_part(&mut pieces, 1, &|c, piece| change(c, piece[0].take().expect("each piece once")));
}

/// Chunk c of `n` targets in chunks of `length`.
#[inline(always)]
fn chunk(c: usize, length: usize, n: usize) -> Range<usize> {
    c * length..((c + 1) * length).min(n)
}

/// `out[k] ← gather(k)` for every target k.
pub fn gather_into<T: Send>(out: &mut [T], gather: impl Fn(usize) -> T + Sync) {
    update(out, |k, slot| *slot = gather(k));
}

/// `change(k, out[k])` for every target k.
pub(crate) fn update<T: Send>(out: &mut [T], change: impl Fn(usize, &mut T) + Sync) {
    each_part(out, CHUNK, &|c, chunk| {
        for (k, slot) in chunk.iter_mut().enumerate() {
            change(c * CHUNK + k, slot);
        }
    });
}

/// `of(targets)` for every chunk of `n` targets, in order.
pub fn by_chunk<T: Send>(n: usize, of: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    collect_of(n.div_ceil(CHUNK), &|c| with_simd(|| of(chunk(c, CHUNK, n))))
}

/// `of(targets)` for every piece of `n` targets, in order.
pub(crate) fn by_piece<T: Send>(n: usize, of: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    collect_of(n.div_ceil(PIECE), &|c| with_simd(|| of(chunk(c, PIECE, n))))
}

/// Sums that a chunk is added up in, in turn, so that no addition waits for the one before it.
const LANES: usize = 4;

/// Σ `value(k)` over `n` targets: the sums of the chunks, added in order.
///
/// ```
/// let [count, total] = sph_core::parallel::sum(4, |k| [1.0, k as f64]);
/// assert_eq!([count, total], [4.0, 6.0]);
/// ```
pub fn sum<const N: usize>(n: usize, value: impl Fn(usize) -> [f64; N] + Sync) -> [f64; N] {
    let add = |mut sum: [f64; N], part: [f64; N]| {
        (0..N).for_each(|i| sum[i] += part[i]);
        sum
    };
    let of_chunk = |targets: Range<usize>| {
        let (mut lanes, whole) = ([[0.0; N]; LANES], targets.len() / LANES * LANES);
        for k in targets.clone().step_by(LANES).take(whole / LANES) {
            for (l, lane) in lanes.iter_mut().enumerate() {
                *lane = add(*lane, value(k + l));
            }
        }
        for (lane, k) in lanes.iter_mut().zip(targets.start + whole..targets.end) {
            *lane = add(*lane, value(k));
        }
        lanes.into_iter().fold([0.0; N], add)
    };
    by_chunk(n, of_chunk).into_iter().fold([0.0; N], add)
}

/// The least `value(k)` of `n` (infinity when there are none); `min` is exact, so any order gives the same bits.
pub(crate) fn least(n: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    let least = by_chunk(n, |targets| targets.map(&value).fold(f64::INFINITY, f64::min));
    least.into_iter().fold(f64::INFINITY, f64::min)
}

/// Particles per piece of a verb that asks each only about itself.
const PIECE: usize = 8 * CHUNK;

/// `change(range, [a[range], b[range], …])` for every piece of arrays of one length.
pub(crate) fn each<T: Send, const N: usize>(
    arrays: [&mut Vec<T>; N],
    change: impl Fn(Range<usize>, [&mut [T]; N]) + Sync,
) {
    let length = arrays.first().map_or(0, |a| a.len());
    let mut rest = arrays.map(|a| a.as_mut_slice().chunks_mut(PIECE));
    let pieces: Vec<[&mut [T]; N]> = (0..length.div_ceil(PIECE))
        .map(|_| std::array::from_fn(|i| rest[i].next().expect("arrays of one length")))
        .collect();
    pieces_of(pieces, &|c, parts| with_simd(|| change(chunk(c, PIECE, length), parts)));
}

/// True if `holds(c)` for each of `n`.
fn all_of(n: usize, holds: &(dyn Fn(usize) -> bool + Sync)) -> bool {
    let all = AtomicBool::new(true);
    each_chunk(n, &|c| {
        if all.load(Ordering::Relaxed) && !holds(c) {
            all.store(false, Ordering::Relaxed);
        }
    });
    all.into_inner()
}

/// True if `holds(k)` for each of `n`.
pub(crate) fn every(n: usize, holds: impl Fn(usize) -> bool + Sync) -> bool {
    all_of(n.div_ceil(PIECE), &|c| with_simd(|| chunk(c, PIECE, n).fold(true, |all, k| all & holds(k))))
}

/// True if `holds(targets)` for every chunk of `n` targets.
pub(crate) fn every_chunk(n: usize, holds: impl Fn(Range<usize>) -> bool + Sync) -> bool {
    all_of(n.div_ceil(CHUNK), &|c| with_simd(|| holds(chunk(c, CHUNK, n))))
}

/// Fill a list for every chunk of `n` targets.
pub(crate) fn for_each_chunk<T: Send>(lists: &mut [T], n: usize, fill: impl Fn(Range<usize>, &mut T) + Sync) {
    update_pieces(lists, 1, |c, list| fill(chunk(c, CHUNK, n), &mut list[0]));
}

/// Fill a list for every chunk of `n` targets, with an `S` of this thread's to work with.
pub(crate) fn for_each_chunk_with<T: Send, S: Default + Send>(
    lists: &mut [T],
    n: usize,
    fill: &(dyn Fn(&mut S, Range<usize>, &mut T) + Sync),
) {
    let spare = Mutex::new(Vec::<S>::new());
    let all = || spare.lock().expect("no panic under this lock");
    each_part(lists, 1, &|c, list| {
        let spare = all().pop();
        let mut with = spare.unwrap_or_default();
        fill(&mut with, chunk(c, CHUNK, n), &mut list[0]);
        all().push(with);
    });
}

/// `parts[c] ← change(targets, chunk)` for every chunk of `out`: changes targets and gives the chunk's part of a sum. Add
/// the parts in order, and the bits of the sum do not depend on the number of threads.
pub(crate) fn update_chunks<T: Send, S: Send>(
    parts: &mut [S],
    out: &mut [T],
    change: impl Fn(Range<usize>, &mut [T]) -> S + Sync,
) {
    let n = out.len();
    each_part_of_both((parts, 1), (out, CHUNK), &|c, part, targets| part[0] = change(chunk(c, CHUNK, n), targets));
}

/// `change(k, a[k], b[k])` for every target k.
pub(crate) fn update_both<T: Send>(a: &mut [T], b: &mut [T], change: impl Fn(usize, &mut T, &mut T) + Sync) {
    each_part_of_both((a, CHUNK), (b, CHUNK), &|c, a, b| {
        for (k, (a, b)) in a.iter_mut().zip(b).enumerate() {
            change(c * CHUNK + k, a, b);
        }
    });
}

/// [`update_chunks`] of two arrays at once.
pub(crate) fn update_both_chunks<T: Send, S: Send>(
    parts: &mut [S],
    a: &mut [T],
    b: &mut [T],
    change: impl Fn(Range<usize>, &mut [T], &mut [T]) -> S + Sync,
) {
    let pairs = a.chunks_mut(CHUNK).zip(b.chunks_mut(CHUNK));
    let pieces: Vec<_> = parts.iter_mut().zip(pairs).collect();
    pieces_of(pieces, &|c, (part, (a, b))| *part = change(c * CHUNK..c * CHUNK + a.len(), a, b));
}

/// `change(c, piece)` for every piece of `length` of `out`.
pub fn update_pieces<T: Send>(out: &mut [T], length: usize, change: impl Fn(usize, &mut [T]) + Sync) {
    each_part(out, length, &change);
}

/// `of(c)` for each of `n` pieces, in order.
pub(crate) fn map_pieces<T: Send>(n: usize, of: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    collect_of(n, &of)
}

/// `change(c, pieces[c])` for every piece.
pub(crate) fn each_piece<T: Send>(pieces: Vec<T>, change: impl Fn(usize, T) + Sync) {
    pieces_of(pieces, &change);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_take_every_target_once() {
        for n in [0, 1, 3, 4, 127, 128, 129, 1000] {
            let [count, total] = sum(n, |k| [1.0, k as f64]);
            assert_eq!([count, total], [n as f64, (n * n.saturating_sub(1) / 2) as f64], "{n} targets");
        }
    }

    #[test]
    fn chunks_come_in_order() {
        let firsts = by_chunk(1000, |targets| targets.start);
        assert_eq!(firsts, (0..1000).step_by(CHUNK).collect::<Vec<_>>());
    }
}
