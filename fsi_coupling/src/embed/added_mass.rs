//! Stable step of a host with explicit coupling: an estimate (THEORY CO32).

use std::f64::consts::PI;

use super::spec::FluidElementSpec;
use super::topology::Topology;
use crate::geometry::polygon::bounding_box;

/// The water's inertia against the host's masses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AddedMass {
    /// Half a layer of water over the mass it moves with [-]: from about 1 on no step of the host is short enough for an
    /// explicit exchange. The worst node's, or that of all masses together.
    pub layer: f64,
    /// The node that it is the worst of; none: all masses together, since some wet node has none of its own.
    pub node: Option<usize>,
    /// All the water that the surface can move over the mass it moves with [-]: below 1 any step is stable.
    pub all: f64,
    /// Longest step of an explicit exchange [s]; infinite where any is stable, 0 where none is.
    pub host_dt: f64,
}

impl AddedMass {
    /// CO32; `None` where the topology has no masses.
    pub(super) fn of(spec: &FluidElementSpec, topology: &Topology) -> Option<AddedMass> {
        if topology.masses.iter().sum::<f64>() <= 0.0 {
            return None;
        }
        let corners: Vec<[f64; 2]> = topology.sides().iter().flatten().map(|end| end.at).collect();
        let [low, high] = bounding_box(&corners);
        let breadth = (high[0] - low[0]).max(high[1] - low[1]);
        let mut wet = vec![0.0; topology.nodes.len()];
        for [a, b] in topology.sides() {
            let half = 0.5 * (b.at[0] - a.at[0]).hypot(b.at[1] - a.at[1]);
            wet[a.node] += half;
            wet[b.node] += half;
        }
        let of = |mass: f64, length: f64, node: Option<usize>| {
            let layer = 0.5 * spec.water.density * spec.spacing * length / mass;
            let all = 0.25 * PI * spec.water.density * breadth * length / mass;
            let sound = spec.water.density * spec.speed_of_sound() * length / mass;
            let host_dt = if all + layer < 1.0 { f64::INFINITY } else { ((1.0 - layer) / sound).max(0.0) };
            AddedMass { layer, node, all, host_dt }
        };
        let own = wet.iter().zip(&topology.masses).enumerate().filter(|(_, (length, _))| **length > 0.0);
        let each: Vec<AddedMass> = own.map(|(node, (length, mass))| of(*mass, *length, Some(node))).collect();
        if each.iter().all(|a| a.layer.is_finite()) {
            return each.into_iter().max_by(|a, b| a.layer.total_cmp(&b.layer));
        }
        Some(of(topology.masses.iter().sum(), high[0] - low[0], None))
    }

    /// A warning where explicit coupling has a limit.
    pub(super) fn warning(&self) -> Option<String> {
        let whose = self.node.map_or("of the whole".into(), |node| format!("of node {node}"));
        match self.host_dt {
            dt if dt.is_infinite() => None,
            dt if dt <= 0.0 => Some(format!(
                "half a layer of water has {:.3} times the mass {whose}, expected less than 1: explicit coupling of the host is unstable \
                 at any step; save, contribute, correct, restore and repeat until the force agrees, or take a finer spacing",
                self.layer
            )),
            dt => Some(format!(
                "the added mass is up to {:.3} times the mass {whose}: explicit coupling of the host may be unstable above steps of \
                 {dt:.3e} s; take shorter ones, or save, contribute, correct, restore and repeat until the force agrees",
                self.all
            )),
        }
    }
}
