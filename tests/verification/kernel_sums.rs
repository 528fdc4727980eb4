//! Sums over a square lattice that have known limits (THEORY OP2, OP4, OP5).

use evidence::parameters::Parameters;
use evidence::statistics::Noise;
use sph_core::particles::{KernelMoments, SURFACE_LAMBDA, TENSIONLESS_KERNEL_SUM};
use sph_core::wcsph::eos::Tait;
use sph_core::{Kernel, Seed, Walls};

/// Spacing of the lattice [m].
const SPACING: f64 = 0.1;
/// Particles along a side of the block; odd, so that one sits in the middle.
const SIDE: usize = 21;

/// What the first pass finds around each particle of a square block, by (column, row).
fn moments(kernel: Kernel, disorder: f64) -> Vec<KernelMoments> {
    let eos = Tait { rho0: 1000.0, c0: 50.0, gamma: 7.0 };
    let parameters = Parameters { kernel, ..Parameters::usual(eos) };
    let mut noise = Noise::new(23);
    let seed = |k: usize, noise: &mut Noise| Seed {
        at: [k % SIDE, k / SIDE].map(|c| SPACING * (c as f64 + disorder * noise.draw())),
        velocity: [0.0; 2],
        area: SPACING * SPACING,
        pressure: 0.0,
    };
    let seeds: Vec<Seed> = (0..SIDE * SIDE).map(|k| seed(k, &mut noise)).collect();
    let mut fluid = parameters.fluid(&seeds);
    fluid.initialise(&mut Walls::default()).expect("a fluid at rest");
    let mut by_id = vec![KernelMoments::default(); SIDE * SIDE];
    for (k, &id) in fluid.particles().id.iter().enumerate() {
        by_id[id as usize] = fluid.fields().moments[k];
    }
    by_id
}

/// Rows and columns at least four from the edge have a full kernel of support 2h = 3 spacings.
fn interior() -> impl Iterator<Item = usize> {
    (4..SIDE - 4).flat_map(|j| (4..SIDE - 4).map(move |i| j * SIDE + i))
}

/// Inside a lattice ΣVW = 1, ΣV∇W = 0, and the renormalisation matrix is the unit matrix: λ = 1. At h/Δx = 1.5 the two
/// smooth kernels meet that to 1 %, the quadratic one to 5 %. The Gaussian is cut at 2h, where it jumps: gradients lose
/// the jump's share, 4e⁻⁴/(1 − e⁻⁴) = 7.5 %, and the lattice's rows that lie on the edge as many percent again.
#[test]
fn inside_a_lattice_space_is_filled_and_gradients_are_exact() {
    for (kernel, filling, lambda, gradient) in [
        (Kernel::WendlandC2, 0.01, [0.99, 1.01], 1e-12),
        (Kernel::CubicSpline, 0.01, [0.99, 1.01], 1e-12),
        (Kernel::Quadratic, 0.05, [0.95, 1.05], 1e-12),
        (Kernel::Gaussian, 0.02, [0.85, 0.99], 0.05),
    ] {
        let around = moments(kernel, 0.0);
        for k in interior() {
            let s = &around[k];
            assert!((s.kernel_sum - 1.0).abs() < filling, "{kernel:?}: ΣVW = {}", s.kernel_sum);
            assert!((lambda[0]..lambda[1]).contains(&f64::from(s.lambda)), "{kernel:?}: λ = {}", s.lambda);
            assert!(
                s.concentration_gradient().iter().all(|c| c.abs() * SPACING < gradient),
                "{kernel:?}: ΣV∇W = {:?}",
                s.concentration_gradient
            );
        }
    }
}

/// What a lattice's quadrature leaves of a pressure gradient at h/Δx = 1.5 (THEORY WC5): still water's pressure is higher
/// by as much. The sum by hand, over a lattice without end: −½ Σ Δx² r·∇W = 0.997399.
#[test]
fn a_lattice_gives_0_26_percent_too_little_gradient() {
    let around = moments(Kernel::WendlandC2, 0.0);
    for k in interior() {
        assert!((f64::from(around[k].lambda) - 0.997_399).abs() < 1e-6, "λ = {}", around[k].lambda);
    }
}

/// A disorder of a tenth of a spacing leaves ΣVW and λ within a tenth: surface detection has room above λ = 0.7.
#[test]
fn a_disordered_interior_is_not_taken_for_a_surface() {
    let around = moments(Kernel::WendlandC2, 0.1);
    for k in interior() {
        assert!((around[k].kernel_sum - 1.0).abs() < 0.1, "ΣVW = {}", around[k].kernel_sum);
        assert!(around[k].lambda > SURFACE_LAMBDA + 0.15, "λ = {}", around[k].lambda);
    }
}

/// On a flat free surface and at a corner λ falls below 0.7 (Marrone et al. 2010); one layer further in it does not.
/// The surface layer is not yet spray.
#[test]
fn a_free_surface_is_the_outer_layer_and_nothing_else() {
    let around = moments(Kernel::WendlandC2, 0.0);
    let at = |i: usize, j: usize| &around[j * SIDE + i];
    let middle = SIDE / 2;
    for surface in [at(middle, SIDE - 1), at(0, middle), at(0, 0)] {
        assert!(surface.lambda < SURFACE_LAMBDA, "λ = {}", surface.lambda);
    }
    assert!(at(middle, SIDE - 2).lambda > SURFACE_LAMBDA, "second layer: λ = {}", at(middle, SIDE - 2).lambda);
    assert!(
        at(middle, SIDE - 1).fluid_kernel_sum() > TENSIONLESS_KERNEL_SUM,
        "top layer {}",
        at(middle, SIDE - 1).fluid_kernel_sum()
    );
}
