//! Sections between stations with outlines (THEORY EN54).

use super::monotone::Monotone;

/// Shares of the girth that differ by less are one [-].
const SAME: f64 = 2e-4;

/// Bottoms of stations, from the keel to the edges.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Loft {
    x: Vec<f64>,
    lines: Vec<Line>,
}

/// A line of points from the keel [m], and the share of its girth at each [-].
#[derive(Clone, Debug, PartialEq)]
struct Line {
    points: Vec<[f64; 2]>,
    shares: Vec<f64>,
}

impl Line {
    fn new(points: Vec<[f64; 2]>) -> Line {
        let mut way = 0.0;
        let lengths = points.windows(2).map(|w| {
            way += (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]);
            way
        });
        let ways: Vec<f64> = std::iter::once(0.0).chain(lengths.collect::<Vec<_>>()).collect();
        let shares = ways.iter().map(|s| s / way).collect();
        Line { points, shares }
    }

    fn at(&self, share: f64) -> [f64; 2] {
        let k = self.shares.partition_point(|s| *s < share).clamp(1, self.shares.len() - 1);
        let part = (share - self.shares[k - 1]) / (self.shares[k] - self.shares[k - 1]);
        [0, 1].map(|c| self.points[k - 1][c] + part * (self.points[k][c] - self.points[k - 1][c]))
    }
}

impl Loft {
    /// Of the lines from keel to edge at places x [m], shape (stations, points, 2).
    pub fn new(x: Vec<f64>, lines: Vec<Vec<[f64; 2]>>) -> Loft {
        Loft { x, lines: lines.into_iter().map(Line::new).collect() }
    }

    /// EN54: the line at x [m], between the stations `k` and `k` + 1: points at the same share of the girth follow the monotone cubics of the
    /// stations' values.
    pub fn at(&self, k: usize, x: f64) -> Vec<[f64; 2]> {
        let mut shares = [&self.lines[k].shares[..], &self.lines[k + 1].shares[..]].concat();
        shares.sort_by(f64::total_cmp);
        shares.dedup_by(|b, a| *b - *a < SAME);
        if let Some(last) = shares.last_mut() {
            *last = 1.0;
        }
        // slopes at both ends follow from the next stations
        let near = k.saturating_sub(1)..=(k + 2).min(self.x.len() - 1);
        let points = shares.iter().map(|share| {
            let at: Vec<[f64; 2]> = self.lines[near.clone()].iter().map(|line| line.at(*share)).collect();
            [0, 1].map(|c| Monotone::through(self.x[near.clone()].to_vec(), at.iter().map(|p| p[c]).collect()).at(x)[0])
        });
        points.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Halfway between a wedge and its like of twice the size lies that of one and a half times.
    #[test]
    fn alike_lines_loft_to_their_like() {
        let line = |size: f64| vec![[0.0, 0.0], [0.5 * size, 0.1 * size], [size, 0.5 * size]];
        let loft = Loft::new(vec![0.0, 2.0], vec![line(1.0), line(2.0)]);
        for (ours, exact) in loft.at(0, 1.0).iter().zip(line(1.5)) {
            assert!((ours[0] - exact[0]).abs() < 1e-12 && (ours[1] - exact[1]).abs() < 1e-12, "{ours:?} {exact:?}");
        }
    }
}
