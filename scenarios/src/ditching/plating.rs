//! Stresses of the plating of a landing along length and girth: boundary elements in sections chosen by load (THEORY EN63, EN64).

use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use run::summary::Peak;
use run::{Outcome, RunOptions, load_text};
use serde::Serialize;
use water_entry::ditching::{GirthPressure, Hull, Landing, LandingResult, PlaneHistory};

use super::checked::{hull, landing};
use super::model::Scene;
use super::plate_strip::{static_stress, wet_period};
use super::plating_keys::{Bay, PlateMaterial, PlatingKeys};
use super::section_text::{SectionEntry, bay_name};

/// Folder of the sections' scenes.
pub(super) const FOLDER: &str = "sections";
/// Elements of a bay.
const ELEMENTS: usize = 16;
/// Rows of the series of a section.
const ROWS: f64 = 800.0;
/// A section is followed while its speed is more than this share of that at the contact [-].
const SLOW: f64 = 0.05;
/// And while its draught is less than this share of the breadth [-].
const DEEP: f64 = 0.95;
/// Planes of water are one where they are nearer than this share of the length of a cell [-].
const SAME: f64 = 0.25;
/// After the chosen load a section is followed for this share of the time from the contact to it [-], and for a wet period of the bay.
const AFTER: f64 = 0.25;

/// Stresses of a plating.
#[derive(Clone, Debug, Serialize)]
pub struct PlatingStress {
    /// Its name.
    pub name: String,
    /// Front and rear end, from the nose [m], shape (2).
    pub ends_m: [f64; 2],
    /// Its bays, from the keel outwards.
    pub bays: Vec<BayStress>,
    /// The sections that were followed.
    pub sections: Vec<PlatingSection>,
    /// Of each bay and cell along the fuselage: largest stress by boundary elements, then under the mean pressure; shape (bays, cells).
    #[serde(skip)]
    cells: Vec<Vec<[Place; 2]>>,
}

/// Largest stress of a bay.
#[derive(Clone, Debug, Serialize)]
pub struct BayStress {
    /// Its ends as shares of the girth from the keel [-], shape (2).
    pub girth: [f64; 2],
    /// Largest stress, of the outer fibre, by boundary elements [Pa], elastic; absent where no section with it could be followed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stress_pa: Option<Peak>,
    /// Where that is, from the nose [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_m: Option<f64>,
    /// Is its section doubtful? Its `doubt` says why.
    pub doubtful: bool,
    /// Allowable stress over it [-]; absent without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reserve_factor: Option<f64>,
    /// Stress of a bay that carries the largest mean pressure of the landing's theory at rest [Pa].
    pub static_stress_pa: Peak,
    /// Where that is, from the nose [m].
    pub static_at_m: f64,
}

/// A section that was chosen: there the mean pressure on a bay is largest in a cell.
#[derive(Clone, Debug, Serialize)]
pub struct PlatingSection {
    /// Its place, from the nose [m].
    pub x_m: f64,
    /// When that is [s].
    pub time_s: f64,
    /// The bay, shares of the girth from the keel [-], shape (2).
    pub girth: [f64; 2],
    /// Stress of the bay under that pressure at rest [Pa].
    pub static_stress_pa: f64,
    /// When its plane of water is first met [s]; absent where that is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_s: Option<f64>,
    /// File of its scene in the landing's folder, for `splashdown run`; absent where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<String>,
    /// Text of that file.
    #[serde(skip)]
    text: Option<String>,
    /// Why boundary elements do not follow it; absent where they do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
    /// What makes its stresses doubtful; absent where nothing does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
}

/// A value of a cell: stress [Pa], time [s], place from the nose [m], and whether it is doubtful.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Place {
    value: f64,
    time: f64,
    x: f64,
    doubtful: bool,
}

impl Place {
    fn keep(&mut self, other: Place) {
        if other.value > self.value {
            *self = other;
        }
    }

    fn most(cells: impl Iterator<Item = Place>) -> Place {
        cells.fold(Place::default(), |most, cell| if cell.value > most.value { cell } else { most })
    }

    fn peak(&self) -> Peak {
        Peak { value: self.value, time_s: self.time, verdict: None }
    }
}

/// A section to follow with one of its bays.
struct Chosen<'a> {
    keys: &'a PlatingKeys,
    plate: PlateMaterial,
    bay: usize,
    section: PlatingSection,
    history: Option<PlaneHistory>,
}

/// Stresses of all plating of a landing that was followed.
pub(super) fn stresses(scene: &Scene, run: &LandingResult) -> Vec<PlatingStress> {
    let Ok(hull) = hull(scene) else { return Vec::new() };
    let landing = landing(scene, &hull);
    let with_plate = |keys| Some((under_mean_pressure(&landing, run, keys), keys, keys.plate()?));
    let mut plating: Vec<_> = scene.plating.iter().filter_map(with_plate).collect();
    let chosen: Vec<Chosen<'_>> =
        plating.iter().flat_map(|(found, keys, plate)| choose(&landing, run, found, (keys, *plate))).collect();
    let followed: Vec<(PlatingSection, Vec<Place>)> =
        chosen.par_iter().map(|chosen| follow(scene, &hull, chosen)).collect();
    for (found, keys, plate) in &mut plating {
        let own = chosen.iter().zip(&followed).filter(|(chosen, _)| chosen.keys.name == keys.name);
        for (chosen, (section, places)) in own.clone() {
            found.sections.push(section.clone());
            places.iter().for_each(|p| found.cells[chosen.bay][cell(keys, p.x)][0].keep(*p));
        }
        // a cell whose own section could not be followed has no stress
        for (chosen, (section, _)) in own.filter(|(_, (section, _))| section.refused.is_some()) {
            found.cells[chosen.bay][cell(keys, section.x_m)][0] = Place::default();
        }
        for (bay, cells) in found.bays.iter_mut().zip(&found.cells) {
            let most = Place::most(cells.iter().map(|cell| cell[0]));
            if most.value > 0.0 {
                (bay.stress_pa, bay.at_m, bay.doubtful) = (Some(most.peak()), Some(most.x), most.doubtful);
                bay.reserve_factor = plate.allowable.map(|allowable| allowable / most.value);
            }
        }
    }
    plating.into_iter().map(|(found, ..)| found).collect()
}

/// The cell of a plating that a place is in.
fn cell(keys: &PlatingKeys, x: f64) -> usize {
    (((x - keys.from) / (keys.to - keys.from) * keys.sections as f64) as usize).min(keys.sections - 1)
}

/// The sections of a plating: for each bay and cell the plane of water that presses most there, each plane of a bay once, the most loaded first.
fn choose<'a>(
    landing: &Landing<'_>,
    run: &LandingResult,
    found: &PlatingStress,
    (keys, plate): (&'a PlatingKeys, PlateMaterial),
) -> Vec<Chosen<'a>> {
    let of_bay = |(bay, cells): (usize, &Vec<[Place; 2]>)| {
        let loaded = cells.iter().map(|cell| cell[1]).filter(|place| place.value > 0.0);
        loaded.map(|place| (bay, place)).collect::<Vec<_>>()
    };
    let bays = keys.bays();
    let mut places: Vec<(usize, Place)> = found.cells.iter().enumerate().flat_map(of_bay).collect();
    places.sort_by(|a, b| b.1.value.total_cmp(&a.1.value));
    let near = SAME * (keys.to - keys.from) / keys.sections as f64;
    let mut chosen: Vec<Chosen<'a>> = Vec::new();
    for (k, place) in places {
        let bay = bays[k];
        let is_known = |other: &Chosen<'_>| {
            let way = other.history.as_ref().filter(|way| way.covers(place.time));
            way.is_some_and(|way| (way.place(place.time) - place.x).abs() < near)
        };
        if chosen.iter().filter(|other| other.bay == k).any(is_known) {
            continue;
        }
        let (length, water) = ((bay.girth[1] - bay.girth[0]) * landing.hull.girth(place.x), landing.water.density);
        let end = |way: &PlaneHistory| {
            place.time + AFTER * (place.time - way.rows[0].time) + wet_period(keys, &plate, &bay, length, water)
        };
        let history = landing.plane_history(&run.flight, place.time, place.x);
        let history = history.and_then(|way| {
            let times = [place.time, end(&way)];
            cut(keys, landing.hull, way, place.x, times)
        });
        let section = PlatingSection {
            x_m: place.x,
            time_s: place.time,
            girth: bay.girth,
            static_stress_pa: place.value,
            contact_s: history.as_ref().map(|history| history.rows[0].time),
            scene: None,
            text: None,
            refused: None,
            doubt: None,
        };
        chosen.push(Chosen { keys, plate, bay: k, section, history });
    }
    chosen
}

/// The part of a way that boundary elements follow: while it passes the plating, goes down and the landing's theory presses, up to an `end`
/// [s]. `None` where that is before the `time` [s] of the chosen load.
fn cut(keys: &PlatingKeys, hull: &Hull, history: PlaneHistory, x: f64, [time, end]: [f64; 2]) -> Option<PlaneHistory> {
    let (first, deepest) = (history.rows[0].speed, DEEP * hull.fuselage().breadth(x));
    let all = &history.rows;
    let goes_on = |k: &usize| {
        let row = &all[*k];
        let load = hull.at(x, row.draught);
        let presses = load.slam * row.speed * row.speed + load.added_mass * row.rate > 0.0;
        let before = &all[k - 1];
        presses && row.speed > SLOW * first && row.draught < deepest && before.x < keys.to && before.time < end
    };
    let rows = all[..1 + (1..all.len()).take_while(goes_on).count()].to_vec();
    (rows.len() > 1 && rows[rows.len() - 1].time >= time).then_some(PlaneHistory { rows })
}

/// Follow a section. Of its bay: largest stress of the strip that is in the plane, at each row of its series.
fn follow(scene: &Scene, hull: &Hull, chosen: &Chosen<'_>) -> (PlatingSection, Vec<Place>) {
    let (keys, mut section) = (chosen.keys, chosen.section.clone());
    let Some(history) = chosen.history.clone() else {
        let why = "its plane of water meets an end of the fuselage first, or the section rises or is pulled before";
        return (PlatingSection { refused: Some(why.into()), ..section }, Vec::new());
    };
    let entry = SectionEntry { scene, hull, x: section.x_m, history };
    let (name, text) = scene_of(&entry, chosen);
    let outcome = by_boundary_elements(&name, &text);
    (section.scene, section.text) = (Some(format!("{FOLDER}/{name}.toml")), Some(text));
    let outcome = match outcome {
        Ok(outcome) => outcome,
        Err(why) => return (PlatingSection { refused: Some(why), ..section }, Vec::new()),
    };
    let panel = bay_name(&keys.name, chosen.bay);
    let doubts = outcome.summary.doubts.iter();
    let of_stress = doubts.filter(|doubt| !doubt.why.beyond_limit && doubt.about.contains(&panel));
    let reasons: Vec<&str> = of_stress.map(|doubt| doubt.why.text.as_str()).collect();
    section.doubt = (!reasons.is_empty()).then(|| reasons.join("; "));
    let doubtful = section.doubt.is_some();
    let stress = outcome.series.column(&format!("{panel}.stress_Pa")).unwrap_or_default();
    let places = outcome.series.times().into_iter().zip(stress).map(|(time, stress)| {
        let time = time + entry.contact();
        Place { value: stress.abs(), time, x: entry.history.place(time), doubtful }
    });
    (section, places.filter(|p| (keys.from..=keys.to).contains(&p.x)).collect())
}

/// Name and text of the scene of a section whose bay bends, by boundary elements.
fn scene_of(entry: &SectionEntry<'_>, chosen: &Chosen<'_>) -> (String, String) {
    let Chosen { keys, plate, bay, section, .. } = chosen;
    let rows = &entry.history.rows;
    let end = rows[rows.len() - 1].time - rows[0].time;
    let panel = bay_name(&keys.name, *bay);
    let name = format!("{panel}_{:.2}m_{:.3}s", entry.x, section.time_s).replace('.', "p");
    let head = format!(
        "# Bay {} of plating {} at {:.2} m from the nose on the way that its plane of water sees, from the contact at {:.4} s of the\n\
         # landing {} on.\nname = \"{name}\"\nmodel = \"boundary_element\"\n",
        bay + 1,
        keys.name,
        entry.x,
        entry.contact(),
        entry.scene.name,
    );
    let panels = entry.panels(keys, plate, Some((*bay, ELEMENTS)));
    let spacing = entry.bay_length(&keys.bays()[*bay]) / (2.0 * ELEMENTS as f64);
    (name, entry.text(&head, [end, end / ROWS], spacing, &panels))
}

/// A scene's run; or why there is none.
fn by_boundary_elements(name: &str, text: &str) -> Result<Outcome, String> {
    let loaded = load_text(&format!("{name}.toml"), text, &[]).map_err(|error| error.to_string())?;
    run::run(&loaded.scene, &RunOptions::default()).map_err(|error| error.to_string())
}

/// The scenes of the sections: file in the landing's folder, and text.
pub(super) fn scenes(plating: &[PlatingStress]) -> Vec<(&str, &str)> {
    let all = plating.iter().flat_map(|plating| &plating.sections);
    all.filter_map(|section| Some((section.scene.as_deref()?, section.text.as_deref()?))).collect()
}

/// EN64: stresses of a plating whose bays carry the mean pressures of the landing's theory at rest.
fn under_mean_pressure(landing: &Landing<'_>, run: &LandingResult, keys: &PlatingKeys) -> PlatingStress {
    let bays = keys.bays();
    let mut cells = vec![vec![[Place::default(); 2]; keys.sections]; bays.len()];
    for now in &run.moments {
        for (strip, force) in &now.strips {
            let Some(part) = strip.entry.filter(|part| (keys.from..=keys.to).contains(&part.at.x)) else { continue };
            let density = landing.water.density;
            let Some(pressure) = GirthPressure::new(landing.hull, &part, *force, &now.acceleration, density) else {
                continue;
            };
            let girth = landing.hull.girth(part.at.x);
            for (bay, cells) in bays.iter().zip(&mut cells) {
                let ends = bay.girth.map(|share| share * girth);
                let mean = pressure.over(ends) / (ends[1] - ends[0]);
                let place = &mut cells[cell(keys, part.at.x)][1];
                let value = static_stress(keys, bay, ends[1] - ends[0], mean);
                place.keep(Place { value, time: now.time, x: part.at.x, doubtful: false });
            }
        }
    }
    let of_bay = |(bay, cells): (&Bay, &Vec<[Place; 2]>)| {
        let most = Place::most(cells.iter().map(|cell| cell[1]));
        BayStress {
            girth: bay.girth,
            stress_pa: None,
            at_m: None,
            doubtful: false,
            reserve_factor: None,
            static_stress_pa: most.peak(),
            static_at_m: most.x,
        }
    };
    let bays = bays.iter().zip(&cells).map(of_bay).collect();
    PlatingStress { name: keys.name.clone(), ends_m: [keys.from, keys.to], bays, sections: Vec::new(), cells }
}

/// The largest stress of each plating, a line for each.
pub(super) fn lines(plating: &[PlatingStress]) -> String {
    let line = |p: &PlatingStress| {
        let found = p.bays.iter().filter_map(|bay| Some((bay.stress_pa?, bay.at_m?, bay)));
        let found = found.max_by(|a, b| a.0.value.total_cmp(&b.0.value));
        let left_out = p.sections.iter().filter(|section| section.refused.is_some()).count();
        let left_out = match left_out {
            0 => String::new(),
            some => format!("; {some} of {} sections could not be followed", p.sections.len()),
        };
        let most = found.map_or("no stress by boundary elements".to_string(), |(peak, at, bay)| {
            let reserve = bay.reserve_factor.map_or(String::new(), |factor| format!(", reserve factor {factor:.2}"));
            let doubtful = if bay.doubtful { ", doubtful" } else { "" };
            format!(
                "largest stress {:.0} MPa {at:.1} m from the nose at {:.3} s{reserve}{doubtful}",
                1e-6 * peak.value,
                peak.time_s
            )
        });
        format!("\n  plating {}: {most}{left_out}", p.name)
    };
    plating.iter().map(line).collect()
}

/// The file of the stresses: a row for each cell of each plating.
pub(super) fn csv(plating: &[PlatingStress]) -> String {
    let mut text =
        "plating,x_from_m,x_to_m,girth_from,girth_to,stress_Pa,time_s,static_stress_Pa,static_time_s\n".to_string();
    for plating in plating {
        let [from, to] = plating.ends_m;
        for (bay, cells) in plating.bays.iter().zip(&plating.cells) {
            let border = |k: usize| from + (to - from) * k as f64 / cells.len() as f64;
            for (k, values) in cells.iter().enumerate() {
                let [low, high] = bay.girth;
                let shown = values.map(|p| match p.value > 0.0 {
                    true => format!("{:.6e},{:.6}", p.value, p.time),
                    false => ",".into(),
                });
                text += &format!(
                    "{},{:.4},{:.4},{low},{high},{},{}\n",
                    plating.name,
                    border(k),
                    border(k + 1),
                    shown[0],
                    shown[1]
                );
            }
        }
    }
    text
}
