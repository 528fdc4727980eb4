//! Contacts and joints in the summary.

use std::collections::BTreeMap;

use fsi_coupling::{Coupled, JointState, TouchRecord};
use serde::Serialize;

/// How two bodies touched (THEORY CO37).
#[derive(Clone, Debug, PartialEq, Serialize)]
#[expect(non_snake_case, reason = "units in names, as in files")]
pub struct ContactResult {
    /// Names of the bodies.
    pub bodies: [String; 2],
    /// When they first touched [s].
    pub first_s: f64,
    /// Where [m].
    pub at_m: [f64; 2],
    /// Impulse of all contacts, by magnitude [N s/m].
    pub impulse_N_s_per_m: f64,
    /// Largest depth of one behind the other's surface [m]: how far it moves in a step.
    pub deepest_m: f64,
}

/// A joint at the end of the run (THEORY CO38).
#[derive(Clone, Debug, PartialEq, Serialize)]
#[expect(non_snake_case, reason = "units in names, as in files")]
pub struct JointResult {
    /// Time at which it broke; absent where it holds [s].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub broken_s: Option<f64>,
    /// Largest mean force of a step [N/m].
    pub largest_force_N_per_m: f64,
    /// The coordinate that it leaves free, less its value at the start [rad of a hinge, else m].
    pub value: f64,
}

/// Which bodies touched so far.
pub(super) fn contact_results(system: &Coupled) -> Vec<ContactResult> {
    let of = |touched: &TouchRecord| {
        let TouchRecord { bodies, first, at, impulse, deepest } = touched.clone();
        ContactResult { bodies, first_s: first, at_m: at, impulse_N_s_per_m: impulse, deepest_m: deepest }
    };
    system.touched().iter().map(of).collect()
}

/// The joints now, by name.
pub(super) fn joint_results(system: &Coupled) -> BTreeMap<String, JointResult> {
    let of = |JointState { name, value, largest, broken, .. }: JointState| {
        (name, JointResult { broken_s: broken, largest_force_N_per_m: largest, value })
    };
    system.joints().into_iter().map(of).collect()
}
