//! From a scene to a fluid, walls and bodies that stand ready to step.

use fsi_coupling::fill::{Basin, Tiling};
use fsi_coupling::pose::Rigid;
use fsi_coupling::prescribed::Law;
use fsi_coupling::{
    Coupled, CouplingError, FlexibleBody, FlexibleSpec, Frame, Outline, PrescribedBody, RigidBody2d, RigidSpec, Shape, Tank,
    WettedBody,
};
use sph_core::eos::Tait;
use sph_core::images::Mirror;
use structure_fe::Damping;
use sph_core::{Fluid, Parameters, Seed, WallTreatment};

use crate::scene::{Body, DiffusionForm, Motion, Oscillation, Scene, Symmetry};

/// Fluid, walls and bodies of a scene at t = 0.
pub fn build(scene: &Scene) -> Result<Coupled, CouplingError> {
    let half = scene.symmetry == Symmetry::X;
    let tiling = tiling(scene);
    let body = scene.body.as_ref().map(|body| rigid_or_prescribed(scene, body)).transpose()?;
    let seeds = fill(scene, &tiling, body.as_deref());
    let fluid = Fluid::new(parameters(scene), &seeds);
    let x = [if half { 0.0 } else { -0.5 * scene.tank.width }, 0.5 * scene.tank.width];
    let floor = -scene.tank.depth;
    let tank = Tank::new(tiling, x, floor, floor + scene.tank.height, half);
    let bodies = body.into_iter().chain([Box::new(tank) as Box<dyn WettedBody>]).collect();
    Coupled::new(fluid, bodies, scene.coupling.scheme(), scene.resolution.spacing)
}

/// How the water is divided into particles.
pub fn tiling(scene: &Scene) -> Tiling {
    let x = scene.water_sides();
    let middle = scene.fine_zone_center();
    let [half_width, fine_depth] = scene.resolution.fine_zone;
    Tiling::new(Basin {
        x,
        y: [-scene.tank.depth, 0.0],
        fine_x: [(middle - half_width).max(x[0]), (middle + half_width).min(x[1])],
        fine_depth,
        spacing: scene.resolution.spacing,
        growth: scene.resolution.growth,
    })
    .on(scene.resolution.lattice)
}

/// Still water at rest under its own weight, without what the body displaces.
fn fill(scene: &Scene, tiling: &Tiling, body: Option<&dyn WettedBody>) -> Vec<Seed> {
    let mut seeds = Vec::new();
    let weight = scene.fluid.density * scene.gravity[1];
    tiling.for_each(|cell| {
        let room = 0.5 * cell.area().sqrt() * (1.0 - 1e-6);
        if body.is_none_or(|b| b.clearance(cell.at) >= room) {
            seeds.push(Seed { at: cell.at, velocity: [0.0; 2], area: cell.area(), pressure: weight * cell.at[1] });
        }
    });
    seeds
}

fn parameters(scene: &Scene) -> Parameters {
    let fluid = &scene.fluid;
    Parameters {
        eos: Tait { rho0: fluid.density, c0: fluid.sound_speed, gamma: fluid.eos_exponent },
        kernel: fluid.kernel,
        smoothing_ratio: fluid.smoothing_ratio,
        gravity: scene.gravity,
        alpha: fluid.artificial_viscosity,
        nu: fluid.kinematic_viscosity,
        delta: fluid.density_diffusion,
        shifting: fluid.shifting,
        volume_correction: fluid.volume_correction,
        slip: fluid.wall_slip,
        wall_stretch: fluid.wall_stretch,
        ventilation: fluid.ventilation,
        integrator: fluid.integrator,
        cfl: fluid.cfl,
        mirror: (scene.symmetry == Symmetry::X).then_some(Mirror { at: 0.0 }),
        verlet_correction_every: fluid.verlet_correction_every.into(),
        density_filter: fluid.density_filter,
        density_filter_every: fluid.density_filter_every.into(),
        xsph: fluid.xsph,
        turbulence: fluid.turbulence,
        gas: fluid.gas(),
        density_evolution: fluid.density_evolution,
        hydrostatic_diffusion: fluid.density_diffusion_form == DiffusionForm::Fourtakas,
        shift_surface: false,
        periodic: None,
        walls: WallTreatment {
            model: fluid.walls,
            hydrostatic_start: fluid.limit_pressure == 1,
            water_depth: scene.tank.depth,
        },
        dissipation: fluid.dissipation,
    }
}

fn rigid_or_prescribed(scene: &Scene, body: &Body) -> Result<Box<dyn WettedBody>, CouplingError> {
    let half = scene.symmetry == Symmetry::X;
    let outline = Outline::of(&body.shape)?;
    let start = Rigid {
        pole: body.position,
        angle: body.angle_deg.to_radians(),
        velocity: body.velocity,
        spin: body.angular_velocity_deg_per_s.to_radians(),
        ..Rigid::default()
    };
    if !body.panels.is_empty() {
        return flexible(scene, body, outline, start);
    }
    let follow =
        |law: Law| Box::new(PrescribedBody::new(&body.name, outline.clone(), half, law)) as Box<dyn WettedBody>;
    let Motion::Free(freedom) = &body.motion else {
        return Ok(follow(law(&body.motion, &start)));
    };
    Ok(Box::new(RigidBody2d::new(RigidSpec {
        name: body.name.clone(),
        outline: outline.clone(),
        mass: freedom.mass,
        inertia: freedom.inertia.unwrap_or(0.0),
        center_of_mass: body.center_of_mass,
        free: [freedom.x, freedom.y, freedom.inertia.is_some()],
        position: body.position,
        angle: start.angle,
        velocity: body.velocity,
        spin: start.spin,
        gravity: scene.gravity,
        half,
    })?))
}

/// The law of a motion that is given.
fn law(motion: &Motion, start: &Rigid) -> Law {
    match motion {
        Motion::Oscillating(Oscillation { amplitude, period }) => {
            PrescribedBody::oscillating(start.pole, start.angle, *amplitude, *period)
        }
        Motion::ConstantVelocity => PrescribedBody::steady(start.pole, start.angle, start.velocity, start.spin),
        Motion::Fixed | Motion::Free(_) => PrescribedBody::steady(start.pole, start.angle, [0.0; 2], 0.0),
    }
}

/// A body with panels.
fn flexible(scene: &Scene, body: &Body, outline: Outline, start: Rigid) -> Result<Box<dyn WettedBody>, CouplingError> {
    let middle = match &body.shape {
        Shape::Polyline { points, .. } => Some(points.clone()),
        _ => None,
    };
    let frame = match &body.motion {
        Motion::Free(freedom) => Frame::Free {
            mass: freedom.mass,
            // a frame that does not turn needs some inertia, which nothing feels
            inertia: freedom.inertia.unwrap_or(freedom.mass),
            center_of_mass: body.center_of_mass,
            free: [freedom.x, freedom.y, freedom.inertia.is_some()],
        },
        motion => Frame::Given(law(motion, &start)),
    };
    // the body's velocity is that of its centre of mass; its frame's origin moves with it
    let arm = body.center_of_mass.map(|c| -c);
    let about = Rigid { pole: [0.0; 2], ..start };
    let start = Rigid { velocity: about.point_velocity(arm), ..start };
    Ok(Box::new(FlexibleBody::new(FlexibleSpec {
        name: body.name.clone(),
        outline,
        middle,
        panels: body.panels.iter().map(|panel| panel.spec()).collect(),
        frame,
        start,
        gravity: scene.gravity,
        damping: Damping { mass: body.damping[0], stiffness: body.damping[1] },
        half: scene.symmetry == Symmetry::X,
    })?))
}
