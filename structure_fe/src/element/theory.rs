//! Beam theories: with and without shear deformation.

use serde::{Deserialize, Serialize};

/// The theory of an element. Euler-Bernoulli by default; see [`Beam::with_theory`](crate::Beam::with_theory).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Theory {
    /// Sections stay normal to the axis: no shear deformation. For length/thickness above about 10.
    #[default]
    EulerBernoulli,
    /// Sections stay plane but turn against the axis by Q/(kappa G A) (Timoshenko 1921).
    Timoshenko {
        /// Shear correction kappa \[-\], positive: 5/6 for a rectangle (Reissner 1945), or
        /// (5 + 5 nu)/(6 + 5 nu) (Kaneko 1975).
        shear_correction: f64,
    },
}

impl Theory {
    /// Timoshenko's theory with kappa = 5/6, a rectangle's.
    pub const TIMOSHENKO: Self = Self::Timoshenko { shear_correction: 5.0 / 6.0 };
}
