//! A run that a host steps.

use fsi_coupling::embed::{Contribution, FluidElement, HostError, HostNodes, HostStep, Snapshot};
use sph_core::StateError;

use super::error::HostedError;
use super::records::Records;
use crate::Outcome;

/// The water of a scene around the nodes of a host. Two runs are independent of each other; each may move between threads.
pub struct HostedRun {
    element: FluidElement,
    /// Of the scene and the interface.
    fingerprint: u32,
    records: Option<Records>,
}

/// Name of a state in messages.
const STATE: &str = "a state of a hosted run";

impl HostedRun {
    pub(super) fn new(
        element: FluidElement,
        fingerprint: u32,
        records: Option<Records>,
    ) -> Result<HostedRun, HostedError> {
        let mut run = HostedRun { element, fingerprint, records };
        if let Some(records) = &mut run.records {
            run.element.observe(|system| records.observe(system));
            records.started()?;
        }
        Ok(run)
    }

    /// The water goes through a step of the host of `dt` [s], in as many steps of its own as it needs, while the nodes move smoothly to
    /// where `nodes` has them at its end (THEORY CO29). `forces` becomes the mean force on each node, `[F_x, F_y, M]` [N/m, N/m, N]:
    /// times `dt` it is the impulse that the water lost, to rounding (CO31).
    ///
    /// # Errors
    /// Input that is refused changes nothing. A step that fails leaves the run to be restored or finished. Records that cannot be written
    /// end there, the run goes on, and `finish` tells why.
    pub fn contribute(
        &mut self,
        dt: f64,
        nodes: &HostNodes,
        forces: &mut [[f64; 3]],
    ) -> Result<Contribution, HostedError> {
        let HostedRun { element, records, .. } = self;
        let step = HostStep { dt, nodes };
        let Some(records) = records else { return Ok(element.contribute(step, forces)?) };
        Ok(element.contribute_observed(step, forces, |system| records.observe(system))?)
    }

    /// Remember the present state, and accept what was recorded so far; replaces the state remembered before. A run that failed remembers
    /// nothing.
    pub fn save(&mut self) {
        if self.element.failure().is_none() {
            self.element.save();
            if let Some(records) = &mut self.records {
                records.hold();
            }
        }
    }

    /// Return to the state last saved, as often as needed: a step redone gives the same bits. Records return as well.
    ///
    /// # Errors
    /// Nothing was saved.
    pub fn restore(&mut self) -> Result<(), HostedError> {
        self.element.restore()?;
        self.records.as_mut().map_or(Ok(()), Records::discard)
    }

    /// The present state as bytes, to continue in another process: fingerprint of scene and interface, content, checksum. Two equal states
    /// may differ in bytes, since the time spent is in them.
    ///
    /// # Errors
    /// A run that failed has no state.
    pub fn to_bytes(&self) -> Result<Vec<u8>, HostedError> {
        let mut bytes = self.fingerprint.to_le_bytes().to_vec();
        bytes.extend(self.element.to_bytes()?);
        let checksum = crc32fast::hash(&bytes);
        bytes.extend(checksum.to_le_bytes());
        Ok(bytes)
    }

    /// Take such a state, of the same scene, settings and interface: the next step gives the same bits.
    ///
    /// # Errors
    /// Bytes that are no such state: the run has failed. A run with records takes none.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), HostedError> {
        match self.records {
            Some(_) => Err(HostedError::Recorded),
            None => match self.content(bytes) {
                Ok(content) => Ok(self.element.restore_bytes(content)?),
                Err(refused) => {
                    // the element fails as it does for any bytes that are not its own
                    self.element.restore_bytes(&[]).err();
                    Err(refused)
                }
            },
        }
    }

    /// What a state holds for the element; an error where it is damaged, or of another scene.
    fn content<'a>(&self, bytes: &'a [u8]) -> Result<&'a [u8], HostedError> {
        let refused = |why: String| HostedError::Element(HostError::State(StateError::Unreadable(STATE, why)));
        let parts =
            bytes.split_last_chunk::<4>().and_then(|(body, sum)| Some((body.split_first_chunk::<4>()?, body, sum)));
        let whole = parts.filter(|(_, body, sum)| crc32fast::hash(body) == u32::from_le_bytes(**sum));
        let Some(((fingerprint, content), ..)) = whole else {
            return Err(refused(format!(
                "given {} bytes that are damaged, expected them as they were written",
                bytes.len()
            )));
        };
        match u32::from_le_bytes(*fingerprint) == self.fingerprint {
            true => Ok(content),
            false => Err(refused("given another scene, setting or interface, expected those of this run".into())),
        }
    }

    /// Time of the water [s].
    pub fn time(&self) -> f64 {
        self.element.time()
    }

    /// Longest step that the water could take next [s].
    ///
    /// # Errors
    /// A state that cannot be stepped.
    pub fn fluid_dt(&self) -> Result<f64, HostedError> {
        Ok(self.element.fluid_dt()?)
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.element.node_count()
    }

    /// Where the nodes are now, as the water has them.
    pub fn nodes(&self) -> HostNodes {
        self.element.nodes()
    }

    /// Forces of the water on the nodes at this moment, `[F_x, F_y, M]` [N/m, N/m, N], to predict the next step with.
    pub fn forces_now(&self) -> Vec<[f64; 3]> {
        self.element.forces_now()
    }

    /// Particles of water now.
    pub fn particle_count(&self) -> usize {
        self.element.system().fluid.particles().len()
    }

    /// A picture of the present state.
    pub fn snapshot(&self) -> Snapshot {
        self.element.snapshot()
    }

    /// Why the last step failed; `None` of a run that can be stepped.
    pub fn failure(&self) -> Option<&str> {
        self.element.failure()
    }

    /// Water and walls inside: the host's surface is body 0, the tank body 1.
    pub fn element(&self) -> &FluidElement {
        &self.element
    }

    /// End the run. With records: summary and report are written and returned.
    ///
    /// # Errors
    /// Files that cannot be written, also those of an earlier step.
    pub fn finish(self) -> Result<Option<Outcome>, HostedError> {
        let HostedRun { element, records, .. } = self;
        let failure = element.failure().map(str::to_string);
        records.map(|records| records.finish(element.into_system(), failure)).transpose()
    }
}
