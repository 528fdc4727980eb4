//! From nodes to equations: numbering without the fixed degrees of freedom, and matrix entries.

use crate::beam::Beam;
use crate::element::{ElementConstants, EndsMatrix};
use crate::supports::{Dof, Supports};

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
    /// Node and degree of freedom of each equation.
    place: Vec<(usize, Dof)>,
}

impl Equations {
    pub fn new(nodes: usize, supports: &Supports) -> Self {
        let order: Vec<usize> = (0..nodes).collect();
        Self::in_order(&order, supports)
    }

    /// Numbered node by node as they come in `order`. Hinged nodes share their displacements' numbers.
    pub fn in_order(order: &[usize], supports: &Supports) -> Self {
        // The first node of each group of hinged ones carries the displacements of all.
        let leader = supports.leaders(order.len());
        let mut free = vec![[true; 3]; order.len()];
        for &(node, dof) in supports.fixed() {
            let node = if dof == Dof::Theta { node } else { leader[node] };
            free[node][dof as usize] = false;
        }
        let mut place = Vec::new();
        let mut number = vec![[None; 3]; order.len()];
        for &node in order {
            for dof in [Dof::U, Dof::W, Dof::Theta] {
                let owner = if dof == Dof::Theta { node } else { leader[node] };
                let index = dof as usize;
                if free[owner][index] && number[owner][index].is_none() {
                    number[owner][index] = Some(place.len());
                    place.push((owner, dof));
                }
                number[node][index] = number[owner][index];
            }
        }
        Self { number, place }
    }

    /// Number of free degrees of freedom.
    pub fn count(&self) -> usize {
        self.place.len()
    }

    /// The equation of a degree of freedom, if it is free.
    #[inline]
    pub fn number(&self, node: usize, dof: usize) -> Option<usize> {
        self.number[node][dof]
    }

    /// Node and degree of freedom of an equation.
    pub fn place(&self, equation: usize) -> (usize, Dof) {
        self.place[equation]
    }

    /// The equations of an element's ends.
    #[inline]
    pub fn of_element(&self, [first, second]: [usize; 2]) -> [Option<usize>; 6] {
        let ([u1, w1, theta1], [u2, w2, theta2]) = (self.number[first], self.number[second]);
        [u1, w1, theta1, u2, w2, theta2]
    }

    /// How far apart the equations of an element are.
    pub fn band(&self, nodes: [usize; 2]) -> usize {
        let numbers = self.of_element(nodes).into_iter().flatten();
        numbers.clone().max().zip(numbers.min()).map_or(0, |(last, first)| last - first)
    }

    /// The free entries of a field of forces, in the order of the equations; those that share one add up.
    pub fn restrict(&self, field: &[[f64; 3]]) -> Vec<f64> {
        let mut values = vec![0.0; self.count()];
        for (number, value) in self.number.as_flattened().iter().zip(field.as_flattened()) {
            if let Some(number) = *number {
                values[number] += value;
            }
        }
        values
    }

    /// Takes the free entries of a field of forces from `values`.
    pub fn subtract(&self, field: &[[f64; 3]], values: &mut [f64]) {
        for (number, value) in self.number.as_flattened().iter().zip(field.as_flattened()) {
            if let Some(number) = *number {
                values[number] -= value;
            }
        }
    }

    /// The free entries of a field of displacements, in the order of the equations.
    pub fn pick(&self, field: &[f64]) -> Vec<f64> {
        self.place.iter().map(|&(node, dof)| field[3 * node + dof as usize]).collect()
    }

    /// The field whose free entries are `value(equation)` and whose fixed entries are zero.
    pub fn extend(&self, value: impl Fn(usize) -> f64) -> Vec<[f64; 3]> {
        self.number.iter().map(|numbers| numbers.map(|number| number.map_or(0.0, &value))).collect()
    }

    /// Adds `factor * values` to the free entries of a field.
    pub fn add(&self, factor: f64, values: &[f64], field: &mut [[f64; 3]]) {
        for (number, value) in self.number.as_flattened().iter().zip(field.as_flattened_mut()) {
            if let Some(number) = *number {
                *value += factor * values[number];
            }
        }
    }

    /// Lower triangle of the stiffness matrix, springs included.
    ///
    /// The order of the entries depends on connectivity and supports only, not on the values.
    pub fn stiffness(&self, beam: &Beam, supports: &Supports) -> Vec<Entry> {
        let mut entries = self.lower_triangle(beam, ElementConstants::stiffness);
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
        let mut entries = self.lower_triangle(beam, ElementConstants::mass);
        let points = self.number.as_flattened().iter().zip(beam.points().as_flattened());
        entries.extend(
            points.filter_map(|(number, &value)| number.map(|number| Entry { row: number, column: number, value })),
        );
        entries
    }

    fn lower_triangle(&self, beam: &Beam, matrix: impl Fn(&ElementConstants) -> EndsMatrix) -> Vec<Entry> {
        let mut entries = Vec::with_capacity(21 * beam.elements().len());
        for (nodes, element) in beam.formulated() {
            let numbers = self.of_element(nodes);
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
