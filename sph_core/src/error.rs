//! How a run can break down: which particle, where, when.

/// The fluid cannot be advanced further.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Breakdown {
    /// A particle's state is no longer a finite number.
    #[error("particle {id} at ({x:.6}, {y:.6}) m has a non-finite state at t = {time:.6e} s")]
    NotFinite {
        /// Identity of the particle.
        id: u32,
        /// Position [m].
        x: f64,
        /// Position [m].
        y: f64,
        /// Time [s].
        time: f64,
    },
    /// A density so far from the reference that the equation of state has no meaning.
    #[error(
        "particle {id} at ({x:.6}, {y:.6}) m has density {rho:.1} kg/m^3 at t = {time:.6e} s: weakly compressible flow stays within 30 % of the reference"
    )]
    Density {
        /// Identity of the particle.
        id: u32,
        /// Position [m].
        x: f64,
        /// Position [m].
        y: f64,
        /// Density [kg/m³].
        rho: f64,
        /// Time [s].
        time: f64,
    },
    /// The stable step has shrunk to nothing.
    #[error(
        "the stable step fell to {dt:.3e} s at t = {time:.6e} s: particle {id} at ({x:.6}, {y:.6}) m moves at {speed:.3e} m/s and accelerates at {acceleration:.3e} m/s^2"
    )]
    Step {
        /// The step [s].
        dt: f64,
        /// Identity of the limiting particle.
        id: u32,
        /// Position [m].
        x: f64,
        /// Position [m].
        y: f64,
        /// Speed [m/s].
        speed: f64,
        /// Acceleration [m/s²].
        acceleration: f64,
        /// Time [s].
        time: f64,
    },
}
