//! The aeroplane of a landing, of its keys.

use std::f64::consts::TAU;

use settings::{Problem, require, significant};
use water_entry::EntryModel;
use water_entry::ditching::{Aeroplane, Bending, FuselageError, Masses, Nacelle, Panel, Rib, Surface};

use super::model::Scene;
use super::parts::{NacelleKeys, PanelKeys, SurfaceKeys};
use super::struts::struts;

/// Largest sag of a slowest mode under the weight, g/ω², over the fuselage's length [-]: beyond, bending is not linear.
const MOST_SAG: f64 = 0.1;
/// Largest product of the highest mode's frequency and the step.
const FASTEST: f64 = 1.0;

fn surface(keys: &SurfaceKeys, index: usize) -> Result<Surface, Problem> {
    let key = |name: &str| format!("surfaces[{index}].{name}");
    let [root, tip] = [keys.root, keys.tip];
    if root[1] < 0.0 {
        let expected = "a distance from the plane of symmetry of 0 or more: both sides are meant";
        return Err(Problem::new(&key("root"), format!("{root:?}"), expected));
    }
    if tip[1].total_cmp(&root[1]).is_le() {
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
fn surfaces(scene: &Scene) -> Result<Vec<Surface>, Problem> {
    scene.surfaces.iter().enumerate().map(|(k, keys)| surface(keys, k)).collect()
}

/// The nacelles of a landing.
fn nacelles(scene: &Scene) -> Result<Vec<Nacelle>, Problem> {
    scene.nacelles.iter().enumerate().map(|(k, keys)| nacelle(keys, k, scene.model)).collect()
}

/// The panels of a landing.
fn panels(scene: &Scene) -> Result<Vec<Panel>, Problem> {
    let (first, last) = (scene.stations[0].x, scene.stations[scene.stations.len() - 1].x);
    let panel = |(k, keys): (usize, &PanelKeys)| {
        let PanelKeys { from, to, gives_way_at, frame_height, drag, .. } = *keys;
        let key = |name: &str| format!("panels[{k}].{name}");
        require((first..last).contains(&from), &key("from"), from, format_args!("a place from {first} to {last} m"))?;
        let expected = format_args!("more than {}, {from} m, and up to {last} m", key("from"));
        require(to > from && to <= last, &key("to"), to, expected)?;
        let before = scene.panels[..k].iter().position(|other| from < other.to && other.from < to);
        if let Some(other) = before {
            let expected = format!("a part of the bottom that panels[{other}] does not take");
            return Err(Problem::new(&key("from"), format!("{from} to {to} m"), expected));
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
    if let Some(k) = known.iter().position(|[x, _]| !(ends[0]..=ends[1]).contains(x)) {
        let expected = format!("a place on the fuselage, from {} to {} m", ends[0], ends[1]);
        return Err(Problem::new(&format!("masses[{k}].x"), known[k][0], expected));
    }
    let (last, sum) = (known.len().saturating_sub(1), known.iter().map(|[_, mass]| mass).sum::<f64>());
    if sum >= craft.mass {
        let expected = format!("masses that leave something of aeroplane.mass, {} kg, not {sum} kg in all", craft.mass);
        return Err(Problem::new(&format!("masses[{last}].mass"), known[last][1], expected));
    }
    let (radius, centre) = (craft.radius_of_gyration, craft.center_of_mass);
    let inside = (ends[0]..=ends[1]).contains(&centre[0]);
    let expected = format_args!("a place on the fuselage, from {} to {} m from the nose", ends[0], ends[1]);
    require(inside, "aeroplane.center_of_mass", format_args!("{centre:?}"), expected)?;
    Masses::new(ends, craft.mass, craft.center_of_mass[0], craft.mass * radius * radius, &known)
        .map_err(|why| Problem::new("aeroplane.radius_of_gyration", radius, why))
}

/// How the fuselage bends, where it does.
fn bending(scene: &Scene, masses: &Masses) -> Result<Option<Bending>, Problem> {
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
    let slowest = bending.frequency.iter().copied().fold(f64::INFINITY, f64::min);
    let least = (scene.water.gravity / (MOST_SAG * (to - from))).sqrt();
    if slowest < least {
        let of = [least, slowest].map(|omega| significant(omega / TAU));
        return Err(refused(format!("a slowest mode of at least {} Hz, not {} Hz: bending is linear", of[0], of[1])));
    }
    let fastest = bending.frequency.iter().copied().fold(0.0, f64::max);
    let longest = FASTEST / fastest;
    if scene.landing.step > longest {
        let expected =
            format!("at most {longest:.2e} s: the fuselage's mode of {:.1} Hz is to be followed", fastest / TAU);
        return Err(Problem::new("landing.step", scene.landing.step, expected));
    }
    Ok(Some(bending))
}

/// The aeroplane of a landing.
pub(super) fn aeroplane(scene: &Scene) -> Result<Aeroplane, Problem> {
    let craft = &scene.aeroplane;
    Ok(Aeroplane {
        mass: craft.mass,
        inertia: craft.mass * craft.radius_of_gyration.powi(2),
        centre: craft.center_of_mass,
        wing: scene.wing,
        surfaces: surfaces(scene)?,
        nacelles: nacelles(scene)?,
        panels: panels(scene)?,
        struts: struts(scene)?,
        bending: bending(scene, &masses(scene)?)?,
    })
}
