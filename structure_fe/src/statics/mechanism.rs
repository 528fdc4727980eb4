//! Does a support set hold the model?
//!
//! Joints are rigid, so a displacement costs no elastic energy exactly when every connected part
//! moves as a rigid body: K is positive definite if and only if the supports of every part stop its
//! three rigid motions; parts that hinges join are asked together. That is three numbers per part,
//! asked of the geometry. A Cholesky
//! factorisation cannot be asked: its last pivot is rounding noise, as often positive as not.

use crate::beam::Beam;
use crate::error::Error;
use crate::supports::Supports;
use faer::{Mat, Side};

/// A rigid motion is free if the supports stop less than this of it, as a fraction of the elastic
/// stiffness and in the mean square over the part: lever arms below 1e-6 of the part's size, or
/// springs softer than 1e-12 of the elements they hold, would lose all digits of the answer.
const FREE: f64 = 1e-12;

/// The error that names a free rigid motion, if the supports leave one.
pub(crate) fn require_no_free_motion(beam: &Beam, supports: &Supports) -> Result<(), Error> {
    supports.check(beam)?;
    let clamped = supports.ties().iter().filter(|(.., turns)| *turns).map(|&(body, node, _)| [body, node]);
    let rigid =
        beam.elements().iter().map(|element| element.nodes).chain(clamped).chain(supports.welds().iter().copied());
    let part = connected_parts(beam.nodes().len(), rigid.clone());
    let restraint = restraint_of_degrees_of_freedom(beam, supports);
    // Parts that hinges join stand or fall together. A group is known by its first node.
    let pinned = supports.ties().iter().filter(|(.., turns)| !turns).map(|&(body, node, _)| [body, node]);
    let links = rigid.chain(supports.hinges().iter().copied()).chain(pinned);
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

/// For each node the first node of the connected part it belongs to.
fn connected_parts(nodes: usize, links: impl Iterator<Item = [usize; 2]>) -> Vec<usize> {
    let mut part: Vec<usize> = (0..nodes).collect();
    let root = |part: &[usize], mut node: usize| {
        while part[node] != node {
            node = part[node];
        }
        node
    };
    for link in links {
        let [a, b] = link.map(|node| root(&part, node));
        part[a.max(b)] = a.min(b);
    }
    (0..part.len()).map(|node| root(&part, node)).collect()
}

/// How firmly each degree of freedom is held, `[nodes][u, w, theta]`: 1 if fixed, k/(k + K_ii) on a spring.
fn restraint_of_degrees_of_freedom(beam: &Beam, supports: &Supports) -> Vec<[f64; 3]> {
    let mut elastic = vec![[0.0; 3]; beam.nodes().len()];
    for (nodes, element) in beam.formulated() {
        let stiffness = element.stiffness();
        let diagonal = std::array::from_fn(|i| stiffness[i][i]);
        crate::beam::add_ends(&mut elastic, nodes, &diagonal);
    }
    let mut spring_stiffness = vec![[0.0; 3]; elastic.len()];
    for spring in supports.springs() {
        spring_stiffness[spring.node][spring.dof as usize] += spring.stiffness;
    }
    let mut restraint = spring_stiffness;
    for (held, elastic) in restraint.iter_mut().zip(&elastic) {
        for dof in 0..3 {
            // A rigid body has no elements of its own.
            if held[dof] > 0.0 {
                held[dof] /= held[dof] + elastic[dof];
            }
        }
    }
    for &(node, dof) in supports.fixed() {
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

    /// Unit motions of a member: along x, along y, and the rotation that moves the farthest node by one.
    fn unit_motions(&self, member: usize) -> [[f64; 3]; 3] {
        self.unit_motions_at(self.nodes[member])
    }

    /// The same of any place that moves with the part.
    fn unit_motions_at(&self, place: [f64; 2]) -> [[f64; 3]; 3] {
        let [x, y] = [0, 1].map(|axis| (place[axis] - self.centre[axis]) / self.radius);
        [[1.0, 0.0, -y], [0.0, 1.0, x], [0.0, 0.0, 1.0]]
    }
}

/// A rigid motion of the parts that supports and hinges do not stop: a node, and its `[u, w, theta]`.
fn free_motion(
    parts: &[Part],
    supports: &Supports,
    restraint: &[[f64; 3]],
) -> Result<Option<(usize, [f64; 3])>, Error> {
    let unknowns = 3 * parts.len();
    let mut stopped = Mat::<f64>::zeros(unknowns, unknowns);
    let mut stop = |row: &[(usize, f64)], held: f64| {
        for &(i, a) in row {
            for &(j, b) in row {
                stopped[(i, j)] += held * a * b;
            }
        }
    };
    let row_of = |index: usize, row: [f64; 3], sign: f64| [0, 1, 2].map(|k| (3 * index + k, sign * row[k]));
    for (index, part) in parts.iter().enumerate() {
        for (member, &node) in part.members.iter().enumerate() {
            for (row, held) in part.unit_motions(member).into_iter().zip(restraint[node]) {
                stop(&row_of(index, row, 1.0), held);
            }
        }
    }
    let place = |node: usize| {
        parts.iter().enumerate().find_map(|(index, part)| Some((index, part.members.binary_search(&node).ok()?)))
    };
    for hinge in supports.hinges() {
        if let [Some((one, here)), Some((other, there))] = hinge.map(place) {
            for dof in 0..2 {
                let ours = row_of(one, parts[one].unit_motions(here)[dof], 1.0);
                let theirs = row_of(other, parts[other].unit_motions(there)[dof], -1.0);
                stop(&[ours, theirs].concat(), 1.0);
            }
        }
    }
    for &(body, node, turns) in supports.ties() {
        if let (false, [Some((one, _)), Some((other, there))]) = (turns, [body, node].map(place)) {
            let at = parts[other].nodes[there];
            for dof in 0..2 {
                let ours = row_of(one, parts[one].unit_motions_at(at)[dof], 1.0);
                let theirs = row_of(other, parts[other].unit_motions(there)[dof], -1.0);
                stop(&[ours, theirs].concat(), 1.0);
            }
        }
    }
    let eigen = stopped
        .self_adjoint_eigen(Side::Lower)
        .map_err(|error| Error::LinearAlgebra { unknowns, reason: format!("{error:?}") })?;
    if eigen.S()[0] > FREE {
        return Ok(None);
    }
    let free = eigen.U().col(0);
    let share = |index: usize| (0..3).map(|k| free[3 * index + k].powi(2)).sum::<f64>();
    let moving = (0..parts.len()).fold(0, |most, index| if share(index) > share(most) { index } else { most });
    let part = &parts[moving];
    let [u, w, turn] = part.unit_motions(0).map(|row| (0..3).map(|k| row[k] * free[3 * moving + k]).sum::<f64>());
    Ok(Some((part.members[0], [u, w, turn / part.radius])))
}
