//! The element at work: one step of the host after the other.

use serde::{Deserialize, Serialize};
use sph_core::{Breakdown, StateError};

use super::added_mass::AddedMass;
use super::error::HostError;
use super::nodes::HostNodes;
use super::surface::HostLink;
use crate::coupling::coupled::Coupled;
use crate::coupling::error::CouplingError;
use crate::coupling::penetration::Penetration;

/// Rounding that a division of a step may have [-].
const ROUNDING: f64 = 1e-9;

/// A step of the host.
#[derive(Clone, Copy, Debug)]
pub struct HostStep<'a> {
    /// Its length [s].
    pub dt: f64,
    /// The nodes at its end. Positions and velocities belong together as those of a smooth motion do, x' = x + ½Δt (v + v')
    /// to third order: the path between follows both (THEORY CO29), and its acceleration is in the water's pressure.
    pub nodes: &'a HostNodes,
}

/// What the water did in a step of the host.
#[derive(Clone, Debug, PartialEq)]
pub struct Contribution {
    /// Steps that the water took.
    pub fluid_steps: u32,
    /// Longest step that the water could take next [s].
    pub fluid_dt: f64,
    /// Longest next step of a host with explicit coupling [s] (THEORY CO32): an estimate, infinite where masses are
    /// unknown or the surface is dry.
    pub host_dt: f64,
    /// Energy given to the nodes [J/m] (THEORY CO31).
    pub work: f64,
    /// Impulse given to the nodes, all together [N s/m]: Δt times the sum of the forces.
    pub impulse: [f64; 2],
    /// Water beyond a wall's surface at the end.
    pub penetration: Penetration,
}

/// The water and the surface at one instant. Particles in the order of their identity, the same at every instant.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    /// Time [s].
    pub time: f64,
    /// Positions of the water's particles [m].
    pub position: Vec<[f64; 2]>,
    /// Their velocities [m/s].
    pub velocity: Vec<[f64; 2]>,
    /// Their pressures [Pa].
    pub pressure: Vec<f64>,
    /// Their spacings √(m/ρ₀) [m].
    pub spacing: Vec<f64>,
    /// The nodes' surfaces, each a closed line [m].
    pub surface: Vec<Vec<[f64; 2]>>,
    /// The nodes.
    pub nodes: HostNodes,
    /// Forces of the water on the nodes now, `[F_x, F_y, M]` [N/m, N/m, N].
    pub force: Vec<[f64; 3]>,
}

/// Limits of an element's steps.
#[derive(Clone, Copy, Debug)]
pub struct ElementLimits {
    /// Speed that no wet node may exceed [m/s].
    pub sound_speed: f64,
    /// Steps of the water above which a step of the host is refused [-].
    pub most_substeps: f64,
    /// Longest step of the water [s], where it is shorter than the stable one; infinite for no limit.
    pub longest_fluid_step: f64,
    /// Shortest step of the host [s].
    pub shortest_step: f64,
    /// The water's inertia against the host's, where its masses are known.
    pub added_mass: Option<AddedMass>,
}

/// Shortest step of a host over that of the water at the start [-]. A projection corrects the places of particles within a step,
/// whatever its length: at 0.3 of the water's step the force of one shorter step was 3 times too large, below that in proportion to
/// 1/Δt.
const SHORTEST_OF_PROJECTION: f64 = 0.05;
/// The same where an equation of state gives the pressure: from about 1e-5 on velocities and accelerations lose their digits.
const SHORTEST: f64 = 1e-3;

/// Shortest step of a host [s] for water that steps by `fluid_dt` [s] at the start.
pub fn shortest_step(incompressible: bool, fluid_dt: f64) -> f64 {
    fluid_dt * if incompressible { SHORTEST_OF_PROJECTION } else { SHORTEST }
}

/// A region of water that pushes a host's nodes.
pub struct FluidElement {
    system: Coupled,
    link: HostLink,
    limits: ElementLimits,
    broken: Option<String>,
    saved: bool,
}

impl FluidElement {
    /// Of a system whose first body is a host's surface, and the surface's other end.
    pub fn of(system: Coupled, link: HostLink, limits: ElementLimits) -> FluidElement {
        FluidElement { system, link, limits, broken: None, saved: false }
    }

    /// The water goes through one step of the host with the nodes, which move smoothly to where `step` says, in as many
    /// steps of the water as are needed; `nodal_forces` becomes the mean force on each node, `[F_x, F_y, M]` [N/m, N/m, N]:
    /// times Δt they are the impulse that the water lost, to rounding (THEORY CO31).
    ///
    /// A refused input changes nothing. After a step that failed the element can be read and restored.
    pub fn contribute(&mut self, step: HostStep<'_>, nodal_forces: &mut [[f64; 3]]) -> Result<Contribution, HostError> {
        self.contribute_observed(step, nodal_forces, |_| ())
    }

    /// As [`FluidElement::contribute`]; `observe` is called after each step of the water, and must not change what flows.
    pub fn contribute_observed(
        &mut self,
        step: HostStep<'_>,
        nodal_forces: &mut [[f64; 3]],
        mut observe: impl FnMut(&mut Coupled),
    ) -> Result<Contribution, HostError> {
        self.refuse(step, nodal_forces.len())?;
        let start = self.time();
        let work = {
            let mut shared = self.link.shared.open();
            shared.path = shared.path.onward(step.nodes, step.dt);
            shared.elapsed = 0.0;
            shared.impulse.fill([0.0; 3]);
            shared.work
        };
        let mut fluid_steps = 0;
        let ended = self.sub_cycle(step.dt, &mut fluid_steps, &mut observe).and_then(|()| self.system.stable_dt());
        let fluid_dt = ended.map_err(|cause| {
            let error = HostError::Step { node: self.nearest_node(&cause), cause, start, fluid_steps };
            self.broken = Some(error.to_string());
            error
        })?;
        let (done, wet) = {
            let shared = self.link.shared.open();
            for (force, impulse) in nodal_forces.iter_mut().zip(&shared.impulse) {
                *force = impulse.map(|j| j / step.dt);
            }
            (shared.work - work, shared.impulse.iter().any(|j| *j != [0.0; 3]))
        };
        let mut impulse = [0.0; 2];
        for force in nodal_forces.iter() {
            (0..2).for_each(|k| impulse[k] += step.dt * force[k]);
        }
        let host_dt = self.limits.added_mass.filter(|_| wet).map_or(f64::INFINITY, |a| a.host_dt);
        Ok(Contribution { fluid_steps, fluid_dt, host_dt, work: done, impulse, penetration: self.system.penetration() })
    }

    /// Steps of the water, as few as are stable: before each the rest of the host's step is divided into equal ones.
    fn sub_cycle(
        &mut self,
        dt: f64,
        fluid_steps: &mut u32,
        observe: &mut impl FnMut(&mut Coupled),
    ) -> Result<(), CouplingError> {
        loop {
            let rest = dt - self.link.shared.open().elapsed;
            if rest <= ROUNDING * dt {
                return Ok(());
            }
            let longest = self.system.stable_dt()?.min(self.limits.longest_fluid_step);
            let parts = (rest / longest - ROUNDING).ceil().max(1.0);
            self.system.step_or_shorter(rest / parts)?;
            *fluid_steps += 1;
            observe(&mut self.system);
        }
    }

    fn refuse(&self, step: HostStep<'_>, forces: usize) -> Result<(), HostError> {
        if let Some(why) = &self.broken {
            return Err(HostError::Failed(why.clone()));
        }
        let time = self.time();
        let duration = |expected: String| Err(HostError::Duration { given: step.dt, expected, time });
        if !(step.dt > 0.0 && step.dt.is_finite()) {
            return duration("a number above 0".into());
        }
        let shortest = self.limits.shortest_step;
        if step.dt < shortest {
            return duration(format!("at least {shortest:.3e} s: forces of shorter steps of this water are wrong"));
        }
        let end = self.link.shared.open().path.end().clone();
        step.nodes.check(end.len(), self.link.rotations, time + step.dt)?;
        self.link.pairs.check(step.nodes, time + step.dt)?;
        if forces != end.len() {
            return Err(HostError::Length { array: "nodal forces", given: forces, expected: end.len() });
        }
        let longest = self.limits.most_substeps * self.system.stable_dt().unwrap_or(f64::MAX);
        if step.dt > longest {
            return duration(format!(
                "at most {longest:.3e} s: most_substeps = {} steps of the water",
                self.limits.most_substeps
            ));
        }
        for &node in &self.link.wet {
            let (from, to, v) = (end.position[node], step.nodes.position[node], step.nodes.velocity[node]);
            let mean = (to[0] - from[0]).hypot(to[1] - from[1]) / step.dt;
            let arm = self.link.arms[node];
            let turned = |values: &[f64]| values.get(node).copied().unwrap_or(0.0);
            let turn = (turned(&step.nodes.rotation) - turned(&end.rotation)).abs() / step.dt;
            let spin = turned(&step.nodes.spin).abs();
            let speeds = [
                ("mean speed", mean),
                ("speed", v[0].hypot(v[1])),
                ("mean speed of turning at the outline", arm * turn),
                ("speed of turning at the outline", arm * spin),
            ];
            for (quantity, speed) in speeds {
                if speed > self.limits.sound_speed {
                    let given = format!("{speed:.6e} m/s");
                    let expected = format!("at most the speed of sound, {} m/s", self.limits.sound_speed);
                    return Err(HostError::Node { node, quantity, given, expected, time: time + step.dt });
                }
            }
        }
        Ok(())
    }

    /// The wet node nearest to where something broke.
    fn nearest_node(&self, cause: &CouplingError) -> Option<usize> {
        let at = match *cause {
            CouplingError::Fluid(
                Breakdown::NotFinite { x, y, .. } | Breakdown::Density { x, y, .. } | Breakdown::Step { x, y, .. },
            )
            | CouplingError::Collision { x, y, .. } => [x, y],
            _ => return None,
        };
        let position = self.nodes().position;
        let distance = |node: &usize| (position[*node][0] - at[0]).hypot(position[*node][1] - at[1]);
        self.link.wet.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Show water and walls to an observer that must not change what flows.
    pub fn observe(&mut self, observe: impl FnOnce(&mut Coupled)) {
        observe(&mut self.system);
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.link.shared.open().path.end().len()
    }

    /// Time of the water [s].
    pub fn time(&self) -> f64 {
        self.system.fluid.time()
    }

    /// The nodes at the present time of the water.
    pub fn nodes(&self) -> HostNodes {
        let shared = self.link.shared.open();
        if shared.elapsed >= shared.path.duration() {
            shared.path.end().clone()
        } else {
            shared.path.at(shared.elapsed)
        }
    }

    /// Forces of the water on the nodes now, to predict the next step with.
    pub fn forces_now(&self) -> Vec<[f64; 3]> {
        self.link.shared.open().now.clone()
    }

    /// Longest step that the water could take next [s].
    pub fn fluid_dt(&self) -> Result<f64, HostError> {
        let refused =
            |cause| HostError::Step { node: self.nearest_node(&cause), cause, start: self.time(), fluid_steps: 0 };
        self.system.stable_dt().map_err(refused)
    }

    /// Store the present state; it replaces the one stored before.
    pub fn save(&mut self) {
        if self.broken.is_none() {
            self.system.checkpoint();
            self.saved = true;
        }
    }

    /// Return to the state last saved, as often as needed. A step redone from there gives the same bits.
    pub fn restore(&mut self) -> Result<(), HostError> {
        if !self.saved {
            return Err(HostError::NothingSaved);
        }
        self.system.restore();
        self.broken = None;
        Ok(())
    }

    /// The present state as bytes, to continue in another process; an element that failed has none.
    pub fn to_bytes(&self) -> Result<Vec<u8>, HostError> {
        self.broken.as_ref().map_or_else(|| Ok(self.system.to_bytes()), |why| Err(HostError::Failed(why.clone())))
    }

    /// Take such a state, of an element built of the same specification, topology and nodes: the next step gives the same bits. After
    /// an error the element has failed.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), HostError> {
        self.saved = false;
        let restored = self.system.restore_bytes(bytes);
        self.broken = restored.as_ref().err().map(StateError::to_string);
        Ok(restored?)
    }

    /// Why it failed; `None` of an element that can be stepped.
    pub fn failure(&self) -> Option<&str> {
        self.broken.as_deref()
    }

    /// Water and walls inside, to be looked at: the nodes' surface is body 0, the basin body 1.
    pub fn system(&self) -> &Coupled {
        &self.system
    }

    /// Water and walls, without the element.
    pub fn into_system(self) -> Coupled {
        self.system
    }

    /// A picture of the present state.
    pub fn snapshot(&self) -> Snapshot {
        let (p, d, rho0) =
            (self.system.fluid.particles(), self.system.fluid.fields(), self.system.fluid.domain().fluid.density);
        let mut order: Vec<usize> = (0..p.len()).collect();
        order.sort_unstable_by_key(|k| p.id[*k]);
        let body = self.system.bodies().next().and_then(|body| body.motion().zip(body.outline()));
        let surface = body.map_or(Vec::new(), |(motion, outline)| {
            outline.loops().iter().map(|line| line.iter().map(|at| motion.point(*at)).collect()).collect()
        });
        Snapshot {
            time: self.time(),
            position: order.iter().map(|&k| [p.x[k], p.y[k]]).collect(),
            velocity: order.iter().map(|&k| [p.u[k], p.v[k]]).collect(),
            pressure: order.iter().map(|&k| d.pressure[k]).collect(),
            spacing: order.iter().map(|&k| (p.mass[k] / rho0).sqrt()).collect(),
            surface,
            nodes: self.nodes(),
            force: self.forces_now(),
        }
    }
}
