//! Which of the host's nodes the water meets: closed loops and open chains.

use serde::{Deserialize, Serialize};

use super::error::HostError;
use crate::geometry::outline::Outline;
use crate::geometry::polygon::normal;

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
}

impl WetSurface {
    fn nodes(&self) -> &[usize] {
        match self {
            WetSurface::Closed(nodes) | WetSurface::Open { nodes, .. } => nodes,
        }
    }

    /// Numbers of its nodes and of its sides.
    pub(super) fn counts(&self) -> (usize, usize) {
        match self {
            WetSurface::Closed(nodes) => (nodes.len(), nodes.len()),
            WetSurface::Open { nodes, .. } => (nodes.len(), nodes.len() - 1),
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

    /// With rotations.
    pub fn turning(self) -> Topology {
        Topology { rotations: true, ..self }
    }

    /// With masses [kg/m], one a node.
    pub fn weighing(self, masses: Vec<f64>) -> Topology {
        Topology { masses, ..self }
    }

    /// Pairs of nodes that a side of a surface joins.
    pub(super) fn sides(&self) -> Vec<[usize; 2]> {
        let mut sides = Vec::new();
        for surface in &self.surfaces {
            let nodes = surface.nodes();
            sides.extend(nodes.windows(2).map(|pair| [pair[0], pair[1]]));
            if let (WetSurface::Closed(_), [first, .., last]) = (surface, nodes) {
                sides.push([*last, *first]);
            }
        }
        sides
    }

    /// What the surfaces enclose at t = 0: a chain together with its backing.
    pub(super) fn outline(&self) -> Result<Outline, HostError> {
        Outline::compound(&self.loops()).map_err(|error| HostError::Shape(error.into()))
    }

    /// Corners of what each surface encloses at t = 0 [m]; the first are its nodes.
    pub(super) fn loops(&self) -> Vec<Vec<[f64; 2]>> {
        let of = |surface: &WetSurface| {
            let line: Vec<[f64; 2]> = surface.nodes().iter().map(|node| self.nodes[*node]).collect();
            match surface {
                WetSurface::Closed(_) => line,
                WetSurface::Open { water, backing, .. } => {
                    let depth = if *water == Side::Left { *backing } else { -backing };
                    let back: Vec<[f64; 2]> = (0..line.len()).rev().map(|k| behind(&line, k, depth)).collect();
                    [line, back].concat()
                }
            }
        };
        self.surfaces.iter().map(of).collect()
    }

    /// Refuse surfaces that are none; `rows` [m] is how deep boundary particles reach.
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
            let least = if matches!(surface, WetSurface::Closed(_)) { 3 } else { 2 };
            let enough = nodes.len() >= least;
            refuse(enough, format!("{} nodes", nodes.len()), format!("{least} nodes at least"))?;
            for (i, node) in nodes.iter().enumerate() {
                refuse(*node < count, format!("node {node}"), format!("a number below {count}"))?;
                refuse(!nodes[..i].contains(node), format!("node {node} twice"), "each node once".into())?;
            }
            if let WetSurface::Open { backing, .. } = surface {
                let deep = *backing >= rows * (1.0 - 1e-9) && backing.is_finite();
                refuse(deep, format!("a backing of {backing} m"), format!("{rows} m at least"))?;
            }
        }
        self.sides().into_iter().try_for_each(|[a, b]| {
            let (p, q) = (self.nodes[a], self.nodes[b]);
            let long = (q[0] - p[0]).hypot(q[1] - p[1]) > 0.0;
            require(long, format!("nodes {a} and {b}"), format!("both at {p:?} m"), "a side that has a length".into())
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
        assert!(said(of().closed([0, 1, 2]).weighing(vec![1.0])).contains("masses of 1 values, expected 4"));
    }
}
