//! Phase four: steps, state and end of the element.

use fsi_coupling::embed::{HostNodes, Snapshot};
use run::host::HostedRun;

use crate::border::guarded;
use crate::buffers;
use crate::handles::Handles;
use crate::status::splashdown_status::SPLASHDOWN_FAILED;
use crate::status::{Failure, splashdown_status};

/// Water under the body of a host.
pub struct splashdown_element {
    _opaque: [u8; 0],
}

/// What the water did in a step of the host.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct splashdown_contribution {
    /// Steps that the water took.
    pub fluid_steps: u64,
    /// Longest step that the water could take next [s].
    pub fluid_dt: f64,
    /// Longest next step of a host that moves with the force of the last step [s]: an estimate, infinite where it is unknown.
    pub host_dt: f64,
    /// Energy given to the nodes [J/m].
    pub work: f64,
    /// Impulse given to the nodes, all together [N s/m]: dt times the sum of the forces.
    pub impulse: [f64; 2],
    /// Particles of the water beyond a wall's surface at the end.
    pub penetrated: u64,
    /// How far the deepest of them is beyond it [m].
    pub depth: f64,
}

pub(crate) static ELEMENTS: Handles<Element> = Handles::new("element");

/// A run with the arrays that calls fill in place.
pub(crate) struct Element {
    run: HostedRun,
    nodes: HostNodes,
    forces: Vec<[f64; 3]>,
    snapshot: Option<Snapshot>,
    bytes: Option<Vec<u8>>,
}

impl Element {
    /// Of a run with `nodes` at t = 0.
    pub fn new(run: HostedRun, nodes: HostNodes) -> Element {
        let forces = vec![[0.0; 3]; nodes.len()];
        Element { run, nodes, forces, snapshot: None, bytes: None }
    }

    /// The run, to be changed: what was kept of its state is dropped.
    pub fn run(&mut self) -> &mut HostedRun {
        (self.snapshot, self.bytes) = (None, None);
        &mut self.run
    }

    /// Number of the water's particles now.
    pub fn particle_count(&self) -> usize {
        self.run.particle_count()
    }

    /// The picture of the present state.
    pub fn snapshot(&mut self) -> &Snapshot {
        self.snapshot.get_or_insert_with(|| self.run.snapshot())
    }

    /// The present state as bytes.
    pub fn bytes(&mut self) -> Result<&[u8], Failure> {
        if self.bytes.is_none() {
            self.bytes = Some(self.run.to_bytes()?);
        }
        Ok(self.bytes.as_deref().unwrap_or_default())
    }

    /// They are computed again when they are needed.
    pub fn clear_bytes(&mut self) {
        self.bytes = None;
    }
}

/// Take the water through one step of the host of length `dt` [s], to where the nodes are at its end.
///
/// `positions` [m] and `velocities` [m/s] have 2n values, `rotations` [rad] and `spins` [rad/s] have n values, or are NULL where
/// nodes have none. They belong together as those of a smooth motion do, x' = x + dt (v + v')/2. `forces` gets 3n values, F_x, F_y
/// [N/m] and M [N] of each node: their mean over the step, so that dt times them is the impulse. `contribution` is NULL if it is
/// not wanted.
///
/// After SPLASHDOWN_STEP the element waits for splashdown_restore; after any other error nothing has changed. A record that cannot be
/// written ends there: the run goes on, and splashdown_finish gives SPLASHDOWN_FILE.
///
/// Memory: Arrays are NULL or of the lengths above; `contribution` is NULL or points to a structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_contribute(
    element: *mut splashdown_element,
    dt: f64,
    positions: *const f64,
    velocities: *const f64,
    rotations: *const f64,
    spins: *const f64,
    n: usize,
    forces: *mut f64,
    contribution: *mut splashdown_contribution,
) -> splashdown_status {
    guarded(|| {
        ELEMENTS.with(element, |element| {
            buffers::expect("forces", forces)?;
            if !contribution.is_null() {
                buffers::expect("contribution", contribution)?;
            }
            // SAFETY: of the lengths by the contract of the caller.
            unsafe { buffers::read_nodes([positions, velocities, rotations, spins], n, &mut element.nodes)? };
            (element.snapshot, element.bytes) = (None, None);
            let given = element.run.contribute(dt, &element.nodes, &mut element.forces)?;
            let reported = splashdown_contribution {
                fluid_steps: u64::from(given.fluid_steps),
                fluid_dt: given.fluid_dt,
                host_dt: given.host_dt,
                work: given.work,
                impulse: given.impulse,
                penetrated: given.penetration.count as u64,
                depth: given.penetration.worst.map_or(0.0, |worst| worst.depth),
            };
            // SAFETY: aligned; 3n values and one structure by the contract of the caller.
            unsafe {
                buffers::write(element.forces.as_flattened(), forces);
                buffers::write(&[reported], contribution);
            }
            Ok(())
        })
    })
}

/// Store the present state; it replaces the one stored before. A failed element has none: SPLASHDOWN_FAILED.
#[unsafe(no_mangle)]
pub extern "C" fn splashdown_save(element: *mut splashdown_element) -> splashdown_status {
    guarded(|| {
        ELEMENTS.with(element, |element| {
            if let Some(why) = element.run.failure() {
                let message =
                    format!("save: the element failed ({why}), expected splashdown_restore of a saved state first");
                return Err(Failure::new(SPLASHDOWN_FAILED, message));
            }
            element.run.save();
            Ok(())
        })
    })
}

/// Return to the state last saved, as often as needed. A step redone from there gives the same bits.
#[unsafe(no_mangle)]
pub extern "C" fn splashdown_restore(element: *mut splashdown_element) -> splashdown_status {
    guarded(|| ELEMENTS.with(element, |element| Ok(element.run().restore()?)))
}

/// The nodes at the present time of the water: `n` nodes into arrays of the caller, as of splashdown_scene_nodes.
///
/// Memory: `positions` and `velocities` are NULL or of 2n values, `rotations` and `spins` NULL or of n values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_nodes(
    element: *const splashdown_element,
    positions: *mut f64,
    velocities: *mut f64,
    rotations: *mut f64,
    spins: *mut f64,
    n: usize,
) -> splashdown_status {
    guarded(|| {
        ELEMENTS.with(element, |element| {
            // SAFETY: of the lengths by the contract of the caller.
            unsafe { buffers::write_nodes(&element.run.nodes(), [positions, velocities, rotations, spins], n) }
        })
    })
}

/// Forces of the water on the `n` nodes at this instant, F_x, F_y [N/m] and M [N] of each: 3n values.
///
/// Memory: `forces` is NULL or of 3n values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_forces_now(
    element: *const splashdown_element,
    forces: *mut f64,
    n: usize,
) -> splashdown_status {
    guarded(|| {
        ELEMENTS.with(element, |element| {
            let now = element.run.forces_now();
            buffers::expect_length("n, nodes", n, now.len())?;
            buffers::expect("forces", forces)?;
            // SAFETY: aligned, and 3n values by the contract of the caller.
            unsafe { buffers::write(now.as_flattened(), forces) };
            Ok(())
        })
    })
}

/// Time of the water [s].
///
/// Memory: `time` is NULL or points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_time(element: *const splashdown_element, time: *mut f64) -> splashdown_status {
    // SAFETY: a number by the contract of the caller.
    guarded(|| ELEMENTS.with(element, |element| unsafe { buffers::write_one("time", element.run.time(), time) }))
}

/// Longest step that the water could take next [s].
///
/// Memory: `dt` is NULL or points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_fluid_dt(element: *const splashdown_element, dt: *mut f64) -> splashdown_status {
    // SAFETY: a number by the contract of the caller.
    guarded(|| ELEMENTS.with(element, |element| unsafe { buffers::write_one("dt", element.run.fluid_dt()?, dt) }))
}

/// End the run: write summary and report to the folder of splashdown_record. The element is consumed, also after an error.
#[unsafe(no_mangle)]
pub extern "C" fn splashdown_finish(element: *mut splashdown_element) -> splashdown_status {
    guarded(|| {
        ELEMENTS.with_slot(element, |slot| match slot.take() {
            Some(element) => element.run.finish().map(|_| ()).map_err(Failure::from),
            None => Ok(()),
        })
    })
}

/// Free an element without ending its run: what was recorded stays as it is. NULL is allowed.
#[unsafe(no_mangle)]
pub extern "C" fn splashdown_free_element(element: *mut splashdown_element) -> splashdown_status {
    guarded(|| ELEMENTS.free(element))
}
