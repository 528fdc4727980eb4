//! Does the resolved scene make sense as a whole? Each check compares what single keys cannot know of each other.

use std::fmt::Display;

use fsi_coupling::Shape;
use fsi_coupling::geometry::plate::too_tight;
use fsi_coupling::geometry::polygon;
use settings::{Problem, require, significant};

use super::auto::hydrostatic_sound;
use super::keys::{Block, Body, Gauge, GaugeFrame, Motion, Scene, Similarity, Symmetry};
use super::legacy::{breakdown_cfl, hollow_walls};
use super::references::check_reference;
use super::resolve_links::{check_links, further};
use super::symmetric::{check_symmetric, on_axis};
use super::validity::projection::check_projection_step;
use super::validity::waves::check_waves;

/// Spacings across the thinnest part of a body: three rows of wall particles behind each face.
const THINNEST_BODY: f64 = 6.0;

/// Spacings across the smallest body of water, and across the smallest block of it.
const SMALLEST_WATER: f64 = 4.0;

/// Density over that of the reference that water cannot reach.
const DENSEST: f64 = 1.3;

/// Largest rise or fall of the surface over the depth: columns are stretched by as much.
const LARGEST_RISE: f64 = 0.5;

/// Refuses a scene that has no sense as a whole; `columns` are those of its curves.
pub(super) fn check(scene: &Scene, columns: &[String]) -> Result<(), Problem> {
    check_water(scene)?;
    check_surface(scene)?;
    scene.tank.block().map_or(Ok(()), |block| check_block(scene, &block))?;
    check_waves(scene)?;
    check_levels(scene)?;
    scene.body.as_ref().map_or(Ok(()), |body| check_body(scene, body))?;
    for (i, body) in scene.bodies.iter().enumerate() {
        check_body(scene, body).map_err(|problem| further(problem, i))?;
    }
    check_links(scene)?;
    let [x, y] = scene.gravity;
    on_axis(scene.symmetry == Symmetry::None || x == 0.0, "gravity", [x, y])?;
    check_names(scene)?;
    for (i, gauge) in scene.gauges.iter().enumerate() {
        check_gauge(scene, gauge, |name| format!("gauges[{i}].{name}"))?;
    }
    check_comparisons(scene, &columns[1..])?;
    scene.rule.map_or(Ok(()), |rule| rule.check())?;
    scene.similarity.map_or(Ok(()), |Similarity::Wedge| check_wedge_similarity(scene))
}

fn check_body(scene: &Scene, body: &Body) -> Result<(), Problem> {
    check_body_in_tank(scene, body)?;
    match &body.shape {
        Shape::Polyline { points, thickness } => check_plate(scene, points, *thickness)?,
        _ if scene.model.is_theory() => (), // no walls of particles
        shape => check_thickness(scene, shape.thickness())?,
    }
    if scene.symmetry == Symmetry::X { check_symmetric(body) } else { Ok(()) }
}

/// Refuses a Courant number, or a fixed step, at which the integrator breaks down.
pub(super) fn check_step(scene: &Scene) -> Result<(), Problem> {
    let Some(fluid) = scene.solver.weakly_compressible() else {
        return check_projection_step(scene); // its steps know no sound
    };
    let (largest, name) = breakdown_cfl(&fluid.options);
    check_weight(scene, fluid.scheme.eos_exponent)?;
    let cfl = scene.courant_number();
    let expected = format_args!("a number above 0 and below {largest}, where {name} breaks down");
    require(cfl < largest, "fluid.cfl", cfl, expected)?;
    // at the speed of sound alone: moving water allows less
    let still = largest * fluid.water.fluid.smoothing_ratio * scene.resolution.spacing / scene.sound_speed();
    let step = scene.time.step.unwrap_or(0.0);
    let limit = significant(still);
    let expected = format_args!("an interval below {limit} s, {largest} h/c0, where {name} breaks down");
    require(step < still, "time.step", step, expected)
}

/// Refuses a speed of sound at which the water's own weight makes it 8 % denser at the floor of an impact, 30 % denser at that of any
/// tank (THEORY WC17).
fn check_weight(scene: &Scene, exponent: f64) -> Result<(), Problem> {
    let depth = scene.tank.depth;
    let least = (!scene.entries().is_empty()).then(|| hydrostatic_sound(scene.gravity, depth)[1]);
    let stiffness = exponent / (DENSEST.powf(exponent) - 1.0);
    let least = least.unwrap_or((stiffness * scene.gravity[1].abs() * depth).sqrt());
    let (sound, limit, depth) = (scene.sound_speed(), significant(least), significant(depth));
    let expected = format_args!("at least {limit} m/s, which the weight of {depth} m of water needs");
    require(sound >= least, "fluid.sound_speed", significant(sound), expected)
}

fn check_water(scene: &Scene) -> Result<(), Problem> {
    let (tank, least) = (&scene.tank, SMALLEST_WATER * scene.resolution.spacing);
    let (width, water) = (tank.width, tank.water_width);
    let enough = format!("at least {SMALLEST_WATER} spacings of water, {} m", significant(least));
    for (key, length) in [("tank.width", width), ("tank.depth", tank.depth), ("tank.water_width", water)] {
        require(length >= least, key, length, &enough)?;
    }
    require(water <= width, "tank.water_width", water, format_args!("at most tank.width = {width} m"))?;
    let half = scene.symmetry == Symmetry::X;
    let expected = format_args!("tank.width = {width} m with symmetry = \"x\"");
    require(!half || water >= width, "tank.water_width", water, expected)?;
    let expected = format_args!("at least tank.depth = {} m", tank.depth);
    require(tank.height >= tank.depth, "tank.height", tank.height, expected)
}

/// The surface that the water starts with fits the tank (THEORY WC19); with a mirror at x = 0 it is its own image.
fn check_surface(scene: &Scene) -> Result<(), Problem> {
    let tank = &scene.tank;
    let Some(surface) = tank.surface() else { return Ok(()) };
    let (rise, largest, mode) = (surface.largest(), LARGEST_RISE * tank.depth, tank.surface_mode);
    let waves = tank.surface_amplitude != 0.0;
    let (key, given) = match waves {
        true => ("tank.surface_amplitude", tank.surface_amplitude),
        false => ("tank.surface_tilt_deg", tank.surface_tilt_deg),
    };
    let [by, most] = [rise, largest].map(significant);
    let expected =
        format_args!("a surface that rises and falls by no more than {most} m, half the depth: this one may by {by} m");
    require(rise <= largest, key, given, expected)?;
    let highest = tank.depth + rise;
    let expected = format_args!("at least {} m, where the water starts", significant(highest));
    require(tank.height >= highest, "tank.height", tank.height, expected)?;
    let expected = format_args!("tank.width = {} m with a surface that is not level", tank.width);
    require(tank.water_width >= tank.width, "tank.water_width", tank.water_width, expected)?;
    let short = waves && tank.width / f64::from(mode) < SMALLEST_WATER * scene.resolution.spacing;
    let expected = format_args!("at most one half wave to {SMALLEST_WATER} spacings");
    require(!short, "tank.surface_mode", mode, expected)?;
    let whole = scene.symmetry == Symmetry::None;
    let (tilt, level) = (tank.surface_tilt_deg, tank.surface_tilt_deg == 0.0);
    require(whole || level, "tank.surface_tilt_deg", tilt, "0 with symmetry = \"x\"")?;
    require(whole || mode % 2 == 0, "tank.surface_mode", mode, "an even number with symmetry = \"x\"")
}

/// The block of water in the air is between the walls and above the water (THEORY WC18).
fn check_block(scene: &Scene, block: &Block) -> Result<(), Problem> {
    let (tank, half, [from, to]) = (&scene.tank, scene.symmetry == Symmetry::X, [block.from, block.to]);
    let least = SMALLEST_WATER * scene.resolution.spacing;
    let left = if half { 0.0 } else { -0.5 * tank.width };
    let (right, rise, rim) = (0.5 * tank.width, tank.rise(), tank.height - tank.depth);
    let expected = format_args!(
        "at least {SMALLEST_WATER} spacings, {} m, above and right of block_from = {from:?}",
        significant(least)
    );
    let large = (0..2).all(|k| to[k] - from[k] >= least);
    require(large, "tank.block_to", format_args!("{to:?}"), expected)?;
    let expected = format_args!("x of at least {left} m and y of at least {rise} m, where the water below ends");
    require(from[0] >= left && from[1] >= rise, "tank.block_from", format_args!("{from:?}"), expected)?;
    let expected = format_args!("x of at most {right} m and y of at most {} m, the walls' rim", significant(rim));
    require(to[0] <= right && to[1] <= rim, "tank.block_to", format_args!("{to:?}"), expected)?;
    let leaves_mirror = half && from[0] == 0.0 && block.velocity[0] != 0.0;
    let given = format_args!("{:?}", block.velocity);
    require(!leaves_mirror, "tank.block_velocity", given, "[0, ...] on the mirror")
}

fn check_body_in_tank(scene: &Scene, body: &Body) -> Result<(), Problem> {
    let [min, max] = polygon::bounding_box(&body.placed_outline());
    if matches!((&body.shape, &body.motion), (Shape::Polyline { .. }, Motion::Fixed)) {
        return check_standing_plate(scene, [min, max]);
    }
    let half = 0.5 * scene.tank.width;
    let [left, right, low] = [min[0], max[0], min[1]].map(significant);
    let [wall, floor] = [half, -scene.tank.depth].map(significant);
    let placed =
        |holds: bool, given: &dyn Display, expected: &dyn Display| require(holds, "body.position", given, expected);
    let beside = |how: &str| format!("a body from x = {left} to {right} m, {how}");
    let inside = format!("a body between the walls at x = -{wall} and {wall} m");
    // what does not move may touch the tank
    let play = if body.motion == Motion::Fixed { 1e-9 * (scene.tank.width + scene.tank.depth) } else { 0.0 };
    placed(min[0] < half && max[0] > -half, &beside("off the tank"), &inside)?;
    let between = min[0] > -half - play && max[0] < half + play;
    placed(between, &beside("overlapping a tank wall"), &inside)?;
    let given = format_args!("a body down to y = {low} m, overlapping the floor");
    placed(min[1] > -scene.tank.depth - play, &given, &format_args!("a body above the floor at y = {floor} m"))?;
    match &body.motion {
        Motion::Oscillating(oscillation) => check_swing(scene, oscillation.amplitude, [min, max]),
        _ => Ok(()),
    }
}

/// A body that swings does so between the walls and above the floor, and moves at all.
fn check_swing(scene: &Scene, amplitude: [f64; 2], [min, max]: [[f64; 2]; 2]) -> Result<(), Problem> {
    let ([x, y], spacing) = (amplitude.map(f64::abs), scene.resolution.spacing);
    let half = 0.5 * scene.tank.width;
    let room = [(half - max[0]).min(min[0] + half), min[1] + scene.tank.depth];
    let expected = match () {
        _ if x == 0.0 && y == 0.0 => "other than [0, 0]: a body at rest has motion = \"fixed\"".to_string(),
        _ if x > 0.0 && x > room[0] - spacing => format!(
            "at most {} m along x, which leaves a spacing of water beside the wall",
            significant((room[0] - spacing).max(0.0))
        ),
        _ if y >= room[1] => format!("less than {} m along y, which is the way to the floor", significant(room[1])),
        _ => return Ok(()),
    };
    Err(Problem::new("body.amplitude", format!("{amplitude:?}"), expected))
}

/// A fixed plate may touch the tank's walls, and is not beyond them.
fn check_standing_plate(scene: &Scene, [min, max]: [[f64; 2]; 2]) -> Result<(), Problem> {
    let (half, floor) = (0.5 * scene.tank.width, -scene.tank.depth);
    let beyond = 1e-9 * scene.tank.width;
    let inside = min[0] >= -half - beyond && max[0] <= half + beyond && min[1] >= floor - beyond;
    let given = format!("a plate that reaches from {:?} to {:?} m", min.map(significant), max.map(significant));
    let [half, floor] = [half, floor].map(significant);
    let expected = format_args!(
        "a plate between the walls at x = -{half} and {half} m that ends at the floor, y = {floor} m, or above"
    );
    require(inside, "body.position", given, expected)
}

/// A thin plate (THEORY WA9) wants walls that fill it, and bends wider than its rows are deep.
fn check_plate(scene: &Scene, points: &[[f64; 2]], thickness: f64) -> Result<(), Problem> {
    let spacing = scene.resolution.spacing;
    let rows = (2.0 * scene.water().smoothing_ratio - 1e-9).ceil();
    if thickness >= 2.0 * rows * spacing {
        return Ok(());
    }
    if let Some(walls) = scene.solver.weakly_compressible().and_then(|fluid| hollow_walls(&fluid.options)) {
        let expected = format!(
            "extrapolated or mirror_point: the body is a plate {} m thin, thinner than {} spacings",
            significant(thickness),
            2.0 * rows
        );
        return Err(Problem::new("fluid.walls", format!("\"{walls}\""), expected));
    }
    let Some(side) = too_tight(points, rows * spacing - 0.5 * thickness) else { return Ok(()) };
    let expected = format!(
        "longer sides or gentler bends beside side {side}: {rows} rows of wall particles, {} m, turn with them",
        significant(rows * spacing)
    );
    Err(Problem::new("body.points", format!("{:?} to {:?}", points[side], points[side + 1]), expected))
}

fn check_thickness(scene: &Scene, thickness: f64) -> Result<(), Problem> {
    let (spacing, largest) = (scene.resolution.spacing, thickness / THINNEST_BODY);
    let expected = format_args!(
        "at most {} m: the body is {} m thin, and thinner than {THINNEST_BODY} spacings it is thinner than its walls \
         can represent",
        significant(largest),
        significant(thickness)
    );
    require(spacing <= largest * (1.0 + 1e-12), "resolution.spacing", spacing, expected)
}

/// Each name starts columns of its own.
fn check_names(scene: &Scene) -> Result<(), Problem> {
    let mut names: Vec<&str> = scene.body.iter().map(|body| body.name.as_str()).collect();
    let bodies = scene.bodies.iter().enumerate().map(|(i, body)| (format!("bodies[{i}].name"), &body.name, "thing"));
    let joints = scene.joints.iter().enumerate().map(|(i, j)| (format!("joints[{i}].name"), &j.name, "joint"));
    let panels = scene.body.iter().flat_map(|body| &body.panels).enumerate();
    let panels = panels.map(|(i, panel)| (format!("body.panels[{i}].name"), &panel.name, "panel"));
    let gauges = scene.gauges.iter().enumerate();
    for (key, name, kind) in bodies
        .chain(joints)
        .chain(panels)
        .chain(gauges.map(|(i, gauge)| (format!("gauges[{i}].name"), &gauge.name, "gauge")))
    {
        let expected = format_args!("a name that no other {kind} or body has");
        require(!names.contains(&name.as_str()), &key, format_args!("{name:?}"), expected)?;
        names.push(name);
    }
    Ok(())
}

fn check_gauge(scene: &Scene, gauge: &Gauge, key: impl Fn(&str) -> String) -> Result<(), Problem> {
    let (tank, [x, y], spacing) = (&scene.tank, gauge.at, scene.resolution.spacing);
    let at = format!("{:?}", gauge.at);
    if gauge.on == GaugeFrame::Body {
        let refused = || Problem::new(&key("on"), "\"body\"", "\"fixed\" in a scene without a body");
        let body = scene.body.as_ref().ok_or_else(refused)?;
        let nearest = polygon::nearest_point(&body.shape.outline(), gauge.at);
        let distance = (nearest[0] - x).hypot(nearest[1] - y);
        let [near_x, near_y, away] = [nearest[0], nearest[1], distance].map(significant);
        let expected =
            format_args!("a point on the body's outline: the nearest, [{near_x}, {near_y}], is {away} m away");
        return require(distance <= spacing, &key("at"), at, expected);
    }
    let right = 0.5 * tank.width;
    let left = if scene.symmetry == Symmetry::X { 0.0 } else { -right };
    let (floor, top) = (-tank.depth, tank.height - tank.depth);
    let inside = (left..=right).contains(&x) && (floor..=top).contains(&y);
    // only a gauge on a wall has a face to average over
    let away = (right - x.abs()).min(y + tank.depth);
    let faces = gauge.length == 0.0 || away <= spacing;
    let [left, right, floor, top, away] = [left, right, floor, top, away].map(significant);
    let expected = format_args!("a point in the tank, x from {left} to {right} and y from {floor} to {top} m");
    require(inside, &key("at"), at, expected)?;
    let expected = format_args!("0 for a gauge in the water, {away} m from the nearest wall");
    require(faces, &key("length"), gauge.length, expected)
}

/// The height of the water is read between the walls.
fn check_levels(scene: &Scene) -> Result<(), Problem> {
    let half = 0.5 * scene.tank.width;
    let left = if scene.symmetry == Symmetry::X { 0.0 } else { -half };
    scene.observe.level.iter().try_for_each(|x| {
        let between = (left..=half).contains(x);
        require(between, "observe.level", x, format_args!("places x from {left} to {half} m"))
    })
}

fn check_comparisons(scene: &Scene, known: &[String]) -> Result<(), Problem> {
    for (i, compare) in scene.compare.iter().enumerate() {
        let given = format_args!("{:?}", compare.quantity);
        let expected = format_args!("a column of this scene's series: {}", known.join(", "));
        require(known.contains(&compare.quantity), &format!("compare[{i}].quantity"), given, expected)?;
        check_reference(i, compare, scene.time.end)?;
    }
    Ok(())
}

/// The similarity solution asks for a wedge that touches the water at t = 0, keeps its speed and feels no gravity.
fn check_wedge_similarity(scene: &Scene) -> Result<(), Problem> {
    let has = |holds: bool, given: String, expected: &str| {
        let expected = format_args!("{expected} for the similarity solution of a wedge");
        require(holds, "similarity", format_args!("\"wedge\" {given}"), expected)
    };
    let Some(body) = &scene.body else { return has(false, "without a body".into(), "a wedge") };
    has(scene.bodies.is_empty() && scene.joints.is_empty(), "beside other bodies or joints".into(), "a wedge alone")?;
    let wedge = matches!(body.shape, Shape::Wedge { .. });
    has(wedge, format!("with shape = \"{}\"", body.shape.name()), "shape = \"wedge\"")?;
    let steady = body.motion == Motion::ConstantVelocity;
    has(steady, "with a body that may change its speed".into(), "motion = \"constant_velocity\"")?;
    let given = format!("with gravity = {:?}", scene.gravity);
    has(scene.gravity == [0.0, 0.0], given, "gravity = [0.0, 0.0]")?;
    let upright = body.velocity[0] == 0.0 && body.velocity[1] < 0.0 && body.angle_deg == 0.0;
    let given = format!("with angle_deg = {}, velocity = {:?}", body.angle_deg, body.velocity);
    let straight = upright && body.angular_velocity_deg_per_s == 0.0;
    has(straight, given, "an upright wedge that moves straight down")?;
    let keel = body.position[1];
    has(keel == 0.0, format!("with the keel at y = {keel} m"), "position = \"touching\"")
}
