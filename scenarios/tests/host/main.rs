//! Scenes whose body a host moves: the scene's own run where both move it alike, rejected steps, states as bytes, impulses over long
//! steps, records, and input that is refused; for every solver and every kind of surface.

mod bits;
mod partitioned;
mod records;
mod refused;
mod same_as_scene;

use fsi_coupling::embed::HostNodes;
use run::host::{HostedRun, HostedScene, Interface};

/// A wedge in a small tank.
const SMALL: [&str; 4] = ["resolution.spacing=0.02", "tank.width=1.6", "tank.depth=0.6", "time.end=0.01"];

/// A bent thin plate, wet on both sides.
const PLATE: &str = r#"
name = "thin_plate"
gravity = [0.0, 0.0]
[time]
end = 0.01
[resolution]
spacing = 0.02
[fluid]
sound_speed = 40.0
[tank]
width = 1.6
depth = 0.6
[body]
name = "plate"
shape = "polyline"
points = [[-0.3, 0.1], [-0.1, 0.0], [0.1, 0.02], [0.3, 0.1]]
thickness = 0.004
motion = "constant_velocity"
velocity = [0.3, -1.5]
position = [0.0, -0.2]
"#;

/// A set-up: a scene, its settings and an interface.
#[derive(Clone, Copy, Debug)]
struct Case {
    scene: &'static str,
    sets: &'static [&'static str],
    interface: Interface,
}

/// Every solver, and every kind of surface.
const CASES: [Case; 10] = [
    Case { scene: "wedge", sets: &[], interface: Interface::Body },
    Case { scene: "wedge", sets: &[], interface: Interface::Nodes },
    Case { scene: "wedge", sets: &["symmetry=none"], interface: Interface::TurningNodes },
    Case { scene: "wedge", sets: &["solver=incompressible"], interface: Interface::Nodes },
    Case { scene: "wedge", sets: &["solver=incompressible_explicit"], interface: Interface::Body },
    Case { scene: "wedge", sets: &["symmetry=none", "body.angle_deg=4"], interface: Interface::Body },
    Case { scene: "wedge", sets: &["resolution.follow=true"], interface: Interface::Nodes },
    Case { scene: "fuselage_section", sets: &["tank.width=4.0"], interface: Interface::Body },
    Case { scene: "plate", sets: &[], interface: Interface::Nodes },
    Case { scene: "plate", sets: &[], interface: Interface::TurningNodes },
];

impl Case {
    fn open(&self, more: &[&str]) -> HostedScene {
        let small: &[&str] = if self.scene == "plate" { &[] } else { &SMALL };
        let sets: Vec<String> = [small, self.sets, more].concat().iter().map(ToString::to_string).collect();
        let opened = match self.scene {
            "plate" => HostedScene::from_text("plate.toml", PLATE, &sets, self.interface),
            scene => HostedScene::open(scene, &sets, self.interface),
        };
        opened.unwrap_or_else(|error| panic!("{self:?}: {error}"))
    }

    fn build(&self, more: &[&str]) -> (HostedRun, HostNodes) {
        let scene = self.open(more);
        let nodes = scene.nodes().clone();
        (scene.build(&nodes).unwrap_or_else(|error| panic!("{self:?}: {error}")), nodes)
    }
}

/// The nodes after a time at their velocity [s].
fn moved(nodes: &HostNodes, time: f64) -> HostNodes {
    let position = nodes.position.iter().zip(&nodes.velocity).map(|(x, v)| [x[0] + time * v[0], x[1] + time * v[1]]);
    HostNodes { position: position.collect(), ..nodes.clone() }
}

/// The mean forces of a step of `dt` [s] that ends `time` [s] after the start.
fn stepped(run: &mut HostedRun, start: &HostNodes, time: f64, dt: f64) -> Vec<[f64; 3]> {
    let mut forces = vec![[0.0; 3]; start.len()];
    run.contribute(dt, &moved(start, time), &mut forces).unwrap_or_else(|error| panic!("t = {time}: {error}"));
    forces
}
