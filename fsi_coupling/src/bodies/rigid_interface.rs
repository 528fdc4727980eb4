//! Interface dynamics of a rigid body: three accelerations (THEORY CO5, CO8).

use sph_core::WallsMut;
use sph_core::walls::interface::{InterfaceDynamics, InterfaceLoad, InterfaceResidual, ParticleLoad};
use sph_core::walls::{Resultant, WallForces};

/// A rigid body under the forces at the end of a step. Directions: x, y [m], angle [rad].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RigidInterface {
    /// Centre of mass at the end of the step [m].
    pub position: [f64; 2],
    /// Mean velocity of the centre of mass over the step [m/s].
    pub velocity: [f64; 2],
    /// Length of the step [s].
    pub dt: f64,
    /// Acceleration that its particles' kinematics are written with [m/s², m/s², rad/s²].
    pub predicted: [f64; 3],
    /// Trial acceleration less the predicted one (CO5, CO8).
    pub change: [f64; 3],
    /// Inverse of mass and moment of inertia [m/kg, m/kg, 1/(kg m)]; 0 where it is held.
    pub inverse_mass: [f64; 3],
    /// Acceleration without a fluid [m/s², m/s², rad/s²].
    pub free_fall: [f64; 3],
}

impl RigidInterface {
    /// The centre of mass `offset` [s] from the end of the step: extrapolated at constant acceleration.
    fn position_at(&self, offset: f64) -> [f64; 2] {
        let curvature = 0.5 * offset * (offset + self.dt);
        [0, 1].map(|k| self.position[k] + offset * self.velocity[k] + curvature * self.predicted[k])
    }

    /// CO8: angular accelerations count by the radius of gyration [m], so that all unknowns are in m/s².
    fn scales(&self) -> [f64; 3] {
        let [x, y, angle] = self.inverse_mass;
        let gyration = if angle > 0.0 && x.max(y) > 0.0 { (x.max(y) / angle).sqrt() } else { 1.0 };
        [1.0, 1.0, gyration]
    }

    fn acceleration(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| self.predicted[k] + self.change[k])
    }

    /// Residual of an acceleration under a force and a moment about the centre of mass [N/m, N/m, N] (CO5).
    fn residual_of(&self, acceleration: [f64; 3], force: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| match self.inverse_mass[k] {
            0.0 => 0.0,
            inverse_mass => inverse_mass * force[k] + self.free_fall[k] - acceleration[k],
        })
    }

    /// CO8: residual of the present acceleration under a resultant about the centre of mass.
    fn residual_under(&self, Resultant { force: [x, y], moment }: Resultant) -> InterfaceResidual {
        let (force, scales) = ([x, y, moment], self.scales());
        let residual = self.residual_of(self.acceleration(), force);
        InterfaceResidual {
            residual: (0..3).map(|k| scales[k] * residual[k]).collect(),
            driving: (0..3).map(|k| scales[k] * self.inverse_mass[k] * force[k]).collect(),
        }
    }

    /// CO5: δa of (1 + M⁻¹ A) δa = M⁻¹ F + g − a.
    fn change_under(&self, force: [f64; 3], added: [[f64; 3]; 3]) -> [f64; 3] {
        let residual = self.residual_of(self.predicted, force);
        let row = |i: usize| {
            let own = |j: usize| if i == j { 1.0 } else { 0.0 };
            let [x, y, angle] = [0, 1, 2].map(|j| own(j) + self.inverse_mass[i] * added[i][j]);
            [x, y, angle, residual[i]]
        };
        solve([row(0), row(1), row(2)])
    }
}

impl InterfaceDynamics for RigidInterface {
    fn solve_acceleration(&mut self, encounter: &InterfaceLoad<'_>, change: &mut [[f64; 2]]) {
        let position = self.position_at(encounter.offset);
        let lever_arm = |touch: &ParticleLoad| [touch.at[0] - position[0], touch.at[1] - position[1]];
        let (mut force, mut added) = ([0.0; 3], [[0.0; 3]; 3]);
        for touch in encounter.particles {
            let (r, l) = (lever_arm(touch), touch.arm);
            accumulate(&mut force, touch.force, r, 1.0);
            // row i of A: force in direction i of unit accelerations, with its sign changed
            let along = [l[0], l[1], r[0] * l[1] - r[1] * l[0]];
            for (column, share) in along.iter().enumerate() {
                let mut unit = [0.0; 3];
                accumulate(&mut unit, touch.push, r, -share);
                (0..3).for_each(|i| added[i][column] += unit[i]);
            }
        }
        if encounter.mirrored {
            (force, added) = both_halves(force, added);
        }
        self.change = self.change_under(force, added);
        let [x, y, turn] = self.change;
        for (change, touch) in change.iter_mut().zip(encounter.particles) {
            let r = lever_arm(touch);
            *change = [x - turn * r[1], y + turn * r[0]];
        }
    }

    fn unknowns(&self) -> Vec<f64> {
        let (scales, a) = (self.scales(), self.acceleration());
        (0..3).map(|k| scales[k] * a[k]).collect()
    }

    fn residual(&self, forces: &WallForces<'_>) -> InterfaceResidual {
        self.residual_under(forces.resultant(self.position))
    }

    fn residual_in_mean(&self, forces: &WallForces<'_>) -> InterfaceResidual {
        self.residual_under(forces.mean_resultant(self.position_at(-self.dt)))
    }

    fn accelerate(&mut self, unknowns: &[f64], walls: WallsMut<'_>) {
        let scales = self.scales();
        self.change = [0, 1, 2].map(|k| unknowns[k] / scales[k] - self.predicted[k]);
        let [x, y, turn] = self.change;
        for k in 0..walls.x.len() {
            walls.ax[k] += x - turn * (walls.y[k] - self.position[1]);
            walls.ay[k] += y + turn * (walls.x[k] - self.position[0]);
        }
    }
}

/// The solution of three linear equations, right side last (Gauss, with the largest pivot of each column).
fn solve(mut rows: [[f64; 4]; 3]) -> [f64; 3] {
    for c in 0..3 {
        let pivot = (c..3).max_by(|&i, &j| rows[i][c].abs().total_cmp(&rows[j][c].abs())).unwrap_or(c);
        rows.swap(c, pivot);
        for i in c + 1..3 {
            let factor = rows[i][c] / rows[c][c];
            for j in c..4 {
                rows[i][j] -= factor * rows[c][j];
            }
        }
    }
    let mut x = [0.0; 3];
    for c in (0..3).rev() {
        let known: f64 = (c + 1..3).map(|k| rows[c][k] * x[k]).sum();
        x[c] = (rows[c][3] - known) / rows[c][c];
    }
    x
}

/// Add `scale` times a force at a lever arm to a force and moment.
fn accumulate(sum: &mut [f64; 3], force: [f64; 2], arm: [f64; 2], scale: f64) {
    sum[0] += scale * force[0];
    sum[1] += scale * force[1];
    sum[2] += scale * (arm[0] * force[1] - arm[1] * force[0]);
}

/// Force and added mass of both halves of a symmetric body: along y only.
fn both_halves(force: [f64; 3], added: [[f64; 3]; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
    let mut vertical = [[0.0; 3]; 3];
    vertical[1][1] = 2.0 * added[1][1];
    ([0.0, 2.0 * force[1], 0.0], vertical)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_equations_are_solved_whatever_their_order() {
        let exact = [1.5, -2.0, 0.25];
        let matrix = [[0.0, 2.0, 1.0], [3.0, -1.0, 0.5], [1e-9, 4.0, -7.0]];
        let found = solve([0, 1, 2].map(|i| {
            let [a, b, c]: [f64; 3] = matrix[i];
            [a, b, c, a * exact[0] + b * exact[1] + c * exact[2]]
        }));
        (0..3).for_each(|k| assert!((found[k] - exact[k]).abs() < 1e-13, "{found:?}"));
    }

    #[test]
    fn held_directions_do_not_accelerate() {
        let owner =
            RigidInterface { inverse_mass: [0.0, 0.5, 0.0], free_fall: [0.0, -9.81, 0.0], ..RigidInterface::default() };
        let added = [[7.0, 1.0, 2.0], [1.0, 6.0, 0.3], [0.1, 0.2, 0.9]];
        let found = owner.change_under([11.0, 30.0, -4.0], added);
        // (m + A) a = F + m g, with m = 2
        assert_eq!([found[0], found[2]], [0.0; 2]);
        assert!((found[1] - (30.0 - 2.0 * 9.81) / (2.0 + 6.0)).abs() < 1e-14, "{found:?}");
    }
}
