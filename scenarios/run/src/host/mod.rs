//! A scene whose body another program moves: the host, which keeps its own time loop.
//!
//! Every option of a scene holds: solver, walls, thin plates, symmetry, resolution that follows, gauges, log and report. The scene's own
//! motion of the body is what is expected: speed of sound, fine zone and bands come from it. The host moves the body instead.
//!
//! | phase | call | what happens |
//! |---|---|---|
//! | open | [`HostedScene::open`] | the scene is read and checked; nodes, particles, bytes and step are known; no water yet |
//! | build | [`HostedScene::build`] | the water at the start, around the nodes |
//! | contribute | [`HostedRun::contribute`] | the water goes through a step of the host, and its force is on the nodes |
//! | finish | [`HostedRun::finish`] | summary and report, where records were asked for |
//!
//! ```
//! use run::host::{HostedScene, Interface};
//!
//! let sets = ["resolution.spacing=0.02", "tank.width=1.2", "tank.depth=0.5"].map(String::from);
//! let scene = HostedScene::open("wedge", &sets, Interface::Body)?;
//! println!("{} particles, {} bytes", scene.fluid_particles(), scene.bytes());
//! let mut nodes = scene.nodes().clone();
//! let mut water = scene.build(&nodes)?;
//! let (mass, dt, mut forces) = (100.0, 2e-4, [[0.0; 3]; 1]);
//! while water.time() < 0.002 {
//!     let before = nodes.velocity[0][1];
//!     nodes.velocity[0][1] += dt * (forces[0][1] / mass - 9.81);
//!     nodes.position[0][1] += dt * 0.5 * (before + nodes.velocity[0][1]);
//!     water.contribute(dt, &nodes, &mut forces)?;
//! }
//! assert!(forces[0][1] > 0.0);
//! # Ok::<(), run::host::HostedError>(())
//! ```
//!
//! A step is rejected by [`HostedRun::save`] before it and [`HostedRun::restore`] after it; redone, it gives the same bits. Underneath
//! is the element of [`fsi_coupling::embed`] (THEORY CO29–CO32).

mod error;
mod hosted_run;
mod hosted_scene;
mod interface;
mod records;

pub use error::{ErrorKind, HostedError};
pub use hosted_run::HostedRun;
pub use hosted_scene::HostedScene;
pub use interface::Interface;
