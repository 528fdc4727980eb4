//! Bending beyond the elastic limit: bilinear moment and curvature with kinematic hardening (Prager 1956).
//!
//! Each of the two Gauss points of an element has its own plastic curvature: M = EI (kappa - kappa_p), and kappa_p
//! flows where |M - H I kappa_p| reaches the yield moment (THEORY BE25).

use crate::error::{Error, not_negative, positive};
use serde::{Deserialize, Serialize};

/// How a material yields in bending. Along the axis it stays elastic, and normal force does not lower the limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plasticity {
    /// Stress along the element at which its outer fibres yield \[Pa\], positive: M_y = sigma_y b h^2/6. In a strip,
    /// held in plane strain, sigma_y/sqrt(1 - nu + nu^2) of the tension test (von Mises 1913).
    pub yield_stress: f64,
    /// Hardening modulus H \[Pa\], not negative: beyond the limit dM/dkappa = EI H I/(EI + H I).
    pub hardening_modulus: f64,
}

impl Plasticity {
    pub(crate) fn check(&self, element: usize) -> Result<(), Error> {
        positive("yield stress [Pa]", "element", element, self.yield_stress)?;
        not_negative("hardening modulus [Pa]", self.hardening_modulus)
    }
}

/// The constants of an element that yields.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlasticBending {
    /// EI \[N m^2\].
    pub stiffness: f64,
    /// H I \[N m^2\].
    pub hardening: f64,
    /// M_y \[N m\].
    pub yield_moment: f64,
    /// L \[m\].
    pub length: f64,
}

/// The return map of an element at given deformations.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flow {
    /// Plastic curvatures \[1/m\] and moments \[N m\] at the Gauss points.
    pub curvature: [f64; 2],
    pub moment: [f64; 2],
    /// Plastic part of (M_s, M_a) \[N m\], added to the elastic part.
    pub plastic_moments: [f64; 2],
    /// Plastic part of the tangent over (psi_s, psi_a): ss, sa, aa \[N m\]; not positive.
    pub softening: [f64; 3],
}

const SQRT_3: f64 = 1.732_050_807_568_877_2;

impl PlasticBending {
    /// Curvatures at the Gauss points: kappa = (-2 psi_s -+ 2 sqrt(3) psi_a)/L.
    pub fn curvatures(&self, &[_, arc, ess]: &[f64; 3]) -> [f64; 2] {
        [-1.0, 1.0].map(|sign| (-2.0 * arc + sign * 2.0 * SQRT_3 * ess) / self.length)
    }

    /// Curvatures at both ends: kappa = (-2 psi_s -+ 6 psi_a)/L.
    pub fn end_curvatures(&self, &[_, arc, ess]: &[f64; 3]) -> [f64; 2] {
        [-1.0, 1.0].map(|sign| (-2.0 * arc + sign * 6.0 * ess) / self.length)
    }

    /// What plastic curvatures add to the elastic (M_s, M_a) \[N m\].
    pub fn plastic_moments(&self, [one, two]: [f64; 2]) -> [f64; 2] {
        [self.stiffness * (one + two), self.stiffness * SQRT_3 * (one - two)]
    }

    /// Moments at the Gauss points of `deformation` and plastic `curvature`.
    pub fn moments(&self, deformation: &[f64; 3], curvature: [f64; 2]) -> [f64; 2] {
        let total = self.curvatures(deformation);
        [0, 1].map(|g| self.stiffness * (total[g] - curvature[g]))
    }

    /// Return map from the plastic curvatures `before` at `deformation`: a trial moment beyond the yield surface is
    /// projected onto it.
    pub fn flow(&self, deformation: &[f64; 3], before: [f64; 2]) -> Flow {
        let (stiffness, hardening) = (self.stiffness, self.hardening);
        let total = self.curvatures(deformation);
        let (mut curvature, mut tangent) = (before, [0.0; 2]);
        for g in 0..2 {
            let trial = stiffness * (total[g] - before[g]) - hardening * before[g];
            let excess = trial.abs() - self.yield_moment;
            if excess > 0.0 {
                curvature[g] += excess.copysign(trial) / (stiffness + hardening);
                tangent[g] = -stiffness * stiffness / (stiffness + hardening);
            }
        }
        let both = 2.0 / self.length * (tangent[0] + tangent[1]);
        Flow {
            curvature,
            moment: self.moments(deformation, curvature),
            plastic_moments: self.plastic_moments(curvature),
            softening: [both, 2.0 * SQRT_3 / self.length * (tangent[0] - tangent[1]), 3.0 * both],
        }
    }

    /// Elastic energy of bending \[J\].
    pub fn energy(&self, moments: [f64; 2]) -> f64 {
        0.25 * self.length * (moments[0].powi(2) + moments[1].powi(2)) / self.stiffness
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BENDING: PlasticBending = PlasticBending { stiffness: 20.0, hardening: 5.0, yield_moment: 3.0, length: 0.5 };

    #[test]
    fn moments_follow_the_bilinear_curve_and_unload_elastically() {
        // A pure arc: the same curvature everywhere.
        let at = |curvature: f64| [0.0, -0.5 * curvature * BENDING.length, 0.0];
        let (limit, slope) = (3.0 / 20.0, 20.0 * 5.0 / 25.0);
        let loaded = BENDING.flow(&at(0.4), [0.0; 2]);
        for moment in loaded.moment {
            assert!((moment - (3.0 + slope * (0.4 - limit))).abs() < 1e-12);
        }
        let unloaded = BENDING.flow(&at(0.3), loaded.curvature);
        assert_eq!(unloaded.curvature, loaded.curvature);
        assert!((unloaded.moment[0] - (loaded.moment[0] - 20.0 * 0.1)).abs() < 1e-12);
        // Back again it yields 2 M_y below where it turned (Bauschinger).
        let back = BENDING.flow(&at(0.4 - 2.0 * limit - 0.1), loaded.curvature);
        assert!((back.moment[1] - (loaded.moment[1] - 6.0 - slope * 0.1)).abs() < 1e-12);
    }

    #[test]
    fn softening_is_the_derivative_of_the_plastic_moments() {
        let deformation = [0.0, -0.09, 0.02];
        let flow = BENDING.flow(&deformation, [0.01, -0.02]);
        assert!(flow.softening[0] < 0.0);
        let step = 1e-7;
        for (k, entries) in [(1, [0, 1]), (2, [1, 2])] {
            let mut there = deformation;
            there[k] += step;
            let moved = BENDING.flow(&there, [0.01, -0.02]);
            for (i, entry) in entries.into_iter().enumerate() {
                let slope = (moved.plastic_moments[i] - flow.plastic_moments[i]) / step;
                assert!((slope - flow.softening[entry]).abs() < 1e-5, "{k}{i}: {slope}, {:?}", flow.softening);
            }
        }
    }
}
