//! How far particles may go astray before their neighbour lists are to be remade.

use serde::{Deserialize, Serialize};

use crate::memory::of_vector;
use crate::parallel::{self, CHUNK};

/// Where particles were when the lists were made, at what velocity they are expected to move on, and how far each may be from
/// there before the lists must be remade. Places are kept from the first of each chunk on, rounded; what rounding takes is taken
/// off the allowance.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Skin {
    origins: Vec<[f64; 2]>,
    x: Vec<f32>,
    y: Vec<f32>,
    velocity: Vec<[f32; 2]>,
    allowance: Vec<f32>,
}

impl Skin {
    /// Note positions [m]; velocity [m/s] and allowance [m] of each.
    pub fn reset(
        &mut self,
        x: &[f64],
        y: &[f64],
        velocity: impl Fn(usize) -> [f32; 2] + Sync,
        allowance: impl Fn(usize) -> f64 + Sync,
    ) {
        let Skin { origins, x: from_x, y: from_y, velocity: velocities, allowance: allowances } = self;
        origins.clear();
        origins.extend((0..x.len()).step_by(CHUNK).map(|k| [x[k], y[k]]));
        for numbers in [&mut *from_x, from_y, allowances] {
            resize(numbers, x.len());
        }
        resize(velocities, x.len());
        parallel::gather_into(velocities, velocity);
        parallel::each([from_x, from_y, allowances], |at, [from_x, from_y, allowances]| {
            let from = |place: f64, origin: f64| (place - origin) as f32;
            let lost = |place: f64, origin: f64, kept: f32| (place - origin - f64::from(kept)).abs();
            for k in 0..from_x.len() {
                let i = at.start + k;
                let [x0, y0] = origins[i / CHUNK];
                (from_x[k], from_y[k]) = (from(x[i], x0), from(y[i], y0));
                let left = allowance(i) - lost(x[i], x0, from_x[k]) - lost(y[i], y0, from_y[k]);
                allowances[k] = (left as f32).next_down();
            }
        });
    }

    /// What it holds on to [bytes].
    pub(crate) fn bytes(&self) -> usize {
        of_vector(&self.origins)
            + of_vector(&self.velocity)
            + [&self.x, &self.y, &self.allowance].map(of_vector).iter().sum::<usize>()
    }

    /// True if no particle is farther than its allowance from where its velocity takes it in `age` [s].
    pub fn holds(&self, x: &[f64], y: &[f64], age: f64) -> bool {
        self.x.len() == x.len()
            && parallel::every_chunk(x.len(), |targets| {
                let [x0, y0] = self.origins[targets.start / CHUNK];
                let (x, y) = (&x[targets.clone()], &y[targets.clone()]);
                let (from_x, from_y) = (&self.x[targets.clone()], &self.y[targets.clone()]);
                let (velocity, allowance) = (&self.velocity[targets.clone()], &self.allowance[targets]);
                (0..x.len()).fold(true, |all, k| {
                    let [u, v] = velocity[k].map(f64::from);
                    let (dx, dy) =
                        (x[k] - x0 - f64::from(from_x[k]) - age * u, y[k] - y0 - f64::from(from_y[k]) - age * v);
                    let allowed = f64::from(allowance[k]);
                    all & (dx * dx + dy * dy <= allowed * allowed) & (allowed >= 0.0)
                })
            })
    }
}

/// As many entries as that, with room for no more.
fn resize<T: Clone + Default>(numbers: &mut Vec<T>, n: usize) {
    numbers.reserve_exact(n.saturating_sub(numbers.len()));
    numbers.resize(n, T::default());
}
