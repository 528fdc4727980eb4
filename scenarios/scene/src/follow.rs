//! Resolution that follows: the fine zone of an impact, as wide and deep as the present draughts want it (THEORY WC21).

use fsi_coupling::{Motion, Outline};
use sph_core::RefinementZone;

use crate::auto::auto_fine_zone;
use crate::impact::middle_of_wet;
use crate::{Entry, Scene};

/// Thickness of the fine layer beside a body [spacings].
const LAYER: f64 = 8.0;

/// The fine zone of a scene whose resolution follows its bodies.
pub struct Follower {
    bodies: Vec<Followed>,
    middle: f64,
    /// The scene's fine zone, which is that of the last draughts, over the one that theory finds for them [-].
    share: [f64; 2],
    spacing: f64,
    slope: f64,
}

/// A body that enters the water.
struct Followed {
    entry: Entry,
    /// Draught [m], and where the body's origin is [m], at t = 0.
    draught: f64,
    origin: [f64; 2],
    /// Its outline at t = 0, from the middle of the zone [m].
    outline: Vec<[f64; 2]>,
}

impl Followed {
    /// The middle of what is wet of it at a draught [m], from the middle of the zone [m].
    fn aside(&self, draught: f64) -> f64 {
        middle_of_wet(&self.outline, draught)
    }
}

impl Follower {
    /// `None` where the fine zone stays as it is.
    pub fn of(scene: &Scene) -> Option<Follower> {
        let (spacing, slope) = (scene.resolution.spacing, scene.resolution.growth - 1.0);
        let middle = scene.fine_zone_center();
        let followed = |(body, entry): (&crate::Body, Entry)| Followed {
            entry,
            draught: body.draught(),
            origin: body.position,
            outline: body.placed_outline().into_iter().map(|[x, y]| [x - middle, y]).collect(),
        };
        let bodies: Vec<Followed> = scene.entries().into_iter().map(followed).collect();
        if !scene.resolution.follow || bodies.is_empty() {
            return None;
        }
        let mut follower = Follower { bodies, middle, share: [1.0; 2], spacing, slope };
        let last = follower.extent(|body| [0.0, body.entry.final_draught]);
        follower.share = std::array::from_fn(|k| scene.resolution.fine_zone[k] / last[k]);
        Some(follower)
    }

    /// The scene's fine zone over the one that theory finds for its last draughts [-], shape (2).
    pub fn share(&self) -> [f64; 2] {
        self.share
    }

    /// The zone's middle at t = 0 [m], and its half width and depth [m], shape (2).
    pub fn at_start(&self) -> (f64, [f64; 2]) {
        let along = self.along(|body| body.draught);
        (self.middle + along, self.extent(|body| [-along, body.draught]))
    }

    /// How far the zone of a body alone is from the whole's middle, at a draught of what `at` says [m]; several stay within one [m].
    fn along(&self, at: impl Fn(&Followed) -> f64) -> f64 {
        match &self.bodies[..] {
            [body] => body.aside(at(body)),
            _ => 0.0,
        }
    }

    /// The zone for bodies that are where their motions say, in the order of the scene.
    pub fn zone(&self, placed: &[(Motion, &Outline)]) -> RefinementZone {
        let moved: Vec<[f64; 2]> = self
            .bodies
            .iter()
            .zip(placed)
            .map(|(body, (motion, _))| [motion.position[0] - body.origin[0], body.origin[1] - motion.position[1]])
            .collect();
        // one body takes its zone along
        let along = match &moved[..] {
            [[aside, sunk]] => aside + self.along(|body| body.draught + sunk),
            _ => 0.0,
        };
        let mut k = 0;
        let [half_width, depth] = self.extent(|body| {
            let [aside, sunk] = moved.get(k).copied().unwrap_or_default();
            k += 1;
            [aside - along, body.draught + sunk]
        });
        let edges = placed.iter().flat_map(|(motion, outline)| {
            let ends = outline.loops().iter().flat_map(|corners| corners.iter().zip(corners.iter().cycle().skip(1)));
            ends.map(|(a, b)| [motion.point(*a), motion.point(*b)])
        });
        RefinementZone {
            middle: self.middle + along,
            half_width,
            depth,
            edges: edges.collect(),
            layer: LAYER * self.spacing,
            spacing: self.spacing,
            slope: self.slope,
        }
    }

    /// Half width and depth that hold the zones of all bodies [m], each moved aside by and at a draught of what `at` says [m].
    fn extent(&self, mut at: impl FnMut(&Followed) -> [f64; 2]) -> [f64; 2] {
        let mut most = [0.0_f64; 2];
        for body in &self.bodies {
            let [aside, draught] = at(body);
            let [half_width, depth] = auto_fine_zone(&Entry { final_draught: draught, ..body.entry }, self.spacing);
            most = [most[0].max((body.aside(draught) + aside).abs() + half_width), most[1].max(depth)];
        }
        std::array::from_fn(|k| self.share[k] * most[k])
    }
}

/// The same scene with another end [s]; a fine zone that follows grows with the draughts at the end.
pub fn with_end(scene: &Scene, end: f64) -> Scene {
    let mut longer = scene.clone();
    longer.time.end = end;
    if let Some(follower) = Follower::of(scene) {
        // of the scene with the old zone, its last extent over its share is that of theory for the new end
        if let Some(theirs) = Follower::of(&longer) {
            let last = theirs.extent(|body| [0.0, body.entry.final_draught]);
            longer.resolution.fine_zone = std::array::from_fn(|k| follower.share[k] * last[k] / theirs.share[k]);
        }
    }
    longer
}
