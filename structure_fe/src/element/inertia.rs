//! Inertia and damping of the moving element.
//!
//! The mass matrix rotates with the chord, M(q) = R M_0 R^T. Lagrange's equations for the kinetic energy v^T M(q) v/2
//! give M a and terms in the angular velocity of the chord, which conserve momentum and energy in large rotations
//! (THEORY BE12; compare Le, Battini & Hjiaj 2011, who also rotate the shape functions with the local deflection).

use super::mass::mass_times;
use super::{Chord, ElementConstants, Ends, EndsMatrix};
use super::{add_deformation_matrix, add_elastic_tangent, deformation_forces, end_forces};

/// Rayleigh damping, a_M M + a_K K, with K of the deformations, so that a rigid rotation is not damped by a_K
/// (THEORY BE13).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Damping {
    /// Coefficient a_M of the mass \[1/s\], not negative: damps slow vibration. In a model with rigid bodies it acts on the
    /// velocity against the body that holds a node, so that it damps no rigid motion; without, against the ground.
    pub mass: f64,
    /// Coefficient a_K of the elastic stiffness \[s\], not negative: damps fast vibration.
    pub stiffness: f64,
}

/// Weights of the derivatives by acceleration, velocity and displacement in the tangent.
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

/// J x: the vectors of both ends rotated by a quarter turn to the left, the derivative of a rotation at zero.
#[inline]
fn quarter_turn(x: &Ends) -> Ends {
    Ends([-x[1], x[0], 0.0, -x[4], x[3], 0.0])
}

/// dM/dalpha x = J M x - M J x.
#[inline]
fn mass_by_angle(mass: &EndsMatrix, x: &Ends) -> Ends {
    quarter_turn(&mass_times(mass, x)) - mass_times(mass, &quarter_turn(x))
}

/// Derivative of the chord's angle by the end values, in its axes: dalpha = a_z^T dq.
#[inline]
fn angle_gradient(chord: &Chord) -> Ends {
    let y = 1.0 / chord.length;
    Ends([0.0, -y, 0.0, 0.0, y, 0.0])
}

/// Internal forces of a moving element: inertia, damping and elasticity, in the global axes
/// (THEORY BE11, BE12, BE13); and, if `weights` are given, their tangent.
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
    let a = chord.to_local(&motion.a) + damping.mass * v;
    let mass = &element.mass;
    let dm_v = mass_by_angle(mass, &v);
    let viscous = viscous_forces(element, &chord, &v, damping);

    let inertia =
        mass_times(mass, &a) + chord.angular_velocity(&v) * dm_v - 0.5 * v.dot(&dm_v) * angle_gradient(&chord);
    let elastic = end_forces(&deformation_forces(element, &chord.deformation), chord.length);
    let force = chord.to_global(&(inertia + (elastic + end_forces(&viscous, chord.length))));

    let tangent = weights.map(|weights| {
        let mut sum = inertia_tangent(mass, &chord, &v, &a, damping, &weights);
        add_elastic_tangent(element, &chord, &viscous, weights.displacement, &mut sum);
        if damping.stiffness > 0.0 {
            let d = element.stiffness.map(|stiffness| damping.stiffness * stiffness);
            let diagonal = [d[0], 0.0, 0.0, d[1], 0.0, d[2]];
            add_deformation_matrix(&chord, &diagonal, weights.velocity, &mut sum);
            add_change_of_rates(&chord, &v, &d, weights.displacement, &mut sum);
        }
        chord.matrix_to_global(&sum)
    });
    (force, tangent)
}

/// Forces (N, M_s, M_a) of the stiffness-proportional damping, of end velocities `v` in the chord's axes (THEORY BE13).
#[inline]
pub(crate) fn viscous_forces(element: &ElementConstants, chord: &Chord, v: &Ends, damping: &Damping) -> [f64; 3] {
    let rates = chord.deformation_rates(v);
    [0, 1, 2].map(|i| damping.stiffness * element.stiffness[i] * rates[i])
}

/// Derivatives of the inertia forces, in the chord's axes (THEORY BE12).
#[inline]
fn inertia_tangent(
    mass: &EndsMatrix,
    chord: &Chord,
    v: &Ends,
    a: &Ends,
    damping: &Damping,
    weights: &Weights,
) -> EndsMatrix {
    let omega = chord.angular_velocity(v);
    let mut sum = mass * (weights.acceleration + weights.velocity * damping.mass);
    // omega dM/dalpha: J M exchanges rows of M in pairs, M J its columns.
    for j in 0..6 {
        for end in [0, 3] {
            let [x, y] = [end, end + 1].map(|i| weights.velocity * omega * mass[(i, j)]);
            sum[(end, j)] -= y;
            sum[(end + 1, j)] += x;
            sum[(j, end)] -= y;
            sum[(j, end + 1)] += x;
        }
    }
    let dm_v = mass_by_angle(mass, v);
    let ddm_v = quarter_turn(&dm_v) - mass_by_angle(mass, &quarter_turn(v));
    let gradient = angle_gradient(chord);
    let by_angle = mass_by_angle(mass, a) + omega * ddm_v - 0.5 * v.dot(&ddm_v) * gradient;
    // The change of a_z: G = -(r z^T + z r^T)/l^2, and G v.
    let l2 = chord.length.powi(2);
    let (stretch, across) = ((v[3] - v[0]) / l2, (v[4] - v[1]) / l2);
    // a_z has entries for w1 and w2 only, G v for the displacements.
    let y = gradient[4];
    for i in 0..6 {
        let by_gradient = y * (weights.velocity * dm_v[i] + weights.displacement * by_angle[i]);
        let by_change = weights.displacement * dm_v[i];
        sum[(i, 0)] += by_change * across;
        sum[(i, 1)] += by_change * stretch - by_gradient;
        sum[(i, 3)] -= by_change * across;
        sum[(i, 4)] += by_gradient - by_change * stretch;
    }
    for j in 0..6 {
        let by_velocity = y * weights.velocity * dm_v[j];
        sum[(1, j)] += by_velocity;
        sum[(4, j)] -= by_velocity;
    }
    let couple = weights.displacement * (0.5 * v.dot(&dm_v)) / l2;
    for (i, sign_i) in [(0, -1.0), (3, 1.0)] {
        for (j, sign_j) in [(0, -1.0), (3, 1.0)] {
            sum[(i, j + 1)] += sign_i * sign_j * couple;
            sum[(i + 1, j)] += sign_i * sign_j * couple;
        }
    }
    sum
}

/// Adds weight B^T D times the change of the deformations' rates by the end values.
#[inline]
fn add_change_of_rates(chord: &Chord, v: &Ends, d: &[f64; 3], weight: f64, sum: &mut EndsMatrix) {
    let l2 = chord.length.powi(2);
    let (stretch, across) = ((v[3] - v[0]) / l2, (v[4] - v[1]) / l2);
    let omega = chord.angular_velocity(v);
    let elongation = end_forces(&[weight * d[0], 0.0, 0.0], chord.length);
    let ess = end_forces(&[0.0, 0.0, weight * d[2]], chord.length);
    let of_elongation = [0.0, -omega, 0.0, 0.0, omega, 0.0];
    let of_ess = [-across, -stretch, 0.0, across, stretch, 0.0];
    for i in 0..6 {
        for j in 0..6 {
            sum[(i, j)] += elongation[i] * of_elongation[j] + ess[i] * of_ess[j];
        }
    }
}

/// Kinetic energy of a moving element \[J\] and its momentum M(q) v in the global axes.
pub(crate) fn momentum(element: &ElementConstants, q: &Ends, v: &Ends) -> (f64, Ends) {
    let chord = Chord::new(element, q);
    let local = chord.to_local(v);
    let momentum = mass_times(&element.mass, &local);
    (0.5 * local.dot(&momentum), chord.to_global(&momentum))
}
