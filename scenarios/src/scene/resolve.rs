//! From a scene as written to a scene as run: defaults, ranges, and the values left to the program.

use super::auto::{auto_fine_zone, auto_reach, auto_sound_speed, fastest_speed};
use super::file::{CompareFile, CouplingFile, FluidFile, GaugeFile, ReportFile, SceneFile, TankFile, TimeFile};
use super::impact::{Entry, LARGEST_COMPRESSIBILITY_ERROR};
use super::model::{
    Compare, Coupling, CouplingScheme, Dissipation, EquationOfState, Fluid, Gauge, GaugeFrame, Integrator, Motion,
    Observe, Report, Scene, Tank, Time,
};
use super::model::{IdealGas, Solver, Turbulence, WallModel};
use super::problem::{Problem, not_negative, positive, required, significant, within, word};
use super::resolve_body::resolve_body;
use super::resolve_model::resolve_model;
use super::resolve_projection::{resolve_projection, settle_projection};
use super::resolve_resolution::{Grown, resolve_resolution};
use super::resolve_thesis::{resolve_thesis, settle_thesis};
use super::start::{resolve_block, resolve_surface};
use fsi_coupling::Shape;

/// Rows of the series and frames of particles in a run, where the scene does not say.
const SAMPLES: f64 = 500.0;
const FRAMES: f64 = 50.0;

/// Wall height over depth, where the scene does not say: above waves, and above the run-up of a dam break.
const FREEBOARD: f64 = 1.25;
const RUN_UP: f64 = 3.0;

/// Least half width of an automatic tank over the body's.
const BESIDE_BODY: f64 = 1.5;

/// Exponents of the equations of state, where the scene does not say: water's in Tait's law, air's.
const TAIT_EXPONENT: f64 = 7.0;
const AIR_EXPONENT: f64 = 1.4;

pub(super) fn resolve(mut file: SceneFile) -> Result<Scene, Problem> {
    let name = required("name", file.name, "a word for file names")?;
    let symmetry = file.symmetry.unwrap_or_default();
    let (model, solver) = resolve_model(file.model, file.solver)?;
    let gravity = file.gravity.unwrap_or([0.0, -9.81]);
    let time = resolve_time(&file.time)?;
    let body = file.body.map(|body| resolve_body(body, symmetry, file.resolution.spacing)).transpose()?;
    let density = positive("fluid.density", file.fluid.density.unwrap_or(1000.0))?;
    let entry = body.as_ref().and_then(|body| Entry::of(body, gravity, density, time.end));
    let fastest = match &entry {
        Some(_) => fastest_speed(entry.as_ref(), body.as_ref(), gravity, 0.0),
        None => {
            let depth = still_water("tank.depth", file.tank.depth)?;
            let width = still_water("tank.width", file.tank.width)?;
            let tank = resolve_tank(&file.tank, width, depth)?;
            fastest_speed(None, body.as_ref(), gravity, tank.fall()) + tank.block_speed()
        }
    };
    settle_thesis(&mut file.fluid, solver);
    settle_projection(&mut file.fluid, solver)?;
    let fluid = resolve_fluid(file.fluid, density, entry.as_ref(), fastest)?;
    let bends = body.as_ref().is_some_and(|body| !body.panels.is_empty());
    let moves_freely = body.as_ref().is_some_and(|body| matches!(body.motion, Motion::Free(_)));
    let yields = bends || solver == Solver::Incompressible && moves_freely;
    let coupling = resolve_coupling(&file.coupling, solver, &fluid, yields)?;
    let spacing = required("resolution.spacing", file.resolution.spacing, "the finest spacing [m]")?;
    let spacing = positive("resolution.spacing", spacing)?;
    let (tank, fine_zone) = match &entry {
        Some(entry) => {
            let fine_zone = file.resolution.fine_zone.unwrap_or_else(|| auto_fine_zone(entry, spacing));
            let [beside, below] = auto_reach(fluid.sound_speed, time.end, fine_zone);
            let off_center = body.as_ref().map_or(0.0, |body| body.middle().abs());
            let beside = beside.max(BESIDE_BODY * entry.half_breadth); // a short run may need less than the body does
            let width = file.tank.width.unwrap_or(2.0 * (beside + off_center));
            let depth = file.tank.depth.unwrap_or(below);
            (resolve_tank(&file.tank, width, depth)?, fine_zone)
        }
        None => {
            let width = still_water("tank.width", file.tank.width)?;
            let depth = still_water("tank.depth", file.tank.depth)?;
            let tank = resolve_tank(&file.tank, width, depth)?;
            // Half a width of `width` covers the tank from wherever the body is.
            (tank, file.resolution.fine_zone.unwrap_or([width, depth]))
        }
    };
    let solid = body.as_ref().is_some_and(|body| !matches!(body.shape, Shape::Polyline { .. }));
    if !solid && body.is_some() && file.resolution.packing == Some(true) {
        return Err(Problem::new(
            "resolution.packing",
            true,
            "false with a polyline, beside which there is room anyhow",
        ));
    }
    let snug = solver.is_incompressible() && solid;
    let grown = Grown { solver, fluid: &fluid, entry: entry.as_ref(), body: body.as_ref() };
    let resolution = resolve_resolution(&file.resolution, spacing, fine_zone, snug, &grown)?;
    Ok(Scene {
        name: word("name", name)?,
        description: file.description.unwrap_or_default(),
        source: file.source.unwrap_or_default(),
        model,
        choice: None,
        solver,
        symmetry,
        gravity,
        similarity: file.similarity,
        gauges: numbered("gauges", file.gauges, resolve_gauge)?,
        compare: numbered("compare", file.compare, |key, compare| resolve_compare(key, compare, time.end))?,
        observe: Observe {
            front: file.observe.front.unwrap_or(false),
            level: file.observe.level.unwrap_or_default(),
            volume: file.observe.volume.unwrap_or(false),
        },
        resolution,
        time,
        fluid,
        tank,
        body,
        report: resolve_report(&file.report)?,
        coupling,
        projection: resolve_projection(&file.projection, solver)?,
        thesis: resolve_thesis(file.thesis, solver)?,
    })
}

fn resolve_report(file: &ReportFile) -> Result<Report, Problem> {
    let log_budget = file.log_budget.map(|size| positive("report.log_budget", size)).transpose()?;
    Ok(Report { force_rules: file.force_rules.unwrap_or(false), log_budget })
}

/// Default scheme of a body that bends, or moves freely in a projection: `added_mass`, which is stable at any mass.
fn resolve_coupling(file: &CouplingFile, solver: Solver, fluid: &Fluid, yields: bool) -> Result<Coupling, Problem> {
    let solves_both = matches!(solver, Solver::WeaklyCompressible | Solver::Incompressible);
    let holding = yields && solves_both && fluid.walls == WallModel::Extrapolated;
    let scheme = file.scheme.unwrap_or(if holding { CouplingScheme::AddedMass } else { CouplingScheme::Weak });
    if scheme != CouplingScheme::Weak && fluid.walls != WallModel::Extrapolated {
        let expected = "\"weak\" with these fluid.walls: only \"extrapolated\" walls feel a body's acceleration";
        return Err(Problem::new("coupling.scheme", format!("{:?}", scheme.name()), expected));
    }
    if scheme == CouplingScheme::AddedMass && !solves_both {
        let expected = "\"weak\" or \"iqn_ils\" with this solver: only \"weakly_compressible\" and \"incompressible\" \
                        find a body's acceleration together with the pressures";
        return Err(Problem::new("coupling.scheme", format!("{:?}", scheme.name()), expected));
    }
    if scheme == CouplingScheme::IqnIls && fluid.integrator == Integrator::PredictorCorrector {
        // it moves the body by the force of the half step, whose acceleration is not the one iterated for (THEORY C5)
        let expected = "\"added_mass\" with fluid.integrator = \"predictor_corrector\", or another integrator";
        return Err(Problem::new("coupling.scheme", format!("{:?}", scheme.name()), expected));
    }
    let max_iterations = file.max_iterations.unwrap_or(50);
    if max_iterations == 0 {
        return Err(Problem::new("coupling.max_iterations", 0, "a number of iterations of at least 1"));
    }
    let tolerance = within("coupling.tolerance", file.tolerance.unwrap_or(1e-6), 1e-12..=0.1)?;
    Ok(Coupling { scheme, tolerance, max_iterations })
}

fn still_water(key: &str, value: Option<f64>) -> Result<f64, Problem> {
    required(key, value, "a length [m]: \"auto\" needs a body that falls or moves down into the water")
}

/// Resolves the tables of an array, each with its key `name[i]`.
fn numbered<F, T>(
    name: &str,
    items: Vec<F>,
    resolve: impl Fn(&str, F) -> Result<T, Problem>,
) -> Result<Vec<T>, Problem> {
    let numbered = items.into_iter().enumerate();
    numbered.map(|(i, item)| resolve(&format!("{name}[{i}]"), item)).collect()
}

fn resolve_time(file: &TimeFile) -> Result<Time, Problem> {
    let end = positive("time.end", required("time.end", file.end, "the end of the simulated time [s]")?)?;
    let interval = |key: &str, value: f64| match value > 0.0 && value <= end {
        true => Ok(value),
        false => Err(Problem::new(key, value, format!("an interval above 0 and up to time.end = {end} s"))),
    };
    Ok(Time {
        end,
        sample_every: interval("time.sample_every", file.sample_every.unwrap_or(end / SAMPLES))?,
        frame_every: interval("time.frame_every", file.frame_every.unwrap_or(end / FRAMES))?,
        step: file.step.map(|step| interval("time.step", step)).transpose()?,
    })
}

fn resolve_fluid(file: FluidFile, density: f64, entry: Option<&Entry>, fastest: f64) -> Result<Fluid, Problem> {
    let compressibility_error = within(
        "fluid.compressibility_error",
        file.compressibility_error.unwrap_or(0.01),
        1e-6..=LARGEST_COMPRESSIBILITY_ERROR,
    )?;
    let sound_speed = match file.sound_speed {
        Some(speed) => positive("fluid.sound_speed", speed)?,
        None => auto_sound_speed(compressibility_error, entry, fastest),
    };
    let equation_of_state = file.equation_of_state.unwrap_or_default();
    let gaseous = equation_of_state == EquationOfState::IdealGas;
    if sound_speed == 0.0 && !gaseous {
        let why = "a speed [m/s]: \"auto\" needs gravity or a moving body";
        return Err(Problem::missing("fluid.sound_speed", why));
    }
    if file.volume_correction == Some(true) {
        let expected = "false: the correction of volumes was dropped, since it gained nothing";
        return Err(Problem::new("fluid.volume_correction", true, expected));
    }
    let integrator = file.integrator.unwrap_or_default();
    let dissipation = file.dissipation.unwrap_or_default();
    let usual_exponent = if gaseous { AIR_EXPONENT } else { TAIT_EXPONENT };
    let mut fluid = Fluid {
        density,
        sound_speed,
        compressibility_error,
        eos_exponent: within("fluid.eos_exponent", file.eos_exponent.unwrap_or(usual_exponent), 1.0..=10.0)?,
        kernel: file.kernel.unwrap_or_default(),
        smoothing_ratio: within("fluid.smoothing_ratio", file.smoothing_ratio.unwrap_or(1.5), 1.0..=3.0)?,
        artificial_viscosity: coefficient("fluid.artificial_viscosity", file.artificial_viscosity, 0.02, dissipation)?,
        kinematic_viscosity: not_negative("fluid.kinematic_viscosity", file.kinematic_viscosity.unwrap_or(0.0))?,
        density_diffusion: coefficient("fluid.density_diffusion", file.density_diffusion, 0.3, dissipation)?,
        shifting: file.shifting.unwrap_or(true),
        settling: within("fluid.settling", file.settling.unwrap_or(0.1), 0.0..=0.3)?,
        wall_slip: file.wall_slip.unwrap_or_default(),
        wall_stretch: file.wall_stretch.unwrap_or(false),
        ventilation: file.ventilation.unwrap_or(false),
        integrator,
        cfl: positive("fluid.cfl", file.cfl.unwrap_or(usual_cfl(integrator, file.wall_stretch.unwrap_or(false))))?,
        verlet_correction_every: file.verlet_correction_every.unwrap_or(40),
        density_filter: file.density_filter.unwrap_or_default(),
        density_filter_every: file.density_filter_every.unwrap_or(20),
        xsph: within("fluid.xsph", file.xsph.unwrap_or(0.0), 0.0..=1.0)?,
        turbulence: file.turbulence.unwrap_or_default(),
        equation_of_state,
        temperature: positive("fluid.temperature", file.temperature.unwrap_or(288.15))?,
        molar_mass: positive("fluid.molar_mass", file.molar_mass.unwrap_or(0.028_964_4))?,
        density_evolution: file.density_evolution.unwrap_or_default(),
        density_diffusion_form: file.density_diffusion_form.unwrap_or_default(),
        walls: file.walls.unwrap_or_default(),
        limit_pressure: match file.limit_pressure.unwrap_or(1) {
            option @ (0 | 1) => option,
            other => return Err(Problem::new("fluid.limit_pressure", other, "0 or 1")),
        },
        dissipation,
    };
    if fluid.density_filter_every == 0 {
        return Err(Problem::new("fluid.density_filter_every", 0, "a number of steps of at least 1"));
    }
    if fluid.turbulence == Turbulence::Sps && fluid.kinematic_viscosity == 0.0 {
        let expected = "none, or a fluid.kinematic_viscosity above 0";
        return Err(Problem::new("fluid.turbulence", "\"sps\"", expected));
    }
    let steps_density_itself = matches!(fluid.integrator, Integrator::Verlet | Integrator::Beeman);
    if fluid.walls == WallModel::Dynamic && steps_density_itself {
        let expected = "symplectic or predictor_corrector, which advance the density of dynamic walls too";
        return Err(Problem::new(
            "fluid.integrator",
            "\"verlet\" or \"beeman\" with fluid.walls = \"dynamic\"",
            expected,
        ));
    }
    if let Some(gas) = fluid.gas() {
        fluid.sound_speed = gas_sound_speed(&gas, file.sound_speed)?;
    }
    Ok(fluid)
}

/// A coefficient of the diffusive dissipation [-]: of the Riemann form, which takes its place, 0.
fn coefficient(key: &str, given: Option<f64>, usual: f64, dissipation: Dissipation) -> Result<f64, Problem> {
    match (dissipation, given) {
        (Dissipation::Diffusion, given) => not_negative(key, given.unwrap_or(usual)),
        (Dissipation::Riemann, None | Some(0.0)) => Ok(0.0),
        (Dissipation::Riemann, Some(value)) => {
            let expected = "none, or 0, with fluid.dissipation = \"riemann\", which has no coefficients";
            Err(Problem::new(key, value, expected))
        }
    }
}

/// Speed of sound of a gas at rest [m/s]: its temperature's; a scene that says another contradicts itself.
fn gas_sound_speed(gas: &IdealGas, given: Option<f64>) -> Result<f64, Problem> {
    if gas.gamma <= 1.0 {
        return Err(Problem::new("fluid.eos_exponent", gas.gamma, "a ratio of specific heats above 1"));
    }
    let sound = gas.sound_speed_at_rest();
    match given {
        Some(speed) if (speed / sound - 1.0).abs() > 1e-9 => {
            let expected = format!("{} m/s, that of fluid.temperature in an ideal gas, or none", significant(sound));
            Err(Problem::new("fluid.sound_speed", speed, expected))
        }
        _ => Ok(sound),
    }
}

/// Courant number by default: the predictor–corrector needs half the symplectic scheme's for the same noise, stretching
/// behind walls two thirds of it for a steady force (THEORY E10).
fn usual_cfl(integrator: Integrator, wall_stretch: bool) -> f64 {
    match integrator {
        Integrator::Symplectic if wall_stretch => 0.4,
        Integrator::Symplectic => 0.6,
        Integrator::PredictorCorrector | Integrator::Beeman => 0.3,
        Integrator::Verlet => 0.05,
    }
}

fn resolve_tank(file: &TankFile, width: f64, depth: f64) -> Result<Tank, Problem> {
    let width = positive("tank.width", width)?;
    let depth = positive("tank.depth", depth)?;
    let water_width = positive("tank.water_width", file.water_width.unwrap_or(width))?;
    let room = if water_width < width { RUN_UP } else { FREEBOARD };
    let height = positive("tank.height", file.height.unwrap_or(room * depth))?;
    let (surface_amplitude, surface_mode, surface_tilt_deg) = resolve_surface(file)?;
    Ok(Tank {
        width,
        depth,
        height,
        water_width,
        surface_amplitude,
        surface_mode,
        surface_tilt_deg,
        block: resolve_block(file)?,
    })
}

fn resolve_gauge(table: &str, file: GaugeFile) -> Result<Gauge, Problem> {
    let key = |name: &str| format!("{table}.{name}");
    let name = required(&key("name"), file.name, "a word that starts its column in the series")?;
    Ok(Gauge {
        name: word(&key("name"), name)?,
        on: file.on.unwrap_or(GaugeFrame::Body),
        at: required(&key("at"), file.at, "a point [x, y] [m]")?,
        length: not_negative(&key("length"), file.length.unwrap_or(0.0))?,
        bandwidth: file.bandwidth.map(|hertz| positive(&key("bandwidth"), hertz)).transpose()?,
    })
}

fn resolve_compare(table: &str, file: CompareFile, end: f64) -> Result<Compare, Problem> {
    let key = |name: &str| format!("{table}.{name}");
    let factor = |name: &str, value: Option<f64>| match value.unwrap_or(1.0) {
        0.0 => Err(Problem::new(&key(name), 0, "a factor other than 0")),
        value => Ok(value),
    };
    let window = file.window.unwrap_or([0.0, end]);
    if window[0] < 0.0 || window[0] >= window[1] {
        let expected = "two times [from, to] [s] with 0 <= from < to";
        return Err(Problem::new(&key("window"), format!("{window:?}"), expected));
    }
    let tolerance = file.tolerance.map(|tolerance| positive(&key("tolerance"), tolerance));
    Ok(Compare {
        reference: required(&key("reference"), file.reference, "the path of a CSV file below the references")?,
        quantity: required(&key("quantity"), file.quantity, "a column of the series")?,
        scale: factor("scale", file.scale)?,
        x: required(&key("x"), file.x, "the reference's column of times")?,
        x_scale: factor("x_scale", file.x_scale)?,
        y: required(&key("y"), file.y, "the reference's column of values")?,
        y_scale: factor("y_scale", file.y_scale)?,
        window,
        norm: file.norm.unwrap_or_default(),
        tolerance: tolerance.transpose()?,
        threshold: within(&key("threshold"), file.threshold.unwrap_or(0.5), 0.01..=0.99)?,
    })
}
