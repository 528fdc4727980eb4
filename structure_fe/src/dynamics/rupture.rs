//! What breaks: supports, ties, welds and hinges that let go of a node.

use crate::dynamics::{Dynamics, Method};
use crate::error::{Error, positive};
use crate::gathered::gather;
use crate::lumped::gathered_mass;
use crate::state::State;
use crate::supports::Supports;
use crate::system::System;
use crate::trapezoidal::Trapezoidal;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What makes a node [let go](Supports::breakable) of whatever holds it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Rupture {
    /// A strain \[-\] of an outer fibre at the end of an element that ends at the node, of either sign.
    FibreStrain(f64),
    /// A rotation \[rad\] against what the node is hinged or pinned to, either way.
    Rotation(f64),
}

/// A rupture that happened, at the end of a step: nothing holds the node from the next step on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Break {
    /// The node.
    pub node: usize,
    /// When \[s\].
    pub time: f64,
    /// Where the node was \[m\].
    pub place: [f64; 2],
    /// The strain \[-\] or rotation \[rad\] that was too much.
    pub value: f64,
}

impl Rupture {
    pub(crate) fn check(&self, index: usize) -> Result<(), Error> {
        let (quantity, value) = match *self {
            Rupture::FibreStrain(limit) => ("rupture strain [-]", limit),
            Rupture::Rotation(limit) => ("rupture rotation [rad]", limit),
        };
        positive(quantity, "breakable node", index, value).map(|_| ())
    }
}

impl Dynamics {
    /// Lays the equations out for what is broken in a state. A step, and whatever else changes a state, does so by
    /// itself; it matters to one who has taken a step back that broke something and asks for momenta, energies or
    /// reactions before the next one.
    pub fn adopt(&mut self, state: &State) -> Result<(), Error> {
        let broken: Vec<usize> = state.ruptures.iter().map(|rupture| rupture.node).collect();
        if broken == self.broken {
            return Ok(());
        }
        let Some(rule) = self.rule() else { return Ok(()) };
        let (beam, supports) = &self.unbroken;
        let supports = supports.without(&broken);
        let (beam, nodal) = gather(beam.clone(), &supports)?;
        self.system = System::new(beam, supports)?;
        let mass = gathered_mass(&self.system, nodal);
        self.method = Method::Momentum(Arc::new(Trapezoidal { weight: rule.weight, mass }));
        self.matrix = self.system.matrix();
        self.broken = broken;
        Ok(())
    }

    /// Ruptures at the end of a step: writes them down and lets go.
    pub(crate) fn let_go(&mut self, state: &mut State) -> Result<(), Error> {
        let held = self.system.supports.breakables();
        if held.is_empty() {
            return Ok(());
        }
        let strains = if held.iter().any(|(_, rupture)| matches!(rupture, Rupture::FibreStrain(_))) {
            self.fibre_strains(state)
        } else {
            Vec::new()
        };
        let before = state.ruptures.len();
        for &(node, rupture) in held {
            let (value, limit) = match rupture {
                Rupture::FibreStrain(limit) => (self.strain_at(node, &strains), limit),
                Rupture::Rotation(limit) => (self.rotation_of(node, state), limit),
            };
            if value > limit {
                let (at, moved) = (self.system.beam.nodes()[node], state.displacement[node]);
                let place = [at[0] + moved[0], at[1] + moved[1]];
                state.ruptures.push(Break { node, time: state.time, place, value });
            }
        }
        if state.ruptures.len() > before {
            let places = self.system.beam.nodes().to_vec();
            self.adopt(state)?;
            self.move_bodies(&places, state);
        }
        Ok(())
    }

    /// Tells the motion of bodies at where their nodes are now, of what it was at other places of the same bodies.
    fn move_bodies(&self, from: &[[f64; 2]], state: &mut State) {
        for &body in self.system.beam.rigid_bodies() {
            let to = self.system.beam.nodes()[body];
            let [x, y] = [0, 1].map(|axis| to[axis] - from[body][axis]);
            let (q, v, a) = (state.displacement[body], state.velocity[body], state.acceleration[body]);
            let (s, c) = q[2].sin_cos();
            let arm = [c * x - s * y, s * x + c * y];
            state.displacement[body] = [q[0] + arm[0] - x, q[1] + arm[1] - y, q[2]];
            state.velocity[body] = [v[0] - v[2] * arm[1], v[1] + v[2] * arm[0], v[2]];
            let inwards = v[2] * v[2];
            state.acceleration[body] =
                [a[0] - a[2] * arm[1] - inwards * arm[0], a[1] + a[2] * arm[0] - inwards * arm[1], a[2]];
        }
    }

    /// The largest strain of an outer fibre at the ends of elements at a node \[-\].
    fn strain_at(&self, node: usize, strains: &[[f64; 2]]) -> f64 {
        let ends = self.system.beam.elements().iter().flat_map(|element| element.nodes);
        let here = ends.zip(strains).filter(|(end, _)| *end == node);
        here.flat_map(|(_, fibres)| fibres).fold(0.0, |most: f64, strain| most.max(strain.abs()))
    }

    /// How far a node has turned against what it is hinged, tied or pinned to \[rad\].
    fn rotation_of(&self, node: usize, state: &State) -> f64 {
        let supports = &self.system.supports;
        let partner = supports.hinges().iter().find_map(|&[a, b]| match node {
            n if n == a => Some(b),
            n if n == b => Some(a),
            _ => None,
        });
        let body = || supports.ties().iter().find(|tie| tie.1 == node).map(|tie| tie.0);
        let against = partner.or_else(body).map_or(0.0, |other| state.displacement[other][2]);
        (state.displacement[node][2] - against).abs()
    }
}

impl Supports {
    /// These supports without what holds the `broken` nodes. Springs stay.
    pub(crate) fn without(&self, broken: &[usize]) -> Self {
        let mut left = self.clone();
        left.retain(|node| !broken.contains(&node));
        left
    }
}
