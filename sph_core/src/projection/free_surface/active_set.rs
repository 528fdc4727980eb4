//! The unilateral condition at the free surface: rows that have no tension, and air that comes in under tension (THEORY PR8).

use serde::{Deserialize, Serialize};

use crate::neighbours::Neighbours;
use crate::projection::linear_solver::cluster_matrix::ClusterMatrix;
use crate::projection::linear_solver::matrix::MatrixRows;

/// What a row leaves of the equation needs a further solve from this share of the strongest source on [-].
const WORTH: f64 = 1e-3;

/// Rows that were constrained in this number of steps start constrained in the next.
const LASTING: u8 = 2;

/// PR8: the rows that are held at p = 0, since they have no tension.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct ActiveSet {
    /// Rows held at p = 0.
    pub constrained: Vec<bool>,
    /// How many they are.
    pub count: usize,
    /// Rows that have no tension, as found so far in this step.
    tensionless: Vec<bool>,
    /// For how many steps each particle's row has been constrained, by identity.
    duration: Vec<u8>,
}

/// The pressure equation as the active set reads it.
pub(crate) struct Rows<'a> {
    pub matrix: ClusterMatrix<'a>,
    pub source: &'a [f64],
    pub scale: &'a [f64],
}

impl Rows<'_> {
    /// Residual of row `k` over its scale (LS4) [-]: by how much it would be over-filled without pressure.
    fn residual(&self, k: usize, pressure: &[f64]) -> f64 {
        (self.source[k] - self.matrix.times(k, pressure)) / self.scale[k]
    }
}

/// The free surface as the active set reads it.
#[derive(Clone, Copy)]
pub(crate) struct Surface<'a> {
    /// 1 beside air, 0 far from it [-].
    pub indicator: &'a [f64],
    pub neighbours: &'a Neighbours,
    /// Air comes in under tension.
    pub ventilated: bool,
}

impl ActiveSet {
    /// Every row may be under tension.
    pub fn clear(&mut self, n: usize) {
        for rows in [&mut self.constrained, &mut self.tensionless] {
            rows.clear();
            rows.resize(n, false);
        }
        self.count = 0;
    }

    /// PR8, warm start: a row near air, or any row where air comes in, that was constrained in the last two steps starts constrained,
    /// unless the water would press there under pressures `pressure` [Pa].
    pub fn warm_start(&mut self, pressure: &mut [f64], id: &[u32], rows: &Rows, surface: Surface) {
        self.clear(pressure.len());
        self.duration.resize(id.len(), 0);
        for (k, p) in pressure.iter_mut().enumerate() {
            let exposed = surface.indicator[k] > 0.0 || surface.ventilated;
            if self.duration[id[k] as usize] >= LASTING && exposed {
                self.constrained[k] = true;
                *p = 0.0;
            }
        }
        self.count = self.constrained.iter().filter(|&&constrained| constrained).count();
        self.release(pressure, rows, 0.0);
    }

    /// Release constrained rows whose residual exceeds `limit`; returns how many they are.
    fn release(&mut self, pressure: &[f64], rows: &Rows, limit: f64) -> usize {
        let before = self.count;
        if before == 0 {
            return 0;
        }
        for k in 0..pressure.len() {
            if self.constrained[k] && rows.residual(k, pressure) > limit {
                self.constrained[k] = false;
                self.count -= 1;
            }
        }
        before - self.count
    }

    /// Store which rows are constrained now, for the next warm start.
    pub fn store(&mut self, id: &[u32]) {
        for (k, &i) in id.iter().enumerate() {
            let duration = &mut self.duration[i as usize];
            *duration = if self.constrained[k] { duration.saturating_add(1) } else { 0 };
        }
    }

    /// PR8: constrain the rows under tension that may have none; returns the new ones, and their tension [Pa].
    pub fn constrain(&mut self, pressure: &mut [f64], surface: Surface) -> Vec<(usize, f64)> {
        self.find_tensionless(pressure, surface);
        self.hold(pressure)
    }

    /// Constrain the rows under tension among those found to have none; returns the new ones, and their tension [Pa].
    fn hold(&mut self, pressure: &mut [f64]) -> Vec<(usize, f64)> {
        let mut new = Vec::new();
        for (k, p) in pressure.iter_mut().enumerate() {
            if *p < 0.0 && self.tensionless[k] && !self.constrained[k] {
                self.constrained[k] = true;
                new.push((k, -*p));
                *p = 0.0;
            }
        }
        self.count += new.len();
        new
    }

    /// PR8: release rows with a positive residual and rows that no chain reaches, constrain rows under tension; returns whether
    /// what that leaves of the equation needs a further solve.
    pub fn update(&mut self, pressure: &mut [f64], rows: &Rows, surface: Surface) -> bool {
        let mut released = self.release(pressure, rows, WORTH);
        self.find_tensionless(pressure, surface);
        released += self.release_unreached();
        let new = self.hold(pressure);
        let left = |&(k, tension): &(usize, f64)| rows.matrix.diagonal()[k] * tension / rows.scale[k];
        released > 0 || new.iter().map(left).any(|left| left > WORTH)
    }

    /// Release rows that were warm-started and that air does not reach now; returns how many they are.
    fn release_unreached(&mut self) -> usize {
        let before = self.count;
        for (constrained, &tensionless) in self.constrained.iter_mut().zip(&self.tensionless) {
            if *constrained && !tensionless {
                *constrained = false;
                self.count -= 1;
            }
        }
        before - self.count
    }

    /// PR8: rows near air and, where air comes in, rows that a chain of rows under tension connects to one of those. From round to
    /// round of a step rows are added, not removed: then the rounds end.
    fn find_tensionless(&mut self, pressure: &[f64], surface: Surface) {
        let (neighbours, n) = (surface.neighbours, pressure.len());
        let ActiveSet { tensionless, constrained, .. } = self;
        for (tensionless, &indicator) in tensionless.iter_mut().zip(surface.indicator) {
            *tensionless |= indicator > 0.0;
        }
        if !surface.ventilated {
            return;
        }
        let mut reached: Vec<usize> = (0..n).filter(|&k| tensionless[k]).collect();
        while let Some(k) = reached.pop() {
            for j in neighbours.fluid.of(k) {
                let j = neighbours.source(j, n);
                if !tensionless[j] && (constrained[j] || pressure[j] < 0.0) {
                    tensionless[j] = true;
                    reached.push(j);
                }
            }
        }
    }
}
