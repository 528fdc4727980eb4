//! Boundary elements: a run in a process of its own, which ends when its answer is no longer wanted.

use std::collections::HashMap;
use std::ffi::OsString;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::sleep;
use std::time::{Duration, Instant};

use scene::EntryModel;
use serde_json::{Value, json};

use crate::answers::{loaded_with, none, of_folder};
use crate::edit::{Edit, apply};
use crate::held::held;
use crate::scratch::Scratch;

/// Longest time of a flow.
const LONGEST: Duration = Duration::from_secs(300);
const PAUSE: Duration = Duration::from_millis(5);

/// The newest request of each page.
#[derive(Debug, Default)]
pub struct Flows {
    newest: Mutex<HashMap<String, u64>>,
    ended: AtomicBool,
}

/// Ends its process.
struct Ended(Child);

impl Drop for Ended {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Flows {
    /// End the process of a page, and count its next request.
    fn next(&self, page: &str) -> u64 {
        let mut newest = held(&self.newest);
        let count = newest.entry(page.to_string()).or_default();
        *count += 1;
        *count
    }

    fn is_newest(&self, page: &str, count: u64) -> bool {
        let newest = held(&self.newest).get(page) == Some(&count);
        newest && !self.ended.load(Ordering::Relaxed)
    }

    /// End all processes.
    pub fn end(&self) {
        self.ended.store(true, Ordering::Relaxed);
    }

    /// The flow about the section of a scene; a later request of the same page ends it.
    ///
    /// # Errors
    /// The answer that says why there is none.
    pub fn answer(&self, program: &[OsString], folder: &Path, text: &str, page: &str) -> Result<Value, Value> {
        let (count, model) = (self.next(page), EntryModel::BoundaryElement);
        let refuse = |why: String| none(model.name(), &why);
        let without_references = apply(text, &[Edit::remove("compare")]).map_err(|error| refuse(error.why))?;
        let scene = loaded_with(folder, &without_references, model)?.scene.to_toml();
        let answer = followed(program, &scene, || self.is_newest(page, count)).map_err(refuse)?;
        Ok(answer.unwrap_or_else(|| json!({"model": model.name(), "stale": true})))
    }
}

/// The answer of a process; `None` where it was ended because it is not wanted.
fn followed(program: &[OsString], scene: &str, wanted: impl Fn() -> bool) -> Result<Option<Value>, String> {
    let scratch = Scratch::new()?;
    let [file, out, errors] = ["scene.toml", "run", "errors"].map(|name| scratch.0.join(name));
    std::fs::write(&file, scene).map_err(|cause| cause.to_string())?;
    let said = std::fs::File::create(&errors).map_err(|cause| cause.to_string())?;
    let [first, rest @ ..] = program else { return Err("expected the path of this program".into()) };
    let mut command = Command::new(first);
    command.args(rest).arg("run").arg(&file).arg("--out").arg(&out).arg("--quiet");
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(said);
    let mut process = Ended(command.spawn().map_err(|cause| format!("cannot start a process: {cause}"))?);
    let start = Instant::now();
    loop {
        match process.0.try_wait() {
            Ok(Some(status)) if status.success() => return of_folder(&out).map(Some),
            Ok(Some(_)) => return Err(std::fs::read_to_string(&errors).unwrap_or_default().trim().to_string()),
            Ok(None) if !wanted() => return Ok(None),
            Ok(None) if start.elapsed() > LONGEST => {
                return Err(format!("not done within {} s", LONGEST.as_secs()));
            }
            Ok(None) => sleep(PAUSE),
            Err(cause) => return Err(cause.to_string()),
        }
    }
}
