//! What a run was at its worst: envelopes of section forces, stresses, strains and displacements.

use crate::beam::Beam;
use crate::dynamics::Dynamics;
use crate::error::{Error, positive};
use crate::section_forces::SectionForces;
use crate::state::State;

/// Smallest and largest value of a quantity over a run, with their times \[s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Smallest value.
    pub least: f64,
    /// When it was \[s\].
    pub time_of_least: f64,
    /// Largest value.
    pub most: f64,
    /// When it was \[s\].
    pub time_of_most: f64,
}

impl Range {
    const NONE: Self =
        Self { least: f64::INFINITY, time_of_least: f64::NAN, most: f64::NEG_INFINITY, time_of_most: f64::NAN };

    fn take(&mut self, value: f64, time: f64) {
        if value < self.least {
            (self.least, self.time_of_least) = (value, time);
        }
        if value > self.most {
            (self.most, self.time_of_most) = (value, time);
        }
    }

    /// The larger of both in size.
    pub fn largest(&self) -> f64 {
        self.most.abs().max(self.least.abs())
    }
}

/// Ranges at one end of an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndEnvelope {
    /// Normal force \[N\].
    pub normal: Range,
    /// Shear force \[N\].
    pub shear: Range,
    /// Bending moment \[N m\].
    pub moment: Range,
    /// Stress of the outer fibres \[Pa\], of whichever is larger or smaller.
    pub fibre_stress: Range,
    /// Their strain \[-\], plastic strain included.
    pub fibre_strain: Range,
}

/// Ranges over a run: call [`Envelope::record`] after each step, or as often as is wanted.
#[derive(Debug, Clone, PartialEq)]
pub struct Envelope {
    /// Of element e at 2e (first node) and 2e + 1.
    pub ends: Vec<EndEnvelope>,
    /// Displacement `[nodes][u, w, theta]` \[m, m, rad\].
    pub displacement: Vec<[Range; 3]>,
}

impl Envelope {
    /// Of a model of which nothing has been seen yet.
    pub fn new(beam: &Beam) -> Self {
        let none = Range::NONE;
        let end = EndEnvelope { normal: none, shear: none, moment: none, fibre_stress: none, fibre_strain: none };
        Self { ends: vec![end; 2 * beam.elements().len()], displacement: vec![[none; 3]; beam.nodes().len()] }
    }

    /// Takes a state in.
    pub fn record(&mut self, dynamics: &Dynamics, state: &State) {
        let time = state.time;
        let elements = dynamics.beam().elements();
        for (index, (end, forces)) in self.ends.iter_mut().zip(dynamics.section_forces(state)).enumerate() {
            let element = &elements[index / 2];
            let SectionForces { normal, shear, moment } = forces;
            end.normal.take(normal, time);
            end.shear.take(shear, time);
            end.moment.take(moment, time);
            let half = 0.5 * element.section.thickness();
            for eta in [-half, half] {
                end.fibre_stress.take(forces.fibre_stress(&element.section, eta), time);
            }
        }
        for (end, strains) in self.ends.iter_mut().zip(dynamics.fibre_strains(state)) {
            for strain in strains {
                end.fibre_strain.take(strain, time);
            }
        }
        for (ranges, values) in self.displacement.iter_mut().zip(&state.displacement) {
            for (range, value) in ranges.iter_mut().zip(values) {
                range.take(*value, time);
            }
        }
    }

    /// Reserve factor `allowable` \[Pa\]/|sigma|max of each element over the run: below one is too much. Infinite where
    /// nothing was stressed.
    pub fn reserve_factors(&self, allowable: f64) -> Result<Vec<f64>, Error> {
        positive("allowable stress [Pa]", "envelope", 0, allowable)?;
        let of_ends = |ends: &[EndEnvelope]| {
            let largest = ends.iter().map(|end| end.fibre_stress.largest()).filter(|stress| stress.is_finite());
            allowable / largest.fold(0.0, f64::max)
        };
        Ok(self.ends.chunks_exact(2).map(of_ends).collect())
    }

    /// The element of the smallest reserve factor, and the factor.
    pub fn reserve_factor(&self, allowable: f64) -> Result<(usize, f64), Error> {
        let factors = self.reserve_factors(allowable)?;
        let first = (0, f64::INFINITY);
        Ok(factors.into_iter().enumerate().fold(first, |least, other| if other.1 < least.1 { other } else { least }))
    }
}
