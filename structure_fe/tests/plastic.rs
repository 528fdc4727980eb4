//! Force and moment beyond the elastic limit: against exact solutions, at rest and in motion.

mod common;

use common::{CONSERVING, LENGTH, MATERIAL, beam, moved, none, pairing, section, supports};
use structure_fe::{
    BarSection, Beam, Damping, Dynamics, Envelope, Error, Integration, Loads, NonlinearStatics, Plasticity, Section,
    Statics, Theory,
};

const SOFT: Plasticity = Plasticity { yield_stress: 2e6, hardening_modulus: 7e9 };

fn yielding(elements: usize) -> Beam {
    beam(elements).with_plasticity(SOFT).unwrap()
}

/// A bar of the strip's thickness, one metre wide, free to contract.
fn bar() -> Section {
    Section::rectangular(section().thickness(), 1.0)
}

fn yielding_bar(elements: usize) -> Beam {
    let bar = Beam::straight([0.0, 0.0], [LENGTH, 0.0], elements, MATERIAL, bar()).unwrap();
    bar.with_plasticity(SOFT).unwrap()
}

/// Moment at which the outer fibres of the bar yield [N m].
fn yield_moment() -> f64 {
    SOFT.yield_stress * bar().thickness().powi(2) / 6.0
}

/// Curvature of the bar under a moment, exact of a bilinear stress: M = E_t I kappa + (1 - E_t/E) 3/2 M_y (1 - (kappa_y/kappa)^2/3) beyond
/// kappa_y.
fn curvature(moment: f64) -> f64 {
    let stiffness = bar().bending_stiffness(&MATERIAL);
    let (first, share) =
        (yield_moment() / stiffness, SOFT.hardening_modulus / (MATERIAL.youngs_modulus + SOFT.hardening_modulus));
    if moment <= yield_moment() {
        return moment / stiffness;
    }
    let of = |kappa: f64| {
        share * stiffness * kappa + (1.0 - share) * 1.5 * yield_moment() * (1.0 - (first / kappa).powi(2) / 3.0)
    };
    let (mut low, mut high) = (first, 1e3 * first);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if of(middle) < moment { low = middle } else { high = middle }
    }
    low
}

/// Deflections of the tip of a cantilever under a load there: whole, and what is left without it.
fn exact_tip(load: f64) -> [f64; 2] {
    let (parts, stiffness) = (20_000, bar().bending_stiffness(&MATERIAL));
    let step = LENGTH / f64::from(parts);
    let each = (0..parts).map(|k| {
        let s = (f64::from(k) + 0.5) * step;
        let kappa = curvature(load * s);
        [kappa * s * step, (kappa - load * s / stiffness) * s * step]
    });
    each.fold([0.0; 2], |[whole, left], [a, b]| [whole + a, left + b])
}

#[test]
fn a_cantilever_bent_beyond_its_limit_keeps_the_exact_dent() {
    let load = 1.8 * yield_moment() / LENGTH;
    let [whole, exact] = exact_tip(load);
    assert!(whole < 0.02 * LENGTH && exact > 0.1 * whole, "small: {whole}, {exact}");
    let errors = [16, 32, 64].map(|elements| {
        let mut loads = Loads::default();
        loads.at_node(elements, [0.0, load, 0.0]);
        let model = NonlinearStatics::new(yielding_bar(elements), supports("cantilever", elements)).unwrap();
        let solved = model.history(&[loads.clone(), Loads::default(), loads.clone()], 4).unwrap();
        let tips = [0, 1, 2].map(|case: usize| solved[case].displacement[elements][1]);
        assert!((solved[0].reactions[0][2] / (load * LENGTH) + 1.0).abs() < 1e-3);
        // Loaded again it comes to where it was, elastically.
        assert!((tips[2] / tips[0] - 1.0).abs() < 1e-9);
        let kept = solved[2].plastic_curvature.as_flattened().iter().zip(solved[1].plastic_curvature.as_flattened());
        assert!(kept.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-9);
        // In one go, the same.
        let once = model.solve(&loads, 1).unwrap();
        assert!((once.displacement[elements][1] / tips[0] - 1.0).abs() < 1e-6);
        [tips[0] / whole - 1.0, tips[1] / exact - 1.0]
    });
    println!("16, 32, 64 elements: {errors:?}; deflection {whole}, dent {exact}");
    assert!(errors[1][0].abs() < 2e-3 && errors[1][1].abs() < 1e-2, "{errors:?}");
    assert!(errors[2][1].abs() < 0.5 * errors[1][1].abs() + 5e-3);
    // Below the limit nothing is left.
    let elements = 16;
    let mut loads = Loads::default();
    loads.at_node(elements, [0.0, 0.9 * yield_moment() / LENGTH, 0.0]);
    let model = NonlinearStatics::new(yielding_bar(elements), supports("cantilever", elements)).unwrap();
    let solved = model.history(&[loads.clone(), Loads::default()], 2).unwrap();
    assert!(solved[1].displacement[elements][1].abs() < 1e-12);
    let model = Statics::new(yielding_bar(elements), supports("cantilever", elements)).unwrap();
    let elastic = model.solve(&loads).unwrap();
    assert!((solved[0].displacement[elements][1] / elastic.displacement[elements][1] - 1.0).abs() < 1e-4);
}

/// A clamped strip under pressure far into its membrane is an arc of the force N: half its chord a/2 = R sin phi, 1 + eps = phi/sin phi,
/// R = N(eps)/p (a string of yield force; bending is confined to its ends).
#[test]
fn a_strip_far_in_its_membrane_is_the_arc_of_its_yield_force() {
    let (thickness, elements) = (0.002, 60);
    let weak = Plasticity { yield_stress: 300e6, hardening_modulus: 1e9 };
    for (section, plane_strain) in [(Section::rectangular(thickness, 1.0), false), (Section::strip(thickness), true)] {
        let beam = Beam::straight([0.0, 0.0], [1.0, 0.0], elements, MATERIAL, section).unwrap();
        let model =
            NonlinearStatics::new(beam.with_plasticity(weak).unwrap(), supports("clamped_clamped", elements)).unwrap();
        for strain in [0.01_f64, 0.04] {
            // far beyond yield in plane strain the flow is that of 2/sqrt(3) sigma_y and 4/3 H
            let stress = if plane_strain {
                let (first, slope) = (2.0 / 3.0_f64.sqrt() * weak.yield_stress, 4.0 / 3.0 * weak.hardening_modulus);
                let modulus = MATERIAL.youngs_modulus / (1.0 - MATERIAL.poissons_ratio.powi(2));
                (first + slope * strain) / (1.0 + slope / modulus)
            } else {
                let tangent = 1.0 / (1.0 / weak.hardening_modulus + 1.0 / MATERIAL.youngs_modulus);
                weak.yield_stress + tangent * (strain - weak.yield_stress / MATERIAL.youngs_modulus)
            };
            let (mut low, mut high) = (1e-6_f64, 2.0_f64);
            for _ in 0..100 {
                let phi = 0.5 * (low + high);
                if phi / phi.sin() < 1.0 + strain { low = phi } else { high = phi }
            }
            let radius = 0.5 / low.sin();
            let (pressure, sagitta) = (stress * thickness / radius, radius * (1.0 - low.cos()));
            let mut loads = Loads::default();
            (0..elements).for_each(|element| {
                loads.pressure_on_element(element, pressure, pressure);
            });
            let solved = model.history(&[loads], 20).unwrap();
            let middle = solved[0].displacement[elements / 2][1].abs();
            let normal = solved[0].section_forces[elements / 2][0].normal / (stress * thickness);
            println!(
                "strain {strain}, plane strain {plane_strain}: sagitta {} and force {} off",
                middle / sagitta - 1.0,
                normal - 1.0
            );
            assert!((middle / sagitta - 1.0).abs() < 1e-2, "{middle} against {sagitta}");
            assert!((normal - 1.0).abs() < 1e-2, "{normal}");
        }
    }
}

/// A load of hundreds of collapse loads, in steps that are long for it: the step is divided, and energy and impulse still close.
#[test]
fn a_plate_that_yields_at_once_converges() {
    let elements = 24;
    let weak = Plasticity { yield_stress: 1e6, hardening_modulus: 0.0 };
    for name in ["clamped_clamped", "simply_supported"] {
        let model = beam(elements).with_plasticity(weak).unwrap();
        let mut dynamics = Dynamics::new(model, supports(name, elements), CONSERVING, Damping::default()).unwrap();
        let mut state = dynamics.at_rest();
        let mut load = none(elements + 1);
        load[1..elements].iter_mut().for_each(|node| node[1] = -3e5 * LENGTH / elements as f64);
        let (mut work, mut dissipated, mut worst): (f64, f64, f64) = (0.0, 0.0, 0.0);
        let mut impulse = 0.0;
        for step in 0..40 {
            if step == 10 {
                load = none(elements + 1);
            }
            let before = state.clone();
            let report = dynamics.step(&mut state, &load, 1e-4).unwrap();
            work += pairing(&load, &moved(&before, &state));
            dissipated += report.dissipated;
            impulse += 1e-4
                * (load.iter().map(|node| node[1]).sum::<f64>()
                    + state.mean_reaction.iter().map(|node| node[1]).sum::<f64>());
            let energy = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state);
            worst = worst.max((energy + dissipated - work).abs());
        }
        let momentum = dynamics.momentum(&state)[1];
        println!(
            "{name}: energy {:.1e}, {dissipated} of {work} J, momentum {:.1e}",
            worst / work,
            momentum / impulse - 1.0
        );
        assert!(worst < 1e-10 * work && dissipated > 0.0);
        assert!((momentum / impulse - 1.0).abs() < 1e-9, "{momentum} against {impulse}");
        let limit = 1.000_001 * 2.0 / 3.0_f64.sqrt() * weak.yield_stress;
        assert!(dynamics.fibres(&state).iter().flat_map(|fibres| fibres.stress).all(|stress| stress.abs() < limit));
    }
}

/// Elements that could yield and do not are elastic to the bit.
#[test]
fn below_the_limit_the_motion_is_the_elastic_one() {
    let elements = 12;
    let end = |beam: Beam| {
        let mut dynamics =
            Dynamics::new(beam, supports("clamped_pinned", elements), CONSERVING, Damping::default()).unwrap();
        let mut state = dynamics.at_rest();
        let mut load = none(elements + 1);
        load[5] = [0.5, -3.0, 0.0];
        for _ in 0..200 {
            dynamics.step(&mut state, &load, 1e-3).unwrap();
        }
        (state.displacement.clone(), dynamics.fibres(&state))
    };
    assert_eq!(end(yielding(elements)), end(beam(elements)));
}

/// Free vibration after an impulse: the energy decreases by the plastic work, the deformation is permanent, and a step from a
/// copy of the state gives the same bits.
#[test]
fn an_impulse_leaves_a_dent_and_its_work_is_accounted_for() {
    let elements = 16;
    for (radius, damping) in [(1.0, 0.0), (0.8, 3e-3)] {
        let rule = Integration::Trapezoidal { spectral_radius: radius };
        let damping = Damping { mass: 0.0, stiffness: damping };
        let mut dynamics = Dynamics::new(yielding(elements), supports("cantilever", elements), rule, damping).unwrap();
        let mut state = dynamics.at_rest();
        let mut envelope = Envelope::new(dynamics.beam());
        let mut load = none(elements + 1);
        let (mut work, mut dissipated, mut worst): (f64, f64, f64) = (0.0, 0.0, 0.0);
        let mut most: f64 = 0.0;
        for step in 0..3000 {
            load[elements][1] = if step < 40 { 5.0 * yield_moment() / LENGTH } else { 0.0 };
            let before = state.clone();
            let report = dynamics.step(&mut state, &load, 1e-3).unwrap();
            if step == 30 {
                let mut again = before.clone();
                dynamics.step(&mut again, &none(elements + 1), 5e-3).unwrap();
                let mut again = before.clone();
                assert_eq!(dynamics.step(&mut again, &load, 1e-3).unwrap(), report);
                assert_eq!(again, state, "a step redone");
            }
            work += pairing(&load, &moved(&before, &state));
            dissipated += report.dissipated;
            let energy = dynamics.kinetic_energy(&state) + dynamics.strain_energy(&state);
            worst = worst.max((energy + dissipated - work).abs());
            most = most.max(energy);
            envelope.record(&dynamics, &state);
        }
        println!("rho {radius}: balance {:e} of {work} J, {dissipated} J dissipated", worst / work);
        assert!(worst < 1e-10 * work && dissipated > 0.1 * work);
        // The envelope: the root was bent beyond the limit, and the reserve is below one there.
        let root = envelope.ends[0];
        assert!(root.moment.largest() > yield_moment());
        let (element, reserve) = envelope.reserve_factor(SOFT.yield_stress).unwrap();
        assert!(element == 0 && reserve < 1.0, "element {element}, {reserve}");
        assert!(root.fibre_strain.largest() > root.fibre_stress.largest() / MATERIAL.youngs_modulus);
        if radius < 1.0 {
            // At rest at last, with the dent of its plastic curvatures: each h/2 of an element, at its two places.
            let length = LENGTH / elements as f64;
            let dent: f64 = dynamics
                .plastic_curvatures(&state)
                .iter()
                .enumerate()
                .map(|(element, curvature)| {
                    [-1.0, 1.0]
                        .iter()
                        .zip(curvature)
                        .map(|(side, kappa)| {
                            let x = length * (element as f64 + 0.5 + side / 12_f64.sqrt());
                            0.5 * length * kappa * (LENGTH - x)
                        })
                        .sum::<f64>()
                })
                .sum();
            let tip = state.displacement[elements][1];
            println!("dent {tip}, of the plastic curvatures {dent}");
            assert!(tip > 0.0 && (tip / dent - 1.0).abs() < 1e-3, "{tip} against {dent}");
        }
    }
}

#[test]
fn envelopes_hold_the_extremes_and_their_times() {
    let elements = 8;
    let mut dynamics =
        Dynamics::new(beam(elements), supports("cantilever", elements), CONSERVING, Damping::default()).unwrap();
    let mut state = dynamics.at_rest();
    let mut load = none(elements + 1);
    load[elements] = [5.0, -10.0, 0.0];
    let mut envelope = Envelope::new(dynamics.beam());
    let (mut least, mut when, mut stress): (f64, f64, f64) = (f64::INFINITY, 0.0, 0.0);
    for _ in 0..200 {
        dynamics.step(&mut state, &load, 2e-3).unwrap();
        envelope.record(&dynamics, &state);
        let root = dynamics.section_forces(&state)[0];
        if root.moment < least {
            (least, when) = (root.moment, state.time);
        }
        stress = stress.max(root.fibre_stress(&section(), 0.01).abs()).max(root.fibre_stress(&section(), -0.01).abs());
    }
    let root = &envelope.ends[0];
    assert_eq!((root.moment.least, root.moment.time_of_least), (least, when));
    assert_eq!(root.fibre_stress.largest(), stress);
    // A sudden load swings to about twice its static moment.
    assert!((least / (-10.0 * LENGTH) - 2.0).abs() < 0.6, "{least}");
    assert!(envelope.displacement[elements][1].least < 0.0 && envelope.displacement[0][1].largest() == 0.0);
    let factors = envelope.reserve_factors(2.0 * stress).unwrap();
    assert!((factors[0] - 2.0).abs() < 1e-12 && factors[elements - 1] > factors[0]);
    assert!(matches!(envelope.reserve_factors(0.0), Err(Error::OutOfRange { .. })));
    assert_eq!(Envelope::new(dynamics.beam()).reserve_factor(1.0).unwrap().1, f64::INFINITY);
}

#[test]
fn what_cannot_yield_is_refused() {
    let bad = |yield_stress, hardening_modulus| {
        beam(2).with_plasticity(Plasticity { yield_stress, hardening_modulus }).unwrap_err()
    };
    assert!(matches!(bad(0.0, 1.0), Error::BadProperty { value: 0.0, .. }));
    assert!(matches!(bad(1.0, -1.0), Error::OutOfRange { value: -1.0, .. }));
    let impossible = BarSection { area: 1e-3, second_moment: 1e-6, shear_modulus: 3e10, fibres: [-0.01, 0.02] };
    let stiff = Beam::straight([0.0, 0.0], [1.0, 0.0], 2, MATERIAL, Section::bar(impossible)).unwrap();
    assert!(matches!(stiff.with_plasticity(SOFT), Err(Error::BadProperty { value: 1e-6, .. })));
    let thick = beam(2).with_theory(Theory::TIMOSHENKO).unwrap();
    let error = thick.with_plasticity(SOFT).unwrap_err();
    assert!(matches!(error, Error::Unsupported { feature: "plasticity", index: 0, .. }), "{error}");
    assert!(matches!(beam(2).with_plasticity_of(2, SOFT), Err(Error::NoSuchElement { item: "plasticity", .. })));
    for rule in [Integration::GeneralisedAlpha { spectral_radius: 1.0 }, Integration::CentralDifference] {
        let some = beam(3).with_plasticity_of(1, SOFT).unwrap();
        let error = Dynamics::new(some, supports("cantilever", 3), rule, Damping::default()).unwrap_err();
        assert!(matches!(error, Error::Unsupported { feature: "plasticity", index: 1, .. }), "{error}");
    }
    let model = NonlinearStatics::new(yielding(2), supports("cantilever", 2)).unwrap();
    let mut loads = Loads::default();
    loads.at_node(2, [0.0, 1.0, 0.0]);
    let error = model.path(&loads, 0.1, 1.0, 3, |_| false).unwrap_err();
    assert!(matches!(error, Error::Unsupported { feature: "plasticity", .. }), "{error}");
}
