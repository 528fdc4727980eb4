//! Log, curves, summary and report of a run that a host steps.

use std::path::PathBuf;
use std::time::Instant;

use fsi_coupling::Coupled;
use scene::Scene;
use scene::vocabulary::Status;
use tracing::warn;

use super::error::HostedError;
use super::interface::Interface;
use crate::driver::{Run, start_folder};
use crate::folder::{Held, refuse_occupied};
use crate::observers::ObserveError;
use crate::options::{Outcome, Page, RunOptions};
use crate::recorder::{Observed, Recorder};
use crate::recorder_state::Mark;

/// Largest share by which the speed at contact may differ from the expected one [-].
const MOST_UNEXPECTED: f64 = 0.1;

/// The records of a run. From the first saved state on, what was observed since the last one can be discarded; the files have it once
/// the next state is saved, or at the end.
pub(super) struct Records {
    scene: Scene,
    options: RunOptions<'static>,
    recorder: Recorder,
    volume: f64,
    start: Instant,
    seen: Observed,
    /// Speed downwards at the first force of the water [m/s].
    contact_speed: Option<f64>,
    mark: Option<(Mark, Observed, Option<f64>)>,
    /// Why nothing is recorded any more.
    failed: Option<ObserveError>,
    _held: Option<Held>,
}

impl Records {
    /// Take the folder and write the resolved scene.
    pub fn start(
        mut scene: Scene,
        interface: Interface,
        folder: PathBuf,
        replace: bool,
        page: Option<Page>,
        warnings: Vec<String>,
        system: &Coupled,
    ) -> Result<Records, HostedError> {
        // they are of the scene's own motion
        scene.compare.clear();
        scene.similarity = None;
        refuse_occupied(&folder, replace)?;
        let (series, log) = (folder.join("series.csv"), folder.join("log.mcap"));
        let host = Some(interface.name());
        let options = RunOptions { out: Some(folder), force: replace, host, warnings, page, ..RunOptions::default() };
        let held = start_folder(&scene, &options)?;
        let recorder = Recorder::new(&scene, Some(&series), Some(&log), system)?;
        let (volume, start, seen) = (system.fluid.volume(), Instant::now(), Observed::Nothing);
        let (contact_speed, mark, failed) = (None, None, None);
        Ok(Records { scene, options, recorder, volume, start, seen, contact_speed, mark, failed, _held: held })
    }

    /// Observe a step of the water; an error ends the records and waits for `finish`.
    pub fn observe(&mut self, system: &mut Coupled) {
        if self.failed.is_some() {
            return;
        }
        if self.contact_speed.is_none() {
            let motion = system.bodies().find_map(|body| body.motion()).filter(|motion| motion.force[1] > 0.0);
            self.contact_speed = motion.map(|motion| -motion.velocity[1]);
        }
        match self.recorder.timed(system, Recorder::observe) {
            Ok(seen) => self.seen = seen,
            Err(error) => self.fail(error),
        }
    }

    fn fail(&mut self, error: ObserveError) {
        warn!("the run goes on without records: {error}");
        self.failed = Some(error);
    }

    /// An error where the state at the start could not be recorded.
    pub fn started(&mut self) -> Result<(), HostedError> {
        self.failed.take().map_or(Ok(()), |error| Err(error.into()))
    }

    /// Accept what was observed: `discard` returns to this moment.
    pub fn hold(&mut self) {
        if self.failed.is_some() {
            return;
        }
        match self.recorder.hold() {
            Ok(mark) => self.mark = Some((mark, self.seen, self.contact_speed)),
            Err(error) => self.fail(error),
        }
    }

    /// Return to the moment of the last `hold`.
    pub fn discard(&mut self) -> Result<(), HostedError> {
        if let Some((mark, seen, contact_speed)) = self.mark.as_ref().filter(|_| self.failed.is_none()) {
            let state = |error| HostedError::Element(fsi_coupling::embed::HostError::State(error));
            self.recorder.discard(mark).map_err(state)?;
            (self.seen, self.contact_speed) = (*seen, *contact_speed);
        }
        Ok(())
    }

    /// The end: the last sample, summary and report, or why the records ended before. `failure`: why the last step failed.
    pub fn finish(self, system: Coupled, failure: Option<String>) -> Result<Outcome, HostedError> {
        let Records { scene, options, mut recorder, volume, start, seen, contact_speed, failed, _held, .. } = self;
        failed.map_or(Ok(()), |error| Err(HostedError::from(error)))?;
        recorder.host_doubt = unexpected(&scene, contact_speed);
        let references = Vec::new();
        let status = if failure.is_some() { Status::Failed } else { Status::Completed };
        if status == Status::Completed {
            recorder.complete(&system, seen)?;
        }
        let (scene, options, dir) = (&scene, &options, options.out.as_deref());
        let run = Run { scene, options, dir, references, system, recorder, volume, wall: 0.0, resumed: false };
        Ok(run.conclude(status, failure, start)?)
    }
}

/// A doubt where the body met the water at another speed than the scene expects.
fn unexpected(scene: &Scene, contact_speed: Option<f64>) -> Option<String> {
    let (found, expected) = (contact_speed?, scene.entry()?.speed);
    ((found - expected).abs() > MOST_UNEXPECTED * expected).then(|| {
        format!(
            "the host's body met the water at {found:.3} m/s, the scene expects {expected:.3} m/s: filters, bands and verdicts are those of \
             the expected motion; set `body.velocity` to what the host does"
        )
    })
}
