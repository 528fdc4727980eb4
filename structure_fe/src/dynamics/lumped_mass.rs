//! Lumped mass, its concentration at rigid bodies, and the stability limit of the explicit step.

use crate::assembly::System;
use crate::element::{Damping, ElementConstants};
use crate::error::Error;
use crate::field::{Dof, Field};
use crate::model::{Beam, Supports};

/// Mass and moment of inertia at the nodes and by equation.
#[derive(Debug, Clone)]
pub(crate) struct LumpedMass {
    /// `[nodes][m, m, J]` \[kg, kg, kg m^2\].
    pub nodal: Field,
    /// The same by equation, linked nodes with their bodies.
    pub by_equation: Vec<f64>,
    /// The inverse of `by_equation`.
    inverse: Vec<f64>,
    /// The longest stable step \[s\].
    pub stable_dt: f64,
}

impl LumpedMass {
    fn new(nodal: Field, by_equation: Vec<f64>, stable_dt: f64) -> Self {
        let inverse = by_equation.iter().map(|mass| mass.recip()).collect();
        Self { nodal, by_equation, inverse, stable_dt }
    }

    /// Accelerations of forces, by equation.
    pub fn accelerations(&self, forces: &[f64]) -> Vec<f64> {
        forces.iter().zip(&self.inverse).map(|(force, inverse)| force * inverse).collect()
    }
}

/// Half the element's mass at each end, with the moment of inertia m L^2/78 that scaling the consistent
/// diagonal to the mass gives (Hinton, Rock & Zienkiewicz 1976), and its rotatory inertia's half.
fn of_element(element: &ElementConstants) -> [f64; 2] {
    let mass = element.mass_per_length * element.length;
    [0.5 * mass, mass * element.length.powi(2) / 78.0 + 0.5 * mass * element.radius_squared]
}

/// Square of the highest frequency of an element with its lumped mass \[1/s^2\]: of elongation, arc and S.
fn highest_squared(element: &ElementConstants) -> f64 {
    let [mass, inertia] = of_element(element);
    let [axial, arc, ess] = element.stiffness;
    let stretching = 2.0 * axial / mass;
    // psi_s = (theta_1 - theta_2)/2; psi_a = (theta_1 + theta_2)/2 - (w_2 - w_1)/L.
    let bending = 0.5 * arc / inertia;
    let shearing = ess * (0.5 / inertia + 2.0 / (mass * element.length.powi(2)));
    stretching.max(bending).max(shearing)
}

/// Masses lumped at the nodes, points included, `[nodes][m, m, J]` \[kg, kg, kg m^2\].
pub(crate) fn nodal_masses(beam: &Beam) -> Field {
    let mut nodal = beam.points().to_vec();
    for (nodes, element) in beam.constants() {
        let [mass, inertia] = of_element(element);
        for node in nodes {
            nodal[node] = [nodal[node][0] + mass, nodal[node][1] + mass, nodal[node][2] + inertia];
        }
    }
    nodal
}

/// Moves mass between the last three nodes at the ends of chains of elements, so that lumping integrates squares
/// along a chain exactly too (Gregory's rule): 3/8, 7/6, 23/24 of an element's mass where all are alike (THEORY BE21).
///
/// Without it the moment of inertia of a chain is too large by m L^2/6 per end, and frequencies of free ends are too low.
fn correct_ends(beam: &Beam, nodal: &mut [[f64; 3]]) {
    let mut around = vec![Vec::new(); nodal.len()];
    for (index, element) in beam.elements().iter().enumerate() {
        for node in element.nodes {
            around[node].push(index);
        }
    }
    let lengths: Vec<(f64, f64)> =
        beam.constants().map(|(_, element)| (element.length, element.mass_per_length)).collect();
    let beyond = |element: usize, node: usize| {
        let [first, second] = beam.elements()[element].nodes;
        if first == node { second } else { first }
    };
    for end in 0..nodal.len() {
        let &[last] = &around[end][..] else { continue };
        let next = beyond(last, end);
        let &[one, other] = &around[next][..] else { continue };
        let inner = if one == last { other } else { one };
        let ([a, b], [c, d]) = (beam.tangent(last), beam.tangent(inner));
        if (a * c + b * d).abs() < 0.9 {
            continue;
        }
        let third = beyond(inner, next);
        let (h, g) = (lengths[last].0, lengths[inner].0);
        let whole = lengths[last].1 * h * h / 12.0;
        // The slope of a parabola through the three, at the end.
        let to_next = whole * (h + g) / (h * g);
        let from_third = whole * h / (g * (h + g));
        let moved = [(end, from_third - to_next), (next, to_next), (third, -from_third)];
        // With very unequal elements the correction would make masses too small.
        if moved.iter().all(|&(node, mass)| nodal[node][0] + mass > 0.2 * nodal[node][0]) {
            for (node, mass) in moved {
                nodal[node] = [nodal[node][0] + mass, nodal[node][1] + mass, nodal[node][2]];
            }
        }
    }
}

/// Masses of the nodes `[nodes][m, m, J]` \[kg, kg, kg m^2\], and the model with the nodes of its bodies moved.
///
/// The node of a body moves to the common centre of mass of the body and of the masses lumped at its linked nodes, which
/// then have none: its mass is diagonal and does not change with rotation (THEORY BE20). If u and w of the body are both
/// supported the node stays: the body rotates about it.
pub(crate) fn concentrate_at_bodies(mut beam: Beam, supports: &Supports) -> Result<(Beam, Field), Error> {
    supports.check(&beam)?;
    let mut nodal = nodal_masses(&beam);
    correct_ends(&beam, &mut nodal);
    for body in beam.rigid_bodies().to_vec() {
        let own = beam.points()[body];
        let fixed = [Dof::U, Dof::W, Dof::Theta].map(|dof| supports.is_fixed(body, dof));
        for (dof, fixed) in [Dof::U, Dof::W].into_iter().zip(fixed) {
            if !fixed && own[0] == 0.0 {
                return Err(Error::MasslessBody { node: body, dof, quantity: "mass [kg]", value: own[0] });
            }
        }
        let linked: Vec<(usize, bool)> =
            supports.links.iter().filter(|link| link.0 == body).map(|&(_, node, clamped)| (node, clamped)).collect();
        let places = beam.nodes();
        let held = fixed[0] && fixed[1];
        let members = || std::iter::once(body).chain(linked.iter().map(|&(node, _)| node));
        let mass: f64 = members().map(|node| nodal[node][0]).sum();
        let centre = if held {
            places[body]
        } else {
            [0, 1].map(|axis| members().map(|node| nodal[node][0] * places[node][axis]).sum::<f64>() / mass)
        };
        let about = |node: usize| {
            let [x, y] = [0, 1].map(|axis| places[node][axis] - centre[axis]);
            nodal[node][0] * (x * x + y * y)
        };
        let rotary: f64 = linked.iter().filter(|(_, clamped)| *clamped).map(|&(node, _)| nodal[node][2]).sum();
        let inertia = members().map(about).sum::<f64>() + own[2] + rotary;
        if !fixed[2] && inertia == 0.0 {
            let quantity = "moment of inertia [kg m^2]";
            return Err(Error::MasslessBody { node: body, dof: Dof::Theta, quantity, value: inertia });
        }
        if !held {
            nodal[body] = [mass, mass, inertia];
            for (node, clamped) in linked {
                nodal[node] = [0.0, 0.0, if clamped { 0.0 } else { nodal[node][2] }];
            }
            beam.move_body(body, centre);
        }
    }
    Ok((beam, nodal))
}

/// The lumped mass from nodal masses concentrated at the bodies, for a rule without a stability limit.
pub(crate) fn mass_with_bodies(system: &System, nodal: Field) -> LumpedMass {
    let equations = &system.equations;
    let mut by_equation = equations.restrict(&nodal);
    for link in &equations.links.all {
        // The masses at the linked nodes of a body that is supported at its node: its u and w have no equation.
        if let Some(equation) = equations.number(link.body, 2) {
            let [mass, _, inertia] = nodal[link.node];
            let own = if link.clamped { inertia } else { 0.0 };
            by_equation[equation] += own + mass * (link.arm[0].powi(2) + link.arm[1].powi(2));
        }
    }
    LumpedMass::new(nodal, by_equation, f64::INFINITY)
}

/// The lumped mass of a model and its step limit: no frequency of the whole is above the highest of its
/// elements (Irons 1970), springs added; dt = (2/omega) (sqrt(1 + xi^2) - xi) with the damping ratio xi at
/// that frequency, whose force lags by half a step (Belytschko, Liu & Moran 2000, ch. 6; THEORY BE18).
pub(crate) fn explicit_mass(system: &System, damping: &Damping) -> LumpedMass {
    let nodal = nodal_masses(&system.beam);
    let highest = system.beam.constants().fold(0.0, |most: f64, (_, element)| most.max(highest_squared(element)));
    let by_equation = system.equations.restrict(&nodal);
    let mut springs = vec![0.0; by_equation.len()];
    for spring in &system.supports.springs {
        if let Some(equation) = system.equations.number(spring.node, spring.dof as usize) {
            springs[equation] += spring.stiffness;
        }
    }
    let of_springs = springs.iter().zip(&by_equation).map(|(k, m)| k / m).fold(0.0, f64::max);
    let omega = (highest + of_springs).sqrt();
    let ratio = 0.5 * (damping.mass / omega + damping.stiffness * omega);
    let stable_dt = 2.0 / omega * ((1.0 + ratio * ratio).sqrt() - ratio);
    LumpedMass::new(nodal, by_equation, stable_dt)
}
