//! From nodes to equations: numbering without the fixed degrees of freedom, and matrix entries.

use crate::beam::Beam;
use crate::euler_bernoulli::{EndsMatrix, EulerBernoulli};
use crate::supports::Supports;

/// One term of a matrix over the free degrees of freedom; terms of the same place add up.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Entry {
    pub row: usize,
    pub column: usize,
    pub value: f64,
}

/// The numbers of the free degrees of freedom, `[nodes][u, w, theta]`.
#[derive(Debug, Clone)]
pub(crate) struct Equations {
    number: Vec<[Option<usize>; 3]>,
    count: usize,
}

impl Equations {
    pub fn new(nodes: usize, supports: &Supports) -> Self {
        let mut free = vec![[true; 3]; nodes];
        for &(node, dof) in supports.fixed() {
            free[node][dof as usize] = false;
        }
        let mut count = 0;
        let number = free
            .into_iter()
            .map(|free| {
                free.map(|free| {
                    free.then(|| {
                        count += 1;
                        count - 1
                    })
                })
            })
            .collect();
        Self { number, count }
    }

    /// Number of free degrees of freedom.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The free entries of a field, in the order of the equations.
    pub fn restrict(&self, field: &[[f64; 3]]) -> Vec<f64> {
        let numbers = self.number.iter().flatten();
        let values = field.iter().flatten();
        numbers.zip(values).filter(|(number, _)| number.is_some()).map(|(_, &value)| value).collect()
    }

    /// The field whose free entries are `value(equation)` and whose fixed entries are zero.
    pub fn extend(&self, value: impl Fn(usize) -> f64) -> Vec<[f64; 3]> {
        self.number.iter().map(|numbers| numbers.map(|number| number.map_or(0.0, &value))).collect()
    }

    /// Lower triangle of the stiffness matrix, springs included.
    ///
    /// The order of the entries depends on connectivity and supports only, not on the values.
    pub fn stiffness(&self, beam: &Beam, supports: &Supports) -> Vec<Entry> {
        let mut entries = self.lower_triangle(beam, EulerBernoulli::stiffness);
        entries.extend(supports.springs().iter().filter_map(|spring| {
            self.number[spring.node][spring.dof as usize].map(|number| Entry {
                row: number,
                column: number,
                value: spring.stiffness,
            })
        }));
        entries
    }

    /// Lower triangle of the mass matrix.
    pub fn mass(&self, beam: &Beam) -> Vec<Entry> {
        self.lower_triangle(beam, EulerBernoulli::mass)
    }

    fn lower_triangle(&self, beam: &Beam, matrix: impl Fn(&EulerBernoulli) -> EndsMatrix) -> Vec<Entry> {
        let mut entries = Vec::with_capacity(21 * beam.elements().len());
        for ([first, second], element) in beam.formulated() {
            let [u1, w1, theta1] = self.number[first];
            let [u2, w2, theta2] = self.number[second];
            let numbers = [u1, w1, theta1, u2, w2, theta2];
            let matrix = matrix(element);
            for i in 0..6 {
                for j in 0..6 {
                    if let (Some(row), Some(column)) = (numbers[i], numbers[j])
                        && row >= column
                    {
                        let value = matrix[i][j];
                        entries.push(Entry { row, column, value });
                    }
                }
            }
        }
        entries
    }
}
