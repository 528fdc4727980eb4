//! Where solids and water are not to be: particles beyond a wall's surface, bodies beyond a tank's walls.

use crate::bodies::body::WettedBody;
use crate::bodies::rigid_motion::rotate;

/// A fluid particle beyond a wall's surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Breach {
    /// The particle.
    pub id: u32,
    /// Where it is [m].
    pub at: [f64; 2],
    /// How far beyond the surface [m].
    pub depth: f64,
    /// Name of the wall's owner; empty for the plane of symmetry.
    pub owner: String,
}

/// Fluid particles beyond a wall's surface: how many, and the deepest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Penetration {
    /// How many.
    pub count: usize,
    /// The deepest.
    pub worst: Option<Breach>,
}

impl Penetration {
    /// What was found among these and among `later` ones.
    pub(crate) fn and(self, later: Penetration) -> Penetration {
        let count = self.count + later.count;
        let worst = match (self.worst, later.worst) {
            (Some(a), Some(b)) => Some(if b.depth > a.depth { b } else { a }),
            (a, b) => a.or(b),
        };
        Penetration { count, worst }
    }

    /// Count one particle, at `clearance` [m] from the wall of `owner`, if it is beyond it.
    pub(crate) fn count(&mut self, id: u32, at: [f64; 2], clearance: f64, owner: &str) {
        if clearance >= 0.0 {
            return;
        }
        self.count += 1;
        if self.worst.as_ref().is_none_or(|worst| -clearance > worst.depth) {
            self.worst = Some(Breach { id, at, depth: -clearance, owner: owner.to_string() });
        }
    }
}

/// A corner of `body` [m] that lies more than `play` [m] beyond a surface of `wall`, if there is one.
pub(crate) fn run_into(body: &dyn WettedBody, wall: &dyn WettedBody, play: f64) -> Option<[f64; 2]> {
    let (outline, motion) = (body.outline()?, body.motion()?);
    let placed = |corner: &[f64; 2]| {
        let r = rotate(*corner, motion.angle);
        [motion.position[0] + r[0], motion.position[1] + r[1]]
    };
    outline.loops().iter().flatten().map(placed).find(|at| wall.clearance(*at) < -play)
}
