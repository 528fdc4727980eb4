//! Which sections of a landing's plating are followed: for each bay and cell the plane of water that presses most there.

use water_entry::ditching::{GirthPressure, Hull, Landing, LandingResult, PlaneHistory};

use super::plate_strip::{static_stress, wet_period};
use super::plating_keys::{PlateMaterial, PlatingKeys};

/// A section is followed while its speed is more than this share of that at the contact [-].
const SLOW: f64 = 0.05;
/// And while its draught is less than this share of the breadth [-].
const DEEP: f64 = 0.95;
/// Planes of water are one where they are nearer than this share of the length of a cell [-].
const SAME: f64 = 0.25;
/// After the chosen load a section is followed for this share of the time from the contact to it [-], and for a wet period of the bay.
const AFTER: f64 = 0.25;
/// A plane is chosen that stays on the plating for this share of a wet period after the chosen load [-].
const STAYS: f64 = 0.5;

/// A value of a cell: stress [Pa], time [s], place from the nose [m], and whether it is doubtful.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Place {
    pub value: f64,
    pub time: f64,
    pub x: f64,
    pub doubtful: bool,
}

impl Place {
    /// The larger of two.
    pub fn keep(&mut self, other: Place) {
        if other.value > self.value {
            *self = other;
        }
    }
}

/// A section to follow with one of its bays.
pub(super) struct Chosen<'a> {
    pub keys: &'a PlatingKeys,
    pub plate: PlateMaterial,
    pub bay: usize,
    /// Where and when it presses most, and the stress at rest then.
    pub load: Place,
    /// Its way, or why there is none.
    pub history: Result<PlaneHistory, String>,
}

/// EN64: largest stress of each bay and cell under the mean pressure of the landing's theory at rest, shape (bays, cells).
pub(super) fn at_rest(landing: &Landing<'_>, run: &LandingResult, keys: &PlatingKeys) -> Vec<Vec<Place>> {
    loads(landing, run, keys, |_, _| true)
}

/// The same of places that count.
fn loads(
    landing: &Landing<'_>,
    run: &LandingResult,
    keys: &PlatingKeys,
    counts: impl Fn(usize, &Place) -> bool,
) -> Vec<Vec<Place>> {
    let bays = keys.bays();
    let mut cells = vec![vec![Place::default(); keys.sections]; bays.len()];
    for now in &run.moments {
        for (strip, force) in &now.strips {
            let Some(part) = strip.entry.filter(|part| (keys.from..=keys.to).contains(&part.at.x)) else { continue };
            let density = landing.water.density;
            let Some(pressure) = GirthPressure::new(landing.hull, &part, *force, &now.acceleration, density) else {
                continue;
            };
            let (x, girth) = (part.at.x, landing.hull.girth(part.at.x));
            for (k, (bay, cells)) in bays.iter().zip(&mut cells).enumerate() {
                let ends = bay.girth.map(|share| share * girth);
                let mean = pressure.over(ends) / (ends[1] - ends[0]);
                let value = static_stress(keys, bay, ends[1] - ends[0], mean);
                let place = Place { value, time: now.time, x, doubtful: false };
                if counts(k, &place) {
                    cells[cell(keys, x)].keep(place);
                }
            }
        }
    }
    cells
}

/// The cell of a plating that a place is in.
pub(super) fn cell(keys: &PlatingKeys, x: f64) -> usize {
    (((x - keys.from) / (keys.to - keys.from) * keys.sections as f64) as usize).min(keys.sections - 1)
}

/// The sections of a plating: for each bay and cell the plane of water that presses most there, each plane of a bay once, the most loaded first.
/// The plane stays on the plating for half a wet period of the bay, where one does.
pub(super) fn choose<'a>(
    landing: &Landing<'_>,
    run: &LandingResult,
    (keys, plate): (&'a PlatingKeys, PlateMaterial),
) -> Vec<Chosen<'a>> {
    let bays = keys.bays();
    let period = |k: usize, x: f64| {
        let length = (bays[k].girth[1] - bays[k].girth[0]) * landing.hull.girth(x);
        wet_period(keys, &plate, &bays[k], length, landing.water.density)
    };
    let leaves = |k: usize, place: &Place| place.x + STAYS * landing.speed * period(k, place.x);
    let staying = loads(landing, run, keys, |k, place| leaves(k, place) <= keys.to);
    let all = at_rest(landing, run, keys);
    let of_bay = |k: usize| {
        let cells = staying[k].iter().zip(&all[k]);
        let either = cells.map(|(staying, any)| if staying.value > 0.0 { *staying } else { *any });
        either.filter(|place| place.value > 0.0).map(move |place| (k, place)).collect::<Vec<_>>()
    };
    let mut places: Vec<(usize, Place)> = (0..bays.len()).flat_map(of_bay).collect();
    places.sort_by(|a, b| b.1.value.total_cmp(&a.1.value));
    let near = SAME * (keys.to - keys.from) / keys.sections as f64;
    let mut chosen: Vec<Chosen<'a>> = Vec::new();
    for (bay, load) in places {
        let is_known = |other: &Chosen<'_>| {
            let way = other.history.as_ref().ok().filter(|way| way.covers(load.time));
            way.is_some_and(|way| (way.place(load.time) - load.x).abs() < near)
        };
        if chosen.iter().filter(|other| other.bay == bay).any(is_known) {
            continue;
        }
        let history = landing.plane_history(&run.flight, load.time, load.x);
        let history = history.ok_or("its plane of water meets an end of the fuselage first".to_string());
        let history = history.and_then(|way| {
            let end = load.time + AFTER * (load.time - way.rows[0].time) + period(bay, load.x);
            cut(keys, landing.hull, way, load, end)
        });
        chosen.push(Chosen { keys, plate, bay, load, history });
    }
    chosen
}

/// The part of a way that boundary elements follow: while it passes the plating, goes down and the landing's theory presses, up to an `end`
/// [s].
///
/// # Errors
/// Why that ends before the time of the load.
fn cut(keys: &PlatingKeys, hull: &Hull, history: PlaneHistory, load: Place, end: f64) -> Result<PlaneHistory, String> {
    let (first, deepest) = (history.rows[0].speed, DEEP * hull.fuselage().breadth(load.x));
    let all = &history.rows;
    let obstacle = |k: usize| {
        let (row, before) = (&all[k], &all[k - 1]);
        let of_theory = hull.at(load.x, row.draught);
        let presses = of_theory.slam * row.speed * row.speed + of_theory.added_mass * row.rate > 0.0;
        match () {
            _ if row.speed <= SLOW * first => Some("the section stops or rises"),
            _ if !presses => Some("the water pulls at the section"),
            _ if row.draught >= deepest => Some("the section is deeper than boundary elements follow"),
            _ if before.x >= keys.to || before.time >= end => Some("the section leaves the plating"),
            _ => None,
        }
    };
    let stop = (1..all.len()).find_map(|k| Some((k, obstacle(k)?)));
    let rows = all[..stop.map_or(all.len(), |(k, _)| k)].to_vec();
    match stop {
        Some((k, why)) if rows.len() < 2 || rows[rows.len() - 1].time < load.time => {
            Err(format!("{why} at {:.3} s, before that load", all[k].time))
        }
        _ => Ok(PlaneHistory { rows }),
    }
}
