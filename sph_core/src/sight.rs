//! Who sees whom where there are screens (THEORY T1, T2): pairs that a screen parts are struck from the neighbour lists.

use crate::cells::Point;
use crate::images::Mirror;
use crate::neighbours::Lists;
use crate::screen::{Screen, bounds};
use crate::walls::Walls;

/// A thin wall's particle is looked at this far to its own side of the middle line at least, in its smoothing lengths.
const ASIDE: f64 = 0.05;
/// Around a free end lists last until somebody has moved this many smoothing lengths (T4).
const END_SKIN: f64 = 0.25;
/// What counts as around a free end, in smoothing lengths.
const END_REACH: f64 = 2.5;

/// A straight piece of a screen.
#[derive(Clone, Copy, Debug)]
struct Piece {
    from: [f64; 2],
    way: [f64; 2],
    square: f64,
    screen: u32,
}

impl Piece {
    /// Coordinates across and along the piece, each times its length [m²].
    fn place(&self, p: [f64; 2]) -> (f64, f64) {
        let r = [p[0] - self.from[0], p[1] - self.from[1]];
        (self.way[0] * r[1] - self.way[1] * r[0], self.way[0] * r[0] + self.way[1] * r[1])
    }

    fn holds(&self, along: f64) -> bool {
        (-1e-9 * self.square..=(1.0 + 1e-9) * self.square).contains(&along)
    }

    /// True where the piece parts p from q [m]; the same in both directions, to the bit.
    fn parts(&self, p: [f64; 2], q: [f64; 2]) -> bool {
        let ((sp, tp), (sq, tq)) = (self.place(p), self.place(q));
        sp * sq < 0.0 && self.holds((sp * tq - sq * tp) / (sp - sq))
    }

    /// True where q lies on the piece.
    fn bears(&self, q: [f64; 2]) -> bool {
        let (across, along) = self.place(q);
        across == 0.0 && self.holds(along)
    }
}

/// Screens as they stand at one moment, with their images.
#[derive(Default)]
pub(crate) struct Sight {
    pieces: Vec<Piece>,
    box_: [[f64; 2]; 2],
}

impl Sight {
    /// Of screens where they are now. Images count after the screens themselves.
    pub fn new(screens: &[Screen], mirror: Option<Mirror>) -> Sight {
        let mut pieces = Vec::new();
        let mut add = |screen: u32, line: &[[f64; 2]]| {
            for side in line.windows(2) {
                let way = [side[1][0] - side[0][0], side[1][1] - side[0][1]];
                pieces.push(Piece { from: side[0], way, square: way[0] * way[0] + way[1] * way[1], screen });
            }
        };
        for (k, screen) in screens.iter().enumerate() {
            add(k as u32, &screen.points);
            if let Some(mirror) = mirror.filter(|_| !screen.own_image) {
                let image: Vec<[f64; 2]> = screen.points.iter().map(|p| [mirror.reflect(p[0]), p[1]]).collect();
                add((screens.len() + k) as u32, &image);
            }
        }
        let end = |p: &Piece| [p.from[0] + p.way[0], p.from[1] + p.way[1]];
        let ends: Vec<[f64; 2]> = pieces.iter().flat_map(|p| [p.from, end(p)]).collect();
        Sight { box_: bounds(ends.iter()), pieces }
    }

    /// True within `radius` of the rectangle about all screens.
    fn is_near(&self, p: [f64; 2], radius: f64) -> bool {
        let [lo, hi] = self.box_;
        (0..2).all(|c| p[c] > lo[c] - radius && p[c] < hi[c] + radius)
    }

    /// The pieces that may part p [m] from anybody within `radius` [m].
    fn near(&self, p: [f64; 2], radius: f64) -> Vec<Piece> {
        let meets = |piece: &&Piece| {
            (0..2).all(|c| {
                let (a, b) = (piece.from[c], piece.from[c] + piece.way[c]);
                p[c] > a.min(b) - radius && p[c] < a.max(b) + radius
            })
        };
        self.pieces.iter().filter(meets).copied().collect()
    }

    /// T1: true where no screen stands between p and q [m].
    pub fn free(&self, p: [f64; 2], q: [f64; 2]) -> bool {
        !self.pieces.iter().any(|piece| piece.parts(p, q))
    }
}

/// A boundary particle as it is looked at.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Where: for a thin wall's particle on the side of the middle line that its area is counted to [m].
    at: [f64; 2],
    /// Its own screen, and whether it is seen through it.
    own: Option<(u32, bool)>,
}

impl Seen {
    /// T2: does the fluid at p [m] see it? `near`: the pieces around p.
    fn from(&self, p: [f64; 2], near: &[Piece]) -> bool {
        let Some((own, beyond)) = self.own else {
            return !near.iter().any(|piece| piece.parts(p, self.at) || piece.bears(self.at));
        };
        let through = |piece: &&Piece| piece.parts(p, self.at);
        near.iter().filter(|piece| piece.screen == own).any(|piece| through(&piece)) == beyond
            && !near.iter().filter(|piece| piece.screen != own).any(|piece| through(&piece))
    }
}

/// Thin walls at the moment of a search.
#[derive(Clone, Copy)]
pub struct ThinWalls<'a> {
    /// Their screens, where they are then.
    pub screens: &'a [Screen],
    /// All walls.
    pub walls: &'a Walls,
}

/// Neighbour lists to be thinned out, and where everybody is who is listed, images included.
pub(crate) struct Listed<'a> {
    pub fluid: &'a [Point],
    pub wall: &'a [Point],
    pub mirrored: &'a [Point],
    /// Sources of the walls' images.
    pub wall_images: &'a [u32],
    pub mirror: Option<Mirror>,
}

impl ThinWalls<'_> {
    /// T4: how far particles around free ends may go, of what each is `allowed` [m].
    pub fn hold_ends(&self, x: &[f64], y: &[f64], h: &[f64], allowed: &mut [f64]) {
        let ends: Vec<[f64; 2]> =
            self.screens.iter().flat_map(|s| s.points.first().into_iter().chain(s.points.last())).copied().collect();
        for (k, allowed) in allowed.iter_mut().enumerate() {
            if ends.iter().any(|end| (x[k] - end[0]).hypot(y[k] - end[1]) < END_REACH * h[k]) {
                *allowed = allowed.min(END_SKIN * h[k]);
            }
        }
    }

    /// T1, T2: strike out of the lists of fluid around fluid, walls around fluid, fluid around walls and fluid around
    /// mirror points who does not see the other.
    pub(crate) fn strike(&self, listed: &Listed<'_>, [fluid, walls_of_fluid, of_wall, of_mirror]: [&mut Lists; 4]) {
        let sight = Sight::new(self.screens, listed.mirror);
        let seen = self.seen(listed);
        let at = |p: &Point| [p.x, p.y];
        let widest = |points: &[Point]| points.iter().map(|p| p.reach).fold(0.0, f64::max);
        // a particle beyond a screen lies as deep behind it at most, at a mitre twice as deep
        let deepest = self.walls.depth.iter().zip(&self.walls.share).filter(|(_, share)| share.is_some());
        let deepest = deepest.map(|(depth, _)| 2.0 * depth).fold(0.0, f64::max);
        let (widest_fluid, widest_wall) = (widest(listed.fluid), widest(listed.wall) + deepest);
        let look = |p: &Point, others: f64| {
            let radius = p.reach + others;
            sight.is_near(at(p), radius).then(|| sight.near(at(p), radius))
        };
        let free = |p: &Point, near: &[Piece], j: u32| {
            !near.iter().any(|piece| piece.parts(at(p), at(&listed.fluid[j as usize])))
        };
        let points = listed.fluid;
        fluid.retain(|k| look(&points[k], widest_fluid), |k, near, j| free(&points[k], near, j));
        walls_of_fluid
            .retain(|k| look(&points[k], widest_wall), |k, near, j| seen[j as usize].from(at(&points[k]), near));
        of_wall.retain(
            |k| look(&Point { reach: listed.wall[k].reach + deepest, ..listed.wall[k] }, widest_fluid + deepest),
            |k, near, j| seen[k].from(at(&points[j as usize]), near),
        );
        of_mirror.retain(|k| look(&listed.mirrored[k], widest_fluid), |k, near, j| free(&listed.mirrored[k], near, j));
    }

    /// Every boundary particle, images last, as it is looked at.
    fn seen(&self, listed: &Listed<'_>) -> Vec<Seen> {
        let (w, screens) = (self.walls, self.screens.len() as u32);
        let one = |(j, p): (usize, &Point)| {
            let (k, image) = if j < w.len() { (j, false) } else { (listed.wall_images[j - w.len()] as usize, true) };
            let Some(share) = w.share[k] else { return Seen { at: [p.x, p.y], own: None } };
            let screen = &self.screens[share.screen as usize];
            let (half, aside) = (screen.half_thickness, ASIDE * w.h[k]);
            let looked_at =
                if share.beyond { w.depth[k].max(half + aside) } else { w.depth[k].min(half - aside.min(0.5 * half)) };
            let out = w.depth[k] - looked_at;
            let (nx, ny) = (if image { -w.nx[k] } else { w.nx[k] }, w.ny[k]);
            let own = if image && !screen.own_image { screens + share.screen } else { share.screen };
            Seen { at: [p.x + out * nx, p.y + out * ny], own: Some((own, share.beyond)) }
        };
        listed.wall.iter().enumerate().map(one).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall() -> Sight {
        let points = vec![[0.0, 0.0], [0.0, 1.0]];
        Sight::new(&[Screen { points, ..Screen::default() }], Some(Mirror { at: -2.0 }))
    }

    #[test]
    fn a_screen_hides_what_is_behind_it_and_nothing_beyond_its_ends() {
        let sight = wall();
        assert!(!sight.free([-0.1, 0.5], [0.1, 0.5]) && !sight.free([0.1, 0.5], [-0.1, 0.5]));
        assert!(sight.free([0.1, 0.1], [0.1, 0.9]));
        assert!(sight.free([-0.1, 0.95], [0.1, 1.15]), "past the end");
        assert!(sight.free([0.0, 1.1], [0.0, 1.3]), "along its extension");
        assert!(!sight.free([-4.1, 0.5], [-3.9, 0.5]), "its image");
    }

    /// Around an end a particle sees each place once: fluid where it looks past the end, the face's own rows where it looks
    /// through the screen.
    #[test]
    fn a_face_is_seen_through_or_up_to_its_screen() {
        let sight = wall();
        let (p, beyond) = ([0.2, 0.8], |at| Seen { at, own: Some((0, true)) });
        let before = |at| Seen { at, own: Some((0, false)) };
        let near = sight.near(p, 1.0);
        for at in [[-0.2, 0.7], [-0.2, 1.1], [-0.2, 1.3], [0.1, 0.9]] {
            let free = sight.free(p, at);
            assert_ne!(beyond(at).from(p, &near), free, "{at:?}");
            assert_eq!(before(at).from(p, &near), free, "{at:?}");
        }
        let ordinary = Seen { at: [0.0, 0.9], own: None };
        assert!(!ordinary.from(p, &near), "an ordinary wall on the screen belongs to neither side");
    }
}
