//! The sea of a landing: what is refused, warnings, results (THEORY EN36–EN38).

use std::f64::consts::{PI, TAU};

use serde::Serialize;
use settings::{Problem, require, significant};
use water_entry::ditching::{Fuselage, Landing, Swell, Touchdown};
use water_entry::waves::linear_wave::STEEPEST;

use super::model::Scene;

/// Height over length up to which the second harmonic, ½ k a of the amplitude, is below 8 % [-].
const STEEP: f64 = 0.05;
/// Shortest wave over the fuselage's breadth [-].
const SHORTEST: f64 = 4.0;
/// Slope of the surface across the flight that sections stand for [-]; 0.1 is 6 degrees of roll.
const ACROSS: f64 = 0.1;

/// The swell of a scene, its phase not yet known.
pub(super) fn swell(scene: &Scene) -> Swell {
    scene.sea.map_or(Swell::default(), |sea| {
        Swell::new(sea.height, sea.length, sea.heading_deg.to_radians(), scene.water.gravity)
    })
}

/// The swell of a landing that touches it where its scene says.
pub(super) fn touched(scene: &Scene, landing: &Landing<'_>) -> Result<Swell, Problem> {
    let Some(sea) = scene.sea else { return Ok(Swell::default()) };
    let refused = |expected: String| Problem::new("sea.touchdown", sea.touchdown.text(), expected);
    let swell = landing.swell_touched_at(sea.touchdown.phase()).map_err(|nearest| {
        let nearest = significant(nearest.to_degrees());
        refused(format!(
            "a phase at which a part of the aeroplane is the first to touch; the nearest is {nearest} degrees"
        ))
    })?;
    let Touchdown { closing_speed, .. } = Landing { swell, ..landing.clone() }.touchdown();
    if closing_speed > 0.0 {
        return Ok(swell);
    }
    let sinking = -landing.speed * landing.path.sin();
    let encounter = swell.encounter_frequency(landing.speed * landing.path.cos());
    let first = (sinking / (swell.amplitude * encounter.abs())).clamp(0.0, 1.0).asin().to_degrees();
    // the aeroplane leaves the surface on the down slope where it is faster than the waves
    let is_behind_crest = (encounter < 0.0) == (swell.along_flight >= 0.0);
    let [from, to] = if is_behind_crest { [first, 180.0 - first] } else { [180.0 + first, 360.0 - first] };
    let falls = significant(sinking - closing_speed);
    Err(refused(format!(
        "a phase outside {} to {} degrees: there the surface below the aeroplane falls at {falls} m/s and the aeroplane at {} m/s. \
         Less sea.height or a steeper landing.flight_path_deg makes the part smaller",
        significant(from),
        significant(to),
        significant(sinking)
    )))
}

/// Refuses waves that break or are too short for the sections.
pub(super) fn check(scene: &Scene, fuselage: &Fuselage) -> Result<(), Problem> {
    let Some(sea) = scene.sea else { return Ok(()) };
    let shortest = SHORTEST * broadest(fuselage);
    let expected = format_args!(
        "at least {} m, {SHORTEST} times the fuselage's breadth: the surface is straight across a section",
        significant(shortest)
    );
    require(sea.length >= shortest, "sea.length", sea.length, expected)?;
    let breaking = STEEPEST * sea.length;
    let expected = format_args!(
        "below {} m, where a wave of {} m breaks (Miche 1944)",
        significant(breaking),
        significant(sea.length)
    );
    require(sea.height < breaking, "sea.height", sea.height, expected)
}

fn broadest(fuselage: &Fuselage) -> f64 {
    fuselage.stations().iter().map(|station| station.breadth).fold(0.0, f64::max)
}

/// What the waves have that the method has not.
pub(super) fn warnings(scene: &Scene, landing: &Landing<'_>) -> Vec<String> {
    let Some(sea) = scene.sea.filter(|sea| sea.height > 0.0) else { return Vec::new() };
    let steepness = sea.height / sea.length;
    let steep = (steepness > STEEP).then(|| {
        format!(
            "sea.height is {} of sea.length: above {STEEP} crests are sharper than those of linear theory, the second harmonic is {} % of \
             the amplitude",
            significant(steepness),
            significant(50.0 * PI * steepness)
        )
    });
    let length = landing.hull.fuselage().length();
    let short = (sea.length < length).then(|| {
        let [waves, length] = [sea.length, length].map(significant);
        format!("sea.length = {waves} m is less than the fuselage's {length} m: it spans crests, and planes of water do not interact")
    });
    let across = PI * steepness * sea.heading_deg.to_radians().sin();
    let slanting = (across > ACROSS).then(|| {
        format!(
            "sea.heading_deg = {}: the surface slopes across the flight by up to {} degrees; roll and sections that meet it so are not modelled",
            sea.heading_deg,
            significant(across.atan().to_degrees())
        )
    });
    let early = landing.earlier_contact().map(|time| {
        format!(
            "sea.touchdown = {}: on a straight flight path the aeroplane would have met the water {} s before; the landing stands for one that \
             flares there",
            sea.touchdown.text(),
            significant(time)
        )
    });
    steep.into_iter().chain(short).chain(slanting).chain(early).collect()
}

/// Without the rounding of the phase: a zero is one, and has no sign.
fn rounded(value: f64) -> f64 {
    (1e9 * value).round() / 1e9 + 0.0
}

/// The sea of a landing in its summary.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Sea {
    /// Phase of the waves at the first contact, in the direction of flight: 0 crest, 90 down slope, 180 trough, 270 up slope [deg].
    pub touchdown_phase_deg: f64,
    /// Place of the first contact, from the nose [m].
    pub touchdown_at_m: f64,
    /// Height of the water there over still water [m].
    pub elevation_m: f64,
    /// Speed at which aeroplane and surface approach there [m/s].
    pub closing_speed_m_per_s: f64,
    /// Height over length of the waves [-].
    pub steepness: f64,
    /// Period of the waves [s].
    pub period_s: f64,
    /// Period at which the aeroplane meets them at the first touch [s].
    pub encounter_period_s: f64,
}

impl Sea {
    /// Of a landing whose scene has a sea.
    pub(super) fn of(scene: &Scene, landing: &Landing<'_>) -> Option<Sea> {
        let (swell, touchdown) = (scene.sea.map(|_| landing.swell)?, landing.touchdown());
        let encounter = swell.encounter_frequency(landing.speed * landing.path.cos());
        Some(Sea {
            touchdown_phase_deg: rounded(touchdown.phase.to_degrees()).rem_euclid(360.0),
            touchdown_at_m: touchdown.x,
            elevation_m: rounded(touchdown.elevation),
            closing_speed_m_per_s: touchdown.closing_speed,
            steepness: swell.steepness(),
            period_s: TAU / swell.angular_frequency,
            encounter_period_s: TAU / encounter.abs(),
        })
    }
}
