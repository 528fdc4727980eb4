//! Resolution that follows: the fine zone of an impact, as wide and deep as the present draught wants it (THEORY E26).

use fsi_coupling::Coupled;
use sph_core::FineZone;

use crate::observe::gauges;
use crate::scene::{Entry, Scene, auto_fine_zone};

/// Thickness of the fine layer beside the body [spacings].
const LAYER: f64 = 8.0;

/// The fine zone of a scene whose resolution follows its body.
pub struct Follower {
    entry: Entry,
    /// Draught and height of the body's origin at t = 0 [m].
    start: [f64; 2],
    /// The scene's fine zone, which is that of the last draught, over the one that theory finds for it [-].
    share: [f64; 2],
    zone: FineZone,
}

impl Follower {
    /// `None` where the fine zone stays as it is.
    pub fn of(scene: &Scene) -> Option<Follower> {
        let (entry, body) = scene.entry().zip(scene.body.as_ref())?;
        let (spacing, slope) = (scene.resolution.spacing, scene.resolution.growth - 1.0);
        let last = auto_fine_zone(&entry, spacing);
        let share = std::array::from_fn(|k| scene.resolution.fine_zone[k] / last[k]);
        let zone = FineZone { middle: scene.fine_zone_center(), layer: LAYER * spacing, spacing, slope, ..FineZone::default() };
        let start = [body.draught(), body.position[1]];
        scene.resolution.follow.then(|| Follower { entry, start, share, zone }.at(start[0]))
    }

    /// The zone as wide and deep as a draught [m] wants it, and no smaller than it was.
    fn at(mut self, draught: f64) -> Follower {
        self.grow(draught);
        self
    }

    fn grow(&mut self, draught: f64) {
        let [half_width, depth] = auto_fine_zone(&Entry { final_draught: draught, ..self.entry }, self.zone.spacing);
        self.zone.half_width = self.zone.half_width.max(self.share[0] * half_width);
        self.zone.depth = self.zone.depth.max(self.share[1] * depth);
    }

    /// The zone now.
    pub fn zone(&self) -> &FineZone {
        &self.zone
    }

    /// Let the zone grow to what the body's place now wants.
    pub fn follow(&mut self, system: &mut Coupled) {
        let Some((motion, outline)) = system.bodies().find_map(|b| Some((b.motion()?, b.outline()?))) else { return };
        self.grow(self.start[0] + self.start[1] - motion.position[1]);
        self.zone.edges.clear();
        for corners in outline.loops() {
            let ends = corners.iter().zip(corners.iter().cycle().skip(1));
            self.zone.edges.extend(ends.map(|(a, b)| [gauges::on(&motion, *a), gauges::on(&motion, *b)]));
        }
        system.fluid.fine_zone = Some(self.zone.clone());
    }
}
