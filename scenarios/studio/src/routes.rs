//! From a request to its answer.

use std::borrow::Cow;
use std::path::PathBuf;

use oxhttp::model::request::Parts;
use oxhttp::model::{Body, Response, StatusCode};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use crate::answers::{of_folder, of_formulas};
use crate::http::{self, Kind, Refusal, query};
use crate::scene_view::{self, view};
use crate::shared::Shared;
use crate::{grid, outline, page};

/// Files of a run that the page shows or hands over.
const FILES: [(&str, Kind); 4] = [
    ("report.html", http::REPORT),
    ("series.csv", http::TEXT),
    ("summary.json", http::JSON),
    ("scene.resolved.toml", http::TEXT),
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

fn parsed<T: DeserializeOwned>(body: &[u8]) -> Result<T, Refusal> {
    serde_json::from_slice(body)
        .map_err(|cause| Refusal::new(StatusCode::BAD_REQUEST, format!("expected JSON of another form: {cause}")))
}

fn not_found(why: impl Into<String>) -> Refusal {
    Refusal::new(StatusCode::NOT_FOUND, why)
}

fn unknown() -> Refusal {
    not_found("there is nothing at this address")
}

/// The answer to a request that may ask.
///
/// # Errors
/// An unknown address, or a body of another form.
pub fn answer(studio: &Shared, head: &Parts, body: &[u8]) -> Result<Response<Body>, Refusal> {
    let path = http::path(&head.uri)?;
    let path: Vec<&str> = path.iter().map(|part| part.as_ref()).collect();
    Ok(match (head.method.as_str(), path.as_slice()) {
        ("GET", []) => http::answer(http::PAGE, page::PAGE.replace(page::TOKEN, &studio.guard.token)),
        ("GET", ["studio.js"]) => http::answer(http::SCRIPT, page::SCRIPT),
        ("GET", ["studio.css"]) => http::answer(http::STYLE, page::STYLE),
        ("GET", ["runs", name, file]) => file_of_run(studio, name, file)?,
        // empty before the first frame
        ("GET", ["api", "runs", name, "picture"]) => {
            http::answer(http::PNG, studio.runs.picture(name).unwrap_or_default())
        }
        ("GET", ["api", "compare"]) => compare(studio, query(head, "run").collect())?,
        ("GET" | "POST", ["api", rest @ ..]) => {
            http::answer(http::JSON, json_answer(studio, head, rest, body)?.to_string())
        }
        ("GET" | "POST", _) => return Err(unknown()),
        _ => return Err(Refusal::new(StatusCode::METHOD_NOT_ALLOWED, "expected GET or POST")),
    })
}

fn json_answer(studio: &Shared, head: &Parts, path: &[&str], body: &[u8]) -> Result<Value, Refusal> {
    let folder = &studio.options.folder;
    let id = || query(head, "id").next().and_then(|id| id.parse().ok()).ok_or_else(unknown);
    Ok(match (head.method.as_str(), path) {
        ("GET", ["start"]) => start(studio),
        ("POST", ["scene"]) => view(folder, &parsed::<scene_view::Asked>(body)?),
        ("POST", ["theories"]) => json!(of_formulas(folder, &parsed::<Text>(body)?.text)),
        ("POST", ["flow"]) => {
            let Text { text, page } = parsed(body)?;
            let (Ok(answer) | Err(answer)) = studio.flows.answer(&studio.options.program, folder, &text, &page);
            answer
        }
        ("POST", ["outline"]) => {
            outline::read(&query(head, "name").next().unwrap_or_default(), query(head, "unit").next().as_deref(), body)
        }
        ("GET", ["runs"]) => studio.runs.list(),
        ("POST", ["runs"]) => studio.runs.add(folder, &parsed::<Text>(body)?.text),
        ("GET", ["runs", name, "answer"]) => {
            let folder = studio.runs.folder_of(name).ok_or_else(unknown)?;
            of_folder(&folder).map_err(not_found)?
        }
        ("POST", ["runs", name, "stop"]) => json!({"stopped": studio.runs.stop(name)}),
        ("POST", ["grid"]) => {
            let begun = studio.grids.start(folder, parsed::<grid::Asked>(body)?);
            json!({"id": begun.as_ref().ok(), "error": begun.as_ref().err()})
        }
        ("GET", ["grid"]) => studio.grids.progress(id()?).ok_or_else(unknown)?,
        ("POST", ["grid", "stop"]) => json!({"stopped": studio.grids.stop(id()?)}),
        _ => return Err(unknown()),
    })
}

/// What the page needs before its first scene.
fn start(studio: &Shared) -> Value {
    let examples = studio.options.examples.iter().map(|(name, text)| json!({"name": name, "text": text}));
    json!({
        "text": studio.options.text,
        "file": studio.options.file,
        "examples": examples.collect::<Vec<_>>(),
        "keywords": scene::schema().keywords(),
    })
}

fn file_of_run(studio: &Shared, name: &str, file: &str) -> Result<Response<Body>, Refusal> {
    let (file, kind) = FILES.into_iter().find(|(own, _)| *own == file).ok_or_else(unknown)?;
    let folder = studio.runs.folder_of(name).ok_or_else(unknown)?;
    std::fs::read(folder.join(file)).map(|content| http::answer(kind, content)).map_err(|_| unknown())
}

fn compare(studio: &Shared, names: Vec<Cow<'_, str>>) -> Result<Response<Body>, Refusal> {
    let folders: Option<Vec<PathBuf>> = names.iter().map(|name| studio.runs.folder_of(name)).collect();
    let folders = folders.filter(|folders| (2..=MOST_COMPARED).contains(&folders.len()));
    let folders = folders.ok_or_else(|| not_found(format!("expected 2 to {MOST_COMPARED} runs")))?;
    let page = report::run_page::compare(&folders).map_err(|error| not_found(error.to_string()))?;
    Ok(http::answer(http::REPORT, page))
}
