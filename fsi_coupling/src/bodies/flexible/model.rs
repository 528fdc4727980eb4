//! From what a flexible body is made of to its finite elements.

use structure_fe::{Beam, Damping, Dof, Dynamics, Integration, State, SupportMotion, Supports};

use crate::bodies::bending::beam_surface::BeamSurface;
use crate::bodies::bending::bending_surface::BendingSurface;
use crate::bodies::bending::frame::Frame;
use crate::bodies::bending::surface_layout::{Span, SurfaceLayout};
use crate::bodies::bending::surface_map::SurfaceMap;
use crate::bodies::error::BodyError;
use crate::bodies::flexible::panel::{Panel, PanelSpec};
use crate::bodies::rigid_motion::RigidMotion;
use crate::geometry::outline::Outline;
use crate::geometry::polyline::Polyline;
use crate::geometry::vector::rotate;

/// A flexible body to be built; everything per metre of span, in the body's own frame.
pub struct FlexibleSpec {
    /// Name, as in output columns.
    pub name: String,
    /// Outline [m].
    pub outline: Outline,
    /// Middle line of a body that is a thin wall [m]; its panels lie along it. Without one they lie along the outline.
    pub middle: Option<Vec<[f64; 2]>>,
    /// The parts that bend.
    pub panels: Vec<PanelSpec>,
    /// What holds them.
    pub frame: Frame,
    /// Motion of the frame's origin at the start.
    pub start: RigidMotion,
    /// Gravity [m/s²].
    pub gravity: [f64; 2],
    /// Damping of the panels.
    pub damping: Damping,
    /// Simulate the half x > 0 of a symmetric body; panels are then on that half, masses of the whole.
    pub half: bool,
}

/// Spectral radius of the time integration at high frequency [-] (THEORY BE20). Steps are the fluid's, much shorter than the panels'
/// periods.
const SPECTRAL_RADIUS: f64 = 0.8;

/// The finite elements of a flexible body, and what lies where on them.
pub(crate) struct Model {
    pub dynamics: Dynamics,
    pub surface: BendingSurface,
    pub panels: Vec<Panel>,
    /// Structure that is simulated, over the whole [-].
    pub share: f64,
}

impl Model {
    /// Assemble the elements.
    pub fn new(spec: &FlexibleSpec) -> Result<(Model, State), BodyError> {
        let wrong = |error: structure_fe::Error| BodyError::structure(&spec.name, &error);
        let line = match &spec.middle {
            Some(middle) => Polyline::open(middle.clone()),
            None => Polyline::closed(&spec.outline.loops()[0]),
        };
        let (mut nodes, mut elements, mut supports) = (Vec::new(), Vec::new(), Supports::default());
        let panels: Vec<Panel> =
            spec.panels.iter().map(|panel| Panel::along(&line, panel, &mut nodes, &mut elements)).collect();
        let ends: Vec<[usize; 2]> = elements.iter().map(|element| element.nodes).collect();
        for node in &mut nodes {
            *node = spec.start.point(*node);
        }
        let mut beam = Beam::new(nodes.clone(), elements).map_err(wrong)?;
        for panel in &panels {
            beam = panel.formulate(beam).map_err(wrong)?;
        }
        let share = if spec.half { 0.5 } else { 1.0 };
        let (at, mass, inertia, free) = match &spec.frame {
            Frame::Given(_) => ([0.0; 2], 0.0, 0.0, [false; 3]),
            Frame::Free { mass, inertia, center_of_mass, free } => (*center_of_mass, *mass, *inertia, *free),
        };
        let (beam, frame) = beam.with_rigid_body(spec.start.point(at), share * mass, share * inertia).map_err(wrong)?;
        for (dof, free) in [Dof::U, Dof::W, Dof::Theta].into_iter().zip(free) {
            if !free {
                supports.fix(frame, dof);
            }
        }
        for panel in &panels {
            panel.hold(frame, &beam, &mut supports);
        }
        let rule = Integration::Trapezoidal { spectral_radius: SPECTRAL_RADIUS };
        let dynamics = Dynamics::new(beam, supports, rule, spec.damping).map_err(wrong)?;
        let mut state = dynamics.at_rest();
        let RigidMotion { position, velocity, angular_velocity, .. } = spec.start;
        dynamics.set_rigid_velocity(&mut state, position, velocity, angular_velocity);
        let reference = dynamics.beam().nodes()[frame];
        let surface = BeamSurface::new(dynamics.beam().nodes().to_vec(), ends);
        let map = SurfaceMap { surface, frame, reference };
        let span = |panel: &Panel| Span { reach: panel.reach, elements: panel.elements.clone() };
        let layout = SurfaceLayout { map, line, spans: panels.iter().map(span).collect(), start: spec.start };
        let surface = BendingSurface::new(layout, spec.outline.clone(), spec.half);
        Ok((Model { dynamics, surface, panels, share }, state))
    }

    /// Update the position of the frame's node: it moves when a panel breaks off a free frame.
    pub fn update_reference(&mut self) {
        let map = &mut self.surface.layout.map;
        map.reference = self.dynamics.beam().nodes()[map.frame];
    }

    /// Motion of the body's frame, about its origin.
    pub fn frame(&self, state: &State) -> RigidMotion {
        self.surface.layout.frame(&state.displacement, &state.velocity, &state.acceleration)
    }

    /// Motion of the frame's node where the body's frame moves as prescribed: displacement, velocity, acceleration.
    pub fn node_of(&self, prescribed: &RigidMotion) -> [[f64; 3]; 3] {
        let SurfaceLayout { map: SurfaceMap { reference, .. }, start, .. } = &self.surface.layout;
        let r = [0, 1].map(|k| reference[k] - start.position[k]);
        let lever_arm = rotate(r, -start.angle);
        let ([x, y], v, a) = (
            prescribed.point(lever_arm),
            prescribed.point_velocity(lever_arm),
            prescribed.point_acceleration(lever_arm),
        );
        [
            [x - reference[0], y - reference[1], prescribed.angle - start.angle],
            [v[0], v[1], prescribed.angular_velocity],
            [a[0], a[1], prescribed.angular_acceleration],
        ]
    }

    /// Prescribe the motion of the frame's node.
    pub fn prescribe(&mut self, prescribed: &RigidMotion) -> Result<(), structure_fe::Error> {
        let [displacement, velocity, acceleration] = self.node_of(prescribed);
        for (k, dof) in [Dof::U, Dof::W, Dof::Theta].into_iter().enumerate() {
            let motion =
                SupportMotion { displacement: displacement[k], velocity: velocity[k], acceleration: acceleration[k] };
            self.dynamics.prescribe(self.surface.layout.map.frame, dof, motion)?;
        }
        Ok(())
    }
}
