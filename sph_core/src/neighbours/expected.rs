//! Where particles are expected while lists last, and how far they may go astray of that.

use crate::neighbours::cells::Point;
use crate::neighbours::visibility::ThinWalls;
use crate::parallel;

/// Skin that even a particle at rest usually gets, in smoothing lengths.
pub(crate) const SKIN: f64 = 0.03;
/// Share of its way, at its velocity while the lists last, that a particle may go astray.
const ASTRAY: f64 = 0.05;

/// Particles as they are when lists are made.
#[derive(Clone, Copy)]
pub(super) struct Moving<'a> {
    /// Position [m].
    pub at: [&'a [f64]; 2],
    /// Velocity [m/s].
    pub velocity: [&'a [f64]; 2],
    /// Smoothing length [m].
    pub h: &'a [f64],
}

/// What is expected of particles while lists last. Points stand where velocities take them in half of that. Beside thin walls
/// particles are expected anywhere around where they are, since masks are made for there.
pub(super) struct Expectation {
    /// How long the lists are to last [s].
    life: f64,
    /// Skin that even a particle at rest gets [h].
    skin: f64,
    /// Ends of thin walls [m]; `None` without thin walls.
    ends: Option<Vec<[f64; 2]>>,
}

impl Expectation {
    pub fn new([life, skin]: [f64; 2], thin: Option<ThinWalls<'_>>) -> Expectation {
        Expectation { life, skin, ends: thin.map(|thin| thin.ends()) }
    }

    /// The velocity that particle `k` is expected to keep [m/s].
    #[inline(always)]
    pub fn velocity(&self, of: &Moving<'_>, k: usize) -> [f32; 2] {
        let [u, v] = of.velocity;
        if self.ends.is_some() { [0.0; 2] } else { [u[k] as f32, v[k] as f32] }
    }

    /// How far particle `k` may go astray [m].
    #[inline(always)]
    pub fn allowance(&self, of: &Moving<'_>, k: usize) -> f64 {
        let ([x, y], [u, v], h) = (of.at, of.velocity, of.h[k]);
        let astray = if self.ends.is_some() { 1.0 } else { ASTRAY };
        let allowed = self.skin * h + astray * (u[k] * u[k] + v[k] * v[k]).sqrt() * self.life;
        let ends = self.ends.iter().flatten();
        ThinWalls::held_at_ends(ends, [x[k], y[k]], h, allowed) // WA8
    }

    /// Particle `k` for the search.
    #[inline(always)]
    pub fn point(&self, of: &Moving<'_>, k: usize) -> Point {
        let travel = self.velocity(of, k).map(|v| 0.5 * self.life * f64::from(v));
        let [x, y] = of.at;
        let reach = of.h[k] + self.allowance(of, k);
        Point { x: x[k] + travel[0], y: y[k] + travel[1], reach, travel, index: k as u32 }
    }

    /// All of them for the search.
    pub fn points(&self, of: &Moving<'_>) -> Vec<Point> {
        let mut points = vec![Point::at_rest([0.0; 2], 0.0, 0); of.at[0].len()];
        parallel::gather_into(&mut points, |k| self.point(of, k));
        points
    }
}
