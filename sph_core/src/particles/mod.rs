//! The fluid's particles: what a restart needs ([`Particles`]), what a step recomputes ([`Derived`]).
//!
//! Structures of arrays by component, one entry per particle, physically sorted by cell at every
//! rebuild of the neighbour lists; [`Particles::id`] keeps a particle's identity through the sorting.

pub mod probe;
pub mod refinement;
pub mod totals;

use serde::{Deserialize, Serialize};

use crate::parallel;

/// One fluid particle as a filler makes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seed {
    /// Position [m].
    pub at: [f64; 2],
    /// Velocity [m/s].
    pub velocity: [f64; 2],
    /// Area it stands for [m²]; its square root is the local spacing.
    pub area: f64,
    /// Pressure it starts with [Pa].
    pub pressure: f64,
}

/// State that lives from step to step. All arrays have one entry per particle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Particles {
    /// Horizontal position [m].
    pub x: Vec<f64>,
    /// Vertical position [m].
    pub y: Vec<f64>,
    /// Horizontal velocity [m/s].
    pub u: Vec<f64>,
    /// Vertical velocity [m/s].
    pub v: Vec<f64>,
    /// Density [kg/m³].
    pub rho: Vec<f64>,
    /// Mass per metre of span [kg/m].
    pub mass: Vec<f64>,
    /// Smoothing length [m].
    pub h: Vec<f64>,
    /// Volume correction θ [-] (THEORY E12): V = θ m/ρ; empty where volumes are not corrected.
    pub theta: Vec<f64>,
    /// Horizontal acceleration at the end of the last step [m/s²].
    pub ax: Vec<f64>,
    /// Vertical acceleration at the end of the last step [m/s²].
    pub ay: Vec<f64>,
    /// Identity, stable through sorting.
    pub id: Vec<u32>,
    /// Specific internal energy e [J/kg] of a gas (THEORY L10); empty for water.
    pub energy: Vec<f64>,
    /// How often it was halved (THEORY E26); empty without a fine zone that moves.
    pub halvings: Vec<u8>,
    /// Has it, or a neighbour of it, been halved? Then it settles (THEORY E13). Empty likewise.
    pub stirred: Vec<bool>,
}

impl Particles {
    /// Room for `n` particles, and none yet.
    pub(crate) fn with_capacity(n: usize) -> Particles {
        let numbers = || Vec::with_capacity(n);
        Particles {
            x: numbers(),
            y: numbers(),
            u: numbers(),
            v: numbers(),
            rho: numbers(),
            mass: numbers(),
            h: numbers(),
            theta: numbers(),
            ax: numbers(),
            ay: numbers(),
            id: Vec::with_capacity(n),
            energy: numbers(),
            halvings: Vec::new(),
            stirred: Vec::new(),
        }
    }

    /// Specific internal energy of particle `k` [J/kg]; 0 for water.
    pub(crate) fn energy_of(&self, k: usize) -> f64 {
        self.energy.get(k).copied().unwrap_or(0.0)
    }

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// True when there is no fluid.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Append a particle of density `rho` [kg/m³] and specific internal energy `energy` [J/kg] whose smoothing length is
    /// `ratio` spacings.
    pub fn push(&mut self, seed: &Seed, rho: f64, energy: f64, ratio: f64) {
        self.id.push(self.x.len() as u32);
        self.x.push(seed.at[0]);
        self.y.push(seed.at[1]);
        self.u.push(seed.velocity[0]);
        self.v.push(seed.velocity[1]);
        self.rho.push(rho);
        self.mass.push(rho * seed.area);
        self.h.push(ratio * seed.area.sqrt());
        self.theta.push(1.0);
        self.ax.push(0.0);
        self.ay.push(0.0);
        self.energy.push(energy);
    }

    /// Put particle `order[k]` at place k, in every array.
    pub(crate) fn permute(&mut self, order: &[u32]) {
        let Particles { x, y, u, v, rho, mass, h, theta, ax, ay, id, energy, halvings, stirred } = self;
        let mut scratch = Vec::new();
        for array in [x, y, u, v, rho, mass, h, theta, ax, ay, energy].into_iter().filter(|a| !a.is_empty()) {
            permute(array, order, &mut scratch);
        }
        let old = id.clone();
        for (k, &from) in order.iter().enumerate() {
            id[k] = old[from as usize];
        }
        if !halvings.is_empty() {
            *halvings = order.iter().map(|&from| halvings[from as usize]).collect();
            *stirred = order.iter().map(|&from| stirred[from as usize]).collect();
        }
    }
}

/// `array[k] ← array[order[k]]`, through `scratch`.
fn permute(array: &mut Vec<f64>, order: &[u32], scratch: &mut Vec<f64>) {
    scratch.resize(order.len(), 0.0);
    parallel::gather_into(scratch, |k| array[order[k] as usize]);
    std::mem::swap(array, scratch);
}

/// What a step recomputes, one entry per particle.
#[derive(Clone, Debug, Default)]
pub struct Derived {
    /// Pressure [Pa].
    pub pressure: Vec<f64>,
    /// Corrected volume θ m/ρ per metre of span [m²]; empty where it is m/ρ.
    pub volume: Vec<f64>,
    /// Geometry of the neighbourhood.
    pub surroundings: Vec<Surroundings>,
    /// True for a particle that is, or has within its support, a free-surface particle.
    pub near_surface: Vec<bool>,
}

impl Derived {
    pub(crate) fn resize(&mut self, n: usize) {
        self.pressure.resize(n, 0.0);
        self.volume.resize(n, 0.0);
        self.surroundings.resize(n, Surroundings::default());
        self.near_surface.resize(n, false);
    }

    pub(crate) fn permute(&mut self, order: &[u32]) {
        fn gather<T: Copy + Default + Send + Sync>(array: &mut Vec<T>, order: &[u32]) {
            if array.is_empty() {
                return;
            }
            let mut sorted = vec![T::default(); order.len()];
            parallel::gather_into(&mut sorted, |k| array[order[k] as usize]);
            *array = sorted;
        }
        gather(&mut self.pressure, order);
        gather(&mut self.volume, order);
        gather(&mut self.surroundings, order);
        gather(&mut self.near_surface, order);
    }

    /// Volume per metre of span of particle `k` of `p` [m²].
    pub fn volume_of(&self, k: usize, p: &Particles) -> f64 {
        self.volume.get(k).copied().unwrap_or_else(|| p.mass[k] / p.rho[k])
    }

    /// E3: does the fluid here hold no tension? Spray does not; nor, with `ventilation`, does what touches both a wall and
    /// the air, which comes in between.
    pub(crate) fn slack(&self, k: usize, ventilation: bool) -> bool {
        self.surroundings[k].slack(self.near_surface[k], ventilation)
    }
}

/// How the neighbours lie around a particle (THEORY E12–E14), summed with the uncorrected volumes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings {
    /// S = Σ V W [-] (E12): 1 where space is filled as the densities say.
    pub filling: f64,
    /// The walls' share of S [-]; exactly 0 away from them.
    pub wall_filling: f32,
    /// ∇C = Σ V ∇W [1/m] (E13), see [`Surroundings::crowding`].
    pub crowding: [f32; 2],
    /// λ (E14), smallest eigenvalue of the renormalisation matrix Σ V (r_b − r_a)⊗∇W [-]: 1 inside, about 0.5 on a flat free surface.
    pub lambda: f32,
}

impl Surroundings {
    /// What a sweep found, in double precision; what is only compared with thresholds or shifts a particle is kept in single.
    pub(crate) fn new(filling: f64, fluid_filling: f64, crowding: [f64; 2], lambda: f64) -> Surroundings {
        let wall_filling = (filling - fluid_filling) as f32;
        Surroundings { filling, wall_filling, crowding: crowding.map(|c| c as f32), lambda: lambda as f32 }
    }

    /// The fluid's own share of S [-]: about 0.6 in the top row of a flat surface, 0.25 for a lone particle.
    #[inline]
    pub fn fluid_filling(&self) -> f64 {
        self.filling - f64::from(self.wall_filling)
    }

    /// ∇C = Σ V ∇W [1/m] (E13): points to where particles crowd.
    #[inline]
    pub fn crowding(&self) -> [f64; 2] {
        self.crowding.map(f64::from)
    }

    /// Is it in the row of the free surface (E14)?
    #[inline]
    pub(crate) fn at_surface(&self) -> bool {
        self.lambda < SURFACE_LAMBDA
    }

    /// E3: see [`Derived::slack`].
    #[inline]
    pub(crate) fn slack(&self, near_surface: bool, ventilation: bool) -> bool {
        let at_waterline = near_surface && self.wall_filling > 0.0;
        self.fluid_filling() < SPRAY_FILLING || (ventilation && at_waterline)
    }
}

impl Default for Surroundings {
    /// Deep inside the fluid: what a particle is taken for before its first sweep.
    fn default() -> Surroundings {
        Surroundings { filling: 1.0, wall_filling: 0.0, crowding: [0.0; 2], lambda: 1.0 }
    }
}

/// Particles of the free surface have λ below this (E14; Marrone et al. 2010 use 0.75 for the jump to the interior).
pub const SURFACE_LAMBDA: f32 = 0.7;

/// Spray (E3): particles whose fluid filling is below this are in films a particle thick, or alone. They hold no
/// tension, so that they leave a wall instead of creeping along it.
pub const SPRAY_FILLING: f64 = 0.5;
