//! A body whose surface bends in natural modes, on a rigid frame (THEORY CO34).

use std::fmt::Display;

use sph_core::state_bytes::{StateError, decode, encode};
use sph_core::walls::Resultant;
use sph_core::{InterfaceDynamics, PlateMidline, WallForces, WallPoint, WallsMut};
use structure_fe::modal::{ModalState, Step};

use crate::bodies::bending::bending_surface::NodalMotion;
use crate::bodies::bending::frame::{Frame, power};
use crate::bodies::bending::surface_map::Influence;
use crate::bodies::body::{Contact, Inspect, Linked, WettedBody};
use crate::bodies::error::BodyError;
use crate::bodies::modal::interface::{InterfaceParts, ModalInterface};
use crate::bodies::modal::spec::{ModalModel, ModalSpec};
use crate::bodies::modal::state::ModalBodyState;
use crate::bodies::modes_state::ModesState;
use crate::bodies::prescribed::Law;
use crate::bodies::rigid_motion::RigidMotion;
use crate::bodies::state::{ContactImpulse, Energy, Momentum, Motion, SurfacePoint};
use crate::geometry::outline::Outline;
use crate::geometry::rows::WallRows;
use crate::geometry::vector::rotate;

/// A rigid frame with a part of the surface that moves in modes.
pub struct ModalBody {
    name: String,
    model: ModalModel,
    law: Option<Law>,
    gravity: [f64; 2],
    state: ModalBodyState,
    checkpoint: Option<(ModalBodyState, Outline)>,
    longest_step: f64,
}

impl ModalBody {
    /// The body at the start, undeformed, under its own weight alone.
    pub fn new(spec: ModalSpec) -> Result<ModalBody, BodyError> {
        let model = ModalModel::new(&spec)?;
        let ModalSpec { name, frame, gravity, start, nodes, modes, .. } = spec;
        let law = match frame {
            Frame::Given(law) => Some(law),
            Frame::Free { .. } => None,
        };
        let mut motion = model.structure.at_rest(start.position, start.angle);
        motion.velocity[..3].copy_from_slice(&[start.velocity[0], start.velocity[1], start.angular_velocity]);
        if let Some(law) = &law {
            motion.acceleration[..3].copy_from_slice(&of_frame(&law(0.0))[2]);
        }
        let with_stress = modes.iter().all(|mode| !mode.stress.is_empty());
        let state = ModalBodyState::new(motion, nodes.len(), with_stress);
        let mut body = ModalBody { name, model, law, gravity, state, checkpoint: None, longest_step: f64::INFINITY };
        body.equilibrate(0.0)?;
        body.update_nodes();
        Ok(body)
    }

    /// The same, with a clock that starts at `time` [s]: the law of its frame begins then.
    pub fn starting_at(mut self, time: f64) -> ModalBody {
        self.law = self.law.map(|law| -> Law { Box::new(move |t| law(t - time)) });
        self.state.motion.time = time;
        self
    }

    /// The same, with steps of at most `dt` [s]: they resolve its vibration.
    pub fn with_longest_step(self, dt: f64) -> ModalBody {
        ModalBody { longest_step: dt, ..self }
    }

    /// Loads on the nodes, as loads on the unknowns: Jᵀ f.
    fn on_unknowns(&self, loads: &[[f64; 3]]) -> Vec<f64> {
        let mut sum = vec![0.0; self.model.structure.unknowns()];
        for (rows, load) in self.model.structure.jacobian(&self.state.motion).iter().zip(loads) {
            for (row, force) in rows.iter().zip(load) {
                sum.iter_mut().zip(row).for_each(|(sum, share)| *sum += share * force);
            }
        }
        sum
    }

    /// J times rates of the unknowns: rates of the nodes, the frame last.
    fn on_nodes(&self, state: &ModalState, rates: &[f64]) -> Vec<[f64; 3]> {
        let of = |rows: &[Vec<f64>; 3]| {
            [0, 1, 2].map(|i| rows[i].iter().zip(rates).map(|(row, rate)| row * rate).sum::<f64>())
        };
        self.model.structure.jacobian(state).iter().map(of).collect()
    }

    /// Places of the nodes of a state less those at rest.
    fn displacements(&self, state: &ModalState) -> Vec<[f64; 3]> {
        let places = self.model.structure.places(state);
        places.iter().zip(&self.model.rest).map(|(now, rest)| [0, 1, 2].map(|k| now[k] - rest[k])).collect()
    }

    /// Accelerations in equilibrium with the fluid's load now, filtered for a step of `dt` [s].
    fn equilibrate(&mut self, dt: f64) -> Result<(), BodyError> {
        let load = self.on_unknowns(&self.state.now);
        let found = self.model.structure.equilibrate(&mut self.state.motion, &load, self.gravity, dt);
        found.map_err(|error| BodyError::structure(&self.name, &error))
    }

    /// Motion of the nodes from that of the unknowns.
    fn update_nodes(&mut self) {
        let motion = &self.state.motion;
        let displacement = self.displacements(motion);
        let velocity = self.on_nodes(motion, &motion.velocity);
        let turning = self.model.structure.convective_acceleration(motion);
        let mut acceleration = self.on_nodes(motion, &motion.acceleration);
        let nodes = acceleration.len() - 1;
        // on the frame the map adds the centripetal part
        for (a, more) in acceleration.iter_mut().zip(turning).take(nodes) {
            (0..2).for_each(|k| a[k] += more[k]);
        }
        (self.state.displacement, self.state.velocity, self.state.acceleration) =
            (displacement, velocity, acceleration);
    }

    /// The unknowns `ahead` [s] from now: displacements at constant acceleration; where it is prescribed the frame by its law.
    fn ahead(&self, ahead: f64) -> ModalState {
        let now = &self.state.motion;
        let moved = |k: usize| ahead * (now.velocity[k] + 0.5 * ahead * now.acceleration[k]);
        ModalState {
            frame: [0, 1, 2].map(|k| now.frame[k] + moved(k)),
            amplitude: now.amplitude.iter().enumerate().map(|(j, q)| q + moved(3 + j)).collect(),
            velocity: now.velocity.iter().zip(&now.acceleration).map(|(v, a)| v + ahead * a).collect(),
            acceleration: now.acceleration.clone(),
            time: now.time + ahead,
        }
    }

    fn frame(&self) -> RigidMotion {
        let ModalBodyState { displacement, velocity, acceleration, .. } = &self.state;
        self.model.surface.layout.frame(displacement, velocity, acceleration)
    }

    fn nodes(&self) -> NodalMotion<'_> {
        let ModalBodyState { displacement, velocity, acceleration, .. } = &self.state;
        NodalMotion { displacement, velocity, acceleration }
    }

    /// Loads on the nodes of an impulse [N s/m] at a place of the surface in space [m].
    fn loads_of(&self, at: [f64; 2], impulse: [f64; 2]) -> Vec<[f64; 3]> {
        self.model.surface.loads_of(at, impulse, &self.frame(), &self.state.displacement)
    }

    /// Velocities of the unknowns under impulses on the nodes within a step of `dt` [s]; zero where the equations have no solution.
    fn velocities_under(&self, impulses: &[f64], dt: f64) -> Vec<f64> {
        let inertia = self.model.structure.effective_inertia(&self.state.motion, dt.max(0.0));
        self.model.structure.solve_free(inertia, impulses.to_vec()).unwrap_or_else(|_| vec![0.0; impulses.len()])
    }

    /// Sum over both halves where one is simulated: twice along y, nothing along x.
    fn both(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        if self.model.surface.half { [0.0, 2.0 * y] } else { [x, y] }
    }

    /// Displacements of the nodes against the frame, in its axes [m].
    fn against_frame(&self) -> Vec<[f64; 2]> {
        let (motion, modes) = (&self.state.motion, self.model.structure.modes());
        let nodes = self.state.displacement.len() - 1;
        let at = |node: usize, axis: usize| -> f64 {
            modes.iter().zip(&motion.amplitude).map(|(mode, q)| q * mode.shape[node][axis]).sum()
        };
        (0..nodes).map(|node| [at(node, 0), at(node, 1)]).collect()
    }

    /// Stress at the nodes [Pa].
    fn stress(&self) -> Vec<f64> {
        let (stresses, amplitude) = (&self.model.stress, &self.state.motion.amplitude);
        let at = |node: usize| stresses.iter().zip(amplitude).map(|(stress, q)| q * stress[node]).sum();
        (0..self.state.extremes.stress.len()).map(at).collect()
    }
}

/// Position, velocity and acceleration of a frame's origin and angle.
fn of_frame(motion: &RigidMotion) -> [[f64; 3]; 3] {
    let RigidMotion { position, angle, velocity, angular_velocity, acceleration, angular_acceleration } = *motion;
    [
        [position[0], position[1], angle],
        [velocity[0], velocity[1], angular_velocity],
        [acceleration[0], acceleration[1], angular_acceleration],
    ]
}

/// CO34: rows x, y of a place by the unknowns, from those by its nodes.
fn rows_of(influence: &Influence, jacobian: &[[Vec<f64>; 3]]) -> [Vec<f64>; 2] {
    influence.rows.map(|row| {
        let mut sum = vec![0.0; jacobian[0][0].len()];
        for (end, node) in influence.nodes.iter().enumerate().take(influence.count) {
            for (k, by_unknown) in jacobian[*node].iter().enumerate() {
                sum.iter_mut().zip(by_unknown).for_each(|(sum, share)| *sum += row[3 * end + k] * share);
            }
        }
        sum
    })
}

impl WettedBody for ModalBody {
    fn sample(&mut self, rows: &WallRows) -> Result<Vec<WallPoint>, BodyError> {
        Ok(self.model.surface.sample(rows))
    }

    fn kinematics(&self, ahead: f64, out: WallsMut<'_>) -> Vec<PlateMidline> {
        let then = self.displacements(&self.ahead(ahead));
        self.model.surface.kinematics(self.nodes(), &then, &self.state.predicted_positions, ahead, out)
    }

    fn interface(&mut self, ahead: f64) -> Result<Option<Box<dyn InterfaceDynamics>>, BodyError> {
        let (structure, surface) = (&self.model.structure, &self.model.surface);
        let (middle, then) = (self.ahead(0.5 * ahead), self.ahead(ahead));
        let (displaced, jacobian) = (self.displacements(&then), structure.jacobian(&then));
        let map = &surface.layout.map;
        let rows = surface.attachments.iter().map(|a| rows_of(&map.influence(a, &displaced), &jacobian)).collect();
        let begin = |attachment| map.velocity(attachment, &self.state.displacement, &self.state.velocity);
        let begun = surface.attachments.iter().map(begin).collect();
        let parts =
            InterfaceParts { structure, rows, ahead: [&middle, &then], begun, gravity: self.gravity, dt: ahead };
        Ok(Some(Box::new(ModalInterface::new(parts))))
    }

    fn load(&mut self, force: WallForces<'_>) {
        let m = &mut self.state;
        m.mean.fill([0.0; 3]);
        m.now.fill([0.0; 3]);
        m.predicted_positions.clear();
        m.predicted_positions.extend(force.x.iter().zip(force.y).map(|(x, y)| [*x, *y]));
        m.force = self.model.surface.add_loads(&force, &m.displacement, &mut m.mean, &mut m.now);
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        let wrong = |error: structure_fe::Error| BodyError::structure(&self.name, &error);
        let m = &self.state;
        let each = m.mean.iter().zip(&m.impulses);
        let all: Vec<[f64; 3]> = each.map(|(load, more)| [0, 1, 2].map(|k| load[k] + more[k] / dt)).collect();
        let load = self.on_unknowns(&all);
        let frame = self.law.as_ref().map(|law| of_frame(&law(m.motion.time + dt)));
        let mut motion = m.motion.clone();
        let step = Step { dt, gravity: self.gravity, frame };
        let outcome = self.model.structure.step(&mut motion, &load, &step).map_err(wrong)?;
        let held = self.model.structure.held();
        let total = self.model.structure.total_mass();
        let begun = m.displacement.clone();
        self.state.motion = motion;
        self.equilibrate(dt)?;
        self.update_nodes();
        let m = &mut self.state;
        for k in 0..2 {
            m.external[k] += dt * total * self.gravity[k] + if held[k] { outcome.support_impulse[k] } else { 0.0 };
        }
        let each = m.displacement.iter().zip(&begun);
        let moved: Vec<[f64; 3]> = each.map(|(q, p)| [0, 1, 2].map(|k| q[k] - p[k])).collect();
        m.work += power(&all, &moved);
        m.dissipated += outcome.dissipated;
        m.support += outcome.support_work;
        m.impulses.fill([0.0; 3]);
        m.impulse_velocities.fill([0.0; 3]);
        let (displacement, stress) = (self.against_frame(), self.stress());
        let m = &mut self.state;
        m.extremes.record(&m.motion.amplitude, &displacement, &stress, m.motion.time);
        let frame = self.frame();
        match self.model.surface.update_outline(&frame, &self.state.displacement) {
            true => Ok(()),
            false => Err(BodyError::NotFinite { name: self.name.clone(), time: self.state.motion.time }),
        }
    }

    fn stable_dt(&self) -> f64 {
        self.longest_step
    }

    fn checkpoint(&mut self) {
        self.checkpoint = Some((self.state.clone(), self.model.surface.outline.clone()));
    }

    fn restore(&mut self) {
        if let Some((state, outline)) = &self.checkpoint {
            (self.state, self.model.surface.outline) = (state.clone(), outline.clone());
        }
    }

    fn to_bytes(&self) -> Vec<u8> {
        encode(&(&self.state, self.model.surface.outline.loops()))
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        const BODY: &str = "a body with modes";
        let (state, loops): (ModalBodyState, Vec<Vec<[f64; 2]>>) = decode(BODY, bytes)?;
        state.check(&self.state, self.model.surface.attachments.len())?;
        let wrong = |cause: &dyn Display| StateError::Unreadable(BODY, cause.to_string());
        self.model.surface.outline = Outline::deformed(loops).ok_or_else(|| wrong(&"its outline is not finite"))?;
        self.state = state;
        Ok(())
    }
}

impl Contact for ModalBody {
    fn signed_distance(&self, at: [f64; 2]) -> f64 {
        self.model.surface.signed_distance(at, &self.frame())
    }

    fn surface(&self, at: [f64; 2]) -> SurfacePoint {
        let ModalBodyState { displacement, velocity, impulse_velocities, .. } = &self.state;
        let each = velocity.iter().zip(impulse_velocities);
        let velocity: Vec<[f64; 3]> = each.map(|(v, s)| [0, 1, 2].map(|k| v[k] + s[k])).collect();
        self.model.surface.nearest(at, &self.frame(), displacement, &velocity)
    }

    fn inverse_effective_mass(&mut self, at: [f64; 2], normal: [f64; 2], dt: f64) -> f64 {
        self.state.dt = dt;
        let load = self.on_unknowns(&self.loads_of(at, normal));
        let velocities = self.velocities_under(&load, dt);
        load.iter().zip(&velocities).map(|(load, v)| load * v).sum::<f64>().max(0.0)
    }

    /// The half that is simulated takes its own impulse; the mirror image acts on the other half.
    fn apply_impulse(&mut self, contact: &ContactImpulse) {
        let loads = self.loads_of(contact.at, contact.impulse);
        let velocities = self.velocities_under(&self.on_unknowns(&loads), self.state.dt);
        let velocities = self.on_nodes(&self.state.motion, &velocities);
        let m = &mut self.state;
        let sums = m.impulses.iter_mut().zip(&loads).chain(m.impulse_velocities.iter_mut().zip(&velocities));
        sums.for_each(|(sum, more)| (0..3).for_each(|k| sum[k] += more[k]));
    }
}

impl Linked for ModalBody {}

impl Inspect for ModalBody {
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

    fn modes(&self) -> Option<ModesState> {
        let angle = self.state.motion.frame[2];
        let in_frame = |[x, y, moment]: &[f64; 3]| {
            let [x, y] = rotate([*x, *y], -angle);
            [x, y, *moment]
        };
        Some(ModesState {
            amplitude: self.state.motion.amplitude.clone(),
            displacement: self.against_frame(),
            stress: self.stress(),
            load: self.state.now[..self.state.now.len() - 1].iter().map(in_frame).collect(),
            extremes: self.state.extremes.clone(),
        })
    }

    fn material_point(&self, at: [f64; 2]) -> Option<(SurfacePoint, [f64; 2])> {
        Some(self.model.surface.material_point(at, self.nodes()))
    }

    fn energy(&self) -> Energy {
        let (structure, state, whole) = (&self.model.structure, &self.state, 1.0 / self.model.share);
        Energy {
            links: 0.0,
            kinetic: whole * structure.kinetic_energy(&state.motion),
            potential: whole * structure.potential_energy(&state.motion, self.gravity),
            elastic: whole * structure.strain_energy(&state.motion),
            work: whole * state.work,
            support: whole * state.support,
            dissipated: whole * state.dissipated,
        }
    }

    fn momentum(&self) -> Momentum {
        let [px, py] = self.model.structure.momentum(&self.state.motion);
        let impulse = |k: usize| self.state.impulses.iter().map(|node| node[k]).sum::<f64>();
        let momentum = self.both([px + impulse(0), py + impulse(1)]);
        Momentum { momentum, external: self.both(self.state.external) }
    }
}
