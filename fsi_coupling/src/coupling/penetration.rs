//! Penetration: fluid particles behind a wall's surface, bodies behind a tank's walls.

use std::ops::Range;

use sph_core::{Fluid, parallel};

use crate::bodies::body::Body;
use crate::geometry::polygon::bounding_box;

/// Rounding of a place over its distance from the origin [-].
const ROUNDING: f64 = 1e-13;

/// A fluid particle behind a wall's surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Breach {
    /// The particle.
    pub id: u32,
    /// Where it is [m].
    pub at: [f64; 2],
    /// How far behind the surface [m].
    pub depth: f64,
    /// Name of the wall's owner; empty for the plane of symmetry.
    pub owner: String,
}

/// Fluid particles behind a wall's surface: how many, and the deepest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Penetration {
    /// How many.
    pub count: usize,
    /// The deepest.
    pub worst: Option<Breach>,
}

impl Penetration {
    /// The sum of two counts.
    pub(crate) fn and(self, later: Penetration) -> Penetration {
        let count = self.count + later.count;
        let worst = match (self.worst, later.worst) {
            (Some(a), Some(b)) => Some(if b.depth > a.depth { b } else { a }),
            (a, b) => a.or(b),
        };
        Penetration { count, worst }
    }

    /// Count one particle, at a signed `distance` [m] from the wall of `owner`, if it is behind it by more than rounding.
    pub(crate) fn count(&mut self, id: u32, at: [f64; 2], distance: f64, owner: &str) {
        if distance >= -ROUNDING * (at[0].abs() + at[1].abs()) {
            return;
        }
        self.count += 1;
        if self.worst.as_ref().is_none_or(|worst| -distance > worst.depth) {
            self.worst = Some(Breach { id, at, depth: -distance, owner: owner.to_string() });
        }
    }
}

/// Bounding box of a body's outline where it is now [m]: no point outside is behind its surface. `None` for a tank.
fn bounding_box_of(body: &dyn Body) -> Option<[[f64; 2]; 2]> {
    let motion = body.motion()?;
    let corners: Vec<[f64; 2]> = body.outline()?.loops().iter().flatten().map(|corner| motion.point(*corner)).collect();
    let [low, high] = bounding_box(&corners);
    let rounding = 1e-9 * (high[0] - low[0] + high[1] - low[1]);
    Some([low.map(|x| x - rounding), high.map(|x| x + rounding)])
}

/// Fluid particles behind the surface of a body, or behind the plane of symmetry.
pub(crate) fn penetration(fluid: &Fluid, bodies: &[&dyn Body]) -> Penetration {
    // a particle whose pairs are held stands for its image while it is beyond the plane
    let (p, mirror) = (fluid.particles(), fluid.domain().mirror.filter(|_| !fluid.holds_pairs()));
    let boxes: Vec<Option<[[f64; 2]; 2]>> = bodies.iter().map(|body| bounding_box_of(*body)).collect();
    let search = |targets: Range<usize>| {
        let mut found = Penetration::default();
        for k in targets {
            let at = [p.x[k], p.y[k]];
            let (mut nearest, mut owner) = (mirror.map_or(f64::INFINITY, |m| p.x[k] - m.at), "");
            for (body, bounds) in bodies.iter().zip(&boxes) {
                if bounds.is_none_or(|[low, high]| (0..2).all(|k| at[k] >= low[k] && at[k] <= high[k])) {
                    let distance = body.signed_distance(at);
                    if distance < nearest {
                        (nearest, owner) = (distance, body.name());
                    }
                }
            }
            found.count(p.id[k], at, nearest, owner);
        }
        found
    };
    parallel::by_chunk(p.len(), search).into_iter().fold(Penetration::default(), Penetration::and)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_particle_on_a_wall_to_rounding_is_not_behind_it() {
        let mut found = Penetration::default();
        found.count(1, [0.2, 0.1], -8.7e-18, "box");
        assert_eq!(found, Penetration::default());
        found.count(2, [0.2, 0.1], -1e-9, "box");
        assert_eq!((found.count, found.worst.map(|worst| worst.id)), (1, Some(2)));
    }
}
