//! Force and moment of layers against exact curves; forces, tangents and energy against each other.

use super::*;
use crate::element::{DiscreteGradient, Ends, Start, Theory, strain_energy};
use crate::material::{Material, Plasticity, Section};

const STEEL: Material = Material { youngs_modulus: 200e9, poissons_ratio: 0.3, density: 7850.0 };
const PERFECT: Plasticity = Plasticity { yield_stress: 300e6, hardening_modulus: 0.0 };
const THICKNESS: f64 = 0.01;

fn element(section: Section, plasticity: Plasticity) -> ElementConstants {
    let mut element = ElementConstants::new(&STEEL, &section, Theory::EulerBernoulli, false, [0.03, 0.04]);
    element.plastic = PlasticElement::new((&STEEL, &section), &plasticity, element.length, false);
    element
}

/// Normal force and moment of an arc with these strains of the axis and of the left fibre from bending, reached in `steps` equal steps.
fn driven(element: &ElementConstants, [axis, bent]: [f64; 2], steps: usize, plastic: &mut PlasticStrains) -> [f64; 2] {
    let layers = element.plastic.as_ref().unwrap();
    let curvature = -2.0 * bent / THICKNESS;
    let arc = -0.5 * curvature * element.length;
    let mut forces = [0.0; 2];
    for step in 1..=steps {
        let share = step as f64 / steps as f64;
        let arc = share * arc;
        let deformation = [element.length * (share * axis - element.curvature_strain[0] * arc * arc / 2.0), arc, 0.0];
        layers.update(element, &deformation, plastic);
        let [n, m_s, _] = layers.held(plastic);
        let [axial, for_arc, _] = element.stiffness;
        forces = [axial * element.length * share * axis + n, -0.5 * (for_arc * arc + m_s)];
    }
    forces
}

/// Force and moment at which all layers flow lie on M/M_p = 1 − (N/N_y)²; N_y and M_p are those of the bar, and of the strip 2/√3 times.
#[test]
fn force_and_moment_interact_as_in_a_rectangle() {
    for (section, factor) in
        [(Section::rectangular(THICKNESS, 1.0), 1.0), (Section::strip(THICKNESS), 2.0 / 3.0_f64.sqrt())]
    {
        let stress = factor * PERFECT.yield_stress;
        let element = element(section, PERFECT);
        let mut worst: f64 = 0.0;
        for k in -60_i32..=60 {
            let ratio = f64::from(k) / 60.0;
            let mut plastic = PlasticStrains::NONE;
            let [n, m] = driven(&element, [0.2 * ratio, 0.2 * (1.0 - ratio.abs())], 400, &mut plastic);
            let (n, m) = (n / (stress * THICKNESS), -m / (stress * THICKNESS.powi(2) / 4.0));
            worst = worst.max((m + n * n - 1.0).abs());
            assert!(k.abs() < 60 || (n.abs() - 1.0).abs() < 1e-3, "pure stretch: {n}");
            assert!(k != 0 || (m - 1.0).abs() < 3e-3, "pure bending: {m}");
        }
        println!("{section:?}: N-M off by at most {worst:.1e}");
        assert!(worst < 5e-3, "{worst}");
    }
}

/// M(κ) of a bar that hardens, and the curvature that is left: exact of two straight lines for the stress.
#[test]
fn a_bar_bends_and_springs_back_as_in_the_books() {
    let hardening = 4e9;
    let element = element(Section::rectangular(THICKNESS, 1.0), Plasticity { hardening_modulus: hardening, ..PERFECT });
    let share = hardening / (STEEL.youngs_modulus + hardening);
    let (limit, second) = (PERFECT.yield_stress / STEEL.youngs_modulus, THICKNESS.powi(3) / 12.0);
    for bent in [0.5 * limit, 1.5 * limit, 4.0 * limit, 20.0 * limit] {
        let core = (limit / bent).min(1.0);
        let plastic_moment = PERFECT.yield_stress * THICKNESS.powi(2) / 4.0;
        let exact = match bent > limit {
            true => {
                share * STEEL.youngs_modulus * second * 2.0 * bent / THICKNESS
                    + (1.0 - share) * plastic_moment * (1.0 - core * core / 3.0)
            }
            false => STEEL.youngs_modulus * second * 2.0 * bent / THICKNESS,
        };
        let mut plastic = PlasticStrains::NONE;
        let [n, m] = driven(&element, [0.0, bent], 1, &mut plastic);
        assert!(n.abs() < 1e-6 && (m / -exact - 1.0).abs() < 4e-3, "{bent}: {m} against {exact}");
        let left = element.plastic.as_ref().unwrap().plastic_curvatures(&plastic);
        let curvature = -(2.0 * bent / THICKNESS - exact / (STEEL.youngs_modulus * second));
        assert!((left[0] - curvature).abs() < 4e-3 * (2.0 * bent / THICKNESS), "{left:?} against {curvature}");
        assert_eq!(plastic.has_yielded(), bent > limit);
    }
}

/// Work of the mean forces is the change of the elastic energy and what is dissipated, whatever yields on the way; nothing changes to the
/// bit where nothing yields.
#[test]
fn work_closes_through_yield() {
    let hard = Plasticity { hardening_modulus: 3e9, ..PERFECT };
    for section in [Section::rectangular(THICKNESS, 0.5), Section::strip(THICKNESS)] {
        let element = element(section, hard);
        let layers = element.plastic.as_ref().unwrap();
        let mut plastic = PlasticStrains::NONE;
        let mut at = Ends::ZERO;
        for move_by in [
            [0.0, 0.0, 0.01, 1e-5, 1e-4, -0.02],
            [1e-4, 0.0, -0.3, 5e-4, -2e-3, 0.1],
            [0.0, 0.01, 0.2, -1e-3, 0.0, 0.1],
        ] {
            let to = at + Ends(move_by);
            for weight in [0.5, 0.8] {
                let start = Start { from: Chord::new(&element, &at), before: &at, plastic: Some(&plastic) };
                let mean = DiscreteGradient::new(&element, start, &to, weight).forces();
                let deformation = |q: &Ends| Chord::new(&element, q).deformation;
                let mut after = plastic;
                layers.update(&element, &deformation(&to), &mut after);
                let held =
                    |q: &Ends, plastic| strain_energy(&element, q) + layers.energy(&element, &deformation(q), plastic);
                let work = mean.forces.dot(&(to - at));
                let error = work - mean.dissipated - (held(&to, &after) - held(&at, &plastic));
                assert!(error.abs() < 1e-10 * work.abs(), "{weight}: {error:e} of {work}");
                assert!(mean.dissipated > 0.0 && after.has_yielded());
            }
            layers.update(&element, &deformation_at(&element, &to), &mut plastic);
            at = to;
        }
        let small = Ends([0.0, 0.0, 1e-3, 1e-6, 1e-5, -1e-3]);
        let rest = Ends::ZERO;
        let from = Chord::new(&element, &rest);
        let of = |plastic| DiscreteGradient::new(&element, Start { from, before: &rest, plastic }, &small, 0.6);
        let [with, without] = [Some(&PlasticStrains::NONE), None].map(of);
        assert_eq!(with.forces().forces, without.forces().forces);
        assert_eq!(with.tangent(), without.tangent());
    }
}

fn deformation_at(element: &ElementConstants, q: &Ends) -> [f64; 3] {
    Chord::new(element, q).deformation
}

/// The static tangent of an element that flows is the derivative of its forces.
#[test]
fn the_tangent_of_a_flowing_element_is_the_derivative_of_its_forces() {
    let element = element(Section::strip(THICKNESS), Plasticity { hardening_modulus: 3e9, ..PERFECT });
    let layers = element.plastic.as_ref().unwrap();
    let mut before = PlasticStrains::NONE;
    layers.update(&element, &[2e-4, 0.02, -0.01], &mut before);
    let at = |d: [f64; 3]| {
        let chord = Chord { direction: [1.0, 0.0], length: element.length, deformation: d };
        layers.corrections(&element, &chord, &before)
    };
    let place = [4e-4, 0.05, -0.03];
    let tangent = at(place).tangent;
    for (k, entries) in [(0, [0, 1, 2]), (1, [1, 3, 4]), (2, [2, 4, 5])] {
        let moved = |h: f64| {
            let mut d = place;
            d[k] += h;
            at(d).forces
        };
        let h = 1e-9;
        let (low, high) = (moved(-h), moved(h));
        for (i, entry) in entries.into_iter().enumerate() {
            let slope = (high[i] - low[i]) / (2.0 * h);
            assert!(
                (slope - tangent[entry]).abs() < 1e-5 * slope.abs().max(1e3),
                "{k}{i}: {slope} against {}",
                tangent[entry]
            );
        }
    }
}
