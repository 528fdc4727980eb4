//! Recovery of energies, section forces, strains and reactions from a displacement.

use super::System;
use crate::element::{Chord, Ends, SectionForces, strain_energy};
use crate::error::Error;
use crate::field::Field;
use crate::model::{Beam, Element, RigidLinks, Supports};

/// Limit of the rotation of an end against its chord \[rad\]: at 1 rad the shortening of an arc's chord is 5 % off.
const MOST_BENT: f64 = 1.0;

impl System {
    /// Elastic energy of beams, springs and connectors \[J\].
    pub fn strain_energy(&self, q: &[[f64; 3]], plastic: &[[f64; 2]]) -> f64 {
        let elements = self.beam.constants().enumerate();
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
        let deformed = self.supports.connections.iter().map(|c| c.energy(c.deformation(&self.beam, q)));
        beams + self.supports.spring_energy(q) + deformed.sum::<f64>()
    }

    /// Section forces at the ends of the elements: elastic forces minus the element's own loads.
    pub fn section_forces(
        &self,
        q: &[[f64; 3]],
        plastic: &[[f64; 2]],
        own_loads: Option<&[Ends]>,
    ) -> Vec<[SectionForces; 2]> {
        let sections = self.beam.constants().enumerate().map(|(index, (nodes, element))| {
            let chord = Chord::new(element, &self.beam.ends(nodes, q));
            let [m_s, m_a] =
                element.plastic.as_ref().map_or([0.0; 2], |bending| bending.plastic_moments(plastic[index]));
            let elastic = chord.elastic_forces(element, &[0.0, m_s, m_a]);
            SectionForces::at_ends(&own_loads.map_or(elastic, |loads| elastic - chord.to_local(&loads[index])))
        });
        sections.collect()
    }

    /// Strains of the outer fibres at the ends, right-hand and left-hand side \[-\].
    pub fn fibre_strains(&self, q: &[[f64; 3]], plastic: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let forces = self.section_forces(q, plastic, None);
        let mut strains = Vec::with_capacity(2 * forces.len());
        for ((index, (nodes, element)), forces) in self.beam.constants().enumerate().zip(forces) {
            let Element { material, section, .. } = &self.beam.elements()[index];
            let [right, left] = section.fibres();
            let plastic = element
                .plastic
                .as_ref()
                .map(|bending| bending.end_curvatures(&Chord::new(element, &self.beam.ends(nodes, q)).deformation));
            for (end, SectionForces { normal, moment, .. }) in forces.into_iter().enumerate() {
                let curvature = plastic.map_or(moment / section.bending_stiffness(material), |ends| ends[end]);
                let mean = normal / section.axial_stiffness(material);
                strains.push([mean - right * curvature, mean - left * curvature]);
            }
        }
        strains
    }

    /// Ok if no element is bent beyond the range of its shape functions, else the error with the first that is.
    pub fn require_moderate_bending(&self, q: &[[f64; 3]]) -> Result<(), Error> {
        for (index, Chord { deformation: [_, arc, ess], .. }) in self.chords(q).into_iter().enumerate() {
            let rotation = arc.abs() + ess.abs();
            if rotation > MOST_BENT {
                return Err(Error::BentTooFar { element: index, rotation, limit: MOST_BENT });
            }
        }
        Ok(())
    }
}

/// Section forces at the two ends of every element at small displacements.
pub(crate) fn linear_section_forces(beam: &Beam, u: &[[f64; 3]], own_loads: &[Ends]) -> Vec<[SectionForces; 2]> {
    let elements = beam.constants().zip(own_loads);
    let at_ends = |((nodes, element), load): (([usize; 2], &crate::element::ElementConstants), &Ends)| {
        let elastic = element.elastic_forces(&beam.ends(nodes, u));
        SectionForces::at_ends(&element.to_local(&(elastic - load)))
    };
    elements.map(at_ends).collect()
}

/// Forces of the supports from the `residual`, internal forces minus load: the residual itself, transferred over the
/// links with these `arms`, where a degree of freedom is fixed, and minus the springs' forces.
pub(crate) fn reactions(
    supports: &Supports,
    (links, arms): (&RigidLinks, &[[f64; 2]]),
    q: &[[f64; 3]],
    mut residual: Field,
) -> Field {
    links.transfer_forces(arms, &mut residual);
    let mut reactions = vec![[0.0; 3]; residual.len()];
    supports.add_spring_forces(q, &mut reactions);
    for reaction in reactions.as_flattened_mut() {
        *reaction = -*reaction;
    }
    for &(node, dof) in &supports.fixed {
        let dof = dof as usize;
        reactions[node][dof] = residual[node][dof];
    }
    reactions
}
