//! What was found: `certify.json`.

use std::collections::BTreeMap;

use serde::Serialize;

use super::cases::Case;
use super::choices::Input;
use super::envelope::{Envelope, Extreme, Reason, reasons};
use super::quantity::Quantity;
use super::record::{Ended, Record};
use super::rule::{Answer, Computed, Evidence, NOT_ANSWERED, Rule, evidence};
use super::{HashedFile, Plan};

/// What these answers are for, and what they are not.
pub const STATEMENT: &str = "This dossier is a computation in support of a showing of compliance. It is not a showing of compliance. It replaces no test and no \
    judgement of the authority. No load in it has a known band: the evidence below says how far computed landings were from model tests.";

/// A worst case in words.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// Name of the number.
    pub name: String,
    /// What it is.
    pub title: String,
    /// Its unit.
    pub unit: &'static str,
    /// Value, time and case.
    #[serde(flatten)]
    pub extreme: Extreme,
    /// The case in words.
    pub words: String,
    /// Why the case is doubtful, where it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
    /// A worse value that a case had before it failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub before_a_failure: Option<Extreme>,
}

/// Number of cases by how they ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// To the end.
    pub completed: usize,
    /// To the end, with a doubt.
    pub doubtful: usize,
    /// Failed on the way.
    pub failed: usize,
    /// Not run: outside the model's range, or not possible.
    pub outside: usize,
}

/// A load that parts were lost at.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LostPart {
    /// Its name.
    pub part: String,
    /// Number of cases in which it was lost after the first touch.
    pub cases: usize,
    /// The first of them.
    pub first: usize,
}

/// What was found.
#[derive(Clone, Debug, Serialize)]
pub struct Findings {
    /// What this is for.
    pub statement: &'static str,
    /// Name of the landing.
    pub scene: String,
    /// The program's version.
    pub version: &'static str,
    /// The model of the sections.
    pub model: &'static str,
    /// The rule.
    pub rule: &'static str,
    /// Files that were read.
    pub files: Vec<HashedFile>,
    /// Inputs and where they come from.
    pub inputs: Vec<Input>,
    /// What the file assumes.
    pub assumptions: Vec<String>,
    /// Number of all combinations of the lists.
    pub combinations: usize,
    /// Number of cases.
    pub cases: usize,
    /// How they ended.
    pub counts: Counts,
    /// Reasons of those that failed, were not run, or are doubtful.
    pub reasons: Vec<Reason>,
    /// Paragraphs of the rule.
    pub paragraphs: Vec<Answer>,
    /// Worst cases.
    pub worst: Vec<Worst>,
    /// Parts that were lost.
    pub lost: Vec<LostPart>,
    /// Borders of the cells from the nose [m].
    pub places_m: Vec<f64>,
    /// Envelopes by name and by cell.
    pub envelope: Envelope,
    /// Errors of landings against tests.
    pub evidence: Vec<Evidence>,
}

impl Findings {
    /// Of a plan and the records of its cases.
    pub fn new(plan: &Plan, records: &[Record]) -> Findings {
        let envelope = Envelope::of(records);
        let cases: BTreeMap<usize, &Case> = plan.cases.iter().map(|case| (case.number, case)).collect();
        let whole = || records.iter().filter(|record| record.ended.is_whole());
        let on_waves = whole().filter(|record| cases.get(&record.case).is_some_and(|case| case.wave_height_m > 0.0));
        let most =
            |of: fn(&Case) -> f64| whole().filter_map(|r| cases.get(&r.case)).map(|case| of(case)).fold(0.0, f64::max);
        let computed = Computed {
            landings: whole().count(),
            on_waves: on_waves.count(),
            sink: most(|case| case.sink_m_per_s),
            forward: most(|case| case.forward_m_per_s.unwrap_or_default()),
        };
        let rule = Rule::of(plan.scene.certify.clone().unwrap_or_default().rule);
        let count = |ended: Ended| records.iter().filter(|record| record.ended == ended).count();
        let ends = [&plan.scene.stations[0], &plan.scene.stations[plan.scene.stations.len() - 1]].map(|s| s.x);
        let cells = envelope.pressure.len();
        let place = |k: usize| ends[0] + (ends[1] - ends[0]) * k as f64 / cells as f64;
        Findings {
            statement: STATEMENT,
            scene: plan.scene.name.clone(),
            version: env!("CARGO_PKG_VERSION"),
            model: plan.scene.model.name(),
            rule: &rule.title,
            files: plan.files.clone(),
            inputs: plan.choices.inputs.clone(),
            assumptions: plan.scene.assumptions.clone(),
            combinations: plan.combinations,
            cases: records.len(),
            counts: Counts {
                completed: count(Ended::Completed),
                doubtful: count(Ended::Doubtful),
                failed: count(Ended::Failed),
                outside: count(Ended::Outside),
            },
            reasons: reasons(records),
            paragraphs: rule.answers(&plan.scene, computed),
            worst: worst(&envelope, &cases, records),
            lost: lost(records),
            places_m: if cells == 0 { Vec::new() } else { (0..=cells).map(place).collect() },
            envelope,
            evidence: evidence(),
        }
    }

    /// The number of a case, with its doubt.
    pub fn case(&self, number: usize) -> String {
        let mut doubtful = self.reasons.iter().filter(|reason| reason.ended == Ended::Doubtful);
        let is_doubtful = doubtful.any(|reason| reason.cases.contains(&number));
        if is_doubtful { format!("{number} (doubtful)") } else { number.to_string() }
    }

    /// The answer in a few lines.
    pub fn words(&self) -> String {
        let Counts { completed, doubtful, failed, outside } = self.counts;
        let mut lines = vec![format!(
            "{}: {} cases: {completed} completed, {doubtful} with a doubt, {failed} failed, {outside} not run",
            self.rule, self.cases
        )];
        let loads =
            self.worst.iter().filter(|worst| !worst.name.starts_with("station.") && worst.name != "balance_error");
        lines.extend(loads.map(|worst| {
            let value = report::run_page::quantity::with_unit(worst.extreme.value, worst.unit);
            let doubt = worst.doubt.as_ref().map_or(String::new(), |why| format!(", with a doubt: {why}"));
            format!("  {}: {value} in case {}{doubt}", worst.title, worst.extreme.case)
        }));
        lines.extend(
            self.reasons
                .iter()
                .map(|reason| format!("  {} {}: {}", reason.cases.len(), reason.ended.words(), reason.example)),
        );
        let open = self.paragraphs.iter().filter(|answer| answer.answer == NOT_ANSWERED);
        let open: Vec<&str> = open.map(|answer| answer.paragraph.as_str()).collect();
        lines.push(format!("  not answered: {}", if open.is_empty() { "none".into() } else { open.join(", ") }));
        lines.join("\n")
    }
}

fn worst(envelope: &Envelope, cases: &BTreeMap<usize, &Case>, records: &[Record]) -> Vec<Worst> {
    let names =
        envelope.numbers.keys().chain(envelope.of_failed.keys().filter(|name| !envelope.numbers.contains_key(*name)));
    let of = |name: &String| {
        let Quantity { title, unit, .. } = Quantity::of(name);
        let before_a_failure = envelope.of_failed.get(name).copied();
        let extreme = envelope.numbers.get(name).copied().or(before_a_failure).unwrap_or_default();
        let words = cases.get(&extreme.case).map_or(String::new(), |case| case.words());
        let doubtful = records.iter().find(|r| r.case == extreme.case && r.ended == Ended::Doubtful);
        let doubt = doubtful.map(|record| record.message.clone().unwrap_or_default());
        Worst { name: name.clone(), title, unit, extreme, words, doubt, before_a_failure }
    };
    let mut worst: Vec<Worst> = names.map(of).collect();
    worst.sort_by_cached_key(|worst| Quantity::of(&worst.name).rank);
    worst
}

fn lost(records: &[Record]) -> Vec<LostPart> {
    let mut parts: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for record in records {
        record.lost.iter().for_each(|(name, _)| parts.entry(name).or_default().push(record.case));
    }
    parts.into_iter().map(|(part, cases)| LostPart { part: part.into(), cases: cases.len(), first: cases[0] }).collect()
}
