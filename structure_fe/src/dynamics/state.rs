//! The state of a moving model, how it is integrated, and what a step reports.

use crate::rupture::Break;

/// Where the model is and how it moves: fields over the nodes, `[nodes][u, w, theta]`.
///
/// It is the whole memory of the motion: a copy of it is all a host needs to reject a step and redo it,
/// to the same bits. Begin with [`Dynamics::at_rest`](crate::Dynamics::at_rest).
#[derive(Debug, Clone, PartialEq)]
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
    /// Plastic curvatures at two places of each element \[1/m\]; empty where nothing yields.
    pub plastic_curvature: Vec<[f64; 2]>,
    /// What has broken, in the order in which it did.
    pub ruptures: Vec<Break>,
}

/// How time is stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Integration {
    /// Implicit, second order, stable for linear models at any step (Chung & Hulbert 1993; THEORY S17).
    GeneralisedAlpha {
        /// What a step leaves of the fastest vibrations: rho in [0, 1]. 1 is the trapezoidal rule, without
        /// damping, which may blow up in stiff rotation; 0.8 damps what the step cannot resolve anyway.
        spectral_radius: f64,
    },
    /// Explicit, second order, with a lumped mass; steps up to
    /// [`Dynamics::stable_dt`](crate::Dynamics::stable_dt) (THEORY S18).
    CentralDifference,
    /// Implicit, in momentum: what the mean load gives, the lumped masses have, to rounding (THEORY S22). The only
    /// one that knows rigid bodies. Second order for a spectral radius of 1, first order below it.
    Trapezoidal {
        /// What a step leaves of the fastest vibrations: rho in (0, 1]. 1 conserves the energy of linear models.
        spectral_radius: f64,
    },
}

/// The motion of a support at the end of the next step, of one degree of freedom.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SupportMotion {
    /// Displacement \[m, rad\].
    pub displacement: f64,
    /// Velocity \[m/s, rad/s\].
    pub velocity: f64,
    /// Acceleration \[m/s^2, rad/s^2\].
    pub acceleration: f64,
}

/// What a step took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport {
    /// Newton's corrections; 0 where the step is explicit.
    pub iterations: usize,
    /// Tangents made and factorised.
    pub tangents: usize,
    /// The last correction as a fraction of the step's motion \[-\].
    pub last_correction: f64,
    /// What damping and the rule took of the energy \[J\] (THEORY S23); NaN under rules that do not tell.
    pub dissipated: f64,
    /// Work of the supports on the model \[J\], where they move; NaN under rules that do not tell.
    pub support_work: f64,
}

impl StepReport {
    pub(crate) fn begun() -> Self {
        Self {
            iterations: 0,
            tangents: 0,
            last_correction: f64::INFINITY,
            dissipated: f64::NAN,
            support_work: f64::NAN,
        }
    }
}
