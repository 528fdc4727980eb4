//! What the commands share that answer by many runs: `size`, `fit`.

use std::fs;
use std::path::{Path, PathBuf};

use decide::{EvaluateError, Evaluator};
use serde::Serialize;

use super::shared::{DONE, Output, Stop, say, to_json, write};

/// Why there is no answer.
pub(super) fn stop(error: EvaluateError) -> Stop {
    match error {
        EvaluateError::Scene(error) => Stop::Scene(error),
        EvaluateError::Run(error) => error.into(),
        EvaluateError::Key(text) => Stop::Input(text),
    }
}

/// A name and a number, `NAME=VALUE`.
pub(super) fn number(option: &str, text: &str, expected: &str) -> Result<(String, f64), Stop> {
    let parts = text.split_once('=').map(|(name, value)| (name.trim().to_string(), value.trim().parse::<f64>().ok()));
    match parts {
        Some((name, Some(value))) if value.is_finite() && !name.is_empty() => Ok((name, value)),
        _ => Err(Stop::Input(format!("{option} {text}: expected {expected}"))),
    }
}

/// The folder of an answer, `runs/SCENE_VERB` where none is given; refused where it holds one.
pub(super) fn folder(given: &Option<PathBuf>, evaluator: &Evaluator, verb: &str, force: bool) -> Result<PathBuf, Stop> {
    let name = evaluator.load(&[]).map_err(stop)?.scene.name;
    let out = given.clone().unwrap_or_else(|| PathBuf::from("runs").join(format!("{name}_{verb}")));
    if !force && out.join(format!("{verb}.json")).exists() {
        let text = format!("{} holds a {verb}: expected another folder, or --force to replace it", out.display());
        return Err(Stop::Input(text));
    }
    Ok(out)
}

/// Write `VERB.json` and the other files, and print the answer.
pub(super) fn finish(
    output: &Output,
    out: &Path,
    verb: &str,
    answer: &impl Serialize,
    words: &str,
    files: &[(&str, String)],
) -> Result<u8, Stop> {
    fs::create_dir_all(out).map_err(|e| Stop::Failed(format!("cannot create {}: {e}", out.display())))?;
    write(&out.join(format!("{verb}.json")), &to_json(answer))?;
    files.iter().try_for_each(|(name, text)| write(&out.join(name), text))?;
    output.result(answer, words);
    if !output.json && !output.quiet {
        say(format_args!("files in {}", out.display()));
    }
    Ok(DONE)
}
