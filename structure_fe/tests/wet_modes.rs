//! Modes of a plate in water, by added masses between nodes.

mod common;

use common::{beam, body_with_panel, supports};
use structure_fe::{AddedMass, Error, Material, natural_modes, wet_modes};

/// Added mass that is mu times the plate's own divides every frequency by sqrt(1 + mu), exactly: the blocks are mu
/// times the consistent masses of the elements, in one block over all nodes.
#[test]
fn proportional_added_mass_divides_frequencies_by_the_root_of_one_plus_mu() {
    let elements = 8;
    let (plate, held) = (beam(elements), supports("clamped_clamped", elements));
    let dry = natural_modes(&plate, &held, 6).unwrap();
    // Of kinetic energies: M_ij = T(e_i + e_j) - T(e_i) - T(e_j).
    let width = 3 * (elements + 1);
    let energy = |places: &[usize]| {
        let mut v = vec![[0.0; 3]; elements + 1];
        for &place in places {
            v[place / 3][place % 3] += 1.0;
        }
        plate.kinetic_energy(&v)
    };
    let mass = |i: usize, j: usize| energy(&[i, j]) - energy(&[i]) - energy(&[j]);
    for mu in [0.5, 10.0] {
        let block = (0..width * width).map(|k| mu * mass(k / width, k % width)).collect();
        let added = AddedMass { nodes: (0..=elements).collect(), block };
        let wet = wet_modes(&plate, &held, 6, &[added]).unwrap();
        for (wet, dry) in wet.iter().zip(&dry) {
            let error = wet.angular_frequency / dry.angular_frequency * (1.0 + mu).sqrt() - 1.0;
            assert!(error.abs() < 1e-9, "mu = {mu}: {error:e}");
        }
    }
}

/// A point mass as a block at a node, also one that is tied to a body, is the point mass.
#[test]
fn a_block_at_a_node_is_a_point_mass() {
    let metal = Material { youngs_modulus: 70e9, poissons_ratio: 0.33, density: 2700.0 };
    let (model, held, _) = body_with_panel(metal, 0.01, 8);
    for node in [0, 5] {
        let with_point = model.clone().with_point_mass(node, 7.0, 0.2).unwrap();
        let point = natural_modes(&with_point, &held, 6).unwrap();
        // Unsymmetric, with the same mean.
        let block = vec![7.0, 3.0, 0.0, -3.0, 7.0, 0.0, 0.0, 0.0, 0.2];
        let wet = wet_modes(&model, &held, 6, &[AddedMass { nodes: vec![node], block }]).unwrap();
        for (wet, point) in wet.iter().zip(&point).skip(3) {
            let error = wet.angular_frequency / point.angular_frequency - 1.0;
            assert!(error.abs() < 1e-8, "node {node}: {error:e}");
        }
    }
    let short = AddedMass { nodes: vec![0, 1], block: vec![0.0; 9] };
    let error = wet_modes(&model, &held, 1, &[short]).unwrap_err();
    assert_eq!(error, Error::WrongLength { quantity: "a block of added mass", given: 9, expected: 36 });
    let far = AddedMass { nodes: vec![99], block: vec![0.0; 9] };
    assert!(matches!(wet_modes(&model, &held, 1, &[far]), Err(Error::NoSuchNode { item: "added mass", node: 99, .. })));
}
