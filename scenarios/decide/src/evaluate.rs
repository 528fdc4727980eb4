//! Runs of one scene with other values of its keys, in this process and without files.

use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use run::{RunError, RunOptions};
use scene::vocabulary::{Doubt, Doubts, Status};
use scene::{Loaded, SceneError};

use crate::numbers::{Number, usual};

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum EvaluateError {
    /// The scene, or a value of a key in it.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The run.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A key that the question names.
    #[error("{0}")]
    Key(String),
}

/// What a run gave.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The model that was run.
    pub model: &'static str,
    /// How it ended.
    pub status: Status,
    /// Why it did not complete.
    pub message: Option<String>,
    /// Results by name, those of panels as `PANEL.peak_stress_Pa`.
    pub numbers: BTreeMap<String, Number>,
    /// Doubts about them.
    pub doubts: Doubts,
    /// Names of the curves' columns; the first is `time_s`.
    pub columns: Vec<String>,
    /// Rows of the curves, shape (n, columns).
    pub rows: Vec<Vec<f64>>,
    /// Wall-clock time [s].
    pub seconds: f64,
}

impl Answer {
    /// Sentences of the doubts about a result, that a panel is beyond its limits apart.
    pub fn doubts_about(&self, name: &str) -> Vec<String> {
        let is_about = |about: &String| {
            name == about || name.strip_prefix(about.as_str()).is_some_and(|rest| rest.starts_with('.'))
        };
        let of_name = |doubt: &&Doubt| doubt.about.is_empty() || doubt.about.iter().any(is_about);
        self.doubts.iter().filter(|doubt| !doubt.why.beyond_limit).filter(of_name).map(Doubt::to_string).collect()
    }

    /// A curve at a time [s], linear between samples; its ends beyond them. `None` of an unknown column.
    pub fn curve(&self, column: &str) -> Option<impl Fn(f64) -> f64 + '_> {
        let k = self.columns.iter().position(|name| name == column)?;
        self.rows.first()?;
        Some(move |time: f64| {
            let after = self.rows.partition_point(|row| row[0] <= time);
            if after == 0 || after == self.rows.len() {
                return self.rows[after.saturating_sub(1)][k];
            }
            let [a, b] = [&self.rows[after - 1], &self.rows[after]];
            a[k] + (b[k] - a[k]) * ((time - a[0]) / (b[0] - a[0]))
        })
    }
}

/// Run a scene.
fn answer(loaded: &Loaded) -> Result<Answer, EvaluateError> {
    let start = Instant::now();
    let options = RunOptions { without_log: true, warnings: loaded.warnings.clone(), ..RunOptions::default() };
    let outcome = run::run(&loaded.scene, &options)?;
    let summary = serde_json::to_value(&outcome.summary).unwrap_or_default();
    Ok(Answer {
        model: outcome.summary.model,
        status: outcome.summary.status,
        message: outcome.summary.message.clone(),
        numbers: usual(&summary).into_iter().collect(),
        doubts: outcome.summary.doubts.clone(),
        columns: outcome.series.columns().to_vec(),
        rows: outcome.series.rows().to_vec(),
        seconds: start.elapsed().as_secs_f64(),
    })
}

/// A scene, and the answers so far.
pub struct Evaluator {
    scene: String,
    sets: Vec<String>,
    answers: Mutex<HashMap<String, Arc<Answer>>>,
}

impl Evaluator {
    /// A scene by name or path, with `key=value` overrides.
    ///
    /// # Errors
    /// The scene is wrong.
    pub fn new(scene: &str, sets: &[String]) -> Result<Evaluator, EvaluateError> {
        run::load(scene, sets)?;
        Ok(Evaluator { scene: scene.into(), sets: sets.to_vec(), answers: Mutex::default() })
    }

    /// The same scene with further overrides, and no answers.
    pub fn with(&self, sets: &[String]) -> Evaluator {
        Evaluator { scene: self.scene.clone(), sets: [&self.sets[..], sets].concat(), answers: Mutex::default() }
    }

    /// The scene with values of keys.
    ///
    /// # Errors
    /// A value that the scene refuses.
    pub fn load(&self, values: &[(&str, f64)]) -> Result<Loaded, EvaluateError> {
        // a whole number stands for both kinds
        let given = values.iter().map(|(key, value)| match value.fract() == 0.0 && value.abs() < 1e15 {
            true => format!("{key}={value:.0}"),
            false => format!("{key}={value:?}"),
        });
        Ok(run::load(&self.scene, &self.sets.iter().cloned().chain(given).collect::<Vec<_>>())?)
    }

    /// Run the scene with values of keys; the same values run once.
    ///
    /// # Errors
    /// A value that the scene refuses, or a run that cannot be built. One that fails on its way is an [`Answer`].
    pub fn evaluate(&self, values: &[(&str, f64)]) -> Result<Arc<Answer>, EvaluateError> {
        let loaded = self.load(values)?;
        let scene = loaded.scene.to_toml();
        let known = || self.answers.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(answer) = known().get(&scene) {
            return Ok(Arc::clone(answer));
        }
        let answer = Arc::new(answer(&loaded)?);
        known().insert(scene, Arc::clone(&answer));
        Ok(answer)
    }

    /// The same, and the answer is not kept.
    ///
    /// # Errors
    /// As [`Evaluator::evaluate`].
    pub fn evaluate_once(&self, values: &[(&str, f64)]) -> Result<Answer, EvaluateError> {
        answer(&self.load(values)?)
    }

    /// Number of answers so far.
    pub fn count(&self) -> usize {
        self.answers.lock().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// The key as a scene has it: `panels.belly.thickness`, by a panel's name, is `body.panels[0].thickness`.
    ///
    /// # Errors
    /// A panel that the scene does not have; a key without a number in it.
    pub fn key(&self, given: &str) -> Result<String, EvaluateError> {
        let scene = self.load(&[])?.scene;
        let of_panel = given.strip_prefix("body.").unwrap_or(given).strip_prefix("panels.");
        let key = match of_panel.and_then(|rest| rest.split_once('.')) {
            Some((name, rest)) if name.parse::<usize>().is_err() => {
                let panels = scene.body.as_ref().map_or(&[][..], |body| &body.panels);
                let known: Vec<&str> = panels.iter().map(|panel| panel.name.as_str()).collect();
                let Some(k) = known.iter().position(|known| *known == name) else {
                    let expected = if known.is_empty() { "the scene has none".into() } else { known.join(", ") };
                    return Err(EvaluateError::Key(format!("{given}: no panel `{name}`: expected one of: {expected}")));
                };
                format!("body.panels[{k}].{rest}")
            }
            _ => given.into(),
        };
        self.value(&key).map(|_| key)
    }

    /// The number that a text is as a key's value, in the key's unit: `2 mm` of a length is 0.002.
    ///
    /// # Errors
    /// A text that the key refuses.
    pub fn read(&self, key: &str, text: &str) -> Result<f64, EvaluateError> {
        match text.trim().parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => self.with(&[format!("{key}={}", text.trim())]).value(key),
        }
    }

    /// The number that a key has in the scene.
    ///
    /// # Errors
    /// A key without a number in it.
    pub fn value(&self, key: &str) -> Result<f64, EvaluateError> {
        let text = self.load(&[])?.scene.to_toml();
        let table: toml::Table = toml::from_str(&text).unwrap_or_default();
        let steps: Vec<_> = scene::source::segments(key).collect();
        let whole = toml::Value::Table(table);
        let found = steps.iter().try_fold(&whole, |at, step| match step {
            scene::source::Segment::Key(name) => at.get(*name),
            scene::source::Segment::Index(k) => at.get(*k),
        });
        let number = found.and_then(|value| value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64)));
        number.ok_or_else(|| EvaluateError::Key(format!("{key}: the scene has no number there: expected a key with one, as body.mass or panels.NAME.thickness (`splashdown keywords` lists them)")))
    }
}
