//! The interface of a flexible body to coupling schemes: an acceleration for each degree of freedom (THEORY CO18).

use sph_core::walls::interface::ParticleLoad;
use structure_fe::{Dynamics, EffectiveInertia, Error, State};

use crate::bodies::bending::interface::{BendingInterface, StepEquations};
use crate::bodies::bending::surface_map::Influence;

/// The linear equations of finite elements in a step. Turns count among the accelerations by a length [m].
pub(crate) struct PanelEquations {
    /// CO15 of each boundary particle, at the end of the step.
    influences: Vec<Influence>,
    /// Inertia in a step of the structure, M + θ²Δt²K + θΔt C.
    inertia: EffectiveInertia,
}

/// Of a structure whose motion at the start and, as predicted, at the end of a step of `dt` [s] is `now` and `then`, under the loads on
/// its nodes that are not the fluid's [N/m, N]; its particles have influences at the end and velocities at the start [m/s].
pub(crate) fn interface_of(
    dynamics: &mut Dynamics,
    (influences, begun): (Vec<Influence>, Vec<[f64; 2]>),
    (now, then): (&State, &State),
    weight: &[[f64; 3]],
    dt: f64,
) -> Result<BendingInterface<PanelEquations>, Error> {
    let amid = dynamics.residual(&amid(now, dynamics.end_weight(), dt), weight);
    let inertia = dynamics.effective_inertia(then, dt);
    let residual = dynamics.residual(then, weight);
    let alone = [inertia.clone().solve(&residual)?, inertia.clone().solve(&amid)?];
    Ok(BendingInterface {
        equations: PanelEquations { influences, inertia },
        predicted: then.acceleration.as_flattened().to_vec(),
        change: vec![0.0; 3 * then.acceleration.len()],
        residual: residual.as_flattened().to_vec(),
        alone: alone.map(|alone| alone.as_flattened().to_vec()),
        begun,
        scale: lengths(dynamics).iter().flat_map(|length| [1.0, 1.0, *length]).collect(),
    })
}

/// Values of the nodes in a row.
fn of_nodes(values: &[f64]) -> &[[f64; 3]] {
    values.as_chunks().0
}

impl StepEquations for PanelEquations {
    fn add_load(&self, particle: usize, force: [f64; 2], loads: &mut [f64]) {
        self.influences[particle].add_load(force, loads.as_chunks_mut().0);
    }

    fn of_particle(&self, particle: usize, accelerations: &[f64]) -> [f64; 2] {
        self.influences[particle].of(of_nodes(accelerations))
    }

    fn solve(&self, loads: &[f64]) -> Option<Vec<f64>> {
        self.inertia.clone().solve(of_nodes(loads)).ok().map(|found| found.as_flattened().to_vec())
    }

    /// Blocks −Hᵀ push armᵀ H.
    fn solve_with_water(&self, touches: &[ParticleLoad], loads: Vec<f64>) -> Option<Vec<f64>> {
        let mut inertia = self.inertia.clone();
        for (influence, touch) in self.influences.iter().zip(touches).filter(|(_, t)| t.arm != [0.0; 2]) {
            let width = 3 * influence.count;
            let by = |v: [f64; 2], k: usize| v[0] * influence.rows[0][k] + v[1] * influence.rows[1][k];
            let entries = (0..width).flat_map(|i| (0..width).map(move |j| (i, j)));
            let block: Vec<f64> = entries.map(|(i, j)| -by(touch.push, i) * by(touch.arm, j)).collect();
            inertia.add(&influence.nodes[..influence.count], &block);
        }
        inertia.solve(of_nodes(&loads)).ok().map(|found| found.as_flattened().to_vec())
    }
}

/// CO24: the motion at which the trapezoidal rule takes the mean forces of a step, at the acceleration predicted.
fn amid(now: &State, theta: f64, dt: f64) -> State {
    let (part, State { displacement, velocity, acceleration, .. }) = (theta * dt, now);
    let each = velocity.iter().zip(acceleration);
    let on: Vec<[f64; 3]> = each.map(|(v, a)| [0, 1, 2].map(|k| v[k] + part * a[k])).collect();
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

#[cfg(test)]
mod tests {
    use sph_core::walls::interface::{InterfaceDynamics, InterfaceLoad};
    use sph_core::{WallForces, WallsMut};
    use structure_fe::{Beam, Damping, Integration, Material, Section, Supports};

    use super::*;
    use crate::bodies::bending::beam_surface::BeamSurface;
    use crate::bodies::bending::surface_map::{Attachment, SurfaceMap};

    /// A panel on a free rigid body, bent and moving; particles on both, each with its force and what is behind it.
    fn panel_on_a_body() -> (BendingInterface<PanelEquations>, Vec<ParticleLoad>) {
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
        let begun = attachments.iter().map(|a| map.velocity(a, &then.displacement, &then.velocity)).collect();
        let influences = attachments.iter().map(|a| map.influence(a, &then.displacement)).collect();
        let owner = interface_of(&mut dynamics, (influences, begun), (&then, &then), &weight, 0.01);
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
        let residual = |owner: &BendingInterface<PanelEquations>, change: &[[f64; 2]]| {
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
