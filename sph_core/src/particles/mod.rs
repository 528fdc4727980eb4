//! The fluid's particles: their state ([`Particles`]) and the quantities that a step recomputes ([`Fields`]).
//!
//! Structures of arrays by component, one entry per particle, physically sorted by cell at every
//! rebuild of the neighbour lists; [`Particles::id`] keeps a particle's identity through the sorting.

mod fields;
pub mod totals;

use serde::{Deserialize, Serialize};

use crate::memory::of_vector;
use crate::parallel;
use crate::state_bytes::{StateError, expect_count};

pub use fields::{Fields, KernelMoments, SURFACE_LAMBDA, TENSIONLESS_KERNEL_SUM};

/// A stored particle is refused farther from the water than this, in its extents [-].
const FAR: f64 = 100.0;
/// A particle is coarse if its smoothing length is more than this many times that of the finest [-].
pub(crate) const COARSE: f64 = 1.05;

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
    /// Horizontal acceleration at the end of the last step [m/s²].
    pub ax: Vec<f64>,
    /// Vertical acceleration at the end of the last step [m/s²].
    pub ay: Vec<f64>,
    /// Identity, stable through sorting.
    pub id: Vec<u32>,
    /// Specific internal energy e [J/kg] of a gas (THEORY LE12); empty for water.
    pub energy: Vec<f64>,
    /// Acceleration f that keeps graded water at rest (THEORY WC28) [m/s²], shape (2, n); empty where nothing is graded.
    pub rest: [Vec<f64>; 2],
    /// Where it acts: the place of each particle at the start [m], shape (2, n); empty likewise.
    pub(crate) home: [Vec<f64>; 2],
    /// Energy −Σ m f·r of particles when their f ended, less the work that still water's pressure did by errors of pairs (THEORY WC29) [J/m].
    pub released: f64,
    /// How often it was halved (THEORY WC21); empty without a fine zone that moves.
    pub(crate) refinement_level: Vec<u8>,
    /// Has it, or a neighbour of it, been halved? Then it settles (THEORY WC10). Empty likewise.
    pub(crate) newly_split: Vec<bool>,
}

impl Particles {
    /// Particles of seeds, whose smoothing lengths are `ratio` spacings; `state` gives density [kg/m³] and specific internal energy
    /// [J/kg] of each.
    pub(crate) fn of(seeds: &[Seed], state: impl Fn(&Seed) -> (f64, Option<f64>), ratio: f64) -> Particles {
        let each = |value: fn(&Seed) -> f64| seeds.iter().map(value).collect();
        let (rho, energy): (Vec<f64>, Vec<Option<f64>>) = seeds.iter().map(state).unzip();
        Particles {
            x: each(|seed| seed.at[0]),
            y: each(|seed| seed.at[1]),
            u: each(|seed| seed.velocity[0]),
            v: each(|seed| seed.velocity[1]),
            mass: rho.iter().zip(seeds).map(|(rho, seed)| rho * seed.area).collect(),
            rho,
            h: seeds.iter().map(|seed| smoothing_length(ratio * ratio * seed.area)).collect(),
            ax: vec![0.0; seeds.len()],
            ay: vec![0.0; seeds.len()],
            id: (0..seeds.len() as u32).collect(),
            energy: energy.into_iter().flatten().collect(),
            ..Particles::default()
        }
    }

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// True when there is no fluid.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Acceleration that keeps particle `k` of still water at rest (WC28) [m/s²].
    #[inline(always)]
    pub(crate) fn rest(&self, k: usize) -> [f64; 2] {
        if self.rest[0].is_empty() { [0.0; 2] } else { [self.rest[0][k], self.rest[1][k]] }
    }

    /// WC28: end the acceleration that keeps particle `k` at rest.
    pub(crate) fn release(&mut self, k: usize) {
        let [fx, fy] = self.rest(k);
        self.released -= self.mass[k] * (fx * self.x[k] + fy * self.y[k]);
        self.rest.iter_mut().filter(|f| !f.is_empty()).for_each(|f| f[k] = 0.0);
    }

    /// Memory that the arrays occupy [bytes].
    pub(crate) fn bytes(&self) -> usize {
        let Particles {
            x, y, u, v, rho, mass, h, ax, ay, id, energy, rest, home, refinement_level, newly_split, ..
        } = self;
        let arrays = [x, y, u, v, rho, mass, h, ax, ay, energy].into_iter().chain(rest).chain(home);
        let numbers: usize = arrays.map(of_vector).sum();
        numbers + of_vector(id) + of_vector(refinement_level) + of_vector(newly_split)
    }

    /// An error unless all arrays have an entry per particle, and identities are those of 0, 1, 2, …; those that are empty in `like`
    /// may be empty.
    pub(crate) fn check(&self, like: &Particles) -> Result<(), StateError> {
        let Particles {
            x, y, u, v, rho, mass, h, ax, ay, id, energy, rest, home, refinement_level, newly_split, ..
        } = self;
        let n = x.len();
        for array in [y, u, v, rho, mass, h, ax, ay] {
            expect_count("entries of a particles' array", array.len(), n)?;
        }
        let is_finite = |k: &usize| [x, y, u, v, rho, mass, h, ax, ay].iter().all(|array| array[*k].is_finite());
        expect_count("particles with finite numbers", (0..n).filter(is_finite).count(), n)?;
        let near = [(x, &like.x), (y, &like.y)].map(|(now, start)| within(now, start, FAR * like.extent()));
        expect_count("particles within a hundred times the water's extent", near[0].min(near[1]), n)?;
        expect_count("identities", id.len(), n)?;
        expect_count("energies", energy.len(), if like.energy.is_empty() { 0 } else { n })?;
        for (rest, like) in rest.iter().chain(home).zip(like.rest.iter().chain(&like.home)) {
            expect_count("accelerations of rest", rest.len(), if like.is_empty() { 0 } else { n })?;
        }
        for split in [refinement_level.len(), newly_split.len()].into_iter().filter(|&split| split > 0) {
            expect_count("refinement levels", split, n)?;
        }
        let mut known = vec![false; n];
        for &i in id.iter().filter(|&&i| (i as usize) < n) {
            known[i as usize] = true;
        }
        expect_count("different identities", known.iter().filter(|known| **known).count(), n)
    }

    /// Width and height of the box around the supports of all particles, together [m].
    fn extent(&self) -> f64 {
        let side = |[low, high]: [f64; 2]| (high - low).max(0.0);
        side(ends(&self.x)) + side(ends(&self.y)) + 4.0 * ends(&self.h)[1].max(0.0)
    }

    /// Put particle `order[k]` at place k, in every array.
    pub(crate) fn permute(&mut self, order: &[u32], spare: &mut Spare) {
        let Particles {
            x, y, u, v, rho, mass, h, ax, ay, id, energy, rest, home, refinement_level, newly_split, ..
        } = self;
        for array in [x, y, u, v, rho, mass, h, ax, ay, energy].into_iter().chain(rest).chain(home) {
            permute(array, order, &mut spare.numbers);
        }
        permute(id, order, &mut spare.ids);
        permute(refinement_level, order, &mut spare.levels);
        permute(newly_split, order, &mut spare.marks);
    }
}

/// An array of each kind, in which others are sorted.
#[derive(Default)]
pub(crate) struct Spare {
    numbers: Vec<f64>,
    ids: Vec<u32>,
    levels: Vec<u8>,
    marks: Vec<bool>,
    moments: Vec<KernelMoments>,
}

impl Spare {
    /// What they hold on to [bytes].
    pub fn bytes(&self) -> usize {
        let Spare { numbers, ids, levels, marks, moments } = self;
        of_vector(numbers) + of_vector(ids) + of_vector(levels) + of_vector(marks) + of_vector(moments)
    }
}

/// `array[k] ← array[order[k]]`, through `spare`; an empty array stays empty.
fn permute<T: Copy + Default + Send + Sync>(array: &mut Vec<T>, order: &[u32], spare: &mut Vec<T>) {
    if array.is_empty() {
        return;
    }
    spare.resize(order.len(), T::default());
    parallel::gather_into(spare, |k| array[order[k] as usize]);
    std::mem::swap(array, spare);
}

/// √h² [m], without the last digits of h²: particles of one size have one smoothing length, whatever rounding their areas have. Halves
/// of h² stay alike.
pub(crate) fn smoothing_length(squared: f64) -> f64 {
    const LAST_DIGITS: u64 = 1 << 12;
    f64::from_bits((squared.to_bits() + LAST_DIGITS / 2) & !(LAST_DIGITS - 1)).sqrt()
}

/// Smallest and largest of some numbers.
fn ends(values: &[f64]) -> [f64; 2] {
    values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &value| [low.min(value), high.max(value)])
}

/// How many of `now` lie within `far` of the span of `start`.
fn within(now: &[f64], start: &[f64], far: f64) -> usize {
    let [low, high] = ends(start);
    now.iter().filter(|&&value| low - far <= value && value <= high + far).count()
}
