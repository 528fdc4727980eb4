//! Lumped masses of tied nodes, gathered at their rigid bodies.

use crate::beam::Beam;
use crate::error::Error;
use crate::lumped::{correct_ends, nodal_masses};
use crate::supports::{Dof, Supports};

/// Masses of the nodes `[nodes][m, m, J]` \[kg, kg, kg m^2\], and the model with its bodies' nodes moved.
///
/// A body's node goes to the common centre of mass of the body and of what is lumped at the nodes tied to it,
/// which then have none of their own: so its mass is diagonal and does not change as it turns (THEORY S21).
/// Where u and w are both supported the node stays: the body turns about it.
pub(crate) fn gather(mut beam: Beam, supports: &Supports) -> Result<(Beam, Vec<[f64; 3]>), Error> {
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
        let tied: Vec<(usize, bool)> =
            supports.ties().iter().filter(|tie| tie.0 == body).map(|&(_, node, turns)| (node, turns)).collect();
        let places = beam.nodes();
        let held = fixed[0] && fixed[1];
        let members = || std::iter::once(body).chain(tied.iter().map(|&(node, _)| node));
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
        let turning: f64 = tied.iter().filter(|(_, turns)| *turns).map(|&(node, _)| nodal[node][2]).sum();
        let inertia = members().map(about).sum::<f64>() + own[2] + turning;
        if !fixed[2] && inertia == 0.0 {
            let quantity = "moment of inertia [kg m^2]";
            return Err(Error::MasslessBody { node: body, dof: Dof::Theta, quantity, value: inertia });
        }
        if !held {
            nodal[body] = [mass, mass, inertia];
            for (node, turns) in tied {
                nodal[node] = [0.0, 0.0, if turns { 0.0 } else { nodal[node][2] }];
            }
            beam.move_body(body, centre);
        }
    }
    Ok((beam, nodal))
}
