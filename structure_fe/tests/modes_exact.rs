//! Natural modes against the exact roots of the Euler-Bernoulli beam.

mod common;

use approx::assert_relative_eq;
use common::{LENGTH, MATERIAL, beam, beam_at, bending_stiffness, number, section, supports, table};
use structure_fe::{Beam, Dof, Mode, Section, Supports, natural_modes};

/// omega = (kL)^2 sqrt(EI/(rho A L^4)).
fn exact_frequency(root: f64) -> f64 {
    (root / LENGTH).powi(2) * (bending_stiffness() / section().mass_per_length(&MATERIAL)).sqrt()
}

/// Relative errors of the first three frequencies against the roots of `case`.
fn errors(case: &str, roots: &str, elements: usize) -> [f64; 3] {
    let held = match case {
        "free" => Supports::default(),
        name => supports(name, elements),
    };
    let rigid = if case == "free" { 3 } else { 0 };
    let modes = natural_modes(&beam(elements), &held, rigid + 3).unwrap();
    let table = table("beam_frequency_roots");
    [0, 1, 2].map(|mode| {
        let exact = exact_frequency(number(&table[mode], roots));
        modes[rigid + mode].angular_frequency / exact - 1.0
    })
}

/// The frequencies are upper bounds, and converge as (kL/elements)^4/1440 to leading order whatever
/// the supports: a cubic w leaves h^4/720 times the mean square of w'''' = k^4 w in that of w''.
#[test]
fn frequencies_converge_to_the_exact_roots_with_order_four() {
    let table = table("beam_frequency_roots");
    // A free beam has the roots of a clamped one, and corrections of higher order that are larger.
    for (case, roots, elements) in [
        ("cantilever", "cantilever", 8),
        ("simply_supported", "simply_supported", 8),
        ("clamped_clamped", "clamped_clamped", 8),
        ("clamped_pinned", "clamped_pinned", 8),
        ("free", "clamped_clamped", 16),
    ] {
        let coarse = errors(case, roots, elements);
        let fine = errors(case, roots, 2 * elements);
        for mode in 0..3 {
            let root = number(&table[mode], roots);
            let leading = (root / (2 * elements) as f64).powi(4) / 1440.0;
            let order = (coarse[mode] / fine[mode]).log2();
            let said = format!(
                "{case} mode {}: {:.3e}, then {:.3e} (leading term {leading:.3e}), order {order:.3}",
                mode + 1,
                coarse[mode],
                fine[mode],
            );
            println!("{said}");
            assert!((order - 4.0).abs() < 0.08, "{said}");
            assert!((fine[mode] / leading - 1.0).abs() < 0.03, "{said}");
        }
    }
}

/// Rounding shows in fine meshes: reducing by the factor of M instead of K + sigma M errs by 2e-4 here.
#[test]
fn a_fine_mesh_keeps_the_nine_digits_of_the_table() {
    for elements in [100, 150] {
        let error = errors("cantilever", "cantilever", elements)[0];
        println!("{elements} elements: {error:e}");
        assert!(error.abs() < 3e-9, "{elements} elements: {error:e}");
    }
}

fn inner_product(beam: &Beam, energy: fn(&Beam, &[[f64; 3]]) -> f64, a: &Mode, b: &Mode) -> f64 {
    let sum: Vec<_> = a.shape.iter().zip(&b.shape).map(|(a, b)| [0, 1, 2].map(|dof| a[dof] + b[dof])).collect();
    energy(beam, &sum) - energy(beam, &a.shape) - energy(beam, &b.shape)
}

#[test]
fn shapes_are_orthonormal_in_mass_and_orthogonal_in_stiffness() {
    let beam = beam_at(0.6, 6);
    let modes = natural_modes(&beam, &supports("clamped_pinned", 6), usize::MAX).unwrap();
    assert_eq!(modes.len(), 7 * 3 - 5);
    assert!(modes.is_sorted_by_key(|mode| mode.angular_frequency));
    for (i, a) in modes.iter().enumerate() {
        assert_eq!(a.shape[0], [0.0; 3], "the clamp does not move");
        assert_relative_eq!(2.0 * beam.kinetic_energy(&a.shape), 1.0, max_relative = 1e-12);
        for b in &modes[..i] {
            let mass = inner_product(&beam, Beam::kinetic_energy, a, b);
            assert!(mass.abs() < 1e-10, "mass product {mass}");
            let stiffness = inner_product(&beam, Beam::strain_energy, a, b);
            let scale = a.angular_frequency.powi(2).max(b.angular_frequency.powi(2));
            assert!(stiffness.abs() < 1e-10 * scale, "stiffness product {stiffness}");
        }
    }
}

/// A free beam: three rigid motions at zero frequency, to rounding, whatever the mesh.
#[test]
fn a_free_beam_has_three_rigid_modes() {
    let root = number(&table("beam_frequency_roots")[0], "clamped_clamped");
    for elements in [10, 100] {
        let modes = natural_modes(&beam_at(1.0, elements), &Supports::default(), 4).unwrap();
        for mode in &modes[..3] {
            let ratio = mode.angular_frequency / exact_frequency(root);
            println!("{elements} elements: {ratio:e}");
            assert!(ratio < 1e-9, "{elements} elements: {ratio:e}");
        }
        let bending = modes[3].angular_frequency;
        assert_relative_eq!(bending, exact_frequency(root), max_relative = 1e-4);
    }
}

/// Fixed-free bar: omega_1 = pi/(2 L) sqrt(E/rho); linear elements err by (kL/elements)^2/24.
#[test]
fn the_axial_mode_of_a_bar_has_its_exact_frequency() {
    let elements = 20;
    let bar = Section::rectangular(0.02, 0.1);
    let beam = Beam::straight([0.0, 0.0], [0.0, LENGTH], elements, MATERIAL, bar).unwrap();
    let mut guided = Supports::default();
    guided.clamp(0);
    for node in 1..=elements {
        guided.fix(node, Dof::U).fix(node, Dof::Theta);
    }
    let mode = &natural_modes(&beam, &guided, 1).unwrap()[0];
    let root = std::f64::consts::FRAC_PI_2;
    let exact = root / LENGTH * (MATERIAL.youngs_modulus / MATERIAL.density).sqrt();
    let error = mode.angular_frequency / exact - 1.0;
    let leading = (root / elements as f64).powi(2) / 24.0;
    assert_relative_eq!(error, leading, max_relative = 0.01);
}

/// A stiff short beam on a soft spring moves as one mass: omega = sqrt(k/m).
#[test]
fn a_body_on_a_spring_oscillates_at_the_root_of_stiffness_over_mass() {
    let beam = Beam::straight([0.0, 0.0], [0.2, 0.0], 2, MATERIAL, Section::strip(0.1)).unwrap();
    let mut guided = Supports::default();
    for node in 0..3 {
        guided.fix(node, Dof::U).fix(node, Dof::Theta);
    }
    guided.spring(1, Dof::W, 100.0);
    let mode = &natural_modes(&beam, &guided, 1).unwrap()[0];
    assert_relative_eq!(mode.angular_frequency, (100.0 / beam.mass()).sqrt(), max_relative = 1e-6);
}

/// Rigid velocities: m v^2/2 along any axis, m L^2 omega^2/6 about an end.
#[test]
fn rigid_motion_has_the_kinetic_energy_of_a_rod() {
    let beam = beam_at(0.4, 5);
    let mass = section().mass_per_length(&MATERIAL) * LENGTH;
    assert_relative_eq!(beam.mass(), mass, max_relative = 1e-14);
    let translation = vec![[3.0, -4.0, 0.0]; 6];
    assert_relative_eq!(beam.kinetic_energy(&translation), 12.5 * mass, max_relative = 1e-13);
    let rotation: Vec<_> = beam.nodes().iter().map(|[x, y]| [-2.0 * y, 2.0 * x, 2.0]).collect();
    let exact = mass * LENGTH.powi(2) * 4.0 / 6.0;
    assert_relative_eq!(beam.kinetic_energy(&rotation), exact, max_relative = 1e-13);
}
