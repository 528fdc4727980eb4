//! The deformed outline of a flexible body, for contact, pictures and the count of penetrating particles.

use crate::bodies::bending::surface_layout::SurfaceLayout;
use crate::bodies::bending::surface_map::{Attachment, Nodal, SurfaceMap};
use crate::bodies::rigid_motion::RigidMotion;
use crate::geometry::outline::Outline;
use crate::geometry::polyline::Polyline;

/// A corner of the outline and its attachment; on the left half of a symmetric body that of its mirror image.
struct Corner {
    attachment: Attachment,
    image: bool,
}

/// Corners close enough to show the panels' bending.
pub(crate) struct DeformedOutline {
    loops: Vec<Vec<Corner>>,
}

impl DeformedOutline {
    /// Of an outline [m, body's frame]; with `half` its left half is the mirror image of the right one.
    pub fn new(outline: &Outline, layout: &SurfaceLayout, half: bool) -> DeformedOutline {
        let element = layout.shortest();
        let corner = |at: [f64; 2]| {
            let image = half && at[0] < 0.0;
            let at = if image { [-at[0], at[1]] } else { at };
            Corner { attachment: layout.attachment(at, at, [0.0; 2]), image }
        };
        let divided = |corners: &Vec<[f64; 2]>| {
            let n = corners.len();
            let points = (0..n).flat_map(|k| {
                let (a, b) = (corners[k], corners[(k + 1) % n]);
                let parts = ((b[0] - a[0]).hypot(b[1] - a[1]) / element).ceil().max(1.0) as usize;
                (0..parts).map(move |i| [0, 1].map(|axis| a[axis] + i as f64 / parts as f64 * (b[axis] - a[axis])))
            });
            // between the corners themselves only places that bend
            let bends = |at: &[f64; 2]| corners.contains(at) || matches!(corner(*at).attachment, Attachment::Beam(_));
            points.filter(bends).map(corner).collect()
        };
        DeformedOutline { loops: outline.loops().iter().map(divided).collect() }
    }

    /// The outline in the body's frame [m] when the nodes are displaced by q and the frame is where it is.
    pub fn outline(&self, map: &SurfaceMap, q: Nodal, frame: &RigidMotion) -> Option<Outline> {
        let place = |corner: &Corner| {
            let [x, y] = frame.local(map.place(&corner.attachment, q).at);
            if corner.image { [-x, y] } else { [x, y] }
        };
        let loops: Vec<Vec<[f64; 2]>> = self.loops.iter().map(|l| l.iter().map(place).collect()).collect();
        Outline::deformed(loops)
    }

    /// The corners at the ends of the side that a place of the outline lies on, each with its share of it.
    fn ends(&self, outline: &Outline, at: [f64; 2]) -> [(&Corner, f64); 2] {
        let mut best = (f64::INFINITY, 0, 0.0);
        for (k, corners) in outline.loops().iter().enumerate() {
            let polyline = Polyline::closed(corners);
            let (s, distance) = polyline.nearest(at);
            if distance < best.0 {
                best = (distance, k, s);
            }
        }
        let (_, k, s) = best;
        let (side, t) = Polyline::closed(&outline.loops()[k]).piece(s);
        let corners = &self.loops[k];
        [(&corners[side], 1.0 - t), (&corners[(side + 1) % corners.len()], t)]
    }

    /// Velocity [m/s] of a place of the outline [m, body's frame].
    pub fn velocity(&self, map: &SurfaceMap, outline: &Outline, at: [f64; 2], (q, rate): (Nodal, Nodal)) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (corner, share) in self.ends(outline, at) {
            let [u, v] = map.velocity(&corner.attachment, q, rate);
            let u = if corner.image { -u } else { u };
            sum = [sum[0] + share * u, sum[1] + share * v];
        }
        sum
    }

    /// Add a force or an impulse at a point of the outline to the nodes' loads.
    pub fn add_load(
        &self,
        map: &SurfaceMap,
        outline: &Outline,
        at: [f64; 2],
        q: Nodal,
        force: [f64; 2],
        loads: &mut [[f64; 3]],
    ) {
        for (corner, share) in self.ends(outline, at) {
            let x = if corner.image { -force[0] } else { force[0] };
            map.add_load(&corner.attachment, q, [share * x, share * force[1]], loads);
        }
    }
}
