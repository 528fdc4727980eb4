//! A case: a scene, numbers whose true values are known, and families of runs.

use include_dir::{Dir, include_dir};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::experiments::catalogue::{self, Catalogue};
use crate::experiments::runs::RunRecord;

static FOLDER: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/cases/charts");

/// The charts.
pub static CHARTS: Catalogue<Case> = Catalogue::new("chart", "chart", &FOLDER);

/// A work–precision chart.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Name, that of its file.
    #[serde(default)]
    pub name: String,
    /// What is shown.
    pub about: String,
    /// Name of a built-in scene, or path of a scene file.
    pub scene: String,
    /// Overrides of every run, as for `--set`.
    #[serde(default)]
    pub set: Vec<String>,
    /// Numbers, all taken from the same runs.
    pub quantity: Vec<Quantity>,
    /// Families of runs.
    pub family: Vec<Family>,
}

/// A number and its true value: `value` and `reference`, or `comparison` and `against`.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Quantity {
    /// Name.
    pub name: String,
    /// Path of the number in `summary.json`, keys joined by `/`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    /// Its exact or measured value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference: Option<f64>,
    /// Path of its standard deviation, where it is a mean of a constant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scatter: Option<String>,
    /// The `quantity` of a line of `summary.json`'s `comparison[]`, whose error is charted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub comparison: Option<String>,
    /// The `reference` of that line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub against: Option<String>,
    /// Source of the true value.
    pub source: String,
}

/// Runs of one setting at growing effort; without `vary` a single run.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Family {
    /// Name.
    pub name: String,
    /// Overrides, as for `--set`.
    #[serde(default)]
    pub set: Vec<String>,
    /// The key that sets the effort.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vary: Option<String>,
    /// Its values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<Value>,
}

/// The value of a key as `--set` takes it: a word without quotation marks.
pub(super) fn as_set(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_string)
}

/// The value of a quantity in a run.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Reading {
    /// The number; of a curve, its mean over the reference's points.
    pub value: f64,
    /// Its relative difference from the reference [-]; of a curve, the error in the measure of the scene's `norm`.
    pub bias: f64,
    /// Its standard deviation over the reference [-]; 0 where the case names none.
    pub scatter: f64,
    /// √(bias² + scatter²) [-].
    pub error: f64,
}

impl Reading {
    /// A number with its bias and scatter [-].
    pub fn new(value: f64, bias: f64, scatter: f64) -> Reading {
        Reading { value, bias, scatter, error: bias.hypot(scatter) }
    }
}

impl Quantity {
    /// Its value in a run.
    ///
    /// # Errors
    /// The run has no such number or comparison.
    pub fn read(&self, run: &RunRecord) -> Result<Reading, String> {
        let number = |path: &str| run.numbers.get(path).ok_or_else(|| format!("summary.json has no number {path}"));
        if let (Some(path), Some(reference)) = (&self.value, self.reference) {
            let value = number(path)?;
            let scatter = self.scatter.as_deref().map_or(Ok(0.0), number)? / reference.abs();
            return Ok(Reading::new(value, value / reference - 1.0, scatter));
        }
        let (quantity, against) = (self.comparison.as_deref(), self.against.as_deref());
        let line =
            run.summary.comparison.iter().find(|c| Some(&*c.quantity) == quantity && Some(&*c.reference) == against);
        let line = line.ok_or_else(|| {
            format!("no comparison of {} with {}", quantity.unwrap_or_default(), against.unwrap_or_default())
        })?;
        Ok(Reading::new(line.ours, line.error, 0.0))
    }

    /// Path, reference and source in one line.
    pub fn text(&self) -> String {
        match (&self.value, self.reference, &self.comparison, &self.against) {
            (Some(value), Some(reference), ..) => format!("`{value}`, reference {reference} ({})", self.source),
            (.., Some(comparison), Some(against)) => format!("`{comparison}` against {against} ({})", self.source),
            _ => self.source.clone(),
        }
    }

    /// Why it cannot be charted.
    fn problem(&self) -> Option<String> {
        let name = &self.name;
        match (&self.value, self.reference, &self.comparison, &self.against) {
            (Some(_), Some(reference), None, None) if reference == 0.0 || !reference.is_finite() => Some(format!(
                "`reference` = {reference} of `{name}`: expected a finite number other than 0, errors are relative to it"
            )),
            (Some(_), Some(_), None, None) => None,
            (None, None, Some(_), Some(_)) if self.scatter.is_none() => None,
            _ => Some(format!(
                "quantity `{name}`: expected `value` and `reference` (and perhaps `scatter`), or `comparison` and `against`"
            )),
        }
    }
}

impl Family {
    /// The value of the key, where one varies, and the overrides of each run.
    pub fn runs(&self, case: &Case) -> Vec<(Option<Value>, Vec<String>)> {
        let common: Vec<String> = case.set.iter().chain(&self.set).cloned().collect();
        let Some(key) = &self.vary else { return vec![(None, common)] };
        let with = |at: &Value| [common.clone(), vec![format!("{key}={}", as_set(at))]].concat();
        self.values.iter().map(|at| (Some(at.clone()), with(at))).collect()
    }

    fn problem(&self) -> Option<String> {
        match (&self.vary, self.values.is_empty()) {
            (Some(key), true) => {
                Some(format!("`values` of `{}` is empty: expected at least one value of `{key}`", self.name))
            }
            (None, false) => Some(format!("`values` of `{}` belong to no key: expected `vary` to name one", self.name)),
            _ => None,
        }
    }
}

impl catalogue::Case for Case {
    fn title(&self) -> [&str; 2] {
        [&self.name, &self.about]
    }

    fn rename(&mut self, name: String) {
        self.name = name;
    }

    fn check(&self) -> Result<(), String> {
        let empty = |what: &str, expected: &str| format!("`{what}` is empty: expected at least one {expected}");
        let twice = |what: &str, mut names: Vec<&String>| {
            names.sort();
            let double = names.windows(2).find(|pair| pair[0] == pair[1])?;
            Some(format!("two of `{what}` are named `{}`: expected different names", double[0]))
        };
        let problem = (self.family.is_empty().then(|| empty("family", "way to the numbers")))
            .or_else(|| self.quantity.is_empty().then(|| empty("quantity", "number")))
            .or_else(|| twice("family", self.family.iter().map(|f| &f.name).collect()))
            .or_else(|| twice("quantity", self.quantity.iter().map(|q| &q.name).collect()))
            .or_else(|| self.quantity.iter().find_map(Quantity::problem))
            .or_else(|| self.family.iter().find_map(Family::problem));
        problem.map_or(Ok(()), Err)
    }
}

#[cfg(test)]
mod tests {
    use run::charted::ErrorLaw;

    use super::*;

    #[test]
    fn settings_keep_their_kind_in_toml_and_json() {
        let family: Family = toml::from_str(
            "name = \"a\"\nset = [\"s=1\"]\nvary = \"k\"\nvalues = [3, 0.5, 2.0, \"wendland_c4\", true]",
        )
        .expect("sound");
        let json = serde_json::to_string(&family).expect("JSON");
        let back: Family = serde_json::from_str(&json).expect("comes back");
        let case = CHARTS.all().expect("they parse").swap_remove(0);
        let case = Case { set: Vec::new(), ..case };
        let last = |f: &Family| f.runs(&case).into_iter().map(|(_, sets)| sets[1].clone()).collect::<Vec<_>>();
        assert_eq!(last(&family), ["k=3", "k=0.5", "k=2.0", "k=wendland_c4", "k=true"]);
        assert_eq!(last(&back), last(&family));
    }

    #[test]
    fn each_stored_law_is_of_a_chart() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/run/charts/fits.json");
        let laws: Vec<ErrorLaw> = serde_json::from_str(&std::fs::read_to_string(path).expect("laws")).expect("laws");
        let charts = CHARTS.all().expect("they parse");
        let of_a_chart = |law: &ErrorLaw| {
            charts
                .iter()
                .any(|chart| chart.name == law.case && chart.family.iter().any(|family| family.name == law.family))
        };
        assert!(!laws.is_empty() && laws.iter().all(of_a_chart));
    }
}
