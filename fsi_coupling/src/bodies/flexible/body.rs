//! A body whose surface bends: panels of beam elements on a rigid frame, one set of equations (THEORY CO13–CO17).

use std::fmt::Display;

use sph_core::state_bytes::{StateError, decode, encode};
use sph_core::walls::Resultant;
use sph_core::{InterfaceDynamics, PlateMidline, WallForces, WallPoint, WallsMut};
use structure_fe::{Break, Dynamics, Envelope, State};

use crate::bodies::bending::frame::{Frame, power};
use crate::bodies::body::{Contact, Inspect, Linked, WettedBody};
use crate::bodies::error::BodyError;
use crate::bodies::flexible::interface::FlexibleInterface;
use crate::bodies::flexible::model::{FlexibleSpec, Model};
use crate::bodies::flexible::panel_state::state_of;
use crate::bodies::flexible::state::FlexibleState;
use crate::bodies::panel_state::PanelState;
use crate::bodies::prescribed::Law;
use crate::bodies::rigid_motion::RigidMotion;
use crate::bodies::state::{ContactImpulse, Energy, Momentum, Motion, SurfacePoint};
use crate::geometry::outline::Outline;
use crate::geometry::rows::WallRows;

/// A rigid frame with panels that bend. The load of a step is the mean force of the fluid, mapped to the nodes by the transpose of the
/// map that places the boundary particles; the structure's step changes momentum by exactly that (THEORY BE20).
pub struct FlexibleBody {
    name: String,
    model: Model,
    law: Option<Law>,
    free: [bool; 3],
    gravity: [f64; 2],
    weight: Vec<[f64; 3]>,
    state: FlexibleState,
    checkpoint: Option<(FlexibleState, Outline)>,
    /// Longest step that resolves its vibration [s].
    longest_step: f64,
}

impl FlexibleBody {
    /// The body at the start, its panels undeformed, under its own weight alone.
    pub fn new(spec: FlexibleSpec) -> Result<FlexibleBody, BodyError> {
        let (mut model, mut nodes) = Model::new(&spec)?;
        let FlexibleSpec { name, frame, gravity, .. } = spec;
        let weight = model.dynamics.gravity_load(gravity);
        let (law, free) = match frame {
            Frame::Given(law) => (Some(law), [false; 3]),
            Frame::Free { free, .. } => (None, free),
        };
        if let Some(law) = &law {
            model.prescribe(&law(0.0)).map_err(|error| BodyError::structure(&name, &error))?;
        }
        model.dynamics.equilibrate(&mut nodes, &weight).map_err(|error| BodyError::structure(&name, &error))?;
        let state = FlexibleState::new(nodes, Envelope::new(model.dynamics.beam()));
        let longest_step = f64::INFINITY;
        Ok(FlexibleBody { name, model, law, free, gravity, weight, state, checkpoint: None, longest_step })
    }

    /// The same, with a clock that starts at `time` [s]: the law of its frame begins then.
    pub fn starting_at(mut self, time: f64) -> FlexibleBody {
        self.law = self.law.map(|law| -> Law { Box::new(move |t| law(t - time)) });
        self.state.nodes.time = time;
        self
    }

    /// The same, with steps of at most `dt` [s] (THEORY CO33).
    pub fn with_longest_step(self, dt: f64) -> FlexibleBody {
        FlexibleBody { longest_step: dt, ..self }
    }

    /// The structure's motion: displacements, velocities and accelerations of its nodes.
    pub fn nodes(&self) -> &State {
        &self.state.nodes
    }

    /// The structure.
    pub fn dynamics(&self) -> &Dynamics {
        &self.model.dynamics
    }

    /// Mean load of the fluid over the last step, `[nodes][F_x, F_y, M]` [N/m, N/m, N].
    pub fn load_of_fluid(&self) -> &[[f64; 3]] {
        &self.state.mean
    }

    /// Displacements `ahead` [s] from now, at constant acceleration.
    fn ahead(&self, ahead: f64) -> Vec<[f64; 3]> {
        let State { displacement, velocity, acceleration, .. } = &self.state.nodes;
        let each = displacement.iter().zip(velocity).zip(acceleration);
        each.map(|((q, v), a)| [0, 1, 2].map(|k| q[k] + ahead * (v[k] + 0.5 * ahead * a[k]))).collect()
    }

    /// After a step or a restored state: the structure may have broken, which changes the weight of the nodes and moves the frame's node.
    fn update_model(&mut self) {
        self.model.update_reference();
        self.weight = self.model.dynamics.gravity_load(self.gravity);
    }

    /// −Σ W·x: potential energy of the structure that is simulated [J/m].
    fn potential(&self) -> f64 {
        let places = self.model.dynamics.beam().nodes().iter().zip(&self.state.nodes.displacement);
        let each = self.weight.iter().zip(places);
        -each.map(|(w, (x, q))| w[0] * (x[0] + q[0]) + w[1] * (x[1] + q[1]) + w[2] * q[2]).sum::<f64>()
    }

    /// Loads on the nodes of an impulse [N s/m] at a place of the surface in space [m].
    fn loads_of(&self, at: [f64; 2], impulse: [f64; 2]) -> Vec<[f64; 3]> {
        self.model.surface.loads_of(at, impulse, &self.frame(), &self.state.nodes.displacement)
    }

    /// Velocities of the nodes under impulses within a step of `dt` [s] (BE23); zero where the equations have no solution.
    fn velocities_under(&mut self, impulses: &[[f64; 3]], dt: f64) -> Vec<[f64; 3]> {
        let still = || vec![[0.0; 3]; impulses.len()];
        if dt <= 0.0 {
            return still();
        }
        let inertia = self.model.dynamics.effective_inertia(&self.state.nodes, dt);
        inertia.solve(impulses).unwrap_or_else(|_| still())
    }

    fn frame(&self) -> RigidMotion {
        self.model.frame(&self.state.nodes)
    }

    /// Update the outline to the present displacements.
    fn update_outline(&mut self) -> Result<(), BodyError> {
        let (frame, nodes) = (self.frame(), &self.state.nodes);
        match self.model.surface.update_outline(&frame, &nodes.displacement) {
            true => Ok(()),
            false => Err(BodyError::NotFinite { name: self.name.clone(), time: nodes.time }),
        }
    }

    /// Sum over both halves where one is simulated: twice along y, nothing along x.
    fn both(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        if self.model.surface.half { [0.0, 2.0 * y] } else { [x, y] }
    }
}

impl WettedBody for FlexibleBody {
    fn sample(&mut self, rows: &WallRows) -> Result<Vec<WallPoint>, BodyError> {
        Ok(self.model.surface.sample(rows))
    }

    fn kinematics(&self, ahead: f64, out: WallsMut<'_>) -> Vec<PlateMidline> {
        let (now, then) = ((&self.state.nodes).into(), self.ahead(ahead));
        self.model.surface.kinematics(now, &then, &self.state.predicted_positions, ahead, out)
    }

    fn interface(&mut self, ahead: f64) -> Result<Option<Box<dyn InterfaceDynamics>>, BodyError> {
        let now = &self.state.nodes;
        let each = now.velocity.iter().zip(&now.acceleration);
        let velocity = each.map(|(v, a)| [0, 1, 2].map(|k| v[k] + ahead * a[k])).collect();
        let then = State { displacement: self.ahead(ahead), velocity, ..now.clone() };
        let Model { dynamics, surface, .. } = &mut self.model;
        let attached = (&surface.layout.map, &surface.attachments[..]);
        let interface = FlexibleInterface::new(&self.name, dynamics, attached, (now, &then), &self.weight, ahead)?;
        Ok(Some(Box::new(interface)))
    }

    fn load(&mut self, force: WallForces<'_>) {
        let m = &mut self.state;
        m.mean.fill([0.0; 3]);
        m.now.fill([0.0; 3]);
        m.predicted_positions.clear();
        m.predicted_positions.extend(force.x.iter().zip(force.y).map(|(x, y)| [*x, *y]));
        m.force = self.model.surface.add_loads(&force, &m.nodes.displacement, &mut m.mean, &mut m.now);
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        if let Some(law) = &self.law {
            let prescribed = law(self.state.nodes.time + dt);
            self.model.prescribe(&prescribed).map_err(|error| BodyError::structure(&self.name, &error))?;
        }
        let (m, dynamics) = (&mut self.state, &mut self.model.dynamics);
        let before = (m.nodes.displacement.clone(), dynamics.momentum(&m.nodes));
        let all: Vec<[f64; 3]> = (0..self.weight.len())
            .map(|n| [0, 1, 2].map(|k| m.mean[n][k] + self.weight[n][k] + m.impulses[n][k] / dt))
            .collect();
        let stepped = dynamics.step(&mut m.nodes, &all, dt);
        let report = stepped.map_err(|error| BodyError::structure(&self.name, &error))?;
        let moved: Vec<[f64; 3]> =
            m.nodes.displacement.iter().zip(&before.0).map(|(q, p)| [0, 1, 2].map(|k| q[k] - p[k])).collect();
        let after = dynamics.momentum(&m.nodes);
        for k in 0..2 {
            let sum = |loads: &[[f64; 3]]| loads.iter().map(|load| load[k]).sum::<f64>();
            let fluid = dt * sum(&m.mean) + sum(&m.impulses);
            // a guide's impulse is the change of momentum less the fluid's
            m.external[k] += if self.free[k] { dt * sum(&self.weight) } else { after[k] - before.1[k] - fluid };
        }
        let work = power(&m.mean, &moved) + power(&m.impulses, &moved) / dt;
        m.work += work;
        m.dissipated += report.dissipated;
        m.support += report.support_work;
        m.impulses.fill([0.0; 3]);
        m.impulse_velocities.fill([0.0; 3]);
        let now: Vec<[f64; 3]> =
            m.now.iter().zip(&self.weight).map(|(load, weight)| [0, 1, 2].map(|k| load[k] + weight[k])).collect();
        dynamics.equilibrate_over(&mut m.nodes, &now, dt).map_err(|error| BodyError::structure(&self.name, &error))?;
        m.envelope.record(dynamics, &m.nodes);
        self.update_model();
        self.update_outline()
    }

    fn stable_dt(&self) -> f64 {
        self.model.dynamics.stable_dt().min(self.longest_step)
    }

    fn checkpoint(&mut self) {
        self.checkpoint = Some((self.state.clone(), self.model.surface.outline.clone()));
    }

    fn restore(&mut self) {
        if let Some((state, outline)) = &self.checkpoint {
            (self.state, self.model.surface.outline) = (state.clone(), outline.clone());
            // adopting cannot fail: the model had this state before
            let _ = self.model.dynamics.apply_ruptures(&self.state.nodes);
            self.update_model();
        }
    }

    fn to_bytes(&self) -> Vec<u8> {
        encode(&(&self.state, self.model.surface.outline.loops()))
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        const BODY: &str = "a flexible body";
        let (state, loops): (FlexibleState, Vec<Vec<[f64; 2]>>) = decode(BODY, bytes)?;
        state.check(&self.state, self.model.surface.attachments.len())?;
        let wrong = |cause: &dyn Display| StateError::Unreadable(BODY, cause.to_string());
        self.model.surface.outline = Outline::deformed(loops).ok_or_else(|| wrong(&"its outline is not finite"))?;
        self.state = state;
        let nodes = &self.state.nodes;
        self.model.dynamics.apply_ruptures(nodes).map_err(|error| wrong(&error))?;
        self.update_model();
        let Some(law) = &self.law else { return Ok(()) };
        self.model.prescribe(&law(self.state.nodes.time)).map_err(|error| wrong(&error))
    }
}

impl Contact for FlexibleBody {
    fn signed_distance(&self, at: [f64; 2]) -> f64 {
        self.model.surface.signed_distance(at, &self.frame())
    }

    fn surface(&self, at: [f64; 2]) -> SurfacePoint {
        let nodes = &self.state.nodes;
        let each = nodes.velocity.iter().zip(&self.state.impulse_velocities);
        let velocity: Vec<[f64; 3]> = each.map(|(v, s)| [0, 1, 2].map(|k| v[k] + s[k])).collect();
        self.model.surface.nearest(at, &self.frame(), &nodes.displacement, &velocity)
    }

    fn inverse_effective_mass(&mut self, at: [f64; 2], normal: [f64; 2], dt: f64) -> f64 {
        self.state.dt = dt;
        let loads = self.loads_of(at, normal);
        power(&loads, &self.velocities_under(&loads, dt)).max(0.0)
    }

    /// The half that is simulated takes its own impulse; the mirror image acts on the other half.
    fn apply_impulse(&mut self, contact: &ContactImpulse) {
        let loads = self.loads_of(contact.at, contact.impulse);
        let velocities = self.velocities_under(&loads, self.state.dt);
        let m = &mut self.state;
        let sums = m.impulses.iter_mut().zip(&loads).chain(m.impulse_velocities.iter_mut().zip(&velocities));
        sums.for_each(|(sum, more)| (0..3).for_each(|k| sum[k] += more[k]));
    }
}

impl Linked for FlexibleBody {}

impl Inspect for FlexibleBody {
    fn name(&self) -> &str {
        &self.name
    }

    /// Motion of the rigid frame.
    fn motion(&self) -> Option<Motion> {
        let (frame, [fx, fy, about]) = (self.frame(), self.state.force);
        let force = self.both([fx, fy]);
        let moment = if self.model.surface.half { 0.0 } else { about };
        let moment = moment - frame.position[0] * force[1] + frame.position[1] * force[0];
        Some(Motion::new(&frame, Resultant { force, moment }))
    }

    fn outline(&self) -> Option<&Outline> {
        Some(&self.model.surface.outline)
    }

    fn panels(&self) -> Vec<PanelState> {
        let (model, state, frame) = (&self.model, &self.state, self.frame());
        let parts = (&model.dynamics, &model.surface.layout.map);
        model.panels.iter().map(|panel| state_of(panel, parts, state, &frame)).collect()
    }

    fn first_rupture(&self) -> Option<(&str, Break)> {
        let first = *self.state.nodes.ruptures.first()?;
        let panel = self.model.panels.iter().find(|panel| panel.nodes.contains(&first.node))?;
        Some((&panel.spec.name, first))
    }

    fn material_point(&self, at: [f64; 2]) -> Option<(SurfacePoint, [f64; 2])> {
        Some(self.model.surface.material_point(at, (&self.state.nodes).into()))
    }

    fn energy(&self) -> Energy {
        let (nodes, whole) = (&self.state.nodes, 1.0 / self.model.share);
        Energy {
            links: 0.0,
            kinetic: whole * self.model.dynamics.kinetic_energy(nodes),
            potential: whole * self.potential(),
            elastic: whole * self.model.dynamics.strain_energy(nodes),
            work: whole * self.state.work,
            support: whole * self.state.support,
            dissipated: whole * self.state.dissipated,
        }
    }

    fn momentum(&self) -> Momentum {
        let [px, py, _] = self.model.dynamics.momentum(&self.state.nodes);
        let impulse = |k: usize| self.state.impulses.iter().map(|node| node[k]).sum::<f64>();
        let momentum = self.both([px + impulse(0), py + impulse(1)]);
        Momentum { momentum, external: self.both(self.state.external) }
    }
}
