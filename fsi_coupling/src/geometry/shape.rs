//! The shapes that bodies may have, and their corners.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geometry::polygon;

/// Angle between the vertices that stand for a circular arc [rad]; chords leave the arc by R·4e-5 at most.
const ARC_STEP: f64 = std::f64::consts::PI / 180.0;

/// The closed outline of a body, in the body's own frame [m].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "snake_case")]
#[schemars(extend("x-shape-doc" = "Shape of the body; polyline is a bent plate"))]
pub enum Shape {
    /// A symmetric wedge with vertical sides; the frame's origin is the keel.
    Wedge {
        /// Angle between the bottom and the still water [deg].
        #[schemars(range(min = 4.0, max = 80.0))]
        deadrise_deg: f64,
        /// Distance from chine to chine, chord of an arc, width of a box [m].
        #[schemars(extend("exclusiveMinimum" = 0))]
        breadth: f64,
        /// Height of the vertical sides above the chines [m].
        #[schemars(range(min = 0.0), extend("x-default" = "breadth/4"))]
        side_height: f64,
    },
    /// A bottom that is an arc of a circle, with vertical sides; the frame's origin is the arc's lowest point.
    Arc {
        /// Radius of the bottom [m].
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius: f64,
        /// Chord of the arc, from chine to chine, at most twice the radius [m].
        #[schemars(extend("exclusiveMinimum" = 0))]
        breadth: f64,
        /// Height of the vertical sides above the chines [m].
        #[schemars(range(min = 0.0), extend("x-default" = "breadth/4"))]
        side_height: f64,
    },
    /// A rectangle; the frame's origin is its centre.
    Box {
        /// Width along the body's x axis [m].
        #[schemars(extend("exclusiveMinimum" = 0))]
        breadth: f64,
        /// Height along the body's y axis [m].
        #[schemars(extend("exclusiveMinimum" = 0))]
        height: f64,
    },
    /// Any simple polygon.
    Polygon {
        /// Vertices in the body's frame, shape (n, 2): a polygon's counter-clockwise, not repeated at the end, a plate's middle line
        /// [m].
        #[schemars(extend("x-default" = "required by polygon, polyline without outline"))]
        points: Vec<[f64; 2]>,
    },
    /// An open line of constant thickness: a bent plate.
    Polyline {
        /// Vertices of the plate's middle line, shape (n, 2) [m].
        #[schemars(extend("x-default" = "required by polygon, polyline without outline"))]
        points: Vec<[f64; 2]>,
        /// Thickness of the plate, half of it on each side of the line [m]. Of any size, also below the spacing (THEORY WA9); a fixed
        /// plate may stand on the tank's floor or walls.
        #[schemars(extend("exclusiveMinimum" = 0))]
        thickness: f64,
    },
}

impl Shape {
    /// Vertices of the outline in the body's frame [m], shape (n, 2), counter-clockwise.
    ///
    /// Exact but for arcs, which become chords of one degree (off by 4e-5 R at most).
    pub fn outline(&self) -> Vec<[f64; 2]> {
        match self {
            Shape::Wedge { deadrise_deg, breadth, side_height } => {
                let half = 0.5 * breadth;
                let chine = half * deadrise_deg.to_radians().tan();
                with_sides(vec![[-half, chine], [0.0, 0.0], [half, chine]], *side_height)
            }
            Shape::Arc { radius, breadth, side_height } => {
                let end = (0.5 * breadth / radius).min(1.0).asin();
                let n = (end / ARC_STEP).ceil().max(1.0) as i32;
                let at = |i: i32| end * f64::from(i) / f64::from(n);
                // R(1 − cos θ) without its cancellation.
                let height = |theta: f64| 2.0 * radius * (0.5 * theta).sin().powi(2);
                let arc = (-n..=n).map(|i| [radius * at(i).sin(), height(at(i))]);
                with_sides(arc.collect(), *side_height)
            }
            Shape::Box { breadth, height } => {
                let (x, y) = (0.5 * breadth, 0.5 * height);
                vec![[-x, -y], [x, -y], [x, y], [-x, y]]
            }
            Shape::Polygon { points } => points.clone(),
            Shape::Polyline { points, thickness } => polygon::thickened(points, *thickness),
        }
    }

    /// The `shape` key's value.
    pub fn name(&self) -> &'static str {
        match self {
            Shape::Wedge { .. } => "wedge",
            Shape::Arc { .. } => "arc",
            Shape::Box { .. } => "box",
            Shape::Polygon { .. } => "polygon",
            Shape::Polyline { .. } => "polyline",
        }
    }

    /// Enclosed area [m²].
    pub fn area(&self) -> f64 {
        polygon::signed_area(&self.outline())
    }

    /// Centroid of the enclosed area, in the body's frame [m].
    pub fn centroid(&self) -> [f64; 2] {
        polygon::centroid(&self.outline())
    }

    /// Smallest dimension of the body [m]: a plate's thickness, a polygon's thinnest web, else the smallest width of the outline in any direction.
    pub fn thickness(&self) -> f64 {
        match self {
            Shape::Polyline { thickness, .. } => *thickness,
            Shape::Polygon { points } => polygon::minimum_width(points).min(polygon::thinnest_web(points)),
            _ => polygon::minimum_width(&self.outline()),
        }
    }
}

/// Closes a bottom line, given from left to right, with vertical sides of the given height.
fn with_sides(mut bottom: Vec<[f64; 2]>, side_height: f64) -> Vec<[f64; 2]> {
    if side_height > 0.0 {
        let ([left, right], n) = ([bottom[0], bottom[bottom.len() - 1]], bottom.len());
        bottom.reserve(n + 2);
        bottom.push([right[0], right[1] + side_height]);
        bottom.push([left[0], left[1] + side_height]);
    }
    bottom
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wedge_area_and_centroid() {
        let wedge = Shape::Wedge { deadrise_deg: 45.0, breadth: 2.0, side_height: 0.0 };
        assert!((wedge.area() - 1.0).abs() < 1e-14);
        assert!((wedge.centroid()[1] - 2.0 / 3.0).abs() < 1e-14);
        assert!((wedge.thickness() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn half_circle_has_its_area_and_its_lowest_point_at_the_origin() {
        let arc = Shape::Arc { radius: 2.0, breadth: 4.0, side_height: 0.0 };
        let exact = 0.5 * std::f64::consts::PI * 4.0;
        // Chords of one degree lose δ²/6 of the area.
        assert!((arc.area() / exact - 1.0 + ARC_STEP.powi(2) / 6.0).abs() < 2e-6);
        assert!(arc.outline().contains(&[0.0, 0.0]));
    }

    #[test]
    fn thickness_of_a_plate_is_not_the_width_of_its_hull() {
        let points = vec![[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0]];
        let plate = Shape::Polyline { points, thickness: 0.02 };
        assert_eq!(plate.thickness(), 0.02);
    }
}
