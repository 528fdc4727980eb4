//! Sums over a square lattice of spacing 1, on which each particle has the volume 1.

use sph_core::Kernel;

/// A neighbour of the particle at the origin.
#[derive(Clone, Copy)]
pub(super) struct Neighbour {
    /// Where, in spacings.
    pub at: [f64; 2],
    /// F of ∇W = F r, in spacings to the power −4; never above zero.
    pub slope: f64,
}

/// The neighbours within the support of a kernel with h = `ratio` spacings.
pub(super) fn neighbours(kernel: Kernel, ratio: f64) -> Vec<Neighbour> {
    let reach = (2.0 * ratio).ceil() as i32;
    let cells = (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| [f64::from(i), f64::from(j)]));
    cells
        .filter(|[x, y]| (x.hypot(*y) > 0.0) && x.hypot(*y) < 2.0 * ratio)
        .map(|at| Neighbour { at, slope: kernel.gradient_factor(at[0].hypot(at[1]), ratio) })
        .collect()
}

/// −½ Σ r·∇W over the neighbours no more than `above` rows higher [-]: near 1 inside.
pub(super) fn filling(neighbours: &[Neighbour], above: f64) -> f64 {
    let below = neighbours.iter().filter(|n| n.at[1] <= above + 0.5);
    -0.5 * below.map(|n| n.slope * (n.at[0] * n.at[0] + n.at[1] * n.at[1])).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// THEORY E6: 0.9974 with Wendland C2 at h/Δx = 1.5, 0.9992 at 2, C4: 0.9982 at 1.75.
    #[test]
    fn a_whole_lattice_is_the_quadrature_of_the_theory() {
        for (kernel, ratio, exact) in
            [(Kernel::WendlandC2, 1.5, 0.9974), (Kernel::WendlandC2, 2.0, 0.9992), (Kernel::WendlandC4, 1.75, 0.9982)]
        {
            let found = filling(&neighbours(kernel, ratio), f64::INFINITY);
            assert!((found - exact).abs() < 5e-5, "{kernel:?} at {ratio}: {found}");
        }
    }
}
