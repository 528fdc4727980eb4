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
    /// The thesis's pressure equation (THEORY LE27) has no solution that the iteration finds.
    #[error(
        "the pressure equation did not converge at t = {time:.6e} s: after {iterations} iterations a residual of {residual:.3e} of the density is left where {tolerance:.3e} was asked, at {kind} {id} at ({x:.6}, {y:.6}) m"
    )]
    Poisson {
        /// Iterations made.
        iterations: usize,
        /// Largest residual of a row [-], relative to the density.
        residual: f64,
        /// What was asked for [-].
        tolerance: f64,
        /// Identity of the particle whose row it is.
        id: u32,
        /// `particle`, or `limit particle`.
        kind: &'static str,
        /// Position [m].
        x: f64,
        /// Position [m].
        y: f64,
        /// Time [s].
        time: f64,
    },
    /// The projection's pressure equation (THEORY PR8–PR11) has no solution that the iteration finds. Nothing has moved: a
    /// shorter step may be tried.
    #[error(
        "the pressure did not converge at t = {time:.6e} s: after {iterations} iterations {residual:.3e} of the largest right-hand side is left where {tolerance:.1e} was asked, at particle {id} at ({x:.6}, {y:.6}) m"
    )]
    Projection {
        /// Iterations made, those of all attempts.
        iterations: usize,
        /// Largest residual of a row [-], over the largest right-hand side.
        residual: f64,
        /// What was asked for [-].
        tolerance: f64,
        /// Identity of the particle whose row it is.
        id: u32,
        /// Position [m].
        x: f64,
        /// Position [m].
        y: f64,
        /// Time [s].
        time: f64,
    },
    /// The masses that give every particle the reference density cannot be found (THEORY LE28).
    #[error(
        "no masses of {unknowns} particles give all of them the reference density: the kernel's matrix is singular"
    )]
    Masses {
        /// Particles.
        unknowns: usize,
    },
}
