//! What a map is made of: data only.

use serde::{Deserialize, Serialize};

use super::{AtlasError, Bound, Theory};

/// Momentum gap of a step from which a run counts as failed, where a map states none: far above rounding [-].
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
    /// What is seen on it, where that wants saying.
    #[serde(default)]
    pub note: String,
    /// Name of a built-in scene, or path of a scene file.
    pub scene: String,
    /// Overrides of every point, as for `--set`.
    #[serde(default)]
    pub set: Vec<String>,
    /// Steps after which a run that has not come to its end has failed.
    pub most_steps: u64,
    /// Energy that a run may gain, over the largest energy exchanged (THEORY E22), before it counts as failed [-].
    pub most_energy_gain: f64,
    /// Momentum gap of a step from which a run counts as failed (THEORY E21) [-].
    #[serde(default = "usual_momentum_gap")]
    pub most_momentum_gap: f64,
    /// Numbers of `summary.json` outside whose bounds a run that ended has failed all the same.
    #[serde(default)]
    pub failed: Vec<Bound>,
    /// Numbers outside whose bounds a run is inaccurate.
    #[serde(default)]
    pub inaccurate: Vec<Bound>,
    /// The boundary by theory.
    pub theory: Option<Theory>,
    /// Across the map.
    pub x: Axis,
    /// Up the map.
    pub y: Axis,
}

/// A parameter: numbers that drive one or more keys, or named choices.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// What it is, with its unit in brackets.
    pub label: String,
    /// Its values, rising.
    #[serde(default)]
    pub values: Vec<f64>,
    /// The keys that a value drives.
    #[serde(default)]
    pub keys: Vec<Key>,
    /// In place of values: named sets of overrides.
    #[serde(default)]
    pub choices: Vec<Choice>,
}

/// A key of the scene that follows an axis' value.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Key {
    /// The key's path, as for `--set`.
    pub path: String,
    /// What the value is multiplied by, in the key's unit over the axis'.
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

    /// The overrides of a place; a number need not be one of the map's. `None` if nothing on the axis is called so.
    pub fn sets(&self, place: &str) -> Option<Vec<String>> {
        if !self.choices.is_empty() {
            return self.choices.iter().find(|c| c.name == place).map(|c| c.set.clone());
        }
        let value = place.parse::<f64>().ok().filter(|value| value.is_finite())?;
        Some(self.keys.iter().map(|key| format!("{}={:?}", key.path, value * key.factor)).collect())
    }

    /// What a place may be called.
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

impl Map {
    /// The map, if it can be swept.
    pub(super) fn sound(self) -> Result<Map, AtlasError> {
        let bounds = self.failed.iter().chain(&self.inaccurate);
        let empty = bounds.into_iter().find(|b| b.least.is_none() && b.most.is_none());
        let axes = self.x.check().and_then(|()| self.y.check());
        let wrong = match (axes, empty) {
            (Err(why), _) => why,
            (_, Some(bound)) => format!("bound on `{}`: expected `least` or `most`", bound.quantity),
            (Ok(()), None) => return Ok(self),
        };
        Err(AtlasError::Map(self.name, wrong))
    }

    /// The command that runs a point again.
    pub fn command(&self, x: &str, y: &str) -> String {
        format!("splashdown stability {} --point {x},{y}", self.name)
    }
}
