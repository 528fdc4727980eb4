//! How far a sweep is.

use serde::Serialize;

use super::folder::{KILLED, Outcome, State, SweepFolder};
use super::plan::Plan;

/// How far a sweep is: the numbers of its points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Progress {
    /// All points of the table.
    pub points: usize,
    /// Points with results.
    pub done: usize,
    /// Points that ended without: the run failed, its scene is wrong, or its process died.
    pub failed: usize,
    /// Points that a process runs.
    pub running: usize,
    /// Points left.
    pub waiting: usize,
    /// Estimate of the time to the end [s]; absent before the first point has ended.
    pub time_left_s: Option<f64>,
    /// Whether a coordinator is at work.
    pub coordinator: bool,
}

impl Progress {
    /// Of the sweep in a folder.
    pub fn of(plan: &Plan, folder: &SweepFolder) -> Progress {
        let mut progress = Progress {
            points: plan.points.len(),
            done: 0,
            failed: 0,
            running: 0,
            waiting: 0,
            time_left_s: None,
            coordinator: folder.is_locked(),
        };
        let (mut spent, mut ended) = (0.0, 0);
        for id in plan.points.iter().map(|point| point.id.as_deref()) {
            let Some(point) = id.map(|id| folder.point(id)) else {
                progress.failed += 1;
                continue;
            };
            let mut take = |outcome: &Outcome| {
                spent += outcome.wall_time_s;
                ended += 1;
                if outcome.is_completed() { progress.done += 1 } else { progress.failed += 1 }
            };
            match point.state() {
                State::Ended(outcome) => take(&outcome),
                State::Running => progress.running += 1,
                State::Waiting => match point.outcome().filter(|outcome| outcome.status == KILLED) {
                    Some(outcome) => take(&outcome),
                    None => progress.waiting += 1,
                },
            }
        }
        let left = progress.waiting as f64 + 0.5 * progress.running as f64;
        progress.time_left_s = (ended > 0).then(|| left * spent / ended as f64 / plan.jobs.max(1) as f64);
        progress
    }

    /// In a line.
    pub fn to_text(&self) -> String {
        let Progress { points, done, failed, running, waiting, .. } = self;
        let left = match self.time_left_s {
            Some(seconds) if running + waiting > 0 => format!(", about {} left", duration(seconds)),
            _ => String::new(),
        };
        let at_work = if self.coordinator { "" } else { "; no coordinator is at work" };
        format!("{points} points: {done} done, {failed} failed, {running} running, {waiting} waiting{left}{at_work}")
    }
}

/// A time in words of its size.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "a second".into(),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}
