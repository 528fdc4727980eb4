//! State of the thesis's projection, and the trial motion of a step.

use crate::legacy::pilorget2010::cast::{Cast, Reflection};
use crate::legacy::pilorget2010::limit::Limits;
use crate::legacy::pilorget2010::pairs::Pairs;
use crate::legacy::pilorget2010::settings::ThesisSettings;
use crate::wcsph::eos::Tait;

/// What the thesis's projection keeps from step to step, and what it counts.
#[derive(Clone, Debug, Default)]
pub struct Thesis {
    /// Its settings.
    pub settings: ThesisSettings,
    pub(crate) eos: Tait,
    pub(crate) limits: Limits,
    /// Masses of the wall particles [kg/m]; 0 for those that play no part.
    pub wall_mass: Vec<f64>,
    /// ρ₀ − Σ m W at the start [kg/m³] (LE19), by identity.
    pub(crate) deficit: Vec<f64>,
    /// The same of the limit particles.
    pub(crate) limit_deficit: Vec<f64>,
    /// ∇·r inside [-] (LE23).
    pub(crate) inside: f64,
    /// Gradient correction inside [-] (LE26).
    pub(crate) correction: f64,
    /// Particles now (r_n) and predicted (r*).
    pub(crate) cast: Cast,
    pub(crate) here: Pairs,
    pub(crate) there: Pairs,
    pub(crate) density: Vec<f64>,
    pub(crate) at_surface: Vec<bool>,
    pub(crate) reflections: Vec<Reflection>,
    /// Iterations of all solutions.
    pub iterations: u64,
    /// Solutions, one a pass of the inner loop.
    pub solutions: u64,
    /// Largest |ρ* − ρ₀|/ρ₀ that the last step's inner loop left [-] (LE27).
    pub density_error: f64,
}

/// Motion of one step before it is taken: r_n, v_n and the velocity found so far.
pub(crate) struct Trial {
    pub from: Vec<[f64; 2]>,
    pub before: Vec<[f64; 2]>,
    pub velocity: Vec<[f64; 2]>,
    pub dt: f64,
}

impl Trial {
    /// r* = r_n + v* Δt.
    pub fn predicted(&self, k: usize) -> [f64; 2] {
        [0, 1].map(|axis| self.from[k][axis] + self.dt * self.velocity[k][axis])
    }

    /// The same particles where they are.
    pub fn standing(&self) -> Trial {
        let (from, before) = (self.from.clone(), self.before.clone());
        Trial { velocity: vec![[0.0; 2]; from.len()], from, before, dt: self.dt }
    }

    /// v ← v + `time` a.
    pub fn kick(&mut self, a: &[[f64; 2]], time: f64) {
        for (v, a) in self.velocity.iter_mut().zip(a) {
            *v = [0, 1].map(|axis| v[axis] + time * a[axis]);
        }
    }
}
