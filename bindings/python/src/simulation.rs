//! A scene that is stepped from Python.

use std::path::PathBuf;
use std::sync::atomic::Ordering;

use fsi_coupling::{Coupled, CouplingError, Motion};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use run::build;
use scene::Scene;

use crate::arrays::{self, Particles};
use crate::call::{Guarded, interruptible};
use crate::errors;
use crate::settings::{assignments, load};

/// Rounding that a step may be longer than the stable one [-].
const ROUNDING: f64 = 1e-9;

/// A scene built and stepped under the caller's control, by the same steps as run() takes.
///
/// Simulation(scene, set=None): `scene` is the name of a built-in scene or the path of a TOML file, `set` a dict of keys and values
/// as of the command's --set. Raises InputError for a wrong scene, and StepError where the water cannot be built.
///
/// Arrays are copies of one instant, read-only, and never change later: ask again after a step.
#[pyclass(frozen, module = "splashdown")]
pub struct Simulation {
    scene: Scene,
    /// Warnings about the scene.
    #[pyo3(get)]
    warnings: Vec<String>,
    state: Guarded<State>,
}

struct State {
    system: Coupled,
    is_saved: bool,
    broken: Option<String>,
    /// The particles as Python was given them, until they move.
    particles: Option<Py<PyDict>>,
}

impl State {
    fn sound(&mut self) -> PyResult<&mut State> {
        match &self.broken {
            Some(why) => Err(errors::step(format!("the simulation failed ({why}); restore() a saved state first"))),
            None => Ok(self),
        }
    }

    /// One step: of `fixed` [s], or the stable one.
    fn step(&mut self, fixed: Option<f64>) -> Result<f64, CouplingError> {
        let dt = fixed.map_or_else(|| self.system.stable_dt(), Ok)?;
        self.system.step_or_shorter(dt)
    }

    /// One of as few equal steps as lead to `end` [s], none of them longer than that of `step`.
    fn step_towards(&mut self, fixed: Option<f64>, end: f64) -> Result<f64, CouplingError> {
        let longest = fixed.map_or_else(|| self.system.stable_dt(), Ok)?;
        let rest = end - self.system.fluid.time();
        let parts = (rest / longest - ROUNDING).ceil().max(1.0);
        self.system.step_or_shorter(rest / parts)
    }

    /// The result of a step; a simulation that failed is not stepped on.
    fn ended<T>(&mut self, ended: Result<T, CouplingError>) -> PyResult<T> {
        self.particles = None;
        ended.map_err(|error| {
            self.broken = Some(error.to_string());
            errors::step(error)
        })
    }
}

#[pymethods]
impl Simulation {
    #[new]
    #[pyo3(signature = (scene, set=None))]
    fn new(py: Python<'_>, scene: PathBuf, set: Option<&Bound<'_, PyDict>>) -> PyResult<Simulation> {
        let loaded = load(py, &scene, &assignments(set)?)?;
        if loaded.scene.model.is_theory() {
            let model = loaded.scene.model.name();
            return Err(errors::input(format!(
                "model = \"{model}\" has no steps: expected a model of particles, or run()"
            )));
        }
        let system = py.detach(|| build::build(&loaded.scene)).map_err(errors::step)?;
        let state = State { system, is_saved: false, broken: None, particles: None };
        Ok(Simulation { scene: loaded.scene, warnings: loaded.warnings, state: Guarded::new(state) })
    }

    /// One step; returns its length [s].
    ///
    /// Without `dt` it is the step that run() would take. `dt` [s] is at most stable_dt: InputError otherwise. The step is taken shorter
    /// where the pressure equation of an incompressible scheme does not converge. StepError if it fails.
    #[pyo3(signature = (dt=None))]
    fn step(&self, py: Python<'_>, dt: Option<f64>) -> PyResult<f64> {
        let mut state = self.state.open()?;
        let state = state.sound()?;
        if let Some(dt) = dt {
            let longest = state.system.stable_dt().map_err(errors::step)?;
            if !(dt > 0.0 && dt <= (1.0 + ROUNDING) * longest) {
                return Err(errors::input(format!(
                    "dt = {dt} s: expected above 0 and at most stable_dt, {longest:e} s"
                )));
            }
        }
        let fixed = dt.or(self.scene.time.step);
        let ended = py.detach(|| state.step(fixed));
        state.ended(ended)
    }

    /// Steps until `time` [s], each a little shorter than stable, so that the last one ends there; returns how many. Ctrl-C ends it after a
    /// step.
    fn run_until(&self, py: Python<'_>, time: f64) -> PyResult<u64> {
        let mut state = self.state.open()?;
        let state = state.sound()?;
        let first = state.system.fluid.steps();
        if !time.is_finite() {
            return Err(errors::input(format!("run_until: {time} s: expected a time")));
        }
        let fixed = self.scene.time.step;
        let mut outcome = Ok(());
        let called = interruptible(py, |stop| {
            let rounding = ROUNDING * time.abs();
            while outcome.is_ok() && state.system.fluid.time() < time - rounding && !stop.load(Ordering::Relaxed) {
                outcome = state.step_towards(fixed, time).map(|_| ());
            }
        });
        state.ended(outcome)?;
        called?;
        Ok(state.system.fluid.steps() - first)
    }

    /// Time [s].
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.state.open()?.system.fluid.time())
    }

    /// Steps taken.
    #[getter]
    fn steps(&self) -> PyResult<u64> {
        Ok(self.state.open()?.system.fluid.steps())
    }

    /// The longest step that is stable now [s].
    #[getter]
    fn stable_dt(&self) -> PyResult<f64> {
        self.state.open()?.sound()?.system.stable_dt().map_err(errors::step)
    }

    /// The resolved scene, as TOML.
    #[getter]
    fn scene(&self) -> String {
        self.scene.to_toml()
    }

    /// The water's particles now: a dict of read-only arrays, in the order of the particles' identity.
    ///
    /// position (n, 2) [m], velocity (n, 2) [m/s], pressure (n) [Pa], density (n) [kg/m³], spacing (n) [m]. Asked twice between steps,
    /// the arrays are the same objects; after a step they stay as they were.
    #[getter]
    fn particles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let mut state = self.state.open()?;
        if let Some(known) = &state.particles {
            return known.bind(py).copy();
        }
        let made = particles(&state.system).into_dict(py)?;
        state.particles = Some(made.copy()?.unbind());
        Ok(made)
    }

    /// The walls' particles now, those of bodies and tank, as particles has the water's.
    #[getter]
    fn walls<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        walls(&self.state.open()?.system).into_dict(py)
    }

    /// The moving bodies by name: a dict each with position [m], angle [rad], velocity [m/s], angular_velocity [rad/s], acceleration
    /// [m/s²], force [N/m] and moment [N] of the water about the body's reference point.
    #[getter]
    fn bodies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let state = self.state.open()?;
        let all = PyDict::new(py);
        for body in state.system.bodies() {
            let Some(motion) = body.motion() else { continue };
            all.set_item(body.name(), motion_dict(py, &motion)?)?;
        }
        Ok(all)
    }

    /// Store the present state; it replaces the one stored before.
    fn save(&self) -> PyResult<()> {
        let mut state = self.state.open()?;
        let state = state.sound()?;
        state.system.checkpoint();
        state.is_saved = true;
        Ok(())
    }

    /// Return to the state last saved, as often as needed: a step repeated from there gives the same bits. StepError without one.
    fn restore(&self) -> PyResult<()> {
        let mut state = self.state.open()?;
        if !state.is_saved {
            return Err(errors::step("restore: given no saved state, expected a save() before"));
        }
        state.system.restore();
        (state.broken, state.particles) = (None, None);
        Ok(())
    }

    /// The present state as bytes, for restore_bytes() of a simulation of the same scene and settings, also in another process.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let mut state = self.state.open()?;
        Ok(PyBytes::new(py, &state.sound()?.system.to_bytes()))
    }

    /// Take a state from to_bytes(). InputError where the bytes are of another scene; then the simulation has failed.
    fn restore_bytes(&self, bytes: &[u8]) -> PyResult<()> {
        let mut state = self.state.open()?;
        let restored = state.system.restore_bytes(bytes);
        state.is_saved = false;
        state.particles = None;
        state.broken = restored.as_ref().err().map(ToString::to_string);
        restored.map_err(errors::input)
    }

    fn __repr__(&self) -> PyResult<String> {
        let state = self.state.open()?;
        let (fluid, name) = (&state.system.fluid, &self.scene.name);
        Ok(format!("<Simulation {name}: t = {:.6} s, {} particles of water>", fluid.time(), fluid.particles().len()))
    }
}

/// The water's particles in the order of their identity.
fn particles(system: &Coupled) -> Particles {
    let (p, fields) = (system.fluid.particles(), system.fluid.fields());
    let mut out = Particles::of_length(p.len());
    for k in 0..p.len() {
        let place = p.id[k] as usize; // identities are 0, 1, 2, …
        out.position[place] = [p.x[k], p.y[k]];
        out.velocity[place] = [p.u[k], p.v[k]];
        out.pressure[place] = fields.pressure[k];
        out.density[place] = p.rho[k];
        out.spacing[place] = (p.mass[k] / p.rho[k]).sqrt();
    }
    out
}

/// The walls' particles.
fn walls(system: &Coupled) -> Particles {
    let w = &system.walls;
    Particles {
        position: (0..w.len()).map(|k| [w.x[k], w.y[k]]).collect(),
        velocity: (0..w.len()).map(|k| [w.u[k], w.v[k]]).collect(),
        pressure: w.pressure.clone(),
        density: vec![system.fluid.domain().fluid.density; w.len()],
        spacing: w.volume.iter().map(|volume| volume.sqrt()).collect(),
    }
}

fn motion_dict<'py>(py: Python<'py>, motion: &Motion) -> PyResult<Bound<'py, PyDict>> {
    let pair = |pair: [f64; 2]| -> PyResult<Bound<'py, PyArray1<f64>>> { arrays::values(py, pair.to_vec()) };
    let dict = PyDict::new(py);
    dict.set_item("position", pair(motion.position)?)?;
    dict.set_item("angle", motion.angle)?;
    dict.set_item("velocity", pair(motion.velocity)?)?;
    dict.set_item("angular_velocity", motion.angular_velocity)?;
    dict.set_item("acceleration", pair(motion.acceleration)?)?;
    dict.set_item("force", pair(motion.force)?)?;
    dict.set_item("moment", motion.moment)?;
    Ok(dict)
}
