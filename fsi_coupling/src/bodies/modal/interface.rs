//! The interface of a body with modes to coupling schemes: an acceleration for each unknown (THEORY CO18, CO34).

use std::sync::Arc;

use faer::Mat;

use structure_fe::modal::{ModalMode, ModalState, ModalStructure};

use sph_core::walls::interface::ParticleLoad;

use crate::bodies::bending::interface::{BendingInterface, StepEquations};

/// The linear equations of a structure by its modes in a step.
pub(crate) struct ModalEquations {
    structure: Arc<ModalStructure>,
    /// CO34: rows x, y of each boundary particle by the unknowns, at the end of the step.
    rows: Vec<[Vec<f64>; 2]>,
    /// Inertia in a step (BE29).
    inertia: Mat<f64>,
}

/// Of a structure whose motion is predicted at the middle and at the end of a step of `dt` [s], under a gravity [m/s²]; `rows` are those of
/// the boundary particles, which begin with velocities `begun` [m/s].
pub(crate) fn interface_of(
    structure: &Arc<ModalStructure>,
    rows: Vec<[Vec<f64>; 2]>,
    [middle, then]: [&ModalState; 2],
    begun: Vec<[f64; 2]>,
    gravity: [f64; 2],
    dt: f64,
) -> BendingInterface<ModalEquations> {
    let unloaded = vec![0.0; structure.unknowns()];
    // of a rotation the mean lever arm, of a mode the largest displacement of its shape
    let arm = |rows: &[Vec<f64>; 2]| rows[0][2].hypot(rows[1][2]);
    let mean = rows.iter().map(arm).sum::<f64>() / rows.len().max(1) as f64;
    let largest = |mode: &ModalMode| mode.shape.iter().map(|[u, v, _]| u.hypot(*v)).fold(f64::MIN_POSITIVE, f64::max);
    let rigid = [1.0, 1.0, mean.max(f64::MIN_POSITIVE)];
    let scale = rigid.into_iter().chain(structure.modes().iter().map(largest)).collect();
    let inertia = structure.effective_inertia(then, dt);
    let [residual, amid] = [then, middle].map(|state| structure.residual(state, &unloaded, gravity));
    let equations = ModalEquations { structure: Arc::clone(structure), rows, inertia };
    let alone = [&residual, &amid].map(|own| equations.solve(own).unwrap_or_else(|| unloaded.clone()));
    let predicted = then.acceleration.clone();
    BendingInterface { equations, predicted, change: unloaded, residual, alone, begun, scale }
}

impl StepEquations for ModalEquations {
    fn add_load(&self, particle: usize, [fx, fy]: [f64; 2], loads: &mut [f64]) {
        let [along_x, along_y] = &self.rows[particle];
        for (k, load) in loads.iter_mut().enumerate() {
            *load += along_x[k] * fx + along_y[k] * fy;
        }
    }

    fn of_particle(&self, particle: usize, accelerations: &[f64]) -> [f64; 2] {
        [0, 1].map(|axis| self.rows[particle][axis].iter().zip(accelerations).map(|(row, a)| row * a).sum())
    }

    fn solve(&self, loads: &[f64]) -> Option<Vec<f64>> {
        self.structure.solve_free(self.inertia.clone(), loads.to_vec()).ok()
    }

    fn solve_with_water(&self, touches: &[ParticleLoad], loads: Vec<f64>) -> Option<Vec<f64>> {
        let mut inertia = self.inertia.clone();
        for (rows, touch) in self.rows.iter().zip(touches).filter(|(_, touch)| touch.arm != [0.0; 2]) {
            let by = |v: [f64; 2], k: usize| v[0] * rows[0][k] + v[1] * rows[1][k];
            for i in 0..inertia.nrows() {
                let push = by(touch.push, i);
                (0..inertia.ncols()).for_each(|j| inertia[(i, j)] -= push * by(touch.arm, j));
            }
        }
        self.structure.solve_free(inertia, loads).ok()
    }
}
