//! From what a flexible body is made of to its finite elements.

use structure_fe::{Beam, Damping, Dof, Dynamics, Integration, State, SupportMotion, Supports};

use crate::bodies::beam_surface::BeamSurface;
use crate::bodies::body::BodyError;
use crate::bodies::flexible::panel::{Panel, PanelSpec};
use crate::bodies::flexible::surface_map::{Carriage, Carrier};
use crate::bodies::prescribed::Law;
use crate::bodies::rigid_motion::{Rigid, rotate};
use crate::geometry::outline::Outline;
use crate::geometry::polyline::Course;

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
    pub start: Rigid,
    /// Gravity [m/s²].
    pub gravity: [f64; 2],
    /// Damping of the panels.
    pub damping: Damping,
    /// Simulate the half x > 0 of a symmetric body; panels are then on that half, masses of the whole.
    pub half: bool,
}

/// The rigid part of a flexible body.
pub enum Frame {
    /// Moves as told.
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

/// What a step's vibrations that it cannot resolve are left [-] (THEORY S21): these steps are the fluid's, far shorter than
/// the panels' periods.
const SPECTRAL_RADIUS: f64 = 0.8;

/// The finite elements of a flexible body, and what lies where on them.
pub(crate) struct Model {
    pub dynamics: Dynamics,
    pub carriage: Carriage,
    pub panels: Vec<Panel>,
    /// The line that the panels lie along [m, body's frame].
    pub line: Course,
    /// The start: of the body's frame, whose places `start.point` puts in the tank's.
    pub start: Rigid,
    /// Structure that is simulated, over the whole [-].
    pub share: f64,
}

impl Model {
    /// Assemble the elements.
    pub fn new(spec: &FlexibleSpec) -> Result<(Model, State), BodyError> {
        let wrong = |error: structure_fe::Error| BodyError::structure(&spec.name, &error);
        let line = match &spec.middle {
            Some(middle) => Course::open(middle.clone()),
            None => Course::closed(&spec.outline.loops()[0]),
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
            panel.hold(frame, &mut supports);
        }
        let rule = Integration::Trapezoidal { spectral_radius: SPECTRAL_RADIUS };
        let dynamics = Dynamics::new(beam, supports, rule, spec.damping).map_err(wrong)?;
        let mut state = dynamics.at_rest();
        let Rigid { pole, velocity, spin, .. } = spec.start;
        dynamics.set_rigid_velocity(&mut state, pole, velocity, spin);
        let pole = dynamics.beam().nodes()[frame];
        let surface = BeamSurface::new(dynamics.beam().nodes().to_vec(), ends);
        let carriage = Carriage { surface, frame, pole };
        Ok((Model { dynamics, carriage, panels, line, start: spec.start, share }, state))
    }

    /// The frame's node is where the model has it: elsewhere, once a panel has broken off a free frame.
    pub fn settle(&mut self) {
        self.carriage.pole = self.dynamics.beam().nodes()[self.carriage.frame];
    }

    /// What carries a place of the surface [m] with its normal [-], in the body's frame; a place below the surface goes with
    /// its foot on the surface.
    pub fn carrier(&self, foot: [f64; 2], at: [f64; 2], normal: [f64; 2]) -> Carrier {
        let (s, _) = self.line.nearest(foot);
        let (at, normal) = (self.start.point(at), rotate(normal, self.start.angle));
        match self.panels.iter().find(|panel| self.line.between(s, panel.reach)) {
            Some(panel) => Carrier::Beam(self.carriage.surface.perch_among(panel.elements.clone(), at, normal)),
            None => self.carriage.on_frame(at, normal),
        }
    }

    /// What carries an open line [m, body's frame], with places between its points that show the panels' bending.
    pub fn divided(&self, line: &[[f64; 2]]) -> Vec<Carrier> {
        let course = Course::open(line.to_vec());
        let lengths = self.panels.iter().flat_map(|p| p.elements.clone()).map(|e| self.carriage.surface.length(e));
        let step = lengths.fold(course.length(), f64::min);
        let mut stops: Vec<f64> = line.iter().map(|p| course.nearest(*p).0).collect();
        let parts = (course.length() / step).ceil() as usize;
        stops.extend((0..=parts).map(|k| course.length() * k as f64 / parts as f64));
        stops.sort_by(f64::total_cmp);
        stops.dedup_by(|a, b| (*a - *b).abs() < 1e-6 * course.length());
        stops.iter().map(|s| course.at(*s)).map(|at| self.carrier(at, at, [0.0; 2])).collect()
    }

    /// Motion of the body's frame, its origin for a pole.
    pub fn frame(&self, state: &State) -> Rigid {
        let node = self.carriage.frame;
        let ([x, y, turn], [u, v, spin], [ax, ay, spin_rate]) =
            (state.displacement[node], state.velocity[node], state.acceleration[node]);
        let pole = [self.carriage.pole[0] + x, self.carriage.pole[1] + y];
        let about_node = Rigid { pole, angle: turn, velocity: [u, v], spin, acceleration: [ax, ay], spin_rate };
        let arm = [0, 1].map(|k| self.start.pole[k] - self.carriage.pole[k]);
        Rigid {
            pole: about_node.point(arm),
            angle: self.start.angle + turn,
            velocity: about_node.point_velocity(arm),
            acceleration: about_node.point_acceleration(arm),
            ..about_node
        }
    }

    /// Motion of the frame's node where the body's frame moves as told: displacement, velocity, acceleration.
    pub fn node_of(&self, told: &Rigid) -> [[f64; 3]; 3] {
        let r = [0, 1].map(|k| self.carriage.pole[k] - self.start.pole[k]);
        let arm = rotate(r, -self.start.angle);
        let ([x, y], v, a) = (told.point(arm), told.point_velocity(arm), told.point_acceleration(arm));
        [
            [x - self.carriage.pole[0], y - self.carriage.pole[1], told.angle - self.start.angle],
            [v[0], v[1], told.spin],
            [a[0], a[1], told.spin_rate],
        ]
    }

    /// Tell the frame's node how to move.
    pub fn prescribe(&mut self, told: &Rigid) -> Result<(), structure_fe::Error> {
        let [displacement, velocity, acceleration] = self.node_of(told);
        for (k, dof) in [Dof::U, Dof::W, Dof::Theta].into_iter().enumerate() {
            let motion =
                SupportMotion { displacement: displacement[k], velocity: velocity[k], acceleration: acceleration[k] };
            self.dynamics.prescribe(self.carriage.frame, dof, motion)?;
        }
        Ok(())
    }
}
