//! A banded matrix with a border for unknowns that couple with all others.

use super::banded::{Banded, SMALLEST_PIVOT, ZeroPivot};

/// A square matrix whose last unknowns (rigid bodies) may couple with all others; the others are banded.
///
/// Blocks [A B; C D]: A banded, eliminated first; then the Schur complement D - C A^-1 B (Golub & Van Loan
/// 2013, 3.2). O(n) for a border of fixed width, for any number of links.
#[derive(Debug, Clone)]
pub(crate) struct Bordered {
    band: Banded,
    inner: usize,
    border: usize,
    /// Columns of B, after elimination of A^-1 B.
    right: Vec<f64>,
    /// Rows of C.
    below: Vec<f64>,
    /// D, then the factors of its Schur complement.
    corner: Vec<f64>,
}

impl Bordered {
    /// Of `inner` unknowns of half-bandwidth `half`, and `border` more.
    pub fn new(inner: usize, half: usize, border: usize) -> Self {
        Self {
            band: Banded::new(inner, half),
            inner,
            border,
            right: vec![0.0; border * inner],
            below: vec![0.0; border * inner],
            corner: vec![0.0; border * border],
        }
    }

    pub fn clear(&mut self) {
        self.band.clear();
        for values in [&mut self.right, &mut self.below, &mut self.corner] {
            values.fill(0.0);
        }
    }

    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let n = self.inner;
        if row < n && column < n {
            self.band.add(row, column, value);
        } else if row < n {
            self.right[(column - n) * n + row] += value;
        } else if column < n {
            self.below[(row - n) * n + column] += value;
        } else {
            self.corner[(row - n) * self.border + column - n] += value;
        }
    }

    /// Whether the matrix has room for an entry.
    pub fn holds(&self, row: usize, column: usize) -> bool {
        row >= self.inner || column >= self.inner || self.band.holds(row, column)
    }

    /// Replaces the matrix by its factors; returns how many pivots are negative.
    pub fn factorise(&mut self) -> Result<usize, ZeroPivot> {
        let (n, border) = (self.inner, self.border);
        let mut negative = self.band.factorise()?;
        let diagonal: Vec<f64> = (0..border).map(|k| self.corner[k * border + k].abs()).collect();
        for column in 0..border {
            let solved = &mut self.right[column * n..(column + 1) * n];
            self.band.solve(solved);
            for row in 0..border {
                let below = &self.below[row * n..(row + 1) * n];
                self.corner[row * border + column] -= below.iter().zip(&*solved).map(|(c, z)| c * z).sum::<f64>();
            }
        }
        for k in 0..border {
            let pivot = self.corner[k * border + k];
            // This form also rejects a pivot that is not a number.
            let regular = pivot.abs() > SMALLEST_PIVOT * diagonal[k];
            if !regular {
                return Err(ZeroPivot { equation: n + k });
            }
            negative += usize::from(pivot < 0.0);
            for row in k + 1..border {
                let factor = self.corner[row * border + k] / pivot;
                self.corner[row * border + k] = factor;
                for column in k + 1..border {
                    self.corner[row * border + column] -= factor * self.corner[k * border + column];
                }
            }
        }
        Ok(negative)
    }

    /// Solves with the factors, in place.
    pub fn solve(&self, x: &mut [f64]) {
        let (n, border) = (self.inner, self.border);
        let (inner, outer) = x.split_at_mut(n);
        self.band.solve(inner);
        for row in 0..border {
            let below = &self.below[row * n..(row + 1) * n];
            outer[row] -= below.iter().zip(&*inner).map(|(c, y)| c * y).sum::<f64>();
            for column in 0..row {
                outer[row] -= self.corner[row * border + column] * outer[column];
            }
        }
        for row in (0..border).rev() {
            for column in row + 1..border {
                outer[row] -= self.corner[row * border + column] * outer[column];
            }
            outer[row] /= self.corner[row * border + row];
        }
        for column in 0..border {
            let solved = &self.right[column * n..(column + 1) * n];
            for (x, z) in inner.iter_mut().zip(solved) {
                *x -= z * outer[column];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solution_satisfies_its_equations() {
        let (inner, half, border) = (20, 3, 4);
        let n = inner + border;
        let entry = |i: usize, j: usize| {
            if i == j { 30.0 + (i % 5) as f64 } else { ((5 * i + 3 * j) as f64).sin() }
        };
        let mut matrix = Bordered::new(inner, half, border);
        let places: Vec<_> = (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).collect();
        let held: Vec<_> = places.into_iter().filter(|&(i, j)| matrix.holds(i, j)).collect();
        let wanted: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
        for _ in 0..2 {
            matrix.clear();
            let mut x = vec![0.0; n];
            for &(i, j) in &held {
                matrix.add(i, j, entry(i, j));
                x[i] += entry(i, j) * wanted[j];
            }
            assert_eq!(matrix.factorise().unwrap(), 0);
            matrix.solve(&mut x);
            for (x, wanted) in x.iter().zip(&wanted) {
                assert!((x - wanted).abs() < 1e-12, "{x} against {wanted}");
            }
        }
    }

    #[test]
    fn a_singular_border_names_its_equation() {
        let mut matrix = Bordered::new(1, 0, 2);
        for (i, j, value) in [(0, 0, 1.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 1.0), (2, 2, 1.0)] {
            matrix.add(i, j, value);
        }
        assert_eq!(matrix.factorise().unwrap_err().equation, 1);
    }
}
