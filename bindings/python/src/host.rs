//! A scene whose body is moved from Python.

use std::path::PathBuf;

use fsi_coupling::embed::{HostNodes, Snapshot};
use numpy::{IntoPyArray, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use run::host::{ErrorKind, HostedError, HostedRun, HostedScene, Interface};
use scene::Scene;

use crate::call::{Guarded, refuse_fork};
use crate::host_arrays::{check_forces, read_nodes, read_start, write_forces};
use crate::run::results;
use crate::settings::{assignments, text};
use crate::{arrays, errors};

/// A scene whose body the caller moves, step by step; the water answers with forces.
///
/// Host(scene, interface="body", set=None, out=None, *, force=False, velocity=None, spin=None)
///
/// `scene` and `set` are as of run(); the scene's own motion of the body says only what is expected. What the caller moves is the
/// `interface`:
///
/// "body": one node, the body's reference point; forces F_x, F_y [N/m] and the moment [N] about it.
/// "nodes": the corners of the body's polygon, or the points of its plate, straight in between.
/// "turning_nodes": the same with rotations, cubic in between; loads have moments.
///
/// With `out` the folder gets the files of a run; `force` replaces a run that it holds. `velocity` (n, 2) [m/s] and `spin` (n) [rad/s] are
/// those of the nodes at the start, the scene's without. Raises InputError for a wrong scene.
#[pyclass(frozen, module = "splashdown")]
pub struct Host {
    scene: Scene,
    /// Warnings about the scene.
    #[pyo3(get)]
    warnings: Vec<String>,
    fluid_particles: usize,
    wall_particles: usize,
    bytes: u64,
    folder: Option<PathBuf>,
    state: Guarded<State>,
}

struct State {
    run: Option<HostedRun>,
    /// The nodes at the end of the last step that the water took.
    nodes: HostNodes,
    forces: Vec<[f64; 3]>,
}

impl State {
    fn running(&mut self) -> PyResult<&mut HostedRun> {
        self.run.as_mut().ok_or_else(ended)
    }
}

/// What the water did in a step of the host.
#[pyclass(frozen, get_all, module = "splashdown")]
pub struct Contribution {
    /// Steps that the water took.
    fluid_steps: u32,
    /// Longest step that the water could take next [s].
    fluid_dt: f64,
    /// Longest next step of a host with explicit coupling [s], an estimate; infinite where it is unknown.
    host_dt: f64,
    /// Energy given to the nodes [J/m].
    work: f64,
    /// Impulse given to the nodes, all together [N s/m].
    impulse: (f64, f64),
    /// Particles of water beyond a wall's surface at the end.
    penetrated: usize,
}

#[pymethods]
impl Contribution {
    fn __repr__(&self) -> String {
        let Contribution { fluid_steps, fluid_dt, work, .. } = self;
        format!("<Contribution: {fluid_steps} steps of the water, work {work:e} J/m, fluid_dt {fluid_dt:e} s>")
    }
}

fn ended() -> PyErr {
    errors::step("the host has ended: finish() was called")
}

fn hosted(py: Python<'_>, error: HostedError) -> PyErr {
    if let HostedError::Scene(error) = &error {
        return errors::scene(py, error);
    }
    match error.kind() {
        ErrorKind::Input | ErrorKind::State => errors::input(error),
        ErrorKind::Step | ErrorKind::Failed | ErrorKind::NothingSaved => errors::step(error),
        ErrorKind::File => errors::file(error),
    }
}

#[pymethods]
impl Host {
    #[new]
    #[pyo3(signature = (scene, interface="body", set=None, out=None, *, force=false, velocity=None, spin=None))]
    fn new(
        py: Python<'_>,
        scene: PathBuf,
        interface: &str,
        set: Option<&Bound<'_, PyDict>>,
        out: Option<PathBuf>,
        force: bool,
        velocity: Option<&Bound<'_, PyAny>>,
        spin: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Host> {
        refuse_fork()?;
        let sets = assignments(set)?;
        let interface = interface.parse::<Interface>().map_err(|error| hosted(py, error))?;
        let name = text(&scene)?;
        let mut sized = py.detach(|| HostedScene::open(name, &sets, interface)).map_err(|error| hosted(py, error))?;
        if let Some(folder) = &out {
            sized = sized.recording(folder.clone(), force).with_page(report::page_of_run);
        }
        let mut nodes = sized.nodes().clone();
        read_start(&mut nodes, velocity, spin)?;
        let (fluid_particles, wall_particles, bytes) = (sized.fluid_particles(), sized.wall_particles(), sized.bytes());
        let (scene, warnings) = (sized.scene().clone(), sized.warnings().to_vec());
        let run = py.detach(|| sized.build(&nodes)).map_err(|error| hosted(py, error))?;
        let forces = vec![[0.0; 3]; nodes.len()];
        let state = Guarded::new(State { run: Some(run), nodes, forces });
        Ok(Host { scene, warnings, fluid_particles, wall_particles, bytes, folder: out, state })
    }

    /// The water goes with the nodes through a step of `dt` [s], to where they are at its end; returns the mean forces of the step and
    /// what the water did: (forces, Contribution).
    ///
    /// `position` (n, 2) [m], `velocity` (n, 2) [m/s], `rotation` (n) [rad], `spin` (n) [rad/s]: C-contiguous arrays of float64, read
    /// in place. Without rotation and spin the nodes keep their rotations, and do not turn. Positions and velocities belong together as
    /// those of a smooth motion do. Forces are an array (n, 3) of F_x, F_y [N/m] and M [N] per metre of span, dt times which is the
    /// impulse; `out` is written and returned where it is given.
    ///
    /// Raises InputError for values or arrays that cannot be used, and nothing has changed; StepError where the step fails: then restore().
    #[pyo3(signature = (dt, position, velocity, rotation=None, spin=None, out=None))]
    fn contribute<'py>(
        &self,
        py: Python<'py>,
        dt: f64,
        position: &Bound<'py, PyAny>,
        velocity: &Bound<'py, PyAny>,
        rotation: Option<&Bound<'py, PyAny>>,
        spin: Option<&Bound<'py, PyAny>>,
        out: Option<Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyAny>, Contribution)> {
        let mut state = self.state.open()?;
        let State { run, nodes, forces } = &mut *state;
        let run = run.as_mut().ok_or_else(ended)?;
        if let Some(out) = &out {
            check_forces(out, forces.len())?;
        }
        let before = nodes.clone();
        let done = read_nodes(nodes, [position, velocity], [rotation, spin])
            .and_then(|()| py.detach(|| run.contribute(dt, nodes, forces)).map_err(|error| hosted(py, error)))
            .inspect_err(|_| *nodes = before)?;
        let contribution = Contribution {
            fluid_steps: done.fluid_steps,
            fluid_dt: done.fluid_dt,
            host_dt: done.host_dt,
            work: done.work,
            impulse: done.impulse.into(),
            penetrated: done.penetration.count,
        };
        let forces = match out {
            Some(out) => {
                write_forces(&out, forces)?;
                out
            }
            None => own(py, forces.clone())?.into_any(),
        };
        Ok((forces, contribution))
    }

    /// Time of the water [s].
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.state.open()?.running()?.time())
    }

    /// Longest step that the water could take next [s].
    #[getter]
    fn fluid_dt(&self, py: Python<'_>) -> PyResult<f64> {
        self.state.open()?.running()?.fluid_dt().map_err(|error| hosted(py, error))
    }

    /// Sizes: fluid_particles, wall_particles, bytes.
    #[getter]
    fn sizes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        dict.set_item("fluid_particles", self.fluid_particles)?;
        dict.set_item("wall_particles", self.wall_particles)?;
        dict.set_item("bytes", self.bytes)?;
        Ok(dict)
    }

    /// The resolved scene, as TOML.
    #[getter]
    fn scene(&self) -> String {
        self.scene.to_toml()
    }

    /// The nodes now: position (n, 2) [m], velocity (n, 2) [m/s], rotation (n) [rad], spin (n) [rad/s]. Arrays of the caller's own.
    #[getter]
    fn nodes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let nodes = self.state.open()?.running()?.nodes();
        nodes_dict(py, nodes)
    }

    /// Forces of the water on the nodes at this moment, (n, 3) [N/m, N/m, N]: to predict the next step with.
    #[getter]
    fn forces_now<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let forces = self.state.open()?.running()?.forces_now();
        own(py, forces)
    }

    /// The water and the body's surface now: time, position, velocity, pressure, spacing of the particles, surface (closed lines of
    /// points), nodes, force.
    fn snapshot<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let snapshot = self.state.open()?.running()?.snapshot();
        snapshot_dict(py, snapshot)
    }

    /// Store the present state; it replaces the one stored before. A host that failed stores nothing.
    fn save(&self) -> PyResult<()> {
        self.state.open()?.running()?.save();
        Ok(())
    }

    /// Return to the state last saved, as often as needed: a step repeated from there gives the same bits. StepError without one.
    fn restore(&self, py: Python<'_>) -> PyResult<()> {
        let mut state = self.state.open()?;
        state.running()?.restore().map_err(|error| hosted(py, error))?;
        state.nodes = state.running()?.nodes();
        Ok(())
    }

    /// The present state as bytes, for restore_bytes() of a host of the same scene, settings and interface, also in another process.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = self.state.open()?.running()?.to_bytes().map_err(|error| hosted(py, error))?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Take a state from to_bytes(). InputError where the bytes are of another scene; then the host has failed.
    fn restore_bytes(&self, py: Python<'_>, bytes: &[u8]) -> PyResult<()> {
        let mut state = self.state.open()?;
        state.running()?.restore_bytes(bytes).map_err(|error| hosted(py, error))?;
        state.nodes = state.running()?.nodes();
        Ok(())
    }

    /// Ends the run: with a folder, writes summary and report and returns the Run, else None. The host can do nothing more. OSError where
    /// the records could not be written, also in an earlier step.
    fn finish<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let run = self.state.open()?.run.take().ok_or_else(ended)?;
        let Some(outcome) = py.detach(|| run.finish()).map_err(|error| hosted(py, error))? else { return Ok(None) };
        let (summary, scene, series) = results(py, &outcome, &self.scene)?;
        let made = py.import("splashdown._run")?.getattr("ended")?.call1((&self.folder, summary, scene, series))?;
        Ok(Some(made))
    }

    fn __repr__(&self) -> PyResult<String> {
        let mut state = self.state.open()?;
        let (nodes, name) = (state.nodes.len(), &self.scene.name);
        Ok(match state.running() {
            Ok(run) => format!("<Host of {name}: t = {:.6} s, {nodes} nodes>", run.time()),
            Err(_) => format!("<Host of {name}: ended>"),
        })
    }
}

/// Triples as an array (n, 3) of the caller's own.
fn own(py: Python<'_>, triples: Vec<[f64; 3]>) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let shape = [triples.len(), 3];
    triples.into_flattened().into_pyarray(py).reshape(shape)
}

/// Nodes as arrays of the caller's own.
fn nodes_dict(py: Python<'_>, nodes: HostNodes) -> PyResult<Bound<'_, PyDict>> {
    let shape = [nodes.len(), 2];
    let dict = PyDict::new(py);
    dict.set_item("position", nodes.position.into_flattened().into_pyarray(py).reshape(shape)?)?;
    dict.set_item("velocity", nodes.velocity.into_flattened().into_pyarray(py).reshape(shape)?)?;
    dict.set_item("rotation", nodes.rotation.into_pyarray(py))?;
    dict.set_item("spin", nodes.spin.into_pyarray(py))?;
    Ok(dict)
}

fn snapshot_dict(py: Python<'_>, snapshot: Snapshot) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("time", snapshot.time)?;
    dict.set_item("position", arrays::pairs(py, snapshot.position)?)?;
    dict.set_item("velocity", arrays::pairs(py, snapshot.velocity)?)?;
    dict.set_item("pressure", arrays::values(py, snapshot.pressure)?)?;
    dict.set_item("spacing", arrays::values(py, snapshot.spacing)?)?;
    let surface = PyList::empty(py);
    for line in snapshot.surface {
        surface.append(arrays::pairs(py, line)?)?;
    }
    dict.set_item("surface", surface)?;
    dict.set_item("nodes", nodes_dict(py, snapshot.nodes)?)?;
    dict.set_item("force", own(py, snapshot.force)?)?;
    Ok(dict)
}
