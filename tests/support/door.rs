//! A free wedge twice: as a rigid body of a scene, and as the nodes of a host, in the same water.

use fsi_coupling::RigidMotion;
use fsi_coupling::embed::{FluidElement, FluidElementSpec, HostNodes, Topology};
use fsi_coupling::{Coupled, Motion};

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
