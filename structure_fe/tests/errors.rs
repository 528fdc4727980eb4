//! Wrong input gives the error that says what is wrong, with the numbers.

mod common;

use common::{LENGTH, MATERIAL, beam, beam_at, section, supports, uniform};
use structure_fe::{Beam, Dof, Error, Loads, Material, Section, Statics, Supports, natural_modes};

fn one_element(material: Material, section: Section) -> Result<Beam, Error> {
    Beam::straight([0.0, 0.0], [1.0, 0.0], 1, material, section)
}

#[test]
fn a_model_needs_elements_that_join_existing_distinct_nodes() {
    let build = |nodes: Vec<[f64; 2]>, connectivity: &[[usize; 2]]| {
        Beam::uniform(nodes, connectivity, MATERIAL, section()).unwrap_err()
    };
    let nodes = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]];
    assert_eq!(build(nodes.clone(), &[]), Error::NoElements { nodes: 3 });
    assert!(matches!(Beam::straight([0.0, 0.0], [1.0, 0.0], 0, MATERIAL, section()), Err(Error::NoElements { .. })));
    assert_eq!(
        build(nodes.clone(), &[[0, 1], [1, 3]]),
        Error::NoSuchNode { item: "element", index: 1, node: 3, nodes: 3 }
    );
    assert_eq!(
        build(nodes.clone(), &[[0, 1], [1, 2]]),
        Error::ZeroLengthElement { element: 1, nodes: [1, 2], length: 0.0, extent: 1.0 }
    );
    assert_eq!(build(nodes, &[[0, 1]]), Error::UnattachedNode { node: 2 });
    let nan = build(vec![[0.0, 0.0], [1.0, f64::NAN]], &[[0, 1]]);
    assert!(matches!(nan, Error::BadProperty { index: 1, value, .. } if value.is_nan()), "{nan}");
}

#[test]
fn material_and_section_must_be_physical() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (name, model) in [
            ("modulus", one_element(Material { youngs_modulus: bad, ..MATERIAL }, section())),
            ("density", one_element(Material { density: bad, ..MATERIAL }, section())),
            ("thickness", one_element(MATERIAL, Section::strip(bad))),
            ("width", one_element(MATERIAL, Section::rectangular(0.1, bad))),
        ] {
            let error = model.unwrap_err();
            let Error::BadProperty { quantity, index: 0, value, .. } = error else {
                panic!("{error}");
            };
            assert!(quantity.contains(name), "{quantity}");
            assert_eq!(value.to_bits(), bad.to_bits());
        }
    }
    for bad in [-1.0, 0.51, f64::NAN] {
        let error = one_element(Material { poissons_ratio: bad, ..MATERIAL }, section());
        assert!(matches!(error, Err(Error::BadProperty { quantity: "Poisson's ratio [-]", index: 0, .. })));
    }
    assert!(one_element(Material { poissons_ratio: 0.5, ..MATERIAL }, section()).is_ok());
}

#[test]
fn supports_and_loads_must_be_on_the_model() {
    let error = Statics::new(beam(2), supports("clamped_clamped", 3)).unwrap_err();
    assert!(matches!(error, Error::NoSuchNode { item: "support", node: 3, nodes: 3, .. }));
    let mut held = Supports::default();
    held.clamp(0).spring(2, Dof::W, -5.0);
    for error in [Statics::new(beam(2), held.clone()).unwrap_err(), natural_modes(&beam(2), &held, 1).unwrap_err()] {
        assert!(matches!(error, Error::BadProperty { item: "spring", value: -5.0, .. }), "{error}");
    }
    let statics = Statics::new(beam(2), supports("cantilever", 2)).unwrap();
    let solve = |put: fn(&mut Loads)| {
        let mut loads = uniform(statics.beam(), [0.0, 1.0]);
        put(&mut loads);
        statics.solve(&loads).unwrap_err()
    };
    assert_eq!(
        solve(|loads| _ = loads.at_node(3, [0.0; 3])),
        Error::NoSuchNode { item: "nodal load", index: 0, node: 3, nodes: 3 }
    );
    assert_eq!(
        solve(|loads| _ = loads.along_element(2, [0.0; 2], [0.0; 2])),
        Error::NoSuchElement { item: "distributed load", index: 2, element: 2, elements: 2 }
    );
    for error in [
        solve(|loads| _ = loads.at_node(1, [0.0, f64::NAN, 0.0])),
        solve(|loads| _ = loads.along_element(1, [0.0; 2], [f64::INFINITY, 0.0])),
    ] {
        assert!(matches!(error, Error::BadProperty { .. }), "{error}");
    }
}

/// The motion the error names, scaled to a largest component of one.
fn free_motion(beam: Beam, supports: Supports) -> (usize, [f64; 3]) {
    match Statics::new(beam, supports) {
        Err(error @ Error::UnderSupported { node, motion }) => {
            assert!(error.to_string().starts_with("under-supported"));
            let largest = motion.into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs()));
            (node, motion.map(|component| component / largest.unwrap()))
        }
        other => panic!("{other:?} should have been under-supported"),
    }
}

#[test]
fn an_under_supported_model_names_its_free_motion() {
    let close = |ours: [f64; 3], expected: [f64; 3]| (0..3).all(|i| (ours[i] - expected[i]).abs() < 1e-9);
    for elements in [1, 7, 40] {
        // Nothing held at all: some motion or other.
        free_motion(beam(elements), Supports::default());

        // One hinge: the beam turns about it.
        let mut hinge = Supports::default();
        hinge.pin(0);
        let (node, motion) = free_motion(beam_at(0.7, elements), hinge);
        assert_eq!(node, 0);
        assert!(close(motion, [0.0, 0.0, 1.0]), "{motion:?}");

        // Two rollers: it slides along x.
        let mut rollers = Supports::default();
        rollers.fix(0, Dof::W).fix(elements, Dof::W);
        let (_, motion) = free_motion(beam(elements), rollers);
        assert!(close(motion, [1.0, 0.0, 0.0]), "{motion:?}");

        // Two rollers at right angles on a slope: it turns about the point where their lines meet.
        let mut crossed = Supports::default();
        crossed.fix(0, Dof::W).fix(elements, Dof::U);
        let (_, motion) = free_motion(beam_at(0.7, elements), crossed);
        let height = LENGTH * 0.7_f64.sin();
        assert!(close(motion, [height, 0.0, 1.0]), "{motion:?}");

        // Three supports whose lines of action meet at the far end: it turns about that end.
        let mut concurrent = Supports::default();
        concurrent.fix(0, Dof::U).pin(elements);
        let (_, motion) = free_motion(beam(elements), concurrent);
        assert!(close(motion, [0.0, 1.0, -1.0 / LENGTH]), "{motion:?}");
    }
}

#[test]
fn a_part_that_is_not_joined_to_the_rest_must_be_held_by_itself() {
    let nodes = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
    let beam = Beam::uniform(nodes, &[[0, 1], [2, 3]], MATERIAL, section()).unwrap();
    let mut held = Supports::default();
    held.clamp(0);
    assert_eq!(free_motion(beam.clone(), held.clone()).0, 2);
    held.clamp(3);
    assert!(Statics::new(beam, held).is_ok());
}

#[test]
fn springs_hold_a_model_unless_they_are_absurdly_soft() {
    let sprung = |stiffness: f64| {
        let mut supports = Supports::default();
        supports.spring(0, Dof::U, stiffness).spring(0, Dof::W, stiffness).spring(4, Dof::W, stiffness);
        Statics::new(beam(4), supports)
    };
    assert!(sprung(1e3).is_ok());
    let error = sprung(1e-9).unwrap_err();
    assert!(matches!(error, Error::UnderSupported { .. }), "{error}");
}
