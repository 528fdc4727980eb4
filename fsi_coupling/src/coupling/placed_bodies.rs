//! Bodies with their boundary particles: first placed alone, then the water is filled in around them. The work of the fluid on
//! them is compared on both sides of the interface (THEORY CO17).

use std::ops::Range;

use serde::{Deserialize, Serialize};

use sph_core::{WallInterface, WallLayout, Walls};

use crate::bodies::body::Body;
use crate::bodies::error::BodyError;
use crate::geometry::rows::WallRows;

/// Work of the fluid on a body as the fluid does it, Σ Δt F̄·V over the boundary particles, and as the body takes it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WorkAudit {
    /// Done by the fluid since the start [J/m].
    pub given: f64,
    /// Taken by the body since the start [J/m].
    pub received: f64,
    /// Σ of the steps' work by magnitude [J/m].
    pub exchanged: f64,
}

impl WorkAudit {
    /// Add the work of a step on the particles of a body, and the work of contact impulses [J/m].
    pub(crate) fn record(&mut self, walls: &Walls, range: Range<usize>, dt: f64, halves: f64, contact: f64) {
        let power = |k: usize| walls.mean_fx[k] * walls.u[k] + walls.mean_fy[k] * walls.v[k];
        let work = halves * dt * range.map(power).sum::<f64>() + contact;
        self.given += work;
        self.exchanged += work.abs();
    }

    /// Difference of both, over the work exchanged [-].
    pub fn residual(&self) -> f64 {
        if self.exchanged > 0.0 { (self.given - self.received).abs() / self.exchanged } else { 0.0 }
    }
}

/// A body, its boundary particles and the midlines of its thin plates among those of all bodies.
pub(super) struct Member {
    pub body: Box<dyn Body>,
    pub range: Range<usize>,
    pub plates: Range<usize>,
    pub work: WorkAudit,
}

/// Bodies at t = 0 with their boundary particles. The water may be packed around them before
/// [`Coupled::with_bodies`](crate::Coupled::with_bodies) steps both.
pub struct PlacedBodies {
    pub(super) walls: Walls,
    pub(super) members: Vec<Member>,
    pub(super) spacing: f64,
}

impl PlacedBodies {
    /// Sample the bodies at `spacing` [m] in the layers that a scheme needs, and place the particles. `ratio` is the smoothing length
    /// over the spacing [-].
    pub fn new(
        bodies: Vec<Box<dyn Body>>,
        layout: WallLayout,
        ratio: f64,
        spacing: f64,
    ) -> Result<PlacedBodies, BodyError> {
        let rows = WallRows::of(layout, spacing);
        let mut placed = PlacedBodies { walls: Walls::default(), members: Vec::new(), spacing };
        for mut body in bodies {
            let range = placed.walls.extend(&body.sample(&rows)?, ratio);
            let plates = 0..0;
            placed.members.push(Member { body, range, plates, work: WorkAudit::default() });
        }
        apply_kinematics(&mut placed.members, &mut placed.walls, 0.0);
        Ok(placed)
    }

    /// The boundary particles of all bodies.
    pub fn walls(&self) -> &Walls {
        &self.walls
    }

    /// The bodies, in the order they were given.
    pub fn bodies(&self) -> impl Iterator<Item = &dyn Body> {
        self.members.iter().map(|m| m.body.as_ref())
    }
}

/// H: place all boundary particles and plate midlines `ahead` [s] from now.
pub(super) fn apply_kinematics(members: &mut [Member], walls: &mut Walls, ahead: f64) {
    walls.midlines.clear();
    for m in members {
        let midlines = m.body.kinematics(ahead, walls.slice_mut(m.range.clone()));
        m.plates = walls.midlines.len()..walls.midlines.len() + midlines.len();
        walls.midlines.extend(midlines);
    }
}

/// CO5: interface dynamics of the bodies that a force accelerates, at the end of a step of `ahead` [s].
pub(super) fn interfaces(members: &mut [Member], ahead: f64, mirrored: bool) -> Result<Vec<WallInterface>, BodyError> {
    let mut found = Vec::new();
    for Member { body, range, .. } in members {
        if let Some(owner) = body.interface(ahead)? {
            found.push(WallInterface { range: range.clone(), mirrored, owner });
        }
    }
    Ok(found)
}

/// Hᵀ: the fluid's forces on the boundary particles become the bodies' loads.
pub(super) fn load(members: &mut [Member], walls: &Walls, mirrored: bool) {
    for m in members {
        let mut forces = walls.forces(m.range.clone());
        forces.mirrored = mirrored;
        m.body.load(forces);
    }
}
