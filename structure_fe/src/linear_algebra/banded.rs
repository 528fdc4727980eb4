//! A banded matrix and its factors: O(n b^2) for n unknowns of half-bandwidth b (THEORY BE19).

/// A square matrix with entries within `half` of its diagonal only, stored by rows.
///
/// The band is allocated once per model. Factors L U without pivoting (Golub & Van Loan 2013, 4.3): the tangents of
/// this crate are nearly symmetric, with pivots far from zero except at limit points.
#[derive(Debug, Clone)]
pub(crate) struct Banded {
    unknowns: usize,
    half: usize,
    values: Vec<f64>,
}

/// A pivot that vanished: the matrix is singular to rounding.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ZeroPivot {
    pub equation: usize,
}

/// A pivot smaller than this fraction of its diagonal entry is rounding \[-\].
pub(super) const SMALLEST_PIVOT: f64 = 1e-14;

impl Banded {
    pub fn new(unknowns: usize, half: usize) -> Self {
        Self { unknowns, half, values: vec![0.0; unknowns * (2 * half + 1)] }
    }

    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Whether an entry lies within the band.
    pub fn holds(&self, row: usize, column: usize) -> bool {
        row.abs_diff(column) <= self.half
    }

    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.values[row * (2 * self.half + 1) + self.half + column - row] += value;
    }

    /// Replaces the matrix by its factors; returns how many pivots are negative, which is how many
    /// directions a symmetric matrix is unstable in (Sylvester 1852).
    pub fn factorise(&mut self) -> Result<usize, ZeroPivot> {
        let (half, width) = (self.half, 2 * self.half + 1);
        let mut negative = 0;
        let diagonal: Vec<f64> = (0..self.unknowns).map(|i| self.values[i * width + half].abs()).collect();
        for k in 0..self.unknowns {
            let (above, below) = self.values.split_at_mut((k + 1) * width);
            let row = &mut above[k * width + half..];
            let pivot = row[0];
            // This form also rejects a pivot that is not a number.
            let regular = pivot.abs() > SMALLEST_PIVOT * diagonal[k];
            if !regular {
                return Err(ZeroPivot { equation: k });
            }
            negative += usize::from(pivot < 0.0);
            // The factors store the inverse of the pivot: a division costs more than the row's other operations.
            row[0] = pivot.recip();
            let (inverse, row) = (row[0], &row[1..]);
            for (offset, other) in below.chunks_exact_mut(width).take(half).enumerate() {
                // The entry of column k in row k + 1 + offset, and those to its right.
                let other = &mut other[half - 1 - offset..];
                if other[0] != 0.0 {
                    let factor = other[0] * inverse;
                    other[0] = factor;
                    for (entry, upper) in other[1..=half].iter_mut().zip(row) {
                        *entry -= factor * upper;
                    }
                }
            }
        }
        Ok(negative)
    }

    /// Solves with the factors, in place.
    pub fn solve(&self, x: &mut [f64]) {
        let (half, width) = (self.half, 2 * self.half + 1);
        for i in 0..self.unknowns {
            let first = i.saturating_sub(half);
            let row = &self.values[i * width + half + first - i..i * width + half];
            let sum: f64 = row.iter().zip(&x[first..i]).map(|(l, x)| l * x).sum();
            x[i] -= sum;
        }
        for i in (0..self.unknowns).rev() {
            let last = (i + half + 1).min(self.unknowns);
            let row = &self.values[i * width + half..];
            let sum: f64 = row[1..].iter().zip(&x[i + 1..last]).map(|(u, x)| u * x).sum();
            x[i] = (x[i] - sum) * row[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solution_satisfies_its_equations() {
        for (unknowns, half) in [(1, 0), (2, 3), (40, 5), (40, 39)] {
            let entry = |i: usize, j: usize| {
                if i == j { 30.0 - 7.0 * (i % 9) as f64 } else { ((7 * i + 3 * j) as f64).sin() }
            };
            let inside = |i: usize, j: usize| i.abs_diff(j) <= half;
            let mut matrix = Banded::new(unknowns, half);
            for _ in 0..2 {
                matrix.clear();
                for i in 0..unknowns {
                    for j in (0..unknowns).filter(|&j| inside(i, j)) {
                        matrix.add(i, j, entry(i, j));
                    }
                }
            }
            let wanted: Vec<f64> = (0..unknowns).map(|i| (i as f64).cos()).collect();
            let mut x: Vec<f64> = (0..unknowns)
                .map(|i| (0..unknowns).filter(|&j| inside(i, j)).map(|j| entry(i, j) * wanted[j]).sum())
                .collect();
            matrix.factorise().unwrap();
            matrix.solve(&mut x);
            for (x, wanted) in x.iter().zip(&wanted) {
                assert!((x - wanted).abs() < 1e-10, "{unknowns}, {half}: {x} against {wanted}");
            }
        }
    }

    #[test]
    fn a_singular_matrix_names_its_equation_and_an_indefinite_one_counts() {
        let mut matrix = Banded::new(3, 1);
        for (i, j, value) in [(0, 0, 1.0), (1, 1, 1.0), (0, 1, 1.0), (1, 0, 1.0), (2, 2, 1.0)] {
            matrix.add(i, j, value);
        }
        assert_eq!(matrix.factorise().unwrap_err().equation, 1);
        let mut matrix = Banded::new(3, 1);
        for (i, value) in [(0, 2.0), (1, -3.0), (2, -1.0)] {
            matrix.add(i, i, value);
        }
        assert_eq!(matrix.factorise().unwrap(), 2);
    }
}
