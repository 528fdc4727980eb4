//! A picture of the water in cells: which are covered by a particle, and how large the holes between them are.

use crate::parallel;

/// Cells around the box that is asked for.
const MARGIN: f64 = 8.0;
/// Rows of cells that are covered together.
const BAND: usize = 32;
/// Cells along a block's side.
const BLOCK: usize = 8;
/// The mark of air that is nothing but air.
const ALL: f64 = 253.0;

/// Cells of one side length over a box.
#[derive(Clone, Debug, Default)]
pub struct OccupancyGrid {
    /// Lower left corner [m].
    pub origin: [f64; 2],
    /// Side of a cell [m].
    pub side: f64,
    /// Cells in a row; 0 where there is no grid.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// 64-bit words to a row.
    words: usize,
    /// One bit a cell, set where a disc covers the cell's centre.
    covered: Vec<u64>,
    /// Discs that touch each band.
    bands: Vec<Vec<Disc>>,
    /// Share of air in ALL-ths, a cell; 0 where covered.
    air: Vec<u8>,
    /// Whether a block of cells has any air; row by row of blocks.
    airy: Vec<bool>,
    holes: Holes,
}

/// A disc in cells.
#[derive(Clone, Copy, Debug)]
struct Disc {
    x: f64,
    y: f64,
    radius: f64,
}

/// Open cells `from..to` of a row.
#[derive(Clone, Copy, Debug)]
struct Run {
    row: u32,
    from: u32,
    to: u32,
}

/// Runs of open cells, joined to holes.
#[derive(Clone, Debug, Default)]
struct Holes {
    runs: Vec<Run>,
    /// A run of the same hole, before it or itself.
    parent: Vec<u32>,
    /// Cells, at the first run of each hole.
    cells: Vec<u32>,
}

impl OccupancyGrid {
    /// An open grid over the box from `lo` to `hi` [m].
    pub fn lay(&mut self, lo: [f64; 2], hi: [f64; 2], side: f64) {
        let margin = MARGIN * side;
        self.origin = [lo[0] - margin, lo[1] - margin];
        self.side = side;
        self.columns = ((hi[0] - lo[0] + 2.0 * margin) / side) as usize + 1;
        self.rows = ((hi[1] - lo[1] + 2.0 * margin) / side) as usize + 1;
        self.words = self.columns.div_ceil(64);
        self.covered.clear();
        self.covered.resize(self.words * self.rows, 0);
        self.bands.resize_with(self.rows.div_ceil(BAND), Vec::new);
        for band in &mut self.bands {
            band.clear();
        }
    }

    /// Cover the cells whose centres lie within `radius` [m] of a place [m].
    pub fn add(&mut self, x: f64, y: f64, radius: f64) {
        let [x, y] = self.cell([x, y]);
        let radius = radius / self.side;
        let (low, high) = (y - radius, y + radius);
        let outside = x + radius < 0.0 || high < 0.0 || x - radius > self.columns as f64 || low > self.rows as f64;
        if outside {
            return;
        }
        let last = self.bands.len() - 1;
        for band in low.max(0.0) as usize / BAND..=(high as usize / BAND).min(last) {
            self.bands[band].push(Disc { x, y, radius });
        }
    }

    /// Cover the cells whose centres lie in covered cells of a finer grid, which was classified.
    pub fn copy(&mut self, finer: &OccupancyGrid) {
        if finer.columns == 0 {
            return;
        }
        let scale = self.side / finer.side;
        let [x, y] = finer.cell(self.origin).map(|a| a + 0.5 * scale + 0.5);
        for row in 0..self.rows {
            let below = y + scale * row as f64;
            if below < 0.0 || below as usize >= finer.rows {
                continue;
            }
            let from = from_above(-x / scale);
            let to = (((finer.columns as f64 - x) / scale).max(0.0) as usize).min(self.columns);
            for column in from..to {
                let beneath = ((x + scale * column as f64) as usize).min(finer.columns - 1);
                let bit = finer.covered[below as usize * finer.words + beneath / 64] >> (beneath % 64) & 1;
                self.covered[row * self.words + column / 64] |= bit << (column % 64);
            }
        }
    }

    /// What was added covers its cells; every hole gets the share of air that `share` gives for its size [cells].
    pub fn classify(&mut self, share: impl Fn(f64) -> f64) {
        let (words, columns) = (self.words, self.columns);
        let bands = &self.bands;
        parallel::update_pieces(&mut self.covered, BAND * words, |band, cells| {
            for disc in &bands[band] {
                disc.cover(cells, words, columns, band * BAND);
            }
        });
        self.holes.find(&self.covered, words, columns);
        self.air.clear();
        self.air.resize(columns * self.rows, 0);
        let blocks = columns.div_ceil(BLOCK);
        self.airy.clear();
        self.airy.resize(blocks * self.rows.div_ceil(BLOCK), false);
        for (k, run) in self.holes.runs.iter().enumerate() {
            let mark = (share(f64::from(self.holes.cells[self.holes.parent[k] as usize])) * ALL) as u8;
            if mark == 0 {
                continue;
            }
            let (row, from, to) = (run.row as usize, run.from as usize, run.to as usize);
            self.air[row * columns + from..row * columns + to].fill(mark);
            self.airy[row / BLOCK * blocks + from / BLOCK..=row / BLOCK * blocks + (to - 1) / BLOCK].fill(true);
        }
    }

    /// A place [m] in cells, from the centre of the first.
    pub fn cell(&self, place: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| (place[i] - self.origin[i]) / self.side - 0.5)
    }

    /// False where no cell less than `reach` away, along both axes, is air.
    pub fn may_have_air(&self, column: i32, row: i32, reach: i32) -> bool {
        let blocks = self.columns.div_ceil(BLOCK);
        let span = |at: i32, cells: usize| {
            let last = cells as i32 - 1;
            (at - reach).clamp(0, last) as usize / BLOCK..=(at + reach).clamp(0, last) as usize / BLOCK
        };
        span(row, self.rows).any(|row| span(column, self.columns).any(|column| self.airy[row * blocks + column]))
    }

    /// False where every cell at most `reach` away, along both axes, is covered.
    pub fn is_open_within(&self, column: i32, row: i32, reach: i32) -> bool {
        let clamp = |at: i32, cells: usize| at.clamp(0, cells as i32 - 1) as usize;
        let (from, to) = (clamp(column - reach, self.columns), clamp(column + reach, self.columns));
        (clamp(row - reach, self.rows)..=clamp(row + reach, self.rows)).any(|row| {
            let words = &self.covered[row * self.words..][..self.words];
            (from / 64..=to / 64).any(|word| {
                let low = if word == from / 64 { from % 64 } else { 0 };
                let high = if word == to / 64 { to % 64 } else { 63 };
                !words[word] & (u64::MAX << low) & (u64::MAX >> (63 - high)) != 0
            })
        })
    }

    /// How much the cell is air [-], the cell inside the grid.
    #[inline(always)]
    pub fn share(&self, column: usize, row: usize) -> f64 {
        f64::from(self.air[row * self.columns + column]) / ALL
    }
}

impl Disc {
    /// Set the bits of the cells of a band, whose first row is `first`, that lie within the disc.
    fn cover(&self, cells: &mut [u64], words: usize, columns: usize, first: usize) {
        let last = first + cells.len() / words;
        let rows = from_above(self.y - self.radius).max(first)..(self.y + self.radius + 1.0) as usize;
        let square = self.radius * self.radius;
        for row in rows.start..rows.end.min(last) {
            let dy = row as u32 as f64 - self.y;
            let half = (square - dy * dy).max(0.0).sqrt();
            let (from, to) = (from_above(self.x - half), (below(self.x + half + 1.0)).min(columns));
            set(&mut cells[(row - first) * words..][..words], from, to);
        }
    }
}

/// The least whole number from `a` on, 0 at least.
fn from_above(a: f64) -> usize {
    let whole = below(a);
    whole + usize::from(f64::from(whole as u32) < a)
}

/// The largest whole number up to `a`, 0 at least.
fn below(a: f64) -> usize {
    a as u32 as usize
}

/// Set the bits `from..to`.
fn set(words: &mut [u64], from: usize, to: usize) {
    if from >= to {
        return;
    }
    let (first, last) = (from / 64, (to - 1) / 64);
    if first == last {
        words[first] |= (u64::MAX >> (63 - (to - 1 - from))) << (from % 64);
        return;
    }
    for word in first..=last {
        let low = if word == first { from % 64 } else { 0 };
        let high = if word == last { (to - 1) % 64 } else { 63 };
        words[word] |= (u64::MAX << low) & (u64::MAX >> (63 - high));
    }
}

impl Holes {
    /// Open cells that share a side belong to one hole.
    fn find(&mut self, covered: &[u64], words: usize, columns: usize) {
        let Holes { runs, parent, cells } = self;
        runs.clear();
        parent.clear();
        cells.clear();
        let mut above = 0..0;
        for (row, bits) in covered.chunks_exact(words).enumerate() {
            let start = runs.len();
            open_runs(bits, columns, |from, to| {
                parent.push(runs.len() as u32);
                cells.push((to - from) as u32);
                runs.push(Run { row: row as u32, from: from as u32, to: to as u32 });
            });
            let mut other = above.start;
            for run in start..runs.len() {
                while other < above.end && runs[other].to <= runs[run].from {
                    other += 1;
                }
                let mut touching = other;
                while touching < above.end && runs[touching].from < runs[run].to {
                    join(parent, cells, touching as u32, run as u32);
                    touching += 1;
                }
            }
            above = start..runs.len();
        }
        for k in 0..parent.len() {
            parent[k] = parent[parent[k] as usize]; // parents come first: theirs are found
        }
    }
}

/// `found(from, to)` for each run of bits that are not set.
fn open_runs(bits: &[u64], columns: usize, mut found: impl FnMut(usize, usize)) {
    let mut from = None;
    for (word, &covered) in bits.iter().enumerate() {
        let base = 64 * word;
        let count = (columns - base).min(64);
        let mut at = 0;
        while at < count {
            let rest = covered >> at;
            // how far it goes on as it is
            let length = if from.is_some() { rest.trailing_zeros() } else { rest.trailing_ones() } as usize;
            at = (at + length).min(count);
            if at < count {
                match from.take() {
                    Some(start) => found(start, base + at),
                    None => from = Some(base + at),
                }
            }
        }
    }
    if let Some(start) = from {
        found(start, columns);
    }
}

/// Make two holes one.
fn join(parent: &mut [u32], cells: &mut [u32], a: u32, b: u32) {
    let (a, b) = (root(parent, a), root(parent, b));
    if a != b {
        let (first, second) = (a.min(b), a.max(b));
        parent[second as usize] = first;
        cells[first as usize] += cells[second as usize];
    }
}

fn root(parent: &mut [u32], mut k: u32) -> u32 {
    while parent[k as usize] != k {
        parent[k as usize] = parent[parent[k as usize] as usize];
        k = parent[k as usize];
    }
    k
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Two halves of a pond, the left one drawn finely first: the same cells are covered but for those at its edge.
    #[test]
    fn a_coarse_grid_takes_over_what_a_finer_one_has() {
        let mut fine = OccupancyGrid::default();
        fine.lay([0.0; 2], [1.0, 1.0], 0.05);
        fine.add(0.5, 0.5, 0.45);
        fine.classify(|_| 1.0);
        let mut coarse = OccupancyGrid::default();
        coarse.lay([-1.0; 2], [3.0, 2.0], 0.1);
        coarse.copy(&fine);
        coarse.classify(|_| 1.0);
        for row in 0..coarse.rows {
            for column in 0..coarse.columns {
                let at = |i: usize, k: usize| coarse.origin[i] + (k as f64 + 0.5) * coarse.side;
                let r = (at(0, column) - 0.5).hypot(at(1, row) - 0.5);
                let expected = if r < 0.41 { 0.0 } else { 1.0 };
                assert!((r - 0.45).abs() < 0.04 || coarse.share(column, row) == expected, "{column} {row}: {r}");
            }
        }
    }

    /// Within two cells along both axes of the only open one, and nowhere else; across the edge of a word too.
    #[test]
    fn an_open_cell_is_seen_as_far_as_is_asked() {
        let mut grid = OccupancyGrid::default();
        grid.lay([0.0; 2], [80.0, 20.0], 1.0);
        grid.covered.fill(u64::MAX);
        let open = (64, 9);
        grid.covered[open.1 * grid.words + 1] = !1;
        for row in 0..grid.rows as i32 {
            for column in 0..grid.columns as i32 {
                let near = (column - open.0).abs() <= 2 && (row - open.1 as i32).abs() <= 2;
                assert_eq!(grid.is_open_within(column, row, 2), near, "{column} {row}");
            }
        }
    }

    proptest! {
        /// Against every cell tested against every disc, and a flood from cell to cell.
        #[test]
        fn holes_are_what_a_flood_finds(discs in prop::collection::vec((0.0..9.0f64, 0.0..4.0f64, 0.2..0.9f64), 1..60)) {
            let mut grid = OccupancyGrid::default();
            grid.lay([0.0; 2], [9.0, 4.0], 0.1);
            for &(x, y, r) in &discs {
                grid.add(x, y, r);
            }
            grid.classify(|cells| (cells / 500.0).min(1.0));
            let (columns, rows) = (grid.columns, grid.rows);
            let open = |c: usize| {
                let (i, j) = ((c % columns) as f64, (c / columns) as f64);
                let near = |&(x, y, r): &(f64, f64, f64)| {
                    let [x, y] = grid.cell([x, y]);
                    (i - x).powi(2) + (j - y).powi(2) <= (r / grid.side).powi(2)
                };
                !discs.iter().any(near)
            };
            let mut seen = vec![false; columns * rows];
            for start in 0..columns * rows {
                if seen[start] || !open(start) {
                    prop_assert!(seen[start] || grid.air[start] == 0);
                    continue;
                }
                let mut hole = vec![start];
                seen[start] = true;
                let mut at = 0;
                while at < hole.len() {
                    let c = hole[at];
                    at += 1;
                    let (i, j) = (c % columns, c / columns);
                    let beside = [(i > 0, c.wrapping_sub(1)), (i + 1 < columns, c + 1),
                        (j > 0, c.wrapping_sub(columns)), (j + 1 < rows, c + columns)];
                    for (inside, n) in beside {
                        if inside && !seen[n] && open(n) {
                            seen[n] = true;
                            hole.push(n);
                        }
                    }
                }
                let mark = ((hole.len() as f64 / 500.0).min(1.0) * ALL) as u8;
                for c in hole {
                    prop_assert_eq!(grid.air[c], mark);
                }
            }
        }
    }
}
