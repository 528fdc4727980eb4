//! How a run can break down: which particle, where, when.

/// The fluid cannot be advanced further. Positions are in metres, times in seconds; a message names the numbers of its variant.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the message of a variant names its fields")]
pub enum Breakdown {
    /// A particle's state is no longer a finite number.
    #[error("particle {id} at ({x:.6}, {y:.6}) m has a non-finite state at t = {time:.6e} s")]
    NotFinite { id: u32, x: f64, y: f64, time: f64 },
    /// A density so far from the reference that the equation of state has no meaning.
    #[error(
        "particle {id} at ({x:.6}, {y:.6}) m has density {rho:.1} kg/m^3 at t = {time:.6e} s: weakly compressible flow stays within 30 % of the reference"
    )]
    Density { id: u32, x: f64, y: f64, rho: f64, time: f64 },
    /// The stable step has shrunk to nothing.
    #[error(
        "the stable step fell to {dt:.3e} s at t = {time:.6e} s: particle {id} at ({x:.6}, {y:.6}) m moves at {speed:.3e} m/s and accelerates at {acceleration:.3e} m/s^2"
    )]
    Step {
        dt: f64,
        /// Identity of the limiting particle.
        id: u32,
        x: f64,
        y: f64,
        speed: f64,
        acceleration: f64,
        time: f64,
    },
    /// The thesis's pressure equation (THEORY LE27) has no solution that the iteration finds.
    #[error(
        "the pressure equation did not converge at t = {time:.6e} s: after {iterations} iterations a residual of {residual:.3e} of the density is left where {tolerance:.3e} was asked, at {kind} {id} at ({x:.6}, {y:.6}) m"
    )]
    Poisson {
        iterations: usize,
        /// Largest residual of a row [-], relative to the density.
        residual: f64,
        tolerance: f64,
        /// Identity of the particle whose row it is.
        id: u32,
        /// `particle`, or `limit particle`.
        kind: &'static str,
        x: f64,
        y: f64,
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
        tolerance: f64,
        /// Identity of the particle whose row it is.
        id: u32,
        x: f64,
        y: f64,
        time: f64,
    },
    /// The masses that give every particle the reference density cannot be found (THEORY LE28).
    #[error(
        "no masses of {unknowns} particles give all of them the reference density: the kernel's matrix is singular"
    )]
    Masses { unknowns: usize },
}
