//! Memory of the fluid, counted.

use crate::fluid::Fluid;
use crate::particles::{Derived, Particles};

/// What a vector holds on to [bytes].
pub(crate) fn of_vector<T>(vector: &Vec<T>) -> usize {
    vector.capacity() * size_of::<T>()
}

impl Fluid {
    /// What a weakly compressible fluid holds on to: state, rows and neighbour lists [bytes]. Not counted: what other solvers and
    /// integrators, options and saved states need beside that, and what a search needs while it lasts.
    pub fn bytes(&self) -> usize {
        let Particles { x, y, u, v, rho, mass, h, theta, ax, ay, id, energy, halvings } = &self.particles;
        let Derived { pressure, volume, surroundings, near_surface } = &self.derived;
        let numbers = [x, y, u, v, rho, mass, h, theta, ax, ay, energy, pressure, volume];
        let rates = [&self.density_rate, &self.heating, &self.scratch];
        let state: usize = numbers.into_iter().chain(rates).map(of_vector).sum();
        state
            + of_vector(id)
            + of_vector(halvings)
            + of_vector(surroundings)
            + of_vector(near_surface)
            + of_vector(&self.gathered)
            + of_vector(&self.extrapolated)
            + of_vector(&self.wall_force)
            + self.rows.bytes()
            + self.search.bytes()
    }
}
