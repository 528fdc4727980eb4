//! Where solids touch (THEORY CO37).

use crate::bodies::body::Body;
use crate::bodies::state::Solid;
use crate::coupling::error::CouplingError;
use crate::coupling::placed_bodies::Member;
use crate::geometry::polygon::{bounding_box, edges, normal};
use crate::geometry::vector::{cross, dot, sub};

/// A point at which solids a and b push each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Indices of a and b.
    pub solids: [usize; 2],
    /// The point [m].
    pub at: [f64; 2],
    /// Unit normal from a to b [-].
    pub normal: [f64; 2],
    /// How far b is closer to the surface of a than the distance of touch [m].
    pub depth: f64,
}

/// Corners of a body where it is now, with their bounding box [m]; of a symmetric half those at x ≥ 0.
struct Corners {
    points: Vec<[f64; 2]>,
    bounds: [[f64; 2]; 2],
    convex: bool,
}

/// The direction in which two convex outlines overlap least.
struct Separation {
    /// The face that it is normal to [m], and its normal [-].
    face: [[f64; 2]; 2],
    normal: [f64; 2],
    /// Overlap; negative where there is a gap [m].
    depth: f64,
}

impl Corners {
    fn of(body: &dyn Body, half: bool) -> Option<Corners> {
        let (outline, motion) = (body.outline()?, body.motion()?);
        let placed = |corners: &[[f64; 2]]| corners.iter().map(|corner| motion.point(*corner)).collect::<Vec<_>>();
        let all: Vec<Vec<[f64; 2]>> = outline.loops().iter().map(|corners| placed(corners)).collect();
        let convex = !half && all.len() == 1 && is_convex(&all[0]);
        let points: Vec<[f64; 2]> = all.into_iter().flatten().filter(|at| !half || at[0] >= 0.0).collect();
        (!points.is_empty()).then(|| Corners { bounds: bounding_box(&points), points, convex })
    }

    fn may_meet(&self, other: &Corners, gap: f64) -> bool {
        let ([low, high], [other_low, other_high]) = (self.bounds, other.bounds);
        (0..2).all(|k| low[k] <= other_high[k] + gap && other_low[k] <= high[k] + gap)
    }

    /// The face of these corners beyond which the others reach least deep.
    fn separation(&self, other: &Corners) -> Option<Separation> {
        let of = |(a, b): ([f64; 2], [f64; 2])| {
            let normal = normal(a, b);
            let nearest = other.points.iter().map(|p| dot(sub(*p, a), normal)).fold(f64::INFINITY, f64::min);
            Separation { face: [a, b], normal, depth: -nearest }
        };
        edges(&self.points).map(of).min_by(|a, b| a.depth.total_cmp(&b.depth))
    }
}

/// CO37: all touches at most `gap` [m] from a surface, in the order of the bodies. `apart` says which pairs do not touch: those that a joint holds. A pair that links cannot
/// hold is an error where a corner is more than `tolerance` [m] behind a surface.
pub(super) fn touches(
    members: &[Member],
    solids: &[Option<Solid>],
    [gap, tolerance]: [f64; 2],
    time: f64,
    apart: impl Fn(usize, usize) -> bool,
) -> Result<Vec<Touch>, CouplingError> {
    let half = solids.iter().flatten().any(|solid| solid.halves > 1.0);
    let corners: Vec<Option<Corners>> = members.iter().map(|m| Corners::of(m.body.as_ref(), half)).collect();
    let mut found = Vec::new();
    for (a, b) in (0..members.len()).flat_map(|b| (0..b).map(move |a| (a, b))) {
        let pair = corners[a].as_ref().zip(corners[b].as_ref());
        if apart(a, b) || pair.is_some_and(|(of_a, of_b)| !of_a.may_meet(of_b, gap)) {
            continue;
        }
        let held = |solid: &Solid| solid.inverse_mass == [0.0; 3];
        let linked = solids[a].zip(solids[b]).is_some_and(|(a, b)| !(held(&a) && held(&b)));
        match pair.filter(|(of_a, of_b)| of_a.convex && of_b.convex) {
            Some(pair) if linked => found.extend(between_convex([a, b], pair, gap)),
            _ => {
                for [wall, owner] in [[a, b], [b, a]] {
                    let of_owner = match &corners[owner] {
                        Some(corners) => &corners.points,
                        None if linked && corners[wall].is_some() => &members[owner].body.rims(),
                        None => continue,
                    };
                    let behind = behind(members, [wall, owner], of_owner, if linked { gap } else { 0.0 });
                    if linked {
                        found.extend(behind);
                    } else if let Some(Touch { at: [x, y], .. }) = behind.into_iter().find(|t| t.depth > tolerance) {
                        let [wall, body] = [wall, owner].map(|k| members[k].body.name().to_string());
                        return Err(CouplingError::Collision { body, wall, x, y, time });
                    }
                }
            }
        }
    }
    Ok(found)
}

/// Corners of a body at most `gap` [m] outside the surface of a wall, which pushes along its own normal there.
fn behind(members: &[Member], solids: [usize; 2], corners: &[[f64; 2]], gap: f64) -> Vec<Touch> {
    let wall = members[solids[0]].body.as_ref();
    let touch = |&at: &[f64; 2]| {
        let (distance, surface) = wall.met_by_solid(at);
        (gap >= distance).then_some(Touch { solids, at, normal: surface.normal, depth: gap - distance })
    };
    corners.iter().filter_map(touch).collect()
}

/// Touches of two convex outlines: along the normal of the face that separates them best (separating axes; Gottschalk et al. 1996), at the
/// corners of the other body beyond this face and at the face's ends inside the other.
fn between_convex([a, b]: [usize; 2], (of_a, of_b): (&Corners, &Corners), gap: f64) -> Vec<Touch> {
    let Some((face_a, face_b)) = of_a.separation(of_b).zip(of_b.separation(of_a)) else { return Vec::new() };
    let (solids, of_owner, Separation { face, normal, depth }) =
        if face_b.depth < face_a.depth { ([b, a], of_a, face_b) } else { ([a, b], of_b, face_a) };
    if depth < -gap {
        return Vec::new();
    }
    let along = sub(face[1], face[0]);
    let length2 = dot(along, along);
    let below = |at: [f64; 2]| -dot(sub(at, face[0]), normal);
    let over_face = |at: [f64; 2]| (0.0..=length2).contains(&dot(sub(at, face[0]), along));
    let corners = of_owner.points.iter().copied().filter(|at| below(*at) >= -gap && over_face(*at));
    let ends = face.into_iter().filter(|at| is_inside(&of_owner.points, *at, gap));
    let touch = |at| Touch { solids, at, normal, depth: depth + gap };
    let found: Vec<Touch> = corners.chain(ends).map(touch).collect();
    if !found.is_empty() {
        return found;
    }
    let deepest = of_owner.points.iter().copied().max_by(|p, q| below(*p).total_cmp(&below(*q)));
    deepest.map(touch).into_iter().collect()
}

fn is_convex(corners: &[[f64; 2]]) -> bool {
    let count = corners.len();
    let turn = |k: usize| {
        let [a, b, c] = [0, 1, 2].map(|step| corners[(k + step) % count]);
        cross(sub(b, a), sub(c, b))
    };
    (0..count).all(|k| turn(k) >= 0.0)
}

/// Whether a point is less than `gap` [m] outside all sides of a convex outline, counter-clockwise.
fn is_inside(corners: &[[f64; 2]], at: [f64; 2], gap: f64) -> bool {
    edges(corners).all(|(a, b)| dot(sub(at, a), normal(a, b)) < gap)
}
