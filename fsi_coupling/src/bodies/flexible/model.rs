//! From what a flexible body is made of to its finite elements.

use structure_fe::{Beam, Damping, Dof, Dynamics, Integration, State, SupportMotion, Supports};

use crate::bodies::beam_surface::BeamSurface;
use crate::bodies::error::BodyError;
use crate::bodies::flexible::panel::{Panel, PanelSpec};
use crate::bodies::flexible::surface_map::{Attachment, SurfaceMap};
use crate::bodies::prescribed::Law;
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

/// The rigid part of a flexible body.
pub enum Frame {
    /// Prescribed motion.
    Given(Law),
    /// Moves under its loads.
    Free {
        /// Mass [kg/m].
        mass: f64,
        /// Moment of inertia about the centre of mass [kg m²/m].
        inertia: f64,
        /// Centre of mass [m].
        center_of_mass: [f64; 2],
        /// Which of x, y, angle are free; the others are held by a guide.
        free: [bool; 3],
    },
}

/// Spectral radius of the time integration at high frequency [-] (THEORY BE20). Steps are the fluid's, much shorter than the panels'
/// periods.
const SPECTRAL_RADIUS: f64 = 0.8;

/// The finite elements of a flexible body, and what lies where on them.
pub(crate) struct Model {
    pub dynamics: Dynamics,
    pub map: SurfaceMap,
    pub panels: Vec<Panel>,
    /// The line that the panels lie along [m, body's frame].
    pub line: Polyline,
    /// The start: of the body's frame, whose places `start.point` puts in the tank's.
    pub start: RigidMotion,
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
        Ok((Model { dynamics, map, panels, line, start: spec.start, share }, state))
    }

    /// Update the position of the frame's node: it moves when a panel breaks off a free frame.
    pub fn update_reference(&mut self) {
        self.map.reference = self.dynamics.beam().nodes()[self.map.frame];
    }

    /// Attachment of a point [m] with its normal [-], in the body's frame; a point below the surface moves with its foot on the
    /// surface.
    pub fn attachment(&self, foot: [f64; 2], at: [f64; 2], normal: [f64; 2]) -> Attachment {
        let (s, _) = self.line.nearest(foot);
        let (at, normal) = (self.start.point(at), rotate(normal, self.start.angle));
        match self.panels.iter().find(|panel| self.line.between(s, panel.reach)) {
            Some(panel) => Attachment::Beam(self.map.surface.attach_among(panel.elements.clone(), at, normal)),
            None => self.map.on_frame(at, normal),
        }
    }

    /// Attachments of an open line [m, body's frame], with additional points that show the panels' bending.
    pub fn divided(&self, line: &[[f64; 2]]) -> Vec<Attachment> {
        let polyline = Polyline::open(line.to_vec());
        let lengths = self.panels.iter().flat_map(|p| p.elements.clone()).map(|e| self.map.surface.length(e));
        let step = lengths.fold(polyline.length(), f64::min);
        let mut stops: Vec<f64> = line.iter().map(|p| polyline.nearest(*p).0).collect();
        let parts = (polyline.length() / step).ceil() as usize;
        stops.extend((0..=parts).map(|k| polyline.length() * k as f64 / parts as f64));
        stops.sort_by(f64::total_cmp);
        stops.dedup_by(|a, b| (*a - *b).abs() < 1e-6 * polyline.length());
        stops.iter().map(|s| polyline.at(*s)).map(|at| self.attachment(at, at, [0.0; 2])).collect()
    }

    /// Motion of the body's frame, about its origin.
    pub fn frame(&self, state: &State) -> RigidMotion {
        let node = self.map.frame;
        let ([x, y, turn], [u, v, angular_velocity], [ax, ay, angular_acceleration]) =
            (state.displacement[node], state.velocity[node], state.acceleration[node]);
        let position = [self.map.reference[0] + x, self.map.reference[1] + y];
        let about_node = RigidMotion {
            position,
            angle: turn,
            velocity: [u, v],
            angular_velocity,
            acceleration: [ax, ay],
            angular_acceleration,
        };
        let lever_arm = [0, 1].map(|k| self.start.position[k] - self.map.reference[k]);
        RigidMotion {
            position: about_node.point(lever_arm),
            angle: self.start.angle + turn,
            velocity: about_node.point_velocity(lever_arm),
            acceleration: about_node.point_acceleration(lever_arm),
            ..about_node
        }
    }

    /// Motion of the frame's node where the body's frame moves as prescribed: displacement, velocity, acceleration.
    pub fn node_of(&self, prescribed: &RigidMotion) -> [[f64; 3]; 3] {
        let r = [0, 1].map(|k| self.map.reference[k] - self.start.position[k]);
        let lever_arm = rotate(r, -self.start.angle);
        let ([x, y], v, a) = (
            prescribed.point(lever_arm),
            prescribed.point_velocity(lever_arm),
            prescribed.point_acceleration(lever_arm),
        );
        [
            [x - self.map.reference[0], y - self.map.reference[1], prescribed.angle - self.start.angle],
            [v[0], v[1], prescribed.angular_velocity],
            [a[0], a[1], prescribed.angular_acceleration],
        ]
    }

    /// Tell the frame's node how to move.
    pub fn prescribe(&mut self, prescribed: &RigidMotion) -> Result<(), structure_fe::Error> {
        let [displacement, velocity, acceleration] = self.node_of(prescribed);
        for (k, dof) in [Dof::U, Dof::W, Dof::Theta].into_iter().enumerate() {
            let motion =
                SupportMotion { displacement: displacement[k], velocity: velocity[k], acceleration: acceleration[k] };
            self.dynamics.prescribe(self.map.frame, dof, motion)?;
        }
        Ok(())
    }
}
