//! Resolution that follows a body: who says where the water is to be fine, and when that is asked (THEORY E26).

use sph_core::FineZone;

use crate::bodies::body::Motion;
use crate::coupling::coupled::Coupled;
use crate::geometry::outline::Outline;

/// Where the water is to be fine around a body: a function of where it is alone, so that a step that is taken back comes
/// again to the same bits.
pub type Focus = Box<dyn Fn(&Motion, &Outline) -> FineZone + Send + Sync>;

impl Coupled {
    /// The same system, whose water is halved where `focus` wants it finer than it is: asked before every step about the
    /// first body that has an outline.
    pub fn focused(mut self, focus: Focus) -> Coupled {
        self.focus = Some(focus);
        self
    }

    /// Ask once more.
    pub(crate) fn refocus(&mut self) {
        let Some(focus) = &self.focus else { return };
        let zone = self.bodies().find_map(|body| Some(focus(&body.motion()?, body.outline()?)));
        self.fluid.fine_zone = zone;
    }
}
