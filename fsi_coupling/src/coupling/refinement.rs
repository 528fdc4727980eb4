//! Refinement tracking: a refinement zone that moves with a body (THEORY WC21).

use sph_core::RefinementZone;

use crate::bodies::state::Motion;
use crate::geometry::outline::Outline;

/// The refinement zone around a body: a function of the body's motion and outline alone, so that a step that is restored and repeated
/// gives the same bits. It is evaluated before each step.
pub type RefinementRule = Box<dyn Fn(&Motion, &Outline) -> RefinementZone + Send + Sync>;
