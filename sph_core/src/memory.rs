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
        self.bytes_by_use().iter().map(|(_, bytes)| bytes).sum()
    }

    /// The same by what it is for [bytes].
    pub fn bytes_by_use(&self) -> Vec<(&'static str, usize)> {
        let Particles { x, y, u, v, rho, mass, h, theta, ax, ay, id, energy, halvings, stirred } = &self.particles;
        let Derived { pressure, volume, surroundings, near_surface } = &self.derived;
        let of = |numbers: &[&Vec<f64>]| numbers.iter().map(|v| of_vector(v)).sum::<usize>();
        let state = of(&[x, y, u, v, rho, mass, h, ax, ay]) + of_vector(id) + of_vector(halvings) + of_vector(stirred);
        let mut table = vec![
            ("state", state),
            ("theta, energy", of(&[theta, energy])),
            ("pressure, volume", of(&[pressure, volume])),
            ("surroundings", of_vector(surroundings) + of_vector(near_surface)),
            ("rates", of(&[&self.density_rate, &self.heating, &self.scratch])),
            ("walls", of_vector(&self.extrapolated) + of_vector(&self.wall_force)),
        ];
        table.extend(self.rows.bytes());
        table.extend(self.search.bytes());
        table
    }
}
