//! Runs of the studio: one at a time, in folders of their own below `runs`.

use std::iter::once;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Instant;

use report::page_of_run;
use report::run_page::quantity::with_unit;
use run::log::{LogError, Viewers};
use run::memory::available_memory;
use run::{Checkpoints, RunOptions};
use scene::vocabulary::{ResultName, Results, Status};
use scene::{EntryModel, Loaded, Scene};
use serde::Deserialize;
use serde_json::{Map, Value, json};

use crate::answers::{doubted, number, title};
use crate::edit::written;
use crate::held::held;
use crate::picture::{LiveFrame, Watcher};
use crate::scene_view::{fingerprint, load, mistake};

/// Most runs of the folder that the page lists, and that wait.
const MOST_LISTED: usize = 200;
const MOST_WAITING: usize = 50;

/// How far a run is.
#[derive(Clone, Debug, PartialEq)]
enum Stage {
    Waiting,
    Running,
    Ended(Status, Option<String>),
}

/// The time that a run has reached [s], and when its steps began.
#[derive(Clone, Copy)]
struct Reached {
    time: f64,
    began: Instant,
}

/// A run that this process was asked for.
struct Asked {
    name: String,
    loaded: Loaded,
    stage: Mutex<Stage>,
    interrupt: AtomicBool,
    /// `None` before the first step.
    reached: Mutex<Option<Reached>>,
    live: Arc<LiveFrame>,
}

impl Asked {
    /// Enter another stage if the run waits; false if it does not.
    fn leave_waiting(&self, next: Stage) -> bool {
        let mut stage = held(&self.stage);
        let waits = *stage == Stage::Waiting;
        if waits {
            *stage = next;
        }
        waits
    }
}

/// The runs of a studio.
#[derive(Default)]
pub struct Runs {
    folder: PathBuf,
    asked: Mutex<Vec<Arc<Asked>>>,
    changed: Condvar,
    ended: AtomicBool,
}

impl Runs {
    /// Runs in the folder `runs` of a studio.
    pub fn new(studio: &Path) -> Runs {
        Runs { folder: studio.join("runs"), ..Runs::default() }
    }

    /// Run a scene's text, after those that wait: its name, or the mistake in it.
    pub fn add(&self, studio: &Path, text: &str) -> Value {
        let loaded = match load(studio, text, &[])
            .and_then(|loaded| loaded.fits_in_memory(available_memory()).map(|()| loaded))
        {
            Ok(loaded) => loaded,
            Err(error) => return json!({"name": null, "error": mistake(&error)}),
        };
        let mut asked = held(&self.asked);
        if asked.iter().filter(|run| *held(&run.stage) == Stage::Waiting).count() >= MOST_WAITING {
            let message = format!("{MOST_WAITING} runs wait already");
            return json!({"name": null, "error": {"message": message, "key": null, "line": null}});
        }
        let taken = |name: &String| self.folder.join(name).exists() || asked.iter().any(|run| run.name == *name);
        let own = &loaded.scene.name;
        let mut names = once(own.clone()).chain((2..).map(|k| format!("{own}_{k}")));
        let name = names.find(|name| !taken(name)).unwrap_or_default();
        asked.push(Arc::new(Asked {
            name: name.clone(),
            loaded,
            stage: Mutex::new(Stage::Waiting),
            interrupt: AtomicBool::new(false),
            reached: Mutex::default(),
            live: Arc::default(),
        }));
        self.changed.notify_all();
        json!({"name": name, "error": null})
    }

    /// Run what waits, until [`Runs::end`].
    pub fn work(&self) {
        let mut asked = held(&self.asked);
        while !self.ended.load(Ordering::Relaxed) {
            let next = asked.iter().find(|run| run.leave_waiting(Stage::Running)).map(Arc::clone);
            asked = match next {
                None => self.changed.wait(asked).unwrap_or_else(PoisonError::into_inner),
                Some(run) => {
                    drop(asked);
                    self.complete(&run);
                    held(&self.asked)
                }
            };
        }
    }

    /// End the run that goes on, and start no other.
    pub fn end(&self) {
        self.ended.store(true, Ordering::Relaxed);
        // a worker that is about to wait holds the list
        held(&self.asked).iter().for_each(|run| run.interrupt.store(true, Ordering::Relaxed));
        self.changed.notify_all();
    }

    fn complete(&self, run: &Asked) {
        let progress = |time: f64, _: u64| {
            let mut reached = held(&run.reached);
            let began = reached.map_or_else(Instant::now, |before| before.began);
            *reached = Some(Reached { time, began });
        };
        let start = |_: &Scene| -> Result<Box<dyn Viewers>, LogError> {
            Ok(Box::new(Watcher { live: Arc::clone(&run.live), taken: None }))
        };
        let options = RunOptions {
            out: Some(self.folder.join(&run.name)),
            live: Some(&start),
            interrupt: Some(&run.interrupt),
            progress: Some(&progress),
            page: Some(page_of_run),
            checkpoints: Some(Checkpoints { every: None }),
            warnings: run.loaded.warnings.clone(),
            ..RunOptions::default()
        };
        let done = catch_unwind(AssertUnwindSafe(|| run::run(&run.loaded.scene, &options)));
        let stage = match done {
            Ok(Ok(outcome)) => Stage::Ended(outcome.summary.status, outcome.summary.message),
            Ok(Err(error)) => Stage::Ended(Status::Failed, Some(error.to_string())),
            Err(_) => Stage::Ended(Status::Failed, Some("the run broke off".into())),
        };
        *held(&run.stage) = stage;
    }

    fn asked(&self, name: &str) -> Option<Arc<Asked>> {
        held(&self.asked).iter().find(|run| run.name == name).map(Arc::clone)
    }

    /// Stop a run after its present step; false for a run that is not this process's.
    pub fn stop(&self, name: &str) -> bool {
        let Some(run) = self.asked(name) else { return false };
        run.interrupt.store(true, Ordering::Relaxed);
        run.leave_waiting(Stage::Ended(Status::Interrupted, Some("stopped before it began".into())));
        true
    }

    /// The newest frame of a run that goes on, as PNG.
    pub fn picture(&self, name: &str) -> Option<Vec<u8>> {
        let run = self.asked(name)?;
        run.live.png(&run.loaded.scene)
    }

    /// The folder of a run of this studio; `None` for any other name.
    pub fn folder_of(&self, name: &str) -> Option<PathBuf> {
        let is_word = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
        if name.is_empty() || name.starts_with('.') || !name.chars().all(is_word) {
            return None;
        }
        let real = std::fs::canonicalize(self.folder.join(name)).ok()?;
        let within = real.starts_with(std::fs::canonicalize(&self.folder).ok()?);
        (within && real.is_dir()).then_some(real)
    }

    /// All runs: those that this process was asked for, the newest first, then those that lie in the folder.
    pub fn list(&self) -> Value {
        let asked: Vec<Arc<Asked>> = held(&self.asked).iter().rev().map(Arc::clone).collect();
        let mut listed: Vec<Value> = asked.iter().map(|run| self.line_of_asked(run)).collect();
        let entries = std::fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let dated = entries.filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            let written = entry.path().join("scene.resolved.toml").metadata().and_then(|file| file.modified()).ok()?;
            Some((written, name)).filter(|(_, name)| asked.iter().all(|run| run.name != *name))
        });
        let mut dated: Vec<_> = dated.collect();
        dated.sort();
        listed.extend(dated.iter().rev().take(MOST_LISTED).filter_map(|(_, name)| self.line_of_folder(name)));
        json!(listed)
    }

    fn line_of_asked(&self, run: &Asked) -> Value {
        let stage = held(&run.stage).clone();
        let (start, end) = (run.loaded.scene.time.start, run.loaded.scene.time.end);
        let reached = *held(&run.reached);
        let share = reached.map_or(0.0, |reached| ((reached.time - start) / (end - start)).clamp(0.0, 1.0));
        let seconds = reached.map(|reached| reached.began.elapsed().as_secs_f64());
        let remaining = seconds.filter(|_| share > 0.02).map(|seconds| seconds * (1.0 - share) / share);
        let line = |state: &str| {
            json!({
                "name": run.name,
                "model": title(run.loaded.scene.model.name()),
                "particles": !run.loaded.scene.model.is_theory(),
                "inputs": inputs(&written(&run.loaded.scene.to_toml()).unwrap_or_default()),
                "state": state,
                "words": state,
                "share": share,
                "time": reached.map_or(0.0, |reached| reached.time),
                "end": end,
                "remaining": remaining,
            })
        };
        match stage {
            Stage::Waiting => line("waiting"),
            Stage::Running => line("running"),
            Stage::Ended(status, message) => {
                let mut ended = self.line_of_folder(&run.name).unwrap_or_else(|| line("ended"));
                ended["status"] = json!(status.name());
                ended["words"] = json!(status.words());
                ended["message"] = json!(message);
                ended
            }
        }
    }

    fn line_of_folder(&self, name: &str) -> Option<Value> {
        let folder = self.folder_of(name)?;
        let resolved = std::fs::read_to_string(folder.join("scene.resolved.toml")).ok()?;
        let text = std::fs::read_to_string(folder.join("summary.json")).unwrap_or_default();
        let summary: Value = serde_json::from_str(&text).unwrap_or_default();
        let status = Status::of(summary["status"].as_str().unwrap_or_default());
        let keys = written(&resolved).unwrap_or_default();
        let ends = [size(&keys, "time.start").unwrap_or(0.0), size(&keys, "time.end").unwrap_or(f64::INFINITY)];
        let (results, _) = doubted(Results::deserialize(&summary["results"]).unwrap_or_default(), Some(ends));
        let force = results.get(ResultName::PeakForce);
        let peak = force.map(|force| format!("peak force {}, {}", number(&force, "N/m"), force.verdict.words()));
        Some(json!({
            "name": name,
            "model": title(summary["model"].as_str().unwrap_or_default()),
            "state": "ended",
            "status": status.name(),
            "words": status.words(),
            "message": summary["message"],
            "has_results": status.has_results(),
            "report": folder.join("report.html").is_file(),
            "fingerprint": fingerprint(&resolved),
            "inputs": inputs(&keys),
            "peak": peak,
        }))
    }
}

/// Mass, speed and, of particles, the spacing of a resolved scene, in words.
fn inputs(keys: &Map<String, Value>) -> String {
    let model = keys.get("model").and_then(Value::as_str);
    let by_particles = !EntryModel::ALL.into_iter().any(|own| Some(own.name()) == model && own.is_theory());
    let named =
        [("mass", "body.mass", "kg/m"), ("speed", "body.velocity", "m/s"), ("spacing", "resolution.spacing", "m")];
    let shown = named.into_iter().take(if by_particles { 3 } else { 2 });
    let words = shown.filter_map(|(title, key, si)| Some(format!("{title} {}", with_unit(size(keys, key)?, si))));
    words.collect::<Vec<_>>().join(", ")
}

/// The number of a resolved key, of a vector its length.
fn size(keys: &Map<String, Value>, key: &str) -> Option<f64> {
    let text = keys.get(key)?.as_str()?.trim_matches(['[', ']']);
    let parts: Vec<f64> = text.split(',').map(|part| part.trim().parse().ok()).collect::<Option<_>>()?;
    if let [one] = parts[..] { Some(one) } else { Some(parts.iter().fold(0.0, |size, part| part.hypot(size))) }
}
