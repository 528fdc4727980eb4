//! Forces are the gradient of the energy and tangents that of the forces, in any motion.

use super::*;
use crate::element::{Damping, Motion, Weights, momentum, response};
use crate::{Beam, Material, Section, Theory};

fn element(theory: Theory) -> ElementConstants {
    let material = Material { youngs_modulus: 3e6, poissons_ratio: 0.3, density: 2000.0 };
    let beam = Beam::straight([0.0, 0.0], [0.5, 0.3], 1, material, Section::strip(0.1)).unwrap();
    let beam = beam.with_theory(theory).unwrap().with_rotatory_inertia().unwrap();
    beam.constants().next().unwrap().1.clone()
}

const THEORIES: [Theory; 2] = [Theory::EulerBernoulli, Theory::TIMOSHENKO];

/// A large motion, with a stretch of some percent and end rotations of some tenths.
const Q: Ends = Ends([0.3, -0.1, 2.3, -0.45, -0.02, 1.7]);
const V: Ends = Ends([1.0, -2.0, 7.0, 3.0, 0.5, -4.0]);
const A: Ends = Ends([-30.0, 20.0, 100.0, 11.0, -17.0, 60.0]);

fn statics(element: &ElementConstants, q: Ends) -> Ends {
    let motion = Motion { q, v: Ends::ZERO, a: Ends::ZERO };
    response(element, &motion, &Damping::default(), None).0
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

#[test]
fn forces_are_the_gradient_of_the_energy() {
    for theory in THEORIES {
        let element = element(theory);
        let force = statics(&element, Q);
        for i in 0..6 {
            let energy = |step: f64| {
                let mut q = Q;
                q[i] += step;
                strain_energy(&element, &q)
            };
            // Fourth order.
            let h = 1e-4;
            let slope = (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h))) / (12.0 * h);
            let error = (slope - force[i]).abs() / largest(&force.0);
            assert!(error < 1e-9, "{theory:?}, {i}: {error:e}");
        }
    }
}

/// Differences of the forces by displacement, velocity and acceleration, against the tangent.
#[test]
fn the_tangent_is_the_derivative_of_the_forces() {
    let damping = Damping { mass: 3.0, stiffness: 0.02 };
    for theory in THEORIES {
        let element = element(theory);
        for (which, weights) in [
            ("displacement", Weights { acceleration: 0.0, velocity: 0.0, displacement: 1.0 }),
            ("velocity", Weights { acceleration: 0.0, velocity: 1.0, displacement: 0.0 }),
            ("acceleration", Weights { acceleration: 1.0, velocity: 0.0, displacement: 0.0 }),
        ] {
            let at = |j: usize, step: f64| {
                let mut motion = Motion { q: Q, v: V, a: A };
                match which {
                    "displacement" => motion.q[j] += step,
                    "velocity" => motion.v[j] += step,
                    _ => motion.a[j] += step,
                }
                response(&element, &motion, &damping, None).0
            };
            let motion = Motion { q: Q, v: V, a: A };
            let tangent = response(&element, &motion, &damping, Some(weights)).1.unwrap();
            let scale = largest(tangent.0.as_flattened());
            // Of first and second degree in acceleration and velocity: no truncation, so large steps.
            let h = if which == "displacement" { 1e-4 } else { 10.0 };
            for j in 0..6 {
                let (near, far) = ((at(j, h), at(j, -h)), (at(j, 2.0 * h), at(j, -2.0 * h)));
                for i in 0..6 {
                    let slope = (8.0 * (near.0[i] - near.1[i]) - (far.0[i] - far.1[i])) / (12.0 * h);
                    let error = (slope - tangent[(i, j)]).abs() / scale;
                    assert!(error < 1e-9, "{theory:?}, {which}, {i}{j}: {slope} against {}", tangent[(i, j)]);
                }
            }
        }
    }
}

/// A rigid motion rotates the forces with the element, and alone causes none.
#[test]
fn forces_do_not_depend_on_rigid_motion() {
    for theory in THEORIES {
        let element = element(theory);
        let [x, y] = [0.5, 0.3];
        for turn in [0.4, 3.0, -9.0, 100.0] {
            let (sine, cosine) = f64::sin_cos(turn);
            let moved = |q: &Ends| -> Ends {
                // Node 1 at the origin, node 2 at (x, y): rotated about the origin and translated.
                let (u1, w1, u2, w2) = (q[0], q[1], x + q[3], y + q[4]);
                Ends([
                    cosine * u1 - sine * w1 + 5.0,
                    sine * u1 + cosine * w1 - 2.0,
                    q[2] + turn,
                    cosine * u2 - sine * w2 - x + 5.0,
                    sine * u2 + cosine * w2 - y - 2.0,
                    q[5] + turn,
                ])
            };
            let expected = rotate(&statics(&element, Q), cosine, sine);
            let ours = statics(&element, moved(&Q));
            let stiffness = element.stiffness[0] * element.length;
            for i in 0..6 {
                assert!((ours[i] - expected[i]).abs() < 1e-13 * stiffness, "{turn}: {ours:?}, {expected:?}");
            }
            for force in statics(&element, moved(&Ends::ZERO)).0 {
                assert!(force.abs() < 1e-13 * stiffness, "{turn}: {force}");
            }
        }
    }
}

/// Lagrange: forces of inertia are d/dt dT/dv - dT/dq, by differences of the kinetic energy along the motion.
#[test]
fn inertia_forces_are_those_of_the_kinetic_energy() {
    for theory in THEORIES {
        let element = element(theory);
        let motion = Motion { q: Q, v: V, a: A };
        let total = response(&element, &motion, &Damping::default(), None).0;
        let elastic = statics(&element, Q);
        let h = 1e-4;
        let at = |t: f64| {
            let (q, v) = (Q + t * V + 0.5 * t * t * A, V + t * A);
            momentum(&element, &q, &v).1
        };
        let rate = 1.0 / (12.0 * h) * (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h)));
        for i in 0..6 {
            let energy = |step: f64| {
                let mut q = Q;
                q[i] += step;
                momentum(&element, &q, &V).0
            };
            let slope = (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h))) / (12.0 * h);
            let (ours, expected) = (total[i] - elastic[i], rate[i] - slope);
            let error = (ours - expected).abs() / largest(&rate.0);
            assert!(error < 1e-9, "{theory:?}, {i}: {ours} against {expected}");
        }
    }
}

/// A chord updated from another one equals the chord of its end values, for small rotations (series) and large ones.
#[test]
fn a_moved_chord_is_the_chord_there() {
    let element = element(Theory::EulerBernoulli);
    let from = Chord::new(&element, &Q);
    for share in [0.0, 1e-9, 1e-3, 0.02, 0.2] {
        let q = Q + share * V;
        let there = Chord::new(&element, &q);
        let (moved, turn, ratio) = Chord::moved(&element, &from, &Q, &q);
        let [a, b] = [from.direction, there.direction];
        let sine = a[0] * b[1] - a[1] * b[0];
        assert!((turn.sin() - sine).abs() < 1e-15 && (ratio * sine - turn).abs() < 1e-15, "{share}: {turn}");
        assert_eq!((moved.length, moved.direction), (there.length, there.direction));
        for (moved, there) in moved.deformation.iter().zip(there.deformation) {
            assert!((moved - there).abs() < 2e-15, "{share}: {moved} against {there}");
        }
    }
}
