//! Inertia and damping of the moving element.
//!
//! The element's mass matrix rides on its chord, M(q) = R M_0 R^T, and the inertia forces are those of
//! Lagrange for the kinetic energy v^T M(q) v/2: beside M a the terms that come of the chord's spin,
//! which keep momentum and energy in large rotations (THEORY S12; in the manner of Le, Battini &
//! Hjiaj 2011, whose element also turns its shape functions with the local deflection).

use crate::corotational::{Chord, add_deformation_matrix, add_elastic_tangent, deformation_forces, elastic_forces};
use crate::element::{ElementConstants, Ends, EndsMatrix, dot, end_forces};
use crate::element_mass::ElementMass;

/// Rayleigh damping, a_M M + a_K K, in a form that no rigid rotation strains (THEORY S13).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Damping {
    /// Coefficient a_M of the mass \[1/s\], not negative: damps slow motion, rigid motion too.
    pub mass: f64,
    /// Coefficient a_K of the elastic stiffness \[s\], not negative: damps fast vibration.
    pub stiffness: f64,
}

/// How the tangent weighs the derivatives by acceleration, velocity and displacement.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Weights {
    pub acceleration: f64,
    pub velocity: f64,
    pub displacement: f64,
}

/// Displacement, velocity and acceleration of an element's ends, in the global axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion {
    pub q: Ends,
    pub v: Ends,
    pub a: Ends,
}

/// The ends' vectors turned a quarter turn to the left: the derivative of a turn at no turn.
#[inline]
fn quarter(x: &Ends) -> Ends {
    [-x[1], x[0], 0.0, -x[4], x[3], 0.0]
}

#[inline]
fn combine(x: &Ends, factor: f64, y: &Ends) -> Ends {
    std::array::from_fn(|i| x[i] + factor * y[i])
}

/// dM/dalpha x = J M x - M J x.
#[inline]
fn turned_mass(mass: &ElementMass, x: &Ends) -> Ends {
    combine(&quarter(&mass.times(x)), -1.0, &mass.times(&quarter(x)))
}

/// Derivative of the chord's direction by the end values, in its axes: dalpha = a_z^T dq.
#[inline]
fn turn_gradient(chord: &Chord) -> Ends {
    let y = 1.0 / chord.length;
    [0.0, -y, 0.0, 0.0, y, 0.0]
}

/// Internal forces of a moving element: inertia, damping and elasticity, in the global axes
/// (THEORY S10, S12, S13); and, if `weights` are given, their tangent.
#[inline]
pub(crate) fn response(
    element: &ElementConstants,
    motion: &Motion,
    damping: &Damping,
    weights: Option<Weights>,
) -> (Ends, Option<EndsMatrix>) {
    let chord = Chord::new(element, &motion.q);
    let v = chord.to_local(&motion.v);
    // Mass-proportional damping is a part of the acceleration.
    let a = combine(&chord.to_local(&motion.a), damping.mass, &v);
    let mass = &element.mass;

    let spin = chord.spin(&v);
    let turned = turned_mass(mass, &v);
    let gradient = turn_gradient(&chord);
    let by_turn = 0.5 * dot(&v, &turned);
    let stiffness = element.stiffness;
    let rates = chord.deformation_rates(&v);
    let viscous = [0, 1, 2].map(|i| damping.stiffness * stiffness[i] * rates[i]);

    let inertia = combine(&combine(&mass.times(&a), spin, &turned), -by_turn, &gradient);
    let elastic = combine(&elastic_forces(element, &chord), 1.0, &end_forces(&viscous, chord.length));
    let force = chord.to_global(&combine(&inertia, 1.0, &elastic));

    let tangent = weights.map(|weights| {
        let mut sum = inertia_tangent(mass, &chord, &v, &a, damping, &weights);
        add_elastic_tangent(element, &chord, &viscous, weights.displacement, &mut sum);
        if damping.stiffness > 0.0 {
            let d = stiffness.map(|stiffness| damping.stiffness * stiffness);
            let diagonal = [d[0], 0.0, 0.0, d[1], 0.0, d[2]];
            add_deformation_matrix(&chord, &diagonal, weights.velocity, &mut sum);
            add_change_of_rates(&chord, &v, &d, weights.displacement, &mut sum);
        }
        chord.matrix_to_global(&sum)
    });
    (force, tangent)
}

/// Elastic and stiffness-proportional damping forces alone, in the global axes (THEORY S10, S13).
#[inline]
pub(crate) fn restoring(element: &ElementConstants, q: &Ends, v: &Ends, damping: &Damping) -> Ends {
    let chord = Chord::new(element, q);
    let mut forces = deformation_forces(element, &chord.deformation);
    if damping.stiffness > 0.0 {
        let stiffness = element.stiffness;
        let rates = chord.deformation_rates(&chord.to_local(v));
        for i in 0..3 {
            forces[i] += damping.stiffness * stiffness[i] * rates[i];
        }
    }
    chord.to_global(&end_forces(&forces, chord.length))
}

/// Derivatives of the inertia forces, in the chord's axes (THEORY S12).
#[inline]
fn inertia_tangent(
    mass: &ElementMass,
    chord: &Chord,
    v: &Ends,
    a: &Ends,
    damping: &Damping,
    weights: &Weights,
) -> EndsMatrix {
    let matrix = mass.matrix();
    let (by_matrix, by_spin) =
        (weights.acceleration + weights.velocity * damping.mass, weights.velocity * chord.spin(v));
    let mut sum: EndsMatrix = std::array::from_fn(|i| std::array::from_fn(|j| by_matrix * matrix[i][j]));
    // spin dM/dalpha: J M has rows, M J has columns of M, exchanged in pairs.
    for j in 0..6 {
        for end in [0, 3] {
            let (x, y) = (by_spin * matrix[end][j], by_spin * matrix[end + 1][j]);
            sum[end][j] -= y;
            sum[end + 1][j] += x;
            sum[j][end] -= y;
            sum[j][end + 1] += x;
        }
    }
    let turned = turned_mass(mass, v);
    let twice = combine(&quarter(&turned), -1.0, &turned_mass(mass, &quarter(v)));
    let gradient = turn_gradient(chord);
    let (by_turn, by_turn_twice) = (0.5 * dot(v, &turned), 0.5 * dot(v, &twice));
    let displaced = combine(&combine(&turned_mass(mass, a), chord.spin(v), &twice), -by_turn_twice, &gradient);
    // The change of a_z: G = -(r z^T + z r^T)/l^2, and G v.
    let l2 = chord.length.powi(2);
    let (stretch, across) = ((v[3] - v[0]) / l2, (v[4] - v[1]) / l2);
    // a_z has entries for w1 and w2 only, G v for the displacements.
    let y = gradient[4];
    for i in 0..6 {
        let by_gradient = y * (weights.velocity * turned[i] + weights.displacement * displaced[i]);
        let by_change = weights.displacement * turned[i];
        sum[i][0] += by_change * across;
        sum[i][1] += by_change * stretch - by_gradient;
        sum[i][3] -= by_change * across;
        sum[i][4] += by_gradient - by_change * stretch;
    }
    for j in 0..6 {
        let by_turned = y * weights.velocity * turned[j];
        sum[1][j] += by_turned;
        sum[4][j] -= by_turned;
    }
    let couple = weights.displacement * by_turn / l2;
    for (i, sign_i) in [(0, -1.0), (3, 1.0)] {
        for (j, sign_j) in [(0, -1.0), (3, 1.0)] {
            sum[i][j + 1] += sign_i * sign_j * couple;
            sum[i + 1][j] += sign_i * sign_j * couple;
        }
    }
    sum
}

/// Adds weight B^T D times the change of the deformations' rates by the end values.
#[inline]
fn add_change_of_rates(chord: &Chord, v: &Ends, d: &[f64; 3], weight: f64, sum: &mut EndsMatrix) {
    let l2 = chord.length.powi(2);
    let (stretch, across) = ((v[3] - v[0]) / l2, (v[4] - v[1]) / l2);
    let spin = chord.spin(v);
    let elongation = end_forces(&[weight * d[0], 0.0, 0.0], chord.length);
    let ess = end_forces(&[0.0, 0.0, weight * d[2]], chord.length);
    let of_elongation = [0.0, -spin, 0.0, 0.0, spin, 0.0];
    let of_ess = [-across, -stretch, 0.0, across, stretch, 0.0];
    for i in 0..6 {
        for j in 0..6 {
            sum[i][j] += elongation[i] * of_elongation[j] + ess[i] * of_ess[j];
        }
    }
}

/// Kinetic energy of a moving element \[J\] and its momentum M(q) v in the global axes.
pub(crate) fn momentum(element: &ElementConstants, q: &Ends, v: &Ends) -> (f64, Ends) {
    let chord = Chord::new(element, q);
    let local = chord.to_local(v);
    let momentum = element.mass.times(&local);
    (0.5 * dot(&local, &momentum), chord.to_global(&momentum))
}
