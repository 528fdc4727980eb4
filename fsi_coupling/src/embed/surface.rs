//! A host's surface as a body of a system that is built elsewhere, such as that of a scene; and the other end of it.

use super::body::{HostBody, SurfaceParts};
use super::error::HostError;
use super::exchange::Shared;
use super::frame::HostFrame;
use super::nodes::{HostNodes, Path};
use super::topology::Topology;
use crate::bodies::body::Body;
use crate::geometry::outline::Outline;
use crate::geometry::rows::WallRows;

/// Farthest that nodes may stand from where the topology has them, and pairs of nodes from each other's images [spacings].
const PLACED: f64 = 1e-6;

/// Farthest that velocities and rotations of nodes may be from those of each other's images [-]: rounding of the host's sums.
const SYMMETRIC: f64 = 1e-6;

/// The nodes of a host, ready to become a body.
pub struct HostSurface {
    body: HostBody,
    link: HostLink,
}

/// What an element keeps of its surface, once the body stands in the water.
pub struct HostLink {
    pub(super) shared: Shared,
    pub(super) wet: Vec<usize>,
    /// The farthest point that each node carries [m].
    pub(super) arms: Vec<f64>,
    pub(super) rotations: bool,
    pub(super) pairs: Pairs,
}

/// What a surface is called, and where it is.
#[derive(Clone)]
pub struct HostSurfaceSpec {
    /// Name in output columns.
    pub name: String,
    /// Its frame at t = 0.
    pub frame: HostFrame,
    /// What it encloses at t = 0, if that is more than the topology says, such as a plate that stands on walls.
    pub outline: Option<Outline>,
    /// Only the part x > 0 is simulated; the nodes of both halves are the host's, and move symmetrically.
    pub half: bool,
}

impl HostSurface {
    /// Of a topology and of nodes that stand where it says; `rows` are the layers of boundary particles.
    ///
    /// # Errors
    /// A surface that is none, nodes elsewhere, or nodes without an image in x = 0 where a half is simulated.
    pub fn new(
        topology: &Topology,
        nodes: &HostNodes,
        rows: &WallRows,
        spec: HostSurfaceSpec,
    ) -> Result<HostSurface, HostError> {
        topology.check(rows.reach())?;
        let HostSurfaceSpec { name, frame, outline, half } = spec;
        let count = topology.nodes.len();
        nodes.check(count, topology.rotations, 0.0)?;
        let tolerance = PLACED * rows.spacing;
        let moved = |k: &usize| {
            let (a, b) = (nodes.position[*k], topology.nodes[*k]);
            (a[0] - b[0]).hypot(a[1] - b[1]) > tolerance
        };
        if let Some(node) = (0..count).find(moved) {
            let (given, expected) = (format!("{:?} m", nodes.position[node]), format!("{:?} m", topology.nodes[node]));
            return Err(HostError::Node { node, quantity: "position", given, expected, time: 0.0 });
        }
        let wet = topology.wet_nodes();
        let pairs = if half { Pairs::of(topology, &wet, tolerance)? } else { Pairs::default() };
        pairs.check(nodes, 0.0)?;
        let arms = topology.arms();
        let rest = outline.map_or_else(|| topology.outline(), Ok)?;
        let shared = Shared::new(Path::resting(nodes));
        let images = if half { pairs.images(count) } else { Vec::new() };
        let parts = SurfaceParts { name, rest, frame, spacing: rows.spacing, images };
        let body = HostBody::new(topology, nodes, parts, shared.clone());
        Ok(HostSurface { body, link: HostLink { shared, wet, arms, rotations: topology.rotations, pairs } })
    }

    /// The body, and the element's end.
    pub fn into_body(self) -> (Box<dyn Body>, HostLink) {
        (Box::new(self.body), self.link)
    }
}

/// Pairs of wet nodes that are images of each other in x = 0; a node on it is its own image.
#[derive(Clone, Debug, Default)]
pub(super) struct Pairs {
    pairs: Vec<[usize; 2]>,
    tolerance: f64,
}

impl Pairs {
    fn of(topology: &Topology, wet: &[usize], tolerance: f64) -> Result<Pairs, HostError> {
        let at = |node: usize| topology.nodes[node];
        let image = |node: usize| {
            let apart = |other: &usize| (at(node)[0] + at(*other)[0]).hypot(at(node)[1] - at(*other)[1]);
            wet.iter().copied().find(|other| apart(other) <= tolerance)
        };
        let pair = |&node: &usize| match image(node) {
            Some(other) => Ok([node, other]),
            None => Err(HostError::Topology {
                place: format!("node {node}"),
                given: format!("{:?} m without an image in x = 0", at(node)),
                expected: "nodes of both halves: only one half of the water is simulated".into(),
            }),
        };
        let pairs = wet.iter().map(pair).collect::<Result<Vec<_>, _>>()?;
        Ok(Pairs { pairs: pairs.into_iter().filter(|[a, b]| a <= b).collect(), tolerance })
    }

    /// The image of each of `count` nodes; a dry node is its own.
    fn images(&self, count: usize) -> Vec<usize> {
        let mut images: Vec<usize> = (0..count).collect();
        for &[node, other] in &self.pairs {
            (images[node], images[other]) = (other, node);
        }
        images
    }

    /// An error unless the nodes are images of each other, and so is their motion.
    pub fn check(&self, nodes: &HostNodes, time: f64) -> Result<(), HostError> {
        for &[node, other] in &self.pairs {
            let turns = |values: &[f64]| [node, other].map(|k| values.get(k).copied().unwrap_or(0.0));
            let pairs = [
                ("position", nodes.position[node], nodes.position[other], self.tolerance),
                ("velocity", nodes.velocity[node], nodes.velocity[other], SYMMETRIC),
            ];
            let expected = || match node == other {
                true => "0 in x: symmetry = \"x\", and only one half of the water is simulated".to_string(),
                false => format!("the image in x = 0 of node {other}: only one half of the water is simulated"),
            };
            for (quantity, a, b, tolerance) in pairs {
                if (a[0] + b[0]).hypot(a[1] - b[1]) > tolerance * (1.0 + a[0].hypot(a[1])) {
                    return Err(HostError::Node {
                        node,
                        quantity,
                        given: format!("{a:?}"),
                        expected: expected(),
                        time,
                    });
                }
            }
            for (quantity, [a, b]) in [("rotation", turns(&nodes.rotation)), ("angular velocity", turns(&nodes.spin))] {
                if (a + b).abs() > SYMMETRIC * (1.0 + a.abs()) {
                    let expected = format!("the opposite of node {other}: only one half of the water is simulated");
                    return Err(HostError::Node { node, quantity, given: format!("{a}"), expected, time });
                }
            }
        }
        Ok(())
    }
}
