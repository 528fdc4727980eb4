//! When air and vapour matter, and what a run makes of them.

use std::f64::consts::FRAC_PI_2;

use settings::significant;

use super::compressibility::LEAST_SOUND_RATIO;
use crate::impact::{Entry, flat_contact_refused, use_the_impulse};
use crate::keys::{Body, Motion, Scene};
use crate::vocabulary::{Finding, Verdict};

/// Spacings across half a flat breadth from which the pressure of trapped air is good (THEORY WC27).
pub const LEAST_HALF_BREADTH: f64 = 10.0;
/// Largest difference of the speed of sound from that of trapped air [-].
const TOLERANCE: f64 = 0.05;
/// Least mass of a free body over the added mass of its flat bottom [-].
const LEAST_MASS: f64 = 0.5;

impl Scene {
    /// True where water is as soft as the air under the flat bottom that meets it (THEORY WC27).
    pub fn is_cushioned(&self, entry: &Entry) -> bool {
        self.body.as_ref().is_some_and(|body| self.is_cushioned_by(body, entry))
    }

    /// The same under any body.
    pub(crate) fn is_cushioned_by(&self, body: &Body, entry: &Entry) -> bool {
        if self.is_light(body, entry) {
            return false;
        }
        let wanted = self.cushion_sound_speed(entry);
        let near = |wanted: f64| (self.sound_speed() / wanted - 1.0).abs() <= TOLERANCE;
        !self.solver.is_incompressible() && wanted.is_some_and(near)
    }

    /// Speed of sound [m/s] at which water is as soft as the trapped air; `None` where the body is too fast for it in any direction.
    fn cushion_sound_speed(&self, entry: &Entry) -> Option<f64> {
        let fast = LEAST_SOUND_RATIO * self.fastest_speed();
        entry.cushion_sound_speed(self.water().density).filter(|sound| *sound >= fast * (1.0 - 1e-9))
    }

    /// True for a free body lighter than half of the water that moves with its flat bottom, (π/2)ρb²: Chuang's plate was heavy.
    fn is_light(&self, body: &Body, entry: &Entry) -> bool {
        let added = |half_breadth: f64| FRAC_PI_2 * self.water().density * half_breadth.powi(2);
        let Motion::Free(freedom) = &body.motion else { return false };
        entry.cushion.is_some_and(|air| freedom.mass < LEAST_MASS * added(air.half_breadth))
    }
}

impl Entry {
    /// Speed of sound [m/s] at which water of density ρ [kg/m³] is as soft as the air under a flat bottom (THEORY WC27); `None` where no
    /// air is trapped, or where the body is too fast for it.
    pub fn cushion_sound_speed(&self, density: f64) -> Option<f64> {
        let sound = self.cushion?.equivalent_sound_speed(density);
        (sound >= LEAST_SOUND_RATIO * self.fastest).then_some(sound)
    }
}

/// Averaging time and length of the pulse of the air under a flat bottom over b/c [-] (THEORY WC27).
const AIR_PULSE: [f64; 2] = [0.2, 2.2];
/// Band of the pressure of the air under a flat bottom (WC27), share of it [-].
const AIR_BAND: f64 = 0.3;

/// Averaging time [s] under a flat bottom whose trapped air the water's softness stands for, and the time after contact at which its pulse ends,
/// or an echo comes.
pub fn air_pulse(scene: &Scene, entry: &Entry) -> Option<[f64; 2]> {
    let (air, sound) = (entry.cushion.filter(|_| scene.is_cushioned(entry))?, scene.sound_speed());
    let way = scene.tank.depth.min(0.5 * scene.tank.width - air.half_breadth);
    let [window, pulse] = AIR_PULSE.map(|share| share * air.half_breadth / sound);
    Some([window, pulse.min(2.0 * way / sound)])
}

/// What may be said of a peak under a flat bottom at a time [s]; `pulse_end`: when the pulse of trapped air ends [s], where the water is as soft as
/// that air.
pub fn flat_finding(entry: &Entry, spacing: f64, pulse_end: Option<f64>, time: f64) -> Finding {
    let spacings = entry.cushion.map_or(0.0, |air| air.half_breadth / spacing);
    match pulse_end {
        None => (Verdict::Acoustic, None, Some(flat_contact_refused().into())),
        Some(_) if spacings < LEAST_HALF_BREADTH => {
            let why =
                format!("half the flat breadth is {} spacings; {LEAST_HALF_BREADTH} are needed", significant(spacings));
            (Verdict::NotResolved, None, Some(why.into()))
        }
        Some(end) if time <= end => (Verdict::Resolved, Some(AIR_BAND), None),
        Some(_) => {
            let why = "it comes after the pulse of the air under the flat bottom: an echo of the floor or the walls, or another contact";
            (Verdict::Acoustic, None, Some(why.into()))
        }
    }
}

/// Vapour pressure of water at 20 °C, relative to the atmosphere [Pa].
const VAPOUR: f64 = -99_000.0;

/// Tension that a fast body may cause, ½ρV², and that water holds beyond its vapour pressure.
pub(crate) fn vapour(scene: &Scene, entry: &Entry) -> Option<String> {
    let tension = 0.5 * scene.water().density * entry.fastest.powi(2);
    let bound =
        scene.solver.weakly_compressible().map(|fluid| fluid.scheme.cavitation_pressure.unwrap_or(f64::NEG_INFINITY));
    let cure = match bound {
        None => "solver = \"weakly_compressible\" has fluid.cavitation_pressure".to_string(),
        Some(_) => format!("fluid.cavitation_pressure = {VAPOUR} bounds it"),
    };
    (tension > -VAPOUR && bound.is_none_or(|bound| bound < VAPOUR)).then(|| {
        format!(
            "at {} m/s water may be under a tension of {} kPa, and vapour forms at {} kPa: {cure}",
            significant(entry.fastest),
            significant(1e-3 * tension),
            significant(-1e-3 * VAPOUR)
        )
    })
}

/// What becomes of the peak under a flat bottom.
pub(crate) fn flat_contact(scene: &Scene, body: &Body, entry: &Entry) -> Option<String> {
    if !entry.is_flat() {
        return None;
    }
    let Some(air) = entry.cushion else {
        return Some(format!("the peak force will be refused: {}", flat_contact_refused()));
    };
    let bounded = format!(
        "air trapped under the flat bottom bounds the pressure at about {} kPa for {} ms (Chuang 1966)",
        significant(1e-3 * air.largest_pressure()),
        significant(1e3 * air.duration())
    );
    let spacings = air.half_breadth / scene.resolution.spacing;
    if scene.is_cushioned_by(body, entry) {
        return (spacings < LEAST_HALF_BREADTH).then(|| {
            format!(
                "{bounded}: {} spacings across half the breadth, {LEAST_HALF_BREADTH} are needed: {} m would do for resolution.spacing",
                significant(spacings),
                significant(air.half_breadth / LEAST_HALF_BREADTH)
            )
        });
    }
    let cure = match scene.cushion_sound_speed(entry) {
        _ if scene.is_light(body, entry) => {
            format!("the body is lighter than half of the water that moves with it; {}", use_the_impulse())
        }
        None => format!("the body is too fast for water that is as soft; {}", use_the_impulse()),
        Some(sound) => format!(
            "with solver = \"weakly_compressible\" and fluid.sound_speed = {} m/s water is as soft",
            significant(sound)
        ),
    };
    Some(format!("the peaks will be refused: {bounded}, this run does not: {cure}"))
}
