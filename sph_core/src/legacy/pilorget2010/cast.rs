//! All particles of a step: fluid, limit particles, dummies, those mirrored at the surface, images of a plane of symmetry.

use crate::neighbours::images::Mirror;

/// One of the cast.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Player {
    pub x: f64,
    pub y: f64,
    pub h: f64,
    pub mass: f64,
    /// Its pressure is `sign` times that of this row.
    pub row: u32,
    pub sign: f64,
    /// False for those that complete kernels of pressures only, not of densities: the mirrored ones (LE25).
    pub counts: bool,
}

/// A player and the surface that mirrors it (LE25): the plane through player `surface`, normal `n`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reflection {
    pub player: u32,
    pub surface: u32,
    pub n: [f64; 2],
}

/// The cast in this order: rows (system, then limit particles), dummies, their images, mirrored ones with theirs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cast {
    pub players: Vec<Player>,
    /// Players that have a row of their own.
    pub rows: usize,
    /// Players before images and mirrored ones.
    pub own: usize,
}

impl Cast {
    /// LE25: add the mirrored ones.
    pub fn reflect(&mut self, reflections: &[Reflection]) {
        for r in reflections {
            let (p, s) = (self.players[r.player as usize], self.players[r.surface as usize]);
            let height = (s.x - p.x) * r.n[0] + (s.y - p.y) * r.n[1];
            let (x, y) = (p.x + 2.0 * height * r.n[0], p.y + 2.0 * height * r.n[1]);
            self.players.push(Player { x, y, sign: -p.sign, counts: false, ..p });
        }
    }

    /// Add the images of those who can be felt across the plane of symmetry.
    pub fn repeat(&mut self, from: usize, mirror: Option<Mirror>) {
        let Some(mirror) = mirror else { return };
        for k in from..self.players.len() {
            let p = self.players[k];
            if p.x - mirror.at < 2.5 * p.h {
                self.players.push(Player { x: mirror.reflect(p.x), ..p });
            }
        }
    }
}
