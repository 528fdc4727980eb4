//! Stresses of the plating of a landing along length and girth: boundary elements in sections chosen by load (THEORY EN63, EN64).

use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use run::summary::Peak;
use serde::Serialize;
use water_entry::ditching::LandingResult;

use super::checked::{hull, landing};
use super::model::Scene;
use super::plating_choice::{Chosen, Place, at_rest, cell, choose};
use super::plating_keys::{PlateMaterial, PlatingKeys};
use super::plating_run::{Followed, follow};

/// A section with this share of the load of the one that gives the largest stress may have more [-].
const MAY_BE_MORE: f64 = 0.9;

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
    /// What makes it doubtful, or too small: a section with more load that could not be followed; absent where nothing does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
    /// Allowable stress over it [-]; absent without one, and where it is 1 or more but the stress doubtful.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reserve_factor: Option<f64>,
    /// Stress of a bay that carries the largest mean pressure of the landing's theory at rest, an estimate [Pa]; absent of a dry bay.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub static_stress_pa: Option<Peak>,
    /// Where that is, from the nose [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub static_at_m: Option<f64>,
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

/// Stresses of all plating of a landing that was followed.
pub(super) fn stresses(scene: &Scene, run: &LandingResult) -> Vec<PlatingStress> {
    let Ok(hull) = hull(scene) else { return Vec::new() };
    let landing = landing(scene, &hull);
    let plating: Vec<(&PlatingKeys, PlateMaterial)> =
        scene.plating.iter().filter_map(|keys| Some((keys, keys.plate()?))).collect();
    let chosen: Vec<Chosen<'_>> = plating.iter().flat_map(|plating| choose(&landing, run, *plating)).collect();
    let followed: Vec<Followed> = chosen.par_iter().map(|chosen| follow(scene, &hull, chosen)).collect();
    let of_plating = |(keys, plate): &(&PlatingKeys, PlateMaterial)| {
        let own: Vec<_> = chosen.iter().zip(&followed).filter(|(chosen, _)| chosen.keys.name == keys.name).collect();
        PlatingStress::new(keys, plate, at_rest(&landing, run, keys), &own)
    };
    plating.iter().map(of_plating).collect()
}

impl PlatingStress {
    /// Of the stresses at rest of each bay and cell, and of sections that were followed.
    fn new(
        keys: &PlatingKeys,
        plate: &PlateMaterial,
        at_rest: Vec<Vec<Place>>,
        own: &[(&Chosen<'_>, &Followed)],
    ) -> PlatingStress {
        let with_none = |rest: Place| [Place::default(), rest];
        let mut cells: Vec<Vec<[Place; 2]>> =
            at_rest.into_iter().map(|cells| cells.into_iter().map(with_none).collect()).collect();
        for (chosen, followed) in own {
            followed.places.iter().for_each(|p| cells[chosen.bay][cell(keys, p.x)][0].keep(*p));
        }
        // a cell whose own section could not be followed has no stress
        for (chosen, _) in own.iter().filter(|(_, followed)| followed.refused.is_some()) {
            cells[chosen.bay][cell(keys, chosen.load.x)][0] = Place::default();
        }
        let bays = keys.bays();
        let bay = |(k, bay): (usize, &super::plating_keys::Bay)| {
            let of_bay: Vec<_> = own.iter().filter(|(chosen, _)| chosen.bay == k).copied().collect();
            BayStress::new(bay.girth, plate, &cells[k], &of_bay)
        };
        PlatingStress {
            name: keys.name.clone(),
            ends_m: [keys.from, keys.to],
            bays: bays.iter().enumerate().map(bay).collect(),
            sections: own.iter().map(|(chosen, followed)| PlatingSection::new(chosen, followed)).collect(),
            cells,
        }
    }
}

impl BayStress {
    /// Of the bay's cells, and of its sections, the most loaded first.
    fn new(
        girth: [f64; 2],
        plate: &PlateMaterial,
        cells: &[[Place; 2]],
        own: &[(&Chosen<'_>, &Followed)],
    ) -> BayStress {
        let most = |k: usize| {
            cells.iter().fold(Place::default(), |mut most, cell| {
                most.keep(cell[k]);
                most
            })
        };
        let known = |place: Place| (place.value > 0.0).then_some(place);
        let (stress, rest) = (known(most(0)), known(most(1)));
        let of_largest =
            |followed: &Followed| stress.is_some_and(|most| followed.places.iter().any(|place| place == &most));
        let governing = own.iter().find(|(_, followed)| of_largest(followed));
        let load = governing.map_or(0.0, |(chosen, _)| chosen.load.value);
        let is_missing = |(chosen, followed): &&(&Chosen<'_>, &Followed)| {
            let is_short = followed.refused.is_some() || followed.doubt.is_some() && !of_largest(followed);
            is_short && chosen.load.value > MAY_BE_MORE * load
        };
        let missing = stress.and_then(|_| own.iter().find(is_missing)).map(|(chosen, followed)| {
            let why = followed.refused.as_ref().or(followed.doubt.as_ref()).map_or("", String::as_str);
            format!(
                "the section at {:.2} m has as much load at {:.3} s or more: {why}",
                chosen.load.x, chosen.load.time
            )
        });
        let doubt = governing.and_then(|(_, followed)| followed.doubt.clone()).or(missing);
        let reserve = stress.and_then(|most| Some(plate.allowable? / most.value));
        BayStress {
            girth,
            stress_pa: stress.map(Place::peak),
            at_m: stress.map(|most| most.x),
            reserve_factor: reserve.filter(|factor| doubt.is_none() || *factor < 1.0),
            doubt,
            static_stress_pa: rest.map(Place::peak),
            static_at_m: rest.map(|most| most.x),
        }
    }
}

impl PlatingSection {
    fn new(chosen: &Chosen<'_>, followed: &Followed) -> PlatingSection {
        let (scene, text) = followed.scene.clone().unzip();
        PlatingSection {
            x_m: chosen.load.x,
            time_s: chosen.load.time,
            girth: chosen.keys.bays()[chosen.bay].girth,
            static_stress_pa: chosen.load.value,
            contact_s: chosen.history.as_ref().ok().map(|history| history.rows[0].time),
            scene,
            text,
            refused: followed.refused.clone(),
            doubt: followed.doubt.clone(),
        }
    }
}

impl Place {
    fn peak(self) -> Peak {
        Peak { value: self.value, time_s: self.time, verdict: None }
    }
}

/// The scenes of the sections: file in the landing's folder, and text.
pub(super) fn scenes(plating: &[PlatingStress]) -> Vec<(&str, &str)> {
    let all = plating.iter().flat_map(|plating| &plating.sections);
    all.filter_map(|section| Some((section.scene.as_deref()?, section.text.as_deref()?))).collect()
}

/// The largest stress of each plating, a line for each, with the bays that have no sure answer.
pub(super) fn lines(plating: &[PlatingStress]) -> String {
    let line = |p: &PlatingStress| {
        let found = p.bays.iter().filter_map(|bay| Some((bay.stress_pa?, bay.at_m?, bay)));
        let found = found.max_by(|a, b| a.0.value.total_cmp(&b.0.value));
        let most = found.map_or("no stress by boundary elements".to_string(), |(peak, at, bay)| {
            let reserve = bay.reserve_factor.map_or(String::new(), |factor| format!(", reserve factor {factor:.2}"));
            format!(
                "largest stress {:.0} MPa {at:.1} m from the nose at {:.3} s{reserve}",
                1e-6 * peak.value,
                peak.time_s
            )
        });
        let numbers = |counts: &dyn Fn(&BayStress) -> bool| {
            let all = p.bays.iter().enumerate().filter(|(_, bay)| counts(bay));
            all.map(|(k, _)| (k + 1).to_string()).collect::<Vec<_>>().join(", ")
        };
        let said = |words: &str, bays: String| if bays.is_empty() { bays } else { format!("; {words} {bays}") };
        let unknown = |bay: &BayStress| bay.stress_pa.is_none() && bay.static_stress_pa.is_some();
        let (doubtful, unknown) = (numbers(&|bay| bay.doubt.is_some()), numbers(&unknown));
        format!(
            "\n  plating {}: {most}{}{}",
            p.name,
            said("doubtful in bays", doubtful),
            said("not known in bays", unknown)
        )
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
