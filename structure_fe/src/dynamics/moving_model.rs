//! The model in motion: system, damping, work arrays, and the motion of its supports.

use super::lumped_mass::LumpedMass;
use super::{State, SupportMotion};
use crate::assembly::System;
use crate::element::{Damping, Weights};
use crate::error::{Error, finite};
use crate::field::{Dof, Field, combine};
use crate::linear_algebra::Bordered;

/// What all integration rules need of a model.
#[derive(Debug, Clone)]
pub(crate) struct MovingModel {
    pub system: System,
    pub damping: Damping,
    /// Tangent or its factors.
    pub matrix: Bordered,
    /// Internal forces.
    pub internal: Field,
    /// Motions of the fixed degrees of freedom.
    motions: Vec<(usize, Dof, SupportMotion)>,
}

impl MovingModel {
    pub fn new(system: System, damping: Damping) -> Self {
        let fixed = system.supports.fixed.iter();
        let motions = fixed.map(|&(node, dof)| (node, dof, SupportMotion::default())).collect();
        let internal = vec![[0.0; 3]; system.beam.nodes().len()];
        Self { matrix: system.matrix(), system, damping, internal, motions }
    }

    /// Replaces the system by one with fewer joints.
    pub fn replace_system(&mut self, system: System) {
        self.matrix = system.matrix();
        self.system = system;
    }

    /// Undeformed, at rest, at time zero.
    pub fn at_rest(&self) -> State {
        let zero = vec![[0.0; 3]; self.internal.len()];
        State {
            displacement: zero.clone(),
            velocity: zero.clone(),
            acceleration: zero.clone(),
            time: 0.0,
            integrated_acceleration: zero.clone(),
            mean_reaction: zero,
            plastic: self.system.no_plasticity(),
            ruptures: Vec::new(),
        }
    }

    /// Sets the motion of a fixed degree of freedom, and of those that hinges and welds join to it.
    pub fn prescribe(&mut self, node: usize, dof: Dof, motion: SupportMotion) -> Result<(), Error> {
        let given = [motion.displacement, motion.velocity, motion.acceleration];
        finite("prescribed motion", "node", node, &given)?;
        if !self.system.supports.is_fixed(node, dof) {
            return Err(Error::NotSupported { node, dof });
        }
        let leader = self.system.supports.leaders(dof, self.internal.len());
        let joined = |other: usize| leader[other] == leader[node];
        self.motions.retain(|&(other, fixed, _)| !(fixed == dof && joined(other)));
        self.motions.extend((0..leader.len()).filter(|&other| joined(other)).map(|other| (other, dof, motion)));
        Ok(())
    }

    /// The motions of the supports that are not broken.
    fn prescribed(&self) -> impl Iterator<Item = (usize, Dof, SupportMotion)> {
        let fixed = |node: usize, dof: Dof| self.system.equations.number(node, dof as usize).is_none();
        self.motions.iter().copied().filter(move |&(node, dof, _)| fixed(node, dof))
    }

    /// Sets the prescribed motion of the supports in a state.
    pub fn move_supports(&self, state: &mut State) {
        for (node, dof, motion) in self.prescribed() {
            let dof = dof as usize;
            state.displacement[node][dof] = motion.displacement;
            state.velocity[node][dof] = motion.velocity;
            state.acceleration[node][dof] = motion.acceleration;
        }
    }

    /// True where no support moves.
    pub fn supports_rest(&self) -> bool {
        self.prescribed().all(|(_, _, motion)| motion.velocity == 0.0 && motion.acceleration == 0.0)
    }

    /// The accelerations that the supports prescribe, zero elsewhere.
    fn prescribed_acceleration(&self) -> Field {
        let mut acceleration = vec![[0.0; 3]; self.internal.len()];
        for (node, dof, motion) in self.prescribed() {
            acceleration[node][dof as usize] = motion.acceleration;
        }
        acceleration
    }

    /// Load minus internal forces, by equation.
    pub fn residual(&self, load: &[[f64; 3]]) -> Vec<f64> {
        let mut residual = self.system.equations.restrict(load);
        self.system.equations.subtract(&self.internal, &mut residual);
        residual
    }

    /// Load minus elastic, damping and inertia forces of a state, by node; with consistent mass without a `mass`.
    pub fn unbalanced_forces(&self, mass: Option<&LumpedMass>, state: &State, load: &[[f64; 3]]) -> Field {
        let mut internal = vec![[0.0; 3]; load.len()];
        let Some(mass) = mass else {
            self.system.forces(state.kinematics(), &self.damping, &mut internal, None);
            return combine(load, &internal, |load, internal| load - internal);
        };
        let State { displacement, velocity, acceleration, plastic, .. } = state;
        self.system.elastic_forces(displacement, plastic, &mut internal, None);
        let mut forces = self.system.viscous_forces([displacement, displacement], velocity, &self.damping, &mass.nodal);
        for (node, force) in forces.iter_mut().enumerate() {
            for dof in 0..3 {
                let inertia = mass.nodal[node][dof] * acceleration[node][dof];
                force[dof] = (load[node][dof] - internal[node][dof]) - (force[dof] + inertia);
            }
        }
        forces
    }

    /// Sets the accelerations of a state to those that supports and rigid links prescribe; returns the unbalanced forces,
    /// by equation.
    pub fn residual_at_prescribed_acceleration(
        &self,
        mass: &LumpedMass,
        state: &mut State,
        load: &[[f64; 3]],
    ) -> Vec<f64> {
        state.acceleration = self.prescribed_acceleration();
        let links = &self.system.equations.links;
        let arms = links.arms_at(&state.displacement);
        links.set_acceleration(&arms, &state.velocity, &mut state.acceleration);
        let unbalanced = self.unbalanced_forces(Some(mass), state, load);
        self.system.equations.reduce(&unbalanced, &arms)
    }

    /// Adds `factor * values` to the free accelerations; linked nodes follow.
    pub fn add_acceleration(&self, factor: f64, values: &[f64], state: &mut State) {
        self.system.equations.add(factor, values, &mut state.acceleration);
        let links = &self.system.equations.links;
        links.set_acceleration(&links.arms_at(&state.displacement), &state.velocity, &mut state.acceleration);
    }

    /// Sets the accelerations of a state to equilibrium with its motion and the load.
    pub fn equilibrate(
        &mut self,
        mass: Option<&LumpedMass>,
        state: &mut State,
        load: &[[f64; 3]],
    ) -> Result<(), Error> {
        let free = if let Some(mass) = mass {
            mass.accelerations(&self.residual_at_prescribed_acceleration(mass, state, load))
        } else {
            state.acceleration = self.prescribed_acceleration();
            let tangent = (Weights { acceleration: 1.0, velocity: 0.0, displacement: 0.0 }, &mut self.matrix);
            self.system.forces(state.kinematics(), &self.damping, &mut self.internal, Some(tangent));
            let mut free = self.residual(load);
            self.matrix.factorise().map_err(|pivot| self.system.equations.singular(pivot))?;
            self.matrix.solve(&mut free);
            free
        };
        self.add_acceleration(1.0, &free, state);
        state.integrated_acceleration.clone_from(&state.acceleration);
        Ok(())
    }

    /// Ok if a load has a finite entry for each node.
    pub fn check_load(&self, load: &[[f64; 3]]) -> Result<(), Error> {
        let (given, expected) = (load.len(), self.internal.len());
        if given != expected {
            return Err(Error::WrongLength { quantity: "the load", given, expected });
        }
        load.iter().enumerate().try_for_each(|(node, force)| finite("load [N, N m]", "node", node, force))
    }
}
