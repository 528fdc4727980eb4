//! Ruptures at the end of a step: exceeded limits, and the state of bodies whose node has moved (THEORY BE26).

use super::State;
use crate::assembly::System;
use crate::element::rotated;
use crate::model::{Beam, Break, Rupture};

/// The joints of a state that exceed their limits, in the order in which they were declared.
pub(super) fn exceeded(system: &System, state: &State) -> Vec<Break> {
    let joints = &system.supports.breakables;
    let strains = if joints.iter().any(|(_, rupture)| matches!(rupture, Rupture::FibreStrain(_))) {
        system.fibre_strains(&state.displacement, &state.plastic_curvature)
    } else {
        Vec::new()
    };
    let mut breaks = Vec::new();
    for &(node, rupture) in joints {
        let (value, limit) = match rupture {
            Rupture::FibreStrain(limit) => (strain_at(system, node, &strains), limit),
            Rupture::Rotation(limit) => (rotation_of(system, node, state), limit),
        };
        if value > limit {
            let (at, moved) = (system.beam.nodes()[node], state.displacement[node]);
            let place = [at[0] + moved[0], at[1] + moved[1]];
            breaks.push(Break { node, time: state.time, place, value });
        }
    }
    breaks
}

/// Changes the motion of bodies from that of their nodes at `from` to that of their nodes in `beam`.
pub(super) fn move_bodies(beam: &Beam, from: &[[f64; 2]], state: &mut State) {
    for &body in beam.rigid_bodies() {
        let to = beam.nodes()[body];
        let [x, y] = [0, 1].map(|axis| to[axis] - from[body][axis]);
        let (q, v, a) = (state.displacement[body], state.velocity[body], state.acceleration[body]);
        let arm = rotated([x, y], q[2]);
        state.displacement[body] = [q[0] + arm[0] - x, q[1] + arm[1] - y, q[2]];
        state.velocity[body] = [v[0] - v[2] * arm[1], v[1] + v[2] * arm[0], v[2]];
        let centripetal = v[2] * v[2];
        state.acceleration[body] =
            [a[0] - a[2] * arm[1] - centripetal * arm[0], a[1] + a[2] * arm[0] - centripetal * arm[1], a[2]];
    }
}

/// The largest strain of an outer fibre at the ends of elements at a node \[-\].
fn strain_at(system: &System, node: usize, strains: &[[f64; 2]]) -> f64 {
    let ends = system.beam.elements().iter().flat_map(|element| element.nodes);
    let here = ends.zip(strains).filter(|(end, _)| *end == node);
    here.flat_map(|(_, fibres)| fibres).fold(0.0, |most: f64, strain| most.max(strain.abs()))
}

/// Rotation of a node relative to the partner of its hinge, or the body of its link \[rad\].
fn rotation_of(system: &System, node: usize, state: &State) -> f64 {
    let hinges = system.supports.hinges.iter().copied();
    let links = system.supports.links.iter().map(|&(body, node, _)| [node, body]);
    let joints = hinges.flat_map(|[a, b]| [[a, b], [b, a]]).chain(links);
    let partner = joints.into_iter().find(|joint| joint[0] == node);
    let relative_to = partner.map_or(0.0, |[_, other]| state.displacement[other][2]);
    (state.displacement[node][2] - relative_to).abs()
}
