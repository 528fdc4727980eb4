//! A body from the mobile limit particles of IPART.

use std::collections::BTreeMap;

use super::Particle;

/// Thickness of a body, in spacings, below which it is a plate [-].
const PLATE: f64 = 6.0;
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
    let line = middle_line(mobile.iter().map(at).collect(), longest(&hull), dx);
    let is_plate = line.thickness < PLATE * dx && line.points.len() > 1;
    let mut lines = vec!["name = \"body\"".to_string()];
    let points = |of: &[[f64; 2]]| of.iter().map(|at| point(*at)).collect::<Vec<_>>().join(", ");
    if is_plate {
        let thickness = line.thickness.max(dx);
        lines.push("shape = \"polyline\"".into());
        lines.push(format!("points = [{}]", points(&line.points)));
        lines.push(format!("thickness = {thickness:?}"));
        notes.push(format!("the body is a plate {thickness} m thick along the mobile limit particles"));
    } else {
        lines.push("shape = \"polygon\"".into());
        lines.push(format!("points = [{}]", points(&hull)));
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

/// A line through the middle of particles, and how far they lie apart across it [m].
struct MiddleLine {
    points: Vec<[f64; 2]>,
    thickness: f64,
}

/// The means of the particles in slices of a spacing along `from`–`to`, without those on a straight line.
fn middle_line(particles: Vec<[f64; 2]>, [from, to]: [[f64; 2]; 2], dx: f64) -> MiddleLine {
    let length = (to[0] - from[0]).hypot(to[1] - from[1]).max(f64::MIN_POSITIVE);
    let along = |at: [f64; 2]| ((at[0] - from[0]) * (to[0] - from[0]) + (at[1] - from[1]) * (to[1] - from[1])) / length;
    let mut slices: BTreeMap<i64, Vec<[f64; 2]>> = BTreeMap::new();
    for at in particles {
        slices.entry((along(at) / dx).round() as i64).or_default().push(at);
    }
    let across = |at: &[f64; 2]| cross(from, to, *at) / length;
    let spread = |slice: &Vec<[f64; 2]>| {
        let [low, high] =
            slice.iter().map(across).fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], s| [l.min(s), h.max(s)]);
        high - low
    };
    let thickness = slices.values().map(spread).fold(0.0, f64::max);
    let mean = |slice: &Vec<[f64; 2]>, axis: usize| slice.iter().map(|at| at[axis]).sum::<f64>() / slice.len() as f64;
    let mut points: Vec<[f64; 2]> = Vec::new();
    for slice in slices.values() {
        let next = [mean(slice, 0), mean(slice, 1)];
        if let [.., a, b] = points[..]
            && cross(a, b, next).abs() <= STRAIGHT * dx * (next[0] - a[0]).hypot(next[1] - a[1])
        {
            points.pop();
        }
        points.push(next);
    }
    MiddleLine { points, thickness }
}
