//! Does the resolved scene make sense as a whole? Each check compares what single keys cannot know of each other.

use super::settings::{Body, Compare, Gauge, GaugeFrame, Motion, Scene, Similarity, Symmetry};
use super::start::check_start;
use crate::observers::columns;
use crate::reference::{ReferenceError, Table};
use fsi_coupling::Shape;
use fsi_coupling::geometry::plate::too_tight;
use fsi_coupling::geometry::polygon;
use fsi_coupling::settings::{Problem, significant};
use sph_core::WallModel;

/// Spacings across the thinnest part of a body: three rows of wall particles behind each face.
const THINNEST_BODY: f64 = 6.0;

/// Spacings across the smallest body of water.
const SMALLEST_WATER: f64 = 4.0;

pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    check_water(scene)?;
    check_start(scene)?;
    check_levels(scene)?;
    if let Some(body) = &scene.body {
        check_body_in_tank(scene, body)?;
        check_plate(scene, body)?;
        check_thickness(scene, body)?;
        if scene.symmetry == Symmetry::X {
            check_symmetric(body)?;
        }
    }
    if scene.symmetry == Symmetry::X && scene.gravity[0] != 0.0 {
        let given = format!("[{}, {}]", scene.gravity[0], scene.gravity[1]);
        return Err(Problem::new("gravity", given, "[0, ...] with symmetry = \"x\""));
    }
    check_gauges(scene)?;
    check_comparisons(scene)?;
    match scene.similarity {
        Some(Similarity::Wedge) => check_wedge_similarity(scene),
        None => Ok(()),
    }
}

fn check_water(scene: &Scene) -> Result<(), Problem> {
    let (tank, least) = (&scene.tank, SMALLEST_WATER * scene.resolution.spacing);
    let enough = format!("at least {SMALLEST_WATER} spacings of water, {} m", significant(least));
    let lengths = [("width", tank.width), ("depth", tank.depth), ("water_width", tank.water_width)];
    if let Some((key, length)) = lengths.iter().find(|(_, length)| *length < least) {
        return Err(Problem::new(&format!("tank.{key}"), length, enough));
    }
    if tank.water_width > tank.width {
        let expected = format!("at most tank.width = {} m", tank.width);
        return Err(Problem::new("tank.water_width", tank.water_width, expected));
    }
    if scene.symmetry == Symmetry::X && tank.water_width < tank.width {
        let expected = format!("tank.width = {} m with symmetry = \"x\"", tank.width);
        return Err(Problem::new("tank.water_width", tank.water_width, expected));
    }
    if tank.height < tank.depth {
        let expected = format!("at least tank.depth = {} m", tank.depth);
        return Err(Problem::new("tank.height", tank.height, expected));
    }
    Ok(())
}

fn check_body_in_tank(scene: &Scene, body: &Body) -> Result<(), Problem> {
    let [min, max] = polygon::bounding_box(&body.placed_outline());
    if stands(body) {
        return check_standing_plate(scene, [min, max]);
    }
    let half = 0.5 * scene.tank.width;
    let reach = format!("a body from x = {} to {} m", significant(min[0]), significant(max[0]));
    let inside = format!("a body between the walls at x = {} and {} m", significant(-half), significant(half));
    // what does not move may touch the tank
    let play = if body.motion == Motion::Fixed { 1e-9 * (scene.tank.width + scene.tank.depth) } else { 0.0 };
    if min[0] >= half || max[0] <= -half {
        return Err(Problem::new("body.position", format!("{reach}, off the tank"), inside));
    }
    if min[0] <= -half - play || max[0] >= half + play {
        return Err(Problem::new("body.position", format!("{reach}, overlapping a tank wall"), inside));
    }
    if min[1] <= -scene.tank.depth - play {
        let given = format!("a body down to y = {} m, overlapping the floor", significant(min[1]));
        let expected = format!("a body above the floor at y = {} m", significant(-scene.tank.depth));
        return Err(Problem::new("body.position", given, expected));
    }
    match &body.motion {
        Motion::Oscillating(oscillation) => check_swing(scene, oscillation.amplitude, [min, max]),
        _ => Ok(()),
    }
}

/// A body that swings does so between the walls and above the floor, and moves at all.
fn check_swing(scene: &Scene, amplitude: [f64; 2], [min, max]: [[f64; 2]; 2]) -> Result<(), Problem> {
    let [x, y] = amplitude.map(f64::abs);
    let half = 0.5 * scene.tank.width;
    let room = [(half - max[0]).min(min[0] + half), min[1] + scene.tank.depth];
    let expected = match () {
        _ if x == 0.0 && y == 0.0 => "other than [0, 0]: a body at rest has motion = \"fixed\"".to_string(),
        _ if x >= room[0] => format!("less than {} m along x, which is the way to a wall", significant(room[0])),
        _ if y >= room[1] => format!("less than {} m along y, which is the way to the floor", significant(room[1])),
        _ => return Ok(()),
    };
    Err(Problem::new("body.amplitude", format!("{amplitude:?}"), expected))
}

/// A fixed plate may stand on the tank's walls.
fn stands(body: &Body) -> bool {
    matches!((&body.shape, &body.motion), (Shape::Polyline { .. }, Motion::Fixed))
}

/// It may touch them, and is not beyond them.
fn check_standing_plate(scene: &Scene, [min, max]: [[f64; 2]; 2]) -> Result<(), Problem> {
    let (half, floor) = (0.5 * scene.tank.width, -scene.tank.depth);
    let beyond = 1e-9 * scene.tank.width;
    if min[0] >= -half - beyond && max[0] <= half + beyond && min[1] >= floor - beyond {
        return Ok(());
    }
    let given = format!("a plate that reaches from {:?} to {:?} m", min.map(significant), max.map(significant));
    let [half, floor] = [half, floor].map(significant);
    let expected = format!(
        "a plate between the walls at x = -{half} and {half} m that ends at the floor, y = {floor} m, or above"
    );
    Err(Problem::new("body.position", given, expected))
}

/// A thin plate (THEORY WA9) wants walls that fill it, and bends wider than its rows are deep.
fn check_plate(scene: &Scene, body: &Body) -> Result<(), Problem> {
    let Shape::Polyline { points, thickness } = &body.shape else { return Ok(()) };
    let spacing = scene.resolution.spacing;
    let rows = (2.0 * scene.water().smoothing_ratio - 1e-9).ceil();
    if *thickness >= 2.0 * rows * spacing {
        return Ok(());
    }
    let walls = scene.solver.weakly_compressible().map_or(WallModel::default(), |fluid| fluid.options.walls);
    if !matches!(walls, WallModel::Extrapolated | WallModel::MirrorPoint) {
        let expected = format!(
            "extrapolated or mirror_point: the body is a plate {} m thin, thinner than {} spacings",
            significant(*thickness),
            2.0 * rows
        );
        let given = format!("{:?}", walls).to_lowercase();
        return Err(Problem::new("fluid.walls", format!("\"{given}\""), expected));
    }
    match too_tight(points, rows * spacing - 0.5 * thickness) {
        None => Ok(()),
        Some(side) => {
            let expected = format!(
                "longer sides or gentler bends beside side {side}: {rows} rows of wall particles, {} m, turn with them",
                significant(rows * spacing)
            );
            Err(Problem::new("body.points", format!("{:?} to {:?}", points[side], points[side + 1]), expected))
        }
    }
}

fn check_thickness(scene: &Scene, body: &Body) -> Result<(), Problem> {
    if matches!(body.shape, Shape::Polyline { .. }) {
        return Ok(()); // thin where it must be (THEORY WA9)
    }
    let (spacing, thickness) = (scene.resolution.spacing, body.shape.thickness());
    let largest = thickness / THINNEST_BODY;
    match spacing <= largest || matches!(body.shape, Shape::Polyline { .. }) {
        true => Ok(()),
        false => {
            let expected = format!(
                "at most {} m: the body is {} m thin, and thinner than {THINNEST_BODY} spacings it is thinner than its \
                 walls can represent",
                significant(largest),
                significant(thickness)
            );
            Err(Problem::new("resolution.spacing", spacing, expected))
        }
    }
}

fn check_symmetric(body: &Body) -> Result<(), Problem> {
    let zero = |key: &str, value: f64| match value == 0.0 {
        true => Ok(()),
        false => Err(Problem::new(&format!("body.{key}"), value, "0 with symmetry = \"x\"")),
    };
    zero("angle_deg", body.angle_deg)?;
    zero("angular_velocity_deg_per_s", body.angular_velocity_deg_per_s)?;
    let on_axis = |key: &str, [x, y]: [f64; 2]| match x == 0.0 {
        true => Ok(()),
        false => Err(Problem::new(&format!("body.{key}"), format!("[{x}, {y}]"), "[0, ...] with symmetry = \"x\"")),
    };
    on_axis("velocity", body.velocity)?;
    on_axis("position", body.position)?;
    if !polygon::is_mirror_symmetric(&body.shape.outline()) {
        let expected = "a body symmetric about x = 0 with symmetry = \"x\"";
        return Err(Problem::new("body.points", "a lopsided body", expected));
    }
    if body.center_of_mass[0].abs() > 1e-9 * polygon::perimeter(&body.shape.outline()) {
        let given = format!("[{}, {}]", body.center_of_mass[0], body.center_of_mass[1]);
        return Err(Problem::new("body.center_of_mass", given, "[0, ...] with symmetry = \"x\""));
    }
    Ok(())
}

fn check_gauges(scene: &Scene) -> Result<(), Problem> {
    let mut names: Vec<&str> = scene.body.iter().map(|body| body.name.as_str()).collect();
    for (i, panel) in scene.body.iter().flat_map(|body| &body.panels).enumerate() {
        if names.contains(&panel.name.as_str()) {
            let expected = "a name that no other panel or body has";
            return Err(Problem::new(&format!("body.panels[{i}].name"), format!("{:?}", panel.name), expected));
        }
        names.push(&panel.name);
    }
    for (i, gauge) in scene.gauges.iter().enumerate() {
        let key = |name: &str| format!("gauges[{i}].{name}");
        if names.contains(&gauge.name.as_str()) {
            let expected = "a name that no other gauge or body has";
            return Err(Problem::new(&key("name"), format!("{:?}", gauge.name), expected));
        }
        names.push(&gauge.name);
        let given = format!("{:?}", gauge.at);
        match (gauge.on, &scene.body) {
            (GaugeFrame::Body, None) => {
                return Err(Problem::new(&key("on"), "\"body\"", "\"fixed\" in a scene without a body"));
            }
            (GaugeFrame::Body, Some(body)) => {
                let [x, y] = polygon::nearest_point(&body.shape.outline(), gauge.at);
                let distance = (x - gauge.at[0]).hypot(y - gauge.at[1]);
                if distance > scene.resolution.spacing {
                    let [x, y, away] = [x, y, distance].map(significant);
                    let expected = format!("a point on the body's outline: the nearest, [{x}, {y}], is {away} m away");
                    return Err(Problem::new(&key("at"), given, expected));
                }
            }
            (GaugeFrame::Fixed, _) => {
                check_fixed_gauge(scene, &key("at"), gauge.at)?;
                check_face_of_fixed_gauge(scene, &key("length"), gauge)?;
            }
        }
    }
    Ok(())
}

/// The height of the water is read between the walls.
fn check_levels(scene: &Scene) -> Result<(), Problem> {
    let half = 0.5 * scene.tank.width;
    let left = if scene.symmetry == Symmetry::X { 0.0 } else { -half };
    match scene.observe.level.iter().find(|x| !(left..=half).contains(*x)) {
        None => Ok(()),
        Some(x) => Err(Problem::new("observe.level", x, format!("places x from {left} to {half} m"))),
    }
}

fn check_fixed_gauge(scene: &Scene, key: &str, at: [f64; 2]) -> Result<(), Problem> {
    let tank = &scene.tank;
    let right = 0.5 * tank.width;
    let left = if scene.symmetry == Symmetry::X { 0.0 } else { -right };
    let (floor, top) = (-tank.depth, tank.height - tank.depth);
    match (left..=right).contains(&at[0]) && (floor..=top).contains(&at[1]) {
        true => Ok(()),
        false => {
            let [left, right, floor, top] = [left, right, floor, top].map(significant);
            let expected = format!("a point in the tank, x from {left} to {right} and y from {floor} to {top} m");
            Err(Problem::new(key, format!("{at:?}"), expected))
        }
    }
}

/// Only a gauge on a wall has a face to average over.
fn check_face_of_fixed_gauge(scene: &Scene, key: &str, gauge: &Gauge) -> Result<(), Problem> {
    let (tank, [x, y]) = (&scene.tank, gauge.at);
    let away = (0.5 * tank.width - x.abs()).min(y + tank.depth);
    if gauge.length == 0.0 || away <= scene.resolution.spacing {
        return Ok(());
    }
    let expected = format!("0 for a gauge in the water, {} m from the nearest wall", significant(away));
    Err(Problem::new(key, gauge.length, expected))
}

fn check_comparisons(scene: &Scene) -> Result<(), Problem> {
    let known = columns(scene).split_off(1);
    for (i, compare) in scene.compare.iter().enumerate() {
        if !known.contains(&compare.quantity) {
            let key = format!("compare[{i}].quantity");
            let expected = format!("a column of this scene's series: {}", known.join(", "));
            return Err(Problem::new(&key, format!("{:?}", compare.quantity), expected));
        }
        check_reference(i, compare)?;
    }
    Ok(())
}

/// The reference is there, and has the columns that the scene names.
fn check_reference(i: usize, compare: &Compare) -> Result<(), Problem> {
    let key = |name: &str| format!("compare[{i}].{name}");
    let wrong = |name: &str, given: &str, error: ReferenceError| {
        Problem::new(&key(name), format!("{given:?}"), format!("a table that can be used: {error}"))
    };
    let table = Table::load(&compare.reference).map_err(|e| wrong("reference", &compare.reference, e))?;
    for (name, column) in [("x", &compare.x), ("y", &compare.y)] {
        table.column(&compare.reference, column).map_err(|e| wrong(name, column, e))?;
    }
    Ok(())
}

/// The similarity solution asks for a wedge that touches the water at t = 0, keeps its speed and feels no gravity.
fn check_wedge_similarity(scene: &Scene) -> Result<(), Problem> {
    let has = |given: &str, expected: &str| {
        let expected = format!("{expected} for the similarity solution of a wedge");
        Err(Problem::new("similarity", format!("\"wedge\" {given}"), expected))
    };
    let Some(body) = &scene.body else {
        return has("without a body", "a wedge");
    };
    if !matches!(body.shape, Shape::Wedge { .. }) {
        return has(&format!("with shape = \"{}\"", body.shape.name()), "shape = \"wedge\"");
    }
    if body.motion != Motion::ConstantVelocity {
        return has("with a body that may change its speed", "motion = \"constant_velocity\"");
    }
    if scene.gravity != [0.0, 0.0] {
        return has(&format!("with gravity = {:?}", scene.gravity), "gravity = [0.0, 0.0]");
    }
    let upright = body.velocity[0] == 0.0 && body.velocity[1] < 0.0 && body.angle_deg == 0.0;
    if !upright || body.angular_velocity_deg_per_s != 0.0 {
        let given = format!("with angle_deg = {}, velocity = {:?}", body.angle_deg, body.velocity);
        return has(&given, "an upright wedge that moves straight down");
    }
    match body.position[1] == 0.0 {
        true => Ok(()),
        false => has(&format!("with the keel at y = {} m", body.position[1]), "position = \"touching\""),
    }
}
