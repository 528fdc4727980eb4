//! How a material yields: von Mises' condition with kinematic hardening, along the element and, in a strip, across the plane too.
//!
//! A layer of the section has the strain epsilon along the element. A bar is free to contract; a strip is held in plane strain, so that a
//! stress acts across the plane as well. Without normal stress through the thickness both are states of plane stress, and the return to
//! the yield surface has one unknown (Simo & Taylor 1986; THEORY BE25).

use crate::error::{Error, not_negative, positive};
use crate::material::{Material, Section};
use serde::{Deserialize, Serialize};

/// How a material yields, by force and moment together.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plasticity {
    /// Yield stress of the tension test \[Pa\], positive. A strip, held in plane strain, yields along the element first at
    /// sigma_y/sqrt(1 - nu + nu^2), and flows at 2 sigma_y/sqrt(3) (von Mises 1913).
    pub yield_stress: f64,
    /// Hardening modulus H of the tension test \[Pa\], not negative: stress over plastic strain.
    pub hardening_modulus: f64,
}

impl Plasticity {
    pub(crate) fn check(&self, element: usize) -> Result<(), Error> {
        positive("yield stress [Pa]", "element", element, self.yield_stress)?;
        not_negative("hardening modulus [Pa]", self.hardening_modulus)
    }
}

/// A trial stress above the yield stress by less than this share of it is on the yield surface \[-\].
const ON_SURFACE: f64 = 1e-12;

/// Most corrections of the return; each adds digits, for the function is concave.
const RETURNS: usize = 40;

/// The constants of a material that yields.
#[derive(Debug, Clone, Copy)]
pub(crate) struct YieldLaw {
    /// Modulus along the element: E, in plane strain E/(1 - nu^2) \[Pa\].
    pub modulus: f64,
    /// Poisson's ratio nu in plane strain; none in a bar.
    contraction: Option<f64>,
    shear: f64,
    hardening: f64,
    yield_stress: f64,
}

/// The state of a layer after the return.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Returned {
    /// Plastic strains along the element and across the plane \[-\].
    pub plastic: [f64; 2],
    /// Change of the tangent d sigma/d epsilon against the modulus \[Pa\]; not positive.
    pub softening: f64,
}

impl YieldLaw {
    pub fn new(material: &Material, section: &Section, plasticity: &Plasticity) -> Self {
        let Plasticity { yield_stress, hardening_modulus: hardening } = *plasticity;
        let contraction = section.is_strip().then_some(material.poissons_ratio);
        let shear = material.youngs_modulus / (2.0 * (1.0 + material.poissons_ratio));
        Self { modulus: section.modulus(material), contraction, shear, hardening, yield_stress }
    }

    /// Stress along the element at which it yields first \[Pa\].
    pub fn first_yield(&self) -> f64 {
        let nu = self.contraction.unwrap_or(0.0);
        self.yield_stress / (1.0 - nu + nu * nu).sqrt()
    }

    /// What plastic strains take off the stress along the element \[Pa\].
    pub fn relief(&self, [along, across]: [f64; 2]) -> f64 {
        -self.modulus * (along + self.contraction.unwrap_or(0.0) * across)
    }

    /// Stresses along the element and across the plane \[Pa\].
    pub fn stress(&self, strain: f64, [along, across]: [f64; 2]) -> [f64; 2] {
        let nu = self.contraction.unwrap_or(0.0);
        let sideways = self.contraction.map_or(0.0, |nu| self.modulus * (nu * (strain - along) - across));
        [self.modulus * (strain - along - nu * across), sideways]
    }

    /// The return to the yield surface from the plastic strains `before`, at a strain.
    pub fn respond(&self, strain: f64, before: [f64; 2]) -> Returned {
        match self.contraction {
            None => self.in_tension(strain, before),
            Some(nu) => self.in_plane_strain(nu, strain, before),
        }
    }

    fn in_tension(&self, strain: f64, before: [f64; 2]) -> Returned {
        let trial = self.modulus * (strain - before[0]) - self.hardening * before[0];
        let excess = trial.abs() - self.yield_stress;
        if excess <= ON_SURFACE * self.yield_stress {
            return Returned { plastic: before, softening: 0.0 };
        }
        let both = self.modulus + self.hardening;
        let plastic = [before[0] + excess.copysign(trial) / both, 0.0];
        Returned { plastic, softening: -self.modulus * self.modulus / both }
    }

    /// In the sum and the difference of both stresses, over sqrt(2), elasticity and flow are diagonal: eta = eta_trial/(1 + rate gamma).
    fn in_plane_strain(&self, nu: f64, strain: f64, before: [f64; 2]) -> Returned {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let turned = |[x, z]: [f64; 2]| [half * (x + z), half * (x - z)];
        let [along, across] = before;
        let back = 2.0 / 3.0 * self.hardening;
        let [x, z] = self.stress(strain, before);
        let trial = turned([x - back * (2.0 * along + across), z - back * (2.0 * across + along)]);
        // von Mises' stress is sqrt(1/2 eta_1^2 + 3/2 eta_2^2)
        let mises = |[sum, difference]: [f64; 2]| (0.5 * sum * sum + 1.5 * difference * difference).sqrt();
        if mises(trial) <= (1.0 + ON_SURFACE) * self.yield_stress {
            return Returned { plastic: before, softening: 0.0 };
        }
        let elastic = [self.modulus * (1.0 + nu) / 3.0, 2.0 * self.shear];
        let rate = elastic.map(|stiffness| back + stiffness);
        let at = |gamma: f64| [0, 1].map(|k| trial[k] / (1.0 + rate[k] * gamma));
        // 1/mises is concave in gamma: Newton's method approaches from below
        let mut gamma = 0.0;
        for _ in 0..RETURNS {
            let eta = at(gamma);
            let size = mises(eta);
            let missing = size / self.yield_stress - 1.0;
            if missing <= 1e-15 {
                break;
            }
            let [first, second] = [0, 1].map(|k| eta[k] * eta[k] * rate[k] / (1.0 + rate[k] * gamma));
            gamma += missing * size * size / (0.5 * first + 1.5 * second);
        }
        let (eta, weight) = (at(gamma), [1.0 / 3.0, 1.0]);
        let [sum, difference] = [0, 1].map(|k| half * gamma * weight[k] * eta[k]);
        let plastic = [along + (sum + difference), across + (sum - difference)];
        // derivatives by the strain: of the trial, of gamma, of the stress
        let moved = turned([self.modulus, nu * self.modulus]);
        let reduced = [0, 1].map(|k| 1.0 / (1.0 + rate[k] * gamma));
        let normal = [eta[0], 3.0 * eta[1]];
        let over = |of: &dyn Fn(usize) -> f64| normal[0] * of(0) + normal[1] * of(1);
        let by_gamma = over(&|k| moved[k] * reduced[k]) / over(&|k| eta[k] * rate[k] * reduced[k]);
        let lost = [0, 1].map(|k| {
            let eta_moved = (moved[k] - eta[k] * rate[k] * by_gamma) * reduced[k];
            elastic[k] * (by_gamma * eta[k] + gamma * eta_moved)
        });
        Returned { plastic, softening: -half * (lost[0] + lost[1]) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: Material = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };
    const LAW: Plasticity = Plasticity { yield_stress: 300e6, hardening_modulus: 2e9 };

    fn laws(plasticity: Plasticity) -> [YieldLaw; 2] {
        [Section::rectangular(0.01, 1.0), Section::strip(0.01)].map(|s| YieldLaw::new(&STEEL, &s, &plasticity))
    }

    /// Von Mises' stress of the stress less its back stress, by the tensors.
    fn mises(law: &YieldLaw, strain: f64, plastic: [f64; 2]) -> f64 {
        let [x, z] = law.stress(strain, plastic);
        let [along, across] = plastic;
        let mean = (x + z) / 3.0;
        let sideways = if law.contraction.is_some() { across } else { -0.5 * along };
        let flow = [along, sideways, -along - sideways].map(|p| 2.0 / 3.0 * law.hardening * p);
        let deviator = [x - mean - flow[0], z - mean - flow[1], -mean - flow[2]];
        (1.5 * deviator.iter().map(|s| s * s).sum::<f64>()).sqrt()
    }

    #[test]
    fn a_return_ends_on_the_yield_surface_and_its_tangent_is_the_derivative() {
        for law in laws(LAW) {
            for (strain, before) in [(0.004, [0.0; 2]), (-0.03, [0.001, -0.0004]), (0.2, [0.0; 2])] {
                let before = if law.contraction.is_some() { before } else { [before[0], 0.0] };
                let there = law.respond(strain, before);
                let error = mises(&law, strain, there.plastic) / LAW.yield_stress - 1.0;
                assert!(error.abs() < 1e-9, "{law:?} at {strain}: {error:e}");
                let stress = |strain: f64| law.stress(strain, law.respond(strain, before).plastic)[0];
                let slope = (stress(strain + 1e-7) - stress(strain - 1e-7)) / 2e-7;
                let tangent = law.modulus + there.softening;
                assert!((slope - tangent).abs() < 1e-6 * law.modulus, "{slope:e} against {tangent:e}");
            }
        }
    }

    #[test]
    fn a_strip_yields_later_than_a_bar_and_flows_at_two_over_root_three() {
        let [bar, strip] = laws(Plasticity { hardening_modulus: 0.0, ..LAW });
        let first = LAW.yield_stress / 0.79_f64.sqrt();
        for (strain, flows) in [(0.999 * first / strip.modulus, false), (1.001 * first / strip.modulus, true)] {
            assert_eq!(strip.respond(strain, [0.0; 2]).plastic[0] > 0.0, flows, "{strain}");
        }
        let mut plastic = [[0.0; 2]; 2];
        for step in 0..=400 {
            let strain = 1e-4 * f64::from(step);
            plastic = [bar.respond(strain, plastic[0]).plastic, strip.respond(strain, plastic[1]).plastic];
        }
        let ratio = strip.stress(0.04, plastic[1])[0] / LAW.yield_stress;
        assert!((ratio / (2.0 / 3.0_f64.sqrt()) - 1.0).abs() < 1e-4, "{ratio}");
        assert!((bar.stress(0.04, plastic[0])[0] / LAW.yield_stress - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_bar_hardens_by_its_tangent_and_yields_early_on_the_way_back() {
        let [bar, _] = laws(LAW);
        let tangent = STEEL.youngs_modulus * LAW.hardening_modulus / (STEEL.youngs_modulus + LAW.hardening_modulus);
        let limit = LAW.yield_stress / STEEL.youngs_modulus;
        let out = bar.respond(0.02, [0.0; 2]).plastic;
        let top = bar.stress(0.02, out)[0];
        assert!((top / (LAW.yield_stress + tangent * (0.02 - limit)) - 1.0).abs() < 1e-12);
        let back = 0.02 - 2.0 * limit - 0.001;
        let low = bar.stress(back, bar.respond(back, out).plastic)[0];
        assert!((low - (top - 2.0 * LAW.yield_stress - tangent * 0.001)).abs() < 1e-3, "{low}");
    }

    /// Plastic work of a cycle between two strains: 4 sigma_y p of a bar, p = (epsilon - sigma_y/E)/(1 + H/E).
    #[test]
    fn cycles_dissipate_the_area_of_their_loop() {
        let [bar, strip] = laws(LAW);
        for law in [bar, strip] {
            let (mut plastic, mut stress, mut work) = ([0.0; 2], [0.0; 2], 0.0);
            for step in 1..=5000 {
                let strain = 0.01 * (std::f64::consts::TAU * f64::from(step) / 1000.0).sin();
                let (before, from) = (plastic, stress);
                plastic = law.respond(strain, before).plastic;
                stress = law.stress(strain, plastic);
                // of the last cycle
                if step > 4000 {
                    work += [0, 1].map(|k| 0.5 * (from[k] + stress[k]) * (plastic[k] - before[k])).iter().sum::<f64>();
                }
            }
            if law.contraction.is_none() {
                let amplitude = (0.01 - LAW.yield_stress / law.modulus) / (1.0 + LAW.hardening_modulus / law.modulus);
                assert!((work / (4.0 * LAW.yield_stress * amplitude) - 1.0).abs() < 1e-2, "{work}");
            } else {
                // of a flow in plane strain, with 2/sqrt(3) sigma_y along the element
                let modulus = law.modulus;
                let amplitude = 0.01 - 2.0 / 3.0_f64.sqrt() * LAW.yield_stress / modulus;
                assert!((work / (8.0 / 3.0_f64.sqrt() * LAW.yield_stress * amplitude) - 1.0).abs() < 0.05, "{work}");
            }
        }
    }
}
