//! From a request to its answer.

use std::path::PathBuf;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use crate::answers::of_formulas;
use crate::grid;
use crate::http::{Answer, Head, Kind, Refusal};
use crate::scene_view::{self, view};
use crate::shared::Shared;
use crate::{outline, page};

/// Files of a run that the page shows or hands over.
const FILES: [(&str, Kind); 4] = [
    ("report.html", Kind::Report),
    ("series.csv", Kind::Text),
    ("summary.json", Kind::Json),
    ("scene.resolved.toml", Kind::Text),
];
/// Most runs that one page compares.
const MOST_COMPARED: usize = 12;

/// A scene's text.
#[derive(Deserialize)]
struct Text {
    text: String,
    #[serde(default)]
    page: String,
}

/// A grid.
#[derive(Deserialize)]
struct Number {
    id: u64,
}

fn parsed<T: DeserializeOwned>(body: &[u8]) -> Result<T, Refusal> {
    serde_json::from_slice(body).map_err(|cause| Refusal::new(400, format!("expected JSON of another form: {cause}")))
}

fn unknown() -> Refusal {
    Refusal::new(404, "there is nothing at this address")
}

/// The answer to a request that may ask.
///
/// # Errors
/// An unknown address, or a body of another form.
pub fn answer(studio: &Shared, head: &Head, body: &[u8]) -> Result<Answer, Refusal> {
    let path: Vec<&str> = head.path.iter().map(String::as_str).collect();
    let found = match (head.method.as_str(), path.as_slice()) {
        ("GET", []) => Answer::new(Kind::Page, page::page(studio.guard.token())),
        ("GET", ["studio.js"]) => Answer::new(Kind::Script, page::SCRIPT),
        ("GET", ["studio.css"]) => Answer::new(Kind::Style, page::STYLE),
        ("GET", ["runs", name, file]) => file_of_run(studio, name, file)?,
        ("GET", ["api", "runs", name, "picture"]) => picture(studio, name),
        ("GET", ["api", "compare"]) => compare(studio, head.query("run").collect())?,
        ("GET" | "POST", ["api", rest @ ..]) => Answer::json(&json_answer(studio, head, rest, body)?),
        ("GET" | "POST", _) => return Err(unknown()),
        _ => return Err(Refusal::new(405, "expected GET or POST")),
    };
    Ok(found)
}

fn json_answer(studio: &Shared, head: &Head, path: &[&str], body: &[u8]) -> Result<Value, Refusal> {
    Ok(match (head.method.as_str(), path) {
        ("GET", ["start"]) => start(studio),
        ("POST", ["scene"]) => view(&studio.options.folder, &parsed::<scene_view::Asked>(body)?),
        ("POST", ["theories"]) => {
            let Text { text, .. } = parsed(body)?;
            json!(of_formulas(&studio.options.folder, &text))
        }
        ("POST", ["flow"]) => {
            let Text { text, page } = parsed(body)?;
            studio.flows.answer(&studio.options.program, &studio.options.folder, &text, &page)
        }
        ("POST", ["outline"]) => {
            outline::read(head.query("name").next().unwrap_or_default(), head.query("unit").next(), body)
        }
        ("GET", ["runs"]) => studio.runs.list(),
        ("POST", ["runs"]) => studio.runs.add(&studio.options.folder, &parsed::<Text>(body)?.text),
        ("GET", ["runs", name, "answer"]) => studio.runs.answer(name).map_err(|why| Refusal::new(404, why))?,
        ("POST", ["runs", name, "stop"]) => json!({"stopped": studio.runs.stop(name)}),
        ("POST", ["grid"]) => studio.grids.start(&studio.options.folder, parsed::<grid::Asked>(body)?),
        ("GET", ["grid"]) => {
            let id = head.query("id").next().and_then(|id| id.parse().ok()).ok_or_else(unknown)?;
            studio.grids.progress(id).ok_or_else(unknown)?
        }
        ("POST", ["grid", "stop"]) => json!({"stopped": studio.grids.stop(parsed::<Number>(body)?.id)}),
        _ => return Err(unknown()),
    })
}

/// What the page needs before its first scene.
fn start(studio: &Shared) -> Value {
    let examples = studio.options.examples.iter().map(|(name, text)| json!({"name": name, "text": text}));
    json!({
        "text": studio.options.text,
        "file": studio.options.file,
        "folder": studio.options.folder.display().to_string(),
        "examples": examples.collect::<Vec<_>>(),
        "keywords": scene::schema().keywords(),
        "version": env!("CARGO_PKG_VERSION"),
    })
}

fn file_of_run(studio: &Shared, name: &str, file: &str) -> Result<Answer, Refusal> {
    let (file, kind) = FILES.into_iter().find(|(own, _)| *own == file).ok_or_else(unknown)?;
    let folder = studio.runs.folder_of(name).ok_or_else(unknown)?;
    std::fs::read(folder.join(file)).map(|content| Answer::new(kind, content)).map_err(|_| unknown())
}

/// The newest frame; an empty answer before the first.
fn picture(studio: &Shared, name: &str) -> Answer {
    Answer::new(Kind::Png, studio.runs.picture(name).unwrap_or_default())
}

fn compare(studio: &Shared, names: Vec<&str>) -> Result<Answer, Refusal> {
    let folders: Option<Vec<PathBuf>> = names.iter().map(|name| studio.runs.folder_of(name)).collect();
    let folders = folders.filter(|folders| (2..=MOST_COMPARED).contains(&folders.len()));
    let folders = folders.ok_or_else(|| Refusal::new(404, format!("expected 2 to {MOST_COMPARED} runs")))?;
    let page = report::run_page::compare(&folders).map_err(|error| Refusal::new(404, error.to_string()))?;
    Ok(Answer::new(Kind::Report, page))
}
