//! Joints: hinges, sliders and springs between two bodies (THEORY CO38).

use serde::{Deserialize, Serialize};

use sph_core::walls::Resultant;

use super::rows::Direction;
use crate::bodies::state::Solid;
use crate::geometry::vector::{dot, rotate, sub};

/// A joint to be built; everything per metre of span.
#[derive(Clone, Debug, PartialEq)]
pub struct JointSpec {
    /// Name, as in output columns.
    pub name: String,
    /// Indices of the bodies a and b among all bodies.
    pub bodies: [usize; 2],
    /// Place at the start [m].
    pub at: [f64; 2],
    /// What it holds.
    pub kind: JointKind,
    /// Stiffness along the coordinate that it leaves free, which is at rest at the start [N/m² or N/rad].
    pub stiffness: f64,
    /// Damping along it [N s/m² or N s/rad].
    pub damping: f64,
    /// Force at which it breaks, a mean over one step [N/m].
    pub breaks_at: Option<f64>,
}

/// Kinds of joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// Both bodies keep one point in common; free: the angle between them [rad].
    Hinge,
    /// Body b slides along an axis (unit vector at the start [-]) that is fixed in body a and does not turn against it; free: the
    /// distance along the axis [m].
    Slider {
        /// The axis.
        axis: [f64; 2],
    },
    /// Nothing is held; a force acts along the line from the joint's place in body a to the point `to` [m] of body b; free: the distance
    /// between both [m].
    Spring {
        /// The other end at the start.
        to: [f64; 2],
    },
}

impl JointSpec {
    /// CO38: the longest step [s] between solids a and b at the start; infinite without spring and damper.
    pub fn longest_step(&self, solids: [Solid; 2]) -> f64 {
        Joint::new(JointSpec { bodies: [0, 1], ..self.clone() }, &solids).stable_dt(&solids)
    }
}

/// State of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointState {
    /// Its name.
    pub name: String,
    /// The free coordinate, less its value at the start [rad or m].
    pub value: f64,
    /// Mean force on body b over the last step [N/m].
    pub force: [f64; 2],
    /// Largest magnitude of it so far [N/m].
    pub largest: f64,
    /// Time at which it broke [s].
    pub broken: Option<f64>,
}

/// A joint between two solids: its points in their frames.
#[derive(Clone, Debug)]
pub(super) struct Joint {
    pub spec: JointSpec,
    /// The joint's place in the frames of a and b, about their reference points [m].
    anchors: [[f64; 2]; 2],
    /// A slider's axis in the frame of a [-].
    axis: [f64; 2],
    /// Angle of b less that of a, and free coordinate at the start.
    angle: f64,
    rest: f64,
    pub memory: Memory,
}

/// What a joint keeps from step to step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(in crate::coupling) struct Memory {
    /// Forces of spring and damper that act now, on a and b; at the end of a step, the sum of those at its ends.
    pub spring: [Resultant; 2],
    /// Reactions that act now, on a and b.
    pub reaction: [Resultant; 2],
    /// Mean force on b over the last step [N/m].
    pub force: [f64; 2],
    /// Largest magnitude of it so far [N/m].
    pub largest: f64,
    /// The free coordinate, less its value at the start.
    pub value: f64,
    /// Time at which it broke [s].
    pub broken: Option<f64>,
}

/// A direction that a joint holds.
pub(super) struct Constraint {
    pub direction: Direction,
    /// How far it is from where it is held [m or rad].
    pub error: f64,
    /// Acceleration along the direction that the motion causes in addition to the solids' accelerations [m/s²].
    pub apparent: f64,
}

impl Joint {
    pub fn new(spec: JointSpec, solids: &[Solid]) -> Joint {
        let [a, b] = spec.bodies;
        let far = if let JointKind::Spring { to } = spec.kind { to } else { spec.at };
        let anchors = [solids[a].motion.local(spec.at), solids[b].motion.local(far)];
        let angle = solids[b].motion.angle - solids[a].motion.angle;
        let axis = if let JointKind::Slider { axis } = spec.kind { axis } else { [0.0; 2] };
        let axis = rotate(axis, -solids[a].motion.angle);
        let mut joint = Joint { spec, anchors, axis, angle, rest: 0.0, memory: Memory::default() };
        joint.rest = joint.coordinate(solids).1;
        joint
    }

    pub fn state(&self) -> JointState {
        let Memory { value, force, largest, broken, .. } = self.memory;
        JointState { name: self.spec.name.clone(), value, force, largest, broken }
    }

    pub fn holds(&self) -> bool {
        self.memory.broken.is_none()
    }

    /// How many directions it holds.
    pub fn held(&self) -> usize {
        if let JointKind::Spring { .. } = self.spec.kind { 0 } else { 2 }
    }

    /// The joint's place as a and as b have it [m].
    fn places(&self, all: &[Solid]) -> [[f64; 2]; 2] {
        [0, 1].map(|side| all[self.spec.bodies[side]].motion.point(self.anchors[side]))
    }

    /// A slider's axis now [-].
    fn axis(&self, all: &[Solid]) -> [f64; 2] {
        rotate(self.axis, all[self.spec.bodies[0]].motion.angle)
    }

    /// CO38: what it holds.
    pub fn constraints(&self, all: &[Solid]) -> Vec<Constraint> {
        let (solids, [p, q]) = (self.spec.bodies, self.places(all));
        let [a, b] = solids.map(|k| &all[k]);
        match self.spec.kind {
            JointKind::Hinge => {
                let middle = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
                let axes = [[1.0, 0.0], [0.0, 1.0]];
                let apart = [a.centripetal(middle), b.centripetal(middle)];
                let of = |k: usize| Constraint {
                    direction: Direction::between(solids, all, middle, axes[k]),
                    error: q[k] - p[k],
                    apparent: apart[1][k] - apart[0][k],
                };
                vec![of(0), of(1)]
            }
            JointKind::Slider { .. } => {
                let [x, y] = self.axis(all);
                let across = [-y, x];
                let sliding = sub(b.velocity_at(q), a.velocity_at(q));
                // Coriolis: 2 ω × v
                let turned = 2.0 * a.motion.angular_velocity;
                let coriolis = [-turned * sliding[1], turned * sliding[0]];
                let apart = sub(sub(b.centripetal(q), a.centripetal(q)), coriolis);
                let held = Constraint {
                    direction: Direction::between(solids, all, q, across),
                    error: dot(sub(q, p), across),
                    apparent: dot(apart, across),
                };
                let error = b.motion.angle - a.motion.angle - self.angle;
                vec![held, Constraint { direction: Direction::turning(solids), error, apparent: 0.0 }]
            }
            JointKind::Spring { .. } => Vec::new(),
        }
    }

    /// The direction that it leaves free, and the coordinate along it [m or rad].
    fn coordinate(&self, all: &[Solid]) -> (Direction, f64) {
        let (solids, [p, q]) = (self.spec.bodies, self.places(all));
        match self.spec.kind {
            JointKind::Hinge => {
                let [a, b] = solids.map(|k| all[k].motion.angle);
                (Direction::turning(solids), b - a)
            }
            JointKind::Slider { .. } => {
                let axis = self.axis(all);
                (Direction::between(solids, all, q, axis), dot(sub(q, p), axis))
            }
            JointKind::Spring { .. } => {
                let line = sub(q, p);
                let length = line[0].hypot(line[1]);
                let unit = if length > 0.0 { line.map(|x| x / length) } else { [0.0; 2] };
                // a force along the line acts on both ends alike: at p and at q it has the same moment
                (Direction::between(solids, all, q, unit), length)
            }
        }
    }

    /// CO38: forces of spring and damper on a and b, and the free coordinate less its value at the start.
    pub fn spring(&self, all: &[Solid]) -> ([Resultant; 2], f64) {
        let (direction, value) = self.coordinate(all);
        let stretched = value - self.rest;
        let force = -self.spec.stiffness * stretched - self.spec.damping * direction.speed(all);
        (direction.resultants(force), stretched)
    }

    /// Energy of the spring [J/m].
    pub fn elastic(&self) -> f64 {
        if self.holds() { 0.5 * self.spec.stiffness * self.memory.value.powi(2) } else { 0.0 }
    }

    /// Largest step at which spring and damper are stable [s].
    pub fn stable_dt(&self, all: &[Solid]) -> f64 {
        let (direction, _) = self.coordinate(all);
        let mobility: f64 = (0..2)
            .map(|side| {
                let response = all[self.spec.bodies[side]].response();
                (0..3).map(|k| direction.jacobian[side][k].powi(2) * response[k]).sum::<f64>()
            })
            .sum();
        // half of the limits 2/ω and 1/(c M⁻¹)
        let spring = 1.0 / (self.spec.stiffness * mobility).sqrt();
        spring.min(0.5 / (self.spec.damping * mobility))
    }
}
