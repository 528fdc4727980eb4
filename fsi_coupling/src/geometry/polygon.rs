//! Plane geometry of polygons.
//!
//! An outline is a slice of vertices `[x, y]` [m], shape (n, 2), counter-clockwise, the last vertex joined to the first.

/// Edges of the outline, `(from, to)`.
pub fn edges(outline: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> + '_ {
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).map(|(a, b)| (*a, *b))
}

fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Unit normal to the right of a → b [-]: outward for a counter-clockwise polygon.
pub fn normal(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx.hypot(dy);
    [dy / length, -dx / length]
}

/// Length of the closed line [m].
pub fn perimeter(outline: &[[f64; 2]]) -> f64 {
    edges(outline).map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1])).sum()
}

/// Enclosed area [m²], positive when counter-clockwise: A = ½ Σ (x_i y_{i+1} − x_{i+1} y_i).
pub fn signed_area(outline: &[[f64; 2]]) -> f64 {
    edges(outline).map(|(a, b)| 0.5 * (a[0] * b[1] - b[0] * a[1])).sum()
}

/// Centroid of the enclosed area [m]: Σ (a + b)(a × b) / 6A.
pub fn centroid(outline: &[[f64; 2]]) -> [f64; 2] {
    let area = signed_area(outline);
    let mut c = [0.0; 2];
    for (a, b) in edges(outline) {
        let twice = a[0] * b[1] - b[0] * a[1];
        for k in 0..2 {
            c[k] += (a[k] + b[k]) * twice / (6.0 * area);
        }
    }
    c
}

/// Corners `[min, max]` of the smallest upright rectangle around the points [m].
pub fn bounding_box(points: &[[f64; 2]]) -> [[f64; 2]; 2] {
    points.iter().fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[min, max], p| {
        [[min[0].min(p[0]), min[1].min(p[1])], [max[0].max(p[0]), max[1].max(p[1])]]
    })
}

/// Smallest distance between two parallel lines that hold all points between them [m].
///
/// One of the two lines always runs along an edge of the convex hull (Freeman & Shapira 1975).
pub fn minimum_width(points: &[[f64; 2]]) -> f64 {
    let hull = convex_hull(points);
    edges(&hull)
        .map(|(a, b)| {
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            hull.iter().fold(0.0_f64, |far, c| far.max(cross(a, b, *c) / length))
        })
        .fold(f64::INFINITY, f64::min)
}

/// Least way along an outline between both sides of a web, over its thickness [-]: beside a corner of 19° and more the way is shorter.
const AROUND_WEB: f64 = 6.0;

/// Smallest distance from the middle of a side, straight into the polygon, to a side that is not its neighbour [m]: the thickness of its
/// thinnest fin or web, corners apart; infinite for a triangle.
pub fn thinnest_web(outline: &[[f64; 2]]) -> f64 {
    let sides: Vec<_> = edges(outline).collect();
    let n = sides.len();
    let length = |k: usize| (sides[k].1[0] - sides[k].0[0]).hypot(sides[k].1[1] - sides[k].0[1]);
    let starts: Vec<f64> =
        (0..=n).scan(0.0, |s, k| Some(std::mem::replace(s, *s + if k < n { length(k) } else { 0.0 }))).collect();
    let mut thinnest = f64::INFINITY;
    for (i, (a, b)) in sides.iter().enumerate() {
        let (inward, middle) = (normal(*a, *b).map(|x| -x), [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
        for (j, (c, d)) in sides.iter().enumerate() {
            if (i + n - j) % n <= 1 || (j + n - i) % n <= 1 {
                continue;
            }
            let (u, w) = ([d[0] - c[0], d[1] - c[1]], [c[0] - middle[0], c[1] - middle[1]]);
            let cross = inward[0] * u[1] - inward[1] * u[0];
            let (along, share) = ((w[0] * u[1] - w[1] * u[0]) / cross, (w[0] * inward[1] - w[1] * inward[0]) / cross);
            let way = (starts[i] + 0.5 * length(i) - starts[j] - share * length(j)).abs();
            let is_web = way.min(starts[n] - way) > AROUND_WEB * along;
            if along > 0.0 && (0.0..=1.0).contains(&share) && is_web {
                thinnest = thinnest.min(along);
            }
        }
    }
    thinnest
}

/// Counter-clockwise convex hull by the monotone chain (Andrew 1979).
fn convex_hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    let half_hull = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut hull: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while hull.len() >= 2 && cross(hull[hull.len() - 2], hull[hull.len() - 1], p) <= 0.0 {
                hull.pop();
            }
            hull.push(p);
        }
        hull.pop();
        hull
    };
    let mut hull = half_hull(&mut sorted.iter().copied());
    hull.extend(half_hull(&mut sorted.iter().rev().copied()));
    hull
}

/// The first two edges, by number, that touch although they are not neighbours.
pub fn first_crossing(outline: &[[f64; 2]]) -> Option<(usize, usize)> {
    let edges: Vec<_> = edges(outline).collect();
    let n = edges.len();
    for i in 0..n {
        for j in i + 2..n {
            let neighbours = i == 0 && j == n - 1;
            if !neighbours && segments_touch(edges[i], edges[j]) {
                return Some((i, j));
            }
        }
    }
    None
}

fn segments_touch((a, b): ([f64; 2], [f64; 2]), (c, d): ([f64; 2], [f64; 2])) -> bool {
    let boxes_meet = (0..2).all(|k| a[k].min(b[k]) <= c[k].max(d[k]) && c[k].min(d[k]) <= a[k].max(b[k]));
    boxes_meet && cross(a, b, c) * cross(a, b, d) <= 0.0 && cross(c, d, a) * cross(c, d, b) <= 0.0
}

/// The point of the outline nearest to `p` [m].
pub fn nearest_point(outline: &[[f64; 2]], p: [f64; 2]) -> [f64; 2] {
    let distance = |q: &[f64; 2]| (q[0] - p[0]).hypot(q[1] - p[1]);
    edges(outline)
        .map(|(a, b)| {
            let (ux, uy) = (b[0] - a[0], b[1] - a[1]);
            let along = (p[0] - a[0]) * ux + (p[1] - a[1]) * uy;
            let s = (along / (ux * ux + uy * uy)).clamp(0.0, 1.0);
            [a[0] + s * ux, a[1] + s * uy]
        })
        .min_by(|p, q| distance(p).total_cmp(&distance(q)))
        .expect("an outline has edges")
}

/// True where every vertex has its mirror image in x = 0, to 1e-9 of the size.
pub fn is_mirror_symmetric(outline: &[[f64; 2]]) -> bool {
    let [min, max] = bounding_box(outline);
    let close = 1e-9 * (max[0] - min[0]).hypot(max[1] - min[1]);
    outline.iter().all(|p| outline.iter().any(|q| (p[0] + q[0]).abs() <= close && (p[1] - q[1]).abs() <= close))
}

/// The outline of a line of constant thickness: the line shifted to both sides by half of it, corners mitred.
///
/// At a corner that turns by θ the mitre is 1/cos(θ/2) times longer than the half thickness.
pub fn thickened(line: &[[f64; 2]], thickness: f64) -> Vec<[f64; 2]> {
    let normals: Vec<[f64; 2]> = line
        .windows(2)
        .map(|w| {
            let (ux, uy) = (w[1][0] - w[0][0], w[1][1] - w[0][1]);
            let length = ux.hypot(uy);
            [-uy / length, ux / length]
        })
        .collect();
    let offset = |i: usize, side: f64| {
        let before = normals[i.saturating_sub(1)];
        let after = normals[i.min(normals.len() - 1)];
        let stretch = 1.0 + before[0] * after[0] + before[1] * after[1];
        let m = [(before[0] + after[0]) / stretch, (before[1] + after[1]) / stretch];
        let d = 0.5 * side * thickness;
        [line[i][0] + d * m[0], line[i][1] + d * m[1]]
    };
    let right = (0..line.len()).map(|i| offset(i, -1.0));
    let left = (0..line.len()).rev().map(|i| offset(i, 1.0));
    right.chain(left).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECTANGLE: [[f64; 2]; 4] = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [0.0, 1.0]];

    #[test]
    fn rectangle_measures() {
        assert_eq!(signed_area(&RECTANGLE), 4.0);
        assert_eq!(perimeter(&RECTANGLE), 10.0);
        assert_eq!(centroid(&RECTANGLE), [2.0, 0.5]);
        assert_eq!(minimum_width(&RECTANGLE), 1.0);
        assert_eq!(nearest_point(&RECTANGLE, [1.5, -2.0]), [1.5, 0.0]);
    }

    #[test]
    fn minimum_width_is_the_thickness_of_a_tilted_plate() {
        let a = 30.0_f64.to_radians();
        let tilted = RECTANGLE.map(|[x, y]| [x * a.cos() - y * a.sin(), x * a.sin() + y * a.cos()]);
        assert!((minimum_width(&tilted) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_fin_under_a_hull_is_its_thinnest_web() {
        let fin = [
            [-0.2, 0.0],
            [-0.005, 0.0],
            [-0.005, -0.15],
            [0.005, -0.15],
            [0.005, 0.0],
            [0.2, 0.0],
            [0.2, 0.2],
            [-0.2, 0.2],
        ];
        assert!((thinnest_web(&fin) - 0.01).abs() < 1e-15);
        assert_eq!(thinnest_web(&RECTANGLE), f64::INFINITY);
        // the corner between a deck and a side of many points is no web
        let deck = |n: usize| {
            let side = |k: usize| [0.5 + 0.5 * k as f64 / n as f64, 0.4 * k as f64 / n as f64];
            let right: Vec<[f64; 2]> = (0..=n).map(side).collect();
            let left = right.iter().rev().map(|[x, y]| [-x, *y]);
            [right.clone(), left.collect()].concat()
        };
        assert!(thinnest_web(&deck(200)) > 0.39, "{}", thinnest_web(&deck(200)));
    }

    #[test]
    fn bow_tie_crosses_itself_and_rectangle_does_not() {
        let bow_tie = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(first_crossing(&bow_tie), Some((0, 2)));
        assert_eq!(first_crossing(&RECTANGLE), None);
    }

    #[test]
    fn thickened_line_keeps_length_times_thickness() {
        let bent = [[-1.0, 0.5], [0.0, 0.0], [1.0, 0.5]];
        let plate = thickened(&bent, 0.1);
        assert!((signed_area(&plate) - 0.1 * 2.0 * 1.25_f64.sqrt()).abs() < 1e-14);
        assert!(is_mirror_symmetric(&plate));
        assert_eq!(first_crossing(&plate), None);
    }
}
