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
    /// Note positions [m], velocities [m/s] and allowances [m].
    pub fn reset(&mut self, x: &[f64], y: &[f64], velocity: Vec<[f32; 2]>, allowance: &[f64]) {
        self.velocity = velocity;
        self.origins = (0..x.len()).step_by(CHUNK).map(|k| [x[k], y[k]]).collect();
        let from_origin = |places: &[f64], axis: usize| {
            let mut near = vec![0.0; places.len()];
            parallel::gather_into(&mut near, |k| (places[k] - self.origins[k / CHUNK][axis]) as f32);
            near
        };
        (self.x, self.y) = (from_origin(x, 0), from_origin(y, 1));
        self.allowance = vec![0.0; x.len()];
        parallel::gather_into(&mut self.allowance, |k| {
            let origin = self.origins[k / CHUNK];
            let lost = |place: f64, axis: usize, kept: f32| (place - origin[axis] - f64::from(kept)).abs();
            let left = allowance[k] - lost(x[k], 0, self.x[k]) - lost(y[k], 1, self.y[k]);
            (left as f32).next_down()
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
