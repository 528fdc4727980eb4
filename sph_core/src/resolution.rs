//! Particles where they matter: water that is coarser than wished is split while the wish moves (THEORY E26).

use serde::{Deserialize, Serialize};

use crate::fluid::Fluid;
use crate::particles::{Derived, Particles};

/// Where water is to be resolved: finely in a rectangle below the still surface y = 0 and in a layer beside a body, by
/// spacings that grow around them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FineZone {
    /// x of its middle [m].
    pub middle: f64,
    /// Half its width [m].
    pub half_width: f64,
    /// Depth of its bottom below the still surface [m].
    pub depth: f64,
    /// The body's edges, from one end to the other [m].
    pub edges: Vec<[[f64; 2]; 2]>,
    /// Thickness of the layer beside them [m].
    pub layer: f64,
    /// Spacing inside [m].
    pub spacing: f64,
    /// Growth of the spacing with the distance from it [-]: rows that grow by 1.1 have 0.1.
    pub slope: f64,
}

impl FineZone {
    /// E26: the spacing wished for at a place [m].
    pub fn spacing_at(&self, at: [f64; 2]) -> f64 {
        let beside = (at[0] - self.middle).abs() - self.half_width;
        let below = -at[1] - self.depth;
        let from_layer = |edge: &[[f64; 2]; 2]| distance(at, edge) - self.layer;
        let far = self.edges.iter().map(from_layer).fold(beside.max(below), f64::min);
        self.spacing + self.slope * far.max(0.0)
    }
}

/// Distance of a point from an edge [m].
fn distance([x, y]: [f64; 2], [a, b]: &[[f64; 2]; 2]) -> f64 {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [x - a[0], y - a[1]]);
    let length2 = (along[0] * along[0] + along[1] * along[1]).max(f64::MIN_POSITIVE);
    let share = ((to[0] * along[0] + to[1] * along[1]) / length2).clamp(0.0, 1.0);
    (to[0] - share * along[0]).hypot(to[1] - share * along[1])
}

/// A particle is split that stands for more than this times the area wished for: its halves stand for as much less.
const COARSE: f64 = std::f64::consts::SQRT_2;
/// Halves lie at this many spacings of the whole on either side of where it was.
const ARM: f64 = 0.25 * std::f64::consts::SQRT_2;
/// The share of walls in a particle's filling from which on it is left whole: a half might end up behind them.
const BESIDE_WALL: f64 = 0.02;

impl Fluid {
    /// E26: halve every particle that is coarser than the fine zone wants it. Mass, momentum, energy, volume and the centre
    /// of mass stay what they are. True if there was one.
    pub(crate) fn refine(&mut self) -> bool {
        let Some(zone) = &self.fine_zone else { return false };
        let (p, d, rho0) = (&mut self.particles, &mut self.derived, self.parameters.eos.rho0);
        let wholes = p.len();
        for k in 0..wholes {
            let area = p.mass[k] / rho0;
            let wished = zone.spacing_at([p.x[k], p.y[k]]);
            let free = d.surroundings[k].filling - d.surroundings[k].fluid_filling < BESIDE_WALL;
            if area > COARSE * wished * wished && free {
                p.halve(k, area.sqrt());
                d.halve(k);
            }
        }
        self.fit();
        self.particles.len() > wholes
    }

    /// Make what a sweep writes as long as there are particles.
    pub(crate) fn fit(&mut self) {
        let n = self.particles.len();
        self.density_rate.resize(n, 0.0);
        self.gathered.resize(n, Default::default());
        self.heating.resize(n, 0.0);
    }
}

impl Particles {
    /// E26: particle `k` of the given spacing [m] becomes two, of which one is the last. A square lattice, halved all over
    /// along its diagonals, is a square lattice again, turned by 45° and finer by √2; halved along x, it is upright again.
    fn halve(&mut self, k: usize, spacing: f64) {
        let upright = self.halvings[k].is_multiple_of(2);
        let arm = if upright { [0.5f64.sqrt(), 0.5f64.sqrt()] } else { [1.0, 0.0] }.map(|e| ARM * spacing * e);
        self.mass[k] *= 0.5;
        self.h[k] *= 0.5f64.sqrt();
        self.halvings[k] += 1;
        let id = self.len() as u32;
        let Particles { x, y, u, v, rho, mass, h, theta, ax, ay, id: ids, energy, halvings } = self;
        for array in [&mut *x, y, u, v, rho, mass, h, theta, ax, ay, energy] {
            array.push(array[k]);
        }
        let last = x.len() - 1;
        (x[k], y[k]) = (x[k] - arm[0], y[k] - arm[1]);
        (x[last], y[last]) = (x[last] + arm[0], y[last] + arm[1]);
        ids.push(id);
        halvings.push(halvings[k]);
    }
}

impl Derived {
    /// What a half knows of itself is what the whole knew.
    fn halve(&mut self, k: usize) {
        self.volume[k] *= 0.5;
        self.volume.push(self.volume[k]);
        self.pressure.push(self.pressure[k]);
        self.surroundings.push(self.surroundings[k]);
        self.near_surface.push(self.near_surface[k]);
    }
}
