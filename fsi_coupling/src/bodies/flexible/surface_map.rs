//! What carries a boundary particle of a flexible body: its rigid frame, or a beam (THEORY K1–K4).

use crate::bodies::beam_surface::{BeamSurface, Perch, Place};
use crate::bodies::rigid_motion::rotate;

/// What carries a place of a flexible body's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carrier {
    /// The rigid frame.
    Frame {
        /// Where it is at rest [m].
        rest: [f64; 2],
        /// Its normal then [-].
        normal: [f64; 2],
    },
    /// A beam element.
    Beam(Perch),
}

/// The nodes of a body, of which one is the rigid frame's, and the beams between the others.
#[derive(Clone, Debug)]
pub struct Carriage {
    /// The beams.
    pub surface: BeamSurface,
    /// The frame's node.
    pub frame: usize,
    /// Where it is at rest [m]; it moves when a panel breaks off.
    pub pole: [f64; 2],
}

/// A displacement, velocity or acceleration of all nodes, or loads on them: `[nodes][x, y, turn]`.
pub type Nodal<'a> = &'a [[f64; 3]];

impl Carriage {
    /// What carries a place [m] with a normal [-] on the frame.
    pub fn on_frame(&self, at: [f64; 2], normal: [f64; 2]) -> Carrier {
        Carrier::Frame { rest: at, normal }
    }

    /// From the frame's node to a place at rest, turned with the frame [m].
    fn arm(&self, rest: [f64; 2], turn: f64) -> [f64; 2] {
        rotate([0, 1].map(|k| rest[k] - self.pole[k]), turn)
    }

    /// Where a place is when the nodes are displaced by q [m, m, rad]: K1, or r = x_f + R(θ_f) arm.
    pub fn place(&self, carrier: &Carrier, q: Nodal) -> Place {
        match carrier {
            Carrier::Beam(perch) => self.surface.place(perch, q),
            Carrier::Frame { rest, normal } => {
                let [x, y, turn] = q[self.frame];
                let r = self.arm(*rest, turn);
                Place { at: [self.pole[0] + x + r[0], self.pole[1] + y + r[1]], normal: rotate(*normal, turn) }
            }
        }
    }

    /// K4: the nodes that move a place, and ∂r/∂q by their values.
    pub fn influence(&self, carrier: &Carrier, q: Nodal) -> Influence {
        match carrier {
            Carrier::Beam(perch) => {
                Influence { nodes: self.surface.ends(perch.element), count: 2, rows: self.surface.influence(perch, q) }
            }
            Carrier::Frame { rest, .. } => {
                let r = self.arm(*rest, q[self.frame][2]);
                let rows = [[1.0, 0.0, -r[1], 0.0, 0.0, 0.0], [0.0, 1.0, r[0], 0.0, 0.0, 0.0]];
                Influence { nodes: [self.frame; 2], count: 1, rows }
            }
        }
    }

    /// H q̇: velocity of a place [m/s].
    pub fn velocity(&self, carrier: &Carrier, q: Nodal, rate: Nodal) -> [f64; 2] {
        self.influence(carrier, q).of(rate)
    }

    /// H q̈, and on the frame the pull of its turning −θ̇² R arm: acceleration of a place [m/s²]. What the bending beams'
    /// own turning adds is left out.
    pub fn acceleration(&self, carrier: &Carrier, q: Nodal, rate: Nodal, acceleration: Nodal) -> [f64; 2] {
        let [ax, ay] = self.influence(carrier, q).of(acceleration);
        match carrier {
            Carrier::Beam(_) => [ax, ay],
            Carrier::Frame { rest, .. } => {
                let (r, spin) = (self.arm(*rest, q[self.frame][2]), rate[self.frame][2]);
                [ax - spin * spin * r[0], ay - spin * spin * r[1]]
            }
        }
    }

    /// Hᵀ f: add a force [N/m] at a place to the nodes' loads [N/m, N/m, N].
    pub fn carry(&self, carrier: &Carrier, q: Nodal, force: [f64; 2], loads: &mut [[f64; 3]]) {
        self.influence(carrier, q).carry(force, loads);
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
    pub fn carry(&self, force: [f64; 2], loads: &mut [[f64; 3]]) {
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
