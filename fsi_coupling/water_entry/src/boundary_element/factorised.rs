//! A square system of equations, factorised in place (LU with partial pivoting).

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::lu::partial_pivoting::solve::{solve_transpose_in_place, solve_transpose_in_place_scratch};
use faer::perm::PermRef;
use faer::{MatMut, MatRef, Par};

use super::buffer::Buffer;

/// Equations of as many unknowns.
pub(crate) struct Factorised {
    /// Factors of the transposed matrix, by columns.
    factors: Buffer,
    size: usize,
    /// Its permutation and the inverse of that.
    order: [Vec<usize>; 2],
}

impl Factorised {
    /// Of a matrix of `size` rows, one after the other.
    pub fn new(mut rows: Buffer, size: usize) -> Factorised {
        let mut order = [vec![0; size], vec![0; size]];
        let mut memory = MemBuffer::new(lu_in_place_scratch::<usize, f64>(size, size, Par::Seq, Default::default()));
        let [forth, back] = &mut order;
        let transposed = MatMut::from_column_major_slice_mut(&mut rows, size, size);
        lu_in_place(transposed, forth, back, Par::Seq, MemStack::new(&mut memory), Default::default());
        Factorised { factors: rows, size, order }
    }

    /// The right side is replaced by the solution.
    pub fn solve(&self, right: &mut [f64]) {
        let factors = MatRef::from_column_major_slice(&self.factors, self.size, self.size);
        let [forth, back] = &self.order;
        let order = PermRef::new_checked(forth, back, self.size);
        let mut memory = MemBuffer::new(solve_transpose_in_place_scratch::<usize, f64>(self.size, 1, Par::Seq));
        let right = MatMut::from_column_major_slice_mut(right, self.size, 1);
        solve_transpose_in_place(factors, factors, order, right, Par::Seq, MemStack::new(&mut memory));
    }
}
