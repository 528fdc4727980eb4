//! What the file of a landing must keep to, and the landing that it gives.

use scene::source::{LARGEST_NUMBER, word};
use settings::{Problem, require};
use water_entry::ditching::{Aeroplane, Fuselage, FuselageError, Hull, Landing, OF_LANDINGS};

use super::aeroplane::aeroplane;
use super::certify_check;
use super::flotation;
use super::model::{LandingKeys, Scene};
use super::plating_keys;
use super::sea;
use super::stations::station;
use super::windows::windows;

/// Most steps of a run.
const MOST_STEPS: f64 = 1e6;
/// Highest bandwidth of an accelerometer over the frequency of samples.
const HIGHEST: f64 = 0.2;

/// The landing with everything filled in, if it is one.
pub(super) fn checked(mut scene: Scene) -> Result<Scene, Problem> {
    word("name", &scene.name)?;
    numbers(&scene)?;
    let hull = hull(&scene)?;
    let (landing, wing) = (&scene.landing, scene.wing);
    let weight = scene.aeroplane.mass * scene.water.gravity;
    let attack = landing.angle_of_attack_deg.to_radians();
    let carrying = wing.carrying_speed(weight, attack);
    let speed = landing.speed.or(carrying);
    let expected = format!("more than wing.zero_lift_deg, {} degrees, or a landing.speed", scene.wing.zero_lift_deg);
    let key = "landing.angle_of_attack_deg";
    let speed = speed.ok_or_else(|| Problem::new(key, landing.angle_of_attack_deg, expected))?;
    let expected = format_args!("up to {LARGEST_NUMBER:e} m/s, or a wing that carries the weight at such a speed");
    require(speed <= LARGEST_NUMBER, "landing.speed", speed, expected)?;
    let least = landing.least_speed.unwrap_or_else(|| (scene.water.gravity * hull.fuselage().length()).sqrt());
    let expected = format_args!("less than the speed of landing, {speed:.4} m/s");
    require(least < speed, "landing.least_speed", least, expected)?;
    (scene.landing.speed, scene.landing.least_speed) = (Some(speed), Some(least));
    names(&scene)?;
    accelerometers(&scene)?;
    assumptions(&scene)?;
    windows(&scene.windows, &hull, scene.model)?;
    plating_keys::check(&scene.plating, &hull)?;
    flotation::check(&scene)?;
    certify_check::check(&scene)?;
    sea::check(&scene, hull.fuselage())?;
    sea::touched(&scene, &untouched(&scene, aeroplane(&scene)?, &hull))?;
    Ok(scene)
}

fn numbers(scene: &Scene) -> Result<(), Problem> {
    let landing = &scene.landing;
    let pitch = landing.angle_of_attack_deg + landing.flight_path_deg;
    let attack = landing.angle_of_attack_deg;
    let expected = format_args!("an attitude of 0 to 30 degrees with landing.flight_path_deg, not {pitch}");
    require((0.0..=30.0).contains(&pitch), "landing.angle_of_attack_deg", attack, expected)?;
    let LandingKeys { step, sample_every, end, .. } = *landing;
    for (key, value, least) in [("landing.step", step, end / MOST_STEPS), ("landing.sample_every", sample_every, step)]
    {
        let expected = format_args!("a number from {least} to {end}");
        require((least..=end).contains(&value), key, value, expected)?;
    }
    Ok(())
}

/// Names of parts and accelerometers are words, each once.
fn names(scene: &Scene) -> Result<(), Problem> {
    let surfaces = scene.surfaces.iter().enumerate().map(|(k, s)| (format!("surfaces[{k}].name"), &s.name));
    let nacelles = scene.nacelles.iter().enumerate().map(|(k, n)| (format!("nacelles[{k}].name"), &n.name));
    let panels = scene.panels.iter().enumerate().map(|(k, p)| (format!("panels[{k}].name"), &p.name));
    let struts = scene.struts.iter().enumerate().map(|(k, s)| (format!("struts[{k}].name"), &s.name));
    let windows = scene.windows.iter().enumerate().map(|(k, w)| (format!("windows[{k}].name"), &w.name));
    let plating = scene.plating.iter().enumerate().map(|(k, p)| (format!("plating[{k}].name"), &p.name));
    let openings = scene.openings.iter().enumerate().map(|(k, o)| (format!("openings[{k}].name"), &o.name));
    let places = scene.accelerometers.iter().enumerate().map(|(k, a)| (format!("accelerometers[{k}].name"), &a.name));
    let mut known: Vec<&str> = Vec::new();
    for (key, name) in
        surfaces.chain(nacelles).chain(panels).chain(struts).chain(windows).chain(plating).chain(openings).chain(places)
    {
        word(&key, name)?;
        require(!known.contains(&name.as_str()), &key, name, "a name that nothing else has")?;
        known.push(name);
    }
    Ok(())
}

/// Each a sentence on a line.
fn assumptions(scene: &Scene) -> Result<(), Problem> {
    let is_sentence = |said: &str| !said.trim().is_empty() && !said.chars().any(char::is_control);
    scene.assumptions.iter().enumerate().try_for_each(|(k, said)| {
        require(is_sentence(said), &format!("assumptions[{k}]"), format!("{said:?}"), "words on one line")
    })
}

fn accelerometers(scene: &Scene) -> Result<(), Problem> {
    let ends = [&scene.stations[0], &scene.stations[scene.stations.len() - 1]].map(|station| station.x);
    let highest = HIGHEST / scene.landing.sample_every;
    for (k, keys) in scene.accelerometers.iter().enumerate() {
        let expected =
            format_args!("up to {highest} Hz with a landing.sample_every of {} s", scene.landing.sample_every);
        let on_fuselage = (ends[0]..=ends[1]).contains(&keys.at[0]);
        let between = format_args!("a place on the fuselage, from {} to {} m", ends[0], ends[1]);
        require(on_fuselage, &format!("accelerometers[{k}].at"), format!("{:?}", keys.at), between)?;
        require(keys.bandwidth <= highest, &format!("accelerometers[{k}].bandwidth"), keys.bandwidth, expected)?;
    }
    Ok(())
}

/// The hull of a landing.
pub(super) fn hull(scene: &Scene) -> Result<Hull, Problem> {
    let stations = scene.stations.iter().enumerate().map(|(k, s)| station(k, s)).collect::<Result<Vec<_>, _>>()?;
    let refused = |e: FuselageError| {
        let key = if scene.stations.is_empty() { "stations".into() } else { format!("stations[{}]", e.station) };
        let sentence = format!("`{key}`: {}", e.why);
        Problem { key, sentence, ..Problem::default() }
    };
    if !OF_LANDINGS.contains(&scene.model) {
        return Err(Problem::new("model", scene.model.name(), "von_karman, wagner or mlm"));
    }
    Fuselage::new(&stations).and_then(|fuselage| Hull::new(fuselage, scene.model)).map_err(refused)
}

/// The landing of a scene that [`checked`] gave.
pub(super) fn landing<'a>(scene: &Scene, hull: &'a Hull) -> Landing<'a> {
    let refused = |problem: Problem| -> ! { panic!("{}", problem.sentence) };
    let landing = untouched(scene, aeroplane(scene).unwrap_or_else(|problem| refused(problem)), hull);
    Landing { swell: sea::touched(scene, &landing).unwrap_or_else(|problem| refused(problem)), ..landing }
}

/// The landing of a scene; the phase of its swell is not yet that of the first contact.
fn untouched<'a>(scene: &Scene, aeroplane: Aeroplane, hull: &'a Hull) -> Landing<'a> {
    let keys = &scene.landing;
    Landing {
        hull,
        aeroplane,
        water: scene.water,
        swell: sea::swell(scene),
        pitch: (keys.angle_of_attack_deg + keys.flight_path_deg).to_radians(),
        path: keys.flight_path_deg.to_radians(),
        speed: keys.speed.unwrap_or_default(),
        strips: keys.strips,
        step: keys.step,
        sample_every: (keys.sample_every / keys.step).round().max(1.0) as usize,
        end: keys.end,
        least_speed: keys.least_speed.unwrap_or_default(),
    }
}
