//! A map: a scene, two axes, and bounds.

use include_dir::{Dir, include_dir};
use run::numbers::Numbers;
use serde::{Deserialize, Serialize};

use super::boundary::Boundary;
use crate::axis::numbers;
use crate::experiments::catalogue::{Case, Catalogue};

static FOLDER: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/cases/maps");

/// The maps.
pub static MAPS: Catalogue<Map> = Catalogue::new("map", "stability", &FOLDER);

/// Default of the momentum gap per step from which a run has failed [-]: far above rounding.
fn usual_momentum_gap() -> f64 {
    1e-9
}

/// A scene over two parameters.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Map {
    /// Name, that of its file.
    #[serde(default)]
    pub name: String,
    /// What is mapped.
    pub about: String,
    /// A remark on the result.
    #[serde(default)]
    pub note: String,
    /// Name of a built-in scene, or path of a scene file.
    pub scene: String,
    /// Overrides of every point, as for `--set`.
    #[serde(default)]
    pub set: Vec<String>,
    /// Largest number of steps; a run that needs more has failed.
    pub most_steps: u64,
    /// Energy that a run may gain, over the largest energy exchanged (THEORY CO28), before it counts as failed [-].
    pub most_energy_gain: f64,
    /// Momentum gap per step from which a run has failed (THEORY CO27) [-].
    #[serde(default = "usual_momentum_gap")]
    pub most_momentum_gap: f64,
    /// Bounds on numbers of `summary.json`; a run outside them has failed.
    #[serde(default)]
    pub failed: Vec<Bound>,
    /// Bounds on numbers; a run outside them is inaccurate.
    #[serde(default)]
    pub inaccurate: Vec<Bound>,
    /// The theoretical boundary.
    pub theory: Option<Boundary>,
    /// Across the map.
    pub x: Axis,
    /// Up the map.
    pub y: Axis,
}

/// A parameter: numbers that drive one or more keys, or named choices.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// Name, with its unit in brackets.
    pub label: String,
    /// Its values, rising: a list or a range.
    #[serde(default, deserialize_with = "numbers")]
    pub values: Vec<f64>,
    /// The keys that a value drives.
    #[serde(default)]
    pub keys: Vec<Key>,
    /// Instead of values: named sets of overrides.
    #[serde(default)]
    pub choices: Vec<Choice>,
}

/// A key of the scene that follows an axis' value.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Key {
    /// The key's path, as for `--set`.
    pub path: String,
    /// Factor on the value, in the key's unit over the axis'.
    #[serde(default = "one")]
    pub factor: f64,
}

fn one() -> f64 {
    1.0
}

/// One of the named places of an axis.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// Name.
    pub name: String,
    /// Overrides, as for `--set`.
    pub set: Vec<String>,
}

impl Axis {
    /// Number of places on it.
    pub fn len(&self) -> usize {
        self.values.len().max(self.choices.len())
    }

    /// True if there is no place on it.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The places as they are written, on the page and in `--point`.
    pub fn names(&self) -> Vec<String> {
        let values = self.values.iter().map(f64::to_string);
        values.chain(self.choices.iter().map(|c| c.name.clone())).collect()
    }

    /// The overrides of a place; a number need not be one of the map's. `None` for an unknown choice.
    pub fn sets(&self, place: &str) -> Option<Vec<String>> {
        if !self.choices.is_empty() {
            return self.choices.iter().find(|c| c.name == place).map(|c| c.set.clone());
        }
        let value = place.parse::<f64>().ok().filter(|value| value.is_finite())?;
        Some(self.keys.iter().map(|key| format!("{}={}", key.path, value * key.factor)).collect())
    }

    /// Allowed places.
    pub fn expected(&self) -> String {
        match self.choices.is_empty() {
            true => "a finite number".into(),
            false => format!("one of {}", self.names().join(", ")),
        }
    }

    fn check(&self) -> Result<(), String> {
        let label = &self.label;
        match (self.values.is_empty(), self.choices.is_empty()) {
            (true, true) => Err(format!("axis `{label}` is empty: expected `values` with `keys`, or `choices`")),
            (false, false) => Err(format!("axis `{label}` has `values` and `choices`: expected one of them")),
            (false, true) if self.keys.is_empty() => {
                Err(format!("axis `{label}` has no `keys`: expected at least one that its values drive"))
            }
            (false, true) if !self.values.is_sorted_by(|a, b| a < b) => {
                Err(format!("`values` of axis `{label}`: expected rising numbers"))
            }
            _ => Ok(()),
        }
    }
}

/// Bounds on a number of `summary.json`.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Bound {
    /// Its path, keys joined by `/`.
    pub quantity: String,
    /// Least value.
    pub least: Option<f64>,
    /// Largest value.
    pub most: Option<f64>,
    /// Meaning of the bounds, with their source.
    pub meaning: String,
}

impl Bound {
    /// Why a run's number is outside the bounds; a missing or infinite number is outside all bounds.
    pub(super) fn breach(&self, numbers: &Numbers) -> Option<String> {
        let Bound { quantity, least, most, meaning } = self;
        let Some(value) = numbers.get(quantity) else {
            return Some(format!("{quantity} is not a number: {meaning}"));
        };
        let (low, high) = (least.is_some_and(|least| value < least), most.is_some_and(|most| value > most));
        let limit = if low { least } else { most }.unwrap_or_default();
        let side = if low { "below" } else { "above" };
        (low || high).then(|| format!("{quantity} = {value:.4e}, {side} {limit}: {meaning}"))
    }
}

impl Case for Map {
    fn title(&self) -> [&str; 2] {
        [&self.name, &self.about]
    }

    fn rename(&mut self, name: String) {
        self.name = name;
    }

    /// The path itself, so that the commands on the page work.
    fn name_of_file(path: &str) -> String {
        path.to_string()
    }

    fn check(&self) -> Result<(), String> {
        self.x.check()?;
        self.y.check()?;
        let mut bounds = self.failed.iter().chain(&self.inaccurate);
        match bounds.find(|b| b.least.is_none() && b.most.is_none()) {
            Some(bound) => Err(format!("bound on `{}`: expected `least` or `most`", bound.quantity)),
            None => Ok(()),
        }
    }
}

impl Map {
    /// Overrides of a point.
    pub(super) fn sets(&self, x: &str, y: &str) -> Vec<String> {
        let own =
            [(&self.x, x), (&self.y, y)].into_iter().flat_map(|(axis, place)| axis.sets(place).unwrap_or_default());
        self.set.iter().cloned().chain(own).collect()
    }

    /// The command that repeats a point.
    pub fn command(&self, x: &str, y: &str) -> String {
        format!("splashdown stability {} --point {x},{y}", self.name)
    }
}
