//! A free wedge twice: as a rigid body of a scene, and as the nodes of a host, in the same water.

use fsi_coupling::embed::{ElementScheme, FluidElement, FluidElementSpec, HostNodes, Topology};
use fsi_coupling::{Coupled, Motion, RigidMotion};
use sph_core::projection;

use crate::systems::system;

/// Spacing of the water [m].
pub const SPACING: f64 = 0.0125;
/// Mass of the wedge [kg/m].
pub const MASS: f64 = 241.0;

/// Fluid, walls and the scene's own wedge, 30°, 0.5 m broad, at 6.15 m/s.
pub fn wedge_of_the_scene(sets: &[&str]) -> Coupled {
    let common = [
        "time.start=0",
        "symmetry=none",
        "resolution.spacing=0.0125",
        "resolution.fine_zone=[0.4, 0.15]",
        "tank.width=2.4",
        "tank.depth=0.8",
        "tank.height=1.0",
        "fluid.sound_speed=167",
    ];
    system("wedge", &[&common[..], sets].concat())
}

/// The same water for a host.
pub fn spec() -> FluidElementSpec {
    FluidElementSpec {
        middle: Some(0.0),
        rim: Some(0.2),
        fine_half_width: Some(0.4),
        fine_depth: Some(0.15),
        ..FluidElementSpec::new(SPACING, 1.2, 0.8).with_sound_speed(167.0)
    }
}

/// The corners of the scene's wedge as a host's nodes, moving as it starts.
pub fn wedge_of_nodes() -> (Topology, HostNodes) {
    let system = wedge_of_the_scene(&[]);
    let body = system.bodies().next().expect("a wedge");
    let (motion, outline) = (body.motion().expect("a body"), body.outline().expect("an outline"));
    let arms = outline.loops()[0].clone();
    let nodes = placed(&arms, &motion);
    let count = nodes.len();
    (Topology::of(nodes.position.clone()).closed(0..count), nodes)
}

/// Nodes of a rigid frame: its points `arms` [m] under a motion of its origin.
pub fn placed(arms: &[[f64; 2]], motion: &Motion) -> HostNodes {
    let frame = RigidMotion {
        position: motion.position,
        angle: motion.angle,
        velocity: motion.velocity,
        angular_velocity: motion.angular_velocity,
        ..RigidMotion::default()
    };
    HostNodes {
        position: arms.iter().map(|arm| frame.point(*arm)).collect(),
        velocity: arms.iter().map(|arm| frame.point_velocity(*arm)).collect(),
        ..HostNodes::default()
    }
}

/// The same nodes `by` [m] farther on, all at a velocity [m/s].
pub fn moved(nodes: &HostNodes, by: [f64; 2], velocity: [f64; 2]) -> HostNodes {
    let position = nodes.position.iter().map(|at| [at[0] + by[0], at[1] + by[1]]).collect();
    HostNodes { position, velocity: vec![velocity; nodes.len()], ..nodes.clone() }
}

/// Sum of nodal forces [N/m, N/m, N].
pub fn total(forces: &[[f64; 3]]) -> [f64; 3] {
    forces.iter().fold([0.0; 3], |sum, force| [0, 1, 2].map(|k| sum[k] + force[k]))
}

/// The wedge's element, built.
pub fn element() -> (FluidElement, HostNodes) {
    let (topology, nodes) = wedge_of_nodes();
    (spec().size(&topology).expect("a sound element").build(&nodes).expect("water"), nodes)
}

/// Every solver of an element.
pub fn schemes() -> [ElementScheme; 3] {
    let projection = projection::Settings::default();
    let explicit = projection::Settings { method: projection::Method::OneIteration, ..projection };
    [ElementScheme::default(), ElementScheme::Projection(projection), ElementScheme::Projection(explicit)]
}

/// A box, half under water, whose nodes swing, and bend where they turn; with nodes along its bottom.
pub fn swinging(rotations: bool, scheme: ElementScheme) -> (FluidElement, impl Fn(f64) -> HostNodes) {
    let mut rest: Vec<[f64; 2]> = (0..=8).map(|k| [-0.4 + 0.1 * f64::from(k), -0.2]).collect();
    rest.extend([[0.4, 0.2], [-0.4, 0.2]]);
    let law = move |t: f64| {
        let (sin, cos) = (40.0 * t).sin_cos();
        // heave, and the bottom's first bending shape with its slope
        let shape = |x: f64| (1.0 - (x / 0.4).powi(2)).powi(2);
        let slope = |x: f64| -4.0 * x / 0.16 * (1.0 - (x / 0.4).powi(2));
        let bottom = |at: &[f64; 2]| if at[1] < 0.0 { 1.0 } else { 0.0 };
        let of = |at: &[f64; 2]| [0.02 * sin, 0.02 * (1.0 - cos) + 0.01 * sin * bottom(at) * shape(at[0])];
        let rate = |at: &[f64; 2]| [0.8 * cos, 0.8 * sin + 0.4 * cos * bottom(at) * shape(at[0])];
        let turn = |at: &[f64; 2], factor: f64| factor * bottom(at) * slope(at[0]);
        let some = |factor: f64| {
            if rotations { rest.iter().map(|at| turn(at, factor)).collect() } else { Vec::new() }
        };
        HostNodes {
            position: rest.iter().map(|at| [at[0] + of(at)[0], at[1] + of(at)[1]]).collect(),
            velocity: rest.iter().map(rate).collect(),
            rotation: some(0.01 * sin),
            spin: some(0.4 * cos),
        }
    };
    let start = law(0.0);
    let topology = Topology { rotations, ..Topology::of(start.position.clone()).closed(0..11) };
    // of one size, so that gravity alone acts from outside (THEORY WC28)
    let spec =
        FluidElementSpec { scheme, fastest_speed: Some(12.0), growth: 1.0, ..FluidElementSpec::new(0.03, 1.0, 0.6) };
    let spec = if matches!(scheme, ElementScheme::Projection(_)) { spec } else { spec.with_sound_speed(40.0) };
    (spec.size(&topology).expect("a sound element").build(&start).expect("water"), law)
}

/// Everything that a step of a host leaves behind, bit by bit.
pub fn bits(element: &FluidElement, forces: &[[f64; 3]]) -> Vec<u64> {
    let (p, w) = (element.system().fluid.particles(), &element.system().walls);
    let mut bits: Vec<u64> = p.id.iter().map(|id| u64::from(*id)).collect();
    for array in [&p.x, &p.y, &p.u, &p.v, &p.rho, &p.ax, &p.ay, &w.x, &w.y, &w.pressure, &w.mean_fy, &w.ax] {
        bits.extend(array.iter().map(|value| value.to_bits()));
    }
    bits.extend(forces.as_flattened().iter().map(|value| value.to_bits()));
    bits.push(element.time().to_bits());
    bits
}
