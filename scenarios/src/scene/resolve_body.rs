//! The body of a scene, from as written to as run.

use super::file::{Axis, BodyFile, MotionName, ShapeName};
use super::model::{Body, Freedom, Motion, Oscillation, Symmetry};
use super::problem::{Problem, not_negative, positive, required, significant, within, word};
use super::resolve_panel::resolve_panels;
use fsi_coupling::Shape;
use fsi_coupling::geometry::polygon;

/// Side height over breadth, where the scene does not say.
const SIDE_OVER_BREADTH: f64 = 0.25;

/// Smallest cosine of the angle by which a plate's middle line turns: sharper corners have no sensible mitre.
const SHARPEST_TURN: f64 = -0.5;

pub(super) fn resolve_body(mut file: BodyFile, symmetry: Symmetry, spacing: Option<f64>) -> Result<Body, Problem> {
    let panels = std::mem::take(&mut file.panels);
    let shape = resolve_shape(&file)?;
    let motion = resolve_motion(&file, symmetry)?;
    refuse_other_motions_keys(&file)?;
    let angle_deg = file.angle_deg.unwrap_or(0.0);
    let name = word("body.name", file.name.unwrap_or_else(|| "body".to_string()))?;
    let mut body = Body {
        name,
        motion,
        center_of_mass: file.center_of_mass.unwrap_or_else(|| shape.centroid()),
        velocity: file.velocity.unwrap_or([0.0, 0.0]),
        angular_velocity_deg_per_s: file.angular_velocity_deg_per_s.unwrap_or(0.0),
        position: [0.0, 0.0],
        angle_deg,
        shape,
        damping: [0.0; 2],
        panels: Vec::new(),
    };
    body.position = file.position.unwrap_or_else(|| {
        let [lowest, _] = polygon::bounding_box(&body.placed_outline());
        [0.0, 0.0 - lowest[1]]
    });
    check_locked_directions(&body)?;
    body.panels = resolve_panels(panels, &body, symmetry, spacing)?;
    if let Some(damping) = file.damping {
        if body.panels.is_empty() && damping != [0.0; 2] {
            return Err(Problem::new("body.damping", format!("{damping:?}"), "only with [[body.panels]]"));
        }
        for (k, value) in damping.iter().enumerate() {
            not_negative(&format!("body.damping[{k}]"), *value)?;
        }
        body.damping = damping;
    }
    Ok(body)
}

fn resolve_shape(file: &BodyFile) -> Result<Shape, Problem> {
    let name = required("body.shape", file.shape, "wedge, arc, box, polygon or polyline")?;
    let length = |key: &str, value: Option<f64>| positive(key, required(key, value, "a length [m]")?);
    let breadth = || length("body.breadth", file.breadth);
    let side_height =
        |breadth: f64| not_negative("body.side_height", file.side_height.unwrap_or(SIDE_OVER_BREADTH * breadth));
    let points = || required("body.points", file.points.clone(), "vertices [[x, y], ...] [m]");
    let shape = match name {
        ShapeName::Wedge => {
            let angle = required("body.deadrise_deg", file.deadrise_deg, "the deadrise [deg]")?;
            Shape::Wedge {
                deadrise_deg: within("body.deadrise_deg", angle, 4.0..=80.0)?,
                breadth: breadth()?,
                side_height: side_height(breadth()?)?,
            }
        }
        ShapeName::Arc => {
            let (radius, breadth) = (length("body.radius", file.radius)?, breadth()?);
            if breadth > 2.0 * radius {
                let expected = format!("a chord of at most twice body.radius, {} m", 2.0 * radius);
                return Err(Problem::new("body.breadth", breadth, expected));
            }
            Shape::Arc { radius, breadth, side_height: side_height(breadth)? }
        }
        ShapeName::Box => Shape::Box { breadth: breadth()?, height: length("body.height", file.height)? },
        ShapeName::Polygon => Shape::Polygon { points: simple_polygon(points()?)? },
        ShapeName::Polyline => {
            Shape::Polyline { points: smooth_line(points()?)?, thickness: length("body.thickness", file.thickness)? }
        }
    };
    refuse_other_shapes_keys(file, &shape)?;
    check_plate_outline(&shape)?;
    Ok(shape)
}

/// A key that the shape does not use is a misunderstanding.
fn refuse_other_shapes_keys(file: &BodyFile, shape: &Shape) -> Result<(), Problem> {
    let used: &[&str] = match shape {
        Shape::Wedge { .. } => &["deadrise_deg", "breadth", "side_height"],
        Shape::Arc { .. } => &["radius", "breadth", "side_height"],
        Shape::Box { .. } => &["breadth", "height"],
        Shape::Polygon { .. } => &["points"],
        Shape::Polyline { .. } => &["points", "thickness"],
    };
    let given = [
        ("deadrise_deg", file.deadrise_deg),
        ("breadth", file.breadth),
        ("side_height", file.side_height),
        ("radius", file.radius),
        ("height", file.height),
        ("thickness", file.thickness),
        ("points", file.points.as_ref().map(|points| points.len() as f64)),
    ];
    let stranger = given.iter().find(|(key, value)| value.is_some() && !used.contains(key));
    match stranger {
        None => Ok(()),
        Some((key, _)) => {
            let expected = format!("only {} with shape = \"{}\"", used.join(", "), shape.name());
            Err(Problem::new(&format!("body.{key}"), "(given)", expected))
        }
    }
}

fn simple_polygon(points: Vec<[f64; 2]>) -> Result<Vec<[f64; 2]>, Problem> {
    let problem = |given: String, expected: &str| Err(Problem::new("body.points", given, expected));
    if points.len() < 3 {
        return problem(format!("{} points", points.len()), "at least 3 points");
    }
    if let Some(i) = repeated(&points).or_else(|| (points.first() == points.last()).then_some(0)) {
        return problem(format!("{:?} twice in a row", points[i]), "every vertex once");
    }
    if let Some((i, j)) = polygon::first_crossing(&points) {
        return problem(format!("a line whose edges {i} and {j} meet"), "an outline that does not cross itself");
    }
    let area = polygon::signed_area(&points);
    if area <= 0.0 {
        return problem(format!("points around {} m²", significant(area)), "counter-clockwise points");
    }
    Ok(points)
}

fn smooth_line(points: Vec<[f64; 2]>) -> Result<Vec<[f64; 2]>, Problem> {
    let problem = |given: String, expected: &str| Err(Problem::new("body.points", given, expected));
    if points.len() < 2 {
        return problem(format!("{} points", points.len()), "at least 2 points");
    }
    if let Some(i) = repeated(&points) {
        return problem(format!("{:?} twice in a row", points[i]), "every vertex once");
    }
    let sharp = points.windows(3).find(|w| {
        let (a, b) = ([w[1][0] - w[0][0], w[1][1] - w[0][1]], [w[2][0] - w[1][0], w[2][1] - w[1][1]]);
        a[0] * b[0] + a[1] * b[1] < SHARPEST_TURN * a[0].hypot(a[1]) * b[0].hypot(b[1])
    });
    match sharp {
        Some(w) => problem(format!("a sharp corner at {:?}", w[1]), "corners that turn by at most 120 degrees"),
        None => Ok(points),
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

fn resolve_motion(file: &BodyFile, symmetry: Symmetry) -> Result<Motion, Problem> {
    match file.motion.unwrap_or_default() {
        MotionName::Fixed => Ok(Motion::Fixed),
        MotionName::ConstantVelocity => Ok(Motion::ConstantVelocity),
        MotionName::Oscillating => {
            let amplitude = required("body.amplitude", file.amplitude, "the amplitude [x, y] [m] of the motion")?;
            if symmetry == Symmetry::X && amplitude[0] != 0.0 {
                let expected = "[0, ...] with symmetry = \"x\"";
                return Err(Problem::new("body.amplitude", format!("{amplitude:?}"), expected));
            }
            let period = required("body.period", file.period, "the period [s] of the motion")?;
            Ok(Motion::Oscillating(Oscillation { amplitude, period: positive("body.period", period)? }))
        }
        MotionName::Free => {
            let free = match (&file.free, symmetry) {
                (Some(axes), _) => axes.clone(),
                (None, Symmetry::None) => vec![Axis::X, Axis::Y, Axis::Angle],
                (None, Symmetry::X) => vec![Axis::Y],
            };
            if free.is_empty() {
                let expected = "some of \"x\", \"y\", \"angle\", or motion = \"fixed\"";
                return Err(Problem::new("body.free", "[]", expected));
            }
            if symmetry == Symmetry::X && free.iter().any(|axis| *axis != Axis::Y) {
                return Err(Problem::new("body.free", format!("{free:?}"), "[\"y\"] with symmetry = \"x\""));
            }
            let mass = required("body.mass", file.mass, "the mass of the free body [kg/m]")?;
            let why = "the moment of inertia [kg m^2/m] of a body that is free to rotate";
            let inertia = || positive("body.inertia", required("body.inertia", file.inertia, why)?);
            Ok(Motion::Free(Freedom {
                mass: positive("body.mass", mass)?,
                x: free.contains(&Axis::X),
                y: free.contains(&Axis::Y),
                inertia: free.contains(&Axis::Angle).then(inertia).transpose()?,
            }))
        }
    }
}

/// A motion to and fro has an amplitude and a period, and no other motion has.
fn refuse_other_motions_keys(file: &BodyFile) -> Result<(), Problem> {
    if file.motion == Some(MotionName::Oscillating) {
        return Ok(());
    }
    let given = [("amplitude", file.amplitude.is_some()), ("period", file.period.is_some())];
    match given.iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((key, _)) => Err(Problem::new(&format!("body.{key}"), "(given)", "only with motion = \"oscillating\"")),
    }
}

/// A direction that cannot move has no velocity.
fn check_locked_directions(body: &Body) -> Result<(), Problem> {
    let (x, y, angle) = match &body.motion {
        Motion::Free(freedom) => (freedom.x, freedom.y, freedom.inertia.is_some()),
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
