//! Large displacements and rotations against exact solutions of the elastica and of a truss.

mod common;

use approx::assert_relative_eq;
use common::{LENGTH, MATERIAL, beam, bending_stiffness, number, section, supports, table};
use std::f64::consts::PI;
use structure_fe::{Beam, Dof, Error, Loads, Material, NonlinearStatics, Section, Statics, Supports, Theory};

/// A strip so thin that its axis does not stretch, as the tables assume.
fn inextensible(elements: usize) -> (NonlinearStatics, f64) {
    let section = Section::strip(1e-3);
    let beam = Beam::straight([0.0, 0.0], [LENGTH, 0.0], elements, MATERIAL, section).unwrap();
    let model = NonlinearStatics::new(beam, supports("cantilever", elements)).unwrap();
    (model, section.bending_stiffness(&MATERIAL))
}

/// Bisshopp & Drucker 1945: a dead load at the tip, up to 10 EI/L^2.
#[test]
fn a_cantilever_follows_the_elastica() {
    for (elements, allowed) in [(32, 1e-3), (8, 4e-3)] {
        let (model, ei) = inextensible(elements);
        let mut worst: f64 = 0.0;
        for row in table("cantilever_large_endload") {
            let mut loads = Loads::default();
            loads.at_node(elements, [0.0, number(&row, "alpha") * ei / LENGTH.powi(2), 0.0]);
            let [u, w, theta] = model.solve(&loads, 5).unwrap().displacement[elements];
            for (ours, exact) in [
                (-u / LENGTH, number(&row, "u_over_L")),
                (w / LENGTH, number(&row, "w_over_L")),
                (theta, number(&row, "theta_tip_rad")),
            ] {
                worst = worst.max((ours / exact - 1.0).abs());
            }
        }
        println!("elastica, {elements} elements: largest error {worst:e}");
        assert!(worst < allowed, "{elements} elements: {worst:e}");
    }
}

/// An end moment 2 pi EI/L rolls the beam up to a full circle.
#[test]
fn an_end_moment_rolls_a_cantilever_up() {
    for (elements, allowed) in [(32, 1e-3), (16, 2e-3)] {
        let (model, ei) = inextensible(elements);
        let mut worst: f64 = 0.0;
        for row in table("cantilever_rollup_moment") {
            let m = number(&row, "m");
            let mut loads = Loads::default();
            loads.at_node(elements, [0.0, 0.0, m * 2.0 * PI * ei / LENGTH]);
            let solution = model.solve(&loads, (20.0 * m).ceil() as usize).unwrap();
            let [u, w, theta] = solution.displacement[elements];
            worst = worst.max((-u / LENGTH - number(&row, "u_over_L")).abs());
            worst = worst.max((w / LENGTH - number(&row, "w_over_L")).abs());
            assert_relative_eq!(theta, 2.0 * PI * m, max_relative = 1e-7);
            assert_relative_eq!(solution.reactions[0][2], -m * 2.0 * PI * ei / LENGTH, max_relative = 1e-6);
        }
        println!("roll-up, {elements} elements: largest error {worst:e} L");
        assert!(worst < allowed, "{elements} elements: {worst:e}");
    }
}

/// Small loads: the linear solution, with pressures and loads along elements alike.
#[test]
fn small_displacements_are_those_of_linear_statics() {
    for theory in [Theory::EulerBernoulli, Theory::TIMOSHENKO] {
        let elements = 6;
        let beam = beam(elements).with_theory(theory).unwrap();
        let mut loads = Loads::default();
        loads.at_node(3, [2e-8, 1e-8, -3e-8]).along_element(4, [0.0, 1e-8], [1e-8, 4e-8]);
        loads.pressure_on_element(1, 1e-8, 3e-8);
        let held = supports("clamped_pinned", elements);
        let linear = Statics::new(beam.clone(), held.clone()).unwrap().solve(&loads).unwrap();
        let ours = NonlinearStatics::new(beam, held).unwrap().solve(&loads, 1).unwrap();
        let scale = linear.displacement.as_flattened().iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        for (a, b) in ours.displacement.as_flattened().iter().zip(linear.displacement.as_flattened()) {
            assert!((a - b).abs() < 1e-7 * scale, "{theory:?}: {a} against {b}");
        }
        for (a, b) in ours.section_forces.iter().flatten().zip(linear.section_forces.iter().flatten()) {
            for (a, b) in [(a.normal, b.normal), (a.shear, b.shear), (a.moment, b.moment)] {
                assert!((a - b).abs() < 1e-7 * 3e-8, "{theory:?}: {a} against {b}");
            }
        }
    }
}

/// Length/thickness 1000: shear deformation vanishes, and the element does not lock. At 10 it does not.
#[test]
fn timoshenko_beams_do_not_lock_when_slender() {
    let tip = |slenderness: f64, elements: usize, theory: Theory, large: bool| {
        let section = Section::rectangular(LENGTH / slenderness, 0.1);
        let beam = Beam::straight([0.0, 0.0], [LENGTH, 0.0], elements, MATERIAL, section).unwrap();
        let beam = beam.with_theory(theory).unwrap();
        let ei = section.bending_stiffness(&MATERIAL);
        let mut loads = Loads::default();
        loads.at_node(elements, [0.0, if large { 5.0 } else { 1e-6 } * ei / LENGTH.powi(2), 0.0]);
        let held = supports("cantilever", elements);
        let u = if large {
            NonlinearStatics::new(beam, held).unwrap().solve(&loads, 5).unwrap().displacement
        } else {
            Statics::new(beam, held).unwrap().solve(&loads).unwrap().displacement
        };
        u[elements][1]
    };
    for elements in [1, 4, 32] {
        for large in [false, true].into_iter().take(if elements > 1 { 2 } else { 1 }) {
            let slender =
                [Theory::TIMOSHENKO, Theory::EulerBernoulli].map(|theory| tip(1000.0, elements, theory, large));
            let difference = slender[0] / slender[1] - 1.0;
            println!("{elements} elements, large {large}: Timoshenko over Euler-Bernoulli {difference:e}");
            assert!(difference.abs() < 1e-6, "{elements}: {difference:e}");
        }
        // P L^3/(3 EI) + P L/(kappa G A), exact with one element.
        let ratio = tip(10.0, elements, Theory::TIMOSHENKO, false) / tip(10.0, elements, Theory::EulerBernoulli, false);
        let exact = 1.0 + 3.0 * 2.0 * (1.0 + MATERIAL.poissons_ratio) / (12.0 * 5.0 / 6.0) / 100.0;
        assert_relative_eq!(ratio, exact, max_relative = 1e-9);
    }
}

/// Pressure follows: at large displacement it is across the beam everywhere, and its resultant is the
/// pressure times the vector from root to tip, turned.
#[test]
fn pressure_follows_the_beam() {
    let elements = 24;
    let (model, ei) = inextensible(elements);
    let pressure = 8.0 * ei / LENGTH.powi(3);
    let mut loads = Loads::default();
    for element in 0..elements {
        loads.pressure_on_element(element, pressure, pressure);
    }
    let solution = model.solve(&loads, 8).unwrap();
    let [u, w, theta] = solution.displacement[elements];
    assert!(theta < -0.8, "the beam bends far: {theta}");
    let (x, y) = (LENGTH + u, w);
    // The left-hand side is pressed: the force on the beam is p (y, -x).
    assert_relative_eq!(solution.reactions[0][0], -pressure * y, max_relative = 1e-7);
    assert_relative_eq!(solution.reactions[0][1], pressure * x, max_relative = 1e-7);
    let moment = 0.5 * pressure * (x * x + y * y);
    assert_relative_eq!(solution.reactions[0][2], moment, max_relative = 1e-3);
}

/// Two bars hinged to each other and to the ground (von Mises 1923): P = 2 EA (L0/l - 1) (h - w)/L0.
fn truss() -> (NonlinearStatics, [f64; 3]) {
    let section = Section::rectangular(0.2, 0.2);
    let material = Material { youngs_modulus: 1e6, poissons_ratio: 0.3, density: 1000.0 };
    let (half, rise) = (1.0, 0.12);
    let nodes = vec![[-half, 0.0], [0.0, rise], [0.0, rise], [half, 0.0]];
    let beam = Beam::uniform(nodes, &[[0, 1], [2, 3]], material, section).unwrap();
    let mut held = Supports::default();
    held.pin(0).pin(3).hinge(1, 2);
    (NonlinearStatics::new(beam, held).unwrap(), [section.axial_stiffness(&material), half, rise])
}

#[test]
fn the_arc_length_passes_the_snap_through_of_a_truss() {
    let (model, [stiffness, half, rise]) = truss();
    let length = f64::hypot(half, rise);
    let exact = |w: f64| {
        let bar = f64::hypot(half, rise - w);
        2.0 * stiffness * (length - bar) / length * (rise - w) / bar
    };
    let peak = (1..1000).map(|i| exact(rise * i as f64 / 1000.0)).fold(0.0, f64::max);
    let mut loads = Loads::default();
    loads.at_node(1, [0.0, -peak, 0.0]);
    let beyond = |w: f64| w > 2.2 * rise;
    let path = model.path(&loads, 0.2, 2.0, 200, |point| beyond(-point.displacement[1][1])).unwrap();
    let (mut largest, mut smallest) = (0.0_f64, 0.0_f64);
    for point in &path {
        let w = -point.displacement[1][1];
        assert!((point.load_factor * peak - exact(w)).abs() < 1e-7 * peak, "w = {w}");
        assert_eq!(point.displacement[1][..2], point.displacement[2][..2], "the hinge holds");
        if w < rise {
            largest = largest.max(point.load_factor);
        } else {
            smallest = smallest.min(point.load_factor);
        }
        // Between the peaks the truss is unstable in one direction.
        let between = (w - rise).abs() < 0.5 * rise;
        if between {
            assert_eq!(point.unstable_directions, 1, "w = {w}");
        }
    }
    println!("{} points, load factors from {smallest} to {largest}", path.len());
    assert!(beyond(-path.last().unwrap().displacement[1][1]), "the path ends early");
    assert!(largest > 0.97 && largest <= 1.0 + 1e-9 && smallest < -0.97);
}

/// Load steps cannot pass the peak: from one step to the next the truss snaps, or Newton says so.
#[test]
fn load_steps_jump_over_what_the_arc_length_follows() {
    let (model, [stiffness, ..]) = truss();
    let mut loads = Loads::default();
    loads.at_node(1, [0.0, -0.01 * stiffness, 0.0]);
    match model.solve(&loads, 10) {
        Ok(solution) => assert!(solution.displacement[1][1] < -0.24, "beyond the snap: {:?}", solution.displacement[1]),
        Err(error) => assert!(matches!(error, Error::NotConverged { .. } | Error::SingularTangent { .. }), "{error}"),
    }
}

/// A failure says step, iteration, residual, load factor, node and degree of freedom.
#[test]
fn a_load_beyond_all_bounds_is_refused_with_its_numbers() {
    let (model, ei) = inextensible(4);
    let mut loads = Loads::default();
    loads.at_node(4, [0.0, 1e200 * ei / LENGTH.powi(2), 0.0]);
    let error = model.solve(&loads, 1).unwrap_err();
    println!("{error}");
    let Error::NotConverged { step: 1, load_factor, residual, iteration, node, .. } = error else { panic!("{error}") };
    assert!(
        load_factor > 0.0 && load_factor <= 1.0 && (residual > 0.0 || residual.is_nan()) && iteration > 0 && node <= 4
    );
}

/// An equilibrium that small strains do not cover, or that the mesh cannot describe, is no answer.
#[test]
fn elements_bent_too_far_are_named() {
    let (model, ei) = inextensible(4);
    let mut loads = Loads::default();
    loads.at_node(4, [0.0, 0.0, 10.0 * ei / LENGTH]);
    let error = model.solve(&loads, 20).unwrap_err();
    assert!(matches!(error, Error::BentTooFar { element: 0..4, rotation, .. } if rotation > 1.0), "{error}");
}

#[test]
fn hinges_release_rotations_in_linear_statics_too() {
    // A cantilever with a hinge in the middle is a mechanism; propped at its tip it is not.
    let nodes = vec![[0.0, 0.0], [0.5, 0.0], [0.5, 0.0], [1.0, 0.0]];
    let beam = Beam::uniform(nodes, &[[0, 1], [2, 3]], MATERIAL, section()).unwrap();
    let mut held = Supports::default();
    held.clamp(0).hinge(1, 2);
    let error = Statics::new(beam.clone(), held.clone()).unwrap_err();
    assert!(matches!(error, Error::UnderSupported { node: 2, .. }), "{error}");
    held.fix(3, Dof::W);
    let mut loads = Loads::default();
    loads.at_node(1, [0.0, -10.0, 0.0]);
    let solution = Statics::new(beam, held).unwrap().solve(&loads).unwrap();
    // The second half only follows: the first is a cantilever of its own.
    let exact = -10.0 * 0.5_f64.powi(3) / (3.0 * bending_stiffness());
    assert_relative_eq!(solution.displacement[2][1], exact, max_relative = 1e-9);
    assert_relative_eq!(solution.displacement[2][2], -exact / 0.5, max_relative = 1e-9);
    let mut apart = Supports::default();
    apart.clamp(0).hinge(0, 3);
    let two =
        Beam::uniform(vec![[0.0, 0.0], [0.5, 0.0], [0.5, 0.1], [1.0, 0.0]], &[[0, 1], [2, 3]], MATERIAL, section());
    assert!(matches!(Statics::new(two.unwrap(), apart), Err(Error::HingeGap { hinge: 0, .. })));
}
