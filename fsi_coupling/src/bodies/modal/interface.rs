//! The interface of a body with modes to coupling schemes: an acceleration for each unknown (THEORY CO18, CO34).

use std::sync::Arc;

use faer::Mat;

use structure_fe::modal::{ModalState, ModalStructure};

use sph_core::walls::interface::{InterfaceDynamics, InterfaceLoad, InterfaceResidual, ParticleLoad};
use sph_core::{WallForces, WallsMut};

/// A structure by its modes under the forces at the end of a step.
pub struct ModalInterface {
    structure: Arc<ModalStructure>,
    /// CO34: rows x, y of each boundary particle by the unknowns, at the end of the step.
    rows: Vec<[Vec<f64>; 2]>,
    /// Accelerations that the particles' kinematics are written with.
    predicted: Vec<f64>,
    /// What the accelerations now supposed are beyond these.
    change: Vec<f64>,
    /// Inertia in a step (BE29).
    inertia: Mat<f64>,
    /// Forces from anything but the fluid, less what the predicted accelerations need; at the end, and in the mean of the step.
    residual: [Vec<f64>; 2],
    /// Velocities of the particles at the step's start [m/s].
    begun: Vec<[f64; 2]>,
    /// By which the unknowns' accelerations are scaled to [m/s²].
    scale: Vec<f64>,
}

/// What an interface is made of.
pub(crate) struct InterfaceParts<'a> {
    pub structure: &'a Arc<ModalStructure>,
    /// Rows of the boundary particles, at the end of the step.
    pub rows: Vec<[Vec<f64>; 2]>,
    /// The motion predicted at the middle and at the end of the step.
    pub ahead: [&'a ModalState; 2],
    /// Velocities of the particles at the step's start [m/s].
    pub begun: Vec<[f64; 2]>,
    pub gravity: [f64; 2],
    /// Length of the step [s].
    pub dt: f64,
}

impl ModalInterface {
    pub(crate) fn new(parts: InterfaceParts<'_>) -> ModalInterface {
        let InterfaceParts { structure, rows, ahead: [middle, then], begun, gravity, dt } = parts;
        let unloaded = vec![0.0; structure.unknowns()];
        // of a rotation the mean lever arm, of a mode the largest displacement of its shape
        let arm = |rows: &[Vec<f64>; 2]| rows[0][2].hypot(rows[1][2]);
        let mean = rows.iter().map(arm).sum::<f64>() / rows.len().max(1) as f64;
        let largest = |mode: &structure_fe::modal::ModalMode| {
            mode.shape.iter().map(|[u, v, _]| u.hypot(*v)).fold(f64::MIN_POSITIVE, f64::max)
        };
        let rigid = [1.0, 1.0, mean.max(f64::MIN_POSITIVE)];
        ModalInterface {
            rows,
            predicted: then.acceleration.clone(),
            change: unloaded.clone(),
            inertia: structure.effective_inertia(then, dt),
            residual: [then, middle].map(|state| structure.residual(state, &unloaded, gravity)),
            begun,
            scale: rigid.into_iter().chain(structure.modes().iter().map(largest)).collect(),
            structure: Arc::clone(structure),
        }
    }

    /// CO34: forces on the particles, as loads on the unknowns.
    fn loads(&self, forces: impl Iterator<Item = [f64; 2]>) -> Vec<f64> {
        let mut loads = vec![0.0; self.predicted.len()];
        for ([along_x, along_y], [fx, fy]) in self.rows.iter().zip(forces) {
            for (k, load) in loads.iter_mut().enumerate() {
                *load += along_x[k] * fx + along_y[k] * fy;
            }
        }
        loads
    }

    /// CO18: the inertia with the water that accelerates with the particles.
    fn with_water(&self, touches: &[ParticleLoad]) -> Mat<f64> {
        let mut inertia = self.inertia.clone();
        for (rows, touch) in self.rows.iter().zip(touches).filter(|(_, touch)| touch.arm != [0.0; 2]) {
            let by = |v: [f64; 2], k: usize| v[0] * rows[0][k] + v[1] * rows[1][k];
            for i in 0..inertia.nrows() {
                let push = by(touch.push, i);
                (0..inertia.ncols()).for_each(|j| inertia[(i, j)] -= push * by(touch.arm, j));
            }
        }
        inertia
    }

    /// CO18, CO24: residual of the accelerations under forces on the particles, without those of the structure's own forces.
    fn residual_under(&self, fx: &[f64], fy: &[f64], own: &[f64]) -> InterfaceResidual {
        let loads = self.loads(fx.iter().zip(fy).map(|(x, y)| [*x, *y]));
        let none = || vec![0.0; self.change.len()];
        let solve = |right: &[f64]| self.structure.solve_free(self.inertia.clone(), right.to_vec());
        let (caused, alone) = (solve(&loads).unwrap_or_else(|_| none()), solve(own).unwrap_or_else(|_| none()));
        let lacking = |k: usize| self.scale[k] * (caused[k] + alone[k] - self.change[k]);
        InterfaceResidual {
            residual: (0..caused.len()).map(lacking).collect(),
            driving: caused.iter().zip(&self.scale).map(|(a, scale)| scale * a).collect(),
        }
    }

    /// What the change adds to the acceleration of a particle [m/s²].
    fn added(&self, particle: usize) -> [f64; 2] {
        [0, 1].map(|axis| self.rows[particle][axis].iter().zip(&self.change).map(|(row, a)| row * a).sum())
    }
}

impl InterfaceDynamics for ModalInterface {
    fn solve_acceleration(&mut self, encounter: &InterfaceLoad<'_>, change: &mut [[f64; 2]]) {
        let mut loads = self.loads(encounter.particles.iter().map(|touch| touch.force));
        loads.iter_mut().zip(&self.residual[0]).for_each(|(load, residual)| *load += residual);
        // where these have no solution the structure's own step says so
        if let Ok(found) = self.structure.solve_free(self.with_water(encounter.particles), loads) {
            self.change = found;
        }
        (0..change.len()).for_each(|k| change[k] = self.added(k));
    }

    fn unknowns(&self) -> Vec<f64> {
        (0..self.change.len()).map(|k| self.scale[k] * (self.predicted[k] + self.change[k])).collect()
    }

    fn residual(&self, forces: &WallForces<'_>) -> InterfaceResidual {
        self.residual_under(forces.fx, forces.fy, &self.residual[0])
    }

    fn residual_in_mean(&self, forces: &WallForces<'_>) -> InterfaceResidual {
        self.residual_under(forces.mean_fx, forces.mean_fy, &self.residual[1])
    }

    fn velocities_at_start(&self, velocities: &mut [[f64; 2]]) {
        velocities.copy_from_slice(&self.begun);
    }

    fn accelerate(&mut self, unknowns: &[f64], walls: WallsMut<'_>) {
        self.change = (0..unknowns.len()).map(|k| unknowns[k] / self.scale[k] - self.predicted[k]).collect();
        for k in 0..self.rows.len() {
            let [x, y] = self.added(k);
            walls.ax[k] += x;
            walls.ay[k] += y;
        }
    }
}
