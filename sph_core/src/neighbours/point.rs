//! A point of the neighbour search.

/// A point and how far it reaches: a and b may meet if |r_ab| < reach_a + reach_b + |s_a − s_b| with their travels s.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Position [m].
    pub x: f64,
    /// Position [m].
    pub y: f64,
    /// Half the distance over which it may interact with its like [m].
    pub reach: f64,
    /// How far it may go from (x, y) at the velocity that it is expected to keep, to either side [m].
    pub travel: [f64; 2],
    /// Whose point this is.
    pub index: u32,
}

impl Point {
    /// A point that stays in place.
    pub fn at_rest([x, y]: [f64; 2], reach: f64, index: u32) -> Point {
        Point { x, y, reach, travel: [0.0; 2], index }
    }

    /// The farthest that it may reach from (x, y) [m].
    #[inline(always)]
    pub(crate) fn farthest(&self) -> f64 {
        self.reach + self.travel[0].abs() + self.travel[1].abs()
    }

    /// True if the two may meet.
    #[inline(always)]
    pub(crate) fn meets(&self, other: &Point) -> bool {
        let apart = (self.travel[0] - other.travel[0]).abs() + (self.travel[1] - other.travel[1]).abs();
        let (dx, dy, cut) = (self.x - other.x, self.y - other.y, self.reach + other.reach + apart);
        dx * dx + dy * dy < cut * cut
    }
}
