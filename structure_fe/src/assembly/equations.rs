//! From nodes to equations: numbering of the free degrees of freedom, and scattering of matrix entries.

use crate::element::{ElementConstants, EndsMatrix};
use crate::error::Error;
use crate::field::{Dof, Field};
use crate::linear_algebra::ZeroPivot;
use crate::model::{Beam, RigidLinks, Supports};
use faer::sparse::Triplet;

/// Entries of the lower triangle of a symmetric matrix over the equations; entries of the same place add up.
pub(crate) type SymmetricMatrix = Vec<Triplet<usize, usize, f64>>;

/// The numbers of the free degrees of freedom, `[nodes][u, w, theta]`.
#[derive(Debug, Clone)]
pub(crate) struct Equations {
    number: Vec<[Option<usize>; 3]>,
    /// Node and degree of freedom of each equation.
    place: Vec<(usize, Dof)>,
    /// Rigid links.
    pub links: RigidLinks,
    /// Equations before those of the rigid bodies, if these were put last.
    inner: usize,
}

/// Lever arms of the rigid links: those that transfer forces to the bodies, and those that transfer displacements.
pub(crate) type Arms<'a> = [&'a [[f64; 2]]; 2];

/// The equations of a degree of freedom with their factors: two if it follows a rigid body.
type Terms = [(Option<usize>, f64); 2];

impl Equations {
    pub fn new(beam: &Beam, supports: &Supports) -> Self {
        Self::in_order(0..beam.nodes().len(), beam, supports)
    }

    /// Numbered by node in the given order, rigid bodies last. Hinged nodes share the numbers of their displacements;
    /// linked degrees of freedom have none.
    pub fn in_order(order: impl Iterator<Item = usize>, beam: &Beam, supports: &Supports) -> Self {
        let nodes = beam.nodes().len();
        let links = RigidLinks::new(beam, supports);
        // The first node of each group of hinged nodes has the numbers of all.
        let [translation, rotation] = [Dof::U, Dof::Theta].map(|dof| supports.leaders(dof, nodes));
        let leader = |node: usize, dof: Dof| if dof == Dof::Theta { rotation[node] } else { translation[node] };
        let mut free = vec![[true; 3]; nodes];
        for &(node, dof) in &supports.fixed {
            free[leader(node, dof)][dof as usize] = false;
        }
        for link in &links.all {
            for dof in 0..3 {
                free[link.node][dof] &= !links.follows(link.node, dof);
            }
        }
        let mut place = Vec::new();
        let mut number = vec![[None; 3]; nodes];
        let mut inner = 0;
        let (bodies, order): (Vec<_>, Vec<_>) = order.partition(|&node| beam.is_rigid_body(node));
        for (group, count_inner) in [(order, true), (bodies, false)] {
            for node in group {
                for dof in Dof::ALL {
                    let (owner, index) = (leader(node, dof), dof as usize);
                    if free[owner][index] && number[owner][index].is_none() {
                        number[owner][index] = Some(place.len());
                        place.push((owner, dof));
                    }
                    number[node][index] = number[owner][index];
                }
            }
            if count_inner {
                inner = place.len();
            }
        }
        Self { number, place, links, inner }
    }

    /// Number of equations before those of the rigid bodies.
    pub fn inner(&self) -> usize {
        self.inner
    }

    /// The equations of a degree of freedom, through its rigid link if it has one, with the lever `arms`.
    #[inline]
    fn terms(&self, (node, dof): (usize, usize), arms: &[[f64; 2]]) -> Terms {
        match self.links.of(node) {
            Some(link) if self.links.follows(node, dof) => {
                let [u, w, theta] = self.number[self.links.all[link].body];
                let [x, y] = arms[link];
                match dof {
                    0 => [(u, 1.0), (theta, -y)],
                    1 => [(w, 1.0), (theta, x)],
                    _ => [(theta, 1.0), (None, 0.0)],
                }
            }
            _ => [(self.number[node][dof], 1.0), (None, 0.0)],
        }
    }

    /// Calls `add(row, column, value)` for each entry between equations of a matrix entry between degrees of freedom:
    /// rows (forces) are transferred to the bodies with the arms `left`, columns (displacements) with `right`.
    pub fn scatter_entry(
        &self,
        [row, column]: [(usize, usize); 2],
        value: f64,
        [left, right]: Arms,
        mut add: impl FnMut(usize, usize, f64),
    ) {
        for (row, by_row) in self.terms(row, left) {
            for (column, by_column) in self.terms(column, right) {
                if let (Some(row), Some(column)) = (row, column) {
                    add(row, column, by_row * by_column * value);
                }
            }
        }
    }

    /// The same for all entries of an element's matrix.
    #[inline]
    pub fn scatter(&self, nodes: [usize; 2], local: &EndsMatrix, arms: Arms, mut add: impl FnMut(usize, usize, f64)) {
        if self.links.all.is_empty() || nodes.iter().all(|&node| self.links.of(node).is_none()) {
            let numbers = self.of_element(nodes);
            for i in 0..6 {
                let Some(row) = numbers[i] else { continue };
                for j in 0..6 {
                    if let Some(column) = numbers[j] {
                        add(row, column, local[(i, j)]);
                    }
                }
            }
            return;
        }
        for i in 0..6 {
            for j in 0..6 {
                let places = [(nodes[i / 3], i % 3), (nodes[j / 3], j % 3)];
                self.scatter_entry(places, local[(i, j)], arms, &mut add);
            }
        }
    }

    /// The free entries of a field of forces; those on linked nodes are transferred to their bodies with these `arms`.
    pub fn reduce(&self, field: &[[f64; 3]], arms: &[[f64; 2]]) -> Vec<f64> {
        if self.links.all.is_empty() {
            return self.restrict(field);
        }
        let mut transferred = field.to_vec();
        self.links.transfer_forces(arms, &mut transferred);
        self.restrict(&transferred)
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
    fn of_element(&self, [first, second]: [usize; 2]) -> [Option<usize>; 6] {
        let ([u1, w1, theta1], [u2, w2, theta2]) = (self.number[first], self.number[second]);
        [u1, w1, theta1, u2, w2, theta2]
    }

    /// The error of a matrix without inverse.
    pub fn singular(&self, pivot: ZeroPivot) -> Error {
        let (node, dof) = self.place(pivot.equation);
        Error::SingularTangent { node, dof }
    }

    /// Half-bandwidth of the equations of an element, without those of rigid bodies.
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

    /// Subtracts the free entries of a field of forces from `values`.
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
    pub fn extend(&self, value: impl Fn(usize) -> f64) -> Field {
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

    /// The stiffness matrix, springs and connectors included. The order of its entries depends on connectivity and supports only.
    pub fn stiffness(&self, beam: &Beam, supports: &Supports) -> SymmetricMatrix {
        let springs = supports.springs.iter().map(|spring| ((spring.node, spring.dof as usize), spring.stiffness));
        let mut entries = self.assemble(beam, ElementConstants::stiffness, springs);
        self.connector_stiffness(beam, &supports.connections, |row, column, value| {
            if row >= column {
                entries.push(Triplet::new(row, column, value));
            }
        });
        entries
    }

    /// The mass matrix, with the masses of points and rigid bodies.
    pub fn mass(&self, beam: &Beam) -> SymmetricMatrix {
        let points = beam.points().iter().enumerate();
        let points = points.flat_map(|(node, point)| (0..3).map(move |dof| ((node, dof), point[dof])));
        self.assemble(beam, ElementConstants::global_mass, points)
    }

    /// The sum of the elements' matrices and of a `diagonal` over degrees of freedom.
    fn assemble(
        &self,
        beam: &Beam,
        matrix: impl Fn(&ElementConstants) -> EndsMatrix,
        diagonal: impl Iterator<Item = ((usize, usize), f64)>,
    ) -> SymmetricMatrix {
        let mut entries = Vec::with_capacity(21 * beam.elements().len());
        let mut add = |row, column, value| {
            if row >= column {
                entries.push(Triplet::new(row, column, value));
            }
        };
        let arms = self.links.arms();
        for (nodes, element) in beam.constants() {
            self.scatter(nodes, &matrix(element), [&arms, &arms], &mut add);
        }
        for (place, value) in diagonal {
            self.scatter_entry([place, place], value, [&arms, &arms], &mut add);
        }
        entries
    }
}
