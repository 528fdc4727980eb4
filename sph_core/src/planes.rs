//! Mirror planes and periodic plane pairs (THEORY OP8, OP9): a neighbour behind a plane of symmetry is the image of
//! one in front of it; a neighbour beyond a periodic plane is the image of one beside the opposite plane.
//!
//! An image is never stored as state: it is a source particle and a reflection or a translation, applied whenever the
//! particles are packed.

use serde::{Deserialize, Serialize};

/// A plane of symmetry x = `at`; the fluid lies on the side x > `at`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mirror {
    /// Where the plane stands [m].
    pub at: f64,
}

impl Mirror {
    /// Image of a horizontal position [m].
    #[inline(always)]
    pub(crate) fn reflect(&self, x: f64) -> f64 {
        2.0 * self.at - x
    }
}

/// OP9: periodic plane pairs. What leaves through one plane of a pair enters through the other, at the same velocity.
/// Each period must be longer than two supports, 4h, so that no particle meets another twice. Not to be combined with a
/// [`Mirror`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Periodic {
    /// The pair of planes across x [m], if there is one.
    pub x: Option<[f64; 2]>,
    /// The pair of planes across y [m], if there is one.
    pub y: Option<[f64; 2]>,
}

impl Periodic {
    /// Translations of the images nearest to the cell [m]: 2 for one pair of planes, 8 for two.
    pub(crate) fn shifts(&self) -> impl Iterator<Item = [f64; 2]> {
        let length = |pair: Option<[f64; 2]>| pair.map_or(0.0, |[from, to]| to - from);
        let (a, b) = (length(self.x), length(self.y));
        let steps = |pair: Option<[f64; 2]>| if pair.is_some() { -1..=1 } else { 0..=0 };
        let rows = steps(self.y);
        steps(self.x)
            .flat_map(move |i| rows.clone().map(move |j| (i, j)))
            .filter(|&(i, j)| (i, j) != (0, 0))
            .map(move |(i, j)| [f64::from(i) * a, f64::from(j) * b])
    }

    /// True within `distance` [m] of a plane, or beyond it.
    pub(crate) fn is_beside(&self, at: [f64; 2], distance: f64) -> bool {
        let beside =
            |at: f64, pair: Option<[f64; 2]>| pair.is_some_and(|[from, to]| at < from + distance || at > to - distance);
        beside(at[0], self.x) || beside(at[1], self.y)
    }

    /// A position inside the cell for one that left it [m].
    pub(crate) fn wrap(&self, at: [f64; 2]) -> [f64; 2] {
        let inside = |at: f64, pair: Option<[f64; 2]>| match pair {
            Some([from, to]) if at < from || at >= to => from + (at - from).rem_euclid(to - from),
            _ => at,
        };
        [inside(at[0], self.x), inside(at[1], self.y)]
    }

    /// The shorter period [m].
    pub(crate) fn shortest(&self) -> f64 {
        [self.x, self.y].into_iter().flatten().map(|[from, to]| to - from).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_has_two_neighbours_along_each_axis_and_four_across_corners() {
        let both = Periodic { x: Some([-1.0, 1.0]), y: Some([0.0, 3.0]) };
        let shifts: Vec<[f64; 2]> = both.shifts().collect();
        assert_eq!(shifts.len(), 8);
        assert!(shifts.contains(&[2.0, -3.0]) && shifts.contains(&[0.0, 3.0]) && shifts.contains(&[-2.0, 0.0]));
        let one = Periodic { x: Some([-1.0, 1.0]), y: None };
        assert_eq!(one.shifts().collect::<Vec<_>>(), [[-2.0, 0.0], [2.0, 0.0]]);
    }

    #[test]
    fn a_particle_leaves_through_one_plane_and_enters_through_the_other() {
        let cell = Periodic { x: Some([-1.0, 1.0]), y: None };
        let [x, y] = cell.wrap([1.25, 7.0]);
        assert!((x + 0.75).abs() < 1e-15 && y == 7.0);
        assert_eq!(cell.wrap([-0.3, 7.0]), [-0.3, 7.0]);
        assert!((-1.0..1.0).contains(&cell.wrap([-1.0 - 1e-17, 0.0])[0]));
    }
}
