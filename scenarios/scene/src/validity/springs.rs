//! The step that springs of a scene allow: masses on springs (THEORY CO35) and joints (CO38).

use fsi_coupling::{RigidMotion, Solid, SprungSpec};
use settings::{Problem, require, significant};

use crate::keys::{Body, Motion, Scene, SprungMass};

/// CO35, CO38: the longest steps that the springs of a scene allow [s], by name.
fn allowed(scene: &Scene) -> Vec<(&str, f64)> {
    let of_masses = scene.all_bodies().flat_map(|body| {
        let Motion::Free(freedom) = &body.motion else { return Vec::new() };
        body.sprung_masses.iter().map(|mass| (mass.name.as_str(), spec(mass).longest_step(freedom.mass))).collect()
    });
    let solid = |name: &str| scene.all_bodies().find(|body| body.name == name).map_or(Solid::default(), solid);
    let of_joints = scene.joints.iter().map(|joint| {
        let solids = joint.bodies.each_ref().map(|name| solid(name));
        (joint.name.as_str(), joint.spec(|_| 0).longest_step(solids))
    });
    of_masses.chain(of_joints).collect()
}

/// The longest step that all springs of a scene allow [s]; infinite without springs.
pub fn longest_spring_step(scene: &Scene) -> f64 {
    allowed(scene).into_iter().map(|(_, step)| step).fold(f64::INFINITY, f64::min)
}

/// Refuses a fixed step that is too long for a spring.
pub(crate) fn check_spring_step(scene: &Scene) -> Result<(), Problem> {
    let Some(step) = scene.time.step.filter(|_| !scene.model.is_theory()) else { return Ok(()) };
    allowed(scene).into_iter().try_for_each(|(name, longest)| {
        let expected = format_args!("at most {} s, which the spring of `{name}` allows", significant(longest));
        require(step <= longest, "time.step", step, expected)
    })
}

/// A body at t = 0 as joints meet it.
fn solid(body: &Body) -> Solid {
    let position = body.to_tank(body.center_of_mass);
    let motion = RigidMotion { position, angle: body.angle_deg.to_radians(), ..RigidMotion::default() };
    let Motion::Free(freedom) = &body.motion else { return Solid { motion, ..Solid::default() } };
    let of = |free: bool, inertia: f64| if free { 1.0 / inertia } else { 0.0 };
    let turning = freedom.inertia.map_or(0.0, |inertia| 1.0 / inertia);
    Solid {
        motion,
        inverse_mass: [of(freedom.x(), freedom.mass), of(freedom.y(), freedom.mass), turning],
        halves: 1.0, // joints are refused with a mirror
    }
}

/// A mass on a spring, as a rigid body takes it.
pub fn spec(mass: &SprungMass) -> SprungSpec {
    let SprungMass { name, mass, stiffness, damping } = mass.clone();
    SprungSpec { name, mass, stiffness, damping }
}
