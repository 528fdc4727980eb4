//! Log, curves, summary and report of a run that a host steps.

use std::path::PathBuf;
use std::time::Instant;

use fsi_coupling::Coupled;

use super::error::HostedError;
use crate::compare::{self, ReferenceCurve};
use crate::observers::ObserveError;
use crate::run::summary::Status;
use crate::run::{Held, Mark, Observed, Outcome, Recorder, Run, RunError, RunOptions, refuse_occupied, start_folder};
use crate::scene::Scene;

/// The records of a run. From the first saved state on, what was observed since the last one can be discarded; the files have it once
/// the next state is saved, or at the end.
pub(super) struct Records {
    scene: Scene,
    options: RunOptions<'static>,
    references: Vec<ReferenceCurve>,
    recorder: Recorder,
    volume: f64,
    start: Instant,
    seen: Observed,
    mark: Option<(Mark, Observed)>,
    /// The first observation that failed.
    failed: Option<ObserveError>,
    _held: Option<Held>,
}

impl Records {
    /// Take the folder and write the resolved scene.
    pub fn start(
        scene: Scene,
        folder: PathBuf,
        replace: bool,
        warnings: Vec<String>,
        system: &Coupled,
    ) -> Result<Records, HostedError> {
        let references = scene.compare.iter().map(compare::curve).collect::<Result<Vec<_>, _>>();
        let references = references.map_err(RunError::from)?;
        refuse_occupied(&folder, replace)?;
        let (series, log) = (folder.join("series.csv"), folder.join("log.mcap"));
        let options = RunOptions { out: Some(folder), force: replace, warnings, ..RunOptions::default() };
        let held = start_folder(&scene, &options)?;
        let recorder = Recorder::new(&scene, Some(&series), Some(&log), system)?;
        let (volume, start, seen) = (system.fluid.volume(), Instant::now(), Observed::Nothing);
        let (mark, failed) = (None, None);
        Ok(Records { scene, options, references, recorder, volume, start, seen, mark, failed, _held: held })
    }

    /// Observe a step of the water; an error waits for `check`.
    pub fn observe(&mut self, system: &mut Coupled) {
        if self.failed.is_some() {
            return;
        }
        match self.recorder.timed(system, Recorder::observe) {
            Ok(seen) => self.seen = seen,
            Err(error) => self.failed = Some(error),
        }
    }

    /// The error of an observation, if there was one.
    pub fn check(&mut self) -> Result<(), HostedError> {
        self.failed.take().map_or(Ok(()), |error| Err(error.into()))
    }

    /// Accept what was observed: `discard` returns to this moment.
    pub fn hold(&mut self) -> Result<(), HostedError> {
        self.mark = Some((self.recorder.hold()?, self.seen));
        Ok(())
    }

    /// Return to the moment of the last `hold`.
    pub fn discard(&mut self) -> Result<(), HostedError> {
        if let Some((mark, seen)) = &self.mark {
            let state = |error| HostedError::Element(fsi_coupling::embed::HostError::State(error));
            self.recorder.discard(mark).map_err(state)?;
            self.seen = *seen;
        }
        Ok(())
    }

    /// The end: the last sample, summary and report. `failure`: why the last step failed.
    pub fn finish(self, system: Coupled, failure: Option<String>) -> Result<Outcome, HostedError> {
        let Records { scene, options, references, mut recorder, volume, start, seen, _held, .. } = self;
        let status = if failure.is_some() { Status::Failed } else { Status::Completed };
        if status == Status::Completed {
            recorder.complete(&system, seen)?;
        }
        let (scene, options, dir) = (&scene, &options, options.out.as_deref());
        let run = Run { scene, options, dir, references, system, recorder, volume, wall: 0.0, resumed: false };
        Ok(run.conclude(status, failure, start)?)
    }
}
