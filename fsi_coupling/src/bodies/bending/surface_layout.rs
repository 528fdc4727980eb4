//! Which part of a body's line bends, and the motion of its frame.

use std::ops::Range;

use crate::bodies::bending::surface_map::{Attachment, Nodal, SurfaceMap};
use crate::bodies::rigid_motion::RigidMotion;
use crate::geometry::outline::Outline;
use crate::geometry::polyline::Polyline;
use crate::geometry::vector::rotate;

/// A part of the line that bends.
#[derive(Clone, Debug)]
pub struct Span {
    /// Running lengths of its ends along the line [m].
    pub reach: [f64; 2],
    /// Its elements.
    pub elements: Range<usize>,
}

/// The line that the parts of a body lie along: its middle line [m], or its outline.
pub(crate) fn line_of(outline: &Outline, middle: Option<&[[f64; 2]]>) -> Polyline {
    middle.map_or_else(|| Polyline::closed(&outline.loops()[0]), |middle| Polyline::open(middle.to_vec()))
}

/// The line of a body, the parts of it that bend, and the map from the nodes to its points.
#[derive(Clone, Debug)]
pub struct SurfaceLayout {
    /// From the nodes to points.
    pub map: SurfaceMap,
    /// The line that the parts lie along [m, body's frame].
    pub line: Polyline,
    /// The parts that bend.
    pub spans: Vec<Span>,
    /// The start: of the body's frame, whose places `start.point` puts in the tank's.
    pub start: RigidMotion,
}

impl SurfaceLayout {
    /// Attachment of a point [m] with its normal [-], in the body's frame; a point below the surface moves with its foot on the
    /// surface.
    pub fn attachment(&self, foot: [f64; 2], at: [f64; 2], normal: [f64; 2]) -> Attachment {
        let (s, _) = self.line.nearest(foot);
        let (at, normal) = (self.start.point(at), rotate(normal, self.start.angle));
        match self.spans.iter().find(|span| self.line.between(s, span.reach)) {
            Some(span) => Attachment::Beam(self.map.surface.attach_among(span.elements.clone(), at, normal)),
            None => self.map.on_frame(at, normal),
        }
    }

    /// Length of the shortest element [m]; infinity without one.
    pub fn shortest(&self) -> f64 {
        let elements = self.spans.iter().flat_map(|span| span.elements.clone());
        elements.map(|element| self.map.surface.length(element)).fold(f64::INFINITY, f64::min)
    }

    /// Attachments of an open line [m, body's frame], with additional points that show how it bends.
    pub fn divided(&self, line: &[[f64; 2]]) -> Vec<Attachment> {
        let polyline = Polyline::open(line.to_vec());
        let step = self.shortest().min(polyline.length());
        let mut stops: Vec<f64> = line.iter().map(|p| polyline.nearest(*p).0).collect();
        let parts = (polyline.length() / step).ceil() as usize;
        stops.extend((0..=parts).map(|k| polyline.length() * k as f64 / parts as f64));
        stops.sort_by(f64::total_cmp);
        stops.dedup_by(|a, b| (*a - *b).abs() < 1e-6 * polyline.length());
        stops.iter().map(|s| polyline.at(*s)).map(|at| self.attachment(at, at, [0.0; 2])).collect()
    }

    /// Motion of the body's frame, about its origin, at displacements, velocities and accelerations of the nodes.
    pub fn frame(&self, displacement: Nodal, velocity: Nodal, acceleration: Nodal) -> RigidMotion {
        let node = self.map.frame;
        let ([x, y, turn], [u, v, angular_velocity], [ax, ay, angular_acceleration]) =
            (displacement[node], velocity[node], acceleration[node]);
        let about_node = RigidMotion {
            position: [self.map.reference[0] + x, self.map.reference[1] + y],
            angle: turn,
            velocity: [u, v],
            angular_velocity,
            acceleration: [ax, ay],
            angular_acceleration,
        };
        let lever_arm = [0, 1].map(|k| self.start.position[k] - self.map.reference[k]);
        RigidMotion {
            position: about_node.point(lever_arm),
            angle: self.start.angle + turn,
            velocity: about_node.point_velocity(lever_arm),
            acceleration: about_node.point_acceleration(lever_arm),
            ..about_node
        }
    }
}
