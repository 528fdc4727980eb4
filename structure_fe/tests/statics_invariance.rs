//! What must hold for any model: equilibrium, frame invariance, no force from rigid motion.

mod common;

use common::{LENGTH, MATERIAL, beam_at, section, supports, uniform};
use structure_fe::{Beam, Dof, Error, Loads, Section, Statics, Supports};

/// A portal frame with a diagonal, unequal elements, on a clamp, a hinge and a spring.
fn frame() -> (Beam, Supports, Loads) {
    let nodes = vec![[0.0, 0.0], [0.1, 1.0], [1.3, 1.2], [1.2, -0.1], [2.0, 0.8]];
    let connectivity = [[0, 1], [1, 2], [2, 3], [0, 2], [2, 4]];
    let beam = Beam::uniform(nodes, &connectivity, MATERIAL, section()).unwrap();
    let mut supports = Supports::default();
    supports.clamp(0).pin(3).spring(4, Dof::W, 3e5);
    let mut loads = Loads::default();
    loads
        .at_node(1, [700.0, -300.0, 40.0])
        .along_element(1, [0.0, -900.0], [100.0, -1500.0])
        .along_element(3, [250.0, 60.0], [-80.0, 0.0])
        .along_element(4, [0.0, -400.0], [0.0, -200.0]);
    (beam, supports, loads)
}

/// Sums of `[F_x, F_y, M about the origin]`.
fn resultant(nodes: &[[f64; 2]], forces: &[[f64; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for ([x, y], [fx, fy, m]) in nodes.iter().zip(forces) {
        sum[0] += fx;
        sum[1] += fy;
        sum[2] += m + x * fy - y * fx;
    }
    sum
}

#[test]
fn reactions_balance_the_loads() {
    let (beam, supports, loads) = frame();
    let nodes = beam.nodes().to_vec();
    let statics = Statics::new(beam, supports).unwrap();
    let solution = statics.solve(&loads).unwrap();

    // The resultant of the loads by hand: each linear load through its own centroid.
    let mut applied = resultant(&[nodes[1]], &[[700.0, -300.0, 40.0]]);
    for (element, start, end) in
        [(1, [0.0, -900.0], [100.0, -1500.0]), (3, [250.0, 60.0], [-80.0, 0.0]), (4, [0.0, -400.0], [0.0, -200.0])]
    {
        let [a, b] = statics.beam().elements()[element].nodes.map(|n| nodes[n]);
        let length = statics.beam().length(element);
        // A triangle of load acts at a third of the length from its high end.
        for (at, q) in [(1.0 / 3.0, start), (2.0 / 3.0, end)] {
            let point = [0, 1].map(|axis| a[axis] + at * (b[axis] - a[axis]));
            let half = q.map(|q: f64| 0.5 * q * length);
            let part = resultant(&[point], &[[half[0], half[1], 0.0]]);
            for i in 0..3 {
                applied[i] += part[i];
            }
        }
    }
    let reactions = resultant(&nodes, &solution.reactions);
    for i in 0..3 {
        let error = (applied[i] + reactions[i]).abs();
        assert!(error < 1e-12 * 3000.0, "component {i}: {error}");
    }
    assert!(solution.reactions[4][1] > 0.0, "the spring pushes back");
    assert_eq!(solution.reactions[1], [0.0; 3], "no support, no reaction");
}

#[test]
fn section_forces_at_a_joint_balance_its_load() {
    let (beam, supports, loads) = frame();
    let statics = Statics::new(beam, supports).unwrap();
    let solution = statics.solve(&loads).unwrap();
    // Joint 1: the second end of element 0 and the first end of element 1.
    let mut sum = [700.0, -300.0, 40.0];
    for (element, end, sign) in [(0, 1, -1.0), (1, 0, 1.0)] {
        let [c, s] = statics.beam().tangent(element);
        let forces = solution.section_forces[element][end];
        sum[0] += sign * (c * forces.normal - s * forces.shear);
        sum[1] += sign * (s * forces.normal + c * forces.shear);
        sum[2] += sign * forces.moment;
    }
    for residual in sum {
        assert!(residual.abs() < 1e-11 * 3000.0, "{sum:?}");
    }
}

#[test]
fn a_beam_at_37_degrees_gives_the_rotated_answer() {
    let angle = 37_f64.to_radians();
    let (c, s) = (angle.cos(), angle.sin());
    let (along, across) = (900.0, -400.0);
    let solve = |angle: f64, load: [f64; 2]| {
        let beam = beam_at(angle, 4);
        let loads = uniform(&beam, load);
        let statics = Statics::new(beam, supports("clamped_pinned", 4)).unwrap();
        statics.solve(&loads).unwrap()
    };
    let straight = solve(0.0, [along, across]);
    let turned = solve(angle, [c * along - s * across, s * along + c * across]);

    let largest = |field: &[[f64; 3]]| field.as_flattened().iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    for (ours, reference) in [(&turned.displacement, &straight.displacement), (&turned.reactions, &straight.reactions)]
    {
        for (ours, &[x, y, rotation]) in ours.iter().zip(reference) {
            let expected = [c * x - s * y, s * x + c * y, rotation];
            for i in 0..3 {
                let error = (ours[i] - expected[i]).abs();
                assert!(error < 1e-12 * largest(reference), "{ours:?} against {expected:?}");
            }
        }
    }
    for (ours, reference) in turned.section_forces.iter().zip(&straight.section_forces) {
        for (ours, reference) in ours.iter().zip(reference) {
            let scale = 1e-12 * 1000.0 * LENGTH;
            assert!((ours.normal - reference.normal).abs() < scale);
            assert!((ours.shear - reference.shear).abs() < scale);
            assert!((ours.moment - reference.moment).abs() < scale);
        }
    }
}

#[test]
fn rigid_motion_costs_no_force_and_no_energy() {
    let (beam, _, _) = frame();
    let stiffness = section().axial_stiffness(&MATERIAL);
    for [u0, w0, turn] in [[0.3, -0.7, 0.0], [0.0, 0.0, 0.01], [-2.0, 1.0, 0.03]] {
        let motion: Vec<_> = beam.nodes().iter().map(|[x, y]| [u0 - turn * y, w0 + turn * x, turn]).collect();
        for force in beam.elastic_forces(&motion).as_flattened() {
            assert!(force.abs() < 1e-14 * stiffness, "{force} N of {stiffness} N");
        }
        assert!(beam.strain_energy(&motion) < 1e-28 * stiffness);
    }
}

#[test]
fn elastic_forces_are_the_gradient_of_the_strain_energy() {
    let (beam, _, _) = frame();
    let u: Vec<[f64; 3]> =
        (0..5).map(|node| [0, 1, 2].map(|dof| (1.0 + 3.0 * node as f64 + dof as f64).sin())).collect();
    let forces = beam.elastic_forces(&u);
    let scale = forces.as_flattened().iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    for node in 0..5 {
        for dof in 0..3 {
            // The energy is quadratic, so the central difference is exact but for rounding.
            let energy = |step: f64| {
                let mut u = u.clone();
                u[node][dof] += step;
                beam.strain_energy(&u)
            };
            let slope = (energy(0.5) - energy(-0.5)) / 1.0;
            assert!((slope - forces[node][dof]).abs() < 1e-12 * scale);
        }
    }
}

#[test]
fn a_refactorised_model_gives_the_same_bits_as_a_new_one() {
    let (beam, supports, loads) = frame();
    let connectivity: Vec<_> = beam.elements().iter().map(|element| element.nodes).collect();
    let nodes = beam.nodes().iter().map(|[x, y]| [1.1 * x, y - 0.2 * x]).collect();
    let thicker = Beam::uniform(nodes, &connectivity, MATERIAL, Section::strip(0.03)).unwrap();

    let mut statics = Statics::new(beam, supports.clone()).unwrap();
    let before = statics.solve(&loads).unwrap();
    statics.refactorise(thicker.clone()).unwrap();
    let after = statics.solve(&loads).unwrap();
    assert_ne!(before, after);
    assert_eq!(after, Statics::new(thicker, supports).unwrap().solve(&loads).unwrap());

    // The frame's elements 0 to 2 join the same nodes as those of a straight beam; it has 5.
    for (elements, differs) in [(2, 2), (4, 3)] {
        let error = statics.refactorise(beam_at(0.0, elements)).unwrap_err();
        assert_eq!(error, Error::OtherConnectivity { element: differs });
    }
    assert_eq!(statics.solve(&loads).unwrap(), after, "an error changes nothing");
}
