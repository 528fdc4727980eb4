//! Lumped masses of linked nodes, concentrated at their rigid bodies.

use super::lumped_mass::{correct_ends, nodal_masses};
use crate::dof::Dof;
use crate::error::Error;
use crate::field::Field;
use crate::model::{Beam, Supports};

/// Masses of the nodes `[nodes][m, m, J]` \[kg, kg, kg m^2\], and the model with the nodes of its bodies moved.
///
/// The node of a body moves to the common centre of mass of the body and of the masses lumped at its linked nodes, which
/// then have none: its mass is diagonal and does not change with rotation (THEORY BE20). If u and w of the body are both
/// supported the node stays: the body rotates about it.
pub(super) fn concentrate_at_bodies(mut beam: Beam, supports: &Supports) -> Result<(Beam, Field), Error> {
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
