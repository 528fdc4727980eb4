//! From nodes to equations: numbering without the fixed degrees of freedom, and matrix entries.

use crate::beam::Beam;
use crate::element::{ElementConstants, EndsMatrix};
use crate::supports::{Dof, Supports};
use crate::ties::Ties;

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
    /// Which nodes follow rigid bodies.
    pub ties: Ties,
    /// Equations before those of the rigid bodies, if these were put last.
    inner: usize,
}

/// Arms of the ties, in their order: what takes forces to the bodies, and what takes displacements from them.
pub(crate) type Arms<'a> = [&'a [[f64; 2]]; 2];

/// The equations of a degree of freedom with their factors: two where it follows a rigid body.
pub(crate) type Terms = [(Option<usize>, f64); 2];

impl Equations {
    pub fn new(beam: &Beam, supports: &Supports) -> Self {
        let order: Vec<usize> = (0..beam.nodes().len()).collect();
        Self::in_order(&order, beam, supports)
    }

    /// Numbered node by node as they come in `order`, rigid bodies last. Hinged nodes share their displacements'
    /// numbers, tied ones have none.
    pub fn in_order(order: &[usize], beam: &Beam, supports: &Supports) -> Self {
        let ties = Ties::new(beam, supports);
        // The first node of each group of hinged ones carries the displacements of all.
        let (leader, turning) = (supports.leaders(order.len()), supports.turning_leaders(order.len()));
        let mut free = vec![[true; 3]; order.len()];
        for &(node, dof) in supports.fixed() {
            let node = if dof == Dof::Theta { turning[node] } else { leader[node] };
            free[node][dof as usize] = false;
        }
        for tie in &ties.all {
            for dof in 0..3 {
                free[tie.node][dof] &= !ties.follows(tie.node, dof);
            }
        }
        let mut place = Vec::new();
        let mut number = vec![[None; 3]; order.len()];
        let mut inner = 0;
        let bodies = order.iter().filter(|&&node| beam.is_rigid_body(node));
        for &node in order.iter().filter(|&&node| !beam.is_rigid_body(node)).chain(bodies) {
            for dof in [Dof::U, Dof::W, Dof::Theta] {
                let owner = if dof == Dof::Theta { turning[node] } else { leader[node] };
                let index = dof as usize;
                if free[owner][index] && number[owner][index].is_none() {
                    number[owner][index] = Some(place.len());
                    place.push((owner, dof));
                }
                number[node][index] = number[owner][index];
            }
            if !beam.is_rigid_body(node) {
                inner = place.len();
            }
        }
        Self { number, place, ties, inner }
    }

    /// Number of equations before those of the rigid bodies.
    pub fn inner(&self) -> usize {
        self.inner
    }

    /// The equations of a degree of freedom, through its tie if it has one, with the ties' `arms`.
    #[inline]
    pub fn terms(&self, node: usize, dof: usize, arms: &[[f64; 2]]) -> Terms {
        match self.ties.of(node) {
            Some(tie) if self.ties.follows(node, dof) => {
                let [u, w, theta] = self.number[self.ties.all[tie].body];
                let [x, y] = arms[tie];
                match dof {
                    0 => [(u, 1.0), (theta, -y)],
                    1 => [(w, 1.0), (theta, x)],
                    _ => [(theta, 1.0), (None, 0.0)],
                }
            }
            _ => [(self.number[node][dof], 1.0), (None, 0.0)],
        }
    }

    /// Calls `add(row, column, value)` for what `value` between two degrees of freedom is between equations:
    /// forces are taken to the bodies with the arms `left`, displacements from them with the arms `right`.
    pub fn spread(
        &self,
        (row, column): ((usize, usize), (usize, usize)),
        value: f64,
        [left, right]: Arms,
        mut add: impl FnMut(usize, usize, f64),
    ) {
        for (row, by_row) in self.terms(row.0, row.1, left) {
            for (column, by_column) in self.terms(column.0, column.1, right) {
                if let (Some(row), Some(column)) = (row, column) {
                    add(row, column, by_row * by_column * value);
                }
            }
        }
    }

    /// Whether an end of an element follows a body.
    #[inline]
    pub fn tied(&self, [first, second]: [usize; 2]) -> bool {
        !self.ties.all.is_empty() && (self.ties.of(first).is_some() || self.ties.of(second).is_some())
    }

    /// The free entries of a field of forces, those on tied nodes taken to their bodies with these `arms`.
    pub fn reduce(&self, field: &[[f64; 3]], arms: &[[f64; 2]]) -> Vec<f64> {
        if self.ties.all.is_empty() {
            return self.restrict(field);
        }
        let mut folded = field.to_vec();
        self.ties.fold(arms, &mut folded);
        self.restrict(&folded)
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

    /// How far apart the equations of an element are, without those of rigid bodies.
    pub fn band(&self, nodes: [usize; 2]) -> usize {
        let numbers = self.of_element(nodes).into_iter().flatten().filter(|&number| number < self.inner);
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
        for spring in supports.springs() {
            self.on_diagonal((spring.node, spring.dof as usize), spring.stiffness, &mut entries);
        }
        entries
    }

    /// Lower triangle of the mass matrix.
    pub fn mass(&self, beam: &Beam) -> Vec<Entry> {
        let mut entries = self.lower_triangle(beam, ElementConstants::mass);
        for (node, point) in beam.points().iter().enumerate() {
            for (dof, &value) in point.iter().enumerate() {
                self.on_diagonal((node, dof), value, &mut entries);
            }
        }
        entries
    }

    fn on_diagonal(&self, place: (usize, usize), value: f64, entries: &mut Vec<Entry>) {
        let arms = self.ties.arms();
        self.spread((place, place), value, [&arms, &arms], |row, column, value| {
            if row >= column {
                entries.push(Entry { row, column, value });
            }
        });
    }

    fn lower_triangle(&self, beam: &Beam, matrix: impl Fn(&ElementConstants) -> EndsMatrix) -> Vec<Entry> {
        let mut entries = Vec::with_capacity(21 * beam.elements().len());
        let arms = self.ties.arms();
        for (nodes, element) in beam.formulated() {
            let matrix = matrix(element);
            for i in 0..6 {
                for j in 0..6 {
                    let places = ((nodes[i / 3], i % 3), (nodes[j / 3], j % 3));
                    self.spread(places, matrix[i][j], [&arms, &arms], |row, column, value| {
                        if row >= column {
                            entries.push(Entry { row, column, value });
                        }
                    });
                }
            }
        }
        entries
    }
}
