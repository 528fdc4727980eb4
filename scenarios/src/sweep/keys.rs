//! Keys of a sweep file, and the tables in it whose keys are those of a scene.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use scene::source::{Source, segments};
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;
use settings::{Problem, Schema};
use toml::Table;

use crate::axis::Values;

/// Values by the paths of their keys, in the order of the file.
pub(super) type Free = serde_json::Map<String, Value>;

/// The schema of a sweep file.
pub fn schema() -> &'static Schema {
    static SCHEMA: LazyLock<Schema> = LazyLock::new(|| Schema::of::<Keys>("a sweep"));
    &SCHEMA
}

/// The keys of a sweep file.
#[derive(Deserialize, JsonSchema)]
pub(super) struct Keys {
    /// Scene of all points: a built-in name, or a path from the folder of this file; several are an axis.
    pub scene: Option<OneOrMore<String>>,
    /// Landing of all points, instead of a scene.
    pub ditch: Option<OneOrMore<String>>,
    /// Paths in summary.json that the table shows, such as `steps`. absent: all results.
    pub tabulate: Option<OneOrMore<String>>,
    /// A value that is the same at all points.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, Value>")]
    pub set: Free,
    /// Axes of which every combination is run.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, Values>")]
    pub grid: Free,
    /// Axes that change together, with as many values each.
    #[schemars(with = "Option<OneOrMore<BTreeMap<String, Values>>>")]
    pub zip: Option<OneOrMore<Free>>,
    /// Random points, evenly along each axis.
    pub latin_hypercube: Option<HypercubeKeys>,
}

/// A Latin hypercube.
#[derive(Deserialize, JsonSchema)]
pub(super) struct HypercubeKeys {
    /// Number of points.
    #[schemars(range(min = 1, max = 100_000))]
    pub samples: usize,
    /// Start of the random numbers.
    #[serde(default = "first_seed")]
    #[schemars(range(min = 0))]
    pub seed: i64,
    /// Axes, each with two ends.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, Values>")]
    pub keys: Free,
}

fn first_seed() -> i64 {
    1
}

/// One, or a list.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum OneOrMore<T> {
    One(T),
    More(#[schemars(length(min = 1))] Vec<T>),
}

impl<T> OneOrMore<T> {
    /// All, each with its path.
    pub fn placed(self, path: &str) -> Vec<(String, T)> {
        match self {
            OneOrMore::One(one) => vec![(path.to_string(), one)],
            OneOrMore::More(list) => {
                list.into_iter().enumerate().map(|(i, one)| (format!("{path}[{i}]"), one)).collect()
            }
        }
    }
}

/// A mistake at a key, in a sentence.
pub(super) fn refused(key: &str, sentence: &str) -> Problem {
    Problem { key: key.into(), sentence: sentence.into(), ..Problem::default() }
}

/// The file with `body.mass` instead of the table `body` with the key `mass`, in `set` and in the tables of axes, in the order of the file.
pub(super) fn with_paths(source: &Source, table: &Table) -> Result<Value, Problem> {
    let mut given = serde_json::to_value(table).unwrap_or_default();
    let mut places = vec!["set".to_string(), "grid".into(), "zip".into(), "latin_hypercube.keys".into()];
    let zips = given["zip"].as_array().map_or(0, Vec::len);
    places.extend((0..zips).map(|k| format!("zip[{k}]")));
    let mut known: Vec<String> = Vec::new();
    for place in places {
        let pointer = format!("/{}", place.replace(['.', '['], "/").replace(']', ""));
        let Some(Value::Object(keys)) = given.pointer_mut(&pointer) else { continue };
        let start = |key: &str| source.span(&format!("{place}.{key}")).start;
        let mut found = Vec::new();
        leaves("", std::mem::take(keys), place == "set", &start, &mut found);
        for (key, value) in found {
            if known.iter().any(|other| segments(other).eq(segments(&key))) {
                let sentence = format!("`{key}` stands twice: expected one place for each key");
                return Err(refused(&format!("{place}.{key}"), &sentence));
            }
            let form = key.rsplit('.').next().filter(|name| DISTRIBUTIONS.contains(name) && place != "set");
            if let (Some(form), true) = (form, value.is_array()) {
                let sentence = format!(
                    "`{form}` is a distribution: expected values or a range; distributions stand in [inputs] of a file of `splashdown scatter`"
                );
                return Err(refused(&format!("{place}.{key}"), &sentence));
            }
            known.push(key.clone());
            keys.insert(key, value);
        }
    }
    Ok(given)
}

/// Names of distributions, which sweeps do not have.
const DISTRIBUTIONS: [&str; 4] = ["normal", "uniform", "weibull", "table"];

/// The values of a table and of the tables in it, each table where it first stands; a table with ends is a range.
fn leaves(path: &str, table: Free, is_set: bool, start: &dyn Fn(&str) -> usize, found: &mut Vec<(String, Value)>) {
    let whole = |key: String| if path.is_empty() { key } else { format!("{path}.{key}") };
    let mut entries: Vec<(String, Value)> = table.into_iter().map(|(key, value)| (whole(key), value)).collect();
    entries.sort_by_cached_key(|(key, _)| start(key));
    for (key, value) in entries {
        match value {
            Value::Object(inner) if is_set || !["from", "to"].iter().any(|end| inner.contains_key(*end)) => {
                leaves(&key, inner, is_set, start, found);
            }
            value => found.push((key, value)),
        }
    }
}
