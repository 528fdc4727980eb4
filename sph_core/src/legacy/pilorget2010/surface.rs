//! The free surface: who is in it, and the dummies that it mirrors (THEORY LE23, LE25).

use crate::legacy::pilorget2010::cast::{Cast, Reflection};
use crate::legacy::pilorget2010::pairs::Pairs;

/// A player lower below the surface than this share of h has a mirror image.
const LOWER: f64 = 0.1;

/// −∇·r_i = −(1/ρ₀) Σ m_j r_ij·∇W_ij [-] (LE23): 2 inside.
pub(crate) fn divergence_of_place(cast: &Cast, pairs: &Pairs, i: usize, rho0: f64) -> f64 {
    let sum = pairs.of(i).iter().filter(|pair| cast.players[pair.j as usize].counts).map(|pair| {
        let r2 = pair.r[0] * pair.r[0] + pair.r[1] * pair.r[1];
        -cast.players[pair.j as usize].mass * pair.grad_factor * r2
    });
    sum.sum::<f64>() / rho0
}

/// LE23: rows whose ∇·r is below `ratio` times that inside.
pub(crate) fn find(cast: &Cast, pairs: &Pairs, rho0: f64, least: f64) -> Vec<bool> {
    (0..cast.rows).map(|i| divergence_of_place(cast, pairs, i, rho0) < least).collect()
}

/// Unit normal out of the fluid, against Σ m ∇W.
pub(crate) fn normal(cast: &Cast, pairs: &Pairs, i: usize) -> Option<[f64; 2]> {
    let mut sum = [0.0; 2];
    for pair in pairs.of(i).iter().filter(|pair| cast.players[pair.j as usize].counts) {
        for axis in 0..2 {
            sum[axis] -= cast.players[pair.j as usize].mass * pair.grad_factor * pair.r[axis];
        }
    }
    let length = sum[0].hypot(sum[1]);
    (length > 0.0).then(|| sum.map(|c| c / length))
}

/// LE25: all particles below the surface, as mirrored by the nearest surface particle that touches water; `fluid` rows are water.
pub(crate) fn reflections(cast: &Cast, pairs: &Pairs, at_surface: &[bool], fluid: usize) -> Vec<Reflection> {
    let mut nearest: Vec<Option<(f64, Reflection)>> = vec![None; cast.own];
    for s in (0..cast.rows).filter(|&s| at_surface[s]) {
        let wet = s < fluid || pairs.of(s).iter().any(|pair| (pair.j as usize) < fluid);
        let (true, Some(n)) = (wet, normal(cast, pairs, s)) else { continue };
        for pair in pairs.of(s) {
            let j = pair.j as usize;
            let below = pair.r[0] * n[0] + pair.r[1] * n[1] > LOWER * cast.players[s].h;
            if j >= cast.own || !below || (j < cast.rows && at_surface[j]) {
                continue;
            }
            let away = pair.r[0] * pair.r[0] + pair.r[1] * pair.r[1];
            if nearest[j].is_none_or(|(least, _)| away < least * (1.0 - 1e-9)) {
                nearest[j] = Some((away, Reflection { player: pair.j, surface: s as u32, n }));
            }
        }
    }
    nearest.into_iter().flatten().map(|(_, reflection)| reflection).collect()
}
