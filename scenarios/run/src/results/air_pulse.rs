//! The pulse of the air under a flat bottom (THEORY WC27): over which time its peaks are means, and when it ends.

use scene::{Entry, Scene};

/// Averaging time and length of the pulse of that air over b/c [-].
const AIR_PULSE: [f64; 2] = [0.2, 2.2];

/// Averaging time [s] under a flat bottom whose trapped air the water's softness stands for, and the time after contact at which its pulse ends,
/// or an echo comes.
pub(super) fn air_pulse(scene: &Scene, entry: &Entry) -> Option<[f64; 2]> {
    let (air, sound) = (entry.cushion.filter(|_| scene.is_cushioned(entry))?, scene.sound_speed());
    let way = scene.tank.depth.min(0.5 * scene.tank.width - air.half_breadth);
    let [window, pulse] = AIR_PULSE.map(|share| share * air.half_breadth / sound);
    Some([window, pulse.min(2.0 * way / sound)])
}
