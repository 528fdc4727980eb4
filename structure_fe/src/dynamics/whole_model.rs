//! Operations on the whole model: rigid initial velocity, and equilibrium without unresolved vibrations.

use super::solver::Rule;
use super::{Dynamics, State};
use crate::error::{Error, above_zero};

impl Dynamics {
    /// Sets the velocity of a rigid motion: `velocity` \[m/s\] at the `reference` point \[m\], and `angular_velocity`
    /// \[rad/s\]. Accelerations do not change: call [`Dynamics::equilibrate`] afterwards.
    pub fn set_rigid_velocity(
        &self,
        state: &mut State,
        reference: [f64; 2],
        velocity: [f64; 2],
        angular_velocity: f64,
    ) {
        for (node, at) in self.beam().nodes().iter().enumerate() {
            let [x, y] = [0, 1].map(|axis| at[axis] + state.displacement[node][axis] - reference[axis]);
            state.velocity[node] =
                [velocity[0] - angular_velocity * y, velocity[1] + angular_velocity * x, angular_velocity];
        }
    }

    /// Like [`Dynamics::equilibrate`], but with the effective inertia of a step `dt` \[s\] (THEORY BE23), which filters
    /// vibrations that such a step does not resolve.
    ///
    /// Preferable with lumped masses: without the filter the accelerations are the forces of the stiffest vibrations over
    /// the smallest masses. The trapezoidal rule ends a [`Dynamics::step`] with these accelerations.
    pub fn equilibrate_over(&mut self, state: &mut State, load: &[[f64; 3]], dt: f64) -> Result<(), Error> {
        self.model.check_load(load)?;
        above_zero("time step [s]", dt)?;
        self.apply_ruptures(state)?;
        let Rule::Trapezoidal(rule) = &self.rule else { return self.equilibrate(state, load) };
        self.model.residual_at_prescribed_acceleration(&rule.mass, state, load);
        let residual = self.residual(state, load);
        let added = self.effective_inertia(state, dt).solve(&residual)?;
        for (a, added) in state.acceleration.as_flattened_mut().iter_mut().zip(added.as_flattened()) {
            *a += added;
        }
        Ok(())
    }
}
