//! What coupling schemes ask a moving model: what its accelerations lack, and how forces would change them.

use crate::bordered::Bordered;
use crate::dynamics::{Dynamics, Method};
use crate::equations::Equations;
use crate::error::Error;
use crate::inertia::Weights;
use crate::state::State;
use crate::supports::Dof;
use crate::system::Kinematics;

/// M + theta^2 dt^2 K + theta dt C of a model as it is (THEORY S24): forces over it are accelerations, as the
/// trapezoidal rule with a step dt sees them. Blocks may be added to it, the added mass of a fluid for one.
#[derive(Debug, Clone)]
pub struct EffectiveInertia {
    matrix: Bordered,
    equations: Equations,
    /// Arms of the tied nodes as turned \[m\].
    arms: Vec<[f64; 2]>,
}

impl Dynamics {
    /// Load less elastic forces, damping and inertia of a state `[nodes][F_x, F_y, M]` \[N, N, N m\]: zero if its
    /// accelerations are in equilibrium. What tied nodes lack is told at their bodies; zero where supported.
    ///
    /// # Panics
    /// If the state is not of this model.
    pub fn lack(&mut self, state: &State, load: &[[f64; 3]]) -> Vec<[f64; 3]> {
        self.adopt(state).expect("a state of this model");
        let at = Kinematics { q: &state.displacement, v: &state.velocity, a: &state.acceleration };
        let mut lack = match &self.method {
            Method::Momentum(rule) => {
                let rule = std::sync::Arc::clone(rule);
                self.system.elastic_forces(&state.displacement, &state.plastic_curvature, &mut self.internal, None);
                self.lack_of_forces(&rule, state, load)
            }
            Method::Implicit(_) => {
                self.system.forces(at, &self.damping, &mut self.internal);
                let each = load.iter().zip(&self.internal);
                each.map(|(load, f)| [0, 1, 2].map(|dof| load[dof] - f[dof])).collect()
            }
            Method::Explicit(mass) => {
                self.system.restoring_forces(at, &self.damping, &mass.nodal, &mut self.internal);
                let each = load.iter().zip(&self.internal).zip(mass.nodal.iter().zip(&state.acceleration));
                each.map(|((load, f), (m, a))| [0, 1, 2].map(|dof| load[dof] - f[dof] - m[dof] * a[dof])).collect()
            }
        };
        let ties = &self.system.equations.ties;
        ties.fold(&ties.arms_at(&state.displacement), &mut lack);
        for &(node, dof) in self.system.supports.fixed() {
            lack[node][dof as usize] = 0.0;
        }
        lack
    }

    /// Weight theta of a step's end in its mean elastic force \[-\]: of the trapezoidal rule; 1/2 under other rules.
    pub fn weight_of_end(&self) -> f64 {
        self.rule().map_or(0.5, |rule| rule.weight)
    }

    /// The effective inertia of the step `dt` \[s\] from a state, with theta of the trapezoidal rule; 1/2 under
    /// other rules.
    ///
    /// # Panics
    /// If the state is not of this model.
    pub fn effective_inertia(&mut self, state: &State, dt: f64) -> EffectiveInertia {
        self.adopt(state).expect("a state of this model");
        let ties = &self.system.equations.ties;
        let arms = ties.arms_at(&state.displacement);
        let mut matrix = self.system.matrix();
        if let Method::Implicit(_) = &self.method {
            let at = Kinematics { q: &state.displacement, v: &state.velocity, a: &state.acceleration };
            let weights = Weights { acceleration: 1.0, velocity: 0.5 * dt, displacement: 0.25 * dt * dt };
            self.system.forces_and_tangent(at, &self.damping, weights, &mut self.internal, &mut matrix);
        } else {
            let theta = self.weight_of_end();
            let both = [&arms[..], &arms[..]];
            let of_stiffness = (theta * dt).powi(2);
            let tangent = Some((of_stiffness, both, &mut matrix));
            self.system.elastic_forces(&state.displacement, &state.plastic_curvature, &mut self.internal, tangent);
            self.system.subtract_turning(&self.internal, &arms, -of_stiffness, &mut matrix);
            self.system.add_viscosity(&state.displacement, &self.damping, theta * dt, both, &mut matrix);
            if let Some(mass) = self.lumped() {
                for (row, mass) in mass.by_equation.iter().enumerate() {
                    matrix.add(row, row, mass * (1.0 + theta * dt * self.damping.mass));
                }
            }
        }
        EffectiveInertia { matrix, equations: self.system.equations.clone(), arms }
    }
}

impl EffectiveInertia {
    /// Adds a block between `nodes`, row by row over their `[u, w, theta]`: rows are forces, columns accelerations.
    /// It need not be symmetric. A tied node's share goes to its body.
    ///
    /// # Panics
    /// If the block is not square over the nodes, or couples nodes that no element joins and no body carries.
    pub fn add(&mut self, nodes: &[usize], block: &[f64]) {
        let width = 3 * nodes.len();
        assert_eq!(block.len(), width * width, "a block over {} nodes has {} entries", nodes.len(), width * width);
        let (matrix, arms) = (&mut self.matrix, [&self.arms[..], &self.arms[..]]);
        for (i, values) in block.chunks_exact(width).enumerate() {
            for (j, &value) in values.iter().enumerate().filter(|(_, value)| **value != 0.0) {
                let (from, to) = (nodes[i / 3], nodes[j / 3]);
                self.equations.spread(((from, i % 3), (to, j % 3)), value, arms, |row, column, value| {
                    assert!(matrix.holds(row, column), "nodes {from} and {to} are ends of no element");
                    matrix.add(row, column, value);
                });
            }
        }
    }

    /// Accelerations of all nodes `[nodes][u, w, theta]` that forces `[nodes][F_x, F_y, M]` give, linearly: tied nodes
    /// with their bodies, zero where supported.
    pub fn solve(mut self, right: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, Error> {
        let mut values = self.equations.reduce(right, &self.arms);
        self.matrix.factorise().map_err(|pivot| {
            let (node, dof): (usize, Dof) = self.equations.place(pivot.equation);
            Error::SingularTangent { node, dof }
        })?;
        self.matrix.solve(&mut values);
        let mut accelerations = self.equations.extend(|equation| values[equation]);
        self.equations.ties.follow_linearly(&self.arms, &mut accelerations);
        Ok(accelerations)
    }
}
