//! The pressure equation's rows (THEORY LE22, LE23, LE28).

use crate::legacy::pilorget2010::bicgstab::Matrix;
use crate::legacy::pilorget2010::cast::Cast;
use crate::legacy::pilorget2010::pairs::Pairs;
use crate::legacy::pilorget2010::settings::LimitRows;

/// What the rows are made of.
pub(crate) struct Assembly<'a> {
    pub cast: &'a Cast,
    pub pairs: &'a Pairs,
    /// ρ* [kg/m³] of each row.
    pub density: &'a [f64],
    pub at_surface: &'a [bool],
    /// Normals of the limit particles, in the order of their rows.
    pub normals: &'a [[f64; 2]],
    pub limit_rows: LimitRows,
    pub rho0: f64,
    pub dt: f64,
}

impl Assembly<'_> {
    /// A and b of A P = b [1/s²].
    pub fn rows(&self) -> (Matrix, Vec<f64>) {
        let n = self.cast.rows;
        let fluid = n - self.normals.len();
        let mut a = Matrix { start: vec![0], ..Matrix::default() };
        let mut b = Vec::with_capacity(n);
        for i in 0..n {
            let zero_gradient = i >= fluid && self.limit_rows == LimitRows::ZeroGradient;
            let rho = self.density[i];
            let (mut diagonal, mut source) = (0.0, (rho - self.rho0) / (rho * self.dt * self.dt)); // LE22
            if self.at_surface[i] {
                (diagonal, source) = (1.0, 0.0); // LE23
            } else if zero_gradient {
                source = 0.0; // LE28
                let normal = self.normals[i - fluid];
                for pair in self.pairs.of(i) {
                    let along = pair.r[0] * normal[0] + pair.r[1] * normal[1];
                    self.link(&mut a, &mut diagonal, i, pair.j, pair.grad_factor * along / (rho * rho));
                }
            } else {
                for pair in self.pairs.of(i) {
                    self.link(&mut a, &mut diagonal, i, pair.j, -2.0 / (rho * rho) * pair.link);
                }
            }
            if diagonal == 0.0 {
                (diagonal, source) = (1.0, 0.0); // no neighbours
            }
            a.diagonal.push(diagonal);
            a.start.push(a.column.len() as u32);
            b.push(source);
        }
        (a, b)
    }

    /// Add `strength` m_j (P_i − P_j) to row `i`, where P_j is a row's pressure, or its opposite.
    fn link(&self, a: &mut Matrix, diagonal: &mut f64, i: usize, j: u32, strength: f64) {
        let other = &self.cast.players[j as usize];
        let weight = strength * other.mass;
        *diagonal += weight;
        if other.row as usize == i {
            *diagonal -= other.sign * weight;
        } else if !self.at_surface[other.row as usize] {
            a.column.push(other.row);
            a.value.push(-other.sign * weight);
        }
    }
}
