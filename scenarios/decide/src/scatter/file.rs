//! The file of a scatter: a scene and how its inputs scatter.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::LazyLock;

use nalgebra::DMatrix;
use scene::read_text;
use scene::source::Source;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use settings::{Problem, Schema};

use super::distribution::Distribution;
use crate::evaluate::EvaluateError;

/// The file of a scatter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ScatterFile {
    /// Scene: a built-in name, or a path from the folder of this file.
    pub scene: String,
    /// Number of samples, a Latin hypercube.
    #[serde(default = "usual_samples")]
    #[schemars(range(min = 20, max = 100_000))]
    pub samples: usize,
    /// Start of the random numbers.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub seed: u32,
    /// A value of the scene that is the same in all samples.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, Value>")]
    pub set: Map<String, Value>,
    /// Inputs that scatter: normal = [mean, standard deviation], uniform = [from, to], weibull = [scale, shape], table = [values],
    /// which were measured, linear between neighbours.
    #[schemars(with = "BTreeMap<String, Value>")]
    pub inputs: BTreeMap<String, Distribution>,
    /// Correlations of pairs of inputs, of the normal distributions that stand for them.
    #[serde(default)]
    pub correlations: Vec<Correlation>,
}

/// A correlation of two inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Correlation {
    /// The two inputs.
    pub keys: [String; 2],
    /// Its value [-].
    #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 1))]
    pub value: f64,
}

fn usual_samples() -> usize {
    1000
}

/// The schema of the file.
pub fn schema() -> &'static Schema {
    static SCHEMA: LazyLock<Schema> = LazyLock::new(|| Schema::of::<ScatterFile>("a scatter"));
    &SCHEMA
}

/// What an input may be.
const FORM: &str =
    "normal = [mean, standard deviation], uniform = [from, to], weibull = [scale, shape] or table = [values]";
/// Names of the distributions.
const FORMS: [&str; 4] = ["normal", "uniform", "weibull", "table"];

/// The table at a key with `body.mass` instead of the table `body` with the key `mass`; tables that are values stay.
fn flatten(given: &mut Value, key: &str, is_value: &dyn Fn(&Map<String, Value>) -> bool) {
    fn leaves(
        path: &str,
        table: Map<String, Value>,
        is_value: &dyn Fn(&Map<String, Value>) -> bool,
        found: &mut Map<String, Value>,
    ) {
        for (key, value) in table {
            let path = if path.is_empty() { key } else { format!("{path}.{key}") };
            match value {
                Value::Object(inner) if !is_value(&inner) => leaves(&path, inner, is_value, found),
                value => {
                    found.insert(path, value);
                }
            }
        }
    }
    if let Some(Value::Object(table)) = given.get_mut(key) {
        let mut found = Map::new();
        leaves("", std::mem::take(table), is_value, &mut found);
        *table = found;
    }
}

impl ScatterFile {
    /// Overrides of the scene, `key=value`.
    pub fn sets(&self) -> Vec<String> {
        let of = |(key, value): (&String, &Value)| {
            let value = toml::Value::try_from(value).map_or_else(|_| value.to_string(), |value| value.to_string());
            format!("{key}={value}")
        };
        self.set.iter().map(of).collect()
    }

    /// Read a file; its scene is looked for from its folder.
    ///
    /// # Errors
    /// The file cannot be read, or its first mistake.
    pub fn read(path: &Path) -> Result<ScatterFile, EvaluateError> {
        let shown = path.display().to_string();
        let text = read_text(path).map_err(|error| EvaluateError::Key(format!("cannot read {shown}: {error}")))?;
        let mut file = ScatterFile::parse(&shown, &text)?;
        let beside = path.parent().unwrap_or(Path::new("")).join(&file.scene);
        if beside.is_file() {
            file.scene = beside.display().to_string();
        }
        Ok(file)
    }

    /// From its text; `shown` stands for the file in messages.
    ///
    /// # Errors
    /// Its first mistake.
    pub fn parse(shown: &str, text: &str) -> Result<ScatterFile, EvaluateError> {
        let source = Source { name: shown.into(), text: text.into(), sets: Vec::new(), schema: schema() };
        let mut given = serde_json::to_value(source.table()?).unwrap_or_default();
        flatten(&mut given, "set", &|_| false);
        flatten(&mut given, "inputs", &|table| table.keys().any(|key| FORMS.contains(&key.as_str())));
        Ok(ScatterFile::of(&given).map_err(|problem| source.error(problem))?)
    }

    /// What is wrong with a key of the file at `path`.
    pub fn error(path: &Path, problem: Problem) -> EvaluateError {
        let text = read_text(path).unwrap_or_default();
        Source { name: path.display().to_string(), text, sets: Vec::new(), schema: schema() }.error(problem).into()
    }

    /// The correlations of the inputs, in their order.
    pub(super) fn correlation_matrix(&self) -> DMatrix<f64> {
        let keys: Vec<&String> = self.inputs.keys().collect();
        let mut matrix = DMatrix::identity(keys.len(), keys.len());
        for Correlation { keys: pair, value } in &self.correlations {
            let [i, j] = pair.each_ref().map(|key| keys.iter().position(|known| *known == key).unwrap_or(0));
            (matrix[(i, j)], matrix[(j, i)]) = (*value, *value);
        }
        matrix
    }

    fn of(given: &Value) -> Result<ScatterFile, Problem> {
        for (key, input) in given.get("inputs").and_then(Value::as_object).into_iter().flatten() {
            Distribution::deserialize(input).map_err(|_| Problem::new(&format!("inputs.{key}"), input, FORM))?;
        }
        let file = ScatterFile::deserialize(schema().check(given)?).map_err(|error| schema().missing("", &error))?;
        if file.inputs.is_empty() {
            return Err(Problem::new(
                "inputs",
                "nothing",
                "a key with its distribution, as \"body.mass\" = { normal = [240, 5] }",
            ));
        }
        for (key, distribution) in &file.inputs {
            if let Some(expected) = distribution.wrong() {
                let given = serde_json::to_string(distribution).unwrap_or_default();
                return Err(Problem::new(&format!("inputs.{key}"), given, expected));
            }
        }
        for (k, Correlation { keys, .. }) in file.correlations.iter().enumerate() {
            let unknown = keys.iter().find(|key| !file.inputs.contains_key(*key));
            if let Some(unknown) = unknown {
                let known = file.inputs.keys().cloned().collect::<Vec<_>>().join(", ");
                return Err(Problem::new(
                    &format!("correlations[{k}].keys"),
                    format!("{unknown:?}"),
                    format!("two of {known}"),
                ));
            }
            let is_same = |other: &Correlation| keys.iter().all(|key| other.keys.contains(key));
            if keys[0] == keys[1] || file.correlations[..k].iter().any(is_same) {
                let expected = "two inputs that no other correlation has";
                return Err(Problem::new(&format!("correlations[{k}].keys"), format!("{keys:?}"), expected));
            }
        }
        if file.correlation_matrix().cholesky().is_none() {
            let values: Vec<f64> = file.correlations.iter().map(|of| of.value).collect();
            let expected = "values that are possible together: a positive definite matrix";
            return Err(Problem::new("correlations", format!("{values:?}"), expected));
        }
        Ok(file)
    }
}
