//! The state of a moving model, the choice of integration rule, and the report of a step.

use serde::{Deserialize, Serialize};

use crate::assembly::Kinematics;
use crate::element::PlasticStrains;
use crate::model::Break;

/// Displacement and motion of a model: fields over the nodes, `[nodes][u, w, theta]`.
///
/// It is complete: from a copy of it a rejected step can be repeated with the same bits. Start with [`Dynamics::at_rest`](crate::Dynamics::at_rest).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Displacement `[u, w, theta]` \[m, m, rad\].
    pub displacement: Vec<[f64; 3]>,
    /// Velocity \[m/s, m/s, rad/s\].
    pub velocity: Vec<[f64; 3]>,
    /// Acceleration \[m/s^2, m/s^2, rad/s^2\], in equilibrium with the load at `time`; after a step of the trapezoidal
    /// rule with its mean load, over the step ([`Dynamics::equilibrate_over`](crate::Dynamics::equilibrate_over)).
    pub acceleration: Vec<[f64; 3]>,
    /// Time t \[s\].
    pub time: f64,
    /// The acceleration that generalised-alpha integrates (Arnold & Bruels 2007), between that of the last
    /// step and of this one: the same as `acceleration` at the start, and always for a spectral radius of 1.
    /// Under the trapezoidal rule the mean acceleration of the last step.
    pub integrated_acceleration: Vec<[f64; 3]>,
    /// Mean force of the supports over the last step, springs included \[N, N, N m\]; of the trapezoidal rule only.
    pub mean_reaction: Vec<[f64; 3]>,
    /// Plastic strains of each element; empty for an elastic model.
    pub plastic: Vec<PlasticStrains>,
    /// Ruptures in the order in which they occurred.
    pub ruptures: Vec<Break>,
}

/// The integration rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Integration {
    /// Implicit, second order, stable for linear models at any step (Chung & Hulbert 1993; THEORY BE17).
    GeneralisedAlpha {
        /// Remaining fraction of the fastest vibrations after a step: rho in [0, 1]. 1 is the trapezoidal rule, without
        /// damping, which may be unstable in stiff rotation; 0.8 damps vibrations that the step does not resolve.
        spectral_radius: f64,
    },
    /// Explicit, second order, with a lumped mass; steps up to
    /// [`Dynamics::stable_dt`](crate::Dynamics::stable_dt) (THEORY BE18).
    CentralDifference,
    /// Implicit, in momentum form: the impulse of the mean load is the change of momentum to rounding, with lumped
    /// masses (THEORY BE21). The only rule that supports rigid bodies, plasticity and rupture. Second order for a
    /// spectral radius of 1, first order below it.
    Trapezoidal {
        /// Remaining fraction of the fastest vibrations after a step: rho in (0, 1]. 1 conserves the energy of linear models.
        spectral_radius: f64,
    },
}

/// The motion of a support in one degree of freedom at the end of the next step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SupportMotion {
    /// Displacement \[m, rad\].
    pub displacement: f64,
    /// Velocity \[m/s, rad/s\].
    pub velocity: f64,
    /// Acceleration \[m/s^2, rad/s^2\].
    pub acceleration: f64,
}

/// Work and energy balance of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport {
    /// Newton corrections; 0 if the rule is explicit.
    pub iterations: usize,
    /// Tangents assembled and factorised.
    pub tangents: usize,
    /// The last correction as a fraction of the step's motion \[-\].
    pub last_correction: f64,
    /// Energy dissipated by damping, plasticity and the rule \[J\] (THEORY BE22); NaN except under the trapezoidal rule.
    pub dissipated: f64,
    /// Work of moving supports on the model \[J\]; NaN except under the trapezoidal rule.
    pub support_work: f64,
}

impl State {
    /// Views of displacement, velocity and acceleration.
    pub(super) fn kinematics(&self) -> Kinematics<'_> {
        Kinematics { q: &self.displacement, v: &self.velocity, a: &self.acceleration }
    }
}

impl StepReport {
    pub(super) fn new() -> Self {
        Self {
            iterations: 0,
            tangents: 0,
            last_correction: f64::INFINITY,
            dissipated: f64::NAN,
            support_work: f64::NAN,
        }
    }
}
