//! The solver for motion in time: an integration rule applied to a model; ruptures at the end of a step (THEORY BE26).

use super::generalised_alpha::GeneralisedAlpha;
use super::lumped_mass::{LumpedMass, concentrate_at_bodies, explicit_mass, mass_with_bodies, nodal_masses};
use super::moving_model::MovingModel;
use super::trapezoidal::Trapezoidal;
use super::{Integration, State, StepReport, SupportMotion};
use crate::assembly::{Fibres, System, reactions};
use crate::element::{Damping, Ends, SectionForces, momentum, rotated};
use crate::error::{Error, above_zero, not_negative, require};
use crate::field::{Dof, combine, sum};
use crate::model::{Beam, Break, Rupture, Supports, add_ends};

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

    /// Prescribes the motion of a fixed degree of freedom at the end of the following steps, until it is prescribed again.
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
            Rule::CentralDifference(mass) => central_difference(mass, model, state, load, dt)?,
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
        let breaks = exceeded(&self.model.system, state);
        if !breaks.is_empty() {
            let places = self.beam().nodes().to_vec();
            state.ruptures.extend(breaks);
            self.apply_ruptures(state)?;
            move_bodies(self.beam(), &places, state);
        }
        Ok(())
    }

    /// Rebuilds the equations for the ruptures of a state. Steps, and all methods that change a state, do so themselves;
    /// a caller that restores a state from before a rupture calls it before it reads momenta, energies or reactions.
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

    /// Elastic energy of beams, springs and connectors \[J\].
    pub fn strain_energy(&self, state: &State) -> f64 {
        self.model.system.strain_energy(&state.displacement, &state.plastic)
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
    /// the shear force at the ends of an element of length L. [`SectionForces::fibre_stress`] gives stresses of elastic elements. The
    /// moments of an element that has yielded are those at its Gauss points, L/2 (1 - 1/sqrt(3)) from its ends.
    pub fn section_forces(&self, state: &State) -> Vec<SectionForces> {
        self.model.system.section_forces(&state.displacement, &state.plastic, None).into_flattened()
    }

    /// Strains and stresses of the outer fibres at the ends of the elements: of element e at 2e (first node) and 2e + 1.
    ///
    /// Elastic: N/(EA) -+ eta kappa and [`SectionForces::fibre_stress`]. In an element that has yielded the strain of the axis and the
    /// curvature at the end, and the stress that the material has at this strain (THEORY BE25).
    pub fn fibres(&self, state: &State) -> Vec<Fibres> {
        self.model.system.fibres(&state.displacement, &state.plastic)
    }

    /// Plastic curvatures at the two Gauss points of each element \[1/m\]; empty for an elastic model.
    pub fn plastic_curvatures(&self, state: &State) -> Vec<[f64; 2]> {
        self.model.system.plastic_curvatures(&state.plastic)
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

/// Central differences, the explicit step: v_half = v + a dt/2, u' = u + v_half dt, M a' = load - f(u', v_half),
/// v' = v_half + a' dt/2 (THEORY BE18).
///
/// A motion that is not finite is an error: the step was too long.
fn central_difference(
    mass: &LumpedMass,
    model: &mut MovingModel,
    state: &State,
    load: &[[f64; 3]],
    dt: f64,
) -> Result<(State, StepReport), Error> {
    let mut new = state.clone();
    let fields = new.displacement.as_flattened_mut().iter_mut().zip(new.velocity.as_flattened_mut());
    for ((u, v), a) in fields.zip(state.acceleration.as_flattened()) {
        *v += 0.5 * dt * a;
        *u += dt * *v;
    }
    model.move_supports(&mut new);
    let accelerations = mass.accelerations(&model.residual_at_prescribed_acceleration(mass, &mut new, load));
    new.acceleration = model.system.equations.extend(|equation| accelerations[equation]);
    for (v, a) in new.velocity.as_flattened_mut().iter_mut().zip(new.acceleration.as_flattened()) {
        *v += 0.5 * dt * a;
    }
    model.move_supports(&mut new);
    if let Some(equation) = accelerations.iter().position(|a| !a.is_finite()) {
        let (node, dof) = model.system.equations.place(equation);
        let residual = accelerations[equation];
        return Err(Error::StepNotConverged { time: state.time, dt, iteration: 0, residual, node, dof });
    }
    new.integrated_acceleration.clone_from(&new.acceleration);
    new.time = state.time + dt;
    Ok((new, StepReport { last_correction: 0.0, ..StepReport::new() }))
}

/// The joints of a state that exceed their limits, in the order in which they were declared.
fn exceeded(system: &System, state: &State) -> Vec<Break> {
    let joints = &system.supports.breakables;
    let fibres = if joints.iter().any(|(_, rupture)| matches!(rupture, Rupture::FibreStrain(_))) {
        system.fibres(&state.displacement, &state.plastic)
    } else {
        Vec::new()
    };
    let mut breaks = Vec::new();
    for &(node, rupture) in joints {
        let (value, limit) = match rupture {
            Rupture::FibreStrain(limit) => (strain_at(system, node, &fibres), limit),
            Rupture::Rotation(limit) => (rotation_of(system, node, state), limit),
        };
        if value > limit {
            let (at, moved) = (system.beam.nodes()[node], state.displacement[node]);
            let place = [at[0] + moved[0], at[1] + moved[1]];
            breaks.push(Break { node, time: state.time, place, value });
        }
    }
    breaks
}

/// Changes the motion of bodies from that of their nodes at `from` to that of their nodes in `beam`.
fn move_bodies(beam: &Beam, from: &[[f64; 2]], state: &mut State) {
    for &body in beam.rigid_bodies() {
        let to = beam.nodes()[body];
        let [x, y] = [0, 1].map(|axis| to[axis] - from[body][axis]);
        let (q, v, a) = (state.displacement[body], state.velocity[body], state.acceleration[body]);
        let arm = rotated([x, y], q[2]);
        state.displacement[body] = [q[0] + arm[0] - x, q[1] + arm[1] - y, q[2]];
        state.velocity[body] = [v[0] - v[2] * arm[1], v[1] + v[2] * arm[0], v[2]];
        let centripetal = v[2] * v[2];
        state.acceleration[body] =
            [a[0] - a[2] * arm[1] - centripetal * arm[0], a[1] + a[2] * arm[0] - centripetal * arm[1], a[2]];
    }
}

/// The largest strain of an outer fibre at the ends of elements at a node \[-\].
fn strain_at(system: &System, node: usize, fibres: &[Fibres]) -> f64 {
    let ends = system.beam.elements().iter().flat_map(|element| element.nodes);
    let here = ends.zip(fibres).filter(|(end, _)| *end == node);
    here.flat_map(|(_, fibres)| fibres.strain).fold(0.0, |most: f64, strain| most.max(strain.abs()))
}

/// Rotation of a node relative to the partner of its hinge, or the body of its link \[rad\].
fn rotation_of(system: &System, node: usize, state: &State) -> f64 {
    let hinges = system.supports.hinges.iter().copied();
    let links = system.supports.links.iter().map(|&(body, node, _)| [node, body]);
    let joints = hinges.flat_map(|[a, b]| [[a, b], [b, a]]).chain(links);
    let partner = joints.into_iter().find(|joint| joint[0] == node);
    let relative_to = partner.map_or(0.0, |[_, other]| state.displacement[other][2]);
    (state.displacement[node][2] - relative_to).abs()
}
