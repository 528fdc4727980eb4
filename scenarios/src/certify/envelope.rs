//! Envelopes: the worst value of each number over all cases, and the case that gives it.

use std::collections::BTreeMap;

use serde::Serialize;

use super::quantity::Quantity;
use super::record::{Ended, Record};

/// A worst value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Extreme {
    /// The value.
    pub value: f64,
    /// Its time after the first touch [s]; of flotation 0.
    pub time_s: f64,
    /// Number of the case.
    pub case: usize,
}

/// Envelopes of a list of cases.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Envelope {
    /// By name, of the cases that completed.
    pub numbers: BTreeMap<String, Extreme>,
    /// Worse values that failed cases had before they failed.
    pub of_failed: BTreeMap<String, Extreme>,
    /// Largest mean pressure on each cell of the bottom [Pa], shape (places, shares of the girth), of all cases, failed ones up to their failure too.
    pub pressure: Vec<Vec<Extreme>>,
}

/// Reasons that cases have in common.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reason {
    /// How they ended.
    pub ended: Ended,
    /// The reason of the first of them.
    pub example: String,
    /// Their numbers.
    pub cases: Vec<usize>,
}

fn keep(worst: &mut BTreeMap<String, Extreme>, name: &str, new: Extreme, quantity: &Quantity) {
    match worst.get_mut(name) {
        Some(old) if quantity.is_worse(new.value, old.value) => *old = new,
        Some(_) => {}
        None => {
            worst.insert(name.to_string(), new);
        }
    }
}

impl Envelope {
    /// Of the records of all cases.
    pub fn of(records: &[Record]) -> Envelope {
        let mut quantities: BTreeMap<&str, Quantity> = BTreeMap::new();
        let mut envelope = Envelope::default();
        let mut failed = BTreeMap::new();
        for record in records {
            for (name, [value, time_s]) in &record.numbers {
                let quantity = quantities.entry(name).or_insert_with(|| Quantity::of(name));
                let new = Extreme { value: *value, time_s: *time_s, case: record.case };
                let worst = if record.ended.is_whole() { &mut envelope.numbers } else { &mut failed };
                keep(worst, name, new, quantity);
            }
            envelope.add(record);
        }
        let is_worse = |(name, of_failed): &(String, Extreme)| match envelope.numbers.get(name) {
            Some(whole) => Quantity::of(name).is_worse(of_failed.value, whole.value),
            None => true,
        };
        envelope.of_failed = failed.into_iter().filter(is_worse).collect();
        envelope
    }

    fn add(&mut self, record: &Record) {
        if self.pressure.is_empty() {
            self.pressure = record.map.iter().map(|row| vec![Extreme::default(); row.len()]).collect();
        }
        for (worst, new) in self.pressure.iter_mut().zip(&record.map) {
            for (worst, [value, time_s]) in worst.iter_mut().zip(new) {
                if *value > worst.value {
                    *worst = Extreme { value: *value, time_s: *time_s, case: record.case };
                }
            }
        }
    }
}

/// Reasons why cases failed, were not run, or are doubtful; those that differ by numbers only are one.
pub fn reasons(records: &[Record]) -> Vec<Reason> {
    let mut reasons: BTreeMap<(Ended, String), Reason> = BTreeMap::new();
    for record in records {
        let Some(message) = &record.message else { continue };
        let kind: String = message.chars().filter(|c| !c.is_ascii_digit() && !"-.".contains(*c)).take(60).collect();
        let reason = reasons.entry((record.ended, kind)).or_insert_with(|| Reason {
            ended: record.ended,
            example: message.clone(),
            cases: Vec::new(),
        });
        reason.cases.push(record.case);
    }
    let mut reasons: Vec<Reason> = reasons.into_values().collect();
    reasons.sort_by_key(|reason| reason.cases.len());
    reasons.reverse();
    reasons
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(case: usize, ended: Ended, value: f64, message: Option<&str>) -> Record {
        let numbers = BTreeMap::from([("station.3.shear".to_string(), [value, 0.1])]);
        let map = vec![vec![[value.abs(), 0.1], [1.0, 0.2]]];
        Record { case, ended, message: message.map(String::from), numbers, lost: Vec::new(), map }
    }

    #[test]
    fn the_worst_is_the_largest_size_of_completed_cases_and_failed_ones_stand_apart() {
        let records = [
            record(1, Ended::Completed, 3.0, None),
            record(2, Ended::Doubtful, -4.0, Some("left the water at t = 1.5 s")),
            record(3, Ended::Failed, 5.0, Some("the nose goes under at t = 0.5 s")),
            record(4, Ended::Failed, 2.0, Some("the nose goes under at t = 0.75 s")),
        ];
        let envelope = Envelope::of(&records);
        let worst = envelope.numbers["station.3.shear"];
        assert_eq!((worst.value, worst.case), (-4.0, 2));
        assert_eq!(envelope.of_failed["station.3.shear"].case, 3);
        assert_eq!((envelope.pressure[0][0].case, envelope.pressure[0][1].case), (3, 1));
        let reasons = reasons(&records);
        assert_eq!(reasons.iter().map(|reason| reason.cases.len()).collect::<Vec<_>>(), [2, 1]);
        assert_eq!(reasons[0].cases, [3, 4]);
    }
}
