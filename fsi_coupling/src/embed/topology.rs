//! Which of the host's nodes the water meets: closed loops and open chains.

use serde::{Deserialize, Serialize};

use super::error::HostError;
use crate::geometry::outline::Outline;
use crate::geometry::polygon::normal;
use crate::geometry::shape::Shape;

/// A side of a chain of nodes, as one walks along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// To the left.
    Left,
    /// To the right.
    Right,
}

/// A wet surface through nodes, by their numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum WetSurface {
    /// A closed line, in either sense; the water is outside.
    Closed(Vec<usize>),
    /// An open line with water on one side.
    Open {
        /// Its nodes in order.
        nodes: Vec<usize>,
        /// Where the water is.
        water: Side,
        /// How deep what lies behind it is [m]: three spacings at least with the default kernel. No water must come there.
        backing: f64,
    },
    /// A plate with water on both sides, whose middle line goes through the nodes (THEORY WA8).
    Plate {
        /// Nodes of the middle line in order.
        nodes: Vec<usize>,
        /// Thickness, half of it on each side of the line [m].
        thickness: f64,
    },
    /// A closed line that one node carries rigidly, in either sense; the water is outside. Nodes must have rotations.
    Carried {
        /// The node.
        node: usize,
        /// Corners of the line at t = 0 [m].
        corners: Vec<[f64; 2]>,
    },
}

/// An end of a side: a point at t = 0 [m] that a node carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Anchor {
    pub node: usize,
    pub at: [f64; 2],
}

impl WetSurface {
    fn nodes(&self) -> &[usize] {
        match self {
            WetSurface::Closed(nodes) | WetSurface::Open { nodes, .. } | WetSurface::Plate { nodes, .. } => nodes,
            WetSurface::Carried { node, .. } => std::slice::from_ref(node),
        }
    }

    fn is_closed(&self) -> bool {
        matches!(self, WetSurface::Closed(_) | WetSurface::Carried { .. })
    }

    /// Numbers of the points that its sides join, and of its sides.
    pub(super) fn counts(&self) -> (usize, usize) {
        match self {
            WetSurface::Carried { corners, .. } => (corners.len(), corners.len()),
            WetSurface::Closed(nodes) => (nodes.len(), nodes.len()),
            WetSurface::Open { nodes, .. } | WetSurface::Plate { nodes, .. } => (nodes.len(), nodes.len() - 1),
        }
    }

    /// The points at t = 0 that its sides join, in order.
    fn anchors(&self, positions: &[[f64; 2]]) -> Vec<Anchor> {
        match self {
            WetSurface::Carried { node, corners } => corners.iter().map(|at| Anchor { node: *node, at: *at }).collect(),
            _ => self.nodes().iter().map(|&node| Anchor { node, at: positions[node] }).collect(),
        }
    }
}

/// The host's nodes at t = 0 and the surfaces through them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Topology {
    /// Positions of all nodes at t = 0 [m], wet or not.
    pub nodes: Vec<[f64; 2]>,
    /// Nodes have rotations: between them the surface bends by cubic shapes (THEORY CO13), and loads have moments.
    /// Without, it is straight from node to node.
    #[serde(default)]
    pub rotations: bool,
    /// Where the water touches.
    pub surfaces: Vec<WetSurface>,
    /// Masses that move with the nodes [kg/m], for warnings and hints about added mass (THEORY CO32); empty: unknown.
    #[serde(default)]
    pub masses: Vec<f64>,
}

impl Topology {
    /// Nodes at t = 0 [m], no surface yet.
    pub fn of(nodes: Vec<[f64; 2]>) -> Topology {
        Topology { nodes, ..Topology::default() }
    }

    /// With a closed surface through nodes.
    pub fn closed(mut self, nodes: impl IntoIterator<Item = usize>) -> Topology {
        self.surfaces.push(WetSurface::Closed(nodes.into_iter().collect()));
        self
    }

    /// With an open surface through nodes, water on one side, `backing` [m] deep behind it.
    pub fn open(mut self, nodes: impl IntoIterator<Item = usize>, water: Side, backing: f64) -> Topology {
        self.surfaces.push(WetSurface::Open { nodes: nodes.into_iter().collect(), water, backing });
        self
    }

    /// With a plate through nodes, of a thickness [m].
    pub fn plate(mut self, nodes: impl IntoIterator<Item = usize>, thickness: f64) -> Topology {
        self.surfaces.push(WetSurface::Plate { nodes: nodes.into_iter().collect(), thickness });
        self
    }

    /// With a closed line of corners [m] that a node carries.
    pub fn carried(mut self, node: usize, corners: Vec<[f64; 2]>) -> Topology {
        self.surfaces.push(WetSurface::Carried { node, corners });
        self
    }

    /// With rotations.
    pub fn turning(self) -> Topology {
        Topology { rotations: true, ..self }
    }

    /// With masses [kg/m], one for each node.
    pub fn weighing(self, masses: Vec<f64>) -> Topology {
        Topology { masses, ..self }
    }

    /// Ends of the sides of all surfaces.
    pub(super) fn sides(&self) -> Vec<[Anchor; 2]> {
        let mut sides = Vec::new();
        for surface in &self.surfaces {
            let anchors = surface.anchors(&self.nodes);
            sides.extend(anchors.windows(2).map(|pair| [pair[0], pair[1]]));
            if let (true, [first, .., last]) = (surface.is_closed(), &anchors[..]) {
                sides.push([*last, *first]);
            }
        }
        sides
    }

    /// Nodes of the surfaces, each once.
    pub(super) fn wet_nodes(&self) -> Vec<usize> {
        let mut wet: Vec<usize> = self.surfaces.iter().flat_map(|surface| surface.nodes()).copied().collect();
        wet.sort_unstable();
        wet.dedup();
        wet
    }

    /// The farthest point that each node carries rigidly [m]; 0 where surfaces go through the node.
    pub(super) fn arms(&self) -> Vec<f64> {
        let mut arms = vec![0.0_f64; self.nodes.len()];
        for Anchor { node, at } in self.sides().into_iter().flatten() {
            arms[node] = arms[node].max((at[0] - self.nodes[node][0]).hypot(at[1] - self.nodes[node][1]));
        }
        arms
    }

    /// What the surfaces enclose at t = 0: a chain together with its backing.
    pub(super) fn outline(&self) -> Result<Outline, HostError> {
        let outline = match &self.surfaces[..] {
            [WetSurface::Plate { nodes, thickness }] => {
                let points = nodes.iter().map(|node| self.nodes[*node]).collect();
                Outline::of(&Shape::Polyline { points, thickness: *thickness })
            }
            _ => Outline::compound(&self.loops()),
        };
        outline.map_err(|error| HostError::Shape(error.into()))
    }

    /// Corners of what each surface encloses at t = 0 [m].
    pub(super) fn loops(&self) -> Vec<Vec<[f64; 2]>> {
        let of = |surface: &WetSurface| {
            let line: Vec<[f64; 2]> = surface.anchors(&self.nodes).iter().map(|anchor| anchor.at).collect();
            match surface {
                WetSurface::Closed(_) | WetSurface::Carried { .. } => line,
                WetSurface::Plate { thickness, .. } => {
                    Shape::Polyline { points: line, thickness: *thickness }.outline()
                }
                WetSurface::Open { water, backing, .. } => {
                    let depth = if *water == Side::Left { *backing } else { -backing };
                    let back: Vec<[f64; 2]> = (0..line.len()).rev().map(|k| behind(&line, k, depth)).collect();
                    [line, back].concat()
                }
            }
        };
        self.surfaces.iter().map(of).collect()
    }

    /// Refuse surfaces that are none; `rows` [m] is depth of the boundary particles.
    pub(super) fn check(&self, rows: f64) -> Result<(), HostError> {
        let require = |holds: bool, place: String, given: String, expected: String| match holds {
            true => Ok(()),
            false => Err(HostError::Topology { place, given, expected }),
        };
        let (count, masses) = (self.nodes.len(), &self.masses);
        for (node, at) in self.nodes.iter().enumerate() {
            let finite = (at[0] + at[1]).is_finite();
            require(finite, format!("node {node}"), format!("{at:?}"), "finite numbers".into())?;
        }
        if !masses.is_empty() && masses.len() != count {
            return Err(HostError::Length { array: "masses", given: masses.len(), expected: count });
        }
        for (node, mass) in masses.iter().enumerate() {
            let heavy = *mass >= 0.0 && mass.is_finite();
            require(heavy, format!("node {node}"), format!("{mass} kg/m"), "a mass of at least 0 kg/m".into())?;
        }
        let some = !self.surfaces.is_empty();
        require(some, "surfaces".into(), "none".into(), "one wet surface at least".into())?;
        for (k, surface) in self.surfaces.iter().enumerate() {
            let (nodes, refuse) =
                (surface.nodes(), |holds, given, why| require(holds, format!("surface {k}"), given, why));
            let least = if surface.is_closed() { 3 } else { 2 };
            let (points, of) = match surface {
                WetSurface::Carried { corners, .. } => (corners.len(), "corners"),
                _ => (nodes.len(), "nodes"),
            };
            refuse(points >= least, format!("{points} {of}"), format!("{least} {of} at least"))?;
            for (i, node) in nodes.iter().enumerate() {
                refuse(*node < count, format!("node {node}"), format!("a number below {count}"))?;
                refuse(!nodes[..i].contains(node), format!("node {node} twice"), "each node once".into())?;
            }
            if let WetSurface::Open { backing, .. } = surface {
                let deep = *backing >= rows * (1.0 - 1e-9) && backing.is_finite();
                refuse(deep, format!("a backing of {backing} m"), format!("{rows} m at least"))?;
            }
            if let WetSurface::Plate { thickness, .. } = surface {
                let thick = *thickness > 0.0 && thickness.is_finite();
                refuse(thick, format!("a thickness of {thickness} m"), "a finite number above 0 m".into())?;
                let alone = self.surfaces.len() == 1;
                refuse(alone, "a plate and other surfaces".into(), "a plate as the only surface".into())?;
            }
            if let WetSurface::Carried { corners, .. } = surface {
                let finite = corners.iter().flatten().all(|c| c.is_finite());
                refuse(finite, "corners that are not finite".into(), "finite numbers".into())?;
                refuse(
                    self.rotations,
                    "nodes without rotations".into(),
                    "rotations: a node turns what it carries".into(),
                )?;
            }
        }
        self.sides().into_iter().try_for_each(|[a, b]| {
            let (p, q) = (a.at, b.at);
            let long = (q[0] - p[0]).hypot(q[1] - p[1]) > 0.0;
            let place = match a.node == b.node {
                true => format!("corners of node {}", a.node),
                false => format!("nodes {} and {}", a.node, b.node),
            };
            require(long, place, format!("both at {p:?} m"), "a side that has a length".into())
        })
    }
}

/// The place `depth` [m] to the right of a line at its point `k`, mitred.
fn behind(line: &[[f64; 2]], k: usize, depth: f64) -> [f64; 2] {
    let side = |i: usize| normal(line[i], line[i + 1]);
    let (a, b) = (side(k.saturating_sub(1)), side(k.min(line.len() - 2)));
    let mitre = depth / (1.0 + a[0] * b[0] + a[1] * b[1]);
    [0, 1].map(|axis| line[k][axis] + mitre * (a[axis] + b[axis]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_has_its_backing_on_the_dry_side() {
        let line = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.5]];
        for (water, inside, outside) in
            [(Side::Right, [1.0, 0.1], [1.0, -0.05]), (Side::Left, [1.0, -0.1], [1.0, 0.05])]
        {
            let outline = Topology::of(line.clone()).open([0, 1, 2], water, 0.3).outline().expect("a strip");
            assert!(outline.signed_distance(inside) < 0.0 && outline.signed_distance(outside) > 0.0, "{water:?}");
            assert!((outline.area() / (0.3 * (1.0 + 1.25_f64.sqrt())) - 1.0).abs() < 0.1);
        }
    }

    #[test]
    fn surfaces_that_are_none_are_refused_by_node() {
        let nodes = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, 1.0]];
        let said = |topology: Topology| topology.check(0.1).expect_err("refused").to_string();
        let of = || Topology::of(nodes.clone());
        assert!(said(of()).contains("given none"));
        assert!(said(of().closed([0, 1])).contains("3 nodes at least"));
        assert!(said(of().closed([0, 1, 9])).contains("node 9"));
        assert!(said(of().closed([0, 1, 2, 0])).contains("node 0 twice"));
        assert!(said(of().closed([0, 1, 2, 3])).contains("nodes 2 and 3: given both at"));
        assert!(said(of().open([0, 1], Side::Left, 0.05)).contains("a backing of 0.05 m, expected 0.1 m"));
        assert!(said(of().closed([0, 1, 2]).weighing(vec![1.0])).contains("masses: given 1 values, expected 4"));
    }
}
