//! Sums over lattices on which each particle has the volume 1.

use sph_core::Kernel;

/// A neighbour of the particle at the origin.
#[derive(Clone, Copy)]
pub(super) struct Neighbour {
    /// Where, in spacings.
    pub at: [f64; 2],
    /// F of ∇W = F r, in spacings to the power −4; never above zero.
    pub grad_factor: f64,
}

/// The neighbours on a square lattice within the support of a kernel with h = `ratio` spacings.
pub(super) fn neighbours(kernel: Kernel, ratio: f64) -> Vec<Neighbour> {
    let reach = (2.0 * ratio).ceil() as i32;
    let cells = (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| [f64::from(i), f64::from(j)]));
    cells
        .filter(|[x, y]| (x.hypot(*y) > 0.0) && x.hypot(*y) < 2.0 * ratio)
        .map(|at| Neighbour { at, grad_factor: kernel.gradient_factor(at[0].hypot(at[1]), ratio) })
        .collect()
}

/// −½ Σ r·∇W over the neighbours no more than `above` rows higher [-]: near 1 inside.
pub(super) fn kernel_sum(neighbours: &[Neighbour], above: f64) -> f64 {
    let below = neighbours.iter().filter(|n| n.at[1] <= above + 0.5);
    -0.5 * below.map(|n| n.grad_factor * (n.at[0] * n.at[0] + n.at[1] * n.at[1])).sum::<f64>()
}

/// What a hexagonal lattice of pairs holds more than one of single particles, Σ_pairs w − Σ w over all within the support
/// with w = W − W(2h): the energy whose gradient is the force under a uniform pressure (OP7) [1/spacing²].
pub(super) fn gain_of_pairs(kernel: Kernel, ratio: f64) -> f64 {
    2.0 * hexagonal(kernel, ratio, 2.0) - hexagonal(kernel, ratio, 1.0)
}

/// Σ W − W(2h) over a hexagonal lattice with an `area` for each site, itself included.
fn hexagonal(kernel: Kernel, ratio: f64, area: f64) -> f64 {
    let side = (2.0 * area / 3.0_f64.sqrt()).sqrt();
    let reach = (2.0 * ratio / side * 1.2).ceil() as i32;
    let edge = kernel.value(2.0 * ratio * (1.0 - f64::EPSILON), ratio);
    let sites = (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| [f64::from(i), f64::from(j)]));
    let distances = sites.map(|[i, j]| side * (i + 0.5 * j).hypot(0.75_f64.sqrt() * j));
    distances.filter(|&r| r < 2.0 * ratio).map(|r| kernel.value(r, ratio) - edge).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// THEORY WC5: 0.9974 with Wendland C2 at h/Δx = 1.5, 0.9992 at 2, C4: 0.9982 at 1.75.
    #[test]
    fn a_whole_lattice_is_the_quadrature_of_the_theory() {
        for (kernel, ratio, exact) in
            [(Kernel::WendlandC2, 1.5, 0.9974), (Kernel::WendlandC2, 2.0, 0.9992), (Kernel::WendlandC4, 1.75, 0.9982)]
        {
            let found = kernel_sum(&neighbours(kernel, ratio), f64::INFINITY);
            assert!((found - exact).abs() < 5e-5, "{kernel:?} at {ratio}: {found}");
        }
    }
}
