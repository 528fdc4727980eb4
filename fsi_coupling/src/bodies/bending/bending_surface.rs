//! The surface of a body that bends: boundary particles, loads on the nodes, contact (THEORY CO13–CO16).

use sph_core::{PlateMidline, WallForces, WallPoint, WallsMut};
use structure_fe::State;

use crate::bodies::bending::deformed_outline::DeformedOutline;
use crate::bodies::bending::surface_layout::SurfaceLayout;
use crate::bodies::bending::surface_map::{Attachment, Influence, Nodal};
use crate::bodies::rigid_motion::RigidMotion;
use crate::bodies::state::SurfacePoint;
use crate::geometry::outline::Outline;
use crate::geometry::plate::Plate;
use crate::geometry::plate_sampling::boundary_particles;
use crate::geometry::rows::WallRows;
use crate::geometry::vector::rotate;

/// Displacements, velocities and accelerations of the nodes.
#[derive(Clone, Copy)]
pub struct NodalMotion<'a> {
    pub displacement: Nodal<'a>,
    pub velocity: Nodal<'a>,
    pub acceleration: Nodal<'a>,
}

impl<'a> From<&'a State> for NodalMotion<'a> {
    fn from(state: &'a State) -> NodalMotion<'a> {
        NodalMotion { displacement: &state.displacement, velocity: &state.velocity, acceleration: &state.acceleration }
    }
}

/// The surface of a body that bends, with its boundary particles attached to nodes.
pub struct BendingSurface {
    pub layout: SurfaceLayout,
    /// The outline now [m, body's frame].
    pub outline: Outline,
    /// Attachments of the boundary particles.
    pub attachments: Vec<Attachment>,
    pub half: bool,
    rest: Outline,
    /// Set where the body is sampled as a thin plate, with the attachments of its midline (THEORY WA8, WA9).
    plate: Option<Plate>,
    midline: Vec<Attachment>,
    deformed: DeformedOutline,
}

impl BendingSurface {
    /// An outline [m, body's frame], undeformed; with `half`, only its half x > 0 is simulated.
    pub fn new(layout: SurfaceLayout, outline: Outline, half: bool) -> BendingSurface {
        let deformed = DeformedOutline::new(&outline, &layout, half);
        let (attachments, midline) = (Vec::new(), Vec::new());
        BendingSurface { layout, rest: outline.clone(), outline, attachments, half, plate: None, midline, deformed }
    }

    /// Boundary particles where the start puts them, attached to the nodes.
    pub fn sample(&mut self, rows: &WallRows) -> Vec<WallPoint> {
        let mut points;
        (points, self.plate) = boundary_particles(&self.rest, rows, self.half);
        self.midline = self.plate.iter().flat_map(|plate| self.layout.divided(&plate.line())).collect();
        let start = self.layout.start;
        self.attachments.clear();
        for point in &mut points {
            let foot = [0, 1].map(|k| point.at[k] + point.depth * point.normal[k]);
            self.attachments.push(self.layout.attachment(foot, point.at, point.normal));
            (point.at, point.normal) = (start.point(point.at), rotate(point.normal, start.angle));
        }
        points
    }

    /// H: from the nodes now and their displacements `then`, `ahead` [s] from now. A particle's mean velocity leads from its place in
    /// `from`, where it has one (CO16).
    pub fn kinematics(
        &self,
        now: NodalMotion,
        then: Nodal,
        from: &[[f64; 2]],
        ahead: f64,
        out: WallsMut<'_>,
    ) -> Vec<PlateMidline> {
        let map = &self.layout.map;
        for (k, attachment) in self.attachments.iter().enumerate() {
            let from = from.get(k).copied().unwrap_or_else(|| map.place(attachment, now.displacement).at);
            let to = map.place(attachment, then);
            [out.x[k], out.y[k]] = to.at;
            [out.nx[k], out.ny[k]] = to.normal;
            [out.u[k], out.v[k]] = if ahead > 0.0 {
                [0, 1].map(|axis| (to.at[axis] - from[axis]) / ahead)
            } else {
                map.velocity(attachment, now.displacement, now.velocity)
            };
            [out.ax[k], out.ay[k]] = map.acceleration(attachment, then, now.velocity, now.acceleration);
        }
        let placed = |q: Nodal| self.midline.iter().map(|point| map.place(point, q).at).collect();
        let midline = |plate: &Plate| PlateMidline {
            points: placed(then),
            start: placed(now.displacement),
            half_thickness: 0.5 * plate.thickness,
            own_image: self.half,
        };
        self.plate.iter().map(midline).collect()
    }

    /// Velocities of the boundary particles [m/s].
    pub fn velocities(&self, now: NodalMotion) -> Vec<[f64; 2]> {
        let of = |attachment| self.layout.map.velocity(attachment, now.displacement, now.velocity);
        self.attachments.iter().map(of).collect()
    }

    /// CO15 of the boundary particles, where the nodes are displaced by q.
    pub fn influences(&self, q: Nodal) -> Vec<Influence> {
        self.attachments.iter().map(|attachment| self.layout.map.influence(attachment, q)).collect()
    }

    /// Motion of the body's frame, about its origin.
    pub fn frame(&self, now: NodalMotion) -> RigidMotion {
        self.layout.frame(now.displacement, now.velocity, now.acceleration)
    }

    /// Hᵀ: the mean forces and those now, added to loads on the nodes displaced by q. Returns the resultant now, with its moment about
    /// the tank's origin [N/m, N/m, N].
    pub fn add_loads(&self, force: &WallForces<'_>, q: Nodal, mean: &mut [[f64; 3]], now: &mut [[f64; 3]]) -> [f64; 3] {
        let (map, mut resultant) = (&self.layout.map, [0.0; 3]);
        for (k, attachment) in self.attachments.iter().enumerate() {
            let [fx, fy] = [force.fx[k], force.fy[k]];
            map.add_load(attachment, q, [force.mean_fx[k], force.mean_fy[k]], mean);
            map.add_load(attachment, q, [fx, fy], now);
            let moment = force.x[k] * fy - force.y[k] * fx;
            resultant = [resultant[0] + fx, resultant[1] + fy, resultant[2] + moment];
        }
        resultant
    }

    /// Loads on the nodes of an impulse [N s/m] at a place of the surface in space [m].
    pub fn loads_of(&self, at: [f64; 2], impulse: [f64; 2], frame: &RigidMotion, q: Nodal) -> Vec<[f64; 3]> {
        let mut loads = vec![[0.0; 3]; q.len()];
        self.deformed.add_load(&self.layout.map, &self.outline, frame.local(at), q, impulse, &mut loads);
        loads
    }

    /// Update the outline to displacements of the nodes; false where they are not finite.
    pub fn update_outline(&mut self, frame: &RigidMotion, q: Nodal) -> bool {
        let placed = self.deformed.outline(&self.layout.map, q, frame);
        let finite = placed.is_some();
        self.outline = placed.unwrap_or_else(|| self.outline.clone());
        finite
    }

    /// Distance of a point in space from the surface [m], positive outside the body.
    pub fn signed_distance(&self, at: [f64; 2], frame: &RigidMotion) -> f64 {
        self.outline.signed_distance(frame.local(at))
    }

    /// The point of the surface nearest to a point in space.
    pub fn nearest(&self, at: [f64; 2], frame: &RigidMotion, q: Nodal, velocity: Nodal) -> SurfacePoint {
        let (found, normal) = self.outline.nearest(frame.local(at));
        let velocity = self.deformed.velocity(&self.layout.map, &self.outline, found, (q, velocity));
        SurfacePoint { at: frame.point(found), normal: rotate(normal, frame.angle), velocity }
    }

    /// A point of the undeformed surface [m, body's frame] where it is now, and its acceleration [m/s²].
    pub fn material_point(&self, at: [f64; 2], now: NodalMotion) -> (SurfacePoint, [f64; 2]) {
        let (_, normal) = self.rest.nearest(at);
        let (map, attachment) = (&self.layout.map, self.layout.attachment(at, at, normal));
        let NodalMotion { displacement, velocity, acceleration } = now;
        let place = map.place(&attachment, displacement);
        let surface = SurfacePoint {
            at: place.at,
            normal: place.normal,
            velocity: map.velocity(&attachment, displacement, velocity),
        };
        (surface, map.acceleration(&attachment, displacement, velocity, acceleration))
    }
}
