//! Parallel loops: every target gathers its own sum in a fixed order.
//!
//! The only module that knows of threads. Targets are cut into chunks of fixed length, so the bits of a
//! result never depend on the number of threads; nothing is scattered, so there are no locks or atomics.

use rayon::prelude::*;

use crate::interactions::simd::with_simd;

/// Targets per chunk.
pub const CHUNK: usize = 128;

/// Do `task` on a thread of the pool: the loops inside then start without waking the pool each time.
pub fn within_pool<T: Send>(task: impl FnOnce() -> T + Send) -> T {
    if rayon::current_thread_index().is_some() { task() } else { rayon::scope(|_| task()) }
}

/// Do `task` with a pool of `threads` of its own.
pub fn on_threads<T: Send>(threads: usize, task: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("a system that gives threads").install(task)
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

/// `of(targets)` for every chunk of `n` targets, in order.
pub fn by_chunk<T: Send>(n: usize, of: impl Fn(std::ops::Range<usize>) -> T + Sync) -> Vec<T> {
    (0..n.div_ceil(CHUNK)).into_par_iter().map(|c| with_simd(|| of(c * CHUNK..((c + 1) * CHUNK).min(n)))).collect()
}

/// `of(targets)` for every piece of `n` targets, in order.
pub fn by_piece<T: Send>(n: usize, of: impl Fn(std::ops::Range<usize>) -> T + Sync) -> Vec<T> {
    (0..n.div_ceil(PIECE)).into_par_iter().map(|c| with_simd(|| of(c * PIECE..((c + 1) * PIECE).min(n)))).collect()
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
    let of_chunk = |targets: std::ops::Range<usize>| {
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
pub fn least(n: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|c| (c * CHUNK..((c + 1) * CHUNK).min(n)).map(&value).fold(f64::INFINITY, f64::min))
        .reduce(|| f64::INFINITY, f64::min)
}

/// Particles per piece of a verb that asks each only about itself.
const PIECE: usize = 8 * CHUNK;

/// `change(range, [a[range], b[range], …])` for every piece of arrays of one length.
pub fn each<T: Send, const N: usize>(
    arrays: [&mut Vec<T>; N],
    change: impl Fn(std::ops::Range<usize>, [&mut [T]; N]) + Sync,
) {
    let length = arrays.first().map_or(0, |a| a.len());
    let mut rest = arrays.map(|a| a.as_mut_slice().chunks_mut(PIECE));
    let pieces: Vec<[&mut [T]; N]> = (0..length.div_ceil(PIECE))
        .map(|_| std::array::from_fn(|i| rest[i].next().expect("arrays of one length")))
        .collect();
    pieces.into_par_iter().enumerate().for_each(|(c, parts)| {
        let from = c * PIECE;
        with_simd(|| change(from..from + parts[0].len(), parts));
    });
}

/// True if `holds(k)` for each of `n`.
pub fn every(n: usize, holds: impl Fn(usize) -> bool + Sync) -> bool {
    let all = |c: usize| with_simd(|| (c * PIECE..((c + 1) * PIECE).min(n)).fold(true, |all, k| all & holds(k)));
    (0..n.div_ceil(PIECE)).into_par_iter().all(all)
}

/// True if `holds(targets)` for every chunk of `n` targets.
pub fn every_chunk(n: usize, holds: impl Fn(std::ops::Range<usize>) -> bool + Sync) -> bool {
    let of = |c: usize| with_simd(|| holds(c * CHUNK..((c + 1) * CHUNK).min(n)));
    (0..n.div_ceil(CHUNK)).into_par_iter().all(of)
}

/// Fill a list for every chunk of `n` targets.
pub fn for_each_chunk<T: Send>(lists: &mut [T], n: usize, fill: impl Fn(std::ops::Range<usize>, &mut T) + Sync) {
    for_each_chunk_with(lists, n, || (), |_, targets, list| fill(targets, list));
}

/// Fill a list for every chunk of `n` targets, with something `made` to work with.
pub fn for_each_chunk_with<T: Send, S>(
    lists: &mut [T],
    n: usize,
    made: impl Fn() -> S + Sync + Send,
    fill: impl Fn(&mut S, std::ops::Range<usize>, &mut T) + Sync,
) {
    let lists = lists.par_iter_mut().enumerate();
    lists.for_each_init(made, |with, (c, list)| fill(with, c * CHUNK..((c + 1) * CHUNK).min(n), list));
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

/// `of(c)` for each of `n` pieces, in order.
pub fn map_pieces<T: Send>(n: usize, of: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    (0..n).into_par_iter().map(of).collect()
}

/// `change(c, pieces[c])` for every piece.
pub fn each_piece<T: Send>(pieces: Vec<T>, change: impl Fn(usize, T) + Sync) {
    pieces.into_par_iter().enumerate().for_each(|(c, piece)| change(c, piece));
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
