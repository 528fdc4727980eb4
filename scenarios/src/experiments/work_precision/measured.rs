//! A chart's runs, their Pareto front, and the law of the error over the cost.

use std::collections::BTreeMap;

use run::power_law::PowerLaw;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::case::{Case, Family, Quantity, Reading, as_set};

/// A run, done or failed.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Point {
    /// The family.
    pub family: String,
    /// Value of the family's key, where it varies one.
    pub at: Option<Value>,
    /// All overrides of the run; they identify it when a chart is resumed.
    pub set: Vec<String>,
    /// How it ended.
    pub outcome: Outcome,
}

/// How a run ended.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// With numbers.
    Done(Run),
    /// Without; why.
    Failed(String),
}

/// Numbers of a run.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Run {
    /// Readings, by quantity.
    pub readings: BTreeMap<String, Reading>,
    /// Quantities that could not be read, with the reason.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub missing: BTreeMap<String, String>,
    /// Draught at the end, while the spray root is on the bottom, over the finest spacing [-]; absent without an entry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spacings_per_draught: Option<f64>,
    /// Fluid particles at the end.
    pub particles: usize,
    /// Steps.
    pub steps: u64,
    /// Wall-clock time × threads [s].
    pub core_seconds: f64,
}

/// A chart, measured.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Measured {
    /// The case.
    pub case: Case,
    /// Threads of each run.
    pub threads: usize,
    /// Version of the program.
    pub version: String,
    /// The runs, family by family.
    pub points: Vec<Point>,
}

/// A run with its reading of one quantity.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The run.
    pub point: &'a Point,
    /// Its numbers.
    pub run: &'a Run,
    /// The quantity's.
    pub reading: Reading,
    /// True where no other run is as cheap and more exact, or as exact and cheaper.
    pub on_front: bool,
}

impl Point {
    /// The run's numbers, if it ended with any.
    pub fn run(&self) -> Option<&Run> {
        match &self.outcome {
            Outcome::Done(run) => Some(run),
            Outcome::Failed(_) => None,
        }
    }

    /// Family and value of its key.
    pub fn name(&self) -> String {
        self.at.as_ref().map_or_else(|| self.family.clone(), |at| format!("{} at {}", self.family, as_set(at)))
    }
}

/// Error of a family over its cost.
#[derive(Clone, Debug)]
pub struct Trend {
    /// error = a · (core-seconds)ᵇ.
    pub law: PowerLaw,
    /// Verdict.
    pub verdict: &'static str,
}

impl Measured {
    /// The runs that gave a quantity, family by family.
    pub fn seen(&self, quantity: &Quantity) -> Vec<Seen<'_>> {
        let of = |point| {
            let run = Point::run(point)?;
            Some(Seen { point, run, reading: *run.readings.get(&quantity.name)?, on_front: false })
        };
        let mut seen: Vec<Seen<'_>> = self.points.iter().filter_map(of).collect();
        let costs: Vec<[f64; 2]> = seen.iter().map(|s| [s.run.core_seconds, s.reading.error]).collect();
        for k in front(&costs) {
            seen[k].on_front = true;
        }
        seen
    }

    /// Law and verdict of a family, where it has three runs at different costs.
    ///
    /// "At the floor of the scatter": the finest run's bias is lost in the standard deviation of its own number, and the
    /// error falls no further. It falls where the power is below zero by more than its standard error.
    pub fn trend(&self, quantity: &Quantity, family: &Family) -> Option<Trend> {
        let mut of: Vec<Seen<'_>> = self.seen(quantity).into_iter().filter(|s| s.point.family == family.name).collect();
        of.sort_by(|a, b| a.run.core_seconds.total_cmp(&b.run.core_seconds));
        let law = PowerLaw::fit(of.iter().map(|s| [s.run.core_seconds, s.reading.error]))?;
        let [.., before, finest] = of.as_slice() else { return None };
        let floor = finest.reading.bias.abs() <= finest.reading.scatter;
        let stands = finest.reading.error >= before.reading.error;
        let falls = law.exponent < -law.exponent_error;
        let verdict = match (falls, floor, stands) {
            (true, true, true) => "falls; at the floor of the scatter",
            (true, false, true) => "falls; not in its last run",
            (true, _, false) => "falls",
            (false, true, _) => "at the floor of the scatter",
            (false, false, _) => "does not fall",
        };
        Some(Trend { law, verdict })
    }

    /// As the text of a JSON file.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a chart holds nothing that JSON cannot say")
    }
}

/// Indices of the Pareto-optimal points [cost, error] by growing cost; their errors fall strictly.
fn front(points: &[[f64; 2]]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        points[a][0].total_cmp(&points[b][0]).then(points[a][1].total_cmp(&points[b][1])).then(a.cmp(&b))
    });
    let mut least = f64::INFINITY;
    order.retain(|&k| {
        let better = points[k][1] < least;
        least = least.min(points[k][1]);
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::front;

    #[test]
    fn the_front_is_pareto_optimal_and_falls_strictly() {
        let points = [[8.0, 0.01], [1.0, 0.1], [2.0, 0.2], [2.0, 0.05], [4.0, 0.05], [8.0, 0.01]];
        assert_eq!(front(&points), [1, 3, 0]);
        assert!(front(&[]).is_empty());
    }
}
