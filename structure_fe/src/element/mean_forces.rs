//! Elastic forces over a step: their work is the change of the elastic energy, exactly, at any rotation.
//!
//! A discrete gradient (Gonzalez 1996) of the energy of BE11: the discrete derivatives of elongation and rotation of the
//! chord, times the motion of the step, are their exact changes; normal force and moments are weighted means of both
//! ends of the step (THEORY BE21).

use super::corotational::mean_strain;
use super::{Chord, ElementConstants, Ends, EndsMatrix, PlasticStrains, YieldStep, sinc};

/// Forces of an element over a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeanForces {
    /// Forces at the ends, in the global axes.
    pub forces: Ends,
    /// Their work beyond the change of the elastic energy \[J\]; zero if the weight is one half.
    pub dissipated: f64,
}

/// An element at the start of a step: its chord, the end values, and the plastic strains of one that yields.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Start<'a> {
    pub from: Chord,
    pub before: &'a Ends,
    pub plastic: Option<&'a PlasticStrains>,
}

/// The discrete gradient of an element's energy over a step: forces and tangent.
pub(crate) struct DiscreteGradient<'a> {
    element: &'a ElementConstants,
    weight: f64,
    from: Chord,
    to: Chord,
    /// Discrete derivatives of elongation \[-\] and rotation \[1/m\] by the chord vector.
    elongation_by: [f64; 2],
    rotation_by: [f64; 2],
    /// Rotation over the step \[rad\], and the factor of the mean chord in `rotation_by` \[1/m^2\].
    rotation: f64,
    factor: f64,
    mean: [f64; 3],
    /// N \[N\], M_s, M_a \[N m\].
    forces: [f64; 3],
    /// The return map of its layers.
    flow: Option<YieldStep>,
}

impl<'a> DiscreteGradient<'a> {
    /// The step from `start` to the end values `q`, with the `weight` of its end.
    #[inline]
    pub fn new(element: &'a ElementConstants, Start { from, before, plastic }: Start, q: &Ends, weight: f64) -> Self {
        let (to, rotation, ratio) = Chord::moved(element, &from, before, q);
        let [start, end] = [from, to].map(|chord| chord.direction.map(|x| chord.length * x));
        let middle = [0, 1].map(|axis| 0.5 * (start[axis] + end[axis]));
        let both = from.length + to.length;
        let factor = ratio / (from.length * to.length);
        let mean: [f64; 3] = std::array::from_fn(|i| 0.5 * (from.deformation[i] + to.deformation[i]));
        let weighted = |a: f64, b: f64| (1.0 - weight) * a + weight * b;
        let [axial, for_arc, for_ess] = element.stiffness;
        let [g_arc, g_ess] = element.curvature_strain.map(|factor| factor * element.length);
        let [before, after] = [&from, &to].map(|chord| mean_strain(element, &chord.deformation));
        let mut normal = axial * element.length * weighted(before, after);
        let flow = element
            .plastic
            .as_ref()
            .zip(plastic)
            .map(|(layers, plastic)| layers.step(element, [&from.deformation, &to.deformation], plastic, weight));
        if let Some(flow) = &flow {
            normal += weighted(flow.before[0], flow.after.forces[0]);
        }
        let of = |i: usize| weighted(from.deformation[i], to.deformation[i]);
        let mut forces =
            [normal, for_arc * of(1) + normal * g_arc * mean[1], for_ess * of(2) + normal * g_ess * mean[2]];
        if let Some(flow) = &flow {
            for k in 1..3 {
                forces[k] += weighted(flow.before[k], flow.after.forces[k]);
            }
        }
        let elongation_by = middle.map(|x| 2.0 * x / both);
        let rotation_by = [-factor * middle[1], factor * middle[0]];
        Self { element, weight, from, to, elongation_by, rotation_by, rotation, factor, mean, forces, flow }
    }

    pub fn forces(&self) -> MeanForces {
        let [normal, arc, ess] = self.forces;
        let [x, y] = [0, 1].map(|k| normal * self.elongation_by[k] - ess * self.rotation_by[k]);
        let element = self.element;
        let change: [f64; 3] = std::array::from_fn(|i| self.to.deformation[i] - self.from.deformation[i]);
        let [before, after] = [&self.from, &self.to].map(|chord| mean_strain(element, &chord.deformation));
        let [axial, for_arc, for_ess] = element.stiffness;
        let stretched = axial * (element.length * (after - before)).powi(2);
        let bent = (self.weight - 0.5) * (for_arc * change[1].powi(2) + for_ess * change[2].powi(2));
        let flown = self.flow.map_or(0.0, |flow| flow.dissipated);
        MeanForces {
            forces: Ends([-x, -y, 0.5 * (ess + arc), x, y, 0.5 * (ess - arc)]),
            dissipated: (self.weight - 0.5) * stretched + bent + flown,
        }
    }

    /// Derivative of the forces by the end values at the end of the step; not symmetric.
    #[inline]
    pub fn tangent(&self) -> EndsMatrix {
        let (element, weight) = (self.element, self.weight);
        let [normal, _, ess] = self.forces;
        let [axial, for_arc, for_ess] = element.stiffness;
        let [g_arc, g_ess] = element.curvature_strain.map(|g| g * element.length);
        let [c, s] = self.to.direction;
        let y = 1.0 / self.to.length;
        // Over the chord vector and both end rotations.
        let by_e = [c, s, 0.0, 0.0];
        let by_arc = [0.0, 0.0, 0.5, -0.5];
        let by_rotation = [-y * s, y * c, 0.0, 0.0];
        let by_ess = [y * s, -y * c, 0.5, 0.5];
        let [_, arc_end, ess_end] = self.to.deformation;
        let [_, arc_mean, ess_mean] = self.mean;
        let softening = self.flow.map_or([0.0; 6], |flow| flow.after.softening.map(|value| weight * value));
        let [strain, n_arc, n_ess, ss, sa, aa] = softening;
        let by = |k: usize| {
            let stretch = by_e[k] + g_arc * arc_end * by_arc[k] + g_ess * ess_end * by_ess[k];
            let mut n = weight * axial * stretch;
            if self.flow.is_some() {
                n += strain * stretch / element.length + n_arc * by_arc[k] + n_ess * by_ess[k];
            }
            let m_arc = (weight * for_arc + 0.5 * normal * g_arc) * by_arc[k]
                + g_arc * arc_mean * n
                + ss * by_arc[k]
                + sa * by_ess[k]
                + n_arc * stretch;
            let m_ess = (weight * for_ess + 0.5 * normal * g_ess) * by_ess[k]
                + g_ess * ess_mean * n
                + sa * by_arc[k]
                + aa * by_ess[k]
                + n_ess * stretch;
            [n, m_arc, m_ess]
        };
        let both = self.from.length + self.to.length;
        let x = self.rotation;
        let correction = if x.abs() < 1e-3 { -x / 3.0 } else { (x.cos() - sinc(x)) / (x * sinc(x)) };
        let quarter = 0.5 * self.factor;
        let mut rows = [[0.0; 4]; 4];
        for k in 0..4 {
            let [n, m_arc, m_ess] = by(k);
            let (along, rotated) = (by_e[k] / both, y * by_e[k] + correction * by_rotation[k]);
            let unit = [f64::from(u8::from(k == 0)), f64::from(u8::from(k == 1))];
            let crossed = [-quarter * unit[1], quarter * unit[0]];
            for axis in 0..2 {
                let elongation = unit[axis] / both - along * self.elongation_by[axis];
                let rotation = crossed[axis] - rotated * self.rotation_by[axis];
                rows[axis][k] = n * self.elongation_by[axis] + normal * elongation
                    - m_ess * self.rotation_by[axis]
                    - ess * rotation;
            }
            rows[2][k] = 0.5 * (m_ess + m_arc);
            rows[3][k] = 0.5 * (m_ess - m_arc);
        }
        let mut matrix = EndsMatrix::ZERO;
        // The chord vector is the position of the second end minus that of the first.
        let places = [[(0, -1.0), (3, 1.0)], [(1, -1.0), (4, 1.0)], [(2, 1.0), (2, 0.0)], [(5, 1.0), (5, 0.0)]];
        for i in 0..4 {
            for j in 0..4 {
                for (row, sign_i) in places[i] {
                    for (column, sign_j) in places[j] {
                        matrix[(row, column)] += sign_i * sign_j * rows[i][j];
                    }
                }
            }
        }
        matrix
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::{PlasticElement, Theory, deformation_forces, end_forces, strain_energy};
    use crate::material::{Material, Plasticity, Section};

    const MATERIAL: Material = Material { youngs_modulus: 3e6, poissons_ratio: 0.3, density: 200.0 };

    fn element(theory: Theory) -> ElementConstants {
        ElementConstants::new(&MATERIAL, &section(), theory, false, [0.4, 0.3])
    }

    const SOFT_IN_SHEAR: Theory = Theory::Timoshenko { shear_correction: 0.05 };

    fn section() -> Section {
        Section::rectangular(0.09, 0.1)
    }

    const FROM: Ends = Ends([0.1, -0.2, 0.3, 0.12, -0.1, -0.1]);
    fn step<'a>(
        element: &'a ElementConstants,
        before: &'a Ends,
        plastic: Option<&'a PlasticStrains>,
        to: &Ends,
        weight: f64,
    ) -> DiscreteGradient<'a> {
        DiscreteGradient::new(element, Start { from: Chord::new(element, before), before, plastic }, to, weight)
    }

    const TO: Ends = Ends([0.5, 0.3, 1.1, 0.2, 0.4, 0.6]);

    #[test]
    fn their_work_is_the_change_of_the_elastic_energy() {
        for theory in [Theory::EulerBernoulli, SOFT_IN_SHEAR] {
            let element = element(theory);
            let chord = |q: &Ends| Chord::new(&element, q);
            let moved = TO - FROM;
            let change = strain_energy(&element, &TO) - strain_energy(&element, &FROM);
            for weight in [0.5, 0.7] {
                let mean = step(&element, &FROM, None, &TO, weight).forces();
                let error = mean.forces.dot(&moved) - mean.dissipated - change;
                assert!(error.abs() < 1e-10 * change.abs(), "{weight}: {error:e} of {change}");
                assert!((mean.dissipated > 0.0) == (weight > 0.5));
            }
            // And at one place they are the forces there.
            let there = chord(&TO);
            let mean = step(&element, &TO, None, &TO, 0.5).forces().forces;
            let exact = there.to_global(&end_forces(&deformation_forces(&element, &there.deformation), there.length));
            for (mean, exact) in mean.0.iter().zip(exact.0) {
                assert!((mean - exact).abs() < 1e-10 * exact.abs().max(1.0));
            }
        }
    }

    #[test]
    fn the_tangent_is_their_derivative_also_where_the_element_yields() {
        let elastic = element(SOFT_IN_SHEAR);
        let mut yielding = element(Theory::EulerBernoulli);
        let soft = Plasticity { yield_stress: 5e4, hardening_modulus: 2e5 };
        yielding.plastic = PlasticElement::new((&MATERIAL, &section()), &soft, yielding.length, false);
        let mut strains = PlasticStrains::NONE;
        yielding.plastic.as_ref().unwrap().update(&yielding, &[0.02, 0.1, -0.2], &mut strains);
        assert!(strains.has_yielded());
        for (element, plastic) in [(elastic, None), (yielding, Some(&strains))] {
            for to in [TO, FROM + 1e-5 * TO] {
                let tangent = step(&element, &FROM, plastic, &to, 0.6).tangent();
                for j in 0..6 {
                    let h = 1e-6;
                    let [low, high] = [-h, h].map(|change| {
                        let mut q = to;
                        q[j] += change;
                        step(&element, &FROM, plastic, &q, 0.6).forces().forces
                    });
                    for i in 0..6 {
                        let slope = (high[i] - low[i]) / (2.0 * h);
                        let error = tangent[(i, j)] - slope;
                        assert!(error.abs() < 5e-3, "{i}{j}: {} against {slope}", tangent[(i, j)]);
                    }
                }
            }
        }
    }
}
