//! The interface of a flexible body to coupling schemes: an acceleration for each degree of freedom (THEORY CO18).

use sph_core::walls::interface::{InterfaceDynamics, InterfaceLoad, InterfaceResidual, ParticleLoad};
use sph_core::{WallForces, WallsMut};
use structure_fe::{Dynamics, EffectiveInertia, State};

use crate::bodies::bending::surface_map::{Attachment, Influence, SurfaceMap};
use crate::bodies::error::BodyError;

/// Values of all nodes, `[nodes][x, y, turn]`.
type Field = Vec<[f64; 3]>;

/// A structure under the forces at the end of a step.
pub struct FlexibleInterface {
    /// CO15 of each boundary particle, at the end of the step.
    influences: Vec<Influence>,
    /// Accelerations that the particles' kinematics are written with [m/s², rad/s²].
    predicted: Field,
    /// What the accelerations now supposed are beyond these.
    change: Field,
    /// What the structure's forces alone would change: of the predicted motion, without the fluid.
    alone: Field,
    /// Inertia in a step of the structure, M + θ²Δt²K + θΔt C.
    inertia: EffectiveInertia,
    /// Forces on the structure from anything but the fluid, less what the predicted accelerations need [N/m, N].
    residual: Field,
    /// As `alone`, of the mean accelerations of the step under its mean forces (CO24).
    alone_in_mean: Field,
    /// Velocities of the particles at the step's start [m/s].
    begun: Vec<[f64; 2]>,
    /// By which turns count among the unknowns [m].
    scale: Vec<f64>,
}

impl FlexibleInterface {
    /// Of a structure whose motion at the start and, as predicted, at the end of a step of `dt` [s] is `now` and `then`, under
    /// the loads on its nodes that are not the fluid's [N/m, N].
    pub fn new(
        name: &str,
        dynamics: &mut Dynamics,
        (map, attachments): (&SurfaceMap, &[Attachment]),
        (now, then): (&State, &State),
        weight: &[[f64; 3]],
        dt: f64,
    ) -> Result<FlexibleInterface, BodyError> {
        let wrong = |error: structure_fe::Error| BodyError::structure(name, &error);
        let amid = dynamics.residual(&amid(now, dynamics.end_weight(), dt), weight);
        let inertia = dynamics.effective_inertia(then, dt);
        let residual = dynamics.residual(then, weight);
        let alone = inertia.clone().solve(&residual).map_err(wrong)?;
        let alone_in_mean = inertia.clone().solve(&amid).map_err(wrong)?;
        let begin = |attachment| map.velocity(attachment, &now.displacement, &now.velocity);
        Ok(FlexibleInterface {
            influences: attachments.iter().map(|attachment| map.influence(attachment, &then.displacement)).collect(),
            predicted: then.acceleration.clone(),
            change: vec![[0.0; 3]; alone.len()],
            alone,
            alone_in_mean,
            begun: attachments.iter().map(begin).collect(),
            inertia,
            residual,
            scale: lengths(dynamics),
        })
    }

    /// CO14: forces on the particles, as loads of the nodes.
    fn loads(&self, forces: impl Iterator<Item = [f64; 2]>) -> Field {
        let mut loads = vec![[0.0; 3]; self.predicted.len()];
        for (influence, force) in self.influences.iter().zip(forces) {
            influence.add_load(force, &mut loads);
        }
        loads
    }

    /// CO18: the inertia with the water that accelerates with the particles: blocks −Hᵀ push armᵀ H.
    fn with_water(&self, touches: &[ParticleLoad]) -> EffectiveInertia {
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

    /// CO18, CO24: residual of the accelerations under forces on the particles, without those of the structure's own forces.
    fn residual_under(&self, fx: &[f64], fy: &[f64], alone: &[[f64; 3]]) -> InterfaceResidual {
        let loads = self.loads(fx.iter().zip(fy).map(|(x, y)| [*x, *y]));
        let caused = self.inertia.clone().solve(&loads).unwrap_or_else(|_| self.change.clone());
        let each = caused.iter().zip(alone).zip(&self.change);
        let residual: Field = each.map(|((c, a), x)| [0, 1, 2].map(|k| c[k] + a[k] - x[k])).collect();
        InterfaceResidual { residual: self.scaled(&residual), driving: self.scaled(&caused) }
    }

    fn scaled(&self, field: &[[f64; 3]]) -> Vec<f64> {
        field.iter().zip(&self.scale).flat_map(|(a, scale)| [a[0], a[1], scale * a[2]]).collect()
    }
}

/// CO24: the motion at which the trapezoidal rule takes the mean forces of a step, at the acceleration predicted.
fn amid(now: &State, theta: f64, dt: f64) -> State {
    let (part, State { displacement, velocity, acceleration, .. }) = (theta * dt, now);
    let each = velocity.iter().zip(acceleration);
    let on: Field = each.map(|(v, a)| [0, 1, 2].map(|k| v[k] + part * a[k])).collect();
    let moved = displacement.iter().zip(&on).map(|(q, v)| [0, 1, 2].map(|k| q[k] + part * v[k])).collect();
    State { displacement: moved, velocity: on, ..now.clone() }
}

/// Half the mean length of the elements at each node [m]; of a node without one, half the model's.
fn lengths(dynamics: &Dynamics) -> Vec<f64> {
    let beam = dynamics.beam();
    let mut halves = vec![Vec::new(); beam.nodes().len()];
    let mut all = 0.0;
    for (index, element) in beam.elements().iter().enumerate() {
        let half = 0.5 * beam.length(index);
        element.nodes.iter().for_each(|node| halves[*node].push(half));
        all += half;
    }
    let mean = |of: &Vec<f64>| of.iter().sum::<f64>() / of.len() as f64;
    halves.iter().map(|of| if of.is_empty() { all.max(f64::MIN_POSITIVE) } else { mean(of) }).collect()
}

impl InterfaceDynamics for FlexibleInterface {
    fn solve_acceleration(&mut self, encounter: &InterfaceLoad<'_>, change: &mut [[f64; 2]]) {
        let mut loads = self.loads(encounter.particles.iter().map(|touch| touch.force));
        loads
            .as_flattened_mut()
            .iter_mut()
            .zip(self.residual.as_flattened())
            .for_each(|(load, residual)| *load += residual);
        // where these have no solution the structure's own step says so
        if let Ok(found) = self.with_water(encounter.particles).solve(&loads) {
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

    fn residual(&self, forces: &WallForces<'_>) -> InterfaceResidual {
        self.residual_under(forces.fx, forces.fy, &self.alone)
    }

    fn residual_in_mean(&self, forces: &WallForces<'_>) -> InterfaceResidual {
        self.residual_under(forces.mean_fx, forces.mean_fy, &self.alone_in_mean)
    }

    fn velocities_at_start(&self, velocities: &mut [[f64; 2]]) {
        velocities.copy_from_slice(&self.begun);
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

#[cfg(test)]
mod tests {
    use structure_fe::{Beam, Damping, Integration, Material, Section, Supports};

    use super::*;
    use crate::bodies::bending::beam_surface::BeamSurface;

    /// A panel on a free rigid body, bent and moving; particles on both, each with its force and what is behind it.
    fn panel_on_a_body() -> (FlexibleInterface, Vec<ParticleLoad>) {
        let material = Material { youngs_modulus: 1e6, poissons_ratio: 0.3, density: 500.0 };
        let beam = Beam::straight([0.0; 2], [1.0, 0.0], 4, material, Section::strip(0.02)).expect("a beam");
        let (beam, frame) = beam.with_rigid_body([-0.3, 0.1], 2.0, 0.1).expect("a body");
        let mut supports = Supports::default();
        supports.link(frame, 0);
        let rule = Integration::Trapezoidal { spectral_radius: 0.8 };
        let mut dynamics = Dynamics::new(beam, supports, rule, Damping::default()).expect("a model");
        let surface = BeamSurface::new(dynamics.beam().nodes().to_vec(), (0..4).map(|e| [e, e + 1]).collect());
        let map = SurfaceMap { surface, frame, reference: [-0.3, 0.1] };
        let mut attachments = vec![map.on_frame([-0.4, 0.0], [0.0, 1.0]), map.on_frame([-0.2, 0.15], [0.0, 1.0])];
        let point = |k: u32| Attachment::Beam(map.surface.attach([0.05 + 0.1 * f64::from(k), 0.01], [0.0, 1.0]));
        attachments.extend((0..10).map(point));
        let mut then = dynamics.at_rest();
        let weight = dynamics.gravity_load([0.0, -9.81]);
        dynamics.equilibrate(&mut then, &weight).expect("a start");
        for _ in 0..20 {
            dynamics.step(&mut then, &weight, 0.01).expect("a step");
        }
        let owner = FlexibleInterface::new("panel", &mut dynamics, (&map, &attachments), (&then, &then), &weight, 0.01);
        let touch = |k: usize| {
            let x = k as f64;
            let (force, push) = ([3.0 * x.sin(), 20.0 + 5.0 * x.cos()], [0.3 * x.cos(), 40.0 + 3.0 * x.sin()]);
            ParticleLoad { at: [0.0; 2], force, push, arm: [0.002 * x.sin(), -0.03 + 0.001 * x.cos()] }
        };
        (owner.expect("an owner"), (0..attachments.len()).map(touch).collect())
    }

    /// Under the forces that the accelerations found cause, nothing is lacking: to rounding; before, a lot is.
    #[test]
    fn accelerations_and_forces_fit() {
        let (mut owner, touches) = panel_on_a_body();
        let none = vec![0.0; touches.len()];
        let residual = |owner: &FlexibleInterface, change: &[[f64; 2]]| {
            let felt = |k: usize, axis: usize| {
                let ParticleLoad { force, push, arm, .. } = touches[k];
                force[axis] + push[axis] * (arm[0] * change[k][0] + arm[1] * change[k][1])
            };
            let [fx, fy] = [0, 1].map(|axis| (0..touches.len()).map(|k| felt(k, axis)).collect::<Vec<f64>>());
            let forces = WallForces {
                x: &none,
                y: &none,
                fx: &fx,
                fy: &fy,
                mean_fx: &fx,
                mean_fy: &fy,
                mean_swing: &none,
                mirrored: false,
            };
            owner.residual(&forces).residual.iter().fold(0.0_f64, |most, residual| most.max(residual.abs()))
        };
        let mut change = vec![[0.0; 2]; touches.len()];
        let before = residual(&owner, &change);
        owner.solve_acceleration(&InterfaceLoad { particles: &touches, offset: 0.0, mirrored: false }, &mut change);
        let after = residual(&owner, &change);
        assert!(before > 1.0 && after < 1e-11 * before, "{before} m/s^2 before, {after} after");
    }

    /// Unknowns given back are the accelerations taken, and the particles get what their nodes get.
    #[test]
    fn unknowns_move_the_particles() {
        let (mut owner, touches) = panel_on_a_body();
        let mut change = vec![[0.0; 2]; touches.len()];
        owner.solve_acceleration(&InterfaceLoad { particles: &touches, offset: 0.0, mirrored: false }, &mut change);
        let found = owner.unknowns();
        let (mut other, _) = panel_on_a_body();
        let n = touches.len();
        let mut arrays: Vec<Vec<f64>> = vec![vec![0.0; n]; 8];
        let [x, y, u, v, ax, ay, nx, ny] = arrays.get_disjoint_mut([0, 1, 2, 3, 4, 5, 6, 7]).expect("eight arrays");
        other.accelerate(&found, WallsMut { x, y, u, v, ax, ay, nx, ny });
        for k in 0..n {
            assert!(
                (arrays[4][k] - change[k][0]).hypot(arrays[5][k] - change[k][1]) < 1e-9 * change[k][1].abs(),
                "{k}"
            );
        }
        for (a, b) in other.unknowns().iter().zip(&found) {
            assert!((a - b).abs() < 1e-12 * b.abs().max(1.0), "{a} {b}");
        }
    }
}
