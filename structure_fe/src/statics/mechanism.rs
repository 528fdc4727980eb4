//! Detection of mechanisms: rigid motions that the supports leave free (THEORY BE9).
//!
//! Joints are rigid, so a displacement has no elastic energy exactly if every connected part moves as a rigid body: K is
//! positive definite if and only if the supports of every part restrain its three rigid motions; parts joined by hinges
//! are examined together. This takes three unknowns per part. The pivots of a Cholesky factorisation do not decide it:
//! the last one is rounding noise of either sign.

use crate::error::Error;
use crate::linear_algebra::connected_parts;
use crate::model::{Beam, Supports, add_ends};
use faer::{Mat, Side};

/// A rigid motion is free if the restraint, as a fraction of the elastic stiffness and in the mean square over the part,
/// is below this \[-\]: lever arms below 1e-6 of the part's size, or springs softer than 1e-12 of their elements, leave
/// no correct digits in the solution.
const FREE: f64 = 1e-12;

/// The error that names a free rigid motion, if the supports leave one.
pub(crate) fn require_no_free_motion(beam: &Beam, supports: &Supports) -> Result<(), Error> {
    supports.check(beam)?;
    if let Some(connection) = supports.connections.first() {
        let (analysis, feature, item, index) = ("statics", "connectors", "node", connection.node);
        return Err(Error::Unsupported { analysis, feature, item, index, instead: "Dynamics" });
    }
    let clamped = supports.links.iter().filter(|(.., clamped)| *clamped).map(|&(body, node, _)| [body, node]);
    let rigid =
        beam.elements().iter().map(|element| element.nodes).chain(clamped).chain(supports.welds.iter().copied());
    let part = connected_parts(beam.nodes().len(), rigid.clone());
    let restraint = restraint_of_degrees_of_freedom(beam, supports);
    // Parts joined by hinges form a group. The first node of a group or part identifies it.
    let pinned = supports.links.iter().filter(|(.., clamped)| !clamped).map(|&(body, node, _)| [body, node]);
    let links = rigid.chain(supports.hinges.iter().copied()).chain(pinned);
    let group = connected_parts(beam.nodes().len(), links);
    for first in (0..group.len()).filter(|&node| group[node] == node) {
        let parts: Vec<Part> = (first..group.len())
            .filter(|&node| group[node] == first && part[node] == node)
            .map(|known_by| Part::new(beam, (known_by..part.len()).filter(|&n| part[n] == known_by).collect()))
            .collect();
        if let Some((node, motion)) = free_motion(&parts, supports, &restraint)? {
            return Err(Error::UnderSupported { node, motion });
        }
    }
    Ok(())
}

/// Restraint of each degree of freedom, `[nodes][u, w, theta]` \[-\]: 1 if fixed, k/(k + K_ii) on a spring.
fn restraint_of_degrees_of_freedom(beam: &Beam, supports: &Supports) -> Vec<[f64; 3]> {
    let mut elastic = vec![[0.0; 3]; beam.nodes().len()];
    for (nodes, element) in beam.constants() {
        add_ends(&mut elastic, nodes, &element.stiffness().diagonal());
    }
    let mut restraint = vec![[0.0; 3]; elastic.len()];
    for spring in &supports.springs {
        restraint[spring.node][spring.dof as usize] += spring.stiffness;
    }
    for (held, elastic) in restraint.iter_mut().zip(&elastic) {
        for dof in 0..3 {
            // A rigid body has no elements of its own.
            if held[dof] > 0.0 {
                held[dof] /= held[dof] + elastic[dof];
            }
        }
    }
    for &(node, dof) in &supports.fixed {
        restraint[node][dof as usize] = 1.0;
    }
    restraint
}

/// A connected part: its nodes, and its unit motions as displacements of a node.
struct Part {
    members: Vec<usize>,
    centre: [f64; 2],
    radius: f64,
    nodes: Vec<[f64; 2]>,
}

impl Part {
    fn new(beam: &Beam, members: Vec<usize>) -> Self {
        let nodes: Vec<[f64; 2]> = members.iter().map(|&node| beam.nodes()[node]).collect();
        let centre = [0, 1].map(|axis| nodes.iter().map(|node| node[axis]).sum::<f64>() / nodes.len() as f64);
        let radius = nodes.iter().map(|node| (node[0] - centre[0]).hypot(node[1] - centre[1])).fold(0.0, f64::max);
        // A rigid body alone is one node.
        let radius = if radius > 0.0 { radius } else { beam.extent() };
        Self { members, centre, radius, nodes }
    }

    /// Unit motions of a place: along x, along y, and the rotation that moves the farthest node by one.
    fn unit_motions(&self, place: [f64; 2]) -> [[f64; 3]; 3] {
        let [x, y] = [0, 1].map(|axis| (place[axis] - self.centre[axis]) / self.radius);
        [[1.0, 0.0, -y], [0.0, 1.0, x], [0.0, 0.0, 1.0]]
    }
}

/// A rigid motion of the parts that supports and hinges leave free: a node, and its `[u, w, theta]`.
fn free_motion(
    parts: &[Part],
    supports: &Supports,
    restraint: &[[f64; 3]],
) -> Result<Option<(usize, [f64; 3])>, Error> {
    let unknowns = 3 * parts.len();
    let mut restrained = Mat::<f64>::zeros(unknowns, unknowns);
    let mut restrain = |row: &[(usize, f64)], stiffness: f64| {
        for &(i, a) in row {
            for &(j, b) in row {
                restrained[(i, j)] += stiffness * a * b;
            }
        }
    };
    let row_of = |index: usize, row: [f64; 3], sign: f64| [0, 1, 2].map(|k| (3 * index + k, sign * row[k]));
    for (index, part) in parts.iter().enumerate() {
        for (place, &node) in part.nodes.iter().zip(&part.members) {
            for (row, stiffness) in part.unit_motions(*place).into_iter().zip(restraint[node]) {
                restrain(&row_of(index, row, 1.0), stiffness);
            }
        }
    }
    let find = |node: usize| {
        parts.iter().enumerate().find_map(|(index, part)| Some((index, part.members.binary_search(&node).ok()?)))
    };
    let pinned = supports.links.iter().filter(|(.., clamped)| !clamped).map(|&(body, node, _)| [body, node]);
    for joint in supports.hinges.iter().copied().chain(pinned) {
        if let [Some((one, _)), Some((other, there))] = joint.map(find) {
            // A body's motion is that of its point at the joint.
            let place = parts[other].nodes[there];
            let [ours, theirs] = [one, other].map(|index| parts[index].unit_motions(place));
            for dof in 0..2 {
                restrain(&[row_of(one, ours[dof], 1.0), row_of(other, theirs[dof], -1.0)].concat(), 1.0);
            }
        }
    }
    let eigen = restrained
        .self_adjoint_eigen(Side::Lower)
        .map_err(|error| Error::LinearAlgebra { unknowns, reason: format!("{error:?}") })?;
    if eigen.S()[0] > FREE {
        return Ok(None);
    }
    let free = eigen.U().col(0);
    let share = |index: usize| (0..3).map(|k| free[3 * index + k].powi(2)).sum::<f64>();
    let moving = (0..parts.len()).fold(0, |most, index| if share(index) > share(most) { index } else { most });
    let part = &parts[moving];
    let [u, w, turn] =
        part.unit_motions(part.nodes[0]).map(|row| (0..3).map(|k| row[k] * free[3 * moving + k]).sum::<f64>());
    Ok(Some((part.members[0], [u, w, turn / part.radius])))
}
