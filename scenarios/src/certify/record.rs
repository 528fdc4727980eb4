//! What a case gave: a line of `cases.jsonl`.

use std::collections::BTreeMap;

use run::summary::Peak;
use scene::SceneError;
use scene::vocabulary::Status;
use serde::{Deserialize, Serialize};

use super::cases::Case;
use crate::ditching::{self, Landed};

/// Digits that are kept.
const DIGITS: usize = 6;

/// What a case gave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Number of the case.
    pub case: usize,
    /// How it ended.
    pub ended: Ended,
    /// Why it has no results, or what is doubtful.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub message: Option<String>,
    /// Value and time [s] by name; of one that failed, up to the failure.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub numbers: BTreeMap<String, [f64; 2]>,
    /// Parts that were lost, with the times [s].
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub lost: Vec<(String, f64)>,
    /// Largest mean pressure on each cell of the bottom [Pa] and its time [s], shape (places, shares of the girth).
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub map: Vec<Vec<[f64; 2]>>,
}

/// How a case ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ended {
    /// To its end.
    Completed,
    /// To its end, with a doubt.
    Doubtful,
    /// It left what the model can follow; numbers are those up to there.
    Failed,
    /// It was not run: outside the model's range, or not possible.
    Outside,
}

impl Ended {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Ended::Completed => "completed",
            Ended::Doubtful => "completed with a doubt",
            Ended::Failed => "failed",
            Ended::Outside => "not run",
        }
    }

    /// True where its numbers are those of a whole landing.
    pub fn is_whole(self) -> bool {
        matches!(self, Ended::Completed | Ended::Doubtful)
    }
}

/// A number with six digits: so long are the numbers of all files.
fn kept(value: f64) -> f64 {
    format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value)
}

impl Record {
    /// Of a case that is not run.
    fn outside(case: &Case, why: String) -> Record {
        let (numbers, lost, map) = (BTreeMap::new(), Vec::new(), Vec::new());
        Record { case: case.number, ended: Ended::Outside, message: Some(why), numbers, lost, map }
    }

    /// Run a case of a landing file.
    pub fn of(file: &str, given: &[String], case: &Case) -> Record {
        if let Some(why) = &case.outside {
            return Record::outside(case, why.clone());
        }
        match ditching::load(file, &[given, &case.sets].concat()) {
            Ok(scene) => Record::landed(case, &ditching::follow(&scene)),
            Err(SceneError::Set { problem, .. } | SceneError::File { problem, .. }) => {
                Record::outside(case, problem.sentence.clone())
            }
            Err(error) => Record::outside(case, error.to_string()),
        }
    }

    fn landed(case: &Case, landed: &Landed) -> Record {
        let s = &landed.summary;
        let ended = match s.status {
            Status::Completed => Ended::Completed,
            Status::Failed => Ended::Failed,
            _ => Ended::Doubtful,
        };
        let parts = s.structure.parts.iter().filter_map(|part| Some((part.name.clone(), kept(part.lost_at_s?))));
        let map = landed.map.iter().flat_map(|map| &map.mean).map(|row| row.iter().map(|c| c.map(kept)).collect());
        let kept_number = |(name, [value, time]): (String, [f64; 2])| {
            value.is_finite().then(|| (name, [kept(value), if time.is_finite() { kept(time) } else { 0.0 }]))
        };
        Record {
            case: case.number,
            ended,
            message: s.message.clone(),
            numbers: numbers(landed).into_iter().filter_map(kept_number).collect(),
            lost: parts.collect(),
            map: map.collect(),
        }
    }
}

/// The numbers of a landing by name: value and time.
fn numbers(landed: &Landed) -> Vec<(String, [f64; 2])> {
    let s = &landed.summary;
    let of = |peak: &Peak| [peak.value, peak.time_s];
    let at_end = |value: f64| [value, s.time_end_s];
    let plain = [
        ("upward_acceleration", of(&s.az_g)),
        ("load_factor", of(&s.load_factor)),
        ("deceleration", of(&s.deceleration_g)),
        ("water_force", of(&s.fz_n)),
        ("water_moment", of(&s.moment_nm)),
        ("line_load", of(&s.line_load_n_per_m)),
        ("least_pitch", at_end(s.pitch_deg[1])),
        ("largest_pitch", at_end(s.pitch_deg[2])),
        ("run_length", at_end(s.run_length_m)),
        ("balance_error", at_end(s.structure.balance_error)),
    ];
    let mut all: Vec<(String, [f64; 2])> = plain.into_iter().map(|(name, value)| (name.to_string(), value)).collect();
    let structure = &s.structure;
    all.extend(structure.deflection_m.iter().map(|peak| ("deflection".to_string(), of(peak))));
    for a in &structure.accelerometers {
        all.push((format!("accelerometer.{}.upwards", a.name), of(&a.normal_g)));
        all.push((format!("accelerometer.{}.deceleration", a.name), of(&a.longitudinal_g)));
    }
    all.extend(structure.windows.iter().map(|w| (format!("window.{}.mean_pressure", w.name), of(&w.mean_pressure_pa))));
    all.extend(structure.parts.iter().map(|p| (format!("part.{}.force", p.name), of(&p.force_n))));
    for l in &structure.stations {
        let name = |of: &str| format!("station.{}.{of}", l.x_m);
        let peaks = [&l.line_load_n_per_m, &l.pressure_pa, &l.shear_n, &l.bending_nm];
        all.extend(["line_load", "pressure", "shear", "bending"].into_iter().zip(peaks).map(|(n, p)| (name(n), of(p))));
    }
    let cells = landed.map.iter().flat_map(|map| map.mean.iter().flatten());
    all.extend(cells.copied().max_by(|a, b| a[0].total_cmp(&b[0])).map(|most| ("cell_pressure".to_string(), most)));
    if let Some(afloat) = structure.flotation.as_ref().filter(|_| s.status != Status::Failed) {
        let mut add =
            |name: &str, value: Option<f64>| all.extend(value.map(|v| (format!("flotation.{name}"), [v, 0.0])));
        add("trim", Some(afloat.trim_deg));
        add("waterline", Some(afloat.waterline_m));
        add("reserve", Some(afloat.reserve));
        add("sinks", afloat.sinks_at_s);
        add("inside", Some(afloat.inside_m3));
        for sill in &afloat.openings {
            add(&format!("{}.over_water", sill.name), Some(sill.over_water_m));
            add(&format!("{}.wet", sill.name), sill.reached_s);
        }
    }
    all
}
