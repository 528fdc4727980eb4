//! The interface of a body that bends to coupling schemes: an acceleration for each unknown (THEORY CO18).

use sph_core::walls::interface::{InterfaceDynamics, InterfaceLoad, InterfaceResidual, ParticleLoad};
use sph_core::{WallForces, WallsMut};

/// The linear equations of a structure in a step, and how its boundary particles move with its unknowns.
pub trait StepEquations: Send + Sync {
    /// Add a force [N/m] on a boundary particle to loads on the unknowns (CO14).
    fn add_load(&self, particle: usize, force: [f64; 2], loads: &mut [f64]);

    /// Acceleration of a boundary particle [m/s²] due to accelerations of the unknowns.
    fn of_particle(&self, particle: usize, accelerations: &[f64]) -> [f64; 2];

    /// Accelerations of the unknowns under loads on them; `None` where there are none.
    fn solve(&self, loads: &[f64]) -> Option<Vec<f64>>;

    /// CO18: the same with the water that accelerates with the particles.
    fn solve_with_water(&self, touches: &[ParticleLoad], loads: Vec<f64>) -> Option<Vec<f64>>;
}

/// A structure under the forces at the end of a step.
pub struct BendingInterface<E> {
    pub(crate) equations: E,
    /// Accelerations that the particles' kinematics are written with.
    pub(crate) predicted: Vec<f64>,
    /// What the accelerations now supposed are beyond these.
    pub(crate) change: Vec<f64>,
    /// Forces from anything but the fluid, less what the predicted accelerations need.
    pub(crate) residual: Vec<f64>,
    /// What these alone would change; at the end, and in the mean of the step (CO24).
    pub(crate) alone: [Vec<f64>; 2],
    /// Velocities of the particles at the step's start [m/s].
    pub(crate) begun: Vec<[f64; 2]>,
    /// By which the unknowns' accelerations are scaled to [m/s²].
    pub(crate) scale: Vec<f64>,
}

impl<E: StepEquations> BendingInterface<E> {
    fn loads(&self, forces: impl Iterator<Item = [f64; 2]>) -> Vec<f64> {
        let mut loads = vec![0.0; self.predicted.len()];
        forces.enumerate().for_each(|(particle, force)| self.equations.add_load(particle, force, &mut loads));
        loads
    }

    /// CO18, CO24: residual of the accelerations under forces on the particles.
    fn residual_under(&self, fx: &[f64], fy: &[f64], alone: &[f64]) -> InterfaceResidual {
        let loads = self.loads(fx.iter().zip(fy).map(|(x, y)| [*x, *y]));
        let caused = self.equations.solve(&loads).unwrap_or_else(|| vec![0.0; loads.len()]);
        let residual = |k: usize| self.scale[k] * (caused[k] + alone[k] - self.change[k]);
        InterfaceResidual {
            residual: (0..caused.len()).map(residual).collect(),
            driving: caused.iter().zip(&self.scale).map(|(a, scale)| scale * a).collect(),
        }
    }
}

impl<E: StepEquations> InterfaceDynamics for BendingInterface<E> {
    fn solve_acceleration(&mut self, encounter: &InterfaceLoad<'_>, change: &mut [[f64; 2]]) {
        let mut loads = self.loads(encounter.particles.iter().map(|touch| touch.force));
        loads.iter_mut().zip(&self.residual).for_each(|(load, residual)| *load += residual);
        // where these have no solution the structure's own step says so
        if let Some(found) = self.equations.solve_with_water(encounter.particles, loads) {
            self.change = found;
        }
        (0..change.len()).for_each(|k| change[k] = self.equations.of_particle(k, &self.change));
    }

    fn unknowns(&self) -> Vec<f64> {
        (0..self.change.len()).map(|k| self.scale[k] * (self.predicted[k] + self.change[k])).collect()
    }

    fn residual(&self, forces: &WallForces<'_>) -> InterfaceResidual {
        self.residual_under(forces.fx, forces.fy, &self.alone[0])
    }

    fn residual_in_mean(&self, forces: &WallForces<'_>) -> InterfaceResidual {
        self.residual_under(forces.mean_fx, forces.mean_fy, &self.alone[1])
    }

    fn velocities_at_start(&self, velocities: &mut [[f64; 2]]) {
        velocities.copy_from_slice(&self.begun);
    }

    fn accelerate(&mut self, unknowns: &[f64], walls: WallsMut<'_>) {
        self.change = (0..unknowns.len()).map(|k| unknowns[k] / self.scale[k] - self.predicted[k]).collect();
        for k in 0..self.begun.len() {
            let [x, y] = self.equations.of_particle(k, &self.change);
            walls.ax[k] += x;
            walls.ay[k] += y;
        }
    }
}
