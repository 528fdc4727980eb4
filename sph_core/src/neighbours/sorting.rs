//! Counting sort of points by cell, in parallel and stable: pieces of the points are sorted by band of cells, then each band gathers
//! its points from the pieces in order and sorts them by cell. What is written lies in one piece or in one band.

use crate::memory::of_vector;
use crate::neighbours::point::Point;
use crate::parallel;

/// Points per piece.
const PIECE: usize = 4096;
/// Most bands of cells.
const MOST_BANDS: usize = 256;
/// Fewest cells per band, as a power of two.
const LEAST_CELLS: u32 = 8;

/// Where points are to be placed; kept from one sort to the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    /// Cell of each point.
    cell: Vec<u32>,
    /// The points of each piece by band.
    by_band: Vec<u32>,
    /// Where in `by_band` each band of each piece starts, counted from the start of the piece; and the piece's end.
    start: Vec<u32>,
    /// Cells per band, as a power of two.
    shift: u32,
    bands: usize,
}

impl Places {
    /// Points of band `b` of piece `c`.
    fn of(&self, c: usize, b: usize) -> &[u32] {
        let at = c * (self.bands + 1) + b;
        &self.by_band[c * PIECE + self.start[at] as usize..c * PIECE + self.start[at + 1] as usize]
    }

    /// What they hold on to [bytes].
    pub fn bytes(&self) -> usize {
        [&self.cell, &self.by_band, &self.start].map(of_vector).iter().sum()
    }
}

/// Find the cells of `n` points, below `cells`, and sort each piece by band.
pub(super) fn count_cells(n: usize, cells: usize, cell_of: impl Fn(usize) -> usize + Sync, places: &mut Places) {
    let shift =
        (LEAST_CELLS..).find(|&shift| cells.div_ceil(1 << shift) <= MOST_BANDS).expect("cells are counted in 32 bits");
    let bands = cells.div_ceil(1 << shift);
    (places.shift, places.bands) = (shift, bands);
    places.cell.resize(n, 0);
    places.by_band.resize(n, 0);
    places.start.resize(n.div_ceil(PIECE) * (bands + 1), 0);
    let Places { cell, by_band, start, .. } = places;
    let pieces = cell.chunks_mut(PIECE).zip(by_band.chunks_mut(PIECE)).zip(start.chunks_mut(bands + 1));
    parallel::each_piece(pieces.collect(), |c, ((cell, by_band), start)| {
        start.fill(0);
        for (k, cell) in cell.iter_mut().enumerate() {
            *cell = cell_of(c * PIECE + k) as u32;
            start[(*cell >> shift) as usize] += 1;
        }
        ends_of_counts(start, 0);
        for (k, cell) in cell.iter().enumerate().rev() {
            let end = &mut start[(cell >> shift) as usize];
            *end -= 1;
            by_band[*end as usize] = (c * PIECE + k) as u32;
        }
    });
}

/// Place the points by cell; `start` ← where each cell starts, the first at `base`.
pub(super) fn place_points(
    places: &Places,
    base: u32,
    start: &mut [u32],
    points: &mut [Point],
    point: impl Fn(usize) -> Point + Sync,
) {
    let pieces = places.cell.len().div_ceil(PIECE);
    let (mut from, mut rest) = (base, points);
    let mut bands = Vec::with_capacity(places.bands);
    for (b, start) in start.chunks_mut(1 << places.shift).enumerate() {
        let count: usize = (0..pieces).map(|c| places.of(c, b).len()).sum();
        let (own, after) = rest.split_at_mut(count);
        bands.push((from, start, own));
        (from, rest) = (from + count as u32, after);
    }
    parallel::each_piece(bands, |b, (from, start, own)| {
        let place = |k: u32| (places.cell[k as usize] as usize) - (b << places.shift);
        start.fill(0);
        for c in 0..pieces {
            places.of(c, b).iter().for_each(|&k| start[place(k)] += 1);
        }
        ends_of_counts(start, from);
        for c in (0..pieces).rev() {
            for &k in places.of(c, b).iter().rev() {
                let end = &mut start[place(k)];
                *end -= 1;
                own[(*end - from) as usize] = point(k as usize);
            }
        }
    });
}

/// Each count ← the end of what it counts, the first starting at `from`; taken one by one from there, the ends become starts.
fn ends_of_counts(counts: &mut [u32], from: u32) {
    counts.iter_mut().fold(from, |end, count| {
        *count += end;
        *count
    });
}
