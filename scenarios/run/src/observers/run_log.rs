//! `log.mcap`: curves and conservation numbers at every sample, particles at every frame; and the same for viewers of a run in progress.

use std::path::Path;

use fsi_coupling::Coupled;
use scene::Scene;

use super::run_view::RunView;
use super::{Frame, ObserveError, Observer};
use crate::log::{BackgroundLog, Budget, Level, LogError, LogMetadata, Logged, StoredLog, Viewers};

/// Writes the log.
pub struct LogObserver {
    writer: BackgroundLog,
    view: RunView,
    end: f64,
}

impl LogObserver {
    /// Create the file.
    pub fn create(path: &Path, scene: &Scene) -> Result<LogObserver, ObserveError> {
        Ok(LogObserver::with(create_log(path, scene)?, scene))
    }

    fn with(writer: BackgroundLog, scene: &Scene) -> LogObserver {
        LogObserver { writer, view: RunView::new(scene), end: scene.time.end }
    }

    /// Continue the file from where it was `stored`.
    pub fn resume(path: &Path, scene: &Scene, stored: StoredLog) -> Result<LogObserver, ObserveError> {
        Ok(LogObserver::with(resume_log(path, scene, stored)?, scene))
    }

    /// What a later process needs to continue from here.
    pub fn stored(&mut self) -> Result<StoredLog, ObserveError> {
        Ok(self.writer.stored()?)
    }

    /// Hold back what comes, as [`BackgroundLog::hold`].
    pub fn hold(&mut self) -> Result<(), ObserveError> {
        Ok(self.writer.hold()?)
    }

    /// Forget what was held back.
    pub fn discard(&mut self) {
        self.writer.discard();
    }

    /// Write a note.
    pub fn note(&mut self, time: f64, level: Level, text: &str) -> Result<(), ObserveError> {
        Ok(self.writer.note(self.view.time(time), level, text)?)
    }

    /// Complete the file.
    pub fn finish(self) -> Result<Logged, ObserveError> {
        Ok(self.writer.finish()?)
    }

    /// Write the present state, whether due or not.
    pub fn keep(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        self.curves(frame)?;
        self.picture(frame.system, true)
    }

    fn curves(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        let LogObserver { writer, view, .. } = self;
        let time = view.time(frame.time());
        Ok(view.curves(frame, |channel, values| writer.sample(time, channel, values))?)
    }

    /// Write a frame of particles; the `last` of a run is written if a budget has room for it alone.
    pub fn picture(&mut self, system: &Coupled, last: bool) -> Result<(), ObserveError> {
        Ok(self.writer.frame(self.view.picture(system)?, last)?)
    }
}

impl Observer for LogObserver {
    fn observe(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        self.curves(frame)?;
        if frame.particles { self.picture(frame.system, frame.time() >= self.end) } else { Ok(()) }
    }
}

/// The empty log of a scene.
pub(crate) fn create_log(path: &Path, scene: &Scene) -> Result<BackgroundLog, LogError> {
    BackgroundLog::create(path, &metadata(scene, &scene.to_toml()), budget(scene))
}

fn resume_log(path: &Path, scene: &Scene, stored: StoredLog) -> Result<BackgroundLog, LogError> {
    BackgroundLog::resume(path, &metadata(scene, &scene.to_toml()), budget(scene), stored)
}

fn metadata<'a>(scene: &'a Scene, toml: &'a str) -> LogMetadata<'a> {
    LogMetadata { scene: &scene.name, scene_toml: toml, version: env!("CARGO_PKG_VERSION") }
}

fn budget(scene: &Scene) -> Option<Budget> {
    let end = scene.time.end - scene.time.start;
    scene.report.log_budget.map(|megabytes| Budget { bytes: (1e6 * megabytes) as u64, end })
}

/// Shows the run to viewers, at their pace: the wall clock decides when, and the run does not depend on it.
pub struct LiveObserver {
    viewers: Box<dyn Viewers>,
    view: RunView,
}

impl LiveObserver {
    /// For these viewers.
    pub fn new(viewers: Box<dyn Viewers>, scene: &Scene) -> LiveObserver {
        LiveObserver { viewers, view: RunView::new(scene) }
    }

    /// True where a viewer waits for a picture.
    pub fn is_due(&self) -> bool {
        self.viewers.is_due()
    }
}

impl Observer for LiveObserver {
    fn observe(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        let LiveObserver { viewers, view } = self;
        let time = view.time(frame.time());
        view.curves(frame, |channel, values| viewers.sample(time, channel, values))?;
        viewers.frame(&view.picture(frame.system)?);
        Ok(())
    }
}
