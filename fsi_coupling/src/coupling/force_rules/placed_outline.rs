//! A body's outline at its present position: forces and tractions become loads of its corners.

use crate::bodies::body::Body;
use crate::bodies::state::Motion;
use crate::coupling::coupled::Coupled;
use crate::coupling::force_rules::nodal_loads::{Nodal, Side, apply_force, gauss_points, sides};
use crate::geometry::outline::Outline;

/// Sides that turn by more than this meet at a corner [rad]; smoother bends are read as flat.
const CORNER: f64 = 0.35;

/// A force [N/m] and its point of action [m]: on the surface, and in space.
pub struct PointForce {
    pub surface: [f64; 2],
    pub at: [f64; 2],
    pub force: [f64; 2],
}

/// A body's outline at its present position, and the fluid around it.
pub struct PlacedOutline<'a> {
    pub system: &'a Coupled,
    pub motion: Motion,
    pub sides: Vec<Side>,
    pub corners: Vec<[f64; 2]>,
    pub sharp: Vec<[f64; 2]>,
    pub support: f64,
    pub field: [f64; 2],
}

impl<'a> PlacedOutline<'a> {
    pub fn of(system: &'a Coupled, body: &dyn Body) -> Option<PlacedOutline<'a>> {
        let (motion, outline): (Motion, &Outline) = (body.motion()?, body.outline()?);
        let place = |v: &[f64; 2]| motion.point(*v);
        let loops: Vec<Vec<[f64; 2]>> = outline.loops().iter().map(|l| l.iter().map(place).collect()).collect();
        let sides = sides(&loops);
        let corners: Vec<[f64; 2]> = loops.concat();
        let arriving = |corner: usize| sides.iter().find(|s| s.corners[1] == corner);
        let turns = |s: &&Side| {
            let before = arriving(s.corners[0]).map_or(s.along, |b| b.along);
            let cross = before[0] * s.along[1] - before[1] * s.along[0];
            cross.atan2(before[0] * s.along[0] + before[1] * s.along[1]).abs() > CORNER
        };
        let sharp = sides.iter().filter(turns).map(|s| s.from).collect();
        let domain = system.fluid.domain();
        let finest = system.fluid.particles().h.iter().copied().fold(f64::INFINITY, f64::min);
        let field = [0, 1].map(|k| domain.fluid.density * (domain.gravity[k] - motion.acceleration[k]));
        Some(PlacedOutline { system, motion, sides, corners, sharp, support: 2.0 * finest, field })
    }

    /// x of the plane of symmetry, if there is one [m].
    pub fn plane(&self) -> Option<f64> {
        self.system.fluid.domain().mirror.map(|m| m.at)
    }

    /// Area within all loops [m²].
    pub fn area(&self) -> f64 {
        let cross = |[a, b]: [usize; 2]| {
            let (a, b) = (self.corners[a], self.corners[b]);
            0.5 * (a[0] * b[1] - a[1] * b[0])
        };
        self.sides.iter().map(|side| cross(side.corners)).sum()
    }

    /// The forces of the half in front of the plane of symmetry, and those of their images.
    pub fn doubled(&self, forces: Vec<PointForce>) -> Vec<PointForce> {
        let Some(plane) = self.plane() else { return forces };
        let turn = |p: [f64; 2]| [2.0 * plane - p[0], p[1]];
        let image =
            |p: &PointForce| PointForce { surface: turn(p.surface), at: turn(p.at), force: [-p.force[0], p.force[1]] };
        let images: Vec<PointForce> = forces.iter().map(image).collect();
        forces.into_iter().chain(images).collect()
    }

    /// The place of the surface above boundary particle `j` [m].
    pub fn above(&self, j: usize) -> [f64; 2] {
        let w = &self.system.walls;
        [w.x[j] + w.depth[j] * w.nx[j], w.y[j] + w.depth[j] * w.ny[j]]
    }

    /// The side nearest to a place, and the share along it.
    pub fn nearest(&self, at: [f64; 2]) -> (usize, f64) {
        let all = self.sides.iter().map(|side| side.nearest(at)).enumerate();
        let nearer =
            |best: (usize, (f64, f64)), here: (usize, (f64, f64))| if here.1.1 < best.1.1 { here } else { best };
        let (side, (share, _)) = all.fold((0, (0.0, f64::INFINITY)), nearer);
        (side, share)
    }

    /// GE9: loads of the corners from forces.
    pub fn nodal_loads(&self, forces: &[PointForce]) -> Vec<Nodal> {
        let mut corners = vec![Nodal::default(); self.corners.len()];
        for force_at in forces {
            let (side, t) = self.nearest(force_at.surface);
            apply_force(&self.sides[side], t, force_at.at, force_at.force, &mut corners);
        }
        corners
    }

    /// GE8: tractions [Pa] at Gauss points, integrated to loads of the corners. Behind a plane of symmetry the mirror
    /// image is read.
    pub fn integrated(&self, panel: f64, traction: impl Fn([f64; 2], [f64; 2]) -> [f64; 2]) -> Vec<Nodal> {
        let mut corners = vec![Nodal::default(); self.corners.len()];
        for side in &self.sides {
            for (t, length) in gauss_points(side, panel) {
                let (at, n) = (side.at(t), side.normal());
                let force = match self.plane() {
                    Some(plane) if at[0] < plane => {
                        let [x, y] = traction([2.0 * plane - at[0], at[1]], [-n[0], n[1]]);
                        [-x, y]
                    }
                    _ => traction(at, n),
                };
                apply_force(side, t, at, force.map(|f| f * length), &mut corners);
            }
        }
        corners
    }
}
