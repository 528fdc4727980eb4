//! Four rules for the force of the fluid on a body, from the same state (THEORY GE8).
//!
//! | rule | what is summed |
//! |---|---|
//! | [`Rule::Reaction`] | the pair forces on every boundary particle: what moves bodies (FEX_2D) |
//! | [`Rule::FirstRow`] | pressure × normal × length of the boundary particles of the first row (FEX_2D2) |
//! | [`Rule::Gauss`] | pressure at Gauss points of the outline's sides, as a gauge reads it (FEX_2D3) |
//! | [`Rule::GaussViscous`] | the same with a moving-least-squares pressure, and viscous traction (FEX_2D4) |
//!
//! The names in brackets are the switches of M. Pilorget's thesis (KTH, 2010). Every rule gives loads on the outline's
//! corners, consistent with linear and Hermite shape functions (GE9), whose resultant is the rule's.

pub mod nodal_loads;

use sph_core::particles::probe::Probe;
use sph_core::walls::Resultant;

use crate::bodies::body::Body;
use crate::bodies::state::Motion;
use crate::coupling::coupled::Coupled;
use crate::coupling::force_rules::nodal_loads::{Nodal, Side, carry, gauss_points, resultant, sides};
use crate::geometry::outline::Outline;

/// How a force is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Sum of the reactions of the pairs.
    Reaction,
    /// Pressure of the first row of boundary particles.
    FirstRow,
    /// Gauged pressure at Gauss points.
    Gauss,
    /// Least-squares pressure and viscous traction at Gauss points.
    GaussViscous,
}

/// All rules, in the thesis's order.
pub const RULES: [Rule; 4] = [Rule::Reaction, Rule::FirstRow, Rule::Gauss, Rule::GaussViscous];

impl Rule {
    /// Name in output.
    pub fn name(self) -> &'static str {
        match self {
            Rule::Reaction => "reaction",
            Rule::FirstRow => "first_row",
            Rule::Gauss => "gauss",
            Rule::GaussViscous => "gauss_viscous",
        }
    }
}

/// What a rule finds on a body; both halves where one is simulated.
#[derive(Clone, Debug)]
pub struct Load {
    /// Force [N/m] and moment about the body frame's origin [N].
    pub resultant: Resultant,
    /// Loads on the outline's corners, through all its loops.
    pub corners: Vec<Nodal>,
}

/// Sides that turn by more than this meet at a corner [rad]; smoother bends are read as flat.
const CORNER: f64 = 0.35;

/// The four rules' loads on body `k` of a system, in the order of [`RULES`]; Gauss points in panels no longer than
/// `panel` [m]. `None` for a body without an outline or a motion: a tank.
pub fn force_rules(system: &Coupled, k: usize, panel: f64) -> Option<[Load; 4]> {
    let body = system.bodies().nth(k)?;
    let scene = Placed::of(system, body)?;
    let reactions = scene.carried(&scene.reactions(k));
    let probe = Probe::new(&system.fluid);
    let first_row = scene.carried(&scene.first_row(k, &probe));
    let gauss = scene.integrated(panel, |at, side| scene.gauged(&probe, at, side));
    let viscous = scene.integrated(panel, |at, side| scene.fitted(&probe, at, side));
    Some(
        [reactions, first_row, gauss, viscous]
            .map(|corners| Load { resultant: resultant(&scene.corners, &corners, scene.motion.position), corners }),
    )
}

/// A force [N/m] and the place where it acts [m]: on the surface, and in space.
struct Pull {
    surface: [f64; 2],
    at: [f64; 2],
    force: [f64; 2],
}

/// A body's outline where it is now.
struct Placed<'a> {
    system: &'a Coupled,
    motion: Motion,
    sides: Vec<Side>,
    corners: Vec<[f64; 2]>,
    sharp: Vec<[f64; 2]>,
    support: f64,
    field: [f64; 2],
}

impl<'a> Placed<'a> {
    fn of(system: &'a Coupled, body: &dyn Body) -> Option<Placed<'a>> {
        let (motion, outline): (Motion, &Outline) = (body.motion()?, body.outline()?);
        let place = |v: &[f64; 2]| motion.point(*v);
        let loops: Vec<Vec<[f64; 2]>> = outline.loops().iter().map(|l| l.iter().map(place).collect()).collect();
        let sides = sides(&loops);
        let corners: Vec<[f64; 2]> = loops.concat();
        let arriving = |corner: usize| sides.iter().find(|s| s.corners[1] == corner);
        let turns = |s: &&Side| {
            let before = arriving(s.corners[0]).map_or(s.along, |b| b.along);
            let cross = before[0] * s.along[1] - before[1] * s.along[0];
            cross.atan2(before[0] * s.along[0] + before[1] * s.along[1]).abs() > CORNER
        };
        let sharp = sides.iter().filter(turns).map(|s| s.from).collect();
        let domain = system.fluid.domain();
        let finest = system.fluid.particles().h.iter().copied().fold(f64::INFINITY, f64::min);
        let field = [0, 1].map(|k| domain.fluid.density * (domain.gravity[k] - motion.acceleration[k]));
        Some(Placed { system, motion, sides, corners, sharp, support: 2.0 * finest, field })
    }

    /// x of the plane of symmetry, if there is one [m].
    fn plane(&self) -> Option<f64> {
        self.system.fluid.domain().mirror.map(|m| m.at)
    }

    /// The pulls of the half in front of the plane of symmetry, and those of their images.
    fn doubled(&self, pulls: Vec<Pull>) -> Vec<Pull> {
        let Some(plane) = self.plane() else { return pulls };
        let turn = |p: [f64; 2]| [2.0 * plane - p[0], p[1]];
        let image = |p: &Pull| Pull { surface: turn(p.surface), at: turn(p.at), force: [-p.force[0], p.force[1]] };
        let images: Vec<Pull> = pulls.iter().map(image).collect();
        pulls.into_iter().chain(images).collect()
    }

    /// FEX_2D: the pair forces, where the boundary particles are.
    fn reactions(&self, k: usize) -> Vec<Pull> {
        let w = &self.system.walls;
        let pull = |j: usize| Pull { surface: self.above(j), at: [w.x[j], w.y[j]], force: [w.fx[j], w.fy[j]] };
        self.doubled(self.system.range(k).map(pull).collect())
    }

    /// The place of the surface above boundary particle `j` [m].
    fn above(&self, j: usize) -> [f64; 2] {
        let w = &self.system.walls;
        [w.x[j] + w.depth[j] * w.nx[j], w.y[j] + w.depth[j] * w.ny[j]]
    }

    /// FEX_2D2: −p n ℓ on the surface above the first row; ℓ reaches half way to the neighbours along the outline. The
    /// pressure is the boundary particle's, carried to the surface by ρ₀(g − a_w)·n, times the place's wetness.
    fn first_row(&self, k: usize, probe: &Probe<'_>) -> Vec<Pull> {
        let (w, domain) = (&self.system.walls, self.system.fluid.domain());
        let first = |j: &usize| w.depth[*j] < 0.75 * w.h[*j] / domain.fluid.smoothing_ratio;
        let (rho, g) = (domain.fluid.density, domain.gravity);
        let pressed = |j: usize| {
            let (n, at) = ([w.nx[j], w.ny[j]], self.above(j));
            let slope = rho * ((g[0] - w.ax[j]) * n[0] + (g[1] - w.ay[j]) * n[1]);
            let p = probe.wetness(at) * (w.pressure[j] + slope * w.depth[j]);
            Pull { surface: at, at, force: [-p * n[0], -p * n[1]] }
        };
        let mut pulls = self.doubled(self.system.range(k).filter(first).map(pressed).collect());
        let starts: Vec<f64> = self.running_lengths();
        let stations: Vec<(usize, f64)> = pulls
            .iter()
            .map(|p| {
                let (side, t) = self.nearest(p.surface);
                (side, starts[side] + t * self.sides[side].length)
            })
            .collect();
        for (pull, length) in pulls.iter_mut().zip(self.shares(&stations, &starts)) {
            pull.force = pull.force.map(|f| f * length);
        }
        pulls
    }

    /// Running length at which each side starts [m], through all loops.
    fn running_lengths(&self) -> Vec<f64> {
        let mut length = 0.0;
        let start = |s: &Side| {
            length += s.length;
            length - s.length
        };
        self.sides.iter().map(start).collect()
    }

    /// Length of the outline [m] that is nearer to each station than to its neighbours on the same loop.
    fn shares(&self, stations: &[(usize, f64)], starts: &[f64]) -> Vec<f64> {
        let mut shares = vec![0.0; stations.len()];
        let mut first = 0;
        while first < self.sides.len() {
            let opening = self.sides[first].corners[0];
            let last = (first..self.sides.len()).find(|&s| self.sides[s].corners[1] == opening).unwrap_or(first);
            let total = starts[last] + self.sides[last].length - starts[first];
            let mut order: Vec<usize> =
                (0..stations.len()).filter(|&k| (first..=last).contains(&stations[k].0)).collect();
            order.sort_by(|&a, &b| stations[a].1.total_cmp(&stations[b].1));
            let n = order.len();
            for i in 0..n {
                let gap = (stations[order[(i + 1) % n]].1 - stations[order[i]].1).rem_euclid(total);
                let gap = if n == 1 { total } else { gap };
                shares[order[i]] += 0.5 * gap;
                shares[order[(i + 1) % n]] += 0.5 * gap;
            }
            first = last + 1;
        }
        shares
    }

    /// The side nearest to a place, and the share along it.
    fn nearest(&self, at: [f64; 2]) -> (usize, f64) {
        let distance = |s: &Side| s.nearest(at).1;
        let side = (0..self.sides.len()).min_by(|&a, &b| distance(&self.sides[a]).total_cmp(&distance(&self.sides[b])));
        let side = side.unwrap_or(0);
        (side, self.sides[side].nearest(at).0)
    }

    /// GE9: forces carried to the corners.
    fn carried(&self, pulls: &[Pull]) -> Vec<Nodal> {
        let mut corners = vec![Nodal::default(); self.corners.len()];
        for pull in pulls {
            let (side, t) = self.nearest(pull.surface);
            carry(&self.sides[side], t, pull.at, pull.force, &mut corners);
        }
        corners
    }

    /// GE8: tractions [Pa] at Gauss points, integrated and carried to the corners. Behind a plane of symmetry the image is
    /// read.
    fn integrated(&self, panel: f64, traction: impl Fn([f64; 2], [f64; 2]) -> [f64; 2]) -> Vec<Nodal> {
        let mut corners = vec![Nodal::default(); self.corners.len()];
        for side in &self.sides {
            for (t, length) in gauss_points(side, panel) {
                let (at, n) = (side.at(t), side.normal());
                let force = match self.plane() {
                    Some(plane) if at[0] < plane => {
                        let [x, y] = traction([2.0 * plane - at[0], at[1]], [-n[0], n[1]]);
                        [-x, y]
                    }
                    _ => traction(at, n),
                };
                carry(side, t, at, force.map(|f| f * length), &mut corners);
            }
        }
        corners
    }

    /// FEX_2D3: −p n, p as a gauge reads it (GE2); within 2h of a corner the carried mean (GE6).
    fn gauged(&self, probe: &Probe<'_>, at: [f64; 2], n: [f64; 2]) -> [f64; 2] {
        let near = |c: &[f64; 2]| (c[0] - at[0]).hypot(c[1] - at[1]) < self.support;
        let p = match self.sharp.iter().any(near) {
            true => probe.carried(at, self.field),
            false => probe.on_flat_face(at, n, self.field[0] * n[0] + self.field[1] * n[1]),
        };
        [-p * n[0], -p * n[1]]
    }

    /// FEX_2D4: −p n + ρ₀ν(∇v + ∇vᵀ)·n by moving least squares (GE7); the carried mean (GE6) where those fail. ν = 0
    /// where walls slip.
    fn fitted(&self, probe: &Probe<'_>, at: [f64; 2], n: [f64; 2]) -> [f64; 2] {
        let Some(found) = probe.least_squares(at) else {
            let p = probe.carried(at, self.field);
            return [-p * n[0], -p * n[1]];
        };
        let domain = self.system.fluid.domain();
        let (mu, g) = (domain.fluid.density * domain.fluid.wall_viscosity(), found.gradient);
        let shear = [0, 1].map(|i| mu * ((g[i][0] + g[0][i]) * n[0] + (g[i][1] + g[1][i]) * n[1]));
        let wetness = probe.wetness(at);
        [0, 1].map(|k| wetness * (shear[k] - found.pressure * n[k]))
    }
}
