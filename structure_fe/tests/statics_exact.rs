//! Statics against exact solutions: the elements are exact at the nodes, for any number of them.

mod common;

use approx::assert_relative_eq;
use common::{LENGTH, MATERIAL, beam, beam_at, bending_stiffness, number, section, supports, table, uniform};
use structure_fe::{Beam, Dof, Element, Error, Loads, Material, Section, StaticSolution, Statics, Supports};

const LOAD: f64 = 120.0;

fn solve(beam: Beam, supports: Supports, loads: &Loads) -> StaticSolution {
    Statics::new(beam, supports).unwrap().solve(loads).unwrap()
}

fn force_at(node: usize, force: [f64; 3]) -> Loads {
    let mut loads = Loads::default();
    loads.at_node(node, force);
    loads
}

/// Each row of the table: our coefficient, the exact one, and how well the table states it (half a
/// unit of its last digit).
#[test]
fn every_row_of_the_table_of_small_deflections() {
    let ei = bending_stiffness();
    let (force, moment, load) = (LENGTH.powi(3) / ei, LENGTH.powi(2) / ei, LENGTH.powi(4) / ei);
    let rows = table("beam_static_small");
    assert_eq!(rows.len(), 9);
    for elements in [2, 8] {
        let (mid, end) = (elements / 2, elements);
        let deflection = |name: &str, loads: &Loads, node: usize| {
            solve(beam(elements), supports(name, end), loads).displacement[node][1]
        };
        let spread = uniform(&beam(elements), [0.0, LOAD]);
        for row in &rows {
            let (ours, exact, stated) = match (row["case"].as_str(), row["quantity"].as_str()) {
                ("cantilever tip load", "tip deflection") => {
                    let tip = force_at(end, [0.0, LOAD, 0.0]);
                    let w = deflection("cantilever", &tip, end);
                    (w / (LOAD * force), 1.0 / 3.0, 5e-10)
                }
                ("cantilever uniform load", "tip deflection") => {
                    let w = deflection("cantilever", &spread, end);
                    (w / (LOAD * load), 1.0 / 8.0, 5e-10)
                }
                ("cantilever end moment", "tip deflection") => {
                    let tip = force_at(end, [0.0, 0.0, LOAD]);
                    let w = deflection("cantilever", &tip, end);
                    (w / (LOAD * moment), 1.0 / 2.0, 5e-10)
                }
                ("simply supported uniform", "mid deflection") => {
                    let w = deflection("simply_supported", &spread, mid);
                    (w / (LOAD * load), 5.0 / 384.0, 5e-11)
                }
                ("clamped-clamped uniform", "mid deflection") => {
                    let w = deflection("clamped_clamped", &spread, mid);
                    (w / (LOAD * load), 1.0 / 384.0, 5e-12)
                }
                ("clamped-clamped uniform", "end moment") => {
                    let held = supports("clamped_clamped", end);
                    let solution = solve(beam(elements), held, &spread);
                    let moment = solution.section_forces[0][0].moment;
                    (moment / (LOAD * LENGTH.powi(2)), 1.0 / 12.0, 5e-11)
                }
                ("simply supported point mid", "mid deflection") => {
                    let point = force_at(mid, [0.0, LOAD, 0.0]);
                    let w = deflection("simply_supported", &point, mid);
                    (w / (LOAD * force), 1.0 / 48.0, 5e-11)
                }
                ("clamped-clamped point mid", "mid deflection") => {
                    let point = force_at(mid, [0.0, LOAD, 0.0]);
                    let w = deflection("clamped_clamped", &point, mid);
                    (w / (LOAD * force), 1.0 / 192.0, 5e-12)
                }
                ("clamped-pinned uniform", "max deflection at 0.5785 L from the clamp") => {
                    // w = q x^2 (L - x) (3 L - 2 x)/(48 EI) is largest where its slope vanishes.
                    let x = (15.0 - 33_f64.sqrt()) / 16.0;
                    assert!((x - 0.5785).abs() < 5e-5);
                    let exact = x.powi(2) * (1.0 - x) * (3.0 - 2.0 * x) / 48.0;
                    let nodes = vec![[0.0, 0.0], [x * LENGTH, 0.0], [LENGTH, 0.0]];
                    let beam = Beam::uniform(nodes, &[[0, 1], [1, 2]], MATERIAL, section());
                    let beam = beam.unwrap();
                    let spread = uniform(&beam, [0.0, LOAD]);
                    let solution = solve(beam, supports("clamped_pinned", 2), &spread);
                    let [_, w, slope] = solution.displacement[1];
                    assert!(slope.abs() * LENGTH < 1e-9 * w, "not at the maximum: {slope}");
                    // The table rounds 184.6 and then the quotient.
                    (w / (LOAD * load), exact, 2e-6)
                }
                (case, quantity) => panic!("no model for {case}, {quantity}"),
            };
            assert_relative_eq!(ours, exact, max_relative = 1e-9);
            let tabulated = number(row, "coefficient");
            assert!(
                (ours - tabulated).abs() <= stated,
                "{}, {}: {ours} against {tabulated}",
                row["case"],
                row["quantity"]
            );
        }
    }
}

/// Aluminium plate under a water column (Fourey et al. 2017): w = q L^4/(384 D), M = q L^2/12 and q L^2/24.
#[test]
fn hydrostatic_plate_has_the_tabulated_deflection_and_moments() {
    let (elements, mid) = (10, 5);
    let plate = Section::strip(0.05);
    for row in table("hydrostatic_plate") {
        let material = Material { youngs_modulus: 67.5e9, poissons_ratio: number(&row, "nu"), density: 2700.0 };
        assert_relative_eq!(plate.bending_stiffness(&material), number(&row, "D_Nm"), max_relative = 5e-9);
        let beam = Beam::straight([0.0, 0.0], [1.0, 0.0], elements, material, plate).unwrap();
        let weight = plate.mass_per_length(&material) * 9.81 * number(&row, "self_weight");
        let load = 1000.0 * 9.81 * 2.0 + weight;
        assert_relative_eq!(load, number(&row, "q_Pa"), max_relative = 1e-12);
        let loads = uniform(&beam, [0.0, -load]);
        let solution = solve(beam, supports("clamped_clamped", elements), &loads);
        let w = solution.displacement[mid][1];
        assert_relative_eq!(-w, number(&row, "w_mid_m"), max_relative = 5e-9);
        let clamp = solution.section_forces[0][0];
        let middle = solution.section_forces[mid][0];
        let (at_clamp, at_middle) = (number(&row, "M_clamp_Nm_per_m"), number(&row, "M_mid_Nm_per_m"));
        assert_relative_eq!(-clamp.moment, at_clamp, max_relative = 1e-9);
        assert_relative_eq!(middle.moment, at_middle, max_relative = 1e-9);
        // The load pushes down, so the top fibre is in tension at the clamp: 6 M/h^2.
        assert_relative_eq!(clamp.fibre_stress(&plate, 0.025), 6.0 * at_clamp / 0.05_f64.powi(2), max_relative = 1e-9);
        assert_relative_eq!(
            middle.fibre_stress(&plate, 0.025),
            -6.0 * at_middle / 0.05_f64.powi(2),
            max_relative = 1e-9
        );
    }
}

/// Cantilever under a load that grows from 0 at the clamp to q at the tip: w = 11 q L^4/(120 EI),
/// with the section forces of the part beyond each section.
#[test]
fn a_triangular_load_is_carried_exactly_along_the_whole_beam() {
    let (elements, length) = (5, LENGTH);
    let beam = beam(elements);
    let mut loads = Loads::default();
    let at = |node: usize| [0.0, LOAD * node as f64 / elements as f64];
    for element in 0..elements {
        // In two parts: loads on the same element add up.
        loads.along_element(element, at(element), [0.0; 2]).along_element(element, [0.0; 2], at(element + 1));
    }
    let solution = solve(beam, supports("cantilever", elements), &loads);
    let exact = 11.0 * LOAD * length.powi(4) / (120.0 * bending_stiffness());
    assert_relative_eq!(solution.displacement[elements][1], exact, max_relative = 1e-9);
    for (element, ends) in solution.section_forces.iter().enumerate() {
        for (end, forces) in ends.iter().enumerate() {
            let x = length * (element + end) as f64 / elements as f64;
            let shear = LOAD * (length.powi(2) - x.powi(2)) / (2.0 * length);
            let moment = LOAD * (2.0 * length.powi(3) - 3.0 * length.powi(2) * x + x.powi(3)) / (6.0 * length);
            assert_relative_eq!(forces.shear, shear, epsilon = 1e-9 * LOAD * length);
            assert_relative_eq!(forces.moment, moment, epsilon = 1e-9 * LOAD * length.powi(2));
            assert!(forces.normal.abs() < 1e-9 * LOAD);
        }
    }
}

/// A bar of two sections in series, pulled at its end and by its weight: u = sum of N L/(EA).
#[test]
fn a_stepped_bar_stretches_by_the_sum_of_its_parts() {
    let sections = [Section::rectangular(0.02, 0.03), Section::rectangular(0.01, 0.03)];
    let elements =
        [0, 1].map(|element| Element { nodes: [element, element + 1], material: MATERIAL, section: sections[element] });
    let nodes = vec![[0.0, 0.0], [0.4, 0.0], [1.0, 0.0]];
    let beam = Beam::new(nodes, elements.to_vec()).unwrap();
    let mut loads = uniform(&beam, [50.0, 0.0]);
    loads.at_node(2, [300.0, 0.0, 0.0]);
    let solution = solve(beam, supports("cantilever", 2), &loads);
    let e = MATERIAL.youngs_modulus;
    let mid = (300.0 + 50.0 * (0.6 + 0.2)) * 0.4 / (e * 0.02 * 0.03);
    let end = mid + (300.0 + 50.0 * 0.3) * 0.6 / (e * 0.01 * 0.03);
    assert_relative_eq!(solution.displacement[1][0], mid, max_relative = 1e-12);
    assert_relative_eq!(solution.displacement[2][0], end, max_relative = 1e-12);
    let root = solution.section_forces[0][0];
    assert_relative_eq!(root.normal, 350.0, max_relative = 1e-12);
    assert_relative_eq!(root.fibre_stress(&sections[0], 0.0), 350.0 / 6e-4, max_relative = 1e-12);
}

/// Cantilever propped by a spring k at its tip: the spring takes P/(1 + 3 EI/(k L^3)).
#[test]
fn a_spring_at_the_tip_takes_its_share() {
    let elements = 4;
    let k = 2.0 * bending_stiffness() / LENGTH.powi(3);
    let mut held = supports("cantilever", elements);
    held.spring(elements, Dof::W, 0.5 * k).spring(elements, Dof::W, 0.5 * k);
    let loads = force_at(elements, [0.0, LOAD, 0.0]);
    let solution = solve(beam(elements), held.clone(), &loads);
    let w = LOAD / (k + 3.0 * bending_stiffness() / LENGTH.powi(3));
    assert_relative_eq!(solution.displacement[elements][1], w, max_relative = 1e-10);
    assert_relative_eq!(solution.reactions[elements][1], -k * w, max_relative = 1e-10);
    // Clapeyron: the elastic energy is half the work of the load.
    let energy = beam(elements).strain_energy(&solution.displacement) + held.spring_energy(&solution.displacement);
    assert_relative_eq!(energy, 0.5 * LOAD * w, max_relative = 1e-10);
}

/// The factorisation alone errs by 4e-3 on 3000 elements, and by 0.9 on 30000: no such answer is given.
#[test]
fn a_very_fine_mesh_is_solved_exactly_or_refused() {
    let tip_deflection = |elements: usize| {
        let statics = Statics::new(beam_at(0.3, elements), supports("cantilever", elements))?;
        let (c, s) = (0.3_f64.cos(), 0.3_f64.sin());
        let solution = statics.solve(&force_at(elements, [-s * LOAD, c * LOAD, 0.0]))?;
        let [u, w, _] = solution.displacement[elements];
        Ok::<_, Error>(c * w - s * u)
    };
    let exact = LOAD * LENGTH.powi(3) / (3.0 * bending_stiffness());
    for elements in [1, 100, 3000, 10_000] {
        let w = tip_deflection(elements).unwrap();
        println!("{elements} elements: {:e}", w / exact - 1.0);
        assert_relative_eq!(w, exact, max_relative = 1e-9);
    }
    for elements in [30_000, 100_000] {
        let error = tip_deflection(elements).unwrap_err();
        assert!(error.to_string().starts_with("ill-conditioned"), "{error}");
        println!("{error}");
    }
}

/// With every degree of freedom fixed, the reactions are the fixed-end forces q L/2 and q L^2/12.
#[test]
fn a_beam_with_no_unknowns_has_the_fixed_end_forces() {
    let beam = beam(1);
    let loads = uniform(&beam, [0.0, LOAD]);
    let solution = solve(beam, supports("clamped_clamped", 1), &loads);
    assert_eq!(solution.displacement, [[0.0; 3]; 2]);
    let (shear, moment) = (LOAD * LENGTH / 2.0, LOAD * LENGTH.powi(2) / 12.0);
    for (node, sign) in [(0, -1.0), (1, 1.0)] {
        assert_relative_eq!(solution.reactions[node][1], -shear, max_relative = 1e-14);
        assert_relative_eq!(solution.reactions[node][2], sign * moment, max_relative = 1e-14);
    }
}
