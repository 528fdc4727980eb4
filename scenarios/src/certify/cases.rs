//! The list of cases: every combination of the lists, or a stated part of it.

use serde::Serialize;
use settings::{Problem, significant};

use super::choices::{Choices, path};
use crate::ditching::{FailureKeys, LoadingKeys, MOST_CASES, Scene, SeaForm};

/// Force [N] and pressure [Pa] at which a part is lost with its first touch.
const AT_ONCE: &str = "1e-3";
/// Flight paths that a landing takes [deg].
const PATHS: [f64; 2] = [-15.0, -1e-3];
/// The golden ratio's fraction: multiples of it spread evenly.
const SPREAD: f64 = 0.618_033_988_749_895;

/// A case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Case {
    /// Its number in the list of all combinations, from 1.
    pub number: usize,
    /// Name of the loading.
    pub loading: String,
    /// Mass [kg].
    pub mass_kg: f64,
    /// Centre of mass from the nose [m].
    pub centre_m: f64,
    /// Pitch at the first touch [deg].
    pub pitch_deg: f64,
    /// Speed downwards [m/s].
    pub sink_m_per_s: f64,
    /// Forward speed [m/s]; absent where the wing cannot carry the weight.
    pub forward_m_per_s: Option<f64>,
    /// Height of regular waves, or significant height [m]; 0 on calm water.
    pub wave_height_m: f64,
    /// Length of regular waves [m].
    pub wave_length_m: Option<f64>,
    /// Period of the peak of a spectrum [s].
    pub peak_period_s: Option<f64>,
    /// Seed of a spectrum.
    pub seed: Option<u32>,
    /// Heading [deg]; absent on calm water.
    pub heading_deg: Option<f64>,
    /// Phase at the first contact [deg]; absent without regular waves.
    pub phase_deg: Option<f64>,
    /// State of the aeroplane.
    pub state: String,
    /// Overrides with which `splashdown ditch` repeats it.
    pub sets: Vec<String>,
    /// Why it cannot be run; absent for one that can be tried.
    pub outside: Option<String>,
}

/// The water of a case: sea, heading [deg], phase [deg], seed.
type Water<'a> = (Option<&'a SeaForm>, Option<f64>, Option<f64>, Option<u32>);

/// The cases that are run, and the number of all combinations.
pub fn cases(scene: &Scene, choices: &Choices) -> Result<(Vec<Case>, usize), Problem> {
    let waters: Vec<Water<'_>> = choices.seas.iter().flat_map(|sea| waters(choices, sea.as_ref())).collect();
    let counts = [
        choices.loadings.len(),
        choices.pitches.len(),
        choices.sinks.len(),
        choices.forwards.len(),
        waters.len(),
        choices.failures.len(),
    ];
    let all: usize = counts.iter().product();
    if all > MOST_CASES {
        let product = counts.map(|n| n.to_string()).join(" x ");
        let expected = format!("at most {MOST_CASES} combinations");
        return Err(Problem::new("certify", format!("{product} = {all} combinations"), expected));
    }
    let wanted = scene.certify.as_ref().and_then(|keys| keys.cases).unwrap_or(all);
    let numbers = spread(all, wanted.min(all));
    let case = |number: usize| {
        // the last list changes fastest
        let mut rest = number;
        let mut at = |k: usize| {
            let index = rest % counts[k];
            rest /= counts[k];
            index
        };
        let (failure, water, forward) = (at(5), at(4), at(3));
        let (sink, pitch, loading) = (at(2), at(1), at(0));
        let touch = [choices.pitches[pitch], choices.sinks[sink]];
        let (loading, failure) = (&choices.loadings[loading], choices.failures[failure].as_ref());
        one(scene, number + 1, loading, touch, choices.forwards[forward], waters[water], failure)
    };
    Ok((numbers.into_iter().map(case).collect(), all))
}

/// `wanted` numbers below `all`, in order: multiples of a step that has no divisor in common with `all`, the nearest to its golden section.
fn spread(all: usize, wanted: usize) -> Vec<usize> {
    let divides = |mut a: usize, mut b: usize| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    let middle = ((all as f64 * SPREAD).round() as usize).max(1);
    let step = (middle..=2 * all.max(1)).find(|step| divides(*step, all) == 1).unwrap_or(1);
    let mut numbers: Vec<usize> = (0..wanted).map(|k| k * step % all).collect();
    numbers.sort_unstable();
    numbers
}

/// The waters of a sea: each heading, and of it each phase or seed.
fn waters<'a>(choices: &Choices, sea: Option<&'a SeaForm>) -> Vec<Water<'a>> {
    let with = |heading: f64| -> Vec<Water<'a>> {
        match sea {
            Some(SeaForm::Irregular(_, _, seeds)) => {
                seeds.iter().map(|seed| (sea, Some(heading), None, Some(*seed))).collect()
            }
            _ => choices.phases.iter().map(|phase| (sea, Some(heading), Some(*phase), None)).collect(),
        }
    };
    match sea {
        None => vec![(None, None, None, None)],
        Some(_) => choices.headings.iter().copied().flat_map(with).collect(),
    }
}

fn one(
    scene: &Scene,
    number: usize,
    loading: &LoadingKeys,
    [pitch_deg, sink]: [f64; 2],
    forward: Option<f64>,
    water: Water<'_>,
    failure: Option<&FailureKeys>,
) -> Case {
    let craft = &scene.aeroplane;
    let mass = loading.mass.unwrap_or(craft.mass);
    let centre = loading.center_of_mass.unwrap_or(craft.center_of_mass);
    let flight = path(scene, mass * scene.water.gravity, pitch_deg.to_radians(), sink, forward);
    let mut sets = Vec::new();
    let mut set = |key: &str, value: String| sets.push(format!("{key}={value}"));
    if loading.mass.is_some() {
        set("aeroplane.mass", format!("{mass:?}"));
    }
    if loading.center_of_mass.is_some() {
        set("aeroplane.center_of_mass", format!("{centre:?}"));
    }
    if let Some(radius) = loading.radius_of_gyration {
        set("aeroplane.radius_of_gyration", format!("{radius:?}"));
    }
    let (outside, along) = match flight {
        None => (Some(format!("the wing has no lift at a pitch of {} degrees", significant(pitch_deg))), forward),
        Some([speed, angle]) => {
            let path_deg = angle.to_degrees();
            set("landing.angle_of_attack_deg", rounded(pitch_deg - path_deg));
            set("landing.flight_path_deg", rounded(path_deg));
            set("landing.speed", rounded(speed));
            (out_of_range(scene, speed, path_deg, sink), Some((1e9 * speed * angle.cos()).round() / 1e9))
        }
    };
    let (sea, heading, phase, seed) = water;
    match (sea, scene.sea.is_some()) {
        (None, false) => {}
        (None, true) => set("sea", "{ height = 0.0, length = 100.0, heading_deg = 0.0, touchdown = \"crest\" }".into()),
        (Some(SeaForm::Regular(height, length)), _) => {
            let [heading, phase] = [heading, phase].map(Option::unwrap_or_default);
            let waves = format!(
                "{{ height = {height:?}, length = {length:?}, heading_deg = {heading:?}, touchdown = {phase:?} }}"
            );
            set("sea", waves);
        }
        (Some(SeaForm::Irregular(height, period, _)), _) => {
            let heading = heading.unwrap_or_default();
            let of_spectrum = format!("significant_height = {height:?}, peak_period = {period:?}");
            let seed = seed.unwrap_or(1);
            set(
                "sea",
                format!("{{ spectrum = \"jonswap\", {of_spectrum}, heading_deg = {heading:?}, seed = {seed} }}"),
            );
        }
    }
    failure.into_iter().flat_map(|failure| lost(scene, failure)).for_each(|(key, value)| set(&key, value));
    let (wave_height_m, wave_length_m, peak_period_s) = match sea {
        None => (0.0, None, None),
        Some(SeaForm::Regular(height, length)) => (*height, Some(*length), None),
        Some(SeaForm::Irregular(height, period, _)) => (*height, None, Some(*period)),
    };
    Case {
        number,
        loading: loading.name.clone(),
        mass_kg: mass,
        centre_m: centre[0],
        pitch_deg,
        sink_m_per_s: sink,
        forward_m_per_s: along,
        wave_height_m,
        wave_length_m,
        peak_period_s,
        seed,
        heading_deg: heading,
        phase_deg: phase,
        state: failure.map_or("whole".into(), |failure| failure.name.clone()),
        sets,
        outside,
    }
}

/// A number for a `--set` argument: short, and the same to the bit where it is read again.
fn rounded(value: f64) -> String {
    format!("{:?}", (1e9 * value).round() / 1e9)
}

/// Why a flight is not one that planes of water can stand for.
fn out_of_range(scene: &Scene, speed: f64, path_deg: f64, sink: f64) -> Option<String> {
    let forward = speed * path_deg.to_radians().cos();
    let least = scene.landing.least_speed.unwrap_or_default();
    if forward <= least {
        return Some(format!(
            "outside the model's range: a forward speed of {} m/s, and landings end at landing.least_speed, {} m/s",
            significant((1e6 * forward).round() / 1e6),
            significant(least)
        ));
    }
    (!(PATHS[0]..=PATHS[1]).contains(&path_deg)).then(|| {
        format!(
            "outside the model's range: a flight path of {} degrees with {} m/s downwards; expected {} to {} degrees",
            significant(path_deg),
            significant(sink),
            PATHS[0],
            PATHS[1]
        )
    })
}

/// Overrides that take parts away or open exits.
fn lost(scene: &Scene, failure: &FailureKeys) -> Vec<(String, String)> {
    let is_lost = |name: &String| failure.lost.contains(name);
    let of = |table: &str, key: &str, names: Vec<&String>, value: &str| {
        let gone = names.into_iter().enumerate().filter(|(_, name)| is_lost(name));
        gone.map(|(k, _)| (format!("{table}[{k}].{key}"), value.to_string())).collect::<Vec<_>>()
    };
    let area = failure.open_area.map(|area| format!("{area:?}"));
    let openings = scene.openings.iter().map(|o| &o.name).collect();
    [
        of("surfaces", "breaks_at", scene.surfaces.iter().map(|s| &s.name).collect(), AT_ONCE),
        of("nacelles", "breaks_at", scene.nacelles.iter().map(|n| &n.name).collect(), AT_ONCE),
        of("panels", "gives_way_at", scene.panels.iter().map(|p| &p.name).collect(), AT_ONCE),
        of("struts", "breaks_at", scene.struts.iter().map(|s| &s.name).collect(), AT_ONCE),
        area.map_or(Vec::new(), |area| of("openings", "area", openings, &area)),
    ]
    .concat()
}

impl Case {
    /// The case in words.
    pub fn words(&self) -> String {
        let speed = self.forward_m_per_s.map_or("no speed".into(), |v| format!("{} m/s forwards", significant(v)));
        let [pitch, sink, height] = [self.pitch_deg, self.sink_m_per_s, self.wave_height_m].map(significant);
        let heading = self.heading_deg.map_or(String::new(), |h| format!(", heading {} degrees", significant(h)));
        let water = match (self.wave_length_m, self.peak_period_s) {
            (Some(length), _) => {
                let phase = self.phase_deg.map_or(String::new(), |p| format!(", phase {} degrees", significant(p)));
                format!("waves of {height} m by {} m{heading}{phase}", significant(length))
            }
            (None, Some(period)) => {
                let seed = self.seed.unwrap_or(1);
                format!("irregular sea of {height} m, {} s{heading}, seed {seed}", significant(period))
            }
            (None, None) => "calm water".into(),
        };
        format!(
            "loading {} ({} kg), pitch {pitch} degrees, {sink} m/s downwards, {speed}, {water}, {}",
            self.loading,
            significant(self.mass_kg),
            if self.state == "whole" { "whole aeroplane".to_string() } else { format!("state {}", self.state) }
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_of_the_list_is_spread_over_all_of_it() {
        for (all, wanted) in [(2025, 100), (78, 78), (7, 3), (1, 1), (1000, 999)] {
            let numbers = spread(all, wanted);
            assert!(numbers.len() == wanted && numbers.windows(2).all(|pair| pair[0] < pair[1]), "{all} {wanted}");
            assert!(numbers.last().is_some_and(|last| *last < all));
        }
        let gaps: Vec<usize> = spread(2025, 100).windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(gaps.iter().all(|gap| (5..=50).contains(gap)), "{gaps:?}");
    }

    #[test]
    fn a_wing_carries_the_weight_at_the_speed_of_its_case() -> Result<(), scene::SceneError> {
        let scene = crate::ditching::load("mercure", &[])?;
        let weight = scene.aeroplane.mass * scene.water.gravity;
        let [speed, angle] = path(&scene, weight, 0.19, 1.2, None).expect("a speed");
        assert!((scene.wing.lift(speed, 0.19 - angle) / weight - 1.0).abs() < 1e-9);
        assert!((speed * angle.sin() + 1.2).abs() < 1e-9);
        Ok(())
    }
}
