//! Does a support set hold the model?
//!
//! Joints are rigid, so a displacement costs no elastic energy exactly when every connected part
//! moves as a rigid body: K is positive definite if and only if the supports of every part stop its
//! three rigid motions. That is three numbers per part, asked of the geometry. A Cholesky
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
    let part = connected_parts(beam);
    let restraint = restraint_of_degrees_of_freedom(beam, supports);
    // A part is known by its first node.
    for first in (0..part.len()).filter(|&node| part[node] == node) {
        let members: Vec<usize> = (first..part.len()).filter(|&n| part[n] == first).collect();
        if let Some(motion) = free_motion(beam, &members, &restraint)? {
            return Err(Error::UnderSupported { node: first, motion });
        }
    }
    Ok(())
}

/// For each node the first node of the connected part it belongs to.
fn connected_parts(beam: &Beam) -> Vec<usize> {
    let mut part: Vec<usize> = (0..beam.nodes().len()).collect();
    let root = |part: &[usize], mut node: usize| {
        while part[node] != node {
            node = part[node];
        }
        node
    };
    for element in beam.elements() {
        let [a, b] = element.nodes.map(|node| root(&part, node));
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
            held[dof] /= held[dof] + elastic[dof];
        }
    }
    for &(node, dof) in supports.fixed() {
        restraint[node][dof as usize] = 1.0;
    }
    restraint
}

/// A rigid motion of the part that its supports do not stop, as `[u, w, theta]` of its first node.
fn free_motion(beam: &Beam, members: &[usize], restraint: &[[f64; 3]]) -> Result<Option<[f64; 3]>, Error> {
    let nodes = beam.nodes();
    let centre = [0, 1].map(|axis| members.iter().map(|&node| nodes[node][axis]).sum::<f64>() / members.len() as f64);
    let arm = |node: usize| [0, 1].map(|axis| nodes[node][axis] - centre[axis]);
    let radius = members.iter().map(|&node| arm(node)[0].hypot(arm(node)[1])).fold(0.0, f64::max);
    // Unit motions: along x, along y, and the rotation that moves the farthest node by one.
    let unit_motions = |node: usize| {
        let [x, y] = arm(node).map(|component| component / radius);
        [[1.0, 0.0, -y], [0.0, 1.0, x], [0.0, 0.0, 1.0]]
    };
    let mut stopped = Mat::<f64>::zeros(3, 3);
    for &node in members {
        for (row, held) in unit_motions(node).iter().zip(restraint[node]) {
            for i in 0..3 {
                for j in 0..3 {
                    stopped[(i, j)] += held * row[i] * row[j];
                }
            }
        }
    }
    let eigen = stopped
        .self_adjoint_eigen(Side::Lower)
        .map_err(|error| Error::LinearAlgebra { unknowns: 3, reason: format!("{error:?}") })?;
    if eigen.S()[0] > FREE {
        return Ok(None);
    }
    let free = eigen.U().col(0);
    let [u, w, turn] = unit_motions(members[0]).map(|row| (0..3).map(|k| row[k] * free[k]).sum::<f64>());
    Ok(Some([u, w, turn / radius]))
}
