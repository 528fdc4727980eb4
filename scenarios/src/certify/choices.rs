//! The values of each list, and where they come from: the user, the rule, the landing, the program.

use std::f64::consts::FRAC_PI_2;

use serde::Serialize;
use settings::{Problem, significant};

use super::rule::Rule;
use crate::ditching::{CertifyKeys, FailureKeys, LoadingKeys, Scene, SeaForm};

/// Pitch around that of the file where no list is given [deg].
const PITCHES: [f64; 3] = [-2.0, 0.0, 2.0];
/// Speeds downwards over that of the file where neither a list nor a rule gives them [-].
const SINKS: [f64; 2] = [1.0, 1.5];
/// Headings and phases where no list is given [deg].
const HEADINGS: [f64; 3] = [0.0, 90.0, 180.0];
const PHASES: [f64; 4] = [0.0, 90.0, 180.0, 270.0];
/// Height and length of the waves where none are given [m].
const WAVES: [f64; 2] = [1.0, 100.0];

/// Repetitions of the search for the speed at which the wing carries the weight.
const REPETITIONS: usize = 50;

/// An input: what it is, its values in words, where they come from.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Input {
    /// What it is, with its unit.
    pub what: &'static str,
    /// Its values.
    pub values: String,
    /// Where they come from.
    pub origin: String,
}

/// The lists whose product is the list of cases.
#[derive(Clone, Debug)]
pub struct Choices {
    /// Masses and centres.
    pub loadings: Vec<LoadingKeys>,
    /// Pitch over the horizon [deg].
    pub pitches: Vec<f64>,
    /// Speeds downwards [m/s].
    pub sinks: Vec<f64>,
    /// Forward speeds [m/s]; `None`: where the wing carries the weight.
    pub forwards: Vec<Option<f64>>,
    /// Headings [deg].
    pub headings: Vec<f64>,
    /// Phases of regular waves [deg].
    pub phases: Vec<f64>,
    /// Calm water, `None`, and seas.
    pub seas: Vec<Option<SeaForm>>,
    /// The whole aeroplane, `None`, and states with parts lost.
    pub failures: Vec<Option<FailureKeys>>,
    /// All of these in words.
    pub inputs: Vec<Input>,
}

const USER: &str = "the user: [certify]";
const OF_FILE: &str = "the landing file";
const NO_NUMBER: &str = "this program; the rule states none";

/// Numbers in a row, with four digits.
fn row(values: &[f64]) -> String {
    values.iter().map(|v| significant(*v)).collect::<Vec<_>>().join(", ")
}

/// A given list, or another with its origin.
fn chosen(given: &Option<Vec<f64>>, otherwise: impl FnOnce() -> (Vec<f64>, String)) -> (Vec<f64>, String) {
    given.clone().map_or_else(otherwise, |values| (values, USER.to_string()))
}

impl Choices {
    /// Of a scene; `speed_is_given`: its file has a landing.speed.
    pub fn new(scene: &Scene, speed_is_given: bool) -> Result<Choices, Problem> {
        let keys = scene.certify.clone().unwrap_or_default();
        let rule = Rule::of(keys.rule);
        let landing = &scene.landing;
        let (speed, path) = (landing.speed.unwrap_or_default(), landing.flight_path_deg.to_radians());
        let (loadings, of_loadings) = match keys.loadings.is_empty() {
            true => (vec![own_loading()], OF_FILE),
            false => (keys.loadings.clone(), USER),
        };
        let (pitches, of_pitches) = chosen(&keys.pitches_deg, || {
            let own = landing.angle_of_attack_deg + landing.flight_path_deg;
            let of_own =
                PITCHES.map(|more| (1e9 * (own + more)).round() / 1e9).into_iter().filter(|p| (0.0..=30.0).contains(p));
            (of_own.collect(), format!("{OF_FILE}, {} degrees more, {NO_NUMBER}", row(&PITCHES)))
        });
        let (sinks, of_sinks) = chosen(&keys.sink_speeds, || match &rule.sink {
            Some(sinks) => (sinks.speeds(), format!("14 CFR {}: the least that it states", sinks.paragraph)),
            None => {
                let own = -speed * path.sin();
                let origin = format!("{OF_FILE}, {} times; {NO_NUMBER}", row(&SINKS));
                (SINKS.map(|factor| (1e3 * factor * own).round() / 1e3).to_vec(), origin)
            }
        });
        let (forwards, of_forwards) = match (&keys.forward_speeds, &rule.forward) {
            (Some(given), _) => (given.iter().copied().map(Some).collect(), USER.to_string()),
            (None, Some(of_rule)) => {
                let origin = format!("14 CFR {}: 0 to 30 kn", of_rule.paragraph);
                (of_rule.speeds().into_iter().map(Some).collect(), origin)
            }
            (None, None) if speed_is_given => (vec![Some(speed * path.cos())], OF_FILE.to_string()),
            (None, None) => (vec![None], NO_NUMBER.to_string()),
        };
        let (headings, of_headings) = chosen(&keys.headings_deg, || (HEADINGS.to_vec(), NO_NUMBER.to_string()));
        let (phases, of_phases) = chosen(&keys.phases_deg, || (PHASES.to_vec(), NO_NUMBER.to_string()));
        let (seas, of_seas) = seas(scene, &keys)?;
        let calm = keys.calm.then_some(None);
        let seas: Vec<Option<SeaForm>> = calm.into_iter().chain(seas.into_iter().map(Some)).collect();
        let (failures, of_failures) = failures(&keys);
        let known = |v: &Option<f64>| v.map_or("where the wing carries the weight".into(), significant);
        let speeds: Vec<String> = forwards.iter().map(known).collect();
        let state = |f: &Option<FailureKeys>| {
            f.as_ref().map_or("whole".into(), |f| format!("{}: {} lost", f.name, f.lost.join(", ")))
        };
        let input = |what, values: String, origin: &str| Input { what, values, origin: origin.to_string() };
        let inputs = vec![
            input("Masses and centres", joined(&loadings, |l| loading(l, scene)), of_loadings),
            input("Pitch at the first touch [deg]", row(&pitches), &of_pitches),
            input("Speed downwards [m/s]", row(&sinks), &of_sinks),
            input("Forward speed [m/s]", speeds.join(", "), &of_forwards),
            input("Seas", joined(&seas, sea), of_seas),
            input("Headings [deg]", row(&headings), &of_headings),
            input("Phases of regular waves at the first contact [deg]", row(&phases), &of_phases),
            input("State of the aeroplane", joined(&failures, state), of_failures),
        ];
        Ok(Choices { loadings, pitches, sinks, forwards, headings, phases, seas, failures, inputs })
    }
}

fn joined<T>(items: &[T], words: impl Fn(&T) -> String) -> String {
    items.iter().map(words).collect::<Vec<_>>().join("; ")
}

fn own_loading() -> LoadingKeys {
    LoadingKeys { name: "file".into(), mass: None, center_of_mass: None, radius_of_gyration: None }
}

fn loading(keys: &LoadingKeys, scene: &Scene) -> String {
    let craft = &scene.aeroplane;
    let [x, z] = keys.center_of_mass.unwrap_or(craft.center_of_mass);
    let [mass, x, z] = [keys.mass.unwrap_or(craft.mass), x, z].map(significant);
    format!("{}: {mass} kg at {x}, {z} m", keys.name)
}

/// A sea in words; `None` is calm water.
pub(super) fn sea(sea: &Option<SeaForm>) -> String {
    match sea {
        None => "calm".into(),
        Some(SeaForm::Regular(height, length)) => {
            format!("waves of {} m by {} m", significant(*height), significant(*length))
        }
        Some(SeaForm::Irregular(height, period, seeds)) => {
            let seeds: Vec<String> = seeds.iter().map(u32::to_string).collect();
            format!("JONSWAP of {} m, {} s, seeds {}", significant(*height), significant(*period), seeds.join(" "))
        }
    }
}

/// Seas beside calm water.
fn seas(scene: &Scene, keys: &CertifyKeys) -> Result<(Vec<SeaForm>, &'static str), Problem> {
    if let Some(seas) = &keys.seas {
        let all = seas.iter().enumerate().map(|(k, sea)| sea.form(&format!("certify.seas[{k}]")));
        return Ok((all.collect::<Result<_, _>>()?, USER));
    }
    let own = scene.sea.and_then(|sea| match (sea.height, sea.significant_height) {
        (Some(height), _) => Some(SeaForm::Regular(height, sea.length?)),
        (None, height) => Some(SeaForm::Irregular(height?, sea.peak_period?, vec![sea.seed.unwrap_or(1)])),
    });
    Ok(match own {
        Some(own) => (vec![own], OF_FILE),
        None => (
            vec![SeaForm::Regular(WAVES[0], WAVES[1])],
            "this program; the rule has no height of reasonably probable waves",
        ),
    })
}

/// States of the aeroplane.
fn failures(keys: &CertifyKeys) -> (Vec<Option<FailureKeys>>, &'static str) {
    let whole = keys.intact.then_some(None);
    let origin = if keys.failures.is_empty() { "this program: whole" } else { USER };
    (whole.into_iter().chain(keys.failures.iter().cloned().map(Some)).collect(), origin)
}

/// Speed along the path [m/s] and the path's angle [rad] of a landing with a pitch [rad] and a speed downwards [m/s]; the forward speed is given, or that at
/// which the wing carries the weight [N]. `None` where it cannot.
pub(super) fn path(scene: &Scene, weight: f64, pitch: f64, sink: f64, forward: Option<f64>) -> Option<[f64; 2]> {
    if let Some(forward) = forward {
        let angle = if forward > 0.0 { -(sink / forward).atan() } else { -FRAC_PI_2 };
        return Some([forward.hypot(sink), angle]);
    }
    let mut angle: f64 = 0.0;
    for _ in 0..REPETITIONS {
        let speed = scene.wing.carrying_speed(weight, pitch - angle)?;
        let next = -(sink / speed).clamp(-1.0, 1.0).asin();
        if (next - angle).abs() < 1e-12 {
            return Some([speed, next]);
        }
        angle = next;
    }
    Some([scene.wing.carrying_speed(weight, pitch - angle)?, angle])
}
