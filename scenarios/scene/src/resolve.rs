//! From a draft to a scene: the values that the program finds, in the order in which they depend on each other.

use std::f64::consts::FRAC_PI_2;

use fsi_coupling::Shape;
use fsi_coupling::geometry::polygon;
use settings::{Problem, require};
use sph_core::{Dissipation, FluidSettings, Kernel, Solver};
use water_entry::EntryModel;

use super::auto::{auto_reach, auto_sound_speed, hydrostatic_sound};
use super::bottom::Bottom;
use super::draft::Draft;
use super::entries::{Meeting, fastest_of_all, middle_of_all, zone_of_all};
use super::impact::Entry;
use super::keys::{
    Beach, Body, Compare, Coupling, CouplingScheme, GRAVITY, Gauge, Joint, Lattice, Motion, Resolution, Scene,
    SolverSettings, Tank, Time, Water, WaveMaker, WeaklyCompressibleFluid,
};
use super::legacy;
use super::resolve_body::resolve_body;
use super::resolve_links::resolve_further_bodies;
use super::source::word;
use super::validity::first_contact::{check_start, earliest_start};
use super::validity::submerged;

/// Rows of the series and frames of particles in a run, where the scene does not say.
const SAMPLES: f64 = 500.0;
const FRAMES: f64 = 50.0;
/// Most rows of the series, or frames.
pub const MOST_ROWS: f64 = 4e6;

/// Wall height over depth, where the scene does not say: above waves, and above the run-up of a dam break.
const FREEBOARD: f64 = 1.25;
const RUN_UP: f64 = 3.0;

/// Calming of a projection (THEORY PR13) beside a wave maker [-]: the usual one takes 5 % of the waves' height per wavelength (WA13).
const CALMING_OF_WAVES: f64 = 0.02;

/// Least half width of an automatic tank over the body's.
const BESIDE_BODY: f64 = 1.5;

pub(super) fn resolve(mut draft: Draft) -> Result<Scene, Problem> {
    let draft = &mut draft;
    let symmetry = draft.get("symmetry").unwrap_or_default();
    let gravity = draft.get("gravity").unwrap_or_else(GRAVITY);
    let start: Option<f64> = draft.get("time.start");
    let time = resolve_time(draft)?;
    let body = resolve_body(draft, symmetry)?;
    let density = draft.get("fluid.density").unwrap_or(FluidSettings::default().density);
    let finest: f64 = draft.get("resolution.spacing").unwrap_or(f64::INFINITY);
    let others = resolve_further_bodies(draft, symmetry)?;
    let joints = resolve_joints(draft)?;
    let bodies: Vec<&Body> = body.iter().chain(&others).collect();
    let meeting = Meeting { gravity, density, end: time.end, spacing: finest };
    let entries = meeting.entries(bodies.iter().copied(), &joints);
    let tank = match entries.is_empty() {
        false => None,
        true => {
            bodies.iter().try_for_each(|body| refuse_rising(draft, body))?;
            Some(resolve_tank(draft)?)
        }
    };
    let fastest = fastest_of_all(bodies.iter().copied(), &entries, gravity, tank.as_ref())
        + tank.as_ref().map_or(0.0, Tank::block_speed);
    let automatic = !draft.is_given("resolution.fine_zone");
    let spacing = draft.get("resolution.spacing");
    let spacing: f64 = spacing.ok_or_else(|| Problem::missing("resolution.spacing", "the finest spacing [m]"))?;
    let still = if entries.is_empty() {
        0.0
    } else {
        let zone = zone_of_all(&entries, middle_of_all(bodies.iter().copied(), &entries), spacing);
        let fine_zone = draft.fill("resolution.fine_zone", zone);
        let least = auto_reach(0.0, time.end, fine_zone, gravity)[1];
        hydrostatic_sound(gravity, draft.get("tank.depth").unwrap_or(least))[0]
    };
    let gentle = body.is_none() && tank.as_ref().is_some_and(Tank::is_full);
    let submerged = tank.as_ref().is_some_and(|tank| tank.block_from.is_none())
        && bodies.iter().any(|body| body.starts_under_water());
    let rigid = bodies.iter().all(|body| !body.bends() && !matches!(body.shape, Shape::Polyline { .. }));
    let solver = resolve_fluid(draft, &bodies, &entries, fastest, still, [gentle, submerged && rigid])?;
    let waves = tank.as_ref().is_some_and(Tank::is_wave_tank);
    let calmed = matches!(solver.kind(), Solver::Incompressible | Solver::IncompressibleExplicit);
    if waves && calmed {
        draft.fill("projection.calming", CALMING_OF_WAVES);
    }
    if submerged && rigid && calmed {
        submerged::fill_projection(draft);
    }
    resolve_coupling(draft, &solver, &bodies)?;
    match entries.is_empty() {
        false => {
            let fine_zone: [f64; 2] = draft.read("resolution.fine_zone")?;
            let [beside, below] = auto_reach(solver.sound_speed(), time.end, fine_zone, gravity);
            // a short run may need less than the body does
            let beside =
                |(body, entry): &(&Body, Entry)| beside.max(BESIDE_BODY * entry.half_breadth) + body.middle().abs();
            draft.fill("tank.width", 2.0 * entries.iter().map(beside).fold(0.0, f64::max));
            draft.fill("tank.depth", below);
            resolve_tank(draft)?;
        }
        true => {
            let tank = resolve_tank(draft)?;
            // half a width of `width` covers the tank from wherever the body is
            draft.fill("resolution.fine_zone", [tank.width, tank.depth]);
        }
    };
    resolve_resolution(draft, &solver, &entries, &bodies, [automatic, submerged])?;
    for i in 0..draft.count("gauges") {
        let gauge: Gauge = draft.read(&format!("gauges[{i}]"))?;
        word(&format!("gauges[{i}].name"), &gauge.name)?;
    }
    for i in 0..draft.count("compare") {
        resolve_compare(draft, &format!("compare[{i}]"), time.end)?;
    }
    let model =
        draft.fill("model", if solver.is_incompressible() { EntryModel::Incompressible } else { EntryModel::Wcsph });
    let flying: Vec<(&Body, Option<Entry>)> = bodies.iter().map(|body| (*body, meeting.entry(body, &joints))).collect();
    check_start(time.start, &flying, solver.kind(), gravity, spacing)?;
    if start.is_none() && !model.is_theory() && !entries.is_empty() {
        draft.set("time.start", earliest_start(&flying, solver.kind(), gravity, spacing));
    }
    let scene: Scene = draft.read("")?;
    word("name", &scene.name)?;
    Ok(scene)
}

fn resolve_time(draft: &mut Draft) -> Result<Time, Problem> {
    draft.fill("time.start", 0.0);
    if let Some(end) = draft.get::<f64>("time.end") {
        draft.fill("time.sample_every", end / SAMPLES);
        draft.fill("time.frame_every", end / FRAMES);
    }
    let time: Time = draft.read("time")?;
    let expected = format!("an interval above 0 and up to time.end = {} s", time.end);
    for (key, value) in [
        ("time.sample_every", Some(time.sample_every)),
        ("time.frame_every", Some(time.frame_every)),
        ("time.step", time.step),
    ] {
        let value = value.unwrap_or(time.end);
        require(value > 0.0 && value <= time.end, key, value, &expected)?;
        let least = time.end / MOST_ROWS;
        require(
            key == "time.step" || value >= least,
            key,
            value,
            format_args!("at least {least} s: {MOST_ROWS} rows"),
        )?;
    }
    Ok(time)
}

/// The joints, complete.
fn resolve_joints(draft: &mut Draft) -> Result<Vec<Joint>, Problem> {
    (0..draft.count("joints")).map(|i| draft.read(&format!("joints[{i}]"))).collect()
}

/// A body that moves up does not meet the water: without a tank of its own such a scene has a wrong sign.
fn refuse_rising(draft: &Draft, body: &Body) -> Result<(), Problem> {
    let has_tank = draft.is_given("tank.depth") && draft.is_given("tank.width");
    if has_tank || body.velocity[1] <= 0.0 { Ok(()) } else { Err(no_fall(body.velocity, "moves up")) }
}

/// A velocity with which a body does not fall into the water, and what it does instead.
fn no_fall(velocity: [f64; 2], what: &str) -> Problem {
    let expected = format!("y below 0, down into the water, or a [tank] with width and depth: this body {what}");
    Problem::new("body.velocity", format!("{velocity:?}"), expected)
}

fn resolve_tank(draft: &mut Draft) -> Result<Tank, Problem> {
    let expected = "a length [m]: \"auto\" needs a body that falls or moves down into the water without a joint";
    let at_rest = draft.get::<[f64; 2]>("body.velocity").filter(|v| v[1] == 0.0 && draft.is_given("body.velocity"));
    let missing = |key: &str| at_rest.map_or(Problem::missing(key, expected), |v| no_fall(v, "does not fall"));
    let length = |key: &str| draft.get::<f64>(key).ok_or_else(|| missing(key));
    let (depth, width) = (length("tank.depth")?, length("tank.width")?);
    let water_width = draft.fill("tank.water_width", width);
    let crest = draft.get::<f64>("tank.wave_maker.height").map_or(0.0, |height| depth + height);
    draft.fill("tank.height", (if water_width < width { RUN_UP } else { FREEBOARD } * depth).max(FREEBOARD * crest));
    if draft.is_given("tank.wave_maker") {
        draft.read::<WaveMaker>("tank.wave_maker")?;
    }
    if draft.is_given("tank.beach") {
        draft.read::<Beach>("tank.beach")?;
    }
    let tank: Tank = draft.read("tank")?;
    match (tank.block_from, tank.block_to) {
        (None, None) if tank.block_velocity == [0.0; 2] => Ok(tank),
        (Some(_), Some(_)) => Ok(tank),
        (None, _) => Err(Problem::missing("tank.block_from", "the block's lower left corner [x, y] [m]")),
        (_, None) => Err(Problem::missing("tank.block_to", "the block's upper right corner [x, y] [m]")),
    }
}

/// Least mass over the added mass (π/2)ρb² of a wedge at its wet chines, of those that were compared without tension behind them [-]; at a
/// hundredth bodies gained energy.
const LEAST_MASS_RATIO: f64 = 0.4;

/// Speed of sound that stands in an incompressible scene without gravity in which nothing moves, where no number follows from it [m/s].
const AT_REST: f64 = 1.0;

/// Mass [kg/m] from which a falling wedge counts as heavy.
fn least_heavy_mass(draft: &Draft, entry: &Entry) -> f64 {
    let density = draft.get::<f64>("fluid.density").unwrap_or(FluidSettings::default().density);
    LEAST_MASS_RATIO * FRAC_PI_2 * density * entry.half_breadth.powi(2)
}

/// Pressure [Pa] that bounds the tension of water which a free body with a keel enters, −ρ(½V² + gL) with the larger L of its breadth
/// and height: air comes in where it would be lower. With more tension jets are sucked around its chines and its lee side. With none,
/// noise is cut to one side and light bodies gain energy; heavy ones and those at a given speed do not, and have none where their chines get
/// wet. With dry chines, beside faces that bend, and under flat and round bottoms, a bound would add to the noise of the start.
fn tension_beside_air(draft: &Draft, entry: &Entry, body: &Body) -> f64 {
    let density = draft.get::<f64>("fluid.density").unwrap_or(FluidSettings::default().density);
    let [low, high] = polygon::bounding_box(&body.placed_outline());
    let length = (high[0] - low[0]).max(high[1] - low[1]);
    let [gx, gy] = draft.get("gravity").unwrap_or_else(GRAVITY);
    -density * (0.5 * (body.velocity[0].powi(2) + entry.speed.powi(2)) + length * gx.hypot(gy))
}

/// True for straight faces with a keel.
fn has_keel(entry: &Entry) -> bool {
    matches!(entry.bottom, Bottom::Wedge { .. }) && !entry.is_flat()
}

/// Pressure [Pa] that bounds the tension of the water which a body enters; `None` for no bound. Of several bodies the lowest holds: a higher one
/// lets light bodies gain energy and adds to the noise under flat bottoms.
fn least_pressure(draft: &Draft, body: &Body, entry: &Entry) -> Option<f64> {
    let round = matches!(entry.bottom, Bottom::Arc { .. });
    if entry.leaves_its_sides() || round && entry.wets_its_chines() {
        return Some(0.0);
    }
    if !has_keel(entry) {
        return None;
    }
    let rigid_and_wet = entry.wets_its_chines() && !body.bends();
    match &body.motion {
        Motion::ConstantVelocity | Motion::Tabulated(_) if rigid_and_wet => Some(0.0),
        Motion::Free(freedom) if rigid_and_wet && freedom.mass >= least_heavy_mass(draft, entry) => Some(0.0),
        Motion::Free(_) => Some(tension_beside_air(draft, entry, body)),
        _ => None,
    }
}

/// Acoustic steps per advective step where a rigid body enters the water (THEORY WC22) [-]: means are those of 1, and 16 are noisier.
const ACOUSTIC_STEPS_OF_AN_ENTRY: u32 = 12;

/// The solver's settings, complete. `fastest` is the largest known speed of the flow [m/s]; `still` the speed of
/// sound that the water's weight needs [m/s]. `gentle`: nothing falls into the water, and no dam breaks; `submerged`: a body
/// starts under water, and all are rigid and closed.
fn resolve_fluid(
    draft: &mut Draft,
    bodies: &[&Body],
    entries: &[(&Body, Entry)],
    fastest: f64,
    still: f64,
    [gentle, submerged]: [bool; 2],
) -> Result<SolverSettings, Problem> {
    let solver: Solver = draft.get("solver").unwrap_or_default();
    let thesis = solver == Solver::IncompressibleThesis;
    let gaseous = legacy::fill(draft, thesis);
    if draft.get("fluid.dissipation") == Some(Dissipation::Riemann) {
        let keys = ["fluid.artificial_viscosity", "fluid.density_diffusion"];
        for key in &keys[..if thesis { 1 } else { 2 }] {
            let coefficient = draft.fill(key, 0.0);
            let expected = "none, or 0, with fluid.dissipation = \"riemann\", which has no coefficients";
            require(coefficient == 0.0, key, coefficient, expected)?;
        }
    }
    if solver == Solver::WeaklyCompressible {
        draft.fill("fluid.shifting_at_surface", !gentle);
    }
    if solver == Solver::WeaklyCompressible && !gaseous {
        let bounds: Vec<Option<f64>> = entries.iter().map(|(body, entry)| least_pressure(draft, body, entry)).collect();
        let lowest = bounds.iter().map(|bound| bound.unwrap_or(f64::NEG_INFINITY)).reduce(f64::min);
        lowest.filter(|bound| bound.is_finite()).map(|bound| draft.fill("fluid.cavitation_pressure", bound));
    }
    let given: Option<f64> = draft.get("fluid.sound_speed");
    let water: Water = draft.read("fluid")?;
    let sound = match auto_sound_speed(&water, entries.iter().map(|(_, entry)| entry), fastest, still) {
        // a size of the tank follows from it, and nothing else
        nothing if nothing == 0.0 && solver.is_incompressible() && !draft.is_given("tank.wave_maker") => AT_REST,
        sound => sound,
    };
    let sound = draft.fill("fluid.sound_speed", sound);
    if sound == 0.0 && !gaseous {
        if draft.get::<WaveMaker>("tank.wave_maker").is_some() {
            let expected = "[0, a number below 0] with a [tank.wave_maker]";
            return Err(Problem::new("gravity", "[0, 0]", expected));
        }
        let expected = "a speed [m/s]: \"auto\" needs gravity or a moving body";
        return Err(Problem::missing("fluid.sound_speed", expected));
    }
    if solver == Solver::WeaklyCompressible {
        let WeaklyCompressibleFluid { options, .. } = draft.read("fluid")?;
        if submerged {
            submerged::fill_weakly_compressible(draft, &options);
        }
        let WeaklyCompressibleFluid { scheme, options, .. } = draft.read("fluid")?;
        let bends = bodies.iter().any(|body| body.bends());
        let splits = !entries.is_empty() && entries.iter().all(|(_, entry)| !entry.is_flat());
        let settles = matches!(water.fluid.kernel, Kernel::WendlandC2 | Kernel::WendlandC4);
        let iterates = draft.get("coupling.scheme") == Some(CouplingScheme::IqnIls);
        let follows = draft.get("resolution.follow") != Some(false);
        let by_pairs = draft.get("fluid.still_pressure") != Some(true);
        if by_pairs && splits && !bends && settles && !iterates && follows && legacy::holds_geometry(&options) {
            draft.fill("fluid.acoustic_steps", ACOUSTIC_STEPS_OF_AN_ENTRY);
        }
        submerged::fill_still_pressure(draft, &options, submerged)?;
        legacy::complete(draft, &water.fluid, scheme, options, given)?;
    }
    draft.read("")
}

/// Where a body bends, or moves freely in a projection, the scheme is, if the scene does not say, the one that holds whatever
/// its mass.
fn resolve_coupling(draft: &mut Draft, solver: &SolverSettings, bodies: &[&Body]) -> Result<(), Problem> {
    use CouplingScheme::{AddedMass, Weak};
    let bends = bodies.iter().any(|body| body.bends());
    let moves_freely = bodies.iter().any(|body| body.is_free());
    let is_light = bends || solver.kind() == Solver::Incompressible && moves_freely;
    let solves_both = matches!(solver.kind(), Solver::WeaklyCompressible | Solver::Incompressible);
    let options = solver.weakly_compressible().map(|fluid| &fluid.options);
    let extrapolated = options.is_none_or(legacy::extrapolates);
    let alternates = bends && options.is_some_and(legacy::leaps);
    draft
        .fill("coupling.scheme", if is_light && solves_both && extrapolated && !alternates { AddedMass } else { Weak });
    let scheme = draft.read::<Coupling>("coupling")?.scheme;
    let allowed =
        |holds: bool, expected: &str| require(holds, "coupling.scheme", format_args!("{:?}", scheme.name()), expected);
    let walls = "\"weak\" with these fluid.walls: only \"extrapolated\" walls take a body's acceleration";
    allowed(scheme == Weak || extrapolated, walls)?;
    let verlet = "\"weak\" with fluid.integrator = \"verlet\" and a body that bends, or another integrator: its force alternates from \
                  step to step";
    allowed(scheme == Weak || !alternates, verlet)?;
    allowed(
        scheme != AddedMass || solves_both,
        "\"weak\" or \"iqn_ils\" with this solver: only \"weakly_compressible\" and \"incompressible\" solve a body's \
         acceleration together with the pressures",
    )?;
    options.map_or(Ok(()), |options| legacy::check_coupling(options, scheme == CouplingScheme::IqnIls))
}

/// Packing and refinement tracking; `automatic`: the scene leaves the fine zone to the program; `submerged`: so starts a body.
fn resolve_resolution(
    draft: &mut Draft,
    solver: &SolverSettings,
    entries: &[(&Body, Entry)],
    bodies: &[&Body],
    [automatic, submerged]: [bool; 2],
) -> Result<(), Problem> {
    let plate = bodies.iter().any(|body| matches!(body.shape, Shape::Polyline { .. }));
    let packing =
        draft.fill("resolution.packing", (solver.is_incompressible() && !bodies.is_empty() || submerged) && !plate);
    let beside_plate = "false with a polyline, beside which there is room anyhow";
    require(!(plate && packing), "resolution.packing", true, beside_plate)?;
    let asked: Option<bool> = draft.get("resolution.follow");
    draft.fill("resolution.follow", false);
    let resolution: Resolution = draft.read("resolution")?;
    for length in resolution.fine_zone {
        require(length > 0.0, "resolution.fine_zone", length, "a finite number above 0")?;
    }
    let growth = resolution.growth;
    require(
        resolution.lattice == Lattice::Square || growth == 1.0,
        "resolution.lattice",
        "\"staggered\"",
        format_args!("\"square\" with resolution.growth = {growth}: a staggered lattice needs growth = 1"),
    )?;
    // why the zone cannot grow (THEORY WC21): what is expected instead of `true`
    let of_options = solver.weakly_compressible().and_then(|fluid| legacy::obstacle_to_tracking(&fluid.options));
    let obstacle = match () {
        _ if entries.is_empty() => Some("false where no body enters the water"),
        _ if bodies.len() > entries.len() => {
            Some("false beside a body that does not enter the water: the fine zone follows those that do")
        }
        _ if growth == 1.0 => Some("false with resolution.growth = 1: all the water is fine"),
        _ if plate => Some("false with a polyline, whose sides see different water"),
        _ if solver.is_incompressible() => {
            Some("false with this solver: only \"weakly_compressible\" splits particles")
        }
        _ => of_options,
    };
    let rigid = bodies.iter().all(|body| !body.bends());
    let follow = asked.unwrap_or(obstacle.is_none() && automatic && rigid);
    require(!follow || obstacle.is_none(), "resolution.follow", true, obstacle.unwrap_or_default())?;
    draft.set("resolution.follow", follow);
    Ok(())
}

fn resolve_compare(draft: &mut Draft, table: &str, end: f64) -> Result<(), Problem> {
    draft.fill(&format!("{table}.window"), [0.0, end]);
    let compare: Compare = draft.read(table)?;
    for (key, factor) in [("scale", compare.scale), ("x_scale", compare.x_scale), ("y_scale", compare.y_scale)] {
        require(factor != 0.0, &format!("{table}.{key}"), 0, "a factor other than 0")?;
    }
    let [from, to] = compare.window;
    let expected = "two times [from, to] [s] with 0 <= from < to";
    require(0.0 <= from && from < to, &format!("{table}.window"), format_args!("{:?}", compare.window), expected)
}
