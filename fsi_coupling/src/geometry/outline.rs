//! A body's surface: closed loops of corners in the body's own frame, and the signed distance to them (parry).

use parry2d::math::Vector;
use parry2d::query::PointQuery;
use parry2d::shape::{Polyline, PolylineFlags};

use crate::geometry::error::OutlineError;
use crate::geometry::plate::Plate;
use crate::geometry::polygon;
use crate::geometry::shape::Shape;

/// Below this distance [m] the way to the nearest point has no direction.
const ON_SURFACE: f64 = 1e-9;

/// One or more closed polygons, counter-clockwise, that do not touch each other.
///
/// The signed distance is that of one oriented polyline through all of them: parry's compound shapes give a
/// wrong distance inside where parts touch.
#[derive(Clone)]
pub struct Outline {
    loops: Vec<Vec<[f64; 2]>>,
    polyline: Polyline,
    plate: Option<Plate>,
}

impl Outline {
    /// The outline of a shape.
    pub fn of(shape: &Shape) -> Result<Outline, OutlineError> {
        let outline = Outline::polygon(&shape.outline())?;
        Ok(match shape {
            Shape::Polyline { points, thickness } => Outline { plate: Some(Plate::new(points, *thickness)), ..outline },
            _ => outline,
        })
    }

    /// The plate whose outline this is, if it is one's.
    pub fn plate(&self) -> Option<&Plate> {
        self.plate.as_ref()
    }

    /// The same plate, standing on other walls: its middle line goes on for these lengths [m] beyond its first and its last
    /// corner (THEORY WA10). Nothing happens to what is not a plate.
    pub fn rooted(mut self, roots: [f64; 2]) -> Outline {
        if let Some(plate) = &mut self.plate {
            plate.roots = roots;
        }
        self
    }

    /// A polygon from its corners [m], in either sense of rotation.
    pub fn polygon(corners: &[[f64; 2]]) -> Result<Outline, OutlineError> {
        Outline::compound(&[corners.to_vec()])
    }

    /// A body of several separate polygons that move as one, such as the hulls of a catamaran [m].
    pub fn compound(parts: &[Vec<[f64; 2]>]) -> Result<Outline, OutlineError> {
        let loops = parts.iter().map(|p| simple(p)).collect::<Result<Vec<_>, _>>()?;
        if loops.is_empty() {
            return Err(OutlineError("given no polygon, expected at least one".into()));
        }
        let outline = Outline::joined(loops);
        let inside = |k: usize, v: &[f64; 2]| {
            let others = Outline::compound(&[outline.loops[k].clone()]);
            others.is_ok_and(|o| o.signed_distance(*v) <= 0.0)
        };
        for (i, part) in outline.loops.iter().enumerate() {
            for k in (0..outline.loops.len()).filter(|k| *k != i) {
                if let Some(v) = part.iter().find(|v| inside(k, v)) {
                    return Err(OutlineError(format!(
                        "given parts {i} and {k} that overlap at {v:?} m, expected parts that do not"
                    )));
                }
            }
        }
        Ok(outline)
    }

    /// Loops as they are deformed [m]: they may cross themselves, and are then inside where they run counter-clockwise round.
    pub(crate) fn deformed(loops: Vec<Vec<[f64; 2]>>) -> Option<Outline> {
        let sound = loops.iter().flatten().flatten().all(|c| c.is_finite());
        sound.then(|| Outline::joined(loops))
    }

    /// Where a loop crosses itself [m], if it does.
    pub(crate) fn crossing(&self) -> Option<[f64; 2]> {
        self.loops.iter().find_map(|l| polygon::first_crossing(l).map(|(side, _)| l[side]))
    }

    fn joined(loops: Vec<Vec<[f64; 2]>>) -> Outline {
        let (mut points, mut sides) = (Vec::new(), Vec::new());
        for part in &loops {
            let (first, n) = (points.len() as u32, part.len() as u32);
            points.extend(part.iter().map(|v| Vector::new(v[0], v[1])));
            sides.extend((0..n).map(|k| [first + k, first + (k + 1) % n]));
        }
        Outline { polyline: Polyline::with_flags(points, Some(sides), PolylineFlags::ORIENTED), loops, plate: None }
    }

    /// The loops of corners, each counter-clockwise [m].
    pub fn loops(&self) -> &[Vec<[f64; 2]>] {
        &self.loops
    }

    /// Distance to the outline [m]: positive outside, negative inside.
    pub fn signed_distance(&self, at: [f64; 2]) -> f64 {
        self.polyline.distance_to_local_point(Vector::new(at[0], at[1]), false)
    }

    /// The point of the outline nearest to `at` [m], and the unit normal there: the gradient of the distance.
    pub fn nearest(&self, at: [f64; 2]) -> ([f64; 2], [f64; 2]) {
        let found = self.polyline.project_local_point(Vector::new(at[0], at[1]), false).point;
        let side = if self.signed_distance(at) < 0.0 { 1.0 } else { -1.0 };
        let way = [side * (found.x - at[0]), side * (found.y - at[1])];
        let length = way[0].hypot(way[1]);
        let normal = if length > ON_SURFACE { way.map(|w| w / length) } else { self.gradient(at) };
        ([found.x, found.y], normal)
    }

    /// Direction in which the signed distance grows, by differences.
    fn gradient(&self, at: [f64; 2]) -> [f64; 2] {
        let d = |x: f64, y: f64| self.signed_distance([at[0] + x, at[1] + y]);
        let e = 1e3 * ON_SURFACE;
        let way = [d(e, 0.0) - d(-e, 0.0), d(0.0, e) - d(0.0, -e)];
        let length = way[0].hypot(way[1]);
        if length > 0.0 { way.map(|w| w / length) } else { [0.0, 1.0] }
    }

    /// Enclosed area [m²].
    pub fn area(&self) -> f64 {
        self.loops.iter().map(|l| polygon::signed_area(l)).sum()
    }
}

/// The same corners counter-clockwise, if they make a simple polygon.
fn simple(corners: &[[f64; 2]]) -> Result<Vec<[f64; 2]>, OutlineError> {
    let n = corners.len();
    if n < 3 {
        return Err(OutlineError(format!("given a polygon of {n} corners, expected at least 3")));
    }
    if let Some(k) = corners.iter().position(|[x, y]| !(x.is_finite() && y.is_finite())) {
        return Err(OutlineError(format!(
            "given corner {k} of a polygon at {:?} m, expected finite numbers",
            corners[k]
        )));
    }
    let area = polygon::signed_area(corners);
    if area == 0.0 {
        return Err(OutlineError("given a polygon whose corners enclose no area, expected an area above 0".into()));
    }
    if let Some((i, j)) = polygon::first_crossing(corners) {
        return Err(OutlineError(format!(
            "given a polygon whose sides {i} and {j} cross, expected sides that do not cross"
        )));
    }
    let mut corners = corners.to_vec();
    if area < 0.0 {
        corners.reverse();
    }
    Ok(corners)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_is_signed_also_for_a_concave_hull() {
        // W-shaped hull: two keels and a tunnel between them
        let corners = [[-1.0, 0.5], [-0.5, 0.0], [0.0, 0.3], [0.5, 0.0], [1.0, 0.5], [1.0, 1.0], [-1.0, 1.0]];
        let hull = Outline::polygon(&corners).unwrap();
        assert!(hull.signed_distance([0.0, 0.1]) > 0.0, "the tunnel is outside");
        assert!(hull.signed_distance([0.0, 0.6]) < 0.0);
        assert!(hull.signed_distance([-0.5, 0.1]) < 0.0, "inside the keel");
        assert!((hull.signed_distance([0.0, 2.0]) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn an_arc_is_its_circle_to_its_chords() {
        let arc = Outline::of(&Shape::Arc { radius: 1.0, breadth: 1.2, side_height: 0.3 }).unwrap();
        for angle in [-0.5_f64, -0.2, 0.0, 0.3, 0.6] {
            let on = [angle.sin(), 1.0 - angle.cos()];
            assert!(arc.signed_distance(on).abs() < 4e-5, "{angle}: {}", arc.signed_distance(on));
        }
    }

    #[test]
    fn a_clockwise_polygon_is_turned_round_and_a_crossed_one_refused() {
        let square = Outline::polygon(&[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]).unwrap();
        assert!((square.area() - 1.0).abs() < 1e-15);
        assert!(square.signed_distance([0.5, 0.5]) < 0.0);
        assert!(Outline::polygon(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]).is_err());
    }

    #[test]
    fn the_hulls_of_a_catamaran_are_one_body() {
        let hull = |x: f64| vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]];
        let body = Outline::compound(&[hull(-2.0), hull(1.0)]).unwrap();
        assert!((body.signed_distance([0.0, 0.5]) - 1.0).abs() < 1e-12, "between the hulls is outside");
        assert!((body.signed_distance([1.5, 0.4]) + 0.4).abs() < 1e-12);
        assert_eq!(body.area(), 2.0);
        assert!(Outline::compound(&[hull(0.0), hull(0.5)]).is_err(), "overlapping parts");
    }
}
