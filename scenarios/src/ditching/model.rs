//! A landing: its settings, as its file gives them, and what they must keep to.

use std::sync::LazyLock;

use fsi_coupling::entry_theory::EntryModel;
use fsi_coupling::entry_theory::ditching::{
    Aeroplane, Form, Fuselage, FuselageError, Hull, Landing, Station, Water, Wing,
};
use fsi_coupling::settings::{Problem, Schema, require};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::parts::{
    AccelerometerKeys, BeamKeys, MassKeys, NacelleKeys, PanelKeys, SurfaceKeys, bending, masses, nacelles, panels,
    surfaces,
};
use crate::scene::source::{LARGEST_NUMBER, word};

/// The schema of a landing's file.
pub fn schema() -> &'static Schema {
    static SCHEMA: LazyLock<Schema> = LazyLock::new(|| Schema::of::<Scene>("a landing"));
    &SCHEMA
}

/// A landing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Scene {
    /// A word that names the landing and its folder.
    pub name: String,
    /// What it is, in a line.
    #[serde(default)]
    pub description: String,
    /// Source of its numbers.
    #[serde(default)]
    pub source: String,
    /// Model of the sections: von_karman, wagner or mlm.
    #[serde(default = "usual::model")]
    pub model: EntryModel,
    /// Flight and its integration.
    pub landing: LandingKeys,
    /// The rigid aeroplane.
    pub aeroplane: AeroplaneKeys,
    /// The wing.
    pub wing: Wing,
    /// The water.
    #[serde(default)]
    pub water: Water,
    /// Sections of the fuselage, from the nose aft; two at least.
    pub stations: Vec<StationKeys>,
    /// Wing, flaps and tailplane, where they may meet the water.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub surfaces: Vec<SurfaceKeys>,
    /// Engines or floats.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub nacelles: Vec<NacelleKeys>,
    /// Parts of the bottom that give way.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub panels: Vec<PanelKeys>,
    /// Where accelerations are taken.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub accelerometers: Vec<AccelerometerKeys>,
    /// Known masses along the fuselage; the rest of the aeroplane's mass is spread so that its centre and radius of gyration hold.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub masses: Vec<MassKeys>,
    /// The fuselage bends.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beam: Option<BeamKeys>,
}

/// Table `[landing]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LandingKeys {
    /// Angle of the body axis over the flight path at the first touch [deg].
    pub angle_of_attack_deg: f64,
    /// Direction of flight at the first touch, upwards [deg].
    #[schemars(range(min = -15.0, max = -1e-3))]
    pub flight_path_deg: f64,
    /// Speed along the flight path at the first touch [m/s].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "where the wing carries the weight"))]
    pub speed: Option<f64>,
    /// End of time after the first touch [s].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub end: f64,
    /// Forward speed below which the landing ends [m/s].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "sqrt(g L), L the fuselage's length"))]
    pub least_speed: Option<f64>,
    /// Step of the integration [s].
    #[serde(default = "usual::step")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub step: f64,
    /// Interval between rows of the series, in whole steps [s].
    #[serde(default = "usual::sample_every")]
    pub sample_every: f64,
    /// Strips along the fuselage; stations are at their ends [-].
    #[serde(default = "usual::strips")]
    #[schemars(range(min = 20, max = 5000))]
    pub strips: usize,
}

/// Table `[aeroplane]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AeroplaneKeys {
    /// Mass [kg].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: f64,
    /// Radius of gyration in pitch, about the centre of mass [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius_of_gyration: f64,
    /// Centre of mass, from the nose and over the body axis [m].
    pub center_of_mass: [f64; 2],
}

/// An item of `[[stations]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StationKeys {
    /// Distance from the nose along the body axis [m].
    pub x: f64,
    /// Height of the keel over the body axis [m].
    pub keel: f64,
    /// Breadth between the edges at which the water separates [m].
    pub breadth: f64,
    /// Radius of a section that is an arc [m].
    #[schemars(extend("x-default" = "required unless deadrise_deg"))]
    pub radius: Option<f64>,
    /// Deadrise of a section that is a wedge [deg].
    #[schemars(extend("x-default" = "required unless radius"))]
    pub deadrise_deg: Option<f64>,
}

mod usual {
    use fsi_coupling::entry_theory::EntryModel;

    pub fn model() -> EntryModel {
        EntryModel::Mlm
    }
    pub fn step() -> f64 {
        0.001
    }
    pub fn sample_every() -> f64 {
        0.005
    }
    pub fn strips() -> usize {
        200
    }
}

impl Scene {
    /// The landing as a file.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a landing holds nothing that TOML cannot say")
    }
}

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
    aeroplane(&scene)?;
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
    let places = scene.accelerometers.iter().enumerate().map(|(k, a)| (format!("accelerometers[{k}].name"), &a.name));
    let mut known: Vec<&str> = Vec::new();
    for (key, name) in surfaces.chain(nacelles).chain(panels).chain(places) {
        word(&key, name)?;
        require(!known.contains(&name.as_str()), &key, name, "a name that nothing else has")?;
        known.push(name);
    }
    Ok(())
}

fn accelerometers(scene: &Scene) -> Result<(), Problem> {
    let highest = HIGHEST / scene.landing.sample_every;
    for (k, keys) in scene.accelerometers.iter().enumerate() {
        let expected =
            format_args!("up to {highest} Hz with a landing.sample_every of {} s", scene.landing.sample_every);
        require(keys.bandwidth <= highest, &format!("accelerometers[{k}].bandwidth"), keys.bandwidth, expected)?;
    }
    Ok(())
}

/// The aeroplane of a landing.
fn aeroplane(scene: &Scene) -> Result<Aeroplane, Problem> {
    let craft = &scene.aeroplane;
    Ok(Aeroplane {
        mass: craft.mass,
        inertia: craft.mass * craft.radius_of_gyration.powi(2),
        centre: craft.center_of_mass,
        wing: scene.wing,
        surfaces: surfaces(scene)?,
        nacelles: nacelles(scene)?,
        panels: panels(scene)?,
        bending: bending(scene, &masses(scene)?)?,
    })
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
        Problem { key, sentence, ..Problem::default() }
    };
    if !scene.model.is_formula() {
        return Err(Problem::new("model", scene.model.name(), "von_karman, wagner or mlm"));
    }
    Fuselage::new(&stations).and_then(|fuselage| Hull::new(fuselage, scene.model)).map_err(refused)
}

/// The landing of a scene that [`checked`] gave.
pub(super) fn landing<'a>(scene: &Scene, hull: &'a Hull) -> Landing<'a> {
    let keys = &scene.landing;
    Landing {
        hull,
        aeroplane: aeroplane(scene).unwrap_or_else(|problem| panic!("{}", problem.sentence)),
        water: scene.water,
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
