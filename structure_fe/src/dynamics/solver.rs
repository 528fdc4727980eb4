//! Motion in time, at large displacements.

use crate::beam::Beam;
use crate::bordered::Bordered;
use crate::corotational::Chord;
use crate::element::Ends;
use crate::error::{Error, finite, positive};
use crate::gathered::gather;
use crate::generalised_alpha::Coefficients;
use crate::inertia::{Damping, Weights, momentum};
use crate::lumped::{LumpedMass, gathered_mass, lumped_mass};
use crate::section_forces::SectionForces;
use crate::state::{Integration, State, StepReport, SupportMotion};
use crate::supports::{Dof, Supports};
use crate::system::{Kinematics, System};
use crate::trapezoidal::Trapezoidal;
use std::sync::Arc;

/// A supported model that moves under loads at its nodes.
///
/// It holds no state of the motion: that is the caller's [`State`]. Loads are `[nodes][F_x, F_y, M]`
/// \[N, N, N m\]; [`Loads::at_nodes`](crate::Loads::at_nodes) makes them of loads along elements. The cost
/// of a step grows with the number of elements of a chain, and its band is laid out once.
#[derive(Debug, Clone)]
pub struct Dynamics {
    pub(crate) system: System,
    pub(crate) damping: Damping,
    pub(crate) method: Method,
    pub(crate) matrix: Bordered,
    pub(crate) internal: Vec<[f64; 3]>,
    motionless: Vec<[f64; 3]>,
    supports: Vec<(usize, Dof, SupportMotion)>,
    /// The model with nothing broken, and the nodes that are broken in `system`.
    pub(crate) unbroken: (Beam, Supports),
    pub(crate) broken: Vec<usize>,
}

/// The integration with what it needs beforehand.
#[derive(Debug, Clone)]
pub(crate) enum Method {
    Implicit(Coefficients),
    Explicit(LumpedMass),
    Momentum(Arc<Trapezoidal>),
}

impl Dynamics {
    /// A supported model with the way to integrate and to damp it. Supports may leave it free.
    pub fn new(beam: Beam, supports: Supports, integration: Integration, damping: Damping) -> Result<Self, Error> {
        for (quantity, value) in [
            ("Rayleigh damping of the mass [1/s]", damping.mass),
            ("Rayleigh damping of the stiffness [s]", damping.stiffness),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(Error::OutOfRange { quantity, value, expected: "[0, infinity)" });
            }
        }
        let unbroken = (beam.clone(), supports.clone());
        let (beam, gathered) = match integration {
            Integration::Trapezoidal { spectral_radius: value } => {
                if !(value > 0.0 && value <= 1.0) {
                    let quantity = "spectral radius of the trapezoidal rule [-]";
                    return Err(Error::OutOfRange { quantity, value, expected: "(0, 1]" });
                }
                gather(beam, &supports)?
            }
            _ => (beam, Vec::new()),
        };
        let system = System::new(beam, supports)?;
        let without_bodies = |integration: &'static str| {
            if let Some(&node) = system.beam.rigid_bodies().first() {
                return Err(Error::NoRigidBodies { integration, node });
            }
            if let Some(&(node, _)) = system.supports.breakables().first() {
                return Err(Error::NoRupture { integration, node });
            }
            let instead = "Integration::Trapezoidal";
            system
                .beam
                .first_that_yields()
                .map_or(Ok(()), |element| Err(Error::NoPlasticity { analysis: integration, element, instead }))
        };
        let method = match integration {
            Integration::GeneralisedAlpha { spectral_radius: value } => {
                if !(0.0..=1.0).contains(&value) {
                    let quantity = "spectral radius of generalised-alpha [-]";
                    return Err(Error::OutOfRange { quantity, value, expected: "[0, 1]" });
                }
                without_bodies("generalised-alpha")?;
                Method::Implicit(Coefficients::new(value))
            }
            Integration::CentralDifference => {
                without_bodies("the central difference")?;
                Method::Explicit(lumped_mass(&system, &damping))
            }
            Integration::Trapezoidal { spectral_radius: value } => {
                let mass = gathered_mass(&system, gathered);
                Method::Momentum(Arc::new(Trapezoidal { weight: (1.0 + value).recip(), mass }))
            }
        };
        let motionless = vec![[0.0; 3]; system.beam.nodes().len()];
        let supports =
            system.supports.fixed().iter().map(|&(node, dof)| (node, dof, SupportMotion::default())).collect();
        Ok(Self {
            matrix: system.matrix(),
            internal: motionless.clone(),
            system,
            damping,
            method,
            motionless,
            supports,
            unbroken,
            broken: Vec::new(),
        })
    }

    /// The model.
    pub fn beam(&self) -> &Beam {
        &self.system.beam
    }

    /// Undeformed, at rest, at time zero.
    pub fn at_rest(&self) -> State {
        State {
            displacement: self.motionless.clone(),
            velocity: self.motionless.clone(),
            acceleration: self.motionless.clone(),
            time: 0.0,
            integrated_acceleration: self.motionless.clone(),
            mean_reaction: self.motionless.clone(),
            plastic_curvature: self.system.unyielded(),
            ruptures: Vec::new(),
        }
    }

    /// Says how a supported degree of freedom moves: its motion at the end of the steps to come, until
    /// told otherwise. Supports stand still by default. Hinged nodes move together.
    pub fn prescribe(&mut self, node: usize, dof: Dof, motion: SupportMotion) -> Result<(), Error> {
        let given = [motion.displacement, motion.velocity, motion.acceleration];
        finite("prescribed motion of node", node, &given)?;
        if !self.system.supports.is_fixed(node, dof) {
            return Err(Error::NotSupported { node, dof });
        }
        let (supports, nodes) = (&self.system.supports, self.motionless.len());
        let leader = if dof == Dof::Theta { supports.turning_leaders(nodes) } else { supports.leaders(nodes) };
        let tied = |other: usize| leader[other] == leader[node];
        self.supports.retain(|&(other, fixed, _)| !(fixed == dof && tied(other)));
        self.supports.extend((0..leader.len()).filter(|&other| tied(other)).map(|other| (other, dof, motion)));
        Ok(())
    }

    /// Gives the state the accelerations that its motion and the load call for. Nothing moves.
    ///
    /// Call it once before the first step, and after any change of displacements or velocities by hand.
    pub fn equilibrate(&mut self, state: &mut State, load: &[[f64; 3]]) -> Result<(), Error> {
        self.check(load)?;
        let mut acceleration = self.motionless.clone();
        self.adopt(state)?;
        for (node, dof, motion) in self.prescribed() {
            acceleration[node][dof as usize] = motion.acceleration;
        }
        match &self.method {
            Method::Implicit(_) => {
                let at = Kinematics { q: &state.displacement, v: &state.velocity, a: &acceleration };
                let weights = Weights { acceleration: 1.0, velocity: 0.0, displacement: 0.0 };
                self.system.forces_and_tangent(at, &self.damping, weights, &mut self.internal, &mut self.matrix);
                let mut missing = self.residual(load);
                self.matrix.factorise().map_err(|pivot| self.system.singular(pivot))?;
                self.matrix.solve(&mut missing);
                self.system.equations.add(1.0, &missing, &mut acceleration);
            }
            Method::Explicit(mass) => {
                let at = Kinematics { q: &state.displacement, v: &state.velocity, a: &acceleration };
                self.system.restoring_forces(at, &self.damping, &mass.nodal, &mut self.internal);
                let free = mass.accelerations(&self.residual(load));
                self.system.equations.add(1.0, &free, &mut acceleration);
            }
            Method::Momentum(rule) => {
                let rule = Arc::clone(rule);
                let free = rule.mass.accelerations(&self.lack_at_known_acceleration(&rule, state, load));
                acceleration.clone_from(&state.acceleration);
                let ties = &self.system.equations.ties;
                self.system.equations.add(1.0, &free, &mut acceleration);
                ties.follow_acceleration(&ties.arms_at(&state.displacement), &state.velocity, &mut acceleration);
            }
        }
        state.integrated_acceleration.clone_from(&acceleration);
        state.acceleration = acceleration;
        Ok(())
    }

    /// One step of `dt` \[s\] under the `load` at its end; of the trapezoidal rule under its mean `load`. After an error the state is what it was.
    pub fn step(&mut self, state: &mut State, load: &[[f64; 3]], dt: f64) -> Result<StepReport, Error> {
        self.check(load)?;
        positive("time step [s]", "step", 0, dt)?;
        self.adopt(state)?;
        match &self.method {
            &Method::Implicit(coefficients) => self.implicit_step(&coefficients, state, load, dt),
            Method::Explicit(_) => self.explicit_step(state, load, dt),
            Method::Momentum(rule) => {
                let rule = Arc::clone(rule);
                self.momentum_step(&rule, state, load, dt)
            }
        }
    }

    /// The longest stable step \[s\]: infinite where implicit. Explicit: of the undeformed model, damping
    /// included; tension raises the frequencies of bending beyond it, so stay some percent below.
    pub fn stable_dt(&self) -> f64 {
        self.lumped().map_or(f64::INFINITY, |mass| mass.stable_dt)
    }

    /// Kinetic energy \[J\], with the mass that the integration uses.
    pub fn kinetic_energy(&self, state: &State) -> f64 {
        match self.lumped() {
            None => {
                let elements: f64 = self.momenta_of_elements(state).map(|(_, (energy, _))| energy).sum();
                elements + self.system.beam.kinetic_energy_of_points(&state.velocity)
            }
            Some(mass) => {
                let masses = mass.nodal.as_flattened().iter().zip(state.velocity.as_flattened());
                masses.map(|(mass, v)| 0.5 * mass * v.powi(2)).sum()
            }
        }
    }

    /// Elastic energy of beams and springs \[J\].
    pub fn strain_energy(&self, state: &State) -> f64 {
        self.system.strain_energy(&state.displacement, &state.plastic_curvature)
    }

    /// Linear momentum along x and y \[kg m/s\], and angular momentum about the origin \[kg m^2/s\].
    pub fn momentum(&self, state: &State) -> [f64; 3] {
        let masses = self.lumped().map_or(self.system.beam.points(), |mass| &mass.nodal);
        let mut nodal: Vec<[f64; 3]> =
            masses.iter().zip(&state.velocity).map(|(mass, v)| [0, 1, 2].map(|dof| mass[dof] * v[dof])).collect();
        if let Method::Implicit(_) = self.method {
            for (nodes, (_, ends)) in self.momenta_of_elements(state) {
                crate::beam::add_ends(&mut nodal, nodes, &ends);
            }
        }
        let places = self.system.beam.nodes().iter().zip(&state.displacement);
        places.zip(&nodal).fold([0.0; 3], |[x, y, about], ((place, moved), [px, py, own])| {
            let arm = [place[0] + moved[0], place[1] + moved[1]];
            [x + px, y + py, about + own + arm[0] * py - arm[1] * px]
        })
    }

    /// Force of the supports on the model, `[nodes][F_x, F_y, M]` \[N, N, N m\], with the inertia and the
    /// damping of what hangs on them.
    pub fn reactions(&self, state: &State, load: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let at = Kinematics { q: &state.displacement, v: &state.velocity, a: &state.acceleration };
        let mut internal = self.motionless.clone();
        match self.lumped() {
            None => self.system.forces(at, &self.damping, &mut internal),
            Some(mass) => {
                self.system.restoring_forces(at, &self.damping, &mass.nodal, &mut internal);
                for ((force, mass), a) in internal.iter_mut().zip(&mass.nodal).zip(&state.acceleration) {
                    *force = [0, 1, 2].map(|dof| force[dof] + mass[dof] * a[dof]);
                }
            }
        }
        self.system.reactions(&state.displacement, &internal, load)
    }

    /// Section forces at the ends of the elements: of element e at 2e (first node) and 2e + 1.
    ///
    /// Of the deformation alone, without what inertia and load along an element add inside it: they are
    /// q L^2/12 in the moment and q L/2 in the shear force at the ends of an element of length L.
    /// [`SectionForces::fibre_stress`] gives stresses.
    pub fn section_forces(&self, state: &State) -> Vec<SectionForces> {
        self.system.section_forces(&state.displacement, &state.plastic_curvature, None).into_flattened()
    }

    /// Strain of the outer fibres at the ends of the elements \[-\], plastic strain included: right-hand side, left-hand
    /// side; of element e at 2e (first node) and 2e + 1. Small strains: N/(EA) +- kappa h/2.
    pub fn fibre_strains(&self, state: &State) -> Vec<[f64; 2]> {
        self.system.fibre_strains(&state.displacement, &state.plastic_curvature)
    }

    /// Length of each element as it is \[m\], and the unit vector along it \[-\].
    pub fn chords(&self, state: &State) -> Vec<(f64, [f64; 2])> {
        let elements = self.system.beam.formulated();
        elements
            .map(|(nodes, element)| {
                let chord = Chord::new(element, &self.system.beam.ends(nodes, &state.displacement));
                (chord.length, chord.direction)
            })
            .collect()
    }

    fn momenta_of_elements(&self, state: &State) -> impl Iterator<Item = ([usize; 2], (f64, Ends))> {
        let beam = &self.system.beam;
        beam.formulated().map(|(nodes, element)| {
            let (q, v) = (beam.ends(nodes, &state.displacement), beam.ends(nodes, &state.velocity));
            (nodes, momentum(element, &q, &v))
        })
    }

    /// The lumped mass, where the integration has one.
    pub(crate) fn lumped(&self) -> Option<&LumpedMass> {
        match &self.method {
            Method::Implicit(_) => None,
            Method::Explicit(mass) => Some(mass),
            Method::Momentum(rule) => Some(&rule.mass),
        }
    }

    /// The motions of the supports that have not let go.
    pub(crate) fn prescribed(&self) -> impl Iterator<Item = (usize, Dof, SupportMotion)> {
        let held = |node: usize, dof: Dof| self.system.equations.number(node, dof as usize).is_none();
        self.supports.iter().copied().filter(move |&(node, dof, _)| held(node, dof))
    }

    /// Load less internal forces, where free.
    pub(crate) fn residual(&self, load: &[[f64; 3]]) -> Vec<f64> {
        let mut residual = self.system.equations.restrict(load);
        self.system.equations.subtract(&self.internal, &mut residual);
        residual
    }

    /// Moves the supports of a state to where they are told to be.
    pub(crate) fn move_supports(&self, state: &mut State) {
        for (node, dof, motion) in self.prescribed() {
            let dof = dof as usize;
            state.displacement[node][dof] = motion.displacement;
            state.velocity[node][dof] = motion.velocity;
            state.acceleration[node][dof] = motion.acceleration;
        }
    }

    pub(crate) fn check(&self, load: &[[f64; 3]]) -> Result<(), Error> {
        let (given, nodes) = (load.len(), self.motionless.len());
        if given != nodes {
            return Err(Error::WrongLength { quantity: "the load", given, nodes });
        }
        load.iter().enumerate().try_for_each(|(node, force)| finite("load [N, N m] at node", node, force))
    }
}
