//! H for a host's nodes: surface points are attached to the sides, straight from node to node or bent by the nodes' rotations
//! (THEORY CO13, CO30).

use super::nodes::HostNodes;
use super::topology::{Anchor, Topology, WetSurface};
use crate::bodies::bending::beam_surface::{BeamAttachment, BeamSurface, Place};
use crate::geometry::vector::{cross, rotate};

/// Most straight pieces that the outline of a bent side is drawn with.
const PIECES: f64 = 8.0;

/// The sides of the wet surfaces. Each has two ends of its own, which nodes carry: an end moves and turns with its node, or, where
/// nodes have no rotations, turns as the side itself (CO30).
#[derive(Clone, Debug)]
pub(super) struct NodeMap {
    ends: BeamSurface,
    sides: Vec<[Anchor; 2]>,
    /// Positions and rotations of the ends at t = 0.
    start: Vec<[f64; 3]>,
    /// From the nodes to the ends at t = 0 [m]; zero for sides from node to node.
    arms: Vec<[f64; 2]>,
    rotations: bool,
}

/// Motion of the ends: displacements and velocities, three values each.
pub(super) struct Ends {
    pub q: Vec<[f64; 3]>,
    pub rate: Vec<[f64; 3]>,
}

impl NodeMap {
    /// Of a topology that has been checked; `nodes` are those at t = 0.
    pub fn new(topology: &Topology, nodes: &HostNodes) -> NodeMap {
        let sides = topology.sides();
        let angle = |node: usize| nodes.rotation.get(node).copied().unwrap_or(0.0);
        let start: Vec<[f64; 3]> = sides.iter().flatten().map(|end| [end.at[0], end.at[1], angle(end.node)]).collect();
        let arm = |end: &Anchor| [0, 1].map(|k| end.at[k] - topology.nodes[end.node][k]);
        let arms = sides.iter().flatten().map(arm).collect();
        let elements = (0..sides.len()).map(|side| [2 * side, 2 * side + 1]).collect();
        let ends = BeamSurface::new(start.iter().map(|[x, y, _]| [*x, *y]).collect(), elements);
        NodeMap { ends, sides, start, arms, rotations: topology.rotations }
    }

    /// The attachment of a point at t = 0.
    pub fn attach(&self, at: [f64; 2], normal: [f64; 2]) -> BeamAttachment {
        self.ends.attach(at, normal)
    }

    /// Attachments of the corners of a line at t = 0 [m]; where nodes turn, its sides are divided at about `spacing` [m].
    pub fn along(&self, line: &[[f64; 2]], spacing: f64) -> Vec<BeamAttachment> {
        let mut points = Vec::new();
        for pair in line.windows(2) {
            let way = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
            let pieces = if self.rotations { (way[0].hypot(way[1]) / spacing).ceil().max(1.0) } else { 1.0 };
            points.extend((0..pieces as usize).map(|k| [0, 1].map(|i| pair[0][i] + way[i] * k as f64 / pieces)));
        }
        points.extend(line.last());
        points.into_iter().map(|at| self.attach(at, [0.0; 2])).collect()
    }

    /// A place of side `side`, a share `t` of it from its first node.
    pub fn on_side(side: usize, t: f64) -> BeamAttachment {
        BeamAttachment { element: side, t, beyond: 0.0, offset: 0.0, normal: [0.0, 1.0] }
    }

    /// The point of a place [m] near the surface where it is now, on the sides' chords.
    pub fn attach_now(&self, at: [f64; 2], ends: &Ends) -> BeamAttachment {
        let moved = self.start.iter().zip(&ends.q).map(|(x, q)| [x[0] + q[0], x[1] + q[1]]).collect();
        let elements = (0..self.sides.len()).map(|side| self.ends.ends(side)).collect();
        BeamSurface::new(moved, elements).attach(at, [0.0; 2])
    }

    /// Where the first (0) or second (1) end of a side is at t = 0 [m].
    fn start_of(&self, side: usize, end: usize) -> [f64; 2] {
        let [x, y, _] = self.start[2 * side + end];
        [x, y]
    }

    /// Corners of the outline; a side between nodes that turn is divided at about `spacing` [m].
    pub fn corners(&self, topology: &Topology, spacing: f64) -> Vec<Vec<BeamAttachment>> {
        let (mut corners, mut first) = (Vec::new(), 0);
        for (surface, corner_points) in topology.surfaces.iter().zip(topology.loops()) {
            let (nodes, sides) = surface.counts();
            let along = if matches!(surface, WetSurface::Plate { .. }) { 0..0 } else { first..first + sides };
            let mut attachments = Vec::new();
            for side in along.clone() {
                let ends = [self.start_of(side, 0), self.start_of(side, 1)];
                let length = (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]);
                let pieces = if topology.rotations { (length / spacing).ceil().clamp(1.0, PIECES) } else { 1.0 };
                attachments.extend((0..pieces as usize).map(|k| NodeMap::on_side(side, k as f64 / pieces)));
            }
            if nodes > sides && !along.is_empty() {
                attachments.push(NodeMap::on_side(first + sides - 1, 1.0));
            }
            let drawn = if along.is_empty() { 0 } else { nodes };
            attachments.extend(corner_points[drawn..].iter().map(|at| self.attach(*at, [0.0; 2])));
            corners.push(attachments);
            first += sides;
        }
        corners
    }

    /// The ends' motion when the nodes move like this.
    pub fn ends(&self, nodes: &HostNodes) -> Ends {
        let (mut q, mut rate) = (Vec::with_capacity(self.start.len()), Vec::with_capacity(self.start.len()));
        for (side, pair) in self.sides.iter().enumerate() {
            let turned = |end: usize, node: usize| match self.rotations {
                true => rotate(self.arms[2 * side + end], nodes.rotation[node] - self.start[2 * side + end][2]),
                false => [0.0; 2],
            };
            let arms = [turned(0, pair[0].node), turned(1, pair[1].node)];
            let spin = |node: usize| nodes.spin.get(node).copied().unwrap_or(0.0);
            let at = |k: usize| [0, 1].map(|axis| nodes.position[pair[k].node][axis] + arms[k][axis]);
            let velocity = |k: usize| {
                let (v, spin) = (nodes.velocity[pair[k].node], spin(pair[k].node));
                [v[0] - spin * arms[k][1], v[1] + spin * arms[k][0]]
            };
            let (ends, rates) = ([at(0), at(1)], [velocity(0), velocity(1)]);
            let way = [0, 1].map(|k| ends[1][k] - ends[0][k]);
            let starts = [self.start[2 * side], self.start[2 * side + 1]];
            let rest = [starts[1][0] - starts[0][0], starts[1][1] - starts[0][1]];
            let turn = cross(rest, way).atan2(rest[0] * way[0] + rest[1] * way[1]);
            let apart = [0, 1].map(|k| rates[1][k] - rates[0][k]);
            let turning = cross(way, apart) / (way[0] * way[0] + way[1] * way[1]);
            for (k, start) in starts.iter().enumerate() {
                let [turn, turning] = match self.rotations {
                    true => [nodes.rotation[pair[k].node] - start[2], spin(pair[k].node)],
                    false => [turn, turning],
                };
                q.push([ends[k][0] - start[0], ends[k][1] - start[1], turn]);
                rate.push([rates[k][0], rates[k][1], turning]);
            }
        }
        Ends { q, rate }
    }

    /// Where a point is.
    pub fn place(&self, point: &BeamAttachment, ends: &Ends) -> Place {
        self.ends.place(point, &ends.q)
    }

    /// H q̇ [m/s].
    pub fn velocity(&self, point: &BeamAttachment, ends: &Ends) -> [f64; 2] {
        self.ends.velocity(point, &ends.q, &ends.rate)
    }

    /// Hᵀ f: add forces [N/m] at points to the loads of the nodes, `[nodes][F_x, F_y, M]` [N/m, N/m, N].
    pub fn add_loads<'a>(
        &self,
        forces: impl IntoIterator<Item = (&'a BeamAttachment, [f64; 2])>,
        ends: &Ends,
        loads: &mut [[f64; 3]],
    ) {
        let mut on_ends = vec![[0.0; 3]; self.start.len()];
        for (point, force) in forces {
            self.ends.add_load(point, &ends.q, force, &mut on_ends);
        }
        for (side, pair) in self.sides.iter().enumerate() {
            let couple = if self.rotations { [0.0; 2] } else { self.couple(side, &ends.q, &on_ends) };
            for ((end, anchor), sign) in [2 * side, 2 * side + 1].into_iter().zip(*pair).zip([1.0, -1.0]) {
                let [fx, fy, moment] = on_ends[end];
                let load = &mut loads[anchor.node];
                load[0] += fx + sign * couple[0];
                load[1] += fy + sign * couple[1];
                if self.rotations {
                    load[2] += moment + cross(rotate(self.arms[end], ends.q[end][2]), [fx, fy]);
                }
            }
        }
    }

    /// CO30: the forces across a straight side that have the moment of its ends' moments; on its first node, and the opposite
    /// on its second.
    fn couple(&self, side: usize, q: &[[f64; 3]], loads: &[[f64; 3]]) -> [f64; 2] {
        let at = |end: usize| [0, 1].map(|k| self.start[end][k] + q[end][k]);
        let ([ax, ay], [bx, by]) = (at(2 * side), at(2 * side + 1));
        let (dx, dy) = (bx - ax, by - ay);
        let moment = (loads[2 * side][2] + loads[2 * side + 1][2]) / (dx * dx + dy * dy);
        [moment * dy, -moment * dx]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::embed::Side;

    /// Three nodes that move and turn; a chain through them; places on it and next to it.
    fn moving(rotations: bool) -> (NodeMap, HostNodes, Vec<BeamAttachment>) {
        let rest = vec![[0.1, 0.2], [0.9, 0.5], [1.2, 1.4]];
        let topology = Topology { rotations, ..Topology::of(rest.clone()).open([0, 1, 2], Side::Right, 0.2) };
        let still = HostNodes::at_rest(rest);
        let still = if rotations { still.with_rotations() } else { still };
        let map = NodeMap::new(&topology, &still);
        let points = [[0.4, 0.3], [0.85, 0.6], [1.0, 1.0], [1.3, 1.5], [0.0, 0.1]].map(|at| map.attach(at, [0.6, 0.8]));
        let some = |values: [f64; 3]| if rotations { values.to_vec() } else { Vec::new() };
        let nodes = HostNodes {
            position: vec![[0.4, 0.0], [1.0, 0.65], [0.9, 1.8]],
            velocity: vec![[0.5, -1.0], [-0.3, 0.8], [1.2, 0.4]],
            rotation: some([0.5, 0.9, 1.1]),
            spin: some([2.0, -1.5, 0.7]),
        };
        (map, nodes, points.to_vec())
    }

    /// A node that carries a triangle; places on it and next to it.
    fn carrying() -> (NodeMap, HostNodes, Vec<BeamAttachment>) {
        let rest = vec![[0.3, 0.1]];
        let topology = Topology::of(rest.clone()).turning().carried(0, vec![[0.0, 0.0], [1.0, 0.2], [0.4, 0.9]]);
        let map = NodeMap::new(&topology, &HostNodes::at_rest(rest).with_rotations());
        let points = [[0.4, 0.1], [0.9, 0.3], [0.1, 0.4]].map(|at| map.attach(at, [0.6, 0.8]));
        let nodes = HostNodes {
            position: vec![[0.7, -0.4]],
            velocity: vec![[0.5, -1.0]],
            rotation: vec![1.1],
            spin: vec![-2.0],
        };
        (map, nodes, points.to_vec())
    }

    /// What a node carries moves rigidly.
    #[test]
    fn a_carried_line_is_rigid() {
        let (map, nodes, _) = carrying();
        let ends = map.ends(&nodes);
        for at in [[0.4, 0.1], [0.9, 0.3], [0.1, 0.4], [1.3, 0.0]] {
            let turned = rotate([at[0] - 0.3, at[1] - 0.1], 1.1);
            let found = map.place(&map.attach(at, [0.0; 2]), &ends).at;
            assert!((found[0] - 0.7 - turned[0]).hypot(found[1] + 0.4 - turned[1]) < 1e-14, "{found:?}");
        }
    }

    #[test]
    fn velocities_are_the_places_derivatives() {
        for (map, nodes, points) in [moving(false), moving(true), carrying()] {
            let ahead = |dt: f64| {
                let mut n = nodes.clone();
                n.position.iter_mut().zip(&nodes.velocity).for_each(|(x, v)| *x = [x[0] + dt * v[0], x[1] + dt * v[1]]);
                n.rotation.iter_mut().zip(&nodes.spin).for_each(|(x, v)| *x += dt * v);
                map.ends(&n)
            };
            for point in &points {
                let (after, before) = (map.place(point, &ahead(1e-6)).at, map.place(point, &ahead(-1e-6)).at);
                let v = map.velocity(point, &ahead(0.0));
                for k in 0..2 {
                    assert!(((after[k] - before[k]) / 2e-6 - v[k]).abs() < 1e-8, "{v:?}");
                }
            }
        }
    }

    /// Power, force and moment are the same on both sides of the interface.
    #[test]
    fn what_the_nodes_get_is_what_the_surface_got() {
        for (map, nodes, points) in [moving(false), moving(true), carrying()] {
            let ends = map.ends(&nodes);
            let force = |k: usize| [3.0 - k as f64, 0.5 + k as f64];
            let mut loads = vec![[0.0; 3]; nodes.len()];
            map.add_loads(points.iter().enumerate().map(|(k, point)| (point, force(k))), &ends, &mut loads);
            let mut residual = [0.0; 4];
            for (k, point) in points.iter().enumerate() {
                let (f, v, at) = (force(k), map.velocity(point, &ends), map.place(point, &ends).at);
                let of = [f[0], f[1], at[0] * f[1] - at[1] * f[0], f[0] * v[0] + f[1] * v[1]];
                (0..4).for_each(|i| residual[i] += of[i]);
            }
            for (node, [fx, fy, m]) in loads.iter().enumerate() {
                let (at, v) = (nodes.position[node], nodes.velocity[node]);
                let spin = nodes.spin.get(node).copied().unwrap_or(0.0);
                let of = [*fx, *fy, m + at[0] * fy - at[1] * fx, fx * v[0] + fy * v[1] + m * spin];
                (0..4).for_each(|i| residual[i] -= of[i]);
                assert!(map.rotations || *m == 0.0);
            }
            assert!(residual.iter().all(|l| l.abs() < 1e-12), "{residual:?}");
        }
    }
}
