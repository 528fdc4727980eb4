//! Envelopes over a run: extreme section forces, stresses, strains and displacements.

use serde::{Deserialize, Serialize};

use super::{Dynamics, State};
use crate::element::SectionForces;
use crate::error::{Error, above_zero};
use crate::model::Beam;

/// Smallest and largest value of a quantity over a run, with their times \[s\].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// Smallest value.
    pub least: f64,
    /// Its time \[s\].
    pub time_of_least: f64,
    /// Largest value.
    pub most: f64,
    /// Its time \[s\].
    pub time_of_most: f64,
}

impl Range {
    const NONE: Self =
        Self { least: f64::INFINITY, time_of_least: f64::NAN, most: f64::NEG_INFINITY, time_of_most: f64::NAN };

    fn include(&mut self, value: f64, time: f64) {
        if value < self.least {
            (self.least, self.time_of_least) = (value, time);
        }
        if value > self.most {
            (self.most, self.time_of_most) = (value, time);
        }
    }

    /// The larger absolute value.
    pub fn largest(&self) -> f64 {
        self.most.abs().max(self.least.abs())
    }
}

/// Ranges at one end of an element.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EndEnvelope {
    /// Normal force \[N\].
    pub normal: Range,
    /// Shear force \[N\].
    pub shear: Range,
    /// Bending moment \[N m\].
    pub moment: Range,
    /// Stress of the outer fibres \[Pa\], over both fibres.
    pub fibre_stress: Range,
    /// Their strain \[-\], plastic strain included.
    pub fibre_strain: Range,
}

/// Ranges over a run: call [`Envelope::record`] after each step, or less often.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Envelope {
    /// Of element e at 2e (first node) and 2e + 1.
    pub ends: Vec<EndEnvelope>,
    /// Displacement `[nodes][u, w, theta]` \[m, m, rad\].
    pub displacement: Vec<[Range; 3]>,
}

impl Envelope {
    /// An empty envelope of a model.
    pub fn new(beam: &Beam) -> Self {
        let none = Range::NONE;
        let end = EndEnvelope { normal: none, shear: none, moment: none, fibre_stress: none, fibre_strain: none };
        Self { ends: vec![end; 2 * beam.elements().len()], displacement: vec![[none; 3]; beam.nodes().len()] }
    }

    /// Extends the envelope by a state.
    pub fn record(&mut self, dynamics: &Dynamics, state: &State) {
        let time = state.time;
        for (end, forces) in self.ends.iter_mut().zip(dynamics.section_forces(state)) {
            let SectionForces { normal, shear, moment } = forces;
            end.normal.include(normal, time);
            end.shear.include(shear, time);
            end.moment.include(moment, time);
        }
        for (end, fibres) in self.ends.iter_mut().zip(dynamics.fibres(state)) {
            fibres.stress.into_iter().for_each(|stress| end.fibre_stress.include(stress, time));
            fibres.strain.into_iter().for_each(|strain| end.fibre_strain.include(strain, time));
        }
        for (ranges, values) in self.displacement.iter_mut().zip(&state.displacement) {
            for (range, value) in ranges.iter_mut().zip(values) {
                range.include(*value, time);
            }
        }
    }

    /// Reserve factor `allowable` \[Pa\]/|sigma|max of each element over the run: below one the stress exceeds the
    /// allowable. Infinite for an element without stress.
    pub fn reserve_factors(&self, allowable: f64) -> Result<Vec<f64>, Error> {
        above_zero("allowable stress [Pa]", allowable)?;
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
