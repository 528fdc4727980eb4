//! H for beams: the elements' shape functions place the boundary particles, the transpose maps their forces to the nodes
//! (THEORY CO13, CO14).

use std::f64::consts::TAU;

use crate::geometry::hermite::hermite;
use crate::geometry::vector::dot;

/// The attachment of a point to a beam structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamAttachment {
    /// Element.
    pub element: usize,
    /// Share of the way from the element's first node to its second, 0 to 1 [-].
    pub t: f64,
    /// Distance beyond that along the middle line's tangent [m]: past an end of the structure, else 0.
    pub beyond: f64,
    /// Distance from the middle line to the left of the element [m]; negative to its right.
    pub offset: f64,
    /// Its normal along and across the middle line, turning with it [-].
    pub normal: [f64; 2],
}

/// Position and normal of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Where it is [m].
    pub at: [f64; 2],
    /// Its normal [-].
    pub normal: [f64; 2],
}

/// Nodes at rest and the elements between them.
#[derive(Clone, Debug)]
pub struct BeamSurface {
    nodes: Vec<[f64; 2]>,
    elements: Vec<[usize; 2]>,
}

/// How an element is bent against its chord.
struct Bend {
    length: f64,
    /// Direction of the chord [-].
    chord: [f64; 2],
    /// Rotations of its ends against the chord [rad].
    psi: [f64; 2],
}

/// Cubic shapes of the end rotations at t, over the length; and their slopes.
fn shapes(t: f64) -> ([f64; 2], [f64; 2]) {
    let [_, first, _, second] = hermite(t, 1.0);
    ([first, second], [1.0 + t * (3.0 * t - 4.0), t * (3.0 * t - 2.0)])
}

impl BeamSurface {
    /// Of node coordinates [m] and the pairs of nodes that elements join.
    pub fn new(nodes: Vec<[f64; 2]>, elements: Vec<[usize; 2]>) -> BeamSurface {
        BeamSurface { nodes, elements }
    }

    /// The attachment of a point at rest [m] with a normal [-]: on the nearest element; past an end of the structure, on the end's
    /// extension.
    pub fn attach(&self, at: [f64; 2], normal: [f64; 2]) -> BeamAttachment {
        self.attach_among(0..self.elements.len(), at, normal)
    }

    /// The same on the nearest of some elements.
    pub fn attach_among(&self, elements: std::ops::Range<usize>, at: [f64; 2], normal: [f64; 2]) -> BeamAttachment {
        let mut best =
            (f64::INFINITY, BeamAttachment { element: elements.start, t: 0.0, beyond: 0.0, offset: 0.0, normal });
        for element in elements {
            let [first, second] = self.elements[element];
            let (a, b) = (self.nodes[first], self.nodes[second]);
            let way = [b[0] - a[0], b[1] - a[1]];
            let length = way[0].hypot(way[1]);
            let along = way.map(|w| w / length);
            let r = [at[0] - a[0], at[1] - a[1]];
            let free = dot(r, along) / length;
            let t = free.clamp(0.0, 1.0);
            let foot = [r[0] - t * way[0], r[1] - t * way[1]];
            let distance = foot[0].hypot(foot[1]);
            if distance < best.0 - 1e-12 * length {
                let across = |v: [f64; 2]| v[1] * along[0] - v[0] * along[1];
                let normal = [dot(normal, along), across(normal)];
                best =
                    (distance, BeamAttachment { element, t, beyond: (free - t) * length, offset: across(r), normal });
            }
        }
        best.1
    }

    /// The attachment on an element's middle line, a share t of the way along it, with its normal to the left.
    pub fn on_element(&self, element: usize, t: f64) -> BeamAttachment {
        BeamAttachment { element, t, beyond: 0.0, offset: 0.0, normal: [0.0, 1.0] }
    }

    /// Length of an element at rest [m].
    pub fn length(&self, element: usize) -> f64 {
        let [a, b] = self.elements[element].map(|node| self.nodes[node]);
        (b[0] - a[0]).hypot(b[1] - a[1])
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// Nodes that an element joins.
    pub fn ends(&self, element: usize) -> [usize; 2] {
        self.elements[element]
    }

    fn bend(&self, element: usize, q: &[[f64; 3]]) -> ([f64; 2], Bend) {
        let [first, second] = self.elements[element];
        let at = |node: usize| [0, 1].map(|k| self.nodes[node][k] + q[node][k]);
        let ([x1, y1], [x2, y2]) = (at(first), at(second));
        let (dx, dy) = (x2 - x1, y2 - y1);
        let length = dx.hypot(dy);
        let rest = [0, 1].map(|k| self.nodes[second][k] - self.nodes[first][k]);
        let turn = (rest[0] * dy - rest[1] * dx).atan2(rest[0] * dx + rest[1] * dy);
        let psi = [first, second].map(|node| {
            let psi = q[node][2] - turn;
            psi - TAU * (psi / TAU).round()
        });
        ([x1, y1], Bend { length, chord: [dx / length, dy / length], psi })
    }

    /// CO13: where a point is when the nodes are displaced by q = `[nodes][u, w, θ]` [m, m, rad].
    pub fn place(&self, point: &BeamAttachment, q: &[[f64; 3]]) -> Place {
        let (start, Bend { length, chord: [c, s], psi }) = self.bend(point.element, q);
        let (h, slope) = shapes(point.t);
        let (deflection, tan) = (length * dot(h, psi), dot(slope, psi));
        let cos = 1.0 / tan.hypot(1.0);
        // tangent of the bent middle line
        let [tx, ty] = [cos * (c - tan * s), cos * (s + tan * c)];
        let along = point.t * length;
        let at = [
            start[0] + along * c - deflection * s + point.beyond * tx - point.offset * ty,
            start[1] + along * s + deflection * c + point.beyond * ty + point.offset * tx,
        ];
        let [n_along, n_across] = point.normal;
        Place { at, normal: [n_along * tx - n_across * ty, n_along * ty + n_across * tx] }
    }

    /// CO14: rows x, y of ∂r/∂q by the six values of the element's ends: velocity = H q̇, to rounding.
    pub fn influence(&self, point: &BeamAttachment, q: &[[f64; 3]]) -> [[f64; 6]; 2] {
        let (_, Bend { length, chord: [c, s], psi }) = self.bend(point.element, q);
        let (h, slope) = shapes(point.t);
        let (shape, tan) = (dot(h, psi), dot(slope, psi));
        let cos = 1.0 / tan.hypot(1.0);
        let [tx, ty] = [cos * (c - tan * s), cos * (s + tan * c)];
        let t = point.t;
        let rotation = [s / length, -c / length, 0.0, -s / length, c / length, 0.0]; // of the chord
        let stretch = [-c, -s, 0.0, c, s, 0.0];
        let mut rows = [[0.0; 6]; 2];
        for k in 0..6 {
            let own = [2, 5].map(|end| f64::from(u8::from(k == end)) - rotation[k]); // ψ̇ of both ends
            let across = shape * stretch[k] + length * dot(h, own);
            let turn = rotation[k] + cos * cos * dot(slope, own);
            let back = length * shape * rotation[k];
            rows[0][k] = -across * s - back * c - turn * (point.beyond * ty + point.offset * tx);
            rows[1][k] = across * c - back * s + turn * (point.beyond * tx - point.offset * ty);
        }
        for (axis, row) in rows.iter_mut().enumerate() {
            row[axis] += 1.0 - t;
            row[3 + axis] += t;
        }
        rows
    }

    /// H q̇ (or H q̈): velocity [m/s] of a point of the nodes' velocities `[nodes][3]`.
    pub fn velocity(&self, point: &BeamAttachment, q: &[[f64; 3]], rate: &[[f64; 3]]) -> [f64; 2] {
        let [first, second] = self.elements[point.element];
        self.influence(point, q).map(|row| (0..3).map(|k| row[k] * rate[first][k] + row[3 + k] * rate[second][k]).sum())
    }

    /// CO14: Hᵀ f: add a force [N/m] at a point to the nodes' loads `[nodes][F_x, F_y, M]` [N/m, N/m, N].
    pub fn add_load(&self, point: &BeamAttachment, q: &[[f64; 3]], force: [f64; 2], loads: &mut [[f64; 3]]) {
        let [first, second] = self.elements[point.element];
        let [x, y] = self.influence(point, q);
        for k in 0..3 {
            loads[first][k] += x[k] * force[0] + y[k] * force[1];
            loads[second][k] += x[3 + k] * force[0] + y[3 + k] * force[1];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bent() -> (BeamSurface, Vec<[f64; 3]>, Vec<BeamAttachment>) {
        let surface = BeamSurface::new(vec![[0.1, 0.2], [0.9, 0.5], [1.2, 1.4]], vec![[0, 1], [1, 2]]);
        let q = vec![[0.3, -0.2, 0.5], [0.1, 0.15, 0.9], [-0.3, 0.4, 1.1]];
        let points =
            [(0, 0.3, 0.0, 0.05), (0, 1.0, 0.0, -0.1), (1, 0.0, -0.3, 0.2), (1, 0.62, 0.0, -0.03), (1, 1.0, 0.1, 0.02)];
        let point = |(element, t, beyond, offset)| BeamAttachment { element, t, beyond, offset, normal: [0.6, 0.8] };
        let points = points.map(point).to_vec();
        (surface, q, points)
    }

    #[test]
    fn an_attachment_at_rest_gives_its_point() {
        let (surface, _, _) = bent();
        let rest = vec![[0.0; 3]; 3];
        for at in [[0.3, 0.3], [1.1, 0.6], [0.8, 1.2], [0.0, 0.1], [1.3, 1.6]] {
            let place = surface.place(&surface.attach(at, [0.0, 1.0]), &rest);
            assert!((place.at[0] - at[0]).hypot(place.at[1] - at[1]) < 1e-14, "{at:?} {place:?}");
            assert!(place.normal[0].abs() + (place.normal[1] - 1.0).abs() < 1e-14);
        }
    }

    /// H is the derivative of the places by the nodes' values.
    #[test]
    fn the_influence_is_the_places_derivative() {
        let (surface, q, points) = bent();
        for point in &points {
            let rows = surface.influence(point, &q);
            for k in 0..6 {
                let (node, dof) = (surface.ends(point.element)[k / 3], k % 3);
                let moved = |by: f64| {
                    let mut q = q.clone();
                    q[node][dof] += by;
                    surface.place(point, &q).at
                };
                let (plus, minus) = (moved(1e-6), moved(-1e-6));
                for axis in 0..2 {
                    let slope = (plus[axis] - minus[axis]) / 2e-6;
                    assert!((rows[axis][k] - slope).abs() < 1e-8, "{point:?} {axis} {k}: {} {slope}", rows[axis][k]);
                }
            }
        }
    }

    /// A rigid motion of the nodes, of any size, moves the points rigidly, normals too.
    #[test]
    fn a_rigid_motion_moves_points_rigidly() {
        let (surface, q, points) = bent();
        let (sin, cos) = 2.3_f64.sin_cos();
        let turned = |p: [f64; 2]| [cos * p[0] - sin * p[1] + 0.7, sin * p[0] + cos * p[1] - 0.4];
        let nodes = [[0.1, 0.2], [0.9, 0.5], [1.2, 1.4]];
        let moved: Vec<[f64; 3]> = (0..3)
            .map(|n| {
                let at = turned([nodes[n][0] + q[n][0], nodes[n][1] + q[n][1]]);
                [at[0] - nodes[n][0], at[1] - nodes[n][1], q[n][2] + 2.3]
            })
            .collect();
        for point in &points {
            let (before, after) = (surface.place(point, &q), surface.place(point, &moved));
            let expected = turned(before.at);
            assert!((after.at[0] - expected[0]).hypot(after.at[1] - expected[1]) < 1e-14);
            let normal =
                [cos * before.normal[0] - sin * before.normal[1], sin * before.normal[0] + cos * before.normal[1]];
            assert!((after.normal[0] - normal[0]).hypot(after.normal[1] - normal[1]) < 1e-14);
        }
    }

    /// Power is the same on both sides of the interface: Σ f·(H q̇) = (Hᵀ f)·q̇; so are force and moment.
    #[test]
    fn work_force_and_moment_are_conserved() {
        let (surface, q, points) = bent();
        let rate = vec![[0.5, -1.0, 2.0], [-0.3, 0.8, -1.5], [1.2, 0.4, 0.7]];
        let (mut loads, mut power, mut force, mut moment) = (vec![[0.0; 3]; 3], 0.0, [0.0; 2], 0.0);
        for (k, point) in points.iter().enumerate() {
            let f = [3.0 - k as f64, 0.5 + k as f64];
            let (v, at) = (surface.velocity(point, &q, &rate), surface.place(point, &q).at);
            surface.add_load(point, &q, f, &mut loads);
            power += dot(f, v);
            force = [force[0] + f[0], force[1] + f[1]];
            moment += at[0] * f[1] - at[1] * f[0];
        }
        let given: f64 = (0..3).map(|n| (0..3).map(|k| loads[n][k] * rate[n][k]).sum::<f64>()).sum();
        assert!((given - power).abs() < 1e-13 * power.abs().max(1.0), "{given} {power}");
        let nodes = [[0.1, 0.2], [0.9, 0.5], [1.2, 1.4]];
        let total: f64 = (0..3)
            .map(|n| loads[n][2] + (nodes[n][0] + q[n][0]) * loads[n][1] - (nodes[n][1] + q[n][1]) * loads[n][0])
            .sum();
        assert!((total - moment).abs() < 1e-12, "{total} {moment}");
        for axis in 0..2 {
            let sum: f64 = loads.iter().map(|load| load[axis]).sum();
            assert!((sum - force[axis]).abs() < 1e-13);
        }
    }
}
