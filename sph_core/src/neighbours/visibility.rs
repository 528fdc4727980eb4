//! Visibility across plate midlines (THEORY WA8, WA9): pairs that a midline separates are masked out of the neighbour lists.

use crate::neighbours::cells::Point;
use crate::neighbours::lists::Lists;
use crate::parallel;
use crate::planes::Mirror;
use crate::walls::Walls;
use crate::walls::midline::PlateMidline;

/// A thin wall's particle faces the water this far above its surface, in its smoothing lengths.
const ABOVE: f64 = 0.3;
/// Around an end lists last until a particle has moved this many smoothing lengths (WA8).
const END_SKIN: f64 = 0.25;
/// What counts as around an end, in smoothing lengths.
const END_REACH: f64 = 2.5;
/// A midline separates water whose nearest places of it are no farther apart along it than this many times the reach of the
/// two: the turns of a coil do not part what lies between them.
const ALONG: f64 = 4.0;

/// Where a particle is, seen from a midline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Zone {
    /// On its left, as it runs from its first corner to its last.
    Left,
    /// On its right.
    Right,
    /// Before its first corner.
    First,
    /// Past its last corner.
    Last,
}

/// Where a particle is, seen from a midline near by.
#[derive(Clone, Copy, Debug)]
struct Standing {
    midline: u32,
    zone: Zone,
    /// Length of the midline up to the place of it that is nearest [m].
    along: f64,
}

/// A midline as it stands at one moment, or its image.
struct Line {
    midline: u32,
    corners: Vec<[f64; 2]>,
    box_: [[f64; 2]; 2],
}

impl Line {
    fn is_near(&self, p: [f64; 2], radius: f64) -> bool {
        let [lo, hi] = self.box_;
        (0..2).all(|c| p[c] > lo[c] - radius && p[c] < hi[c] + radius)
    }

    /// WA8: the zone of p [m], by the nearest place of the line; `None` beyond `radius` [m].
    fn standing(&self, p: [f64; 2], radius: f64) -> Option<Standing> {
        if !self.is_near(p, radius) {
            return None;
        }
        let (sides, mut least, mut length) = (self.corners.len() - 1, radius * radius, 0.0);
        let mut found = None;
        for k in 0..sides {
            let (way, size) = self.way(k);
            let r = [p[0] - self.corners[k][0], p[1] - self.corners[k][1]];
            let free = r[0] * way[0] + r[1] * way[1];
            let along = free.clamp(0.0, size);
            let off = [r[0] - along * way[0], r[1] - along * way[1]];
            let square = off[0] * off[0] + off[1] * off[1];
            if square < least {
                // at a corner the bisector's normal tells the side
                let other = match free {
                    f if f < 0.0 && k > 0 => self.way(k - 1).0,
                    f if f > size && k + 1 < sides => self.way(k + 1).0,
                    _ => way,
                };
                let height = (way[0] + other[0]) * off[1] - (way[1] + other[1]) * off[0];
                let zone = match free {
                    f if f < 0.0 && k == 0 => Zone::First,
                    f if f > size && k + 1 == sides => Zone::Last,
                    _ if height > 0.0 => Zone::Left,
                    _ => Zone::Right,
                };
                (least, found) = (square, Some(Standing { midline: self.midline, zone, along: length + along }));
            }
            length += size;
        }
        found
    }

    /// Direction and length of side k.
    fn way(&self, k: usize) -> ([f64; 2], f64) {
        let way = [self.corners[k + 1][0] - self.corners[k][0], self.corners[k + 1][1] - self.corners[k][1]];
        let size = way[0].hypot(way[1]);
        (way.map(|w| w / size), size)
    }
}

/// Midlines as they stand at one moment, with their images.
#[derive(Default)]
pub(crate) struct Visibility {
    lines: Vec<Line>,
}

impl Visibility {
    /// Of midlines where they are now. Images count after the midlines themselves.
    pub fn new(midlines: &[PlateMidline], mirror: Option<Mirror>) -> Visibility {
        let line = |midline: usize, corners: Vec<[f64; 2]>| {
            let box_ = crate::walls::midline::bounds(corners.iter());
            Line { midline: midline as u32, corners, box_ }
        };
        let mut lines: Vec<Line> = midlines.iter().enumerate().map(|(k, s)| line(k, s.points.clone())).collect();
        if let Some(mirror) = mirror {
            let reflected = |s: &PlateMidline| s.points.iter().map(|p| [mirror.reflect(p[0]), p[1]]).collect();
            let strangers = midlines.iter().enumerate().filter(|(_, s)| !s.own_image);
            lines.extend(strangers.map(|(k, s)| line(midlines.len() + k, reflected(s))));
        }
        Visibility { lines }
    }

    fn standings(&self, p: [f64; 2], radius: f64) -> Vec<Standing> {
        self.lines.iter().filter_map(|line| line.standing(p, radius)).collect()
    }

    /// What p [m] sees within `reach` [m].
    pub fn from(&self, p: [f64; 2], reach: f64) -> View<'_> {
        View { visibility: self, standings: self.standings(p, reach), reach }
    }
}

/// What is seen from one place.
pub(crate) struct View<'a> {
    visibility: &'a Visibility,
    standings: Vec<Standing>,
    reach: f64,
}

impl View<'_> {
    /// WA8: true where no midline stands between the place and q [m].
    pub fn shows(&self, q: [f64; 2]) -> bool {
        self.standings.is_empty() || !separated(&self.standings, &self.visibility.standings(q, self.reach), self.reach)
    }
}

/// WA8: true where a midline has one on its left and the other on its right.
fn separated(a: &[Standing], b: &[Standing], reach: f64) -> bool {
    a.iter().any(|a| {
        b.iter().any(|b| {
            let opposite = matches!((a.zone, b.zone), (Zone::Left, Zone::Right) | (Zone::Right, Zone::Left));
            a.midline == b.midline && opposite && (a.along - b.along).abs() < ALONG * reach
        })
    })
}

/// A boundary particle as it is looked at: where the water stands that it faces.
#[derive(Clone, Debug, Default)]
struct Seen {
    /// Its own midline and zone, if it is a thin plate's.
    own: Option<(u32, Option<Zone>)>,
    standings: Vec<Standing>,
}

impl Seen {
    /// WA9: does fluid that stands so see it?
    fn from(&self, fluid: &[Standing], reach: f64) -> bool {
        let Some((own, zone)) = self.own else {
            return !separated(fluid, &self.standings, reach);
        };
        let faced = fluid.iter().any(|f| f.midline == own && Some(f.zone) == zone);
        faced && !separated(fluid, &self.standings, reach)
    }
}

/// Thin walls at the moment of a search.
#[derive(Clone, Copy)]
pub struct ThinWalls<'a> {
    /// Their midlines, where they are then.
    pub midlines: &'a [PlateMidline],
    /// All walls.
    pub walls: &'a Walls,
}

/// Positions of all listed particles, images included.
pub(crate) struct Listed<'a> {
    pub fluid: &'a [Point],
    pub wall: &'a [Point],
    pub mirrored: &'a [Point],
    /// Sources of the walls' images.
    pub wall_images: &'a [u32],
    pub mirror: Option<Mirror>,
}

impl ThinWalls<'_> {
    /// The ends of all midlines [m].
    pub(crate) fn ends(&self) -> Vec<[f64; 2]> {
        self.midlines.iter().flat_map(|s| s.points.first().into_iter().chain(s.points.last())).copied().collect()
    }

    /// WA8: how far a particle may go, of what it is `allowed` [m], that may be around an end.
    #[inline(always)]
    pub(crate) fn held_at_ends<'e>(
        mut ends: impl Iterator<Item = &'e [f64; 2]>,
        [x, y]: [f64; 2],
        h: f64,
        allowed: f64,
    ) -> f64 {
        let around = ends.any(|end| (x - end[0]).hypot(y - end[1]) < END_REACH * h);
        if around { allowed.min(END_SKIN * h) } else { allowed }
    }

    /// WA8, WA9: mask in the lists of fluid around fluid, walls around fluid, fluid around walls and fluid around
    /// mirror points all pairs that a midline separates.
    pub(crate) fn mask(&self, listed: &Listed<'_>, [fluid, walls_of_fluid, of_wall, of_mirror]: [&mut Lists; 4]) {
        let visibility = Visibility::new(self.midlines, listed.mirror);
        let widest = |points: &[Point]| points.iter().map(|p| p.reach).fold(0.0, f64::max);
        // a thin wall's particle lies as deep behind its midline at most, at a mitre twice as deep
        let thin = self.walls.depth.iter().zip(&self.walls.midline).filter(|(_, midline)| midline.is_some());
        let deepest = thin.map(|(depth, _)| 2.0 * depth).fold(0.0, f64::max);
        let reach = 2.0 * widest(listed.fluid).max(widest(listed.wall)) + deepest;
        let stand = |points: &[Point]| {
            let mut found = vec![Vec::new(); points.len()];
            parallel::gather_into(&mut found, |k| visibility.standings([points[k].x, points[k].y], reach));
            found
        };
        let (standing, of_mirrors) = (stand(listed.fluid), stand(listed.mirrored));
        let mut seen = vec![Seen::default(); listed.wall.len()];
        parallel::gather_into(&mut seen, |j| self.seen(j, listed, &visibility, reach));
        fluid.retain(|k, j| !separated(&standing[k], &standing[j as usize], reach));
        walls_of_fluid.retain(|k, j| seen[j as usize].from(&standing[k], reach));
        of_wall.retain(|k, j| seen[k].from(&standing[j as usize], reach));
        of_mirror.retain(|k, j| !separated(&of_mirrors[k], &standing[j as usize], reach));
    }

    /// Boundary particle j, or image, as it is looked at.
    fn seen(&self, j: usize, listed: &Listed<'_>, visibility: &Visibility, reach: f64) -> Seen {
        let (w, p) = (self.walls, &listed.wall[j]);
        let (k, image) = if j < w.len() { (j, false) } else { (listed.wall_images[j - w.len()] as usize, true) };
        let Some(midline) = w.midline[k] else {
            return Seen { own: None, standings: visibility.standings([p.x, p.y], reach) };
        };
        let (out, nx) = (w.depth[k] + ABOVE * w.h[k], if image { -w.nx[k] } else { w.nx[k] });
        let own_image = self.midlines[midline as usize].own_image;
        let own = if image && !own_image { self.midlines.len() as u32 + midline } else { midline };
        let mut standings = visibility.standings([p.x + out * nx, p.y + out * w.ny[k]], reach);
        let zone = standings.iter().find(|s| s.midline == own).map(|s| s.zone);
        standings.retain(|s| s.midline != own);
        Seen { own: Some((own, zone)), standings }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall() -> Visibility {
        let points = vec![[0.0, 0.0], [0.0, 0.4], [0.0, 1.0]];
        Visibility::new(&[PlateMidline { points, ..PlateMidline::default() }], Some(Mirror { at: -2.0 }))
    }

    fn free(p: [f64; 2], q: [f64; 2]) -> bool {
        let (there, back) = (wall().from(p, 1.0).shows(q), wall().from(q, 1.0).shows(p));
        assert_eq!(there, back, "{p:?} {q:?}");
        there
    }

    #[test]
    fn a_midline_separates_its_left_from_its_right_and_neither_from_what_is_past_its_ends() {
        assert!(!free([-0.1, 0.5], [0.1, 0.5]) && !free([-0.1, 0.99], [0.1, 0.98]));
        assert!(free([0.1, 0.1], [0.1, 0.9]));
        assert!(free([-0.1, 0.95], [0.1, 1.05]) && free([0.1, -0.05], [-0.1, 0.05]));
        assert!(!free([-4.1, 0.5], [-3.9, 0.5]), "its image");
    }

    /// Between the turns of a coil the nearer turn is on one side or the other: nothing parts the water there.
    #[test]
    fn the_turns_of_a_coil_do_not_part_the_water_between_them() {
        let points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-0.2, 1.0], [-0.2, -0.2], [1.0, -0.2]];
        let coil = Visibility::new(&[PlateMidline { points, ..PlateMidline::default() }], None);
        let from = |p| coil.from(p, 0.2);
        assert!(from([0.5, -0.11]).shows([0.5, -0.09]), "outside one turn, inside the other");
        assert!(!from([0.5, -0.01]).shows([0.5, 0.01]) && !from([0.5, -0.19]).shows([0.5, -0.21]));
    }

    #[test]
    fn a_bend_has_two_sides() {
        let points = vec![[-0.5, 0.5], [0.0, 0.0], [0.5, 0.5]];
        let bend = Visibility::new(&[PlateMidline { points, ..PlateMidline::default() }], None);
        assert!(!bend.from([0.0, 0.02], 0.3).shows([0.0, -0.02]));
        assert!(bend.from([0.05, -0.02], 0.3).shows([-0.05, -0.02]), "both below the corner");
    }
}
