//! When the flow about a section begins, and with which added keel.

use super::super::entry::SectionMotion;
use super::super::section::Section;

/// The flow begins at this share of the draught at which the chines are wet, or at which the wedge would be at the end.
pub(super) const BEGIN: f64 = 1.0 / 6.0;
/// The largest such share of a straight wedge, whose flow is nearly the similar one.
const LATEST_OF_WEDGE: f64 = 0.5;
/// The share of a straight wedge at constant speed without gravity, whose flow is the similar one.
const LATEST_OF_SIMILAR: f64 = 0.6;
/// Share of its speed that a free wedge has lost then at most, unless that is before `BEGIN`.
const SLOWED: f64 = 0.1;
/// And at the latest at this share of the draught at which the faces next to the keel are wet.
pub(super) const LATEST: f64 = 0.5;
/// Latest draught over V²/g on flat faces, and over V²/(g tan β) on steep ones: the similar flow has no gravity. Buoyancy is then below 0.5 % of its
/// load.
const LATEST_UNDER_GRAVITY: [f64; 2] = [0.02, 0.01];
/// Angle of the keel that is added to a round bottom [deg].
pub(super) const KEEL_DEG: f64 = 15.0;
/// Those that are tried one after the other under another blunt bottom: flat ones need a steeper keel [deg].
const KEELS_DEG: [f64; 3] = [KEEL_DEG, 20.0, 25.0];
/// Half width of the first flow about a blunt bottom, over that of its keel: a round one, and those that are tried under a flat keel [-].
const FIRST_WIDTHS: [f64; 3] = [0.8, 0.6, 0.8];
pub(super) const ROUND_KEEL: AddedKeel = AddedKeel { deg: KEEL_DEG, first: FIRST_WIDTHS[0] };

/// A keel that is added to a blunt bottom.
#[derive(Clone, Copy, Debug)]
pub(super) struct AddedKeel {
    /// Its angle [deg].
    pub deg: f64,
    /// Half width of the first flow, over that of the keel [-].
    pub first: f64,
}

/// The keels that are tried under a section, none steeper than its steepest place, and the first no steeper than the first face that needs no keel.
pub(super) fn keels(section: &Section) -> Vec<AddedKeel> {
    if section.radius().is_some() || !section.is_blunt() {
        return vec![ROUND_KEEL];
    }
    let first = section.first_steep_deg().unwrap_or(KEEL_DEG).min(KEEL_DEG);
    let others = KEELS_DEG[1..].iter().copied().filter(|keel| *keel < section.steepest_followed_deg());
    let widths = if section.is_round() { &FIRST_WIDTHS[..1] } else { &FIRST_WIDTHS[1..] };
    let angles = std::iter::once(first).chain(others);
    angles.flat_map(|deg| widths.iter().map(move |first| AddedKeel { deg, first: *first })).collect()
}

/// The draught at which the flow about a straight wedge begins [m]: that at which the wedge is `slowed` [m], between two shares of the `last` one [m].
pub(super) fn begin_of_wedge(motion: &SectionMotion, gravity: f64, last: f64, slowed: f64) -> f64 {
    let is_similar = matches!(motion, SectionMotion::Constant) && gravity == 0.0;
    let latest = if is_similar { LATEST_OF_SIMILAR } else { LATEST_OF_WEDGE };
    slowed.clamp(BEGIN * last, latest * last)
}

/// The draught at which the flow about faces of a `slope` [-] begins at the latest, for a speed [m/s] and a gravity [m/s²]; infinite without gravity [m].
pub(super) fn latest_under_gravity(speed: f64, gravity: f64, slope: f64) -> f64 {
    let [flat, steep] = LATEST_UNDER_GRAVITY;
    flat.min(steep / slope) * speed * speed / gravity.max(f64::MIN_POSITIVE)
}

/// Half width of the wetted bottom at which the water, of the added mass ½πρc², has taken the share `SLOWED` of the speed [m].
/// 0 of a motion that is given.
pub(super) fn slowed_at(motion: &SectionMotion, density: f64) -> f64 {
    match motion {
        SectionMotion::Constant => f64::INFINITY,
        SectionMotion::Given(_) => 0.0,
        SectionMotion::Free(mass) => (2.0 * SLOWED * mass / (std::f64::consts::PI * density)).sqrt(),
    }
}
