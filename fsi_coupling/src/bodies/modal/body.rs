//! A body whose surface bends in natural modes, on a rigid frame (THEORY CO34).

use serde::{Deserialize, Serialize};
use sph_core::state_bytes::{StateError, expect_count};
use structure_fe::Error;
use structure_fe::modal::{ModalState, Step};

use crate::bodies::bending::bending_surface::{BendingSurface, NodalMotion};
use crate::bodies::bending::body::BendingBody;
use crate::bodies::bending::frame::{in_frame, less, power};
use crate::bodies::bending::model::{BendingModel, Interface, StateOf};
use crate::bodies::bending::state::BendingState;
use crate::bodies::bending::surface_map::Influence;
use crate::bodies::error::BodyError;
use crate::bodies::modal::interface::interface_of;
use crate::bodies::modal::spec::{ModalModel, ModalSpec};
use crate::bodies::modes_state::{ModalExtremes, ModesState};
use crate::bodies::rigid_motion::RigidMotion;

/// A rigid frame with a part of the surface that moves in modes.
pub type ModalBody = BendingBody<ModalModel>;

/// Motion of the unknowns, and of the nodes, the frame last: displacements, velocities, accelerations.
#[derive(Clone, Serialize, Deserialize)]
pub struct ModalMotion {
    unknowns: ModalState,
    displacement: Vec<[f64; 3]>,
    velocity: Vec<[f64; 3]>,
    acceleration: Vec<[f64; 3]>,
}

impl ModalBody {
    /// The body at the start, undeformed, under its own weight alone.
    pub fn new(spec: ModalSpec) -> Result<ModalBody, BodyError> {
        let wrong = |error: Error| BodyError::structure(&spec.name, &error);
        let (model, surface) = ModalModel::new(&spec).map_err(wrong)?;
        let (start, nodes) = (spec.start, spec.nodes.len());
        let mut unknowns = model.structure.at_rest(start.position, start.angle);
        unknowns.velocity[..3].copy_from_slice(&of_frame(&start)[1]);
        if let Some(start) = spec.frame.prescribed_start() {
            unknowns.acceleration[..3].copy_from_slice(&of_frame(&start)[2]);
        }
        let with_stress = spec.modes.iter().all(|mode| !mode.stress.is_empty());
        let none = |n: usize| vec![[0.0; 2]; n];
        let extremes = ModalExtremes {
            amplitude: none(unknowns.amplitude.len()),
            displacement: none(nodes),
            stress: none(if with_stress { nodes } else { 0 }),
        };
        let (displacement, velocity, acceleration) = Default::default();
        let motion = ModalMotion { unknowns, displacement, velocity, acceleration };
        let mut state = BendingState::new(motion, nodes + 1, extremes);
        model.equilibrate(&mut state, 0.0).map_err(wrong)?;
        Ok(BendingBody::at_start((spec.name, spec.frame), (model, surface), state))
    }
}

impl ModalModel {
    /// Loads on the nodes, as loads on the unknowns: Jᵀ f.
    fn on_unknowns(&self, state: &ModalState, loads: &[[f64; 3]]) -> Vec<f64> {
        let mut sum = vec![0.0; self.structure.unknowns()];
        for (rows, load) in self.structure.jacobian(state).iter().zip(loads) {
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
        self.structure.jacobian(state).iter().map(of).collect()
    }

    /// Places of the nodes of a state less those at rest.
    fn displacements(&self, state: &ModalState) -> Vec<[f64; 3]> {
        less(&self.structure.places(state), &self.rest)
    }

    /// Accelerations in equilibrium with the fluid's load now, filtered for a step of `dt` [s]; motion of the nodes from that of the unknowns.
    fn equilibrate(&self, state: &mut StateOf<Self>, dt: f64) -> Result<(), Error> {
        let ModalMotion { unknowns: motion, displacement, velocity, acceleration } = &mut state.motion;
        let load = self.on_unknowns(motion, &state.now);
        self.structure.equilibrate(motion, &load, self.gravity, dt)?;
        *displacement = self.displacements(motion);
        *velocity = self.on_nodes(motion, &motion.velocity);
        let turning = self.structure.convective_acceleration(motion);
        *acceleration = self.on_nodes(motion, &motion.acceleration);
        let nodes = acceleration.len() - 1;
        // on the frame the map adds the centripetal part
        for (a, more) in acceleration.iter_mut().zip(turning).take(nodes) {
            (0..2).for_each(|k| a[k] += more[k]);
        }
        Ok(())
    }

    /// The unknowns `ahead` [s] from now: displacements at constant acceleration; where it is prescribed the frame by its law.
    fn unknowns_ahead(&self, now: &ModalState, ahead: f64) -> ModalState {
        let moved = |k: usize| ahead * (now.velocity[k] + 0.5 * ahead * now.acceleration[k]);
        ModalState {
            frame: [0, 1, 2].map(|k| now.frame[k] + moved(k)),
            amplitude: now.amplitude.iter().enumerate().map(|(j, q)| q + moved(3 + j)).collect(),
            velocity: now.velocity.iter().zip(&now.acceleration).map(|(v, a)| v + ahead * a).collect(),
            acceleration: now.acceleration.clone(),
            time: now.time + ahead,
        }
    }

    /// Velocities of the unknowns under impulses on them within a step of `dt` [s]; zero where the equations have no solution.
    fn unknowns_under(&self, state: &ModalState, impulses: &[f64], dt: f64) -> Vec<f64> {
        let inertia = self.structure.effective_inertia(state, dt.max(0.0));
        self.structure.solve_free(inertia, impulses.to_vec()).unwrap_or_else(|_| vec![0.0; impulses.len()])
    }

    /// Displacements of the nodes against the frame, in its axes [m].
    fn against_frame(&self, state: &StateOf<Self>) -> Vec<[f64; 2]> {
        let (amplitude, modes) = (&state.motion.unknowns.amplitude, self.structure.modes());
        let at = |node: usize, axis: usize| -> f64 {
            modes.iter().zip(amplitude).map(|(mode, q)| q * mode.shape[node][axis]).sum()
        };
        (0..state.motion.displacement.len() - 1).map(|node| [at(node, 0), at(node, 1)]).collect()
    }

    /// Stress at the nodes [Pa].
    fn stress_of(&self, state: &StateOf<Self>) -> Vec<f64> {
        let amplitude = &state.motion.unknowns.amplitude;
        let at = |node: usize| self.stress.iter().zip(amplitude).map(|(stress, q)| q * stress[node]).sum();
        (0..state.extremes.stress.len()).map(at).collect()
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

impl BendingModel for ModalModel {
    type Motion = ModalMotion;
    type Extremes = ModalExtremes;
    const BODY: &'static str = "a body with modes";

    fn nodes(ModalMotion { displacement, velocity, acceleration, .. }: &ModalMotion) -> NodalMotion<'_> {
        NodalMotion { displacement, velocity, acceleration }
    }

    fn time(motion: &mut ModalMotion) -> &mut f64 {
        &mut motion.unknowns.time
    }

    fn check(state: &StateOf<Self>, like: &StateOf<Self>) -> Result<(), StateError> {
        let (now, modes) = (&state.motion.unknowns, like.motion.unknowns.amplitude.len());
        expect_count("modes", now.amplitude.len(), modes)?;
        expect_count("modes", state.extremes.amplitude.len(), like.extremes.amplitude.len())?;
        expect_count("unknowns", now.velocity.len(), like.motion.unknowns.velocity.len())?;
        expect_count("unknowns", now.acceleration.len(), like.motion.unknowns.velocity.len())?;
        let ModalMotion { displacement, velocity, acceleration, .. } = &state.motion;
        for field in [displacement, velocity, acceleration] {
            expect_count("nodes", field.len(), like.mean.len())?;
        }
        expect_count("nodes", state.extremes.displacement.len(), like.extremes.displacement.len())?;
        expect_count("stresses", state.extremes.stress.len(), like.extremes.stress.len())
    }

    fn ahead(&self, motion: &ModalMotion, ahead: f64) -> Vec<[f64; 3]> {
        self.displacements(&self.unknowns_ahead(&motion.unknowns, ahead))
    }

    fn interface(&mut self, surface: &BendingSurface, now: &ModalMotion, dt: f64) -> Result<Interface, Error> {
        let [middle, then] = [0.5 * dt, dt].map(|ahead| self.unknowns_ahead(&now.unknowns, ahead));
        let jacobian = self.structure.jacobian(&then);
        let influences = surface.influences(&self.displacements(&then));
        let rows = influences.iter().map(|influence| rows_of(influence, &jacobian)).collect();
        let begun = surface.velocities(ModalModel::nodes(now));
        Ok(Box::new(interface_of(&self.structure, rows, [&middle, &then], begun, self.gravity, dt)))
    }

    fn prescribe(&mut self, _: &BendingSurface, frame: &RigidMotion) -> Result<(), Error> {
        self.prescribed = Some(of_frame(frame));
        Ok(())
    }

    fn step(&mut self, m: &mut StateOf<Self>, dt: f64) -> Result<(), Error> {
        let each = m.mean.iter().zip(&m.impulses);
        let all: Vec<[f64; 3]> = each.map(|(load, more)| [0, 1, 2].map(|k| load[k] + more[k] / dt)).collect();
        let load = self.on_unknowns(&m.motion.unknowns, &all);
        let step = Step { dt, gravity: self.gravity, frame: self.prescribed };
        let done = self.structure.step(&mut m.motion.unknowns, &load, &step)?;
        let begun = m.motion.displacement.clone();
        self.equilibrate(m, dt)?;
        let (held, total) = (self.structure.held(), self.structure.total_mass());
        for k in 0..2 {
            m.external[k] += dt * total * self.gravity[k] + if held[k] { done.support_impulse[k] } else { 0.0 };
        }
        m.work += power(&all, &less(&m.motion.displacement, &begun));
        m.dissipated += done.dissipated;
        m.support += done.support_work;
        let (displacement, stress, now) = (self.against_frame(m), self.stress_of(m), &m.motion.unknowns);
        m.extremes.record(&now.amplitude, &displacement, &stress, now.time);
        Ok(())
    }

    fn velocities_under(&mut self, motion: &ModalMotion, impulses: &[[f64; 3]], dt: f64) -> Vec<[f64; 3]> {
        let load = self.on_unknowns(&motion.unknowns, impulses);
        self.on_nodes(&motion.unknowns, &self.unknowns_under(&motion.unknowns, &load, dt))
    }

    fn response(&mut self, motion: &ModalMotion, impulses: &[[f64; 3]], dt: f64) -> f64 {
        let load = self.on_unknowns(&motion.unknowns, impulses);
        let velocities = self.unknowns_under(&motion.unknowns, &load, dt);
        load.iter().zip(&velocities).map(|(load, v)| load * v).sum::<f64>()
    }

    fn energies(&self, ModalMotion { unknowns, .. }: &ModalMotion) -> [f64; 3] {
        let potential = self.structure.potential_energy(unknowns, self.gravity);
        [self.structure.kinetic_energy(unknowns), potential, self.structure.strain_energy(unknowns)]
    }

    fn momentum(&self, motion: &ModalMotion) -> [f64; 2] {
        self.structure.momentum(&motion.unknowns)
    }

    fn modes(&self, state: &StateOf<Self>) -> Option<ModesState> {
        let now = &state.motion.unknowns;
        let load = state.now[..state.now.len() - 1].iter().map(|load| in_frame(load, now.frame[2]));
        Some(ModesState {
            amplitude: now.amplitude.clone(),
            displacement: self.against_frame(state),
            stress: self.stress_of(state),
            load: load.collect(),
            extremes: state.extremes.clone(),
        })
    }
}
