//! The map H from the nodes of a flexible body to points of its surface, and Hᵀ (THEORY CO13–CO15).

use crate::bodies::bending::beam_surface::{BeamAttachment, BeamSurface, Place};
use crate::geometry::vector::rotate;

/// What a point of a flexible body's surface is attached to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Attachment {
    /// The rigid frame.
    Frame {
        /// Where it is at rest [m].
        rest: [f64; 2],
        /// Its normal then [-].
        normal: [f64; 2],
    },
    /// A beam element.
    Beam(BeamAttachment),
}

/// The nodes of a body, of which one is the rigid frame's, and the beams between the others.
#[derive(Clone, Debug)]
pub struct SurfaceMap {
    /// The beams.
    pub surface: BeamSurface,
    /// The frame's node.
    pub frame: usize,
    /// Where it is at rest [m]; it moves when a panel breaks off.
    pub reference: [f64; 2],
}

/// A displacement, velocity or acceleration of all nodes, or loads on them: `[nodes][x, y, turn]`.
pub type Nodal<'a> = &'a [[f64; 3]];

impl SurfaceMap {
    /// Attach a point [m] with a normal [-] to the frame.
    pub fn on_frame(&self, at: [f64; 2], normal: [f64; 2]) -> Attachment {
        Attachment::Frame { rest: at, normal }
    }

    /// From the frame's node to a place at rest, turned with the frame [m].
    fn lever_arm(&self, rest: [f64; 2], turn: f64) -> [f64; 2] {
        rotate([0, 1].map(|k| rest[k] - self.reference[k]), turn)
    }

    /// Where a place is when the nodes are displaced by q [m, m, rad]: CO13, or r = x_f + R(θ_f) arm.
    pub fn place(&self, attachment: &Attachment, q: Nodal) -> Place {
        match attachment {
            Attachment::Beam(beam) => self.surface.place(beam, q),
            Attachment::Frame { rest, normal } => {
                let [x, y, turn] = q[self.frame];
                let r = self.lever_arm(*rest, turn);
                Place {
                    at: [self.reference[0] + x + r[0], self.reference[1] + y + r[1]],
                    normal: rotate(*normal, turn),
                }
            }
        }
    }

    /// CO15: the nodes that move a place, and ∂r/∂q by their values.
    pub fn influence(&self, attachment: &Attachment, q: Nodal) -> Influence {
        match attachment {
            Attachment::Beam(beam) => {
                Influence { nodes: self.surface.ends(beam.element), count: 2, rows: self.surface.influence(beam, q) }
            }
            Attachment::Frame { rest, .. } => {
                let r = self.lever_arm(*rest, q[self.frame][2]);
                let rows = [[1.0, 0.0, -r[1], 0.0, 0.0, 0.0], [0.0, 1.0, r[0], 0.0, 0.0, 0.0]];
                Influence { nodes: [self.frame; 2], count: 1, rows }
            }
        }
    }

    /// H q̇: velocity of a place [m/s].
    pub fn velocity(&self, attachment: &Attachment, q: Nodal, rate: Nodal) -> [f64; 2] {
        self.influence(attachment, q).of(rate)
    }

    /// H q̈, and on the frame the pull of its turning −θ̇² R arm: acceleration of a place [m/s²]. What the bending beams'
    /// own turning adds is left out.
    pub fn acceleration(&self, attachment: &Attachment, q: Nodal, rate: Nodal, acceleration: Nodal) -> [f64; 2] {
        let [ax, ay] = self.influence(attachment, q).of(acceleration);
        match attachment {
            Attachment::Beam(_) => [ax, ay],
            Attachment::Frame { rest, .. } => {
                let (r, angular_velocity) = (self.lever_arm(*rest, q[self.frame][2]), rate[self.frame][2]);
                [ax - angular_velocity * angular_velocity * r[0], ay - angular_velocity * angular_velocity * r[1]]
            }
        }
    }

    /// Hᵀ f: add a force [N/m] at a place to the nodes' loads [N/m, N/m, N].
    pub fn add_load(&self, attachment: &Attachment, q: Nodal, force: [f64; 2], loads: &mut [[f64; 3]]) {
        self.influence(attachment, q).add_load(force, loads);
    }
}

/// How a place moves with the nodes that carry it.
#[derive(Clone, Copy, Debug)]
pub struct Influence {
    /// The nodes; the first `count` of them.
    pub nodes: [usize; 2],
    /// How many.
    pub count: usize,
    /// Rows x, y by the nodes' values.
    pub rows: [[f64; 6]; 2],
}

impl Influence {
    /// Transposed rows times a force [N/m], added to the nodes' loads.
    pub fn add_load(&self, force: [f64; 2], loads: &mut [[f64; 3]]) {
        let rows = &self.rows;
        for (end, node) in self.nodes.iter().enumerate().take(self.count) {
            for k in 0..3 {
                loads[*node][k] += rows[0][3 * end + k] * force[0] + rows[1][3 * end + k] * force[1];
            }
        }
    }

    /// Rows times a field.
    pub fn of(&self, field: Nodal) -> [f64; 2] {
        self.rows.map(|row| {
            let by = |end: usize| (0..3).map(|k| row[3 * end + k] * field[self.nodes[end]][k]).sum::<f64>();
            (0..self.count).map(by).sum()
        })
    }
}
