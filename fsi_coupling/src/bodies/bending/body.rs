//! A rigid frame with a structure that bends: transfer, contact and output, whatever the equations of the structure.

use std::fmt::Display;

use sph_core::state_bytes::{StateError, decode, encode};
use sph_core::walls::Resultant;
use sph_core::{InterfaceDynamics, PlateMidline, WallForces, WallPoint, WallsMut};
use structure_fe::{Break, Error};

use crate::bodies::bending::bending_surface::{BendingSurface, NodalMotion};
use crate::bodies::bending::frame::Frame;
use crate::bodies::bending::model::{BendingModel, StateOf};
use crate::bodies::body::{Contact, Inspect, Linked, WettedBody};
use crate::bodies::error::BodyError;
use crate::bodies::modes_state::ModesState;
use crate::bodies::panel_state::PanelState;
use crate::bodies::prescribed::Law;
use crate::bodies::rigid_motion::RigidMotion;
use crate::bodies::state::{ContactImpulse, Energy, Momentum, Motion, SurfacePoint};
use crate::geometry::outline::Outline;
use crate::geometry::rows::WallRows;

/// A rigid frame with a structure that bends. The load of a step is the mean force of the fluid, mapped to the nodes by the transpose of
/// the map that places the boundary particles; the structure's step changes momentum by exactly that (THEORY BE20, BE29).
pub struct BendingBody<M: BendingModel> {
    name: String,
    pub(crate) model: M,
    surface: BendingSurface,
    law: Option<Law>,
    pub(crate) state: StateOf<M>,
    checkpoint: Option<(StateOf<M>, Outline)>,
    /// Longest step that resolves its vibration [s].
    longest_step: f64,
}

impl<M: BendingModel> BendingBody<M> {
    /// A model at the start.
    pub(crate) fn at_start(
        (name, frame): (String, Frame),
        (model, surface): (M, BendingSurface),
        state: StateOf<M>,
    ) -> BendingBody<M> {
        let law = match frame {
            Frame::Given(law) => Some(law),
            Frame::Free { .. } => None,
        };
        BendingBody { name, model, surface, law, state, checkpoint: None, longest_step: f64::INFINITY }
    }

    /// The same, with a clock that starts at `time` [s]: the law of its frame begins then.
    pub fn starting_at(mut self, time: f64) -> BendingBody<M> {
        self.law = self.law.map(|law| -> Law { Box::new(move |t| law(t - time)) });
        *M::time(&mut self.state.motion) = time;
        self
    }

    /// The same, with steps of at most `dt` [s] (THEORY CO33).
    pub fn with_longest_step(self, dt: f64) -> BendingBody<M> {
        BendingBody { longest_step: dt, ..self }
    }

    fn nodes_now(&self) -> NodalMotion<'_> {
        M::nodes(&self.state.motion)
    }

    fn frame(&self) -> RigidMotion {
        self.surface.frame(self.nodes_now())
    }

    /// Prescribe what the law gives `ahead` [s] from now.
    fn follow_law(&mut self, ahead: f64) -> Result<(), Error> {
        let time = *M::time(&mut self.state.motion) + ahead;
        self.law.as_ref().map_or(Ok(()), |law| self.model.prescribe(&self.surface, &law(time)))
    }

    fn wrong(&self) -> impl Fn(Error) -> BodyError {
        |error| BodyError::structure(&self.name, &error)
    }

    /// Loads on the nodes of an impulse [N s/m] at a place of the surface in space [m].
    fn loads_of(&self, at: [f64; 2], impulse: [f64; 2]) -> Vec<[f64; 3]> {
        self.surface.loads_of(at, impulse, &self.frame(), self.nodes_now().displacement)
    }

    /// Sum over both halves where one is simulated: twice along y, nothing along x.
    fn both(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        if self.surface.half { [0.0, 2.0 * y] } else { [x, y] }
    }
}

impl<M: BendingModel> WettedBody for BendingBody<M> {
    fn sample(&mut self, rows: &WallRows) -> Result<Vec<WallPoint>, BodyError> {
        Ok(self.surface.sample(rows))
    }

    fn kinematics(&self, ahead: f64, out: WallsMut<'_>) -> Vec<PlateMidline> {
        let then = self.model.ahead(&self.state.motion, ahead);
        self.surface.kinematics(self.nodes_now(), &then, &self.state.predicted_positions, ahead, out)
    }

    fn interface(&mut self, ahead: f64) -> Result<Option<Box<dyn InterfaceDynamics>>, BodyError> {
        let interface = self.model.interface(&self.surface, &self.state.motion, ahead);
        interface.map(Some).map_err(self.wrong())
    }

    fn load(&mut self, force: WallForces<'_>) {
        let m = &mut self.state;
        m.mean.fill([0.0; 3]);
        m.now.fill([0.0; 3]);
        m.predicted_positions.clear();
        m.predicted_positions.extend(force.x.iter().zip(force.y).map(|(x, y)| [*x, *y]));
        m.force = self.surface.add_loads(&force, M::nodes(&m.motion).displacement, &mut m.mean, &mut m.now);
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        let stepped = self.follow_law(dt).and_then(|()| self.model.step(&mut self.state, dt));
        stepped.map_err(self.wrong())?;
        self.model.update(&mut self.surface);
        let (frame, m) = (self.frame(), &mut self.state);
        m.impulses.fill([0.0; 3]);
        m.impulse_velocities.fill([0.0; 3]);
        match self.surface.update_outline(&frame, M::nodes(&m.motion).displacement) {
            true => Ok(()),
            false => Err(BodyError::NotFinite { name: self.name.clone(), time: *M::time(&mut m.motion) }),
        }
    }

    fn stable_dt(&self) -> f64 {
        self.model.stable_dt().min(self.longest_step)
    }

    fn checkpoint(&mut self) {
        self.checkpoint = Some((self.state.clone(), self.surface.outline.clone()));
    }

    fn restore(&mut self) {
        if let Some((state, outline)) = &self.checkpoint {
            (self.state, self.surface.outline) = (state.clone(), outline.clone());
            // this cannot fail: the model had this state before
            let _ = self.model.resume(&self.state.motion);
            self.model.update(&mut self.surface);
        }
    }

    fn to_bytes(&self) -> Vec<u8> {
        encode(&(&self.state, self.surface.outline.loops()))
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        let (state, loops): (StateOf<M>, Vec<Vec<[f64; 2]>>) = decode(M::BODY, bytes)?;
        M::check(&state, &self.state)?;
        state.check(&self.state, self.surface.attachments.len())?;
        let wrong = |cause: &dyn Display| StateError::Unreadable(M::BODY, cause.to_string());
        self.surface.outline = Outline::deformed(loops).ok_or_else(|| wrong(&"its outline is not finite"))?;
        self.state = state;
        self.model.resume(&self.state.motion).map_err(|error| wrong(&error))?;
        self.model.update(&mut self.surface);
        self.follow_law(0.0).map_err(|error| wrong(&error))
    }
}

impl<M: BendingModel> Contact for BendingBody<M> {
    fn signed_distance(&self, at: [f64; 2]) -> f64 {
        self.surface.signed_distance(at, &self.frame())
    }

    fn surface(&self, at: [f64; 2]) -> SurfacePoint {
        let NodalMotion { displacement, velocity, .. } = self.nodes_now();
        let each = velocity.iter().zip(&self.state.impulse_velocities);
        let velocity: Vec<[f64; 3]> = each.map(|(v, s)| [0, 1, 2].map(|k| v[k] + s[k])).collect();
        self.surface.nearest(at, &self.frame(), displacement, &velocity)
    }

    fn inverse_effective_mass(&mut self, at: [f64; 2], normal: [f64; 2], dt: f64) -> f64 {
        self.state.dt = dt;
        let loads = self.loads_of(at, normal);
        self.model.response(&self.state.motion, &loads, dt).max(0.0)
    }

    /// The half that is simulated takes its own impulse; the mirror image acts on the other half.
    fn apply_impulse(&mut self, contact: &ContactImpulse) {
        let loads = self.loads_of(contact.at, contact.impulse);
        let m = &mut self.state;
        let velocities = self.model.velocities_under(&m.motion, &loads, m.dt);
        let sums = m.impulses.iter_mut().zip(&loads).chain(m.impulse_velocities.iter_mut().zip(&velocities));
        sums.for_each(|(sum, more)| (0..3).for_each(|k| sum[k] += more[k]));
    }
}

impl<M: BendingModel> Linked for BendingBody<M> {}

impl<M: BendingModel> Inspect for BendingBody<M> {
    fn name(&self) -> &str {
        &self.name
    }

    /// Motion of the rigid frame.
    fn motion(&self) -> Option<Motion> {
        let (frame, [fx, fy, about]) = (self.frame(), self.state.force);
        let force = self.both([fx, fy]);
        let moment = if self.surface.half { 0.0 } else { about };
        let moment = moment - frame.position[0] * force[1] + frame.position[1] * force[0];
        Some(Motion::new(&frame, Resultant { force, moment }))
    }

    fn outline(&self) -> Option<&Outline> {
        Some(&self.surface.outline)
    }

    fn panels(&self) -> Vec<PanelState> {
        self.model.panels(&self.surface, &self.state, &self.frame())
    }

    fn first_rupture(&self) -> Option<(&str, Break)> {
        self.model.first_rupture(&self.state.motion)
    }

    fn modes(&self) -> Option<ModesState> {
        self.model.modes(&self.state)
    }

    fn material_point(&self, at: [f64; 2]) -> Option<(SurfacePoint, [f64; 2])> {
        Some(self.surface.material_point(at, self.nodes_now()))
    }

    fn energy(&self) -> Energy {
        let whole = if self.surface.half { 2.0 } else { 1.0 };
        let [kinetic, potential, elastic] = self.model.energies(&self.state.motion).map(|energy| whole * energy);
        let [work, support, dissipated] =
            [self.state.work, self.state.support, self.state.dissipated].map(|energy| whole * energy);
        Energy { kinetic, potential, elastic, work, support, links: 0.0, dissipated }
    }

    fn momentum(&self) -> Momentum {
        let [px, py] = self.model.momentum(&self.state.motion);
        let impulse = |k: usize| self.state.impulses.iter().map(|node| node[k]).sum::<f64>();
        let momentum = self.both([px + impulse(0), py + impulse(1)]);
        Momentum { momentum, external: self.both(self.state.external) }
    }
}
