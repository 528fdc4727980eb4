//! An owner of walls that bends, as coupling schemes see it: an acceleration for each degree of freedom (THEORY C10).

use structure_fe::{Dynamics, EffectiveInertia, State};

use sph_core::yielding::{Encounter, Lack, Touch, Yields};
use sph_core::{WallForces, WallsMut};

use crate::body::BodyError;
use crate::carrier::{Carriage, Carrier, Influence};

/// Values of all nodes, `[nodes][x, y, turn]`.
type Field = Vec<[f64; 3]>;

/// A structure under the forces at the end of a step.
pub struct FlexibleYield {
    /// K4 of each boundary particle, at the end of the step.
    influences: Vec<Influence>,
    /// Accelerations that the particles' kinematics are written with [m/s², rad/s²].
    predicted: Field,
    /// What the accelerations now supposed are beyond these.
    change: Field,
    /// What the structure's forces alone would change: of the predicted motion, without the fluid.
    alone: Field,
    /// Inertia as a step of the structure sees it, M + θ²Δt²K + θΔt C.
    inertia: EffectiveInertia,
    /// Forces on the structure from anything but the fluid, less what the predicted accelerations need [N/m, N].
    lack: Field,
    /// By which turns count among the unknowns [m].
    scale: Vec<f64>,
}

impl FlexibleYield {
    /// Of a structure whose motion at the end of a step of `dt` [s] is predicted as `then`, under loads on its nodes besides
    /// the fluid's [N/m, N].
    pub fn new(
        name: &str,
        dynamics: &mut Dynamics,
        (carriage, carriers): (&Carriage, &[Carrier]),
        then: &State,
        weight: &[[f64; 3]],
        dt: f64,
    ) -> Result<FlexibleYield, BodyError> {
        let wrong = |error: structure_fe::Error| BodyError::structure(name, &error);
        let inertia = dynamics.effective_inertia(then, dt);
        let lack = dynamics.lack(then, weight);
        let alone = inertia.clone().solve(&lack).map_err(wrong)?;
        Ok(FlexibleYield {
            influences: carriers.iter().map(|carrier| carriage.influence(carrier, &then.displacement)).collect(),
            predicted: then.acceleration.clone(),
            change: vec![[0.0; 3]; alone.len()],
            alone,
            inertia,
            lack,
            scale: lengths(dynamics),
        })
    }

    /// K3: forces on the particles, as loads of the nodes.
    fn carried(&self, forces: impl Iterator<Item = [f64; 2]>) -> Field {
        let mut loads = vec![[0.0; 3]; self.predicted.len()];
        for (influence, force) in self.influences.iter().zip(forces) {
            influence.carry(force, &mut loads);
        }
        loads
    }

    /// C10: the inertia with the water that accelerates with the particles: blocks −Hᵀ push armᵀ H.
    fn with_water(&self, touches: &[Touch]) -> EffectiveInertia {
        let mut inertia = self.inertia.clone();
        for (influence, touch) in self.influences.iter().zip(touches).filter(|(_, t)| t.arm != [0.0; 2]) {
            let width = 3 * influence.count;
            let by = |v: [f64; 2], k: usize| v[0] * influence.rows[0][k] + v[1] * influence.rows[1][k];
            let entries = (0..width).flat_map(|i| (0..width).map(move |j| (i, j)));
            let block: Vec<f64> = entries.map(|(i, j)| -by(touch.push, i) * by(touch.arm, j)).collect();
            inertia.add(&influence.nodes[..influence.count], &block);
        }
        inertia
    }

    fn scaled(&self, field: &[[f64; 3]]) -> Vec<f64> {
        field.iter().zip(&self.scale).flat_map(|(a, scale)| [a[0], a[1], scale * a[2]]).collect()
    }
}

/// Half the mean length of the elements at each node [m]; of a node without one, half the model's.
fn lengths(dynamics: &Dynamics) -> Vec<f64> {
    let beam = dynamics.beam();
    let mut sums = vec![[0.0; 2]; beam.nodes().len()];
    let mut all = [0.0; 2];
    for (index, element) in beam.elements().iter().enumerate() {
        let length = beam.length(index);
        for sum in element.nodes.map(|node| node) {
            sums[sum] = [sums[sum][0] + length, sums[sum][1] + 1.0];
        }
        all = [all[0] + length, 2.0];
    }
    sums.iter()
        .map(|sum| if sum[1] > 0.0 { 0.5 * sum[0] / sum[1] } else { 0.5 * all[0].max(f64::MIN_POSITIVE) })
        .collect()
}

impl Yields for FlexibleYield {
    fn answer(&mut self, encounter: &Encounter<'_>, change: &mut [[f64; 2]]) {
        let mut loads = self.carried(encounter.touches.iter().map(|touch| touch.force));
        loads.as_flattened_mut().iter_mut().zip(self.lack.as_flattened()).for_each(|(load, lack)| *load += lack);
        // where these have no solution the structure's own step says so
        if let Ok(found) = self.with_water(encounter.touches).solve(&loads) {
            self.change = found;
        }
        for (change, influence) in change.iter_mut().zip(&self.influences) {
            *change = influence.of(&self.change);
        }
    }

    fn unknowns(&self) -> Vec<f64> {
        let each = self.predicted.iter().zip(&self.change);
        let now: Field = each.map(|(a, change)| [0, 1, 2].map(|k| a[k] + change[k])).collect();
        self.scaled(&now)
    }

    fn lack(&self, forces: &WallForces<'_>) -> Lack {
        let loads = self.carried(forces.fx.iter().zip(forces.fy).map(|(x, y)| [*x, *y]));
        let caused = self.inertia.clone().solve(&loads).unwrap_or_else(|_| self.change.clone());
        let each = caused.iter().zip(&self.alone).zip(&self.change);
        let lack: Field = each.map(|((c, a), x)| [0, 1, 2].map(|k| c[k] + a[k] - x[k])).collect();
        Lack { lack: self.scaled(&lack), caused: self.scaled(&caused) }
    }

    fn accelerate(&mut self, unknowns: &[f64], walls: WallsMut<'_>) {
        let each = self.predicted.iter().zip(&self.scale).zip(unknowns.as_chunks::<3>().0);
        self.change = each.map(|((a, scale), x)| [x[0] - a[0], x[1] - a[1], x[2] / scale - a[2]]).collect();
        for (k, influence) in self.influences.iter().enumerate() {
            let [x, y] = influence.of(&self.change);
            walls.ax[k] += x;
            walls.ay[k] += y;
        }
    }
}
