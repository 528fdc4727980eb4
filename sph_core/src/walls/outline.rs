//! What boundary particles stand for of closed outlines, and the exact force of a pressure on these (THEORY PR19, WC29).

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::Walls;

/// The part of a closed outline that a boundary particle stands for (THEORY PR19), in the frame of its normal and of the normal turned by
/// +90°.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OutlineShare {
    /// a = ∫n ds [m].
    pub area: [f64; 2],
    /// ∫(r − s)⊗n ds about the surface s above the particle [m²].
    pub moment: [[f64; 2]; 2],
}

impl OutlineShare {
    /// ∫P n ds [N/m] of a pressure that is linear along the share: `pressure` [Pa] at the surface above the particle, whose normal is given,
    /// with `gradient` [Pa/m].
    pub(crate) fn integral(&self, [nx, ny]: [f64; 2], pressure: f64, [gx, gy]: [f64; 2]) -> [f64; 2] {
        let OutlineShare { area, moment } = self;
        let slope = [gx * nx + gy * ny, gy * nx - gx * ny];
        let [along, across] = [0, 1].map(|b| pressure * area[b] + slope[0] * moment[0][b] + slope[1] * moment[1][b]);
        [along * nx - across * ny, along * ny + across * nx]
    }

    /// ∫(r − r_w)×n ds [m²] about the particle, `depth` [m] below the surface.
    pub(crate) fn couple(&self, depth: f64) -> f64 {
        self.moment[0][1] - self.moment[1][0] + depth * self.area[1]
    }
}

/// The owners that have a closed outline.
pub(crate) fn closed_owners(walls: &Walls) -> impl Iterator<Item = Range<usize>> + '_ {
    let has_outline =
        |owner: &&Range<usize>| walls.outline[(*owner).clone()].iter().any(|share| share.area != [0.0; 2]);
    walls.owners.iter().filter(has_outline).cloned()
}

/// Smallest mean square of arms over the largest, of places that can turn a body [-]: that of one place alone is rounding.
const LEAST_SPREAD: f64 = 1e-12;

/// Forces [N/m] at places [m], by weight, that turn with the moment `couple` [N] and have no resultant: those of a rigid rotation.
pub(crate) fn turning_forces(places: &[([f64; 2], f64)], couple: f64) -> Vec<[f64; 2]> {
    let sum: f64 = places.iter().map(|(_, w)| w).sum();
    if sum <= 0.0 {
        return vec![[0.0; 2]; places.len()];
    }
    let middle = [0, 1].map(|i| places.iter().map(|(at, w)| w * at[i]).sum::<f64>() / sum);
    let arm = |at: &[f64; 2]| [at[0] - middle[0], at[1] - middle[1]];
    let square = |at: &[f64; 2]| arm(at).iter().map(|d| d * d).sum::<f64>();
    let inertia: f64 = places.iter().map(|(at, w)| w * square(at)).sum();
    let largest = places.iter().map(|(at, _)| square(at)).fold(0.0, f64::max);
    let turn = if inertia > LEAST_SPREAD * sum * largest { couple / inertia } else { 0.0 };
    places.iter().map(|(at, w)| (arm(at), w)).map(|([x, y], w)| [-turn * w * y, turn * w * x]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_forces_turn_and_do_not_push() {
        let places = [([0.0, 0.0], 1.0), ([2.0, 0.5], 2.0), ([1.0, -1.0], 0.5), ([9.0, 9.0], 0.0)];
        let forces = turning_forces(&places, 3.0);
        let sum = forces.iter().fold([0.0; 2], |[x, y], f| [x + f[0], y + f[1]]);
        let moment: f64 = places.iter().zip(&forces).map(|((at, _), f)| at[0] * f[1] - at[1] * f[0]).sum();
        assert_eq!(turning_forces(&[([1.0, 2.0], 0.0)], 3.0), [[0.0; 2]]);
        for weight in [0.1, 0.3, 0.7] {
            let alone = [([0.1, 0.7], weight), ([0.3, 0.2], 0.0)];
            assert_eq!(turning_forces(&alone, 3.0), [[0.0; 2]; 2], "one wet place turns nothing");
        }
        assert!(sum.iter().all(|f| f.abs() < 1e-14) && (moment - 3.0).abs() < 1e-14, "{sum:?}, {moment}");
    }
}
