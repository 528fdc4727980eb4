//! A body from the mobile limit particles of IPART.

use super::Particle;

/// Thickness of a body, in spacings, up to which it is a plate [-].
const PLATE: f64 = 2.0;
/// Distance from the line of its neighbours, in spacings, below which a vertex is left out [-].
const STRAIGHT: f64 = 1e-6;

/// The lines of `[body]`, and what was chosen.
pub(super) struct BodyOf {
    pub(super) is_plate: bool,
    pub(super) lines: Vec<String>,
    pub(super) notes: Vec<String>,
}

/// The body of `mobile`: a plate along their longest direction, or the polygon of their convex hull.
///
/// `origin`: the middle of the tank and the still water in the file's axes [m]; `dx`: spacing [m].
pub(super) fn body_of(mobile: &[Particle], upright: usize, origin: [f64; 2], dx: f64) -> BodyOf {
    let at = |particle: &Particle| [particle.position[0] - origin[0], particle.position[upright] - origin[1]];
    let hull = convex_hull(mobile.iter().map(at).collect(), STRAIGHT * dx);
    let count = mobile.len() as f64;
    let mean = |axis: usize| mobile.iter().map(|particle| particle.velocity[axis]).sum::<f64>() / count;
    let velocity = [mean(0), mean(upright)];
    let mut notes = vec![
        format!("{} mobile limit particles: the body; its outline runs through the outermost of them", mobile.len()),
        "mass, inertia and the body's motion have no parameter in INDAT: body.motion is to be chosen".into(),
    ];
    let [from, to] = longest(&hull);
    let thickness = width_across(&hull, from, to);
    let mut lines = vec!["name = \"body\"".to_string()];
    let is_plate = thickness < PLATE * dx;
    if is_plate {
        let plate = thickness.max(dx);
        lines.push("shape = \"polyline\"".into());
        lines.push(format!("points = [{}, {}]", point(from), point(to)));
        lines.push(format!("thickness = {plate:?}"));
        notes.push(format!("the body is a plate {plate} m thick between the ends of the mobile limit particles"));
    } else {
        lines.push("shape = \"polygon\"".into());
        lines.push(format!("points = [{}]", hull.iter().map(|at| point(*at)).collect::<Vec<_>>().join(", ")));
        notes.push("the body is the convex hull of the mobile limit particles".into());
    }
    lines.push("position = [0.0, 0.0]".into());
    if velocity == [0.0; 2] {
        lines.push("motion = \"fixed\"".into());
        notes.push("the body is at rest in IPART: body.motion = \"oscillating\" makes a wave generator of it".into());
    } else {
        lines.push("motion = \"constant_velocity\"".into());
        lines.push(format!("velocity = {}", point(velocity)));
        notes.push("the body moves in IPART: at constant velocity, or body.motion = \"free\" with body.mass".into());
    }
    BodyOf { is_plate, lines, notes }
}

fn point([x, y]: [f64; 2]) -> String {
    format!("[{x:?}, {y:?}]")
}

/// Cross product of b - a and c - a [m²].
fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Convex hull, counter-clockwise (monotone chain, Andrew 1979), without vertices that lie less than `straight` off it [m].
fn convex_hull(mut points: Vec<[f64; 2]>, straight: f64) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    let chain = |order: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut hull: Vec<[f64; 2]> = Vec::new();
        for &next in order {
            while let [.., a, b] = hull[..]
                && cross(a, b, next) <= straight * (next[0] - a[0]).hypot(next[1] - a[1])
            {
                hull.pop();
            }
            hull.push(next);
        }
        hull.pop();
        hull
    };
    let mut hull = chain(&mut points.iter());
    hull.extend(chain(&mut points.iter().rev()));
    if hull.is_empty() { points } else { hull }
}

/// The two points that are farthest from each other.
fn longest(hull: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let distance = |[a, b]: [[f64; 2]; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
    let pairs = hull.iter().flat_map(|a| hull.iter().map(move |b| [*a, *b]));
    pairs.max_by(|p, q| distance(*p).total_cmp(&distance(*q))).unwrap_or_default()
}

/// Extent across the line between two points [m].
fn width_across(hull: &[[f64; 2]], from: [f64; 2], to: [f64; 2]) -> f64 {
    let length = (to[0] - from[0]).hypot(to[1] - from[1]).max(f64::MIN_POSITIVE);
    let sides = hull.iter().map(|at| cross(from, to, *at) / length);
    let [low, high] = sides.fold([0.0_f64; 2], |[low, high], side| [low.min(side), high.max(side)]);
    high - low
}
