//! What a host does with a moving model as a whole: weighs it, throws it, lets go of fast vibrations.

use crate::dynamics::{Dynamics, Method};
use crate::error::{Error, positive};
use crate::lumped::nodal_masses;
use crate::state::State;

impl Dynamics {
    /// Gravity \[m/s^2\] on the masses lumped at the nodes, rigid bodies included: a load `[nodes][F_x, F_y, M]`.
    pub fn weight(&self, gravity: [f64; 2]) -> Vec<[f64; 3]> {
        let of =
            |masses: &[[f64; 3]]| masses.iter().map(|mass| [mass[0] * gravity[0], mass[1] * gravity[1], 0.0]).collect();
        match &self.method {
            Method::Implicit(_) => of(&nodal_masses(&self.system.beam)),
            Method::Explicit(mass) => of(&mass.nodal),
            Method::Momentum(rule) => of(&rule.mass.nodal),
        }
    }

    /// Gives everything the velocity of a rigid body: `velocity` \[m/s\] at the place `pole` \[m\], and `spin`
    /// \[rad/s\]. Accelerations stay what they were: call [`Dynamics::equilibrate`] then.
    pub fn start_moving(&self, state: &mut State, pole: [f64; 2], velocity: [f64; 2], spin: f64) {
        for (node, at) in self.system.beam.nodes().iter().enumerate() {
            let [x, y] = [0, 1].map(|axis| at[axis] + state.displacement[node][axis] - pole[axis]);
            state.velocity[node] = [velocity[0] - spin * y, velocity[1] + spin * x, spin];
        }
    }

    /// Like [`Dynamics::equilibrate`], but with the accelerations that the effective inertia of a step `dt` \[s\]
    /// gives (THEORY S24): vibrations that such a step does not resolve are left out.
    ///
    /// With lumped masses this is the one to take: the other tells the forces of the stiffest vibrations over
    /// the smallest masses. A [`Dynamics::step`] of the trapezoidal rule ends with these.
    pub fn equilibrate_over(&mut self, state: &mut State, load: &[[f64; 3]], dt: f64) -> Result<(), Error> {
        self.check(load)?;
        positive("time step [s]", "step", 0, dt)?;
        self.adopt(state)?;
        let Some(rule) = self.rule() else { return self.equilibrate(state, load) };
        self.lack_at_known_acceleration(&rule, state, load);
        let lack = self.lack(state, load);
        let added = self.effective_inertia(state, dt).solve(&lack)?;
        for (a, added) in state.acceleration.as_flattened_mut().iter_mut().zip(added.as_flattened()) {
            *a += added;
        }
        Ok(())
    }
}
