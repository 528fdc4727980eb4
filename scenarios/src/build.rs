//! From a scene to a fluid, walls and bodies that stand ready to step.

use fsi_coupling::bodies::prescribed::Law;
use fsi_coupling::bodies::rigid_motion::Rigid;
use fsi_coupling::geometry::layout::{Basin, Tiling};
use fsi_coupling::{
    Arrangement, Coupled, CouplingError, FlexibleBody, FlexibleSpec, Frame, Outline, Plate, PrescribedBody,
    RigidBody2d, RigidSpec, Shape, Tank, WettedBody,
};
use sph_core::legacy::settings::{DiffusionForm, EquationOfState};
use sph_core::neighbours::images::Mirror;
use sph_core::wcsph::eos::Tait;
use sph_core::{Fluid, IdealGas, Parameters, Projecting, WallTreatment, wcsph};
use structure_fe::Damping;

use crate::filling::fill;
use crate::follow::Follower;
use crate::scene::settings::WeaklyCompressibleFluid;
use crate::scene::{Body, Motion, Oscillation, PanelEnd, Scene, SolverSettings, Symmetry};

/// Fluid, walls and bodies of a scene at t = 0.
pub fn build(scene: &Scene) -> Result<Coupled, CouplingError> {
    let body = body(scene)?;
    let seeds = fill(scene, body.as_deref())?;
    let fluid = Fluid::new(parameters(scene), &seeds);
    let bodies = body.into_iter().chain([Box::new(tank(scene)) as Box<dyn WettedBody>]).collect();
    let system = Coupled::new(fluid, bodies, scene.coupling.scheme(), scene.resolution.spacing)?;
    Ok(match Follower::of(scene) {
        Some(follower) => system.focused(Box::new(move |motion, outline| follower.zone(motion, outline))),
        None => system,
    })
}

/// The scene's body, if it has one, where it starts.
pub(crate) fn body(scene: &Scene) -> Result<Option<Box<dyn WettedBody>>, CouplingError> {
    scene.body.as_ref().map(|body| rigid_or_prescribed(scene, body)).transpose()
}

/// The tank, with what stands on it.
pub(crate) fn tank(scene: &Scene) -> Tank {
    let half = scene.symmetry == Symmetry::X;
    let x = [if half { 0.0 } else { -0.5 * scene.tank.width }, 0.5 * scene.tank.width];
    let floor = -scene.tank.depth;
    let standing = scene.body.as_ref().and_then(|body| standing(scene, body)).into_iter().collect();
    Tank::new(tiling(scene), x, floor, floor + scene.tank.height, half).carrying(standing)
}

/// How the water is divided into particles.
pub fn tiling(scene: &Scene) -> Tiling {
    let x = scene.water_sides();
    let middle = scene.fine_zone_center();
    let [half_width, fine_depth] = match Follower::of(scene) {
        Some(follower) => follower.at_start(),
        None => scene.resolution.fine_zone,
    };
    let tiling = Tiling::new(Basin {
        x,
        y: [-scene.tank.depth, 0.0],
        fine_x: [(middle - half_width).max(x[0]), (middle + half_width).min(x[1])],
        fine_depth,
        spacing: scene.resolution.spacing,
        growth: scene.resolution.growth,
    });
    if scene.resolution.follow { tiling.by_halves() } else { tiling.on(scene.resolution.lattice) }
}

/// An end of a plate stands on a wall that is nearer than this share of a spacing.
const STANDS: f64 = 0.5;

/// Rows of wall particles below each face.
fn layers(scene: &Scene) -> usize {
    Arrangement::of(&parameters(scene)).1
}

/// True for a plate whose faces' rows do not fit between them (THEORY T2).
pub(crate) fn is_thin(scene: &Scene, body: &Body) -> bool {
    matches!(&body.shape, Shape::Polyline { points, thickness }
        if Plate::new(points, *thickness).is_thin(scene.resolution.spacing, layers(scene)))
}

/// T3: how far a fixed plate goes on into the tank's walls that its middle line's ends stand on [m].
fn roots(scene: &Scene, body: &Body) -> [f64; 2] {
    let (Shape::Polyline { points, .. }, Motion::Fixed) = (&body.shape, &body.motion) else { return [0.0; 2] };
    let loose = |end: &[f64; 2]| {
        let ends = body.panels.iter().flat_map(|panel| [panel.from, panel.to].into_iter().zip(panel.ends));
        ends.into_iter().any(|(at, how)| how == PanelEnd::Free && (at[0] - end[0]).hypot(at[1] - end[1]) < 1e-9)
    };
    let root = |end: &[f64; 2]| {
        if loose(end) {
            return 0.0;
        }
        let at = body.to_tank(*end);
        let spacing = tiling(scene).spacing_at(at);
        let away = (0.5 * scene.tank.width - at[0].abs()).min(at[1] + scene.tank.depth);
        if away < STANDS * spacing { (layers(scene) as f64 + 1.0) * spacing } else { 0.0 }
    };
    [root(&points[0]), root(&points[points.len() - 1])]
}

/// A thin plate that stands on the tank's walls, where it stands.
fn standing(scene: &Scene, body: &Body) -> Option<Plate> {
    let roots = roots(scene, body);
    let Shape::Polyline { points, thickness } = &body.shape else { return None };
    let middle: Vec<[f64; 2]> = points.iter().map(|p| body.to_tank(*p)).collect();
    (roots != [0.0; 2] && is_thin(scene, body)).then(|| Plate { roots, ..Plate::new(&middle, *thickness) })
}

pub(crate) fn parameters(scene: &Scene) -> Parameters {
    let water = scene.water();
    let eos = Tait { rho0: water.density, c0: scene.sound_speed(), gamma: wcsph::Settings::default().eos_exponent };
    let shared = Parameters {
        kernel: water.kernel,
        smoothing_ratio: water.smoothing_ratio,
        gravity: scene.gravity,
        nu: water.kinematic_viscosity,
        slip: water.wall_slip,
        cfl: scene.courant_number(),
        mirror: (scene.symmetry == Symmetry::X).then_some(Mirror { at: 0.0 }),
        solver: scene.solver.kind(),
        speed: scene.projection_speed(),
        walls: WallTreatment { water_depth: scene.tank.depth, ..WallTreatment::default() },
        ..Parameters::usual(eos)
    };
    match &scene.solver {
        SolverSettings::WeaklyCompressible { fluid } => weakly_compressible(fluid, shared),
        SolverSettings::Incompressible { fluid, projection }
        | SolverSettings::IncompressibleExplicit { fluid, projection } => Parameters {
            alpha: 0.0,
            delta: 0.0,
            shifting: fluid.scheme.shifting,
            ventilation: fluid.scheme.ventilation,
            projecting: Projecting {
                tolerance: projection.tolerance,
                most_iterations: projection.most_iterations,
                relaxation: projection.relaxation,
                calming: projection.viscosity_coefficient,
                shift: projection.shift,
            },
            ..shared
        },
        SolverSettings::IncompressibleThesis { fluid, thesis } => Parameters {
            alpha: fluid.scheme.artificial_viscosity,
            delta: 0.0,
            dissipation: fluid.scheme.dissipation,
            thesis: *thesis,
            ..shared
        },
    }
}

fn weakly_compressible(fluid: &WeaklyCompressibleFluid, shared: Parameters) -> Parameters {
    let WeaklyCompressibleFluid { scheme, options, .. } = fluid;
    let eos = Tait { gamma: scheme.eos_exponent, ..shared.eos };
    let (temperature, molar_mass) = (options.temperature, options.molar_mass);
    let gas = IdealGas { rho0: eos.rho0, gamma: eos.gamma, temperature, molar_mass };
    Parameters {
        eos,
        alpha: scheme.artificial_viscosity,
        delta: scheme.density_diffusion,
        dissipation: scheme.dissipation,
        shifting: scheme.shifting,
        settling: scheme.settling,
        wall_stretch: scheme.wall_stretch,
        ventilation: scheme.ventilation,
        integrator: options.integrator,
        verlet_correction_every: options.verlet_correction_every.into(),
        density_filter: options.density_filter,
        density_filter_every: options.density_filter_every.into(),
        xsph: options.xsph,
        turbulence: options.turbulence,
        gas: (options.equation_of_state == EquationOfState::IdealGas).then_some(gas),
        density_evolution: options.density_evolution,
        hydrostatic_diffusion: options.density_diffusion_form == DiffusionForm::Fourtakas,
        walls: WallTreatment { model: options.walls, hydrostatic_start: options.limit_pressure == 1, ..shared.walls },
        ..shared
    }
}

fn rigid_or_prescribed(scene: &Scene, body: &Body) -> Result<Box<dyn WettedBody>, CouplingError> {
    let half = scene.symmetry == Symmetry::X;
    let outline = Outline::of(&body.shape)?.rooted(roots(scene, body));
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
        free: [freedom.x(), freedom.y(), freedom.inertia.is_some()],
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
            free: [freedom.x(), freedom.y(), freedom.inertia.is_some()],
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
