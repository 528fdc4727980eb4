//! The solver for motion in time: an integration rule applied to a model.

use super::generalised_alpha::GeneralisedAlpha;
use super::lumped_mass::{LumpedMass, concentrate_at_bodies, explicit_mass, mass_with_bodies, nodal_masses};
use super::moving_model::MovingModel;
use super::trapezoidal::Trapezoidal;
use super::{Integration, State, StepReport, SupportMotion, central_difference, rupture};
use crate::assembly::{System, reactions};
use crate::element::{Damping, Ends, SectionForces, momentum};
use crate::error::{Error, above_zero, not_negative, require};
use crate::field::{Dof, combine, sum};
use crate::model::{Beam, Supports, add_ends};

/// A supported model that moves under loads at its nodes.
///
/// It holds no state of the motion: that is the caller's [`State`]. Loads are `[nodes][F_x, F_y, M]`
/// \[N, N, N m\]; [`Loads::at_nodes`](crate::Loads::at_nodes) makes them of loads along elements. The cost
/// of a step is proportional to the number of elements of a chain.
#[derive(Debug, Clone)]
pub struct Dynamics {
    pub(super) model: MovingModel,
    pub(super) rule: Rule,
    /// The model without ruptures, and the nodes that are broken in `model`.
    unbroken: (Beam, Supports),
    broken: Vec<usize>,
}

/// An integration rule with its constants.
#[derive(Debug, Clone)]
pub(super) enum Rule {
    GeneralisedAlpha(GeneralisedAlpha),
    CentralDifference(LumpedMass),
    Trapezoidal(Trapezoidal),
}

impl Rule {
    /// The lumped mass, if the rule has one.
    pub fn lumped_mass(&self) -> Option<&LumpedMass> {
        match self {
            Self::GeneralisedAlpha(_) => None,
            Self::CentralDifference(mass) => Some(mass),
            Self::Trapezoidal(rule) => Some(&rule.mass),
        }
    }
}

impl Dynamics {
    /// A supported model with an integration rule and damping. Supports may leave it free.
    pub fn new(beam: Beam, supports: Supports, integration: Integration, damping: Damping) -> Result<Self, Error> {
        not_negative("Rayleigh damping of the mass [1/s]", damping.mass)?;
        not_negative("Rayleigh damping of the stiffness [s]", damping.stiffness)?;
        let unbroken = (beam.clone(), supports.clone());
        let (system, rule) = match integration {
            Integration::GeneralisedAlpha { spectral_radius: value } => {
                let quantity = "spectral radius of generalised-alpha [-]";
                require((0.0..=1.0).contains(&value), quantity, value, "[0, 1]")?;
                let system = System::new(beam, supports)?;
                require_plain(&system, "generalised-alpha")?;
                (system, Rule::GeneralisedAlpha(GeneralisedAlpha::new(value)))
            }
            Integration::CentralDifference => {
                let system = System::new(beam, supports)?;
                require_plain(&system, "the central difference")?;
                let mass = explicit_mass(&system, &damping);
                (system, Rule::CentralDifference(mass))
            }
            Integration::Trapezoidal { spectral_radius: value } => {
                let quantity = "spectral radius of the trapezoidal rule [-]";
                require(value > 0.0 && value <= 1.0, quantity, value, "(0, 1]")?;
                let (system, mass) = with_concentrated_mass(beam, supports)?;
                (system, Rule::Trapezoidal(Trapezoidal { weight: (1.0 + value).recip(), mass }))
            }
        };
        Ok(Self { model: MovingModel::new(system, damping), rule, unbroken, broken: Vec::new() })
    }

    /// The model.
    pub fn beam(&self) -> &Beam {
        &self.model.system.beam
    }

    /// Undeformed, at rest, at time zero.
    pub fn at_rest(&self) -> State {
        self.model.at_rest()
    }

    /// Prescribes the motion of a fixed degree of freedom at the end of the following steps, until it is prescribed anew.
    /// Supports are at rest by default. Nodes joined by hinges and welds move together.
    pub fn prescribe(&mut self, node: usize, dof: Dof, motion: SupportMotion) -> Result<(), Error> {
        self.model.prescribe(node, dof, motion)
    }

    /// Sets the accelerations of a state to equilibrium with its motion and the load.
    ///
    /// Call it once before the first step, and after any change of displacements or velocities by hand.
    pub fn equilibrate(&mut self, state: &mut State, load: &[[f64; 3]]) -> Result<(), Error> {
        self.model.check_load(load)?;
        self.apply_ruptures(state)?;
        self.model.equilibrate(self.rule.lumped_mass(), state, load)
    }

    /// One step of `dt` \[s\] under the `load` at its end; under the trapezoidal rule its mean `load`. An error leaves
    /// the state unchanged.
    pub fn step(&mut self, state: &mut State, load: &[[f64; 3]], dt: f64) -> Result<StepReport, Error> {
        self.model.check_load(load)?;
        above_zero("time step [s]", dt)?;
        self.apply_ruptures(state)?;
        let model = &mut self.model;
        let (mut new, report) = match &self.rule {
            Rule::GeneralisedAlpha(rule) => rule.step(model, state, load, dt)?,
            Rule::CentralDifference(mass) => central_difference::step(mass, model, state, load, dt)?,
            Rule::Trapezoidal(rule) => rule.step(model, state, load, dt)?,
        };
        if let Err(error) = self.release(&mut new) {
            self.apply_ruptures(state)?;
            return Err(error);
        }
        *state = new;
        Ok(report)
    }

    /// Records joints beyond their limits in the state and releases their nodes.
    fn release(&mut self, state: &mut State) -> Result<(), Error> {
        let breaks = rupture::exceeded(&self.model.system, state);
        if !breaks.is_empty() {
            let places = self.beam().nodes().to_vec();
            state.ruptures.extend(breaks);
            self.apply_ruptures(state)?;
            rupture::move_bodies(self.beam(), &places, state);
        }
        Ok(())
    }

    /// Rebuilds the equations for the ruptures of a state. Steps, and all methods that change a state, do so themselves;
    /// a caller that restores a state from before a rupture calls it before it asks for momenta, energies or reactions.
    pub fn apply_ruptures(&mut self, state: &State) -> Result<(), Error> {
        let broken: Vec<usize> = state.ruptures.iter().map(|rupture| rupture.node).collect();
        let Rule::Trapezoidal(rule) = &mut self.rule else { return Ok(()) };
        if broken != self.broken {
            let (beam, supports) = &self.unbroken;
            let (system, mass) = with_concentrated_mass(beam.clone(), supports.without(&broken))?;
            rule.mass = mass;
            self.model.replace_system(system);
            self.broken = broken;
        }
        Ok(())
    }

    /// The longest stable step \[s\]: infinite if implicit. Explicit: that of the undeformed model, damping
    /// included; tension raises the frequencies of bending, so stay some percent below.
    pub fn stable_dt(&self) -> f64 {
        self.rule.lumped_mass().map_or(f64::INFINITY, |mass| mass.stable_dt)
    }

    /// Kinetic energy \[J\], with the mass of the integration rule.
    pub fn kinetic_energy(&self, state: &State) -> f64 {
        match self.rule.lumped_mass() {
            None => {
                let elements: f64 = self.element_momenta(state).map(|(_, (energy, _))| energy).sum();
                elements + self.beam().kinetic_energy_of_points(&state.velocity)
            }
            Some(mass) => sum(&mass.nodal, &state.velocity, |mass, v| 0.5 * mass * v.powi(2)),
        }
    }

    /// Elastic energy of beams and springs \[J\].
    pub fn strain_energy(&self, state: &State) -> f64 {
        self.model.system.strain_energy(&state.displacement, &state.plastic_curvature)
    }

    /// Linear momentum along x and y \[kg m/s\], and angular momentum about the origin \[kg m^2/s\].
    pub fn momentum(&self, state: &State) -> [f64; 3] {
        let lumped = self.rule.lumped_mass();
        let masses = lumped.map_or(self.beam().points(), |mass| &mass.nodal);
        let mut nodal = combine(masses, &state.velocity, |mass, v| mass * v);
        if lumped.is_none() {
            for (nodes, (_, ends)) in self.element_momenta(state) {
                add_ends(&mut nodal, nodes, &ends);
            }
        }
        let places = self.beam().nodes().iter().zip(&state.displacement);
        places.zip(&nodal).fold([0.0; 3], |[x, y, about], ((place, moved), [px, py, own])| {
            let arm = [place[0] + moved[0], place[1] + moved[1]];
            [x + px, y + py, about + own + arm[0] * py - arm[1] * px]
        })
    }

    /// Energy and momentum of each element with consistent mass.
    fn element_momenta(&self, state: &State) -> impl Iterator<Item = ([usize; 2], (f64, Ends))> {
        let beam = self.beam();
        beam.constants().map(|(nodes, element)| {
            let (q, v) = (beam.ends(nodes, &state.displacement), beam.ends(nodes, &state.velocity));
            (nodes, momentum(element, &q, &v))
        })
    }

    /// Gravity load \[m/s^2\] on the masses lumped at the nodes, rigid bodies included: `[nodes][F_x, F_y, M]`.
    pub fn gravity_load(&self, gravity: [f64; 2]) -> Vec<[f64; 3]> {
        let weight = |mass: &[f64; 3]| [mass[0] * gravity[0], mass[1] * gravity[1], 0.0];
        match self.rule.lumped_mass() {
            Some(mass) => mass.nodal.iter().map(weight).collect(),
            None => nodal_masses(self.beam()).iter().map(weight).collect(),
        }
    }

    /// Force of the supports on the model, `[nodes][F_x, F_y, M]` \[N, N, N m\], inertia and damping included.
    pub fn reactions(&self, state: &State, load: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let unbalanced = self.model.unbalanced_forces(self.rule.lumped_mass(), state, load);
        let System { supports, equations, .. } = &self.model.system;
        let residual = unbalanced.iter().map(|force| force.map(|force| -force)).collect();
        let arms = equations.links.arms_at(&state.displacement);
        reactions(supports, (&equations.links, &arms), &state.displacement, residual)
    }

    /// Section forces at the ends of the elements: of element e at 2e (first node) and 2e + 1.
    ///
    /// From the deformation alone: inertia and load q along an element would add q L^2/12 to the moment and q L/2 to
    /// the shear force at the ends of an element of length L. [`SectionForces::fibre_stress`] gives stresses.
    pub fn section_forces(&self, state: &State) -> Vec<SectionForces> {
        self.model.system.section_forces(&state.displacement, &state.plastic_curvature, None).into_flattened()
    }

    /// Strain of the outer fibres at the ends of the elements \[-\], plastic strain included: right-hand side, left-hand
    /// side; of element e at 2e (first node) and 2e + 1. Small strains: N/(EA) +- kappa h/2.
    pub fn fibre_strains(&self, state: &State) -> Vec<[f64; 2]> {
        self.model.system.fibre_strains(&state.displacement, &state.plastic_curvature)
    }

    /// Deformed length of each element \[m\], and the unit vector along its chord \[-\].
    pub fn chords(&self, state: &State) -> Vec<(f64, [f64; 2])> {
        let chords = self.model.system.chords(&state.displacement);
        chords.into_iter().map(|chord| (chord.length, chord.direction)).collect()
    }
}

/// Ok if a model has no feature that only the trapezoidal rule supports.
fn require_plain(system: &System, analysis: &'static str) -> Result<(), Error> {
    let (beam, supports) = (&system.beam, &system.supports);
    let body = beam.rigid_bodies().first().map(|&node| ("rigid bodies", "node", node));
    let joint = supports.breakables.first().map(|&(node, _)| ("rupture", "node", node));
    let plastic = beam.first_plastic_element().map(|element| ("plasticity", "element", element));
    match body.or(joint).or(plastic) {
        None => Ok(()),
        Some((feature, item, index)) => {
            let instead = "Integration::Trapezoidal";
            Err(Error::Unsupported { analysis, feature, item, index, instead })
        }
    }
}

/// The system of the trapezoidal rule, with lumped masses concentrated at the bodies.
fn with_concentrated_mass(beam: Beam, supports: Supports) -> Result<(System, LumpedMass), Error> {
    let (beam, nodal) = concentrate_at_bodies(beam, &supports)?;
    let system = System::new(beam, supports)?;
    let mass = mass_with_bodies(&system, nodal);
    Ok((system, mass))
}
