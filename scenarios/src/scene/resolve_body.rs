//! The body of a scene: defaults that depend on its shape and motion, and what they exclude.

use fsi_coupling::Shape;
use fsi_coupling::geometry::polygon;
use fsi_coupling::settings::{Problem, significant};

use super::draft::Draft;
use super::resolve_panel::{check_panels, fill_panels};
use super::settings::{Axis, Body, Motion, Symmetry, placed};
use super::word::word;

/// Side height over breadth, where the scene does not say.
const SIDE_OVER_BREADTH: f64 = 0.25;

/// Smallest cosine of the angle by which a plate's middle line turns: sharper corners have no sensible mitre.
const SHARPEST_TURN: f64 = -0.5;

/// The body, complete; `None` in a scene without one.
pub(super) fn resolve_body(draft: &mut Draft, symmetry: Symmetry) -> Result<Option<Body>, Problem> {
    if !draft.is_given("body") {
        return Ok(None);
    }
    let shape = resolve_shape(draft)?;
    draft.fill("body.center_of_mass", shape.centroid());
    resolve_motion(draft, symmetry)?;
    let angle = draft.get("body.angle_deg").unwrap_or(0.0);
    let [lowest, _] = polygon::bounding_box(&placed(shape.outline(), [0.0; 2], angle));
    draft.fill("body.position", [0.0, 0.0 - lowest[1]]);
    fill_panels(draft, &shape)?;
    let body: Body = draft.read("body")?;
    word("body.name", &body.name)?;
    check_locked_directions(&body)?;
    check_panels(&body, symmetry)?;
    Ok(Some(body))
}

fn resolve_shape(draft: &mut Draft) -> Result<Shape, Problem> {
    let has_sides = draft.get("body.shape").is_some_and(|shape: String| shape == "wedge" || shape == "arc");
    if let (true, Some(breadth)) = (has_sides, draft.get::<f64>("body.breadth")) {
        draft.fill("body.side_height", SIDE_OVER_BREADTH * breadth);
    }
    let shape: Shape = draft.read("body")?;
    match &shape {
        Shape::Arc { radius, breadth, .. } if *breadth > 2.0 * radius => {
            let expected = format!("a chord of at most twice body.radius, {} m", 2.0 * radius);
            return Err(Problem::new("body.breadth", breadth, expected));
        }
        Shape::Polygon { points } => check_polygon(points)?,
        Shape::Polyline { points, .. } => check_line(points)?,
        _ => {}
    }
    check_plate_outline(&shape)?;
    Ok(shape)
}

fn check_polygon(points: &[[f64; 2]]) -> Result<(), Problem> {
    let problem = |given: String, expected: &str| Err(Problem::new("body.points", given, expected));
    if points.len() < 3 {
        return problem(format!("{} points", points.len()), "at least 3 points");
    }
    if let Some(i) = repeated(points).or_else(|| (points.first() == points.last()).then_some(0)) {
        return problem(format!("{:?} twice in a row", points[i]), "every vertex once");
    }
    if let Some((i, j)) = polygon::first_crossing(points) {
        return problem(format!("a line whose edges {i} and {j} meet"), "an outline that does not cross itself");
    }
    let area = polygon::signed_area(points);
    if area <= 0.0 {
        return problem(format!("points around {} m²", significant(area)), "counter-clockwise points");
    }
    Ok(())
}

fn check_line(points: &[[f64; 2]]) -> Result<(), Problem> {
    let problem = |given: String, expected: &str| Err(Problem::new("body.points", given, expected));
    if points.len() < 2 {
        return problem(format!("{} points", points.len()), "at least 2 points");
    }
    if let Some(i) = repeated(points) {
        return problem(format!("{:?} twice in a row", points[i]), "every vertex once");
    }
    let sharp = points.windows(3).find(|w| {
        let (a, b) = ([w[1][0] - w[0][0], w[1][1] - w[0][1]], [w[2][0] - w[1][0], w[2][1] - w[1][1]]);
        a[0] * b[0] + a[1] * b[1] < SHARPEST_TURN * a[0].hypot(a[1]) * b[0].hypot(b[1])
    });
    match sharp {
        Some(w) => problem(format!("a sharp corner at {:?}", w[1]), "corners that turn by at most 120 degrees"),
        None => Ok(()),
    }
}

fn repeated(points: &[[f64; 2]]) -> Option<usize> {
    points.windows(2).position(|w| w[0] == w[1])
}

fn check_plate_outline(shape: &Shape) -> Result<(), Problem> {
    match shape {
        Shape::Polyline { thickness, .. } if polygon::first_crossing(&shape.outline()).is_some() => {
            let expected = "a plate whose two sides do not cross: thinner, or with longer edges";
            Err(Problem::new("body.thickness", thickness, expected))
        }
        _ => Ok(()),
    }
}

fn resolve_motion(draft: &mut Draft, symmetry: Symmetry) -> Result<(), Problem> {
    let motion = draft.fill("body.motion", "free".to_string());
    if motion == "free" {
        let free = match symmetry {
            Symmetry::None => vec![Axis::X, Axis::Y, Axis::Angle],
            Symmetry::X => vec![Axis::Y],
        };
        let free = draft.fill("body.free", free);
        if !free.contains(&Axis::Angle) {
            draft.remove("body", "inertia");
        }
    }
    match draft.read("body")? {
        Motion::Free(freedom) if freedom.free.is_empty() => {
            let expected = "some of \"x\", \"y\", \"angle\", or motion = \"fixed\"";
            Err(Problem::new("body.free", "[]", expected))
        }
        Motion::Free(freedom) if symmetry == Symmetry::X && freedom.free.iter().any(|axis| *axis != Axis::Y) => {
            Err(Problem::new("body.free", format!("{:?}", freedom.free), "[\"y\"] with symmetry = \"x\""))
        }
        Motion::Free(freedom) if freedom.free.contains(&Axis::Angle) && freedom.inertia.is_none() => {
            let why = "the moment of inertia [kg m²/m] of a body that is free to rotate";
            Err(Problem::missing("body.inertia", why))
        }
        Motion::Oscillating(oscillation) if symmetry == Symmetry::X && oscillation.amplitude[0] != 0.0 => {
            let expected = "[0, ...] with symmetry = \"x\"";
            Err(Problem::new("body.amplitude", format!("{:?}", oscillation.amplitude), expected))
        }
        _ => Ok(()),
    }
}

/// A direction that cannot move has no velocity.
fn check_locked_directions(body: &Body) -> Result<(), Problem> {
    let (x, y, angle) = match &body.motion {
        Motion::Free(freedom) => (freedom.x(), freedom.y(), freedom.inertia.is_some()),
        Motion::ConstantVelocity => (true, true, true),
        Motion::Fixed | Motion::Oscillating(_) => (false, false, false),
    };
    let [vx, vy] = body.velocity;
    if (!x && vx != 0.0) || (!y && vy != 0.0) {
        let expected = "0 along every direction that body.motion and body.free lock";
        return Err(Problem::new("body.velocity", format!("{:?}", body.velocity), expected));
    }
    if !angle && body.angular_velocity_deg_per_s != 0.0 {
        let expected = "0, since body.motion and body.free lock the rotation";
        return Err(Problem::new("body.angular_velocity_deg_per_s", body.angular_velocity_deg_per_s, expected));
    }
    Ok(())
}
