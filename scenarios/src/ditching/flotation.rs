//! After the stop: how the aeroplane floats, and what runs into it (THEORY EN57, EN58).

use serde::Serialize;
use settings::{Problem, require};
use water_entry::ditching::{Afloat, Flooding, Fuselage, Opening, Volume};

use super::afloat_keys::DISCHARGE;
use super::model::Scene;

/// How the aeroplane floats.
#[derive(Clone, Debug, Serialize)]
pub struct Flotation {
    /// Does it float when it has stopped, before any water is in it?
    pub floats: bool,
    /// Height of the water over the body axis at the centre of mass, at rest without water inside [m].
    pub waterline_m: f64,
    /// Trim then, nose up [deg].
    pub trim_deg: f64,
    /// Volume of the fuselage over what the mass displaces [-].
    pub reserve: f64,
    /// Openings, and panels that gave way.
    pub openings: Vec<SillTime>,
    /// When it sank or found no trim within 31 degrees [s]; absent where it floated to the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sinks_at_s: Option<f64>,
    /// Water inside at the end [m³].
    pub inside_m3: f64,
    /// Height of the water and trim at the end, as above [m, deg], shape (2).
    pub at_end: [f64; 2],
    /// Time after the stop, water inside, height of the water, trim [s, m³, m, deg], shape (rows, 4).
    #[serde(skip)]
    pub series: Vec<[f64; 4]>,
}

/// A sill.
#[derive(Clone, Debug, Serialize)]
pub struct SillTime {
    /// Name of its opening.
    pub name: String,
    /// Area [m²].
    pub area_m2: f64,
    /// Its height over the water at rest without water inside [m].
    pub over_water_m: f64,
    /// When the water reaches it after the stop [s]; absent where it stays dry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reached_s: Option<f64>,
}

/// Refuses openings that are not on the fuselage.
pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    let [first, last] = [0, scene.stations.len() - 1].map(|k| scene.stations[k].x);
    for (k, opening) in scene.openings.iter().enumerate() {
        let inside = (first..=last).contains(&opening.sill[0]);
        let expected = format_args!("a place on the fuselage, from {first} to {last} m");
        require(inside, &format!("openings[{k}].sill"), format!("{:?}", opening.sill), expected)?;
    }
    Ok(())
}

/// How the aeroplane of a scene floats with panels lost, by name; `None` without `[flotation]` and `[[openings]]`.
pub(super) fn flotation(scene: &Scene, fuselage: &Fuselage, lost: &[String]) -> Option<Flotation> {
    if scene.flotation.is_none() && scene.openings.is_empty() {
        return None;
    }
    let end = scene.flotation.clone().unwrap_or_default().end;
    let given = scene.openings.iter().map(|o| Opening {
        name: o.name.clone(),
        sill: o.sill,
        area: o.area,
        discharge: o.discharge,
    });
    let holes = scene.panels.iter().filter(|panel| lost.contains(&panel.name)).map(|panel| {
        let x = 0.5 * (panel.from + panel.to);
        Opening {
            name: panel.name.clone(),
            sill: [x, fuselage.keel(x).height],
            area: panel.hole.unwrap_or((panel.to - panel.from) * fuselage.breadth(x)),
            discharge: DISCHARGE,
        }
    });
    let openings: Vec<Opening> = given.chain(holes).collect();
    let volume = Volume::of_fuselage(fuselage);
    let mass = scene.aeroplane.mass / scene.water.density;
    let centre = scene.aeroplane.center_of_mass;
    let afloat = Afloat { volume: &volume, mass, centre, gravity: scene.water.gravity, openings: &openings };
    let flooding = afloat.solve(end);
    let floats = flooding.is_some();
    let Flooding { states, reached, lost } = flooding.unwrap_or_else(|| Flooding {
        states: Vec::new(),
        reached: vec![None; openings.len()],
        lost: Some(0.0),
    });
    let row =
        |s: &water_entry::ditching::FloatingState| [s.time, s.inside, s.outer.level, s.outer.slope.atan().to_degrees()];
    let series: Vec<[f64; 4]> = states.iter().map(row).collect();
    let first = series.first().copied().unwrap_or([f64::NAN; 4]);
    let last = series.last().copied().unwrap_or([f64::NAN; 4]);
    let sill = |(opening, reached): (&Opening, Option<f64>)| SillTime {
        name: opening.name.clone(),
        area_m2: opening.area,
        over_water_m: states.first().map_or(f64::NAN, |s| opening.sill[1] - s.outer.at(opening.sill[0])),
        reached_s: reached,
    };
    Some(Flotation {
        floats,
        waterline_m: first[2],
        trim_deg: first[3],
        reserve: volume.whole() / mass,
        openings: openings.iter().zip(reached).map(sill).collect(),
        sinks_at_s: lost,
        inside_m3: last[1],
        at_end: [last[2], last[3]],
        series,
    })
}
