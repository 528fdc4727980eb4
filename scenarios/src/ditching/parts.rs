//! Parts of a landing's aeroplane beside the bottom of its fuselage: their keys, and what they become.

use fsi_coupling::entry_theory::EntryModel;
use fsi_coupling::entry_theory::ditching::{Bending, FuselageError, Masses, Nacelle, Panel, Rib, Surface};
use fsi_coupling::settings::Problem;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::model::Scene;

/// An item of `[[surfaces]]`: a wing, a flap or a tailplane whose lower side may meet the water, on both sides of the aeroplane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SurfaceKeys {
    /// A word that names it.
    pub name: String,
    /// Leading edge at the root: from the nose, from the plane of symmetry, over the body axis [m].
    pub root: [f64; 3],
    /// Leading edge at the tip, likewise [m].
    pub tip: [f64; 3],
    /// Chord at the root and at the tip [m].
    pub chords: [f64; 2],
    /// Angle of the chord over the body axis, nose up [deg].
    #[schemars(range(min = -20.0, max = 80.0))]
    pub incidence_deg: f64,
    /// Force of the water at which it is lost [N].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "it holds"))]
    pub breaks_at: Option<f64>,
}

/// An item of `[[nacelles]]`: engines or floats.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NacelleKeys {
    /// A word that names them.
    pub name: String,
    /// How many of them side by side.
    #[schemars(range(min = 1, max = 12))]
    pub number: u32,
    /// Centre of the face: from the nose, over the body axis [m].
    pub face: [f64; 2],
    /// Diameter [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub diameter: f64,
    /// Length [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: f64,
    /// Drag coefficient of the immersed part of the face [-].
    #[serde(default = "usual_drag")]
    #[schemars(range(min = 0.0, max = 2.0))]
    pub drag: f64,
    /// Force of the water on one at which it is lost [N].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "it holds"))]
    pub breaks_at: Option<f64>,
}

/// An item of `[[panels]]`: a part of the bottom that gives way; then it bears nothing, and the frame at its rear end stands against the water.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PanelKeys {
    /// A word that names it.
    pub name: String,
    /// Front end, from the nose [m].
    pub from: f64,
    /// Rear end, from the nose [m].
    pub to: f64,
    /// Mean pressure over the breadth at which it gives way [Pa].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub gives_way_at: f64,
    /// Height of the frame at its rear end over the keel [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub frame_height: f64,
    /// Drag coefficient of the frame's immersed part [-].
    #[serde(default = "usual_drag")]
    #[schemars(range(min = 0.0, max = 2.0))]
    pub drag: f64,
}

/// A disc in a cavity (Reichardt 1946).
fn usual_drag() -> f64 {
    0.8
}

/// An item of `[[accelerometers]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AccelerometerKeys {
    /// A word that names it.
    pub name: String,
    /// Place: from the nose, over the body axis [m].
    pub at: [f64; 2],
    /// Frequency up to which it follows [Hz].
    #[serde(default = "usual_bandwidth")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bandwidth: f64,
}

fn usual_bandwidth() -> f64 {
    20.0
}

/// An item of `[[masses]]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MassKeys {
    /// Place from the nose [m].
    pub x: f64,
    /// Mass [kg].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: f64,
}

/// Table `[beam]`: the fuselage bends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BeamKeys {
    /// Bending stiffness E I at equal distances from nose to tail [N m²]; one number: the same everywhere.
    pub stiffness: Vec<f64>,
    /// Damping of each mode over the critical one [-].
    #[serde(default = "usual_damping")]
    #[schemars(range(min = 0.0, max = 0.5))]
    pub damping: f64,
}

fn usual_damping() -> f64 {
    0.02
}

/// Largest product of the highest mode's frequency and the step.
const FASTEST: f64 = 1.0;

fn surface(keys: &SurfaceKeys, index: usize) -> Result<Surface, Problem> {
    let key = |name: &str| format!("surfaces[{index}].{name}");
    let [root, tip] = [keys.root, keys.tip];
    if !(root[1] >= 0.0 && tip[1] > root[1]) {
        return Err(Problem::new(
            &key("tip"),
            format!("{tip:?}"),
            "a tip further from the plane of symmetry than the root",
        ));
    }
    if !keys.chords.iter().all(|chord| *chord > 0.0) {
        return Err(Problem::new(&key("chords"), format!("{:?}", keys.chords), "chords above 0"));
    }
    Ok(Surface {
        name: keys.name.clone(),
        ribs: [0, 1].map(|k| Rib { leading_edge: [root, tip][k], chord: keys.chords[k] }),
        incidence: keys.incidence_deg.to_radians(),
        breaks_at: keys.breaks_at,
    })
}

fn nacelle(keys: &NacelleKeys, index: usize, model: EntryModel) -> Result<Nacelle, Problem> {
    let refused = |e: FuselageError| Problem::new(&format!("nacelles[{index}].diameter"), keys.diameter, e.why);
    let NacelleKeys { face, diameter, length, drag, breaks_at, .. } = *keys;
    Nacelle::new(keys.name.clone(), f64::from(keys.number), face, diameter, length, drag, breaks_at, model)
        .map_err(refused)
}

/// The surfaces of a landing.
pub(super) fn surfaces(scene: &Scene) -> Result<Vec<Surface>, Problem> {
    scene.surfaces.iter().enumerate().map(|(k, keys)| surface(keys, k)).collect()
}

/// The nacelles of a landing.
pub(super) fn nacelles(scene: &Scene) -> Result<Vec<Nacelle>, Problem> {
    scene.nacelles.iter().enumerate().map(|(k, keys)| nacelle(keys, k, scene.model)).collect()
}

/// The panels of a landing.
pub(super) fn panels(scene: &Scene) -> Result<Vec<Panel>, Problem> {
    let (first, last) = (scene.stations[0].x, scene.stations[scene.stations.len() - 1].x);
    let panel = |(k, keys): (usize, &PanelKeys)| {
        let PanelKeys { from, to, gives_way_at, frame_height, drag, .. } = *keys;
        if !(from >= first && to > from && to <= last) {
            let expected = format!("more than panels[{k}].from, both from {first} to {last} m");
            return Err(Problem::new(&format!("panels[{k}].to"), to, expected));
        }
        Ok(Panel { name: keys.name.clone(), ends: [from, to], gives_way_at, frame_height, drag })
    };
    scene.panels.iter().enumerate().map(panel).collect()
}

/// The masses along the fuselage.
pub(super) fn masses(scene: &Scene) -> Result<Masses, Problem> {
    let (craft, stations) = (&scene.aeroplane, &scene.stations);
    let known: Vec<[f64; 2]> = scene.masses.iter().map(|m| [m.x, m.mass]).collect();
    let ends = [stations[0].x, stations[stations.len() - 1].x];
    let radius = craft.radius_of_gyration;
    Masses::new(ends, craft.mass, craft.center_of_mass[0], craft.mass * radius * radius, &known)
        .map_err(|why| Problem::new("aeroplane.radius_of_gyration", radius, why))
}

/// How the fuselage bends, where it does.
pub(super) fn bending(scene: &Scene, masses: &Masses) -> Result<Option<Bending>, Problem> {
    let Some(beam) = &scene.beam else { return Ok(None) };
    let refused = |expected: String| Problem::new("beam.stiffness", format!("{:?}", beam.stiffness), expected);
    if beam.stiffness.is_empty() || !beam.stiffness.iter().all(|ei| *ei > 0.0 && ei.is_finite()) {
        return Err(refused("numbers above 0".into()));
    }
    let (from, to) = (masses.x[0], masses.x[masses.x.len() - 1]);
    let stiffness = |x: f64| {
        let last = beam.stiffness.len() - 1;
        let at = (x - from) / (to - from) * last as f64;
        let k = (at as usize).min(last.saturating_sub(1));
        let [a, b] = [beam.stiffness[k], beam.stiffness[(k + 1).min(last)]];
        a + (at - k as f64) * (b - a)
    };
    let bending = Bending::new(masses, stiffness, beam.damping).map_err(refused)?;
    let fastest = bending.frequency.iter().copied().fold(0.0, f64::max);
    let longest = FASTEST / fastest;
    if scene.landing.step > longest {
        let expected =
            format!("at most {longest:.2e} s: the fuselage's mode of {:.1} Hz is to be followed", fastest / 6.2832);
        return Err(Problem::new("landing.step", scene.landing.step, expected));
    }
    Ok(Some(bending))
}
