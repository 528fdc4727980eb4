//! The equations of the moving model: internal forces and their tangent, assembled.

use crate::banded::ZeroPivot;
use crate::beam::{Beam, Element, add_ends};
use crate::bordered::Bordered;
use crate::corotational::{Chord, strain_energy};
use crate::element::{Ends, EndsMatrix};
use crate::equations::{Arms, Equations};
use crate::error::Error;
use crate::inertia::{Damping, Motion, Weights, response, restoring};
use crate::ordering::narrow_band;
use crate::restoring::relieved;
use crate::section_forces::{SectionForces, at_ends};
use crate::supports::{Dof, Supports};

/// Ends may turn by this much against their chord \[rad\]: at 1 rad the shortening of an arc's chord is 5 % off.
const MOST_BENT: f64 = 1.0;

/// A supported model at large displacements. The numbering and the band are laid out once.
#[derive(Debug, Clone)]
pub(crate) struct System {
    pub beam: Beam,
    pub supports: Supports,
    pub equations: Equations,
    half_band: usize,
}

/// Displacement, velocity and acceleration of the model, `[nodes][u, w, theta]`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kinematics<'a> {
    pub q: &'a [[f64; 3]],
    pub v: &'a [[f64; 3]],
    pub a: &'a [[f64; 3]],
}

impl System {
    pub fn new(beam: Beam, supports: Supports) -> Result<Self, Error> {
        supports.check(&beam)?;
        let links = beam.elements().iter().map(|element| element.nodes).chain(supports.joints());
        let order = narrow_band(beam.nodes().len(), links);
        let equations = Equations::in_order(&order, &beam, &supports);
        let half_band = beam.elements().iter().map(|element| equations.band(element.nodes)).max().unwrap_or(0);
        Ok(Self { beam, supports, equations, half_band })
    }

    pub fn matrix(&self) -> Bordered {
        let inner = self.equations.inner();
        Bordered::new(inner, self.half_band, self.equations.count() - inner)
    }

    /// Inertia, damping and elastic forces at the nodes (the left-hand side of the equations of motion).
    pub fn forces(&self, at: Kinematics, damping: &Damping, forces: &mut [[f64; 3]]) {
        self.sweep(at, damping, forces, None);
    }

    /// The same forces, and their tangent into `matrix`.
    pub fn forces_and_tangent(
        &self,
        at: Kinematics,
        damping: &Damping,
        weights: Weights,
        forces: &mut [[f64; 3]],
        matrix: &mut Bordered,
    ) {
        matrix.clear();
        self.sweep(at, damping, forces, Some((weights, matrix)));
    }

    fn sweep(
        &self,
        at: Kinematics,
        damping: &Damping,
        forces: &mut [[f64; 3]],
        mut tangent: Option<(Weights, &mut Bordered)>,
    ) {
        let weights = tangent.as_ref().map(|(weights, _)| *weights);
        forces.fill([0.0; 3]);
        let arms = if weights.is_some() { self.equations.ties.arms_at(at.q) } else { Vec::new() };
        for (nodes, element) in self.beam.formulated() {
            let ends = |field| self.beam.ends(nodes, field);
            let motion = Motion { q: ends(at.q), v: ends(at.v), a: ends(at.a) };
            let (force, local) = response(element, &motion, damping, weights);
            add_ends(forces, nodes, &force);
            if let (Some((_, matrix)), Some(local)) = (&mut tangent, local) {
                self.add_matrix(nodes, &local, [&arms, &arms], matrix);
            }
        }
        for (node, mass) in self.beam.points().iter().enumerate().filter(|(_, mass)| mass[0] > 0.0) {
            for dof in 0..3 {
                forces[node][dof] += mass[dof] * (at.a[node][dof] + damping.mass * at.v[node][dof]);
                if let (Some((weights, matrix)), Some(row)) = (&mut tangent, self.equations.number(node, dof)) {
                    matrix.add(row, row, mass[dof] * (weights.acceleration + damping.mass * weights.velocity));
                }
            }
        }
        self.add_springs(at, damping, forces);
        if let Some((weights, matrix)) = tangent {
            let factor = weights.displacement + damping.stiffness * weights.velocity;
            self.add_stiffness_of_springs(factor, [&arms, &arms], matrix);
        }
    }

    /// Adds an element's matrix: forces taken to the bodies with the arms `left`, displacements with `right`.
    #[inline]
    pub fn add_matrix(&self, nodes: [usize; 2], local: &EndsMatrix, arms: Arms, matrix: &mut Bordered) {
        if self.equations.tied(nodes) {
            for i in 0..6 {
                for j in 0..6 {
                    let places = ((nodes[i / 3], i % 3), (nodes[j / 3], j % 3));
                    self.equations.spread(places, local[i][j], arms, |row, column, value| {
                        matrix.add(row, column, value);
                    });
                }
            }
            return;
        }
        let numbers = self.equations.of_element(nodes);
        for (row, values) in numbers.iter().zip(local) {
            let Some(row) = *row else { continue };
            for (column, value) in numbers.iter().zip(values) {
                if let Some(column) = *column {
                    matrix.add(row, column, *value);
                }
            }
        }
    }

    /// Adds `factor` times the springs' stiffness.
    pub fn add_stiffness_of_springs(&self, factor: f64, arms: Arms, matrix: &mut Bordered) {
        for spring in self.supports.springs() {
            let place = (spring.node, spring.dof as usize);
            self.equations.spread((place, place), factor * spring.stiffness, arms, |row, column, value| {
                matrix.add(row, column, value);
            });
        }
    }

    /// Adds what the turning of the arms takes from the moments of `forces` on tied nodes, -factor a . F on
    /// the body's rotation (THEORY S21).
    pub fn subtract_turning(&self, forces: &[[f64; 3]], arms: &[[f64; 2]], factor: f64, matrix: &mut Bordered) {
        for (tie, arm) in self.equations.ties.all.iter().zip(arms) {
            if let Some(row) = self.equations.number(tie.body, 2) {
                let force = forces[tie.node];
                matrix.add(row, row, factor * (arm[0] * force[0] + arm[1] * force[1]));
            }
        }
    }

    /// Adds `factor * values` to the free entries of a displacement; tied nodes follow.
    pub fn displace(&self, factor: f64, values: &[f64], q: &mut [[f64; 3]]) {
        self.equations.add(factor, values, q);
        self.equations.ties.follow(q);
    }

    pub fn add_springs(&self, at: Kinematics, damping: &Damping, forces: &mut [[f64; 3]]) {
        for spring in self.supports.springs() {
            let (node, dof) = (spring.node, spring.dof as usize);
            forces[node][dof] += spring.stiffness * (at.q[node][dof] + damping.stiffness * at.v[node][dof]);
        }
    }

    /// Elastic and damping forces alone, with the damping on the diagonal of a lumped `mass`.
    pub fn restoring_forces(&self, at: Kinematics, damping: &Damping, mass: &[[f64; 3]], forces: &mut [[f64; 3]]) {
        for ((force, mass), v) in forces.iter_mut().zip(mass).zip(at.v) {
            *force = [0, 1, 2].map(|dof| damping.mass * mass[dof] * v[dof]);
        }
        for (nodes, element) in self.beam.formulated() {
            let force = restoring(element, &self.beam.ends(nodes, at.q), &self.beam.ends(nodes, at.v), damping);
            add_ends(forces, nodes, &force);
        }
        self.add_springs(at, damping, forces);
    }

    /// Elastic energy of beams and springs \[J\].
    pub fn strain_energy(&self, q: &[[f64; 3]], plastic: &[[f64; 2]]) -> f64 {
        let elements = self.beam.formulated().enumerate();
        let beams: f64 = elements
            .map(|(index, (nodes, element))| {
                let ends = self.beam.ends(nodes, q);
                let elastic = strain_energy(element, &ends);
                let Some(bending) = &element.plastic else { return elastic };
                let deformation = Chord::new(element, &ends).deformation;
                let [without, with] =
                    [[0.0; 2], plastic[index]].map(|curvature| bending.moments(&deformation, curvature));
                elastic + bending.energy(with) - bending.energy(without)
            })
            .sum();
        beams + self.supports.spring_energy(q)
    }

    /// Section forces at the ends of the elements: elastic forces less the element's own loads.
    pub fn section_forces(
        &self,
        q: &[[f64; 3]],
        plastic: &[[f64; 2]],
        own_loads: Option<&[Ends]>,
    ) -> Vec<[SectionForces; 2]> {
        let sections = self.beam.formulated().enumerate().map(|(index, (nodes, element))| {
            let chord = Chord::new(element, &self.beam.ends(nodes, q));
            let relief = element.plastic.as_ref().map_or([0.0; 2], |bending| bending.relief(plastic[index]));
            let elastic = relieved(element, &chord, &[0.0, relief[0], relief[1]]);
            let load = own_loads.map_or([0.0; 6], |loads| chord.to_local(&loads[index]));
            at_ends(&std::array::from_fn(|i| elastic[i] - load[i]))
        });
        sections.collect()
    }

    /// Strains of the outer fibres at the ends, right-hand and left-hand side \[-\].
    pub fn fibre_strains(&self, q: &[[f64; 3]], plastic: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let forces = self.section_forces(q, plastic, None);
        let mut strains = Vec::with_capacity(2 * forces.len());
        for ((index, (nodes, element)), forces) in self.beam.formulated().enumerate().zip(forces) {
            let Element { material, section, .. } = &self.beam.elements()[index];
            let half = 0.5 * section.thickness();
            let yielded = element
                .plastic
                .as_ref()
                .map(|bending| bending.end_curvatures(&Chord::new(element, &self.beam.ends(nodes, q)).deformation));
            for (end, SectionForces { normal, moment, .. }) in forces.into_iter().enumerate() {
                let curvature = yielded.map_or(moment / section.bending_stiffness(material), |ends| ends[end]);
                let mean = normal / section.axial_stiffness(material);
                strains.push([mean + half * curvature, mean - half * curvature]);
            }
        }
        strains
    }

    /// The error that names the first element bent beyond what its shapes describe, if there is one.
    pub fn require_bent_little(&self, q: &[[f64; 3]]) -> Result<(), Error> {
        for (index, (nodes, element)) in self.beam.formulated().enumerate() {
            let [_, arc, ess] = Chord::new(element, &self.beam.ends(nodes, q)).deformation;
            let rotation = arc.abs() + ess.abs();
            if rotation > MOST_BENT {
                return Err(Error::BentTooFar { element: index, rotation, limit: MOST_BENT });
            }
        }
        Ok(())
    }

    /// Forces of the supports: what the internal forces lack of the load where a degree of freedom is
    /// fixed, and minus the springs' forces.
    pub fn reactions(&self, q: &[[f64; 3]], internal: &[[f64; 3]], load: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut lack: Vec<[f64; 3]> =
            internal.iter().zip(load).map(|(f, load)| [0, 1, 2].map(|dof| f[dof] - load[dof])).collect();
        self.equations.ties.fold(&self.equations.ties.arms_at(q), &mut lack);
        let mut reactions = vec![[0.0; 3]; load.len()];
        self.supports.add_spring_forces(q, &mut reactions);
        for reaction in reactions.as_flattened_mut() {
            *reaction = -*reaction;
        }
        for &(node, dof) in self.supports.fixed() {
            let dof = dof as usize;
            reactions[node][dof] = lack[node][dof];
        }
        reactions
    }

    /// Size of a change of the displacements \[-\]: its largest entry, lengths over the model's extent.
    pub fn size(&self, change: &[f64]) -> f64 {
        let extent = self.beam.extent();
        let entries = change.iter().enumerate();
        entries.fold(0.0, |largest: f64, (equation, change)| {
            let (_, dof) = self.equations.place(equation);
            let scaled = if dof == Dof::Theta { change.abs() } else { change.abs() / extent };
            // A value that is not a number must not hide behind `max`.
            if scaled.is_nan() { f64::NAN } else { largest.max(scaled) }
        })
    }

    /// Size of the difference of two displacements \[-\], as above.
    pub fn size_of_difference(&self, a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
        let scale = self.beam.extent().recip();
        a.iter().zip(b).fold(0.0, |largest: f64, (a, b)| {
            let moved = (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
            largest.max(moved * scale).max((a[2] - b[2]).abs())
        })
    }

    /// The largest entry of a residual, lengths making moments comparable, and where it is.
    pub fn worst(&self, residual: &[f64]) -> (f64, usize, Dof) {
        let extent = self.beam.extent();
        let mut worst = (0.0, 0, Dof::U);
        for (equation, value) in residual.iter().enumerate() {
            let (node, dof) = self.equations.place(equation);
            let size = if dof == Dof::Theta { value.abs() / extent } else { value.abs() };
            if size.is_nan() || size >= worst.0 {
                worst = (size, node, dof);
                if size.is_nan() {
                    break;
                }
            }
        }
        worst
    }

    /// The error of a tangent that has no inverse.
    pub fn singular(&self, pivot: ZeroPivot) -> Error {
        let (node, dof) = self.equations.place(pivot.equation);
        Error::SingularTangent { node, dof }
    }
}
