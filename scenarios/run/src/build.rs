//! From a scene to a fluid, walls and bodies that stand ready to step.

use fsi_coupling::geometry::error::OutlineError;
use fsi_coupling::{
    Body, Coupled, CouplingError, FlexibleBody, FlexibleSpec, Frame, ModalBody, ModalSpec, Outline, PlacedBodies,
    Plate, PrescribedBody, RigidBody2d, RigidMotion, RigidSpec, Shape, Tank, WallRows,
};
use scene::{Follower, Modes, Motion, Moved, PanelEnd, Scene, Symmetry, domain, layout, rows};
use sph_core::Fluid;
use structure_fe::Damping;

use crate::initial_fluid::initial_fluid;

/// Fluid, walls and bodies of a scene at the start of its run: the bodies are placed, the water is filled in around them.
pub fn build(scene: &Scene) -> Result<Coupled, CouplingError> {
    let rows = rows(scene);
    let bodies: Result<_, CouplingError> = scene.all_bodies().map(|body| of_scene(scene, body, &rows)).collect();
    let system = build_around(scene, bodies?)?;
    let last = scene.all_bodies().count();
    let index = |name: &str| scene.all_bodies().position(|body| body.name == name).unwrap_or(last);
    let joints = scene.joints.iter().map(|joint| joint.spec(index)).collect();
    system.with_links(scene.contact.law(scene.resolution.spacing), joints)
}

/// Fluid and walls of a scene, with bodies that stand where the scene has its own at the start.
pub(crate) fn build_around(scene: &Scene, bodies: Vec<Box<dyn Body>>) -> Result<Coupled, CouplingError> {
    let (domain, settings, layout) = (domain(scene), scene.solver.scheme(scene.tank.depth), layout(scene));
    let (pattern, ratio) = (settings.wall_layout(&domain), domain.fluid.smoothing_ratio);
    let rows = rows(scene);
    let thin = scene.all_bodies().any(|body| is_thin(body, &rows));
    let tank: Box<dyn Body> = Box::new(tank(scene, &rows));
    let bodies = bodies.into_iter().chain([tank]).collect();
    let placed = PlacedBodies::new(bodies, pattern, ratio, scene.resolution.spacing)?;
    let seeds = initial_fluid(scene, &domain, &layout, &placed, thin);
    let mut fluid = Fluid::new(domain, settings.as_ref(), &seeds);
    fluid.start_at(scene.time.start);
    let system = Coupled::with_bodies(fluid, placed, scene.coupling.scheme())?;
    let system = match scene.beach() {
        Some(zone) => system.with_beach(zone),
        None => system,
    };
    let system = match scene.relaxation() {
        Some(zone) => system.with_relaxation(zone),
        None => system,
    };
    Ok(match Follower::of(scene) {
        Some(follower) => system.with_refinement(Box::new(move |bodies| follower.zone(bodies))),
        None => system,
    })
}

/// The tank with a plate that stands on its walls.
fn tank(scene: &Scene, rows: &WallRows) -> Tank {
    let half = scene.symmetry == Symmetry::X;
    let x = [if half { 0.0 } else { -0.5 * scene.tank.width }, 0.5 * scene.tank.width];
    let floor = -scene.tank.depth;
    let standing = scene.all_bodies().filter_map(|body| standing(scene, body, rows)).collect();
    let tank = Tank::new(layout(scene), x, floor, floor + scene.tank.height, half).with_plates(standing);
    match scene.piston() {
        Some(motion) => tank.with_piston(motion, scene.time.start),
        None => tank,
    }
}

/// An end of a plate stands on a wall that is nearer than this share of a spacing.
const STANDS: f64 = 0.5;

/// True for a plate whose faces' rows do not fit between them (THEORY WA9).
fn is_thin(body: &scene::Body, rows: &WallRows) -> bool {
    matches!(&body.shape, Shape::Polyline { points, thickness } if Plate::new(points, *thickness).is_thin(rows))
}

/// The outline of a scene's body in space at the start, with the roots of a plate that stands on walls.
pub(crate) fn outline_at_start(
    scene: &Scene,
    body: &scene::Body,
    start: &RigidMotion,
) -> Result<Outline, OutlineError> {
    let placed = |points: &[[f64; 2]]| points.iter().map(|at| start.point(*at)).collect::<Vec<_>>();
    match &body.shape {
        Shape::Polyline { points, thickness } => {
            let shape = Shape::Polyline { points: placed(points), thickness: *thickness };
            Ok(Outline::of(&shape)?.rooted(roots(scene, body, &rows(scene))))
        }
        shape => Outline::polygon(&placed(&shape.outline())),
    }
}

/// The motion of a body's frame at the start: its velocity is that of the frame's origin.
pub(crate) fn frame_at_start(scene: &Scene, body: &scene::Body) -> RigidMotion {
    let start = scene.motion_at_start(body);
    match body.motion.moved(&start) {
        Moved::ByLoads(_) => about_origin(body, start),
        Moved::ByLaw(law) => law(0.0),
    }
}

/// A motion whose velocity is that of the centre of mass, with the velocity of the frame's origin.
fn about_origin(body: &scene::Body, start: RigidMotion) -> RigidMotion {
    let lever_arm = body.center_of_mass.map(|c| -c);
    let about = RigidMotion { position: [0.0; 2], ..start };
    RigidMotion { velocity: about.point_velocity(lever_arm), ..start }
}

/// WA10: how far a fixed plate goes on into the tank's walls that its middle line's ends stand on [m].
fn roots(scene: &Scene, body: &scene::Body, rows: &WallRows) -> [f64; 2] {
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
        let spacing = layout(scene).spacing_at(at);
        let away = (0.5 * scene.tank.width - at[0].abs()).min(at[1] + scene.tank.depth);
        if away < STANDS * spacing { (rows.layers as f64 + 1.0) * spacing } else { 0.0 }
    };
    [root(&points[0]), root(&points[points.len() - 1])]
}

/// A thin plate that stands on the tank's walls, where it stands.
fn standing(scene: &Scene, body: &scene::Body, rows: &WallRows) -> Option<Plate> {
    let roots = roots(scene, body, rows);
    let Shape::Polyline { points, thickness } = &body.shape else { return None };
    let middle: Vec<[f64; 2]> = points.iter().map(|p| body.to_tank(*p)).collect();
    (roots != [0.0; 2] && is_thin(body, rows)).then(|| Plate { roots, ..Plate::new(&middle, *thickness) })
}

/// A scene's body as it stands at the start.
fn of_scene(scene: &Scene, body: &scene::Body, rows: &WallRows) -> Result<Box<dyn Body>, CouplingError> {
    moving(scene, body, rows, (scene.motion_at_start(body), scene.time.start))
}

/// A scene's body with a motion at a time [s].
pub(crate) fn moving(
    scene: &Scene,
    body: &scene::Body,
    rows: &WallRows,
    (start, clock): (RigidMotion, f64),
) -> Result<Box<dyn Body>, CouplingError> {
    let half = scene.symmetry == Symmetry::X;
    let outline = Outline::of(&body.shape)?.rooted(roots(scene, body, rows));
    if !body.panels.is_empty() {
        let flexible = flexible(scene, body, outline, start)?.with_longest_step(scene::longest_step(scene));
        return Ok(Box::new(flexible.starting_at(clock)));
    }
    if let Some(modal) = &body.modal {
        let bending = with_modes(scene, body, modal, outline, start)?.with_longest_step(scene::longest_step(scene));
        return Ok(Box::new(bending.starting_at(clock)));
    }
    let freedom = match body.motion.moved(&start) {
        Moved::ByLoads(freedom) => freedom,
        Moved::ByLaw(law) => {
            return Ok(Box::new(PrescribedBody::new(&body.name, outline, half, law).starting_at(clock)));
        }
    };
    let rigid = RigidBody2d::new(RigidSpec {
        name: body.name.clone(),
        outline,
        mass: freedom.mass,
        inertia: freedom.inertia.unwrap_or(0.0),
        center_of_mass: body.center_of_mass,
        free: [freedom.x(), freedom.y(), freedom.inertia.is_some()],
        position: start.position,
        angle: start.angle,
        velocity: about_origin(body, start).velocity,
        angular_velocity: start.angular_velocity,
        gravity: scene.gravity,
        half,
        sprung: body.sprung_masses.iter().map(scene::sprung_spec).collect(),
    })?;
    Ok(Box::new(rigid.starting_at(clock)))
}

/// A body with panels.
fn flexible(
    scene: &Scene,
    body: &scene::Body,
    outline: Outline,
    start: RigidMotion,
) -> Result<FlexibleBody, CouplingError> {
    let (frame, start) = frame(body, start);
    Ok(FlexibleBody::new(FlexibleSpec {
        name: body.name.clone(),
        outline,
        middle: middle(body),
        panels: body.panels.iter().map(|panel| panel.spec()).collect(),
        frame,
        start,
        gravity: scene.gravity,
        damping: Damping { mass: body.damping[0], stiffness: body.damping[1] },
        half: scene.symmetry == Symmetry::X,
    })?)
}

/// A body whose structure is given by its modes.
fn with_modes(
    scene: &Scene,
    body: &scene::Body,
    modal: &Modes,
    outline: Outline,
    start: RigidMotion,
) -> Result<ModalBody, CouplingError> {
    let (frame, start) = frame(body, start);
    Ok(ModalBody::new(ModalSpec {
        name: body.name.clone(),
        outline,
        middle: middle(body),
        nodes: modal.nodes.clone(),
        masses: modal.all_masses(),
        modes: modal.surface_modes(),
        frame,
        start,
        gravity: scene.gravity,
        half: scene.symmetry == Symmetry::X,
    })?)
}

/// The middle line of a body that is a thin wall.
fn middle(body: &scene::Body) -> Option<Vec<[f64; 2]>> {
    match &body.shape {
        Shape::Polyline { points, .. } => Some(points.clone()),
        _ => None,
    }
}

/// The rigid part of a body that bends, and the motion of its origin at the start.
fn frame(body: &scene::Body, start: RigidMotion) -> (Frame, RigidMotion) {
    match body.motion.moved(&start) {
        Moved::ByLoads(freedom) => {
            let frame = Frame::Free {
                mass: freedom.mass,
                // a frame that does not turn needs an inertia, which has no effect
                inertia: freedom.inertia.unwrap_or(freedom.mass),
                center_of_mass: body.center_of_mass,
                free: [freedom.x(), freedom.y(), freedom.inertia.is_some()],
            };
            (frame, about_origin(body, start))
        }
        // what bends starts with the law's velocity
        Moved::ByLaw(law) => {
            let begun = law(0.0);
            (Frame::Given(law), begun)
        }
    }
}
