//! A free rigid body, moved by rapier. The only file that uses rapier.
//!
//! rapier is set for physics, not games: no gravity of its own, one solver iteration (its user force is
//! frozen over iterations, which feeds energy into stiff external forces), no sleeping, no velocity cap,
//! no continuous collision surprises, mass properties given. A step is kick–drift–kick with impulses
//! (THEORY CO2): second order, and the same impulses that the fluid's kicks carry.

mod links;

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use rapier2d::prelude::*;
use sph_core::state_bytes::{StateError, decode, encode};
use sph_core::walls::Resultant;
use sph_core::{InterfaceDynamics, PlateMidline, WallForces, WallPoint, WallsMut};

use crate::bodies::body::{Contact, Inspect, WettedBody};
use crate::bodies::error::BodyError;
use crate::bodies::rigid_interface::RigidInterface;
use crate::bodies::rigid_motion::RigidMotion;
use crate::bodies::rigid_spec::RigidSpec;
use crate::bodies::rigid_surface::RigidSurface;
use crate::bodies::sprung::{Sprung, SprungSpec, SprungState};
use crate::bodies::state::{ContactImpulse, Energy, Momentum, Motion, SurfacePoint};
use crate::geometry::outline::Outline;
use crate::geometry::rows::WallRows;
use crate::geometry::vector::{cross, dot, rotate};

/// A rigid body that moves under the fluid's load and gravity; any of x, y, angle may be held by a guide.
pub struct RigidBody2d {
    spec: RigidSpec,
    world: PhysicsWorld,
    handle: RigidBodyHandle,
    surface: RigidSurface,
    state: State,
    sprung: Vec<Sprung>,
    checkpoint: Option<(State, Vec<Sprung>, Pose, Vector, f64)>,
}

/// What a step changes, without rapier's position and velocities.
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
struct State {
    angle: f64,
    now: Resultant,
    mean: Resultant,
    kicked: Resultant,
    /// Of links, in the first half of the next step.
    reaction: Resultant,
    external: [f64; 2],
    work: f64,
    /// Mean velocities x, y, angle of the last step [m/s, m/s, rad/s].
    drift: [f64; 3],
    /// Work of links on the body [J/m].
    work_of_links: f64,
    time: f64,
}

impl RigidBody2d {
    /// Build the body; mass must be positive, and inertia too where rotation is free.
    pub fn new(spec: RigidSpec) -> Result<RigidBody2d, BodyError> {
        let wrong = |quantity, given| BodyError::Inertia { name: spec.name.clone(), quantity, given };
        if !(spec.mass > 0.0 && spec.mass.is_finite()) {
            return Err(wrong("mass", spec.mass));
        }
        if spec.free[2] && !(spec.inertia > 0.0 && spec.inertia.is_finite()) {
            return Err(wrong("inertia", spec.inertia));
        }
        if let Some(sprung) = spec.sprung.iter().find(|_| spec.free != [false, true, false]) {
            let reason = format!(
                "given free = {:?} with `{}` on its spring, expected a body that is free in y alone",
                spec.free, sprung.name
            );
            return Err(BodyError::Structure { name: spec.name.clone(), reason });
        }
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        world.integration_parameters.num_solver_iterations = 1;
        world.integration_parameters.max_ccd_substeps = 0;
        world.integration_parameters.normalized_max_linear_velocity = f64::MAX;
        let com = spec.center_of_mass;
        let start = RigidMotion {
            position: spec.position,
            angle: spec.angle,
            velocity: spec.velocity,
            angular_velocity: spec.angular_velocity,
            ..RigidMotion::default()
        };
        let v = start.point_velocity(com);
        let inertia = if spec.free[2] { spec.inertia } else { spec.inertia.max(spec.mass) };
        let body = RigidBodyBuilder::dynamic()
            .translation(Vector::new(spec.position[0], spec.position[1]))
            .rotation(spec.angle)
            .linvel(Vector::new(v[0], v[1]))
            .angvel(spec.angular_velocity)
            .additional_mass_properties(MassProperties::new(Vector::new(com[0], com[1]), spec.mass, inertia))
            .can_sleep(false)
            .allow_fast_rotation(true);
        let handle = world.insert_body(body);
        let body = &mut world.bodies[handle];
        body.set_enabled_translations(spec.free[0], spec.free[1], true);
        body.lock_rotations(!spec.free[2], true);
        body.recompute_mass_properties_from_colliders(&world.colliders);
        let surface = RigidSurface::new(spec.outline.clone(), com, spec.half);
        let state = State { angle: spec.angle, ..State::default() };
        let sprung = vec![Sprung { velocity: v[1], ..Sprung::default() }; spec.sprung.len()];
        Ok(RigidBody2d { spec, world, handle, surface, state, sprung, checkpoint: None })
    }

    /// The same, with a clock that starts at `time` [s].
    pub fn starting_at(mut self, time: f64) -> RigidBody2d {
        self.state.time = time;
        self
    }

    /// Motion of the centre of mass under the load now and gravity, guides holding what is not free.
    fn motion_now(&self) -> RigidMotion {
        self.motion_under(self.state.now + self.state.reaction)
    }

    /// The same under other loads.
    fn motion_under(&self, loads: Resultant) -> RigidMotion {
        let (body, spec) = (&self.world.bodies[self.handle], &self.spec);
        let (com, v) = (body.center_of_mass(), body.linvel());
        let of_springs = [0.0, self.springs(v.y).sum::<f64>()];
        let free = |k: usize, value: f64| if spec.free[k] { value } else { 0.0 };
        RigidMotion {
            position: [com.x, com.y],
            angle: self.state.angle,
            velocity: [v.x, v.y],
            angular_velocity: body.angvel(),
            acceleration: [0, 1].map(|k| free(k, (loads.force[k] + of_springs[k]) / spec.mass + spec.gravity[k])),
            angular_acceleration: free(2, loads.moment / spec.inertia.max(f64::MIN_POSITIVE)),
        }
    }

    /// Forces of the springs on the body, which moves upwards at `velocity` [m/s], upwards [N/m].
    fn springs(&self, velocity: f64) -> impl Iterator<Item = f64> + '_ {
        self.spec.sprung.iter().zip(&self.sprung).map(move |(spec, now)| spec.force(now, velocity))
    }

    /// CO35: kick the body and the masses by the springs and the masses' weight over `dt` [s].
    fn kick_springs(&mut self, dt: f64) {
        if self.sprung.is_empty() {
            return;
        }
        let velocity = self.world.bodies[self.handle].linvel().y;
        let forces: Vec<f64> = self.springs(velocity).collect();
        let gravity = self.spec.gravity[1];
        for ((spec, now), force) in self.spec.sprung.iter().zip(&mut self.sprung).zip(&forces) {
            now.velocity += dt * spec.acceleration(*force, gravity);
            now.dissipated += dt * spec.damping * (now.velocity - velocity).powi(2);
            self.state.external[1] += dt * spec.mass * gravity;
        }
        let impulse = Vector::new(0.0, dt * forces.iter().sum::<f64>());
        self.world.bodies[self.handle].apply_impulse(impulse, true);
    }

    /// The masses move on by `dt` [s] while the body goes up by `risen` [m].
    fn drift_springs(&mut self, dt: f64, risen: f64) {
        self.sprung.iter_mut().for_each(|now| now.extension += dt * now.velocity - risen);
    }

    /// Refuse a step [s] that is too long for a spring.
    fn check_springs(&self, dt: f64) -> Result<(), BodyError> {
        let longest = |spec: &SprungSpec| spec.longest_step(self.spec.mass);
        let Some(spec) = self.spec.sprung.iter().find(|spec| dt > longest(spec)) else { return Ok(()) };
        let (name, mass) = (self.spec.name.clone(), spec.name.clone());
        Err(BodyError::Spring { name, mass, step: dt, longest: longest(spec) })
    }

    /// Add the step's turn to the angle, which counts whole turns; rapier's wraps at ±π.
    fn unwrap_angle(&mut self) -> f64 {
        let wrapped = self.world.bodies[self.handle].rotation().angle();
        let turned = (wrapped - self.state.angle + PI).rem_euclid(TAU) - PI;
        self.state.angle += turned;
        turned
    }

    /// Take a state, rapier's position and velocities with it.
    fn set_state(
        &mut self,
        (state, sprung, pose, velocity, angular_velocity): (State, Vec<Sprung>, Pose, Vector, f64),
    ) {
        let body = &mut self.world.bodies[self.handle];
        body.set_position(pose, true);
        body.set_linvel(velocity, true);
        body.set_angvel(angular_velocity, true);
        body.recompute_mass_properties_from_colliders(&self.world.colliders);
        self.state = state;
        self.sprung = sprung;
    }

    /// Apply an impulse [N s/m] and an angular impulse [N s] at once; its work [J/m].
    fn apply(&mut self, Resultant { force: impulse, moment }: Resultant) -> f64 {
        let before = self.motion_now();
        let body = &mut self.world.bodies[self.handle];
        body.apply_impulse(Vector::new(impulse[0], impulse[1]), true);
        body.apply_torque_impulse(moment, true);
        let after = self.motion_now();
        let along = |k: usize| 0.5 * (before.velocity[k] + after.velocity[k]) * impulse[k];
        along(0) + along(1) + 0.5 * (before.angular_velocity + after.angular_velocity) * moment
    }

    /// CO2: give the body an impulse [N s/m] and an angular impulse; guides take their share. Updates the external impulses.
    fn kick(&mut self, load: Resultant, dt: f64) {
        let g = self.spec.gravity;
        for k in 0..2 {
            let weight = dt * self.spec.mass * g[k];
            self.state.external[k] += if self.spec.free[k] { weight } else { -dt * load.force[k] };
        }
        let impulse = [0, 1].map(|k| dt * (load.force[k] + self.spec.mass * g[k]));
        let body = &mut self.world.bodies[self.handle];
        body.apply_impulse(Vector::new(impulse[0], impulse[1]), true);
        body.apply_torque_impulse(dt * load.moment, true);
    }
}

impl WettedBody for RigidBody2d {
    fn sample(&mut self, rows: &WallRows) -> Result<Vec<WallPoint>, BodyError> {
        let motion = self.motion_now();
        Ok(self.surface.sample(&motion, rows))
    }

    fn kinematics(&self, ahead: f64, out: WallsMut<'_>) -> Vec<PlateMidline> {
        let now = self.motion_now();
        self.surface.kinematics(&now, ahead, out);
        self.surface.midlines(&now, &now.ahead(ahead))
    }

    fn interface(&mut self, ahead: f64) -> Result<Option<Box<dyn InterfaceDynamics>>, BodyError> {
        let (now, spec) = (self.motion_now(), &self.spec);
        let of_springs: f64 = self.springs(now.velocity[1]).sum();
        let ([x, y], inverse) = (now.acceleration, [spec.mass, spec.mass, spec.inertia].map(|inertia| 1.0 / inertia));
        let (free, held) = (|k: usize, value: f64| if spec.free[k] { value } else { 0.0 }, self.state.reaction);
        Ok(Some(Box::new(RigidInterface {
            position: now.ahead(ahead).position,
            velocity: now.ahead(0.5 * ahead).velocity,
            dt: ahead,
            predicted: [x, y, now.angular_acceleration],
            change: [0.0; 3],
            inverse_mass: [0, 1, 2].map(|k| free(k, inverse[k])),
            free_fall: [
                free(0, spec.gravity[0] + held.force[0] / spec.mass),
                free(1, spec.gravity[1] + (of_springs + held.force[1]) / spec.mass),
                free(2, held.moment * inverse[2]),
            ],
        })))
    }

    fn load(&mut self, force: WallForces<'_>) {
        let about = self.motion_now().position;
        self.state.kicked = self.state.now;
        (self.state.now, self.state.mean) = (force.resultant(about), force.mean_resultant(about));
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        self.check_springs(dt)?;
        let before = self.motion_now();
        // reactions act here; the links' impulses after the step are their other half
        self.kick(self.state.kicked + self.state.reaction, 0.5 * dt);
        self.kick_springs(0.5 * dt);
        self.world.integration_parameters.dt = dt;
        self.world.step();
        if !self.world.quarantine().is_empty() {
            return Err(BodyError::NotFinite { name: self.spec.name.clone(), time: self.state.time + dt });
        }
        let com = self.world.bodies[self.handle].center_of_mass();
        let moved = [com.x - before.position[0], com.y - before.position[1]];
        let turned = self.unwrap_angle();
        self.state.drift = [moved[0] / dt, moved[1] / dt, turned / dt];
        self.drift_springs(dt, moved[1]);
        // what remains of the step's impulse after the first half kick, about where the centre of mass now is
        let (mean, kicked) = (self.state.mean, self.state.kicked);
        let rest = Resultant {
            force: [0, 1].map(|k| 2.0 * mean.force[k] - kicked.force[k]),
            moment: 2.0 * mean.moment - kicked.moment,
        };
        self.kick_springs(0.5 * dt);
        self.kick(rest.about(moved), 0.5 * dt);
        self.state.now = self.state.now.about(moved);
        self.state.work += dot(mean.force, moved);
        let reaction = self.state.reaction;
        self.state.work_of_links += 0.5 * (dot(reaction.force, moved) + reaction.moment * turned);
        self.state.work += 0.5 * (kicked.moment + rest.about(moved).moment) * turned;
        self.state.time += dt;
        Ok(())
    }

    fn stable_dt(&self) -> f64 {
        self.spec.sprung.iter().map(|spec| spec.longest_step(self.spec.mass)).fold(f64::INFINITY, f64::min)
    }

    fn checkpoint(&mut self) {
        let body = &self.world.bodies[self.handle];
        self.checkpoint = Some((self.state, self.sprung.clone(), *body.position(), body.linvel(), body.angvel()));
    }

    fn restore(&mut self) {
        let Some(stored) = self.checkpoint.clone() else { return };
        self.set_state(stored);
    }

    fn to_bytes(&self) -> Vec<u8> {
        let body = &self.world.bodies[self.handle];
        let (Pose { rotation, translation }, v) = (*body.position(), body.linvel());
        let pose = [translation.x, translation.y, rotation.re, rotation.im];
        encode(&(self.state, &self.sprung, pose, [v.x, v.y, body.angvel()]))
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        let (state, sprung, [x, y, re, im], [u, v, angular_velocity]): (State, Vec<Sprung>, [f64; 4], [f64; 3]) =
            decode("a rigid body", bytes)?;
        let pose = Pose { rotation: Rotation { re, im }, translation: Vector::new(x, y) };
        self.set_state((state, sprung, pose, Vector::new(u, v), angular_velocity));
        Ok(())
    }
}
impl Contact for RigidBody2d {
    fn signed_distance(&self, at: [f64; 2]) -> f64 {
        self.surface.signed_distance(&self.motion_now(), at)
    }

    fn surface(&self, at: [f64; 2]) -> SurfacePoint {
        self.surface.nearest(&self.motion_now(), at)
    }

    fn apply_impulse(&mut self, contact: &ContactImpulse) {
        let (at, impulse) = contact.resultant();
        let position = self.motion_now().position;
        let moment = cross([at[0] - position[0], at[1] - position[1]], impulse);
        self.state.work += self.apply(Resultant { force: impulse, moment });
        for k in 0..2 {
            self.state.external[k] -= if self.spec.free[k] { 0.0 } else { impulse[k] };
        }
    }
}

impl Inspect for RigidBody2d {
    fn name(&self) -> &str {
        &self.spec.name
    }

    fn motion(&self) -> Option<Motion> {
        let now = self.motion_now();
        let origin = self.surface.lever_arm([0.0; 2]);
        let frame = RigidMotion {
            position: now.point(origin),
            velocity: now.point_velocity(origin),
            acceleration: now.point_acceleration(origin),
            ..now
        };
        Some(Motion::new(&frame, self.state.now.about(rotate(origin, now.angle))))
    }

    fn outline(&self) -> Option<&Outline> {
        Some(&self.surface.outline)
    }

    fn sprung(&self) -> Vec<SprungState> {
        let velocity = self.world.bodies[self.handle].linvel().y;
        let state = |((spec, now), force): ((&SprungSpec, &Sprung), f64)| SprungState {
            name: spec.name.clone(),
            extension: now.extension,
            acceleration: spec.acceleration(force, self.spec.gravity[1]),
        };
        self.spec.sprung.iter().zip(&self.sprung).zip(self.springs(velocity)).map(state).collect()
    }

    fn energy(&self) -> Energy {
        let (r, s) = (self.motion_now(), &self.spec);
        let v2 = r.velocity[0] * r.velocity[0] + r.velocity[1] * r.velocity[1];
        let rotation = if s.free[2] { s.inertia * r.angular_velocity * r.angular_velocity } else { 0.0 };
        let mut energy = Energy {
            kinetic: 0.5 * (s.mass * v2 + rotation),
            potential: -s.mass * (s.gravity[0] * r.position[0] + s.gravity[1] * r.position[1]),
            work: self.state.work,
            links: self.state.work_of_links,
            ..Energy::default()
        };
        for (spec, now) in s.sprung.iter().zip(&self.sprung) {
            energy.kinetic += 0.5 * spec.mass * now.velocity * now.velocity;
            energy.potential -= spec.mass * s.gravity[1] * (r.position[1] + now.extension);
            energy.elastic += 0.5 * spec.stiffness * now.extension * now.extension;
            energy.dissipated += now.dissipated;
        }
        energy
    }

    fn momentum(&self) -> Momentum {
        let v = self.motion_now().velocity;
        let on_springs: f64 =
            self.spec.sprung.iter().zip(&self.sprung).map(|(spec, now)| spec.mass * now.velocity).sum();
        let momentum = [0, 1].map(|k| if self.spec.free[k] { self.spec.mass * v[k] } else { 0.0 });
        Momentum { momentum: [momentum[0], momentum[1] + on_springs], external: self.state.external }
    }
}
