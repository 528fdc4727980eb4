//! The interface to coupling schemes: residual and effective inertia of a moving model, rigid initial velocity, and equilibrium
//! without unresolved vibrations.

use super::solver::Rule;
use super::{Dynamics, State};
use crate::assembly::Equations;
use crate::element::Weights;
use crate::error::{Error, above_zero};
use crate::linear_algebra::Bordered;

/// Effective inertia M + theta^2 dt^2 K + theta dt C of a model in a state (THEORY BE23): it relates forces to the
/// accelerations of a step dt of the trapezoidal rule. Blocks can be added to it, such as the added mass of a fluid.
#[derive(Debug, Clone)]
pub struct EffectiveInertia {
    matrix: Bordered,
    equations: Equations,
    /// Lever arms of the rigid links, rotated \[m\].
    arms: Vec<[f64; 2]>,
}

impl Dynamics {
    /// Load minus elastic, damping and inertia forces of a state, `[nodes][F_x, F_y, M]` \[N, N, N m\]: zero if its
    /// accelerations are in equilibrium. The residual of linked nodes is at their bodies; zero where supported.
    ///
    /// # Panics
    /// If the state is not of this model.
    pub fn residual(&mut self, state: &State, load: &[[f64; 3]]) -> Vec<[f64; 3]> {
        self.apply_ruptures(state).expect("a state of this model");
        let mut residual = self.model.unbalanced_forces(self.rule.lumped_mass(), state, load);
        let links = &self.model.system.equations.links;
        links.transfer_forces(&links.arms_at(&state.displacement), &mut residual);
        for &(node, dof) in &self.model.system.supports.fixed {
            residual[node][dof as usize] = 0.0;
        }
        residual
    }

    /// Weight theta of the end of the step in the mean elastic force \[-\]: of the trapezoidal rule; 1/2 under other rules.
    pub fn end_weight(&self) -> f64 {
        if let Rule::Trapezoidal(rule) = &self.rule { rule.weight } else { 0.5 }
    }

    /// The effective inertia of the step `dt` \[s\] from a state, with theta = [`Dynamics::end_weight`].
    ///
    /// # Panics
    /// If the state is not of this model.
    pub fn effective_inertia(&mut self, state: &State, dt: f64) -> EffectiveInertia {
        self.apply_ruptures(state).expect("a state of this model");
        let theta = self.end_weight();
        let (system, damping, internal) = (&self.model.system, &self.model.damping, &mut self.model.internal);
        let (q, plastic) = (&state.displacement, &state.plastic);
        let arms = system.equations.links.arms_at(q);
        let mut matrix = system.matrix();
        if let Some(mass) = self.rule.lumped_mass() {
            let both = [&arms[..], &arms[..]];
            let of_stiffness = (theta * dt).powi(2);
            system.elastic_forces(q, plastic, internal, Some((of_stiffness, both, &mut matrix)));
            system.add_arm_rotation(internal, &arms, -of_stiffness, &mut matrix);
            system.add_viscosity(q, damping, theta * dt, both, &mut matrix);
            let damped = theta * dt * damping.mass;
            let of_ground = if system.is_damped_against_ground() { damped } else { 0.0 };
            for (row, mass) in mass.by_equation.iter().enumerate() {
                matrix.add(row, row, mass * (1.0 + of_ground));
            }
            if damped > 0.0 && !system.is_damped_against_ground() {
                system.add_mass_damping(&system.damping_arms(q, q), &mass.nodal, damped, &mut matrix);
            }
        } else {
            let weights = Weights { acceleration: 1.0, velocity: 0.5 * dt, displacement: 0.25 * dt * dt };
            system.forces(state.kinematics(), damping, internal, Some((weights, &mut matrix)));
        }
        EffectiveInertia { matrix, equations: system.equations.clone(), arms }
    }

    /// Sets the velocity of a rigid motion: `velocity` \[m/s\] at the `reference` point \[m\], and `angular_velocity`
    /// \[rad/s\]. Accelerations do not change: call [`Dynamics::equilibrate`] afterwards.
    pub fn set_rigid_velocity(
        &self,
        state: &mut State,
        reference: [f64; 2],
        velocity: [f64; 2],
        angular_velocity: f64,
    ) {
        for (node, at) in self.beam().nodes().iter().enumerate() {
            let [x, y] = [0, 1].map(|axis| at[axis] + state.displacement[node][axis] - reference[axis]);
            state.velocity[node] =
                [velocity[0] - angular_velocity * y, velocity[1] + angular_velocity * x, angular_velocity];
        }
    }

    /// Like [`Dynamics::equilibrate`], but with the effective inertia of a step `dt` \[s\] (THEORY BE23), which filters
    /// vibrations that such a step does not resolve.
    ///
    /// Preferable with lumped masses: without the filter the accelerations are the forces of the stiffest vibrations over
    /// the smallest masses. The trapezoidal rule ends a [`Dynamics::step`] with these accelerations.
    pub fn equilibrate_over(&mut self, state: &mut State, load: &[[f64; 3]], dt: f64) -> Result<(), Error> {
        self.model.check_load(load)?;
        above_zero("time step [s]", dt)?;
        self.apply_ruptures(state)?;
        let Rule::Trapezoidal(rule) = &self.rule else { return self.equilibrate(state, load) };
        self.model.residual_at_prescribed_acceleration(&rule.mass, state, load);
        let residual = self.residual(state, load);
        let added = self.effective_inertia(state, dt).solve(&residual)?;
        for (a, added) in state.acceleration.as_flattened_mut().iter_mut().zip(added.as_flattened()) {
            *a += added;
        }
        Ok(())
    }
}

impl EffectiveInertia {
    /// Adds a block between `nodes`, row by row over their `[u, w, theta]`: rows are forces, columns accelerations.
    /// It need not be symmetric. Entries of linked nodes are transferred to their bodies.
    ///
    /// # Panics
    /// If the block is not square over the nodes, or couples nodes that neither an element nor a body joins.
    pub fn add(&mut self, nodes: &[usize], block: &[f64]) {
        let width = 3 * nodes.len();
        assert_eq!(block.len(), width * width, "a block over {} nodes has {} entries", nodes.len(), width * width);
        let (matrix, arms) = (&mut self.matrix, [&self.arms[..], &self.arms[..]]);
        for (i, values) in block.chunks_exact(width).enumerate() {
            for (j, &value) in values.iter().enumerate().filter(|(_, value)| **value != 0.0) {
                let (from, to) = (nodes[i / 3], nodes[j / 3]);
                self.equations.scatter_entry([(from, i % 3), (to, j % 3)], value, arms, |row, column, value| {
                    assert!(matrix.holds(row, column), "nodes {from} and {to} are ends of no element");
                    matrix.add(row, column, value);
                });
            }
        }
    }

    /// Accelerations of all nodes `[nodes][u, w, theta]` under forces `[nodes][F_x, F_y, M]`, linearly: linked nodes
    /// follow their bodies; zero where supported.
    pub fn solve(mut self, right: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, Error> {
        let mut values = self.equations.reduce(right, &self.arms);
        self.matrix.factorise().map_err(|pivot| self.equations.singular(pivot))?;
        self.matrix.solve(&mut values);
        let mut accelerations = self.equations.extend(|equation| values[equation]);
        self.equations.links.set_velocity(&self.arms, &mut accelerations);
        Ok(accelerations)
    }
}
