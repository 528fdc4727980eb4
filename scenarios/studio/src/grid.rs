//! A scene at the points of one or two ranges of its keys, by a theory or boundary elements.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;

use run::RunOptions;
use scene::{EntryModel, SceneError};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::answers::{doubted, ends, refused, result, with_model};
use crate::held::held;
use crate::scene_view::load;

/// Most points of a grid, and most grids that are kept.
const MOST_POINTS: usize = 400;
const MOST_KEPT: usize = 20;

/// A range of a key.
#[derive(Clone, Debug, Deserialize)]
pub struct Range {
    key: String,
    from: f64,
    to: f64,
    count: usize,
}

impl Range {
    fn value(&self, k: usize) -> f64 {
        self.from + (self.to - self.from) * k as f64 / (self.count.max(2) - 1) as f64
    }
}

/// What is to be computed.
#[derive(Clone, Debug, Deserialize)]
pub struct Asked {
    text: String,
    model: String,
    ranges: Vec<Range>,
}

/// A grid that is being computed.
struct Grid {
    asked: Asked,
    folder: PathBuf,
    points: Mutex<Vec<Value>>,
    next: AtomicUsize,
    stop: AtomicBool,
}

/// The grids of a studio.
#[derive(Default)]
pub struct Grids {
    kept: Mutex<BTreeMap<u64, Arc<Grid>>>,
}

impl Grids {
    /// Begin a grid: its number.
    ///
    /// # Errors
    /// Why it is refused.
    pub fn start(&self, folder: &Path, mut asked: Asked) -> Result<u64, String> {
        if !EntryModel::ALL.into_iter().any(|model| model.name() == asked.model && model.is_theory()) {
            return Err(format!("{}: expected a theory, or boundary_element", asked.model));
        }
        if !(1..=2).contains(&asked.ranges.len()) {
            return Err("expected one or two ranges".into());
        }
        let count = asked.ranges.iter().map(|range| range.count).try_fold(1usize, usize::checked_mul);
        let finite = asked.ranges.iter().all(|range| range.from.is_finite() && range.to.is_finite());
        let count = count.filter(|count| finite && (1..=MOST_POINTS).contains(count));
        let expected = || format!("expected ranges of 1 to {MOST_POINTS} points together, with numbers at their ends");
        let count = count.ok_or_else(expected)?;
        asked.text = with_model(&asked.text, &asked.model).map_err(|error| error.to_string())?;
        let grid = Arc::new(Grid {
            asked,
            folder: folder.to_path_buf(),
            points: Mutex::new(vec![Value::Null; count]),
            next: AtomicUsize::new(0),
            stop: AtomicBool::new(false),
        });
        let mut kept = held(&self.kept);
        let id = kept.last_key_value().map_or(1, |(last, _)| last + 1);
        if kept.len() >= MOST_KEPT
            && let Some((_, oldest)) = kept.pop_first()
        {
            oldest.stop.store(true, Ordering::Relaxed);
        }
        kept.insert(id, Arc::clone(&grid));
        let threads = thread::available_parallelism().map_or(1, usize::from).min(count);
        for _ in 0..threads {
            let grid = Arc::clone(&grid);
            thread::spawn(move || grid.work());
        }
        Ok(id)
    }

    fn grid(&self, id: u64) -> Option<Arc<Grid>> {
        held(&self.kept).get(&id).map(Arc::clone)
    }

    /// How far a grid is, and the results of its points.
    pub fn progress(&self, id: u64) -> Option<Value> {
        let grid = self.grid(id)?;
        let points = held(&grid.points);
        let values = |range: &Range| (0..range.count).map(|k| range.value(k)).collect::<Vec<_>>();
        Some(json!({
            "done": points.iter().filter(|point| !point.is_null()).count(),
            "stopped": grid.stop.load(Ordering::Relaxed),
            "ranges": grid.asked.ranges.iter().map(|range| json!({"key": range.key, "values": values(range)})).collect::<Vec<_>>(),
            "points": *points,
        }))
    }

    /// Stop a grid after the points that are being computed; false for an unknown one.
    pub fn stop(&self, id: u64) -> bool {
        self.grid(id).inspect(|grid| grid.stop.store(true, Ordering::Relaxed)).is_some()
    }

    /// Stop all.
    pub fn end(&self) {
        let kept = held(&self.kept);
        kept.values().for_each(|grid| grid.stop.store(true, Ordering::Relaxed));
    }
}

impl Grid {
    fn work(&self) {
        while !self.stop.load(Ordering::Relaxed) {
            let k = self.next.fetch_add(1, Ordering::Relaxed);
            let count = held(&self.points).len();
            if k >= count {
                return;
            }
            let (Ok(point) | Err(point)) = self.point(k);
            held(&self.points)[k] = point;
        }
    }

    /// The results at a point, or why there are none; the last range changes fastest.
    fn point(&self, k: usize) -> Result<Value, Value> {
        let (mut rest, mut sets) = (k, Vec::new());
        for range in self.asked.ranges.iter().rev() {
            sets.insert(0, set(&range.key, range.value(rest % range.count)));
            rest /= range.count;
        }
        let why = |error: &SceneError| json!({"why": refused(&self.asked.model, error)["why"]});
        let loaded = load(&self.folder, &self.asked.text, &sets).map_err(|error| why(&error))?;
        let options = RunOptions { without_log: true, ..RunOptions::default() };
        let outcome = run::run(&loaded.scene, &options).map_err(|error| json!({"why": error.to_string()}))?;
        let (results, _) = doubted(outcome.summary.results.clone(), ends(outcome.series.rows()));
        let results = results.named().map(|(id, quantity)| result(&id, quantity));
        Ok(json!({"results": results.collect::<Vec<_>>()}))
    }
}

/// An override; a whole number stands for both kinds.
fn set(key: &str, value: f64) -> String {
    match value.fract() == 0.0 && value.abs() < 1e15 {
        true => format!("{key}={value:.0}"),
        false => format!("{key}={value:?}"),
    }
}
