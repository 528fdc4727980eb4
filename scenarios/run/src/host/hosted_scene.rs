//! A scene whose body a host will move: its nodes and its size are known, its water is not there yet.

use std::path::PathBuf;

use fsi_coupling::embed::{
    ElementLimits, FluidElement, HostError, HostFrame, HostNodes, HostSurface, HostSurfaceSpec, Topology, shortest_step,
};
use fsi_coupling::{BodyError, RigidMotion};
use scene::{Body, Loaded, Scene, Symmetry, memory_estimate, particle_estimate, rows, step_at_start};

use super::error::HostedError;
use super::hosted_run::HostedRun;
use super::interface::Interface;
use super::records::Records;
use crate::build::{build_around, frame_at_start, outline_at_start};
use crate::checkpoint::fingerprint;
use crate::memory::available_memory;
use crate::options::Page;

/// Steps of the water above which a step of the host is refused [-].
const MOST_SUBSTEPS: f64 = 100_000.0;

/// A scene that is ready to be built around the nodes of a host.
#[derive(Clone)]
pub struct HostedScene {
    scene: Scene,
    body: Body,
    start: RigidMotion,
    interface: Interface,
    topology: Topology,
    nodes: HostNodes,
    warnings: Vec<String>,
    records: Option<(PathBuf, bool)>,
    page: Option<Page>,
}

impl HostedScene {
    /// A built-in scene by its name, or a scene file by its path, with settings such as `resolution.spacing=0.01` in their order. A scene
    /// whose model is left to the program is run with particles.
    ///
    /// # Errors
    /// A scene that cannot be read or run, or whose body no host can move: without a body, with panels, by a theory.
    pub fn open(scene: &str, settings: &[String], interface: Interface) -> Result<HostedScene, HostedError> {
        let loaded = crate::load(scene, settings)?;
        if !(loaded.scene.model.is_theory() && loaded.scene.choice.is_some()) {
            return HostedScene::of(loaded, interface);
        }
        let particles = [settings, &["model=wcsph".to_string()]].concat();
        HostedScene::of(crate::load(scene, &particles)?, interface)
    }

    /// A scene from its text; `name` stands for the file in messages.
    ///
    /// # Errors
    /// As [`HostedScene::open`].
    pub fn from_text(
        name: &str,
        text: &str,
        settings: &[String],
        interface: Interface,
    ) -> Result<HostedScene, HostedError> {
        HostedScene::of(crate::load_text(name, text, settings)?, interface)
    }

    fn of(loaded: Loaded, interface: Interface) -> Result<HostedScene, HostedError> {
        let Loaded { scene, warnings, .. } = loaded;
        let unfit = |given: &str, expected: &str| {
            let (given, expected) = (given.to_string(), expected.to_string());
            HostedError::Unfit { scene: scene.name.clone(), given, expected }
        };
        if scene.model.is_theory() {
            let given = format!("model = \"{}\" has no particles", scene.model.name());
            return Err(unfit(&given, "model = \"wcsph\" or \"incompressible\""));
        }
        if !scene.bodies.is_empty() || !scene.joints.is_empty() {
            return Err(unfit("several bodies, or joints", "one [body], which the host moves"));
        }
        let Some(body) = scene.body.clone() else {
            return Err(unfit("no body", "a table [body] with the shape that the host moves"));
        };
        if body.bends() {
            return Err(unfit(
                if body.panels.is_empty() { "body.modal" } else { "body.panels" },
                "a body without panels and modes: the structure is the host's, whose nodes are the corners of the outline",
            ));
        }
        let start = frame_at_start(&scene, &body);
        let (topology, nodes) = interface.nodes(&body, &start);
        Ok(HostedScene { scene, body, start, interface, topology, nodes, warnings, records: None, page: None })
    }

    /// The same with log, curves and summary in a folder; `replace` a run that it holds.
    pub fn recording(self, folder: PathBuf, replace: bool) -> HostedScene {
        HostedScene { records: Some((folder, replace)), ..self }
    }

    /// The records with a page, `report.html`.
    pub fn with_page(self, page: Page) -> HostedScene {
        HostedScene { page: Some(page), ..self }
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What of the body the host moves.
    pub fn interface(&self) -> Interface {
        self.interface
    }

    /// The nodes at the start, with the motion that the scene expects.
    pub fn nodes(&self) -> &HostNodes {
        &self.nodes
    }

    /// Time at the start [s]: below zero where a body starts above the water.
    pub fn time(&self) -> f64 {
        self.scene.time.start
    }

    /// Particles of water at the start.
    pub fn fluid_particles(&self) -> usize {
        scene::layout(&self.scene).count()
    }

    /// Boundary particles, estimated.
    pub fn wall_particles(&self) -> usize {
        particle_estimate(&self.scene).1 as usize
    }

    /// Memory, estimated [bytes].
    pub fn bytes(&self) -> u64 {
        memory_estimate(&self.scene)
    }

    /// The water's step at the start [s].
    pub fn fluid_dt(&self) -> f64 {
        step_at_start(&self.scene)
    }

    /// Warnings about the scene.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    fn fits_in_memory(&self) -> Result<(), HostedError> {
        let (bytes, most) = (self.bytes(), available_memory());
        let particles = self.fluid_particles();
        if bytes > most { Err(HostedError::Memory { particles, bytes, most }) } else { Ok(()) }
    }

    /// The water around the nodes, which stand where [`HostedScene::nodes`] says; their velocities are what they start with.
    ///
    /// # Errors
    /// Water that does not fit in memory or cannot be built, nodes elsewhere, files that cannot be written.
    pub fn build(self, nodes: &HostNodes) -> Result<HostedRun, HostedError> {
        self.fits_in_memory()?;
        let HostedScene { scene, body, start, interface, topology, mut warnings, records, page, .. } = self;
        let rest = outline_at_start(&scene, &body, &start).map_err(BodyError::from)?;
        let spec = HostSurfaceSpec {
            name: body.name.clone(),
            frame: HostFrame { position: start.position, angle: start.angle },
            outline: Some(rest),
            half: scene.symmetry == Symmetry::X,
        };
        let incompressible = scene.solver.is_incompressible();
        let sound_speed = if incompressible { 10.0 * scene.projection_speed() } else { scene.sound_speed() };
        refuse_fast(nodes, sound_speed)?;
        let (hosted, link) = HostSurface::new(&topology, nodes, &rows(&scene), spec)?.into_body();
        let system = build_around(&scene, vec![hosted])?;
        let fingerprint = fingerprint(&scene) ^ crc32fast::hash(interface.name().as_bytes());
        warnings.push(format!(
            "a host program moved the body by the interface `{}`: the scene's own motion is what was expected of it",
            interface.name()
        ));
        let longest_fluid_step = scene.time.step.unwrap_or(f64::INFINITY);
        let records =
            records.map(|(folder, replace)| Records::start(scene, interface, folder, replace, page, warnings, &system));
        let most_substeps = MOST_SUBSTEPS;
        let own = system.stable_dt()?.min(longest_fluid_step);
        let shortest_step = shortest_step(incompressible, own);
        let limits = ElementLimits { sound_speed, most_substeps, longest_fluid_step, shortest_step, added_mass: None };
        HostedRun::new(FluidElement::of(system, link, limits), fingerprint, records.transpose()?)
    }
}

/// An error for a node that is faster than sound at the start.
fn refuse_fast(nodes: &HostNodes, sound_speed: f64) -> Result<(), HostedError> {
    let speed = |v: &[f64; 2]| v[0].hypot(v[1]);
    let fast = nodes.velocity.iter().position(|v| speed(v) > sound_speed);
    fast.map_or(Ok(()), |node| {
        let given = format!("{:.6e} m/s", speed(&nodes.velocity[node]));
        let expected = format!("at most the speed of sound, {sound_speed} m/s");
        Err(HostError::Node { node, quantity: "speed", given, expected, time: 0.0 }.into())
    })
}
