//! The sea of a landing: what is refused, warnings, results (THEORY EN36–EN38).

use std::f64::consts::{PI, TAU};

use serde::Serialize;
use settings::{Problem, require, significant};
use water_entry::ditching::{Fuselage, Jonswap, Landing, Swell, Touchdown};
use water_entry::waves::linear_wave::STEEPEST;

use super::model::Scene;
use super::sea_keys::{SeaKeys, SeaState};

/// Height over length up to which the second harmonic, ½ k a of the amplitude, is below 8 % [-].
const STEEP: f64 = 0.05;
/// Shortest wave over the fuselage's breadth [-].
const SHORTEST: f64 = 4.0;
/// Slope of the surface across the flight that sections stand for [-]; 0.1 is 6 degrees of roll.
const ACROSS: f64 = 0.1;
/// Largest significant height over the length of the peak's wave [-]: developed seas have 0.04, the steepest about 0.07.
const STEEPEST_SEA: f64 = 0.07;

/// The swell of a scene; of regular waves the phase is not yet known.
pub(super) fn swell(scene: &Scene) -> Swell {
    let heading = |sea: &SeaKeys| sea.heading_deg.to_radians();
    match scene.sea.map(|sea| (sea, sea.state())) {
        Some((sea, Ok(SeaState::Regular(height, length, _)))) => {
            Swell::new(height, length, heading(&sea), scene.water.gravity)
        }
        Some((sea, Ok(SeaState::Irregular(spectrum)))) => {
            Swell::irregular(&spectrum, heading(&sea), scene.water.gravity)
        }
        _ => Swell::default(),
    }
}

/// The swell of a landing that touches it where its scene says, or where it first meets the waves of a spectrum.
pub(super) fn touched(scene: &Scene, landing: &Landing<'_>) -> Result<Swell, Problem> {
    let Some(sea) = scene.sea else { return Ok(Swell::default()) };
    let SeaState::Regular(_, _, touchdown) = sea.state()? else { return Ok(landing.swell_first_met()) };
    let refused = |expected: String| Problem::new("sea.touchdown", touchdown.text(), expected);
    let swell = landing.swell_touched_at(touchdown.phase()).map_err(|nearest| {
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
    let straight = format!(
        "at least {} m, {SHORTEST} times the fuselage's breadth: the surface is straight across a section",
        significant(shortest)
    );
    match sea.state()? {
        SeaState::Regular(height, length, _) => {
            require(length >= shortest, "sea.length", length, straight)?;
            let breaking = STEEPEST * length;
            let expected = format_args!(
                "below {} m, where a wave of {} m breaks (Miche 1944)",
                significant(breaking),
                significant(length)
            );
            require(height < breaking, "sea.height", height, expected)
        }
        SeaState::Irregular(Jonswap { significant_height, peak_period, .. }) => {
            let length = scene.water.gravity * peak_period * peak_period / TAU;
            let expected = format_args!("a period whose wave has {straight}, not {} m", significant(length));
            require(length >= shortest, "sea.peak_period", peak_period, expected)?;
            let most = STEEPEST_SEA * length;
            let expected = format_args!(
                "up to {} m, {STEEPEST_SEA} of the length of the peak's wave: steeper seas break",
                significant(most)
            );
            require(significant_height <= most, "sea.significant_height", significant_height, expected)
        }
    }
}

fn broadest(fuselage: &Fuselage) -> f64 {
    fuselage.stations().iter().map(|station| station.breadth).fold(0.0, f64::max)
}

/// What is said of the waves of a spectrum.
const OF_SPECTRUM: &str = "a sea of a spectrum is one sample of many: land on several values of sea.seed; waves shorter than 0.16 of the peak's and \
                           short crests are not in it";

/// What the waves have that the method has not.
pub(super) fn warnings(scene: &Scene, landing: &Landing<'_>) -> Vec<String> {
    let Some(sea) = scene.sea else { return Vec::new() };
    let Ok(SeaState::Regular(height, wave_length, touchdown)) = sea.state() else {
        return vec![OF_SPECTRUM.to_string()];
    };
    if height <= 0.0 {
        return Vec::new();
    }
    let steepness = height / wave_length;
    let steep = (steepness > STEEP).then(|| {
        format!(
            "sea.height is {} of sea.length: above {STEEP} crests are sharper than those of linear theory, the second harmonic is {} % of \
             the amplitude",
            significant(steepness),
            significant(50.0 * PI * steepness)
        )
    });
    let length = landing.hull.fuselage().length();
    let short = (wave_length < length).then(|| {
        let [waves, length] = [wave_length, length].map(significant);
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
            touchdown.text(),
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
    /// Phase of regular waves at the first contact, in the direction of flight: 0 crest, 90 down slope, 180 trough, 270 up slope [deg].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub touchdown_phase_deg: Option<f64>,
    /// Place of the first contact, from the nose [m].
    pub touchdown_at_m: f64,
    /// Height of the water there over still water [m].
    pub elevation_m: f64,
    /// Speed at which aeroplane and surface approach there [m/s].
    pub closing_speed_m_per_s: f64,
    /// Height over length of the waves; of a spectrum significant height over the length of the peak's wave [-].
    pub steepness: f64,
    /// Period of the waves, or of the peak of their spectrum [s].
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
            touchdown_phase_deg: swell
                .components
                .is_none()
                .then(|| rounded(touchdown.phase.to_degrees()).rem_euclid(360.0)),
            touchdown_at_m: touchdown.x,
            elevation_m: rounded(touchdown.elevation),
            closing_speed_m_per_s: touchdown.closing_speed,
            steepness: if swell.components.is_some() { 0.5 } else { 1.0 } * swell.steepness(),
            period_s: TAU / swell.angular_frequency,
            encounter_period_s: TAU / encounter.abs(),
        })
    }
}
