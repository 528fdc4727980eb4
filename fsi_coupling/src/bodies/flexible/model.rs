//! From what a flexible body is made of to its finite elements.

use structure_fe::{Beam, Damping, Dof, Dynamics, Error, Integration, State, SupportMotion, Supports};

use crate::bodies::bending::beam_surface::BeamSurface;
use crate::bodies::bending::bending_surface::BendingSurface;
use crate::bodies::bending::frame::Frame;
use crate::bodies::bending::surface_layout::{Span, SurfaceLayout, line_of};
use crate::bodies::bending::surface_map::SurfaceMap;
use crate::bodies::flexible::panel::{Panel, PanelSpec};
use crate::bodies::rigid_motion::RigidMotion;
use crate::geometry::outline::Outline;
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

/// The finite elements of a flexible body.
pub struct FlexibleModel {
    pub(crate) dynamics: Dynamics,
    pub(crate) panels: Vec<Panel>,
    /// What of the frame is free.
    pub(crate) free: [bool; 3],
    pub(crate) gravity: [f64; 2],
    /// Load of gravity on the nodes [N/m, N/m, N].
    pub(crate) weight: Vec<[f64; 3]>,
}

impl FlexibleModel {
    /// Assemble the elements and what lies where on them, at the start under their own weight.
    pub(crate) fn new(spec: &FlexibleSpec) -> Result<(FlexibleModel, BendingSurface, State), Error> {
        let line = line_of(&spec.outline, spec.middle.as_deref());
        let (mut nodes, mut elements, mut supports) = (Vec::new(), Vec::new(), Supports::default());
        let panels: Vec<Panel> =
            spec.panels.iter().map(|panel| Panel::along(&line, panel, &mut nodes, &mut elements)).collect();
        let ends: Vec<[usize; 2]> = elements.iter().map(|element| element.nodes).collect();
        for node in &mut nodes {
            *node = spec.start.point(*node);
        }
        let mut beam = Beam::new(nodes.clone(), elements)?;
        for panel in &panels {
            beam = panel.formulate(beam)?;
        }
        let share = if spec.half { 0.5 } else { 1.0 };
        let (mass, inertia, at, free) = spec.frame.rigid_part();
        let (beam, frame) = beam.with_rigid_body(spec.start.point(at), share * mass, share * inertia)?;
        for (dof, free) in [Dof::U, Dof::W, Dof::Theta].into_iter().zip(free) {
            if !free {
                supports.fix(frame, dof);
            }
        }
        for panel in &panels {
            panel.hold(frame, &beam, &mut supports);
        }
        let rule = Integration::Trapezoidal { spectral_radius: SPECTRAL_RADIUS };
        let dynamics = Dynamics::new(beam, supports, rule, spec.damping)?;
        let mut state = dynamics.at_rest();
        let RigidMotion { position, velocity, angular_velocity, .. } = spec.start;
        dynamics.set_rigid_velocity(&mut state, position, velocity, angular_velocity);
        let reference = dynamics.beam().nodes()[frame];
        let surface = BeamSurface::new(dynamics.beam().nodes().to_vec(), ends);
        let map = SurfaceMap { surface, frame, reference };
        let span = |panel: &Panel| Span { reach: panel.reach, elements: panel.elements.clone() };
        let layout = SurfaceLayout { map, line, spans: panels.iter().map(span).collect(), start: spec.start };
        let surface = BendingSurface::new(layout, spec.outline.clone(), spec.half);
        let (weight, gravity) = (dynamics.gravity_load(spec.gravity), spec.gravity);
        let mut model = FlexibleModel { dynamics, panels, free, gravity, weight };
        if let Some(start) = spec.frame.prescribed_start() {
            model.prescribe_node(&surface.layout, &start)?;
        }
        model.dynamics.equilibrate(&mut state, &model.weight)?;
        Ok((model, surface, state))
    }

    /// Motion of the frame's node where the body's frame moves as prescribed: displacement, velocity, acceleration.
    fn node_of(layout: &SurfaceLayout, prescribed: &RigidMotion) -> [[f64; 3]; 3] {
        let SurfaceLayout { map: SurfaceMap { reference, .. }, start, .. } = layout;
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
    pub(crate) fn prescribe_node(&mut self, layout: &SurfaceLayout, prescribed: &RigidMotion) -> Result<(), Error> {
        let [displacement, velocity, acceleration] = FlexibleModel::node_of(layout, prescribed);
        for (k, dof) in [Dof::U, Dof::W, Dof::Theta].into_iter().enumerate() {
            let motion =
                SupportMotion { displacement: displacement[k], velocity: velocity[k], acceleration: acceleration[k] };
            self.dynamics.prescribe(layout.map.frame, dof, motion)?;
        }
        Ok(())
    }
}
