//! Resolution that follows: the fine zone of an impact, as wide and deep as the present draught wants it (THEORY WC21).

use fsi_coupling::{Motion, Outline};
use sph_core::RefinementZone;

use crate::auto::auto_fine_zone;
use crate::{Entry, Scene};

/// Thickness of the fine layer beside the body [spacings].
const LAYER: f64 = 8.0;

/// The fine zone of a scene whose resolution follows its body.
pub struct Follower {
    entry: Entry,
    /// Draught [m], and where the body's origin is [m], at t = 0.
    draught: f64,
    origin: [f64; 2],
    middle: f64,
    /// The scene's fine zone, which is that of the last draught, over the one that theory finds for it [-].
    share: [f64; 2],
    spacing: f64,
    slope: f64,
}

impl Follower {
    /// `None` where the fine zone stays as it is.
    pub fn of(scene: &Scene) -> Option<Follower> {
        let (entry, body) = scene.entry().zip(scene.body.as_ref())?;
        let (spacing, slope) = (scene.resolution.spacing, scene.resolution.growth - 1.0);
        let last = auto_fine_zone(&entry, spacing);
        let share = std::array::from_fn(|k| scene.resolution.fine_zone[k] / last[k]);
        let (draught, origin, middle) = (body.draught(), body.position, scene.fine_zone_center());
        scene.resolution.follow.then_some(Follower { entry, draught, origin, middle, share, spacing, slope })
    }

    /// The scene's fine zone over the one that theory finds for its last draught [-], shape (2).
    pub fn share(&self) -> [f64; 2] {
        self.share
    }

    /// Half width and depth of the zone at t = 0 [m], shape (2).
    pub fn at_start(&self) -> [f64; 2] {
        self.extent(self.draught)
    }

    /// The zone for a body that is where `motion` says.
    pub fn zone(&self, motion: &Motion, outline: &Outline) -> RefinementZone {
        let sunk = self.origin[1] - motion.position[1];
        let [half_width, depth] = self.extent(self.draught + sunk);
        let edges = outline.loops().iter().flat_map(|corners| {
            let ends = corners.iter().zip(corners.iter().cycle().skip(1));
            ends.map(|(a, b)| [motion.point(*a), motion.point(*b)])
        });
        RefinementZone {
            middle: self.middle + motion.position[0] - self.origin[0],
            half_width,
            depth,
            edges: edges.collect(),
            layer: LAYER * self.spacing,
            spacing: self.spacing,
            slope: self.slope,
        }
    }

    fn extent(&self, draught: f64) -> [f64; 2] {
        let wanted = auto_fine_zone(&Entry { final_draught: draught, ..self.entry }, self.spacing);
        std::array::from_fn(|k| self.share[k] * wanted[k])
    }
}

/// The same scene with another end [s]; a fine zone that follows grows with the draught at the end.
pub fn with_end(scene: &Scene, end: f64) -> Scene {
    let mut longer = scene.clone();
    longer.time.end = end;
    if let (Some(follower), Some(entry)) = (Follower::of(scene), longer.entry()) {
        let last = auto_fine_zone(&entry, scene.resolution.spacing);
        longer.resolution.fine_zone = std::array::from_fn(|k| follower.share[k] * last[k]);
    }
    longer
}
