//! Recovery of energies, section forces, strains and reactions from a displacement.

use super::System;
use crate::element::{
    Chord, ElementConstants, Ends, PlasticElement, PlasticStrains, SectionForces, in_chord, strain_energy,
};
use crate::error::Error;
use crate::field::Field;
use crate::model::{Beam, Element, RigidLinks, Supports};

/// Limit of the rotation of an end against its chord \[rad\]: at 1 rad the shortening of an arc's chord is 5 % off.
const MOST_BENT: f64 = 1.0;

/// Outer fibres at an end of an element: right-hand and left-hand side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fibres {
    /// Strain along the element, plastic strain included \[-\].
    pub strain: [f64; 2],
    /// Stress along the element \[Pa\].
    pub stress: [f64; 2],
}

impl System {
    /// Elastic energy of beams, springs and connectors \[J\].
    pub fn strain_energy(&self, q: &[[f64; 3]], plastic: &[PlasticStrains]) -> f64 {
        let elements = self.beam.constants().enumerate();
        let beams: f64 = elements
            .map(|(index, (nodes, element))| {
                let ends = self.beam.ends(nodes, q);
                let elastic = strain_energy(element, &ends);
                let Some(layers) = &element.plastic else { return elastic };
                elastic + layers.energy(element, &Chord::new(element, &ends).deformation, &plastic[index])
            })
            .sum();
        let deformed = self.supports.connections.iter().map(|c| c.energy(c.deformation(&self.beam, q)));
        beams + self.supports.spring_energy(q) + deformed.sum::<f64>()
    }

    /// Section forces at the ends of the elements: elastic forces minus the element's own loads. The moments of an element that has yielded
    /// are those at its Gauss points: beyond them it does not say how far its layers flow.
    pub fn section_forces(
        &self,
        q: &[[f64; 3]],
        plastic: &[PlasticStrains],
        own_loads: Option<&[Ends]>,
    ) -> Vec<[SectionForces; 2]> {
        let sections = self.beam.constants().enumerate().map(|(index, (nodes, element))| {
            let chord = Chord::new(element, &self.beam.ends(nodes, q));
            let layers = element.plastic.as_ref();
            let yielded = layers.map(|layers| in_chord(element, &chord, layers.held(&plastic[index])));
            let elastic = chord.elastic_forces(element, yielded.as_ref());
            let own = own_loads.map_or(elastic, |loads| elastic - chord.to_local(&loads[index]));
            let mut ends = SectionForces::at_ends(&own);
            if let Some(layers) = layers.filter(|_| plastic[index].has_yielded()) {
                let moments = layers.moments(&chord.deformation, &plastic[index]);
                ends.iter_mut().zip(moments).for_each(|(end, moment)| end.moment = moment);
            }
            ends
        });
        sections.collect()
    }

    /// Strains and stresses of the outer fibres at the ends, right-hand and left-hand side \[-, Pa\].
    ///
    /// Those of an element that has yielded are those of layers there (BE25), else of the section forces: up to the first yield, for they
    /// contain the part of N in the moments (BE11), which the layers do not.
    pub fn fibres(&self, q: &[[f64; 3]], plastic: &[PlasticStrains]) -> Vec<Fibres> {
        let forces = self.section_forces(q, plastic, None);
        let mut fibres = Vec::with_capacity(2 * forces.len());
        for ((index, (nodes, element)), forces) in self.beam.constants().enumerate().zip(forces) {
            let Element { material, section, .. } = &self.beam.elements()[index];
            let [right, left] = section.fibres();
            let of = |end: SectionForces| {
                let curvature = end.moment / section.bending_stiffness(material);
                let mean = end.normal / section.axial_stiffness(material);
                let strain = [mean - right * curvature, mean - left * curvature];
                let limit = element.plastic.as_ref().map_or(f64::INFINITY, PlasticElement::first_yield);
                Fibres { strain, stress: [right, left].map(|eta| end.fibre_stress(section, eta).clamp(-limit, limit)) }
            };
            let mut ends = forces.map(of);
            if let Some(layers) = &element.plastic.as_ref().filter(|_| plastic[index].has_yielded()) {
                let chord = Chord::new(element, &self.beam.ends(nodes, q));
                let strains = layers.fibre_strains(element, &chord.deformation);
                let stresses = layers.fibre_stresses(&strains, &plastic[index]);
                ends = [0, 1].map(|end| Fibres { strain: strains[end], stress: stresses[end] });
            }
            fibres.extend(ends);
        }
        fibres
    }

    /// Plastic curvatures at the Gauss points of each element \[1/m\]; empty for an elastic model.
    pub fn plastic_curvatures(&self, plastic: &[PlasticStrains]) -> Vec<[f64; 2]> {
        let each = self.beam.constants().zip(plastic);
        let of = |((_, element), plastic): (([usize; 2], &ElementConstants), &PlasticStrains)| {
            element.plastic.as_ref().map_or([0.0; 2], |layers| layers.plastic_curvatures(plastic))
        };
        each.map(of).collect()
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
    let at_ends = |((nodes, element), &load): (([usize; 2], &ElementConstants), &Ends)| {
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
