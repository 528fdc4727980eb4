//! What a landing must keep to, and the values that it leaves open.

use std::ops::RangeInclusive;

use fsi_coupling::entry_theory::ditching::{
    Aeroplane, Form, Fuselage, FuselageError, Hull, Landing, Station, Water, Wing,
};

use super::model::{Scene, StationKeys};
use crate::scene::word::word;
use fsi_coupling::settings::Problem;

/// Most steps of a run.
const MOST_STEPS: f64 = 1e6;

/// The landing with everything filled in, if it is one.
pub(super) fn checked(mut scene: Scene) -> Result<Scene, Problem> {
    word("name", &scene.name)?;
    numbers(&scene)?;
    let hull = hull(&scene)?;
    let (landing, wing) = (&scene.landing, wing(&scene));
    let weight = scene.aeroplane.mass * scene.water.gravity;
    let attack = landing.angle_of_attack_deg.to_radians();
    let carrying = wing.carrying_speed(weight, attack);
    let speed = landing.speed.or(carrying);
    let expected = format!("more than wing.zero_lift_deg, {} degrees, or a landing.speed", scene.wing.zero_lift_deg);
    let key = "landing.angle_of_attack_deg";
    let speed = speed.ok_or_else(|| Problem::new(key, landing.angle_of_attack_deg, expected))?;
    let least = landing.least_speed.unwrap_or_else(|| (scene.water.gravity * hull.fuselage().length()).sqrt());
    if least >= speed {
        return Err(Problem::new(
            "landing.least_speed",
            least,
            format!("less than the speed of landing, {speed:.4} m/s"),
        ));
    }
    (scene.landing.speed, scene.landing.least_speed) = (Some(speed), Some(least));
    Ok(scene)
}

fn numbers(scene: &Scene) -> Result<(), Problem> {
    let landing = &scene.landing;
    let pitch = landing.angle_of_attack_deg + landing.flight_path_deg;
    if !(0.0..=30.0).contains(&pitch) {
        let expected = format!("an attitude of 0 to 30 degrees with landing.flight_path_deg, not {pitch}");
        return Err(Problem::new("landing.angle_of_attack_deg", landing.angle_of_attack_deg, expected));
    }
    within("landing.step", landing.step, landing.end / MOST_STEPS..=landing.end)?;
    within("landing.sample_every", landing.sample_every, landing.step..=landing.end)?;
    Ok(())
}

fn within(key: &str, value: f64, range: RangeInclusive<f64>) -> Result<(), Problem> {
    match range.contains(&value) {
        true => Ok(()),
        false => Err(Problem::new(key, value, format!("a number from {} to {}", range.start(), range.end()))),
    }
}

fn station(index: usize, keys: &StationKeys) -> Result<Station, Problem> {
    let key = |name: &str| format!("stations[{index}].{name}");
    let form = match (keys.radius, keys.deadrise_deg) {
        (Some(radius), None) => Form::Radius(radius),
        (None, Some(deadrise)) => Form::DeadriseDeg(deadrise),
        (Some(_), Some(given)) => {
            return Err(Problem::new(&key("deadrise_deg"), given, "a radius or a deadrise, not both"));
        }
        (None, None) => return Err(Problem::missing(&key("radius"), "a radius or deadrise_deg")),
    };
    Ok(Station { x: keys.x, keel: keys.keel, breadth: keys.breadth, form })
}

/// The hull of a landing.
pub(super) fn hull(scene: &Scene) -> Result<Hull, Problem> {
    let stations = scene.stations.iter().enumerate().map(|(k, s)| station(k, s)).collect::<Result<Vec<_>, _>>()?;
    let refused = |e: FuselageError| {
        let key = if scene.stations.is_empty() { "stations".into() } else { format!("stations[{}]", e.station) };
        let sentence = format!("`{key}`: {}", e.why);
        Problem { key, sentence }
    };
    if !scene.model.is_theory() {
        return Err(Problem::new("model", scene.model.name(), "von_karman, wagner or mlm"));
    }
    Fuselage::new(&stations).and_then(|fuselage| Hull::new(fuselage, scene.model)).map_err(refused)
}

fn wing(scene: &Scene) -> Wing {
    let keys = &scene.wing;
    Wing {
        area: keys.area,
        lift_slope: keys.lift_slope,
        zero_lift: keys.zero_lift_deg.to_radians(),
        chord: keys.chord,
        pitch_stiffness: keys.pitch_stiffness,
        pitch_damping: keys.pitch_damping,
        air_density: keys.air_density,
    }
}

/// The landing of a scene that [`checked`] gave.
pub(super) fn landing<'a>(scene: &Scene, hull: &'a Hull) -> Landing<'a> {
    let (keys, craft, water) = (&scene.landing, &scene.aeroplane, &scene.water);
    Landing {
        hull,
        aeroplane: Aeroplane {
            mass: craft.mass,
            inertia: craft.mass * craft.radius_of_gyration.powi(2),
            centre: craft.center_of_mass,
            wing: wing(scene),
        },
        water: Water {
            density: water.density,
            gravity: water.gravity,
            friction: water.friction,
            suction: water.suction,
        },
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
