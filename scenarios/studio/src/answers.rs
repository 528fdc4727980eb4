//! What a model says of a scene: curves, results with band and verdict, the number to quote in words.

use std::path::Path;
use std::thread;

use report::COARSE;
use report::run_page::quantity::with_unit;
use report::run_page::two_digits;
use run::RunOptions;
use scene::vocabulary::{Doubt, Quantity, ResultId, ResultName, Results, Verdict};
use scene::{EntryModel, Loaded, SceneError};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::edit::{Edit, EditError, apply};
use crate::scene_view::{load, mistake};

/// Rows of a curve that the page draws, at most.
const MOST_ROWS: usize = 400;
/// What is said of a largest force at the end of the time.
const GROWING: &str = "Do not quote it as the peak: at the end of the time it may still grow. A later end shows more.";
/// Ends of the columns that are drawn, with their title and SI unit.
const CURVES: [(&str, &str, &str); 3] =
    [(".fy_N_per_m", "Force", "N/m"), (".vy_m_per_s", "Speed", "m/s"), (".ay_m_per_s2", "Acceleration", "m/s²")];

/// The answers of all formulas, from the simplest.
pub fn of_formulas(folder: &Path, text: &str) -> Vec<Value> {
    let formulas: Vec<EntryModel> = EntryModel::ALL.into_iter().filter(|model| model.is_formula()).collect();
    thread::scope(|scope| {
        let asked: Vec<_> = formulas.iter().map(|model| scope.spawn(move || of_theory(folder, text, *model))).collect();
        let answers = asked.into_iter().zip(&formulas).map(|(asked, model)| match asked.join() {
            Ok(Ok(answer) | Err(answer)) => answer,
            Err(_) => none(model.name(), "it broke down"),
        });
        answers.collect()
    })
}

/// A model in words.
pub fn title(model: &str) -> &str {
    match model {
        "von_karman" => "von Kármán",
        "wagner" => "Wagner",
        "mlm" => "modified Logvinovich",
        "similarity" => "similarity solution",
        "boundary_element" => "boundary elements",
        "wcsph" => "particles",
        "incompressible" => "incompressible particles",
        other => other,
    }
}

/// The text with another model, without the keys of `model = "auto"` and without a solver.
///
/// # Errors
/// A text that is no TOML.
pub fn with_model(text: &str, model: &str) -> Result<String, EditError> {
    apply(text, &[Edit::remove("solver"), Edit::remove("want"), Edit::remove("within"), Edit::set("model", model)])
}

/// The scene of a text with another model.
///
/// # Errors
/// The answer of a model that does not follow it.
pub fn loaded_with(folder: &Path, text: &str, model: EntryModel) -> Result<Loaded, Value> {
    let text = with_model(text, model.name()).map_err(|error| none(model.name(), &error.why))?;
    load(folder, &text, &[]).map_err(|error| refused(model.name(), &error))
}

/// The answer of a theory, computed here.
fn of_theory(folder: &Path, text: &str, model: EntryModel) -> Result<Value, Value> {
    let loaded = loaded_with(folder, text, model)?;
    let options = RunOptions { without_log: true, ..RunOptions::default() };
    let outcome = run::run(&loaded.scene, &options).map_err(|error| none(model.name(), &error.to_string()))?;
    let summary = serde_json::to_value(&outcome.summary).unwrap_or_default();
    Ok(answer(&summary, outcome.series.columns(), outcome.series.rows()))
}

/// A model that does not answer, and why.
pub fn none(model: &str, why: &str) -> Value {
    json!({"model": model, "title": title(model), "ok": false, "why": why})
}

/// A model that refuses the scene.
pub fn refused(model: &str, error: &SceneError) -> Value {
    let mistake = mistake(error);
    // of a theory outside its range, the range
    let range = mistake["expected"].as_str().and_then(|expected| expected.strip_prefix("a scene it holds for: "));
    let range = range.map(|range| format!("holds for {range}"));
    none(model, range.as_deref().or(mistake["message"].as_str()).unwrap_or_default())
}

/// The answer in the folder of a run.
///
/// # Errors
/// The folder holds no whole run.
pub fn of_folder(dir: &Path) -> Result<Value, String> {
    let read = |name: &str| std::fs::read_to_string(dir.join(name)).map_err(|cause| format!("{name}: {cause}"));
    let summary: Value =
        serde_json::from_str(&read("summary.json")?).map_err(|cause| format!("summary.json: {cause}"))?;
    let series = read("series.csv")?;
    let mut lines = series.lines();
    let columns: Vec<String> = lines.next().unwrap_or_default().split(',').map(String::from).collect();
    let row = |line: &str| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
    let rows: Vec<Vec<f64>> = lines.map(row).collect();
    Ok(answer(&summary, &columns, &rows))
}

/// The answer of a summary and its curves.
fn answer(summary: &Value, columns: &[String], rows: &[Vec<f64>]) -> Value {
    let model = summary["model"].as_str().unwrap_or_default();
    let results = Results::deserialize(&summary["results"]).unwrap_or_default();
    let (results, growing) = doubted(results, ends(rows));
    let mut doubts: Vec<String> = Vec::deserialize(&summary["doubts"]).unwrap_or_default();
    doubts.extend(growing.iter().map(Doubt::to_string).filter(|growing| !doubts.contains(growing)).collect::<Vec<_>>());
    let place = |end: &str| columns.iter().position(|column| column.ends_with(end));
    let every = rows.len().div_ceil(MOST_ROWS).max(1);
    let shown = || rows.iter().enumerate().filter(|(k, _)| k % every == 0 || k + 1 == rows.len()).map(|(_, row)| row);
    let finite =
        |k: usize| shown().map(|row| row.get(k).copied().filter(|value| value.is_finite())).collect::<Vec<_>>();
    let curve = |(end, title, si): &(&str, &str, &str)| {
        place(end).map(|k| json!({"title": title, "si": si, "values": finite(k)}))
    };
    json!({
        "model": model,
        "title": title(model),
        "ok": true,
        "time": finite(0),
        "curves": CURVES.iter().filter_map(curve).collect::<Vec<_>>(),
        "results": results.named().map(|(id, quantity)| result(&id, quantity)).collect::<Vec<_>>(),
        "quote": quote(model, &results, growing.as_ref()),
        "doubts": doubts,
    })
}

/// First and last time of rows [s].
pub fn ends(rows: &[Vec<f64>]) -> Option<[f64; 2]> {
    Some([*rows.first()?.first()?, *rows.last()?.first()?])
}

/// Results between two times [s], and a doubt about those that are largest at the end, whatever moves the body.
pub fn doubted(mut results: Results, ends: Option<[f64; 2]>) -> (Results, Option<Doubt>) {
    let growing = ends.and_then(|ends| results.still_growing(ends));
    (results, growing)
}

/// A result with its unit and in words.
pub fn result(id: &ResultId, quantity: &Quantity) -> Value {
    json!({
        "name": id.to_string(),
        "title": id.title(),
        "si": id.name.si(),
        "value": quantity.shown(),
        "band": quantity.band,
        "share": quantity.share(),
        "verdict": quantity.verdict.name(),
        "verdict_words": quantity.verdict.words(),
        "text": number(quantity, id.name.si()),
    })
}

/// A number with its band.
pub fn number(quantity: &Quantity, si: &str) -> String {
    let Some(value) = quantity.shown() else { return "withheld: its band is as large as itself".into() };
    let share = quantity.share().map_or(String::new(), |share| format!(" ± {} %", two_digits(100.0 * share)));
    format!("{}{share}", with_unit(value, si))
}

/// The number to quote in words: what it is, and what may be said of it.
fn quote(model: &str, results: &Results, growing: Option<&Doubt>) -> Value {
    let Some(force) = results.get(ResultName::PeakForce) else { return Value::Null };
    let time = force.time_s.map_or(String::new(), |time| format!(", {} after the start", with_unit(time, "s")));
    let also =
        |id: &ResultId| id.panel.is_some() || [ResultName::PeakAcceleration, ResultName::Impulse].contains(&id.name);
    let others = results.named().filter(|(id, _)| also(id));
    let others = others.map(|(id, quantity)| format!("{}: {}", id.title(), number(quantity, id.name.si())));
    let grows = growing.is_some_and(|doubt| doubt.about.iter().any(|name| name == ResultName::PeakForce.name()));
    json!({
        "value": force.shown(),
        "share": force.share(),
        "verdict": force.verdict.name(),
        "number": number(&force, "N/m"),
        "by": format!("per metre of span, by {}{time}", title(model)),
        "verdict_in_words": if grows { GROWING.into() } else { verdict(&force) },
        "others": others.collect::<Vec<_>>(),
    })
}

/// What may be said of a force, in a sentence or two.
fn verdict(force: &Quantity) -> String {
    match (force.verdict, force.share()) {
        (Verdict::Resolved, Some(share)) if share > COARSE => {
            format!("Coarse: the true value may be {} % higher or lower.", two_digits(100.0 * share))
        }
        (Verdict::Resolved, share) => {
            let within = share.map_or(String::new(), |share| format!(", {} %", two_digits(100.0 * share)));
            format!(
                "Resolved. Quote it with its band{within}: in the nearest cases this model was no farther from exact solutions or fine particles."
            )
        }
        (Verdict::Acoustic, _) => {
            "Do not quote it alone: the peak depends on the speed of sound and on the time of averaging. Quote the impulse.".into()
        }
        (Verdict::NotResolved, _) => "Do not quote it: it is not resolved.".into(),
        (Verdict::NoBand, _) => {
            "No band is known: no case near this one was measured. Compare it with a run by particles before you quote it.".into()
        }
    }
}
