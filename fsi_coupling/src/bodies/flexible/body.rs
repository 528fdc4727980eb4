//! A body whose surface bends: panels of beam elements on a rigid frame, one set of equations (THEORY CO13–CO17).

use sph_core::state_bytes::{StateError, expect_count};
use structure_fe::{Break, Dynamics, Envelope, Error, State};

use crate::bodies::bending::bending_surface::{BendingSurface, NodalMotion};
use crate::bodies::bending::body::BendingBody;
use crate::bodies::bending::frame::{less, power};
use crate::bodies::bending::model::{BendingModel, Interface, StateOf};
use crate::bodies::bending::state::BendingState;
use crate::bodies::error::BodyError;
use crate::bodies::flexible::interface::interface_of;
use crate::bodies::flexible::model::{FlexibleModel, FlexibleSpec};
use crate::bodies::flexible::panel_state::state_of;
use crate::bodies::panel_state::PanelState;
use crate::bodies::rigid_motion::RigidMotion;

/// A rigid frame with panels that bend.
pub type FlexibleBody = BendingBody<FlexibleModel>;

impl FlexibleBody {
    /// The body at the start, its panels undeformed, under its own weight alone.
    pub fn new(spec: FlexibleSpec) -> Result<FlexibleBody, BodyError> {
        let (model, surface, nodes) =
            FlexibleModel::new(&spec).map_err(|error| BodyError::structure(&spec.name, &error))?;
        let (count, envelope) = (nodes.displacement.len(), Envelope::new(model.dynamics.beam()));
        let state = BendingState::new(nodes, count, envelope);
        Ok(BendingBody::at_start((spec.name, spec.frame), (model, surface), state))
    }

    /// The structure's motion: displacements, velocities and accelerations of its nodes.
    pub fn nodes(&self) -> &State {
        &self.state.motion
    }

    /// The structure.
    pub fn dynamics(&self) -> &Dynamics {
        &self.model.dynamics
    }

    /// Mean load of the fluid over the last step, `[nodes][F_x, F_y, M]` [N/m, N/m, N].
    pub fn load_of_fluid(&self) -> &[[f64; 3]] {
        &self.state.mean
    }
}

impl BendingModel for FlexibleModel {
    type Motion = State;
    type Extremes = Envelope;
    const BODY: &'static str = "a flexible body";

    fn nodes(motion: &State) -> NodalMotion<'_> {
        motion.into()
    }

    fn time(motion: &mut State) -> &mut f64 {
        &mut motion.time
    }

    fn check(state: &StateOf<Self>, like: &StateOf<Self>) -> Result<(), StateError> {
        let (nodes, n) = (&state.motion, like.mean.len());
        let moving = [&nodes.displacement, &nodes.velocity, &nodes.acceleration, &nodes.integrated_acceleration];
        for field in moving.into_iter().chain([&nodes.mean_reaction]) {
            expect_count("nodes", field.len(), n)?;
        }
        let (found, expected) = (nodes.plastic.len(), like.motion.plastic.len());
        expect_count("elements that yield", found, expected)?;
        expect_count("ruptures of nodes", nodes.ruptures.iter().filter(|r| r.node < n).count(), nodes.ruptures.len())?;
        expect_count("element ends", state.extremes.ends.len(), like.extremes.ends.len())?;
        expect_count("nodes", state.extremes.displacement.len(), like.extremes.displacement.len())
    }

    fn ahead(&self, State { displacement, velocity, acceleration, .. }: &State, ahead: f64) -> Vec<[f64; 3]> {
        let each = displacement.iter().zip(velocity).zip(acceleration);
        each.map(|((q, v), a)| [0, 1, 2].map(|k| q[k] + ahead * (v[k] + 0.5 * ahead * a[k]))).collect()
    }

    fn interface(&mut self, surface: &BendingSurface, now: &State, dt: f64) -> Result<Interface, Error> {
        let each = now.velocity.iter().zip(&now.acceleration);
        let velocity = each.map(|(v, a)| [0, 1, 2].map(|k| v[k] + dt * a[k])).collect();
        let then = State { displacement: self.ahead(now, dt), velocity, ..now.clone() };
        let particles = (surface.influences(&then.displacement), surface.velocities(now.into()));
        Ok(Box::new(interface_of(&mut self.dynamics, particles, (now, &then), &self.weight, dt)?))
    }

    fn prescribe(&mut self, surface: &BendingSurface, frame: &RigidMotion) -> Result<(), Error> {
        self.prescribe_node(&surface.layout, frame)
    }

    fn step(&mut self, m: &mut StateOf<Self>, dt: f64) -> Result<(), Error> {
        let (nodes, dynamics, weight) = (&mut m.motion, &mut self.dynamics, &self.weight);
        let before = (nodes.displacement.clone(), dynamics.momentum(nodes));
        let all: Vec<[f64; 3]> =
            (0..weight.len()).map(|n| [0, 1, 2].map(|k| m.mean[n][k] + weight[n][k] + m.impulses[n][k] / dt)).collect();
        let report = dynamics.step(nodes, &all, dt)?;
        let moved = less(&nodes.displacement, &before.0);
        let after = dynamics.momentum(nodes);
        for k in 0..2 {
            let sum = |loads: &[[f64; 3]]| loads.iter().map(|load| load[k]).sum::<f64>();
            let fluid = dt * sum(&m.mean) + sum(&m.impulses);
            // a guide's impulse is the change of momentum less the fluid's
            m.external[k] += if self.free[k] { dt * sum(weight) } else { after[k] - before.1[k] - fluid };
        }
        m.work += power(&m.mean, &moved) + power(&m.impulses, &moved) / dt;
        m.dissipated += report.dissipated;
        m.support += report.support_work;
        let each = m.now.iter().zip(weight);
        let now: Vec<[f64; 3]> = each.map(|(load, weight)| [0, 1, 2].map(|k| load[k] + weight[k])).collect();
        dynamics.equilibrate_over(nodes, &now, dt)?;
        m.extremes.record(dynamics, nodes);
        Ok(())
    }

    fn stable_dt(&self) -> f64 {
        self.dynamics.stable_dt()
    }

    fn resume(&mut self, motion: &State) -> Result<(), Error> {
        self.dynamics.apply_ruptures(motion)
    }

    /// The frame's node moves, and the weight of the nodes changes.
    fn update(&mut self, surface: &mut BendingSurface) {
        let map = &mut surface.layout.map;
        map.reference = self.dynamics.beam().nodes()[map.frame];
        self.weight = self.dynamics.gravity_load(self.gravity);
    }

    /// BE23.
    fn velocities_under(&mut self, motion: &State, impulses: &[[f64; 3]], dt: f64) -> Vec<[f64; 3]> {
        let still = || vec![[0.0; 3]; impulses.len()];
        if dt <= 0.0 {
            return still();
        }
        self.dynamics.effective_inertia(motion, dt).solve(impulses).unwrap_or_else(|_| still())
    }

    fn response(&mut self, motion: &State, impulses: &[[f64; 3]], dt: f64) -> f64 {
        power(impulses, &self.velocities_under(motion, impulses, dt))
    }

    fn energies(&self, motion: &State) -> [f64; 3] {
        let places = self.dynamics.beam().nodes().iter().zip(&motion.displacement);
        let each = self.weight.iter().zip(places);
        let lowered = each.map(|(w, (x, q))| w[0] * (x[0] + q[0]) + w[1] * (x[1] + q[1]) + w[2] * q[2]);
        let potential = -lowered.sum::<f64>();
        [self.dynamics.kinetic_energy(motion), potential, self.dynamics.strain_energy(motion)]
    }

    fn momentum(&self, motion: &State) -> [f64; 2] {
        let [px, py, _] = self.dynamics.momentum(motion);
        [px, py]
    }

    fn panels(&self, surface: &BendingSurface, state: &StateOf<Self>, frame: &RigidMotion) -> Vec<PanelState> {
        let parts = (&self.dynamics, &surface.layout.map);
        self.panels.iter().map(|panel| state_of(panel, parts, state, frame)).collect()
    }

    fn first_rupture(&self, motion: &State) -> Option<(&str, Break)> {
        let first = *motion.ruptures.first()?;
        let panel = self.panels.iter().find(|panel| panel.nodes.contains(&first.node))?;
        Some((&panel.spec.name, first))
    }
}
