//! From a draft to a scene: the values that the program finds, in the order in which they depend on each other.

use fsi_coupling::settings::Problem;
use sph_core::{FluidSettings, Solver, WallModel};

use super::auto::{auto_fine_zone, auto_reach, fastest_speed};
use super::draft::Draft;
use super::impact::Entry;
use super::resolve_body::resolve_body;
use super::resolve_fluid::resolve_fluid;
use super::resolve_resolution::{Growth, resolve_resolution};
use super::settings::{
    Body, Compare, Coupling, CouplingScheme, GRAVITY, Gauge, Motion, Scene, SolverSettings, Tank, Time,
};
use super::word::word;

/// Rows of the series and frames of particles in a run, where the scene does not say.
const SAMPLES: f64 = 500.0;
const FRAMES: f64 = 50.0;

/// Wall height over depth, where the scene does not say: above waves, and above the run-up of a dam break.
const FREEBOARD: f64 = 1.25;
const RUN_UP: f64 = 3.0;

/// Least half width of an automatic tank over the body's.
const BESIDE_BODY: f64 = 1.5;

pub(super) fn resolve(mut draft: Draft) -> Result<Scene, Problem> {
    let draft = &mut draft;
    let symmetry = draft.get("symmetry").unwrap_or_default();
    let gravity = draft.get("gravity").unwrap_or_else(GRAVITY);
    let time = resolve_time(draft)?;
    let body = resolve_body(draft, symmetry)?;
    let density = draft.get("fluid.density").unwrap_or(FluidSettings::default().density);
    let entry = body.as_ref().and_then(|body| Entry::of(body, gravity, density, time.end));
    let fastest = match &entry {
        Some(_) => fastest_speed(entry.as_ref(), body.as_ref(), gravity, 0.0),
        None => {
            let tank = resolve_tank(draft)?;
            fastest_speed(None, body.as_ref(), gravity, tank.fall()) + tank.block_speed()
        }
    };
    let solver = resolve_fluid(draft, entry.as_ref(), fastest)?;
    resolve_coupling(draft, &solver, body.as_ref())?;
    let automatic = !draft.is_given("resolution.fine_zone");
    let spacing = match draft.get::<f64>("resolution.spacing") {
        Some(spacing) => spacing,
        None => return Err(Problem::missing("resolution.spacing", "the finest spacing [m]")),
    };
    match &entry {
        Some(entry) => {
            let fine_zone = draft.fill("resolution.fine_zone", auto_fine_zone(entry, spacing));
            let [beside, below] = auto_reach(solver.sound_speed(), time.end, fine_zone);
            let off_center = body.as_ref().map_or(0.0, |body| body.middle().abs());
            let beside = beside.max(BESIDE_BODY * entry.half_breadth); // a short run may need less than the body does
            draft.fill("tank.width", 2.0 * (beside + off_center));
            draft.fill("tank.depth", below);
            resolve_tank(draft)?;
        }
        None => {
            let tank = resolve_tank(draft)?;
            // half a width of `width` covers the tank from wherever the body is
            draft.fill("resolution.fine_zone", [tank.width, tank.depth]);
        }
    };
    resolve_resolution(draft, &Growth { solver: &solver, entry: entry.as_ref(), body: body.as_ref(), automatic })?;
    for i in 0..draft.count("gauges") {
        let gauge: Gauge = draft.read(&format!("gauges[{i}]"))?;
        word(&format!("gauges[{i}].name"), &gauge.name)?;
    }
    for i in 0..draft.count("compare") {
        resolve_compare(draft, &format!("compare[{i}]"), time.end)?;
    }
    let model = model_of(&solver);
    draft.fill("model", model);
    let scene: Scene = draft.read("")?;
    word("name", &scene.name)?;
    Ok(scene)
}

/// The model of particles that a solver is.
fn model_of(solver: &SolverSettings) -> fsi_coupling::entry_theory::EntryModel {
    use fsi_coupling::entry_theory::EntryModel;
    if solver.is_incompressible() { EntryModel::Incompressible } else { EntryModel::Wcsph }
}

fn resolve_time(draft: &mut Draft) -> Result<Time, Problem> {
    if let Some(end) = draft.get::<f64>("time.end") {
        draft.fill("time.sample_every", end / SAMPLES);
        draft.fill("time.frame_every", end / FRAMES);
    }
    let time: Time = draft.read("time")?;
    let intervals =
        [("sample_every", Some(time.sample_every)), ("frame_every", Some(time.frame_every)), ("step", time.step)];
    for (key, value) in intervals {
        if let Some(value) = value.filter(|value| !(*value > 0.0 && *value <= time.end)) {
            let expected = format!("an interval above 0 and up to time.end = {} s", time.end);
            return Err(Problem::new(&format!("time.{key}"), value, expected));
        }
    }
    Ok(time)
}

fn resolve_tank(draft: &mut Draft) -> Result<Tank, Problem> {
    let expected = "a length [m]: \"auto\" needs a body that falls or moves down into the water";
    let length = |key: &str| draft.get::<f64>(key).ok_or_else(|| Problem::missing(key, expected));
    let (depth, width) = (length("tank.depth")?, length("tank.width")?);
    let water_width = draft.fill("tank.water_width", width);
    draft.fill("tank.height", if water_width < width { RUN_UP } else { FREEBOARD } * depth);
    let tank: Tank = draft.read("tank")?;
    match (tank.block_from, tank.block_to) {
        (None, None) if tank.block_velocity == [0.0; 2] => Ok(tank),
        (Some(_), Some(_)) => Ok(tank),
        (None, _) => Err(Problem::missing("tank.block_from", "the block's lower left corner [x, y] [m]")),
        (_, None) => Err(Problem::missing("tank.block_to", "the block's upper right corner [x, y] [m]")),
    }
}

/// Where a body bends, or moves freely in a projection, the scheme is, if the scene does not say, the one that holds whatever
/// its mass.
fn resolve_coupling(draft: &mut Draft, solver: &SolverSettings, body: Option<&Body>) -> Result<(), Problem> {
    let bends = body.is_some_and(|body| !body.panels.is_empty());
    let moves_freely = body.is_some_and(|body| matches!(body.motion, Motion::Free(_)));
    let is_light = bends || solver.kind() == Solver::Incompressible && moves_freely;
    let solves_both = matches!(solver.kind(), Solver::WeaklyCompressible | Solver::Incompressible);
    let options = solver.weakly_compressible().map(|fluid| &fluid.options);
    let extrapolated = options.is_none_or(|options| options.walls == WallModel::Extrapolated);
    let holding = is_light && solves_both && extrapolated;
    draft.fill("coupling.scheme", if holding { CouplingScheme::AddedMass } else { CouplingScheme::Weak });
    let scheme = draft.read::<Coupling>("coupling")?.scheme;
    let refused = |expected: &str| Err(Problem::new("coupling.scheme", format!("{:?}", scheme.name()), expected));
    if scheme != CouplingScheme::Weak && !extrapolated {
        return refused("\"weak\" with these fluid.walls: only \"extrapolated\" walls take a body's acceleration");
    }
    if scheme == CouplingScheme::AddedMass && !solves_both {
        return refused(
            "\"weak\" or \"iqn_ils\" with this solver: only \"weakly_compressible\" and \"incompressible\" solve a body's \
             acceleration together with the pressures",
        );
    }
    let half_step = options.is_some_and(|options| options.integrator == sph_core::Integrator::PredictorCorrector);
    if scheme == CouplingScheme::IqnIls && half_step {
        // it moves the body by the force of the half step, whose acceleration is not the one iterated for (THEORY CO8)
        return refused("\"added_mass\" with fluid.integrator = \"predictor_corrector\", or another integrator");
    }
    Ok(())
}

fn resolve_compare(draft: &mut Draft, table: &str, end: f64) -> Result<(), Problem> {
    draft.fill(&format!("{table}.window"), [0.0, end]);
    let compare: Compare = draft.read(table)?;
    for (key, factor) in [("scale", compare.scale), ("x_scale", compare.x_scale), ("y_scale", compare.y_scale)] {
        if factor == 0.0 {
            return Err(Problem::new(&format!("{table}.{key}"), 0, "a factor other than 0"));
        }
    }
    let window = compare.window;
    if window[0] < 0.0 || window[0] >= window[1] {
        let expected = "two times [from, to] [s] with 0 <= from < to";
        return Err(Problem::new(&format!("{table}.window"), format!("{window:?}"), expected));
    }
    Ok(())
}
