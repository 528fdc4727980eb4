//! The smallest value of a key with which results stay allowed, with their bands.
//!
//! [`Question`] says what may vary and what is allowed; [`Question::answer`] runs the scene with a cheap model inside and, where asked, with
//! particles at the end.

mod margin;
mod search;
mod trial;

use rayon::prelude::*;
use scene::vocabulary::{Status, Verdict};
use scene::{Symmetry, panel_length};
use serde::Serialize;

pub use margin::{Limit, Margin};
use search::{Found, Search, Untried};
pub use trial::Trial;

use crate::evaluate::{EvaluateError, Evaluator};

/// Values at which a range is tried first.
const FIRST: usize = 7;
/// Change of the margin over all values below which they have no influence [-].
const WITHOUT: f64 = 1e-6;
/// Runs that look for an allowed value where none of the first is.
const BESIDE_BEST: usize = 8;
/// Runs of particles that confirm at most.
const CONFIRMATIONS: usize = 4;
/// What is added to the missing part of a value after a run of particles did not confirm it [-].
const BEYOND: f64 = 0.1;

/// Values that a key may have.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// All between two ends.
    Range([f64; 2]),
    /// Some, such as gauges of sheet that can be bought; increasing.
    List(Vec<f64>),
}

/// What is asked.
#[derive(Clone, Debug)]
pub struct Question {
    /// The key, as [`Evaluator::key`] gives it.
    pub key: String,
    /// Its values.
    pub values: Values,
    /// Factor by which limits are kept away from [-].
    pub reserve: f64,
    /// Limits of results, besides the allowable stresses of the scene's panels.
    pub limits: Vec<Limit>,
    /// Is the value confirmed by particles?
    pub confirm: bool,
}

/// What was found.
#[derive(Clone, Debug, Serialize)]
pub struct Sized {
    /// The key.
    pub key: String,
    /// Its value: the smallest that is allowed, or the largest.
    pub value: f64,
    /// Is it the largest? Then smaller values are allowed and larger ones are not.
    pub is_largest: bool,
    /// Is the end of the range allowed, so that no limit decided?
    pub at_end: bool,
    /// The trial at this value.
    pub decided: Trial,
    /// Runs of particles at the end, the last at this value.
    pub confirmed: Vec<Trial>,
    /// All trials of the cheap model, by value.
    pub trials: Vec<Trial>,
    /// Sentences that a reader must know.
    pub notes: Vec<String>,
}

impl Question {
    /// Find the value: `cheap` runs the model inside, `particles` the one that confirms.
    ///
    /// # Errors
    /// A value that the scene refuses; no value that is allowed; no result with a limit.
    pub fn answer(&self, cheap: &Evaluator, particles: &Evaluator) -> Result<Sized, EvaluateError> {
        let trial = |of: &Evaluator, value: f64| self.trial(of, value);
        let values: Vec<f64> = match &self.values {
            Values::List(values) => values.clone(),
            Values::Range([from, to]) => {
                (0..FIRST).map(|k| from + (to - from) * k as f64 / (FIRST - 1) as f64).collect()
            }
        };
        if let Values::List(values) = &self.values {
            values.iter().try_for_each(|value| cheap.load(&[(self.key.as_str(), *value)]).map(|_| ()))?;
        }
        let mut search = Search::of(Vec::new(), Vec::new());
        let first: Result<Vec<_>, EvaluateError> = values.par_iter().map(|value| trial(cheap, *value)).collect();
        first?.into_iter().for_each(|one| search.add(one));
        if let (true, Some(Untried { value, why })) = (search.trials.is_empty(), search.untried.first()) {
            return Err(EvaluateError::Key(format!("{}: no value can be run; {value}: {why}", self.key)));
        }
        let is_range = matches!(self.values, Values::Range(_));
        for _ in 0..if is_range { BESIDE_BEST } else { 0 } {
            match search.beside_best().filter(|_| search.boundary().is_none()) {
                Some(next) => search.add(trial(cheap, next)?),
                None => break,
            }
        }
        let Some(mut found) = search.boundary() else {
            return Err(self.none_allowed(&search, [values[0], values[values.len() - 1]]));
        };
        while let Some(next) = found.next().filter(|_| is_range) {
            search.add(trial(cheap, next)?);
            let Some(nearer) = search.boundary() else { break };
            found = nearer;
        }
        let mut decided = search.at(found.allowed).clone();
        let mut confirmed: Vec<Trial> = Vec::new();
        let mut value = found.allowed;
        while self.confirm && confirmed.len() < CONFIRMATIONS {
            let run = match trial(particles, value)? {
                Ok(run) => run,
                Err(failed) => {
                    return Err(EvaluateError::Key(format!("{} = {value} by particles: {}", self.key, failed.why)));
                }
            };
            let margin = run.margin.share;
            confirmed.push(run);
            if margin >= 0.0 {
                break;
            }
            let Some(next) = self.further(&search, &found, value, margin) else { break };
            value = next;
            if let Ok(one) = trial(cheap, value)? {
                decided = one;
            }
        }
        Ok(Sized {
            notes: notes(&found, &decided, &confirmed, &search),
            key: self.key.clone(),
            value,
            is_largest: found.is_largest,
            at_end: found.is_at_end(),
            decided,
            confirmed,
            trials: search.trials,
        })
    }

    fn trial(&self, evaluator: &Evaluator, value: f64) -> Result<Result<Trial, Untried>, EvaluateError> {
        let values = [(self.key.as_str(), value)];
        let (answer, scene) = match (evaluator.evaluate(&values), evaluator.load(&values)) {
            (Ok(answer), Ok(loaded)) => (answer, loaded.scene),
            (Err(error), _) | (_, Err(error)) => return Ok(Err(Untried { value, why: error.to_string() })),
        };
        if answer.status == Status::Failed {
            return Ok(Err(Untried { value, why: answer.message.clone().unwrap_or_default() }));
        }
        let margin = Margin::of(&answer, self.reserve, &self.limits)?;
        let panels = scene.body.iter().flat_map(|body| body.panels.iter().map(move |panel| (body, panel)));
        let mass: f64 = panels.map(|(body, p)| p.thickness * p.density * panel_length(body, p)).sum();
        let sides = if scene.symmetry == Symmetry::X { 2.0 } else { 1.0 };
        let model = answer.model.into();
        let doubts = answer.doubts_about(&margin.decided_by);
        Ok(Ok(Trial { value, model, margin, panel_mass_kg_per_m: sides * mass.abs(), doubts }))
    }

    /// The next value to confirm, after one that particles found short of a margin.
    fn further(&self, search: &Search, found: &Found, value: f64, margin: f64) -> Option<f64> {
        match &self.values {
            Values::List(values) if found.is_largest => values.iter().rev().find(|next| **next < value).copied(),
            Values::List(values) => values.iter().find(|next| **next > value).copied(),
            Values::Range([from, to]) => {
                let slope = search.slope(value)?;
                let next = value - margin * (1.0 + BEYOND) / slope;
                (*from..=*to).contains(&next).then_some(next)
            }
        }
    }

    fn none_allowed(&self, search: &Search, [from, to]: [f64; 2]) -> EvaluateError {
        let Trial { value, margin, .. } = search.best();
        let (key, share, by) = (&self.key, 100.0 * margin.share, &margin.decided_by);
        let best = format!("the best is {value} with a margin of {share:+.1} % ({by})");
        let left_out = cannot_be_run(search).map_or(String::new(), |sentence| format!("; {sentence}"));
        EvaluateError::Key(format!("{key}: no value from {from} to {to} is allowed: {best}{left_out}"))
    }
}

/// Which values cannot be run, and why the first of them cannot.
fn cannot_be_run(search: &Search) -> Option<String> {
    let Untried { value, why } = search.untried.first()?;
    let more = search.untried.len() - 1;
    let others = if more > 0 { format!(" (and {more} more)") } else { String::new() };
    Some(format!("{value}{others} cannot be run and is left out: {why}"))
}

/// Sentences that a reader must know.
fn notes(found: &Found, decided: &Trial, confirmed: &[Trial], search: &Search) -> Vec<String> {
    let mut notes: Vec<String> = cannot_be_run(search).into_iter().collect();
    let is_mean = |trial: &Trial| {
        ["peak_force", "peak_acceleration"].iter().any(|name| trial.margin.decided_by.starts_with(name))
    };
    if confirmed.iter().any(is_mean) {
        notes.push("particles quote means of forces and accelerations, theories do not without report.bandwidth: give both the same".into());
    }
    let margins = || search.trials.iter().map(|trial| trial.margin.share);
    if margins().fold(f64::NEG_INFINITY, f64::max) - margins().fold(f64::INFINITY, f64::min) < WITHOUT {
        notes.push("the value has no influence on what decides".into());
    }
    if found.is_at_end() {
        notes.push("all values that can be run are allowed: no limit decides within the range".into());
    }
    match found.until {
        Some(until) => notes.push(format!("{until} and larger values are not allowed: see the trials")),
        None if !search.is_monotone(found.is_largest) => {
            notes.push("the margin does not grow steadily with the value: see the trials".into());
        }
        None => {}
    }
    let Trial { margin: judged, doubts, .. } = confirmed.last().unwrap_or(decided);
    let by = &judged.decided_by;
    if let Some(verdict) = judged.verdict.filter(|verdict| *verdict != Verdict::Resolved) {
        notes.push(format!("{by}: {}", verdict.words()));
    }
    if judged.verdict.is_none() {
        notes.push(format!("{by}: not judged"));
    }
    if judged.band.is_none() {
        notes.push(format!("{by}: no band is in the margin"));
    }
    notes.extend(doubts.iter().cloned());
    if confirmed.last().is_some_and(|last| last.margin.share < 0.0) {
        notes.push("particles do not confirm it within the range".into());
    }
    notes
}
