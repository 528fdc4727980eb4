//! A structure by its modes: places, energies, forces (THEORY BE28).

use faer::prelude::Solve;
use faer::{Mat, Side};

use super::inertia::ShapeIntegrals;
use super::mode::{Frame, ModalMode, ModalState, turned};
use crate::error::{Error, finite, not_negative, positive};

/// A structure by its modes. It holds no state of the motion: that is the caller's [`ModalState`].
#[derive(Clone, Debug)]
pub struct ModalStructure {
    frame: Frame,
    nodes: Vec<[f64; 2]>,
    modes: Vec<ModalMode>,
    integrals: ShapeIntegrals,
}

impl ModalStructure {
    /// A structure with `nodes` \[m, frame's axes\] that carry `masses` \[kg/m\], moving in `modes`.
    ///
    /// Masses link the modes with the frame's motion. Modes of a structure that is free as a whole need none: they carry no momentum.
    pub fn new(frame: Frame, nodes: Vec<[f64; 2]>, masses: Vec<f64>, modes: Vec<ModalMode>) -> Result<Self, Error> {
        not_negative("mass of the frame [kg/m]", frame.mass)?;
        not_negative("moment of inertia of the frame [kg m²/m]", frame.inertia)?;
        let counted = |quantity, given: usize| match given == nodes.len() {
            true => Ok(()),
            false => Err(Error::WrongLength { quantity, given, expected: nodes.len() }),
        };
        counted("the list of masses", masses.len())?;
        for (k, (at, mass)) in nodes.iter().zip(&masses).enumerate() {
            finite("place", "node", k, at)?;
            let expected = "at least 0 and finite";
            if !(*mass >= 0.0 && mass.is_finite()) {
                return Err(Error::BadProperty {
                    quantity: "mass [kg/m]",
                    item: "node",
                    index: k,
                    value: *mass,
                    expected,
                });
            }
        }
        for (j, mode) in modes.iter().enumerate() {
            counted("the shape of a mode", mode.shape.len())?;
            positive("frequency [Hz]", "mode", j, mode.frequency)?;
            positive("generalised mass [kg/m]", "mode", j, mode.mass)?;
            finite("shape", "mode", j, mode.shape.as_flattened())?;
            not_negative("damping ratio of a mode [-]", mode.damping_ratio)?;
        }
        let integrals = ShapeIntegrals::new(&frame, &nodes, &masses, &modes);
        let structure = ModalStructure { frame, nodes, modes, integrals };
        structure.check_inertia()?;
        Ok(structure)
    }

    /// An error where the nodes' masses carry more of a motion than the structure has.
    fn check_inertia(&self) -> Result<(), Error> {
        let mut mass = self.mass_matrix(&self.at_rest([0.0; 2], 0.0));
        for (k, held) in self.frame.held.into_iter().enumerate() {
            if held {
                isolate(&mut mass, k);
            }
        }
        let reason = "the mass matrix is not positive definite: the generalised masses are smaller than those of the nodes' masses in the shapes, or a frame that is free has no mass";
        let failed = |_| Error::LinearAlgebra { unknowns: self.unknowns(), reason: reason.into() };
        mass.llt(Side::Lower).map(|_| ()).map_err(failed)
    }

    /// Number of unknowns: three, and one for each mode.
    pub fn unknowns(&self) -> usize {
        3 + self.modes.len()
    }

    /// Mass of frame and nodes \[kg/m\].
    pub fn total_mass(&self) -> f64 {
        self.integrals.mass
    }

    /// The modes.
    pub fn modes(&self) -> &[ModalMode] {
        &self.modes
    }

    /// Which of x, y, rotation of the frame are held.
    pub fn held(&self) -> [bool; 3] {
        self.frame.held
    }

    /// Undeformed and at rest, with the frame at a place \[m\] and an angle \[rad\].
    pub fn at_rest(&self, [x, y]: [f64; 2], angle: f64) -> ModalState {
        let still = vec![0.0; self.unknowns()];
        let amplitude = vec![0.0; self.modes.len()];
        ModalState { frame: [x, y, angle], amplitude, velocity: still.clone(), acceleration: still, time: 0.0 }
    }

    /// BE28: places of the nodes and of the frame, the frame last: `[x, y, turn]` \[m, m, rad\].
    pub fn places(&self, state: &ModalState) -> Vec<[f64; 3]> {
        let [x, y, angle] = state.frame;
        let place = |k: usize, at: &[f64; 2]| {
            let moved = self.sum_of_shapes(k, &state.amplitude);
            let [rx, ry] = turned([at[0] + moved[0], at[1] + moved[1]], angle);
            [x + rx, y + ry, angle + moved[2]]
        };
        self.nodes.iter().enumerate().map(|(k, at)| place(k, at)).chain([state.frame]).collect()
    }

    /// The shapes at a node, each times its factor.
    fn sum_of_shapes(&self, node: usize, factors: &[f64]) -> [f64; 3] {
        self.modes
            .iter()
            .zip(factors)
            .fold([0.0; 3], |sum, (mode, factor)| [0, 1, 2].map(|i| sum[i] + factor * mode.shape[node][i]))
    }

    /// BE28: ∂(places)/∂(unknowns), three rows for each node and for the frame, which is last.
    pub fn jacobian(&self, state: &ModalState) -> Vec<[Vec<f64>; 3]> {
        let ([x, y, angle], places) = (state.frame, self.places(state));
        let rows = |k: usize, place: &[f64; 3]| {
            let shape = |mode: &ModalMode| match mode.shape.get(k) {
                Some([u, v, turn]) => {
                    let [u, v] = turned([*u, *v], angle);
                    [u, v, *turn]
                }
                None => [0.0; 3], // the frame
            };
            let rigid = [[1.0, 0.0, y - place[1]], [0.0, 1.0, place[0] - x], [0.0, 0.0, 1.0]];
            let shapes: Vec<[f64; 3]> = self.modes.iter().map(shape).collect();
            [0, 1, 2].map(|i| rigid[i].into_iter().chain(shapes.iter().map(|shape| shape[i])).collect())
        };
        places.iter().enumerate().map(|(k, place)| rows(k, place)).collect()
    }

    /// The part of the accelerations of the nodes, and of the frame, that comes from velocities: centripetal and Coriolis \[m/s²\].
    pub fn convective_acceleration(&self, state: &ModalState) -> Vec<[f64; 3]> {
        let ([x, y, angle], spin) = (state.frame, state.velocity[2]);
        let at = |(k, place): (usize, &[f64; 3])| {
            let rate = if k < self.nodes.len() { self.sum_of_shapes(k, &state.velocity[3..]) } else { [0.0; 3] };
            let [u, v] = turned([rate[0], rate[1]], angle);
            [-spin * spin * (place[0] - x) - 2.0 * spin * v, -spin * spin * (place[1] - y) + 2.0 * spin * u, 0.0]
        };
        self.places(state).iter().enumerate().map(at).collect()
    }

    /// BE28: mass matrix of x, y, rotation and amplitudes.
    pub(super) fn mass_matrix(&self, state: &ModalState) -> Mat<f64> {
        self.integrals.mass_matrix(&self.modes, state)
    }

    /// BE28: the generalised weight.
    pub(super) fn weight(&self, state: &ModalState, gravity: [f64; 2]) -> Vec<f64> {
        self.integrals.weight(state, gravity)
    }

    /// BE28: centripetal and Coriolis forces of a frame that turns.
    pub(super) fn convective_forces(&self, state: &ModalState) -> Vec<f64> {
        self.integrals.convective_forces(state)
    }

    /// Kinetic energy \[J/m\].
    pub fn kinetic_energy(&self, state: &ModalState) -> f64 {
        0.5 * dot(&times(&self.mass_matrix(state), &state.velocity), &state.velocity)
    }

    /// Elastic energy ½ Σ k q² \[J/m\].
    pub fn strain_energy(&self, state: &ModalState) -> f64 {
        0.5 * self.modes.iter().zip(&state.amplitude).map(|(mode, q)| mode.stiffness() * q * q).sum::<f64>()
    }

    /// Linear momentum \[N s/m\].
    pub fn momentum(&self, state: &ModalState) -> [f64; 2] {
        let momenta = times(&self.mass_matrix(state), &state.velocity);
        [momenta[0], momenta[1]]
    }

    /// −g·Σ m r: potential energy \[J/m\].
    pub fn potential_energy(&self, state: &ModalState, gravity: [f64; 2]) -> f64 {
        let [sx, sy] = turned(self.integrals.first_moment(&state.amplitude), state.frame[2]);
        let mass = self.integrals.mass;
        -gravity[0] * (mass * state.frame[0] + sx) - gravity[1] * (mass * state.frame[1] + sy)
    }

    /// BE29: M + θ²Δt²K + θΔt C of a step \[s\], θ = ½: forces over the accelerations in such a step.
    pub fn effective_inertia(&self, state: &ModalState, dt: f64) -> Mat<f64> {
        let mut matrix = self.mass_matrix(state);
        for (j, mode) in self.modes.iter().enumerate() {
            matrix[(3 + j, 3 + j)] += 0.25 * dt * dt * mode.stiffness() + 0.5 * dt * mode.damping();
        }
        matrix
    }

    /// BE29: load, weight and the structure's own forces, less what the state's accelerations need.
    pub fn residual(&self, state: &ModalState, load: &[f64], gravity: [f64; 2]) -> Vec<f64> {
        let needed = times(&self.mass_matrix(state), &state.acceleration);
        let own = self.own_forces(state, gravity);
        (0..self.unknowns()).map(|k| load[k] + own[k] - needed[k]).collect()
    }

    /// The accelerations of a state in equilibrium with a load, filtered for a step of `dt` \[s\]. Those of what is held stay.
    pub fn equilibrate(&self, state: &mut ModalState, load: &[f64], gravity: [f64; 2], dt: f64) -> Result<(), Error> {
        let lacking = self.residual(state, load, gravity);
        let added = self.solve_free(self.effective_inertia(state, dt), lacking)?;
        state.acceleration.iter_mut().zip(&added).for_each(|(a, more)| *a += more);
        Ok(())
    }

    /// Solves for the unknowns that are free; what is held gets zero.
    pub fn solve_free(&self, mut matrix: Mat<f64>, mut right: Vec<f64>) -> Result<Vec<f64>, Error> {
        for (k, held) in self.frame.held.into_iter().enumerate() {
            if held {
                isolate(&mut matrix, k);
                right[k] = 0.0;
            }
        }
        let right = Mat::from_fn(right.len(), 1, |i, _| right[i]);
        let found: Vec<f64> = matrix.partial_piv_lu().solve(&right).col(0).iter().copied().collect();
        match found.iter().all(|value| value.is_finite()) {
            true => Ok(found),
            false => Err(Error::LinearAlgebra { unknowns: found.len(), reason: "the motion is not finite".into() }),
        }
    }

    /// Weight, elastic and damping forces, and those of the frame's rotation.
    fn own_forces(&self, state: &ModalState, gravity: [f64; 2]) -> Vec<f64> {
        let (weight, turning) = (self.weight(state, gravity), self.convective_forces(state));
        let mut forces: Vec<f64> = weight.iter().zip(&turning).map(|(w, t)| w + t).collect();
        for (j, mode) in self.modes.iter().enumerate() {
            forces[3 + j] -= mode.stiffness() * state.amplitude[j] + mode.damping() * state.velocity[3 + j];
        }
        forces
    }
}

/// The equation of an unknown becomes that of itself alone.
fn isolate(matrix: &mut Mat<f64>, k: usize) {
    for i in 0..matrix.nrows() {
        (matrix[(k, i)], matrix[(i, k)]) = (0.0, 0.0);
    }
    matrix[(k, k)] = 1.0;
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn times(matrix: &Mat<f64>, vector: &[f64]) -> Vec<f64> {
    (0..matrix.nrows()).map(|i| (0..vector.len()).map(|j| matrix[(i, j)] * vector[j]).sum()).collect()
}
