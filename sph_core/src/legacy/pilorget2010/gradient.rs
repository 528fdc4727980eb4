//! The corrector's gradient (THEORY LE26).

use crate::legacy::pilorget2010::cast::Cast;
use crate::legacy::pilorget2010::pairs::Pairs;

/// ∇P_i/ρ_i [m/s²] of row `i`: (1/ρ_i²) Σ m_j (P_j − P_i) ∇W_ij.
pub(crate) fn inside(cast: &Cast, pairs: &Pairs, pressure: &[f64], density: f64, i: usize) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for pair in pairs.of(i) {
        let other = &cast.players[pair.j as usize];
        let difference = other.mass * (other.sign * pressure[other.row as usize] - pressure[i]) * pair.grad_factor;
        sum = [0, 1].map(|axis| sum[axis] + difference * pair.r[axis]);
    }
    sum.map(|s| s / (density * density))
}

/// LE25: the same of a particle at the surface, whose own neighbours are mirrored at the plane through it with normal `n`:
/// 2 n n·∇P/ρ.
pub(crate) fn at_surface(
    cast: &Cast,
    pairs: &Pairs,
    pressure: &[f64],
    density: f64,
    i: usize,
    n: [f64; 2],
) -> [f64; 2] {
    let mut sum = 0.0;
    for pair in pairs.of(i) {
        let other = &cast.players[pair.j as usize];
        if other.counts {
            let along = pair.r[0] * n[0] + pair.r[1] * n[1];
            sum += 2.0 * other.mass * other.sign * pressure[other.row as usize] * pair.grad_factor * along;
        }
    }
    n.map(|c| c * sum / (density * density))
}

/// LE26: Σ W_ij/|Σ (y_i − y_j) ∂W_ij/∂y| [-], y along `up`.
pub(crate) fn correction(pairs: &Pairs, i: usize, up: [f64; 2]) -> f64 {
    let (mut filling, mut grad_factor) = (pairs.own[i], 0.0);
    for pair in pairs.of(i) {
        let height = pair.r[0] * up[0] + pair.r[1] * up[1];
        filling += pair.w;
        grad_factor += pair.grad_factor * height * height;
    }
    if grad_factor == 0.0 { 1.0 } else { filling / grad_factor.abs() }
}
