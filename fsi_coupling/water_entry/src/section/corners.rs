//! The corners of a bottom: slopes, areas, straight lines, dents, hulls.

use super::super::curve::Piece;

/// Depth of a dent over the breadth up to which a bottom counts as convex: points are rounded [-].
const DENT: f64 = 1e-4;
/// Largest turn at a corner that is none [rad].
const ON_A_LINE: f64 = 1e-9;
/// Largest turn between two corners of a curve [rad].
const CURVE_TURN: f64 = std::f64::consts::PI / 180.0;

/// Corners along a curve, with few degrees between them.
pub(super) fn corners_of(curve: &[Piece]) -> Vec<[f64; 2]> {
    let mut corners = vec![[0.0, 0.0]];
    for piece in curve {
        let count = ((piece.curvature * piece.length).abs() / CURVE_TURN).ceil().max(1.0);
        let at = (1..=count as usize).map(|k| piece.at(piece.length * k as f64 / count)[0]);
        corners.extend(at.map(|z| [z.re, z.im]));
    }
    corners
}

/// Area between the heights of two corners [m²], both halves, up to a draught.
pub(super) fn area_between([x0, y0]: [f64; 2], [x1, y1]: [f64; 2], draught: f64) -> f64 {
    let top = draught.min(y1);
    let x = if y1 > y0 { x0 + (x1 - x0) * (top - y0) / (y1 - y0) } else { x1 };
    (x0 + x) * (top - y0)
}

/// Area below the level of each corner [m²], both halves.
pub(super) fn areas_of(corners: &[[f64; 2]]) -> Vec<f64> {
    let mut area = 0.0;
    let mut add = |w: &[[f64; 2]]| {
        area += area_between(w[0], w[1], w[1][1]);
        area
    };
    std::iter::once(0.0).chain(corners.windows(2).map(&mut add)).collect()
}

/// Slopes df/dx between corners [-].
pub(super) fn slopes_of(corners: &[[f64; 2]]) -> Vec<f64> {
    corners.windows(2).map(|w| (w[1][1] - w[0][1]) / (w[1][0] - w[0][0])).collect()
}

/// Without the corners on a straight line between their neighbours; a bottom that is straight to the digits of its points is one face.
pub(super) fn straightened(corners: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let (first, last) = (corners[0], corners[corners.len() - 1]);
    let [breadth, height] = sub(last, first);
    let off = |corner: &[f64; 2]| {
        let [x, y] = sub(*corner, first);
        (y - x * height / breadth).abs()
    };
    if corners.len() > 1 && corners.iter().all(|corner| off(corner) <= DENT * 2.0 * breadth.abs()) {
        return vec![first, last];
    }
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for next in corners {
        if let [.., before, corner] = kept[..] {
            let ([ax, ay], [bx, by]) = (sub(corner, before), sub(next, corner));
            if (ax * by - ay * bx).abs() < ON_A_LINE * ax.hypot(ay) * bx.hypot(by) {
                kept.pop();
            }
        }
        kept.push(next);
    }
    kept
}

/// The corners of a convex bottom as they are; of one that is convex to the digits of its points, those of its convex hull; of another its
/// corners, and the place and depth of its hollow [m].
pub(super) fn without_dents(corners: Vec<[f64; 2]>) -> (Vec<[f64; 2]>, Option<[f64; 2]>) {
    if slopes_of(&corners).windows(2).all(|w| w[1] >= w[0] - 1e-9) {
        return (corners, None);
    }
    let hull = hull_of(&corners);
    let height = |x: f64| {
        let k = hull.partition_point(|c| c[0] < x).clamp(1, hull.len() - 1);
        let ([x0, y0], [x1, y1]) = (hull[k - 1], hull[k]);
        y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    };
    let dents = corners.iter().map(|[x, y]| [*x, y - height(*x)]);
    let deepest = dents.fold([0.0, 0.0], |most, dent| if dent[1] > most[1] { dent } else { most });
    match deepest[1] > DENT * 2.0 * corners[corners.len() - 1][0] {
        true => (corners, Some(deepest)),
        false => (hull, None),
    }
}

/// The corners of the convex hull seen from below.
pub(super) fn hull_of(corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut hull: Vec<[f64; 2]> = Vec::new();
    for corner in corners {
        while let [.., a, b] = hull[..]
            && (b[0] - a[0]) * (corner[1] - a[1]) <= (corner[0] - a[0]) * (b[1] - a[1])
        {
            hull.pop();
        }
        hull.push(*corner);
    }
    hull
}

/// a − b.
fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Lowest place [m] of an outline that is farther than `width` [m] from x = `x0`; infinite without one.
pub(super) fn lowest_beyond(points: &[[f64; 2]], x0: f64, width: f64) -> f64 {
    let beyond = |p: &[f64; 2]| (p[0] - x0).abs() > width;
    let sides = points.iter().zip(points.iter().cycle().skip(1)).filter(|(a, b)| beyond(a) || beyond(b));
    let lowest_of = |(a, b): (&[f64; 2], &[f64; 2])| {
        let at = |x: f64| {
            Some((x - a[0]) / (b[0] - a[0])).filter(|t| (0.0..=1.0).contains(t)).map(|t| a[1] + t * (b[1] - a[1]))
        };
        let ends = [a, b].into_iter().filter(|p| beyond(p)).map(|p| p[1]);
        ends.chain([x0 - width, x0 + width].into_iter().filter_map(at)).fold(f64::INFINITY, f64::min)
    };
    sides.map(lowest_of).fold(f64::INFINITY, f64::min)
}
