//! The surface of a rigid body: boundary particles and contact by rigid kinematics.

use sph_core::{PlateMidline, WallPoint, WallsMut};

use crate::bodies::rigid_motion::RigidMotion;
use crate::bodies::state::SurfacePoint;
use crate::geometry::outline::Outline;
use crate::geometry::plate::Plate;
use crate::geometry::plate_sampling::boundary_particles;
use crate::geometry::rows::WallRows;
use crate::geometry::vector::rotate;

/// An outline, with its boundary particles relative to a reference point.
#[derive(Clone)]
pub struct RigidSurface {
    /// Outline in the body's frame [m].
    pub outline: Outline,
    /// The reference point in the body's frame [m].
    pub reference: [f64; 2],
    half: bool,
    points: Vec<WallPoint>,
    /// Set where the outline is sampled as a thin plate (THEORY WA9).
    plate: Option<Plate>,
}

impl RigidSurface {
    /// An outline that moves with a reference point, not yet sampled; with `half`, only its part x > 0 is sampled.
    pub fn new(outline: Outline, reference: [f64; 2], half: bool) -> RigidSurface {
        RigidSurface { outline, reference, half, points: Vec::new(), plate: None }
    }

    /// Whether only its part x > 0 is sampled.
    pub fn is_half(&self) -> bool {
        self.half
    }

    /// Boundary particles where `motion` puts them; kept in the body's frame.
    pub fn sample(&mut self, motion: &RigidMotion, rows: &WallRows) -> Vec<WallPoint> {
        (self.points, self.plate) = boundary_particles(&self.outline, rows, self.half);
        for p in &mut self.points {
            p.at = [p.at[0] - self.reference[0], p.at[1] - self.reference[1]];
        }
        let put = |p: &WallPoint| WallPoint { at: motion.point(p.at), normal: rotate(p.normal, motion.angle), ..*p };
        self.points.iter().map(put).collect()
    }

    /// H for rigid motion: positions `ahead` [s] from now, mean velocity until then, acceleration.
    pub fn kinematics(&self, now: &RigidMotion, ahead: f64, out: WallsMut<'_>) {
        let (then, mean) = (now.ahead(ahead), now.ahead(0.5 * ahead));
        for (k, p) in self.points.iter().enumerate() {
            [out.x[k], out.y[k]] = then.point(p.at);
            [out.u[k], out.v[k]] = mean.point_velocity(p.at);
            [out.ax[k], out.ay[k]] = then.point_acceleration(p.at);
            [out.nx[k], out.ny[k]] = rotate(p.normal, then.angle);
        }
    }

    /// The midline of a thin plate (THEORY WA8) that moves from `now` to `then`; none for other shapes.
    pub fn midlines(&self, now: &RigidMotion, then: &RigidMotion) -> Vec<PlateMidline> {
        let midline = |plate: &Plate| {
            let line = plate.line();
            let placed = |motion: &RigidMotion| line.iter().map(|p| motion.point(self.lever_arm(*p))).collect();
            let half_thickness = 0.5 * plate.thickness;
            PlateMidline { points: placed(then), start: placed(now), half_thickness, own_image: self.half }
        };
        self.plate.iter().map(midline).collect()
    }

    /// Distance of a point in space from the surface [m], positive outside the body.
    pub fn signed_distance(&self, now: &RigidMotion, at: [f64; 2]) -> f64 {
        self.outline.signed_distance(self.in_frame(now, at))
    }

    /// The point of the surface nearest to a point in space.
    pub fn nearest(&self, now: &RigidMotion, at: [f64; 2]) -> SurfacePoint {
        let (found, normal) = self.outline.nearest(self.in_frame(now, at));
        let lever_arm = self.lever_arm(found);
        SurfacePoint {
            at: now.point(lever_arm),
            normal: rotate(normal, now.angle),
            velocity: now.point_velocity(lever_arm),
        }
    }

    /// From the reference point to a point of the body's frame [m].
    pub fn lever_arm(&self, in_frame: [f64; 2]) -> [f64; 2] {
        [in_frame[0] - self.reference[0], in_frame[1] - self.reference[1]]
    }

    fn in_frame(&self, now: &RigidMotion, at: [f64; 2]) -> [f64; 2] {
        let r = now.local(at);
        [r[0] + self.reference[0], r[1] + self.reference[1]]
    }
}
