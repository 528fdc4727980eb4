//! An element that yields by force and moment together: layers through the thickness at its two Gauss points (THEORY BE25).
//!
//! A layer at eta has the strain epsilon - eta kappa, with the mean strain of the axis (BE11) and the curvature of the Gauss point. Plastic
//! strains change the elastic forces of BE11 by what they take off the stress of the layers; an element that has not yielded keeps the
//! elastic forces to the bit. The outer fibres at both ends are layers without area: they give stress and strain there.

use super::corotational::mean_strain;
use super::plastic::{PlasticElement, PlasticStrains};
use super::{Chord, ElementConstants};
use crate::material::LAYERS;

const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// What the layers add to the elastic forces (N, M_s, M_a), without the part of N in the moments; and to their derivatives by (strain,
/// psi_s, psi_a): N by each, M_s by psi_s, M_s by psi_a, M_a by psi_a.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Yielded {
    pub forces: [f64; 3],
    pub softening: [f64; 6],
}

/// A step of an element that yields.
#[derive(Debug, Clone, Copy)]
pub(crate) struct YieldStep {
    /// At the end, and the forces at the start.
    pub after: Yielded,
    pub before: [f64; 3],
    /// Work beyond the change of the elastic energy that the layers add \[J\].
    pub dissipated: f64,
}

/// Sums over the layers of a Gauss point: of (N, M), and of the derivatives N by strain, N by curvature, M by curvature.
type Sums = ([f64; 2], [f64; 3]);

impl PlasticElement {
    /// Curvatures at the Gauss points, kappa = (-2 psi_s -+ 2 sqrt(3) psi_a)/L, or at both ends, with `across` = 6 \[1/m\].
    fn curvatures(&self, &[_, arc, ess]: &[f64; 3], across: f64) -> [f64; 2] {
        [-1.0, 1.0].map(|sign| (-2.0 * arc + sign * across * ess) / self.length)
    }

    /// Strain of the layers on the axis, and curvatures at the Gauss points.
    fn strains(&self, element: &ElementConstants, deformation: &[f64; 3]) -> (f64, [f64; 2]) {
        (self.axial * mean_strain(element, deformation), self.curvatures(deformation, 2.0 * SQRT_3))
    }

    /// The forces of both Gauss points from those of their layers.
    fn forces(&self, [[n_1, m_1], [n_2, m_2]]: [[f64; 2]; 2]) -> [f64; 3] {
        [0.5 * self.axial * (n_1 + n_2), -(m_1 + m_2), SQRT_3 * (m_2 - m_1)]
    }

    fn yielded(&self, [(first, [a_1, s_1, i_1]), (second, [a_2, s_2, i_2])]: [Sums; 2]) -> Yielded {
        let per_length = 1.0 / self.length;
        let (axial, both) = (self.axial, 2.0 * per_length * (i_1 + i_2));
        Yielded {
            forces: self.forces([first, second]),
            softening: [
                0.5 * axial * axial * (a_1 + a_2),
                -axial * per_length * (s_1 + s_2),
                axial * SQRT_3 * per_length * (s_2 - s_1),
                both,
                2.0 * SQRT_3 * per_length * (i_1 - i_2),
                3.0 * both,
            ],
        }
    }

    /// Forces of plastic strains that do not change.
    pub fn held(&self, plastic: &PlasticStrains) -> [f64; 3] {
        self.forces(plastic.layers.map(|layers| self.relief(&layers)))
    }

    /// What plastic strains take off normal force \[N\] and moment \[N m\] of a Gauss point.
    fn relief(&self, plastic: &[[f64; 2]; LAYERS]) -> [f64; 2] {
        self.layers.iter().zip(plastic).fold([0.0; 2], |[n, m], ((eta, area), plastic)| {
            let force = area * self.law.relief(*plastic);
            [n + force, m - eta * force]
        })
    }

    /// The return map from `before` at a deformation.
    pub fn response(&self, element: &ElementConstants, deformation: &[f64; 3], before: &PlasticStrains) -> Yielded {
        let (strain, curvatures) = self.strains(element, deformation);
        self.yielded([0, 1].map(|g| {
            let mut sums = ([0.0; 2], [0.0; 3]);
            for ((eta, area), before) in self.layers.iter().zip(&before.layers[g]) {
                self.add(&mut sums, [eta, area], strain - eta * curvatures[g], *before);
            }
            sums
        }))
    }

    /// Adds a layer's part; returns its plastic strains.
    fn add(&self, ([n, m], [a, s, i]): &mut Sums, [eta, area]: [f64; 2], strain: f64, before: [f64; 2]) -> [f64; 2] {
        let returned = self.law.respond(strain, before);
        let (force, softening) = (area * self.law.relief(returned.plastic), area * returned.softening);
        *n += force;
        *m -= eta * force;
        *a += softening;
        *s -= eta * softening;
        *i += eta * eta * softening;
        returned.plastic
    }

    /// A step between two deformations from the plastic strains `before`, with the `weight` of its end.
    pub fn step(
        &self,
        element: &ElementConstants,
        [from, to]: [&[f64; 3]; 2],
        before: &PlasticStrains,
        weight: f64,
    ) -> YieldStep {
        let [(start, start_curvatures), (end, end_curvatures)] = [from, to].map(|d| self.strains(element, d));
        let mut dissipated = 0.0;
        let sums = [0, 1].map(|g| {
            let mut sums = ([0.0; 2], [0.0; 3]);
            for ((eta, area), &held) in self.layers.iter().zip(&before.layers[g]) {
                let [first, last] = [start - eta * start_curvatures[g], end - eta * end_curvatures[g]];
                let plastic = self.add(&mut sums, [eta, area], last, held);
                if plastic == held {
                    continue;
                }
                let [x, z] = [0, 1].map(|k| plastic[k] - held[k]);
                let ([x_0, z_0], [x_1, z_1]) = (self.law.stress(first, held), self.law.stress(last, plastic));
                let plastic_work = 0.5 * ((x_0 + x_1) * x + (z_0 + z_1) * z);
                let change = self.law.relief([x, z]);
                dissipated += area * (plastic_work + (weight - 0.5) * change * (last - first));
            }
            sums
        });
        YieldStep { after: self.yielded(sums), before: self.held(before), dissipated: 0.5 * self.length * dissipated }
    }

    /// Updates the plastic strains by the return map at a deformation.
    pub fn update(&self, element: &ElementConstants, deformation: &[f64; 3], plastic: &mut PlasticStrains) {
        let (strain, curvatures) = self.strains(element, deformation);
        for (curvature, layers) in curvatures.into_iter().zip(&mut plastic.layers) {
            for ((eta, _), layer) in self.layers.iter().zip(layers) {
                *layer = self.law.respond(strain - eta * curvature, *layer).plastic;
            }
        }
        for (strains, fibres) in self.fibre_strains(element, deformation).into_iter().zip(&mut plastic.fibres) {
            for (strain, fibre) in strains.into_iter().zip(fibres) {
                *fibre = self.law.respond(strain, *fibre).plastic;
            }
        }
    }

    /// What plastic strains add to the elastic energy of BE11 \[J\].
    pub fn energy(&self, element: &ElementConstants, deformation: &[f64; 3], plastic: &PlasticStrains) -> f64 {
        let (strain, curvatures) = self.strains(element, deformation);
        let of = |g: usize| {
            let layers = self.layers.iter().zip(&plastic.layers[g]);
            let each = layers.map(|((eta, area), &[along, across])| {
                let strain = strain - eta * curvatures[g];
                let [x, z] = self.law.stress(strain, [along, across]);
                area * (x * (strain - along) - z * across - self.law.modulus * strain * strain)
            });
            each.sum::<f64>()
        };
        if plastic.has_yielded() { 0.25 * self.length * (of(0) + of(1)) } else { 0.0 }
    }

    /// Strains of the right and the left outer fibre at both ends \[-\].
    pub fn fibre_strains(&self, element: &ElementConstants, deformation: &[f64; 3]) -> [[f64; 2]; 2] {
        let strain = self.axial * mean_strain(element, deformation);
        self.curvatures(deformation, 6.0).map(|curvature| self.fibres.map(|eta| strain - eta * curvature))
    }

    /// Their stresses \[Pa\].
    pub fn fibre_stresses(&self, strains: &[[f64; 2]; 2], plastic: &PlasticStrains) -> [[f64; 2]; 2] {
        [0, 1].map(|end| [0, 1].map(|side| self.law.stress(strains[end][side], plastic.fibres[end][side])[0]))
    }

    /// Moments at the Gauss points \[N m\].
    pub fn moments(&self, deformation: &[f64; 3], plastic: &PlasticStrains) -> [f64; 2] {
        let curvatures = self.curvatures(deformation, 2.0 * SQRT_3);
        [0, 1].map(|g| self.bending_stiffness * curvatures[g] + self.relief(&plastic.layers[g])[1])
    }

    /// Stress along the element at which a fibre yields first \[Pa\].
    pub fn first_yield(&self) -> f64 {
        self.law.first_yield()
    }

    /// Curvatures that the plastic strains leave without a moment, at the Gauss points \[1/m\].
    pub fn plastic_curvatures(&self, plastic: &PlasticStrains) -> [f64; 2] {
        plastic.layers.map(|layers| -self.relief(&layers)[1] / self.bending_stiffness)
    }

    /// The parts of the plastic strains `before` in the forces conjugate to the deformations of a chord and, after the return map, in their
    /// derivatives: 11, 12, 13, 22, 23, 33.
    pub fn corrections(&self, element: &ElementConstants, chord: &Chord, before: &PlasticStrains) -> Corrections {
        let Yielded { forces: [normal, m_s, m_a], softening: [by_strain, by_arc, by_ess, ss, sa, aa] } =
            self.response(element, &chord.deformation, before);
        let [_, arc, ess] = chord.deformation;
        let [g_arc, g_ess] = element.curvature_strain;
        let length = self.length;
        let (n_arc, n_ess) = (by_strain * g_arc * arc + by_arc, by_strain * g_ess * ess + by_ess);
        let tangent = [
            by_strain / length,
            n_arc,
            n_ess,
            length * (g_arc * normal + g_arc * arc * (n_arc + by_arc)) + ss,
            length * (g_arc * arc * n_ess + by_arc * g_ess * ess) + sa,
            length * (g_ess * normal + g_ess * ess * (n_ess + by_ess)) + aa,
        ];
        Corrections { forces: in_chord(element, chord, [normal, m_s, m_a]), tangent }
    }
}

/// Parts of the plastic strains in the forces (N, M_s, M_a) of a chord, and in their derivatives.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Corrections {
    pub forces: [f64; 3],
    pub tangent: [f64; 6],
}

/// Forces with the part of N in the moments: N L psi_s/3 and N L psi_a/5 (BE11).
pub(crate) fn in_chord(element: &ElementConstants, chord: &Chord, [normal, m_s, m_a]: [f64; 3]) -> [f64; 3] {
    let [_, arc, ess] = chord.deformation;
    let [g_arc, g_ess] = element.curvature_strain.map(|g| g * element.length);
    [normal, m_s + normal * g_arc * arc, m_a + normal * g_ess * ess]
}

#[cfg(test)]
#[path = "yielding_tests.rs"]
mod tests;
