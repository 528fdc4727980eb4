//! What is charted: a scene, numbers whose true values are known, and ways to them.

use std::path::Path;

use include_dir::{Dir, include_dir};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::ChartError;
use crate::embedded;
use crate::summary::Summary;

static CASES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/cases/charts");

/// What is charted.
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
    /// Ways to the numbers.
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
    /// Path of its standard deviation, where it is a mean of something that should not vary.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scatter: Option<String>,
    /// The `quantity` of a line of `summary.json`'s `comparison[]`, whose error is charted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub comparison: Option<String>,
    /// The `reference` of that line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub against: Option<String>,
    /// Where the true value is from.
    pub source: String,
}

/// One way to the numbers, at growing effort; without `vary` a single run.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Family {
    /// Name.
    pub name: String,
    /// Overrides, as for `--set`.
    #[serde(default)]
    pub set: Vec<String>,
    /// The key that tells the effort.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vary: Option<String>,
    /// Its values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<Setting>,
}

/// A value of a key.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(untagged)]
pub enum Setting {
    /// True or false.
    Flag(bool),
    /// A whole number.
    Integer(i64),
    /// A number.
    Number(f64),
    /// A name.
    Word(String),
}

impl std::fmt::Display for Setting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Setting::Flag(value) => value.fmt(f),
            Setting::Integer(value) => value.fmt(f),
            Setting::Number(value) => write!(f, "{value:?}"),
            Setting::Word(value) => value.fmt(f),
        }
    }
}

/// What a run gave for a quantity.
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
    /// What a summary says; else what it lacks. `json` is the summary as its file.
    pub fn read(&self, summary: &Summary, json: &Value) -> Result<Reading, String> {
        let number = |path: &str| {
            let found = json.pointer(&format!("/{path}")).and_then(Value::as_f64);
            found.ok_or_else(|| format!("summary.json has no number {path}"))
        };
        if let (Some(path), Some(reference)) = (&self.value, self.reference) {
            let value = number(path)?;
            let scatter = self.scatter.as_deref().map_or(Ok(0.0), number)? / reference.abs();
            return Ok(Reading::new(value, value / reference - 1.0, scatter));
        }
        let (quantity, against) = (self.comparison.as_deref(), self.against.as_deref());
        let line = summary.comparison.iter().find(|c| Some(&*c.quantity) == quantity && Some(&*c.reference) == against);
        let line = line.ok_or_else(|| {
            format!("no comparison of {} with {}", quantity.unwrap_or_default(), against.unwrap_or_default())
        })?;
        Ok(Reading::new(line.ours, line.error, 0.0))
    }

    /// The number in words.
    pub fn in_words(&self) -> String {
        match (&self.value, self.reference, &self.comparison, &self.against) {
            (Some(value), Some(reference), ..) => format!("`{value}`, reference {reference} ({})", self.source),
            (.., Some(comparison), Some(against)) => format!("`{comparison}` against {against} ({})", self.source),
            _ => self.source.clone(),
        }
    }

    /// Why it cannot be charted, if so.
    fn doubt(&self) -> Option<String> {
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
    pub fn runs(&self, case: &Case) -> Vec<(Option<Setting>, Vec<String>)> {
        let common: Vec<String> = case.set.iter().chain(&self.set).cloned().collect();
        let Some(key) = &self.vary else { return vec![(None, common)] };
        let with = |at: &Setting| [common.clone(), vec![format!("{key}={at}")]].concat();
        self.values.iter().map(|at| (Some(at.clone()), with(at))).collect()
    }

    fn doubt(&self) -> Option<String> {
        match (&self.vary, self.values.is_empty()) {
            (Some(key), true) => {
                Some(format!("`values` of `{}` is empty: expected at least one value of `{key}`", self.name))
            }
            (None, false) => Some(format!("`values` of `{}` belong to no key: expected `vary` to name one", self.name)),
            _ => None,
        }
    }
}

/// All cases, by name.
pub fn cases() -> Result<Vec<Case>, ChartError> {
    let all: Vec<(String, Case)> = embedded::all(&CASES).map_err(|(name, why)| ChartError::Case(name, why))?;
    all.into_iter().map(|(name, case)| sound(Case { name, ..case })).collect()
}

/// The cases of the given names, or of the given TOML files; all that are built in if none is given.
pub fn select(names: &[String]) -> Result<Vec<Case>, ChartError> {
    let all = cases()?;
    if names.is_empty() {
        return Ok(all);
    }
    let known = || all.iter().map(|c| c.name.as_str()).collect::<Vec<_>>().join(", ");
    let chosen = |name: &String| match name.strip_suffix(".toml") {
        Some(path) => from_file(Path::new(name), path),
        None => all.iter().find(|c| c.name == *name).cloned().ok_or_else(|| ChartError::Unknown(name.clone(), known())),
    };
    names.iter().map(chosen).collect()
}

/// The case of a file, named like it.
fn from_file(file: &Path, path: &str) -> Result<Case, ChartError> {
    let wrong = |why: String| ChartError::Case(file.display().to_string(), why);
    let text = std::fs::read_to_string(file).map_err(|e| wrong(e.to_string()))?;
    let case = toml::from_str(&text).map_err(|e| wrong(e.to_string()))?;
    sound(Case { name: name_of(path), ..case })
}

/// The last part of a path, without its folders.
pub(super) fn name_of(path: &str) -> String {
    Path::new(path).file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// A case whose errors can be told.
pub(super) fn sound(case: Case) -> Result<Case, ChartError> {
    let empty = |what: &str, expected: &str| format!("`{what}` is empty: expected at least one {expected}");
    let twice = |what: &str, mut names: Vec<&String>| {
        names.sort();
        let double = names.windows(2).find(|pair| pair[0] == pair[1])?;
        Some(format!("two of `{what}` are named `{}`: expected different names", double[0]))
    };
    let doubt = (case.family.is_empty().then(|| empty("family", "way to the numbers")))
        .or_else(|| case.quantity.is_empty().then(|| empty("quantity", "number")))
        .or_else(|| twice("family", case.family.iter().map(|f| &f.name).collect()))
        .or_else(|| twice("quantity", case.quantity.iter().map(|q| &q.name).collect()))
        .or_else(|| case.quantity.iter().find_map(Quantity::doubt))
        .or_else(|| case.family.iter().find_map(Family::doubt));
    match doubt {
        Some(why) => Err(ChartError::Case(case.name, why)),
        None => Ok(case),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_keep_their_kind_in_toml_and_json() {
        let family: Family = toml::from_str(
            "name = \"a\"\nset = [\"s=1\"]\nvary = \"k\"\nvalues = [3, 0.5, 2.0, \"wendland_c4\", true]",
        )
        .expect("sound");
        let json = serde_json::to_string(&family).expect("JSON");
        let back: Family = serde_json::from_str(&json).expect("comes back");
        let case = cases().expect("they parse").swap_remove(0);
        let case = Case { set: Vec::new(), ..case };
        let last = |f: &Family| f.runs(&case).into_iter().map(|(_, sets)| sets[1].clone()).collect::<Vec<_>>();
        assert_eq!(last(&family), ["k=3", "k=0.5", "k=2.0", "k=wendland_c4", "k=true"]);
        assert_eq!(last(&back), last(&family));
    }
}
