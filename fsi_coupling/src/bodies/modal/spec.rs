//! What a body with modes is made of.

use std::sync::Arc;

use structure_fe::Error;
use structure_fe::modal::{Frame as ModalFrame, ModalStructure};

use crate::bodies::bending::beam_surface::BeamSurface;
use crate::bodies::bending::bending_surface::BendingSurface;
use crate::bodies::bending::frame::Frame;
use crate::bodies::bending::surface_layout::{Span, SurfaceLayout, line_of};
use crate::bodies::bending::surface_map::SurfaceMap;
use crate::bodies::bending::surface_mode::SurfaceMode;
use crate::bodies::rigid_motion::RigidMotion;
use crate::geometry::outline::Outline;

/// A body with modes, to be built; everything per metre of span, in the body's own frame.
pub struct ModalSpec {
    /// Name, as in output columns.
    pub name: String,
    /// Outline [m].
    pub outline: Outline,
    /// Middle line of a body that is a thin wall [m]; the nodes lie along it. Without one they lie along the outline.
    pub middle: Option<Vec<[f64; 2]>>,
    /// Nodes along that line, in its order [m]. Between the first and the last one the surface bends.
    pub nodes: Vec<[f64; 2]>,
    /// Masses that move with the nodes [kg/m].
    pub masses: Vec<f64>,
    /// The modes, with shapes at the nodes; at least one.
    pub modes: Vec<SurfaceMode>,
    /// The rigid rest.
    pub frame: Frame,
    /// Motion of the frame's origin at the start.
    pub start: RigidMotion,
    /// Gravity [m/s²].
    pub gravity: [f64; 2],
    /// Simulate the half x > 0 of a symmetric body; nodes, their masses and the generalised masses are then of that half, the
    /// frame's mass of the whole.
    pub half: bool,
}

/// The equations of a body with modes.
pub struct ModalModel {
    /// Shared with the interface of each step.
    pub(crate) structure: Arc<ModalStructure>,
    /// Places of the nodes at the start, the frame last: `[x, y, turn]` [m, m, rad].
    pub(crate) rest: Vec<[f64; 3]>,
    /// Stress of each mode at the nodes at unit amplitude [Pa/m].
    pub(crate) stress: Vec<Vec<f64>>,
    /// Gravity [m/s²].
    pub(crate) gravity: [f64; 2],
    /// Position, velocity and acceleration of a prescribed frame at the end of the next step.
    pub(crate) prescribed: Option<[[f64; 3]; 3]>,
}

impl ModalModel {
    pub(crate) fn new(spec: &ModalSpec) -> Result<(ModalModel, BendingSurface), Error> {
        let share = if spec.half { 0.5 } else { 1.0 };
        let (mass, inertia, center_of_mass, free) = spec.frame.rigid_part();
        let held = free.map(|free| !free);
        let frame = ModalFrame { mass: share * mass, inertia: share * inertia, center_of_mass, held };
        let modes = spec.modes.iter().map(|mode| mode.mode.clone()).collect();
        let structure = ModalStructure::new(frame, spec.nodes.clone(), spec.masses.clone(), modes)?;
        let RigidMotion { position, angle, .. } = spec.start;
        let rest = structure.places(&structure.at_rest(position, angle));
        let line = line_of(&spec.outline, spec.middle.as_deref());
        let last = spec.nodes.len() - 1;
        let reach = [spec.nodes[0], spec.nodes[last]].map(|end| line.nearest(end).0);
        let beams =
            BeamSurface::new(rest.iter().map(|[x, y, _]| [*x, *y]).collect(), (0..last).map(|k| [k, k + 1]).collect());
        let map = SurfaceMap { surface: beams, frame: last + 1, reference: position };
        let layout = SurfaceLayout { map, line, spans: vec![Span { reach, elements: 0..last }], start: spec.start };
        let surface = BendingSurface::new(layout, spec.outline.clone(), spec.half);
        let stress = spec.modes.iter().map(|mode| mode.stress.clone()).collect();
        let structure = Arc::new(structure);
        Ok((ModalModel { structure, rest, stress, gravity: spec.gravity, prescribed: None }, surface))
    }
}
