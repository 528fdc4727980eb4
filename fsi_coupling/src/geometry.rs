//! Shapes of bodies: a closed outline in the body's own frame, and its signed distance (parry).

use parry2d::math::Vector;
use parry2d::query::PointQuery;
use parry2d::shape::{Polyline, PolylineFlags};

use crate::body::BodyError;

/// A closed polygon, counter-clockwise, with a signed distance: positive outside, negative inside.
#[derive(Clone)]
pub struct Outline {
    vertices: Vec<[f64; 2]>,
    polyline: Polyline,
}

/// Chords approximate an arc to this share of its radius.
const ARC_TOLERANCE: f64 = 1e-5;

impl Outline {
    /// A polygon from its corners [m], in either sense of rotation.
    pub fn polygon(corners: &[[f64; 2]]) -> Result<Outline, BodyError> {
        let n = corners.len();
        if n < 3 || corners.iter().flatten().any(|c| !c.is_finite()) {
            return Err(BodyError::Outline(format!("a polygon needs at least 3 finite corners, got {n}")));
        }
        let area = signed_area(corners);
        if area.abs() < 1e-300 {
            return Err(BodyError::Outline("the polygon's corners enclose no area".into()));
        }
        let mut vertices = corners.to_vec();
        if area < 0.0 {
            vertices.reverse();
        }
        if let Some((i, j)) = self_crossing(&vertices) {
            return Err(BodyError::Outline(format!("the polygon's sides {i} and {j} cross")));
        }
        let points = vertices.iter().map(|v| Vector::new(v[0], v[1])).collect();
        let sides = (0..n as u32).map(|k| [k, (k + 1) % n as u32]).collect();
        Ok(Outline { polyline: Polyline::with_flags(points, Some(sides), PolylineFlags::ORIENTED), vertices })
    }

    /// A symmetric wedge: keel at the origin, deadrise angle β [deg], breadth between the chines [m],
    /// vertical sides of the given height above them [m].
    pub fn wedge(deadrise_deg: f64, breadth: f64, side_height: f64) -> Result<Outline, BodyError> {
        let (half, rise) = (0.5 * breadth, 0.5 * breadth * deadrise_deg.to_radians().tan());
        let top = rise + side_height;
        Outline::polygon(&[[0.0, 0.0], [half, rise], [half, top], [-half, top], [-half, rise]])
    }

    /// A section with a circular-arc bottom of radius R [m] and chord `breadth` [m]; lowest point at the
    /// origin, vertical sides above the chord [m].
    pub fn arc(radius: f64, breadth: f64, side_height: f64) -> Result<Outline, BodyError> {
        let half = 0.5 * breadth;
        if half > radius {
            return Err(BodyError::Outline(format!("a chord of {breadth} m does not fit an arc of radius {radius} m")));
        }
        let widest = (half / radius).asin();
        let pieces = 2 * (widest / (8.0 * ARC_TOLERANCE).sqrt()).ceil().max(1.0) as usize;
        let at = |k: usize| {
            let angle = widest * (2.0 * k as f64 / pieces as f64 - 1.0);
            let x = if 2 * k == pieces { 0.0 } else { radius * angle.sin() };
            [x, radius * (1.0 - angle.cos())]
        };
        let mut corners: Vec<[f64; 2]> = (0..=pieces).map(at).collect();
        let top = at(0)[1] + side_height;
        corners.extend([[half, top], [-half, top]]);
        corners.dedup();
        Outline::polygon(&corners)
    }

    /// A circle of radius R [m] about the origin.
    pub fn circle(radius: f64) -> Result<Outline, BodyError> {
        let pieces = 4 * (std::f64::consts::FRAC_PI_4 / (8.0 * ARC_TOLERANCE).sqrt()).ceil() as usize;
        let at = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / pieces as f64 - std::f64::consts::FRAC_PI_2;
            [if 2 * k == pieces || k == 0 { 0.0 } else { radius * angle.cos() }, radius * angle.sin()]
        };
        Outline::polygon(&(0..pieces).map(at).collect::<Vec<_>>())
    }

    /// A rectangle about the origin [m].
    pub fn rectangle(breadth: f64, height: f64) -> Result<Outline, BodyError> {
        let (a, b) = (0.5 * breadth, 0.5 * height);
        Outline::polygon(&[[-a, -b], [a, -b], [a, b], [-a, b]])
    }

    /// A thin plate along an open polyline [m], of the given thickness [m], half of it on either side.
    pub fn plate(points: &[[f64; 2]], thickness: f64) -> Result<Outline, BodyError> {
        if points.len() < 2 {
            return Err(BodyError::Outline(format!("a polyline needs at least 2 points, got {}", points.len())));
        }
        let offset = |side: f64| -> Vec<[f64; 2]> {
            let normals: Vec<[f64; 2]> = points.windows(2).map(|p| normal(p[0], p[1])).collect();
            let n = points.len();
            let at = |k: usize| {
                let (a, b) = (normals[k.saturating_sub(1)], normals[k.min(n - 2)]);
                let scale = 0.5 * side * thickness * 2.0 / (1.0 + a[0] * b[0] + a[1] * b[1]).max(0.1);
                let mean = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
                [points[k][0] + scale * mean[0], points[k][1] + scale * mean[1]]
            };
            (0..n).map(at).collect()
        };
        let mut corners = offset(1.0);
        corners.extend(offset(-1.0).into_iter().rev());
        Outline::polygon(&corners)
    }

    /// The corners, counter-clockwise [m].
    pub fn vertices(&self) -> &[[f64; 2]] {
        &self.vertices
    }

    /// Distance to the outline [m]: positive outside, negative inside.
    pub fn signed_distance(&self, at: [f64; 2]) -> f64 {
        self.polyline.distance_to_local_point(Vector::new(at[0], at[1]), false)
    }

    /// Enclosed area [m²].
    pub fn area(&self) -> f64 {
        signed_area(&self.vertices)
    }

    /// Lowest and highest coordinates [m]: [[x_min, y_min], [x_max, y_max]].
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        let fold = |f: fn(f64, f64) -> f64, k: usize| self.vertices.iter().map(|v| v[k]).reduce(f).unwrap_or(0.0);
        [[fold(f64::min, 0), fold(f64::min, 1)], [fold(f64::max, 0), fold(f64::max, 1)]]
    }
}

fn signed_area(v: &[[f64; 2]]) -> f64 {
    (0..v.len()).map(|k| cross(v[k], v[(k + 1) % v.len()])).sum::<f64>() * 0.5
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Unit normal to the right of a → b: outward for a counter-clockwise outline.
pub(crate) fn normal(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx.hypot(dy);
    [dy / length, -dx / length]
}

/// Two sides that are not neighbours and cross.
fn self_crossing(v: &[[f64; 2]]) -> Option<(usize, usize)> {
    let n = v.len();
    let side = |a: [f64; 2], b: [f64; 2], p: [f64; 2]| cross([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    for i in 0..n {
        for j in i + 2..n {
            if i == 0 && j == n - 1 {
                continue;
            }
            let (a, b, c, d) = (v[i], v[(i + 1) % n], v[j], v[(j + 1) % n]);
            if side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0 {
                return Some((i, j));
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_is_signed_also_for_a_concave_hull() {
        // W-shaped hull: two keels and a tunnel between them
        let hull = Outline::polygon(&[[-1.0, 0.5], [-0.5, 0.0], [0.0, 0.3], [0.5, 0.0], [1.0, 0.5], [1.0, 1.0], [-1.0, 1.0]]).unwrap();
        assert!(hull.signed_distance([0.0, 0.1]) > 0.0, "the tunnel is outside");
        assert!(hull.signed_distance([0.0, 0.6]) < 0.0);
        assert!(hull.signed_distance([-0.5, 0.1]) < 0.0, "inside the keel");
        assert!((hull.signed_distance([0.0, 2.0]) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn an_arc_is_its_circle() {
        let arc = Outline::arc(1.0, 1.2, 0.3).unwrap();
        for angle in [-0.5_f64, -0.2, 0.0, 0.3, 0.6] {
            let on = [angle.sin(), 1.0 - angle.cos()];
            assert!(arc.signed_distance(on).abs() < 2e-5, "{angle}: {}", arc.signed_distance(on));
        }
        assert!(arc.vertices().contains(&[0.0, 0.0]));
    }

    #[test]
    fn a_clockwise_polygon_is_turned_round_and_a_crossed_one_refused() {
        let square = Outline::polygon(&[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]).unwrap();
        assert!((square.area() - 1.0).abs() < 1e-15);
        assert!(square.signed_distance([0.5, 0.5]) < 0.0);
        assert!(Outline::polygon(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.5]]).is_err());
    }

    #[test]
    fn a_plate_has_its_thickness() {
        let plate = Outline::plate(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.5]], 0.1).unwrap();
        assert!((plate.signed_distance([0.4, 0.0]) + 0.05).abs() < 1e-12);
        assert!((plate.signed_distance([0.4, 0.1]) - 0.05).abs() < 1e-12);
    }
}
