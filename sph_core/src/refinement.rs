//! Refinement: particles that are coarser than a moving zone allows are split (THEORY WC21).

use serde::{Deserialize, Serialize};

use crate::neighbours::Neighbours;
use crate::parallel;
use crate::particles::{Fields, Particles, smoothing_length};
use crate::walls::midline::bounds;

/// Where water is to be resolved: finely in a rectangle below the still surface y = 0 and in a layer beside a body, by
/// spacings that grow around them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RefinementZone {
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

impl RefinementZone {
    /// WC21: the distance from zone and layer at which a spacing [m] is what is wished for [m]; below 0 for a finer one.
    fn distance_of(&self, spacing: f64) -> f64 {
        (spacing - self.spacing) / self.slope
    }

    /// Is a place within `distance` [m] of the rectangle or of the layer? `bounds` are those of the edges.
    fn is_within(&self, at: [f64; 2], distance: f64, bounds: &Bounds) -> bool {
        let beside = (at[0] - self.middle).abs() - self.half_width;
        let below = -at[1] - self.depth;
        let from_edge = distance + self.layer;
        beside.max(below) < distance
            || bounds.is_within(at, from_edge) && self.edges.iter().any(|edge| from(edge, at) < from_edge)
    }
}

/// Distance of a point from an edge [m].
fn from([a, b]: &[[f64; 2]; 2], [x, y]: [f64; 2]) -> f64 {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [x - a[0], y - a[1]]);
    let length2 = (along[0] * along[0] + along[1] * along[1]).max(f64::MIN_POSITIVE);
    let share = ((to[0] * along[0] + to[1] * along[1]) / length2).clamp(0.0, 1.0);
    let apart = [to[0] - share * along[0], to[1] - share * along[1]];
    (apart[0] * apart[0] + apart[1] * apart[1]).sqrt()
}

/// The smallest upright rectangle around edges: most particles are far from all of them.
struct Bounds([[f64; 2]; 2]);

impl Bounds {
    fn of(edges: &[[[f64; 2]; 2]]) -> Bounds {
        Bounds(bounds(edges.iter().flatten()))
    }

    fn is_within(&self, at: [f64; 2], distance: f64) -> bool {
        let Bounds([low, high]) = self;
        (0..2).all(|i| at[i] > low[i] - distance && at[i] < high[i] + distance)
    }
}

/// A particle is halved whose spacing is more than this times the one wished for, 2^¼: the halves' is as much less.
const COARSE: f64 = 1.189_207_115_002_721;
/// Halves lie at this many spacings of the whole on either side of where it was.
const ARM: f64 = 0.25 * std::f64::consts::SQRT_2;
/// The share of walls in a particle's filling from which on it is left whole: a half might end up behind them.
const BESIDE_WALL: f32 = 0.02;

/// WC21: split every particle that is coarser than the zone allows. Mass, momentum and the centre of mass stay what they are; so
/// do volume and energy, but for the square of the pressure difference within a particle. `rho0` and `c0` are the reference
/// density [kg/m³] and the speed of sound [m/s], `pressure` [Pa] follows from a density.
pub(crate) fn refine(
    zone: &RefinementZone,
    p: &mut Particles,
    fields: &mut Fields,
    neighbours: &Neighbours,
    gravity: [f64; 2],
    (rho0, c0): (f64, f64),
    pressure: impl Fn(f64) -> f64,
) {
    if neighbours.rebuilds == 0 {
        return; // which particles are beside a wall is not known yet
    }
    let (wholes, bounds) = (p.len(), Bounds::of(&zone.edges));
    p.refinement_level.resize(wholes, 0);
    p.newly_split.resize(wholes, false);
    let spacing = |p: &Particles, k: usize| (p.mass[k] / rho0).sqrt();
    let is_coarse = |k: &usize| {
        let reach = zone.distance_of(spacing(p, *k) / COARSE);
        let free = fields.moments[*k].wall_kernel_sum < BESIDE_WALL;
        reach > 0.0 && free && zone.is_within([p.x[*k], p.y[*k]], reach, &bounds)
    };
    for k in parallel::by_chunk(wholes, |targets| targets.filter(is_coarse).collect::<Vec<usize>>()).concat() {
        for j in neighbours.fluid.of(k) {
            p.newly_split[neighbours.source(j, wholes)] = true;
        }
        p.newly_split[k] = true;
        p.split(k, spacing(p, k), gravity, c0);
        fields.split(k, [k, p.len() - 1].map(|half| pressure(p.rho[half])));
    }
}

impl Particles {
    /// WC21: particle `k` of the given spacing [m] becomes two, of which one is the last. A square lattice, halved all over
    /// along its diagonals, is a square lattice again, turned by 45° and finer by √2; halved along x, it is upright again. The
    /// pressure has the gradient that accelerates the whole, under gravity `g` [m/s²], at the speed of sound `c0` [m/s].
    fn split(&mut self, k: usize, spacing: f64, g: [f64; 2], c0: f64) {
        let upright = self.refinement_level[k].is_multiple_of(2);
        let arm = if upright { [0.5f64.sqrt(), 0.5f64.sqrt()] } else { [1.0, 0.0] }.map(|e| ARM * spacing * e);
        self.release(k);
        self.mass[k] *= 0.5;
        self.h[k] = smoothing_length(0.5 * self.h[k] * self.h[k]);
        self.refinement_level[k] += 1;
        let id = self.len() as u32;
        let Particles { x, y, u, v, rho, mass, h, ax, ay, id: ids, energy, rest, home, .. } = self;
        let arrays = [&mut *x, y, u, v, rho, mass, h, ax, ay, energy].into_iter().chain(rest).chain(home);
        for array in arrays.filter(|a| !a.is_empty()) {
            array.push(array[k]);
        }
        let last = x.len() - 1;
        (x[k], y[k]) = (x[k] - arm[0], y[k] - arm[1]);
        (x[last], y[last]) = (x[last] + arm[0], y[last] + arm[1]);
        let denser = ((g[0] - ax[k]) * arm[0] + (g[1] - ay[k]) * arm[1]) / (c0 * c0); // δρ/ρ of ∇p = ρ (g − a)
        (rho[k], rho[last]) = (rho[k] * (1.0 - denser), rho[last] * (1.0 + denser));
        ids.push(id);
        self.refinement_level.push(self.refinement_level[k]);
        self.newly_split.push(true);
    }
}

impl Fields {
    /// What a half knows of itself is what the whole knew, but for the pressures [Pa].
    fn split(&mut self, k: usize, pressures: [f64; 2]) {
        if !self.volume.is_empty() {
            self.volume[k] *= 0.5;
            self.volume.push(self.volume[k]);
        }
        self.pressure[k] = pressures[0];
        self.pressure.push(pressures[1]);
        self.moments.push(self.moments[k]);
        self.near_surface.push(self.near_surface[k]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wcsph::{self, Wcsph};
    use crate::{Domain, Fluid, Seed, Walls};

    const SPACING: f64 = 0.04;
    const SIDE: usize = 24;

    /// A block of water in the void, turning, its pressure growing to the right by `slope` [Pa/m].
    fn block(slope: f64) -> Fluid {
        let at = |k: usize| [(k % SIDE) as f64 + 0.5, -((k / SIDE) as f64) - 0.5].map(|c| c * SPACING);
        let seed = |k: usize| {
            let [x, y] = at(k);
            Seed { at: [x, y], velocity: [0.3 - y, 0.1 + x], area: SPACING * SPACING, pressure: slope * x }
        };
        let settings = wcsph::Settings { sound_speed: 50.0.into(), ..wcsph::Settings::default() };
        let mut fluid = Fluid::new(Domain::default(), &settings, &(0..SIDE * SIDE).map(seed).collect::<Vec<_>>());
        fluid.initialise(&mut Walls::default()).expect("water");
        fluid
    }

    /// The left half, finer by a half.
    fn zone() -> RefinementZone {
        let half = 0.5 * SIDE as f64 * SPACING;
        RefinementZone {
            middle: 0.0,
            half_width: half,
            depth: 1.0,
            spacing: 0.5 * SPACING,
            slope: 0.1,
            ..RefinementZone::default()
        }
    }

    fn refine(fluid: &mut Fluid) {
        let scheme = fluid.scheme::<Wcsph>().expect("the default scheme").clone();
        scheme.refine(fluid.system_mut());
    }

    /// Mass, momentum, kinetic energy and the centre of mass are those before, to rounding; the volume to the square of the strain.
    #[test]
    fn halves_hold_what_the_whole_held() {
        let mut fluid = block(1e3);
        let (before, count) = (fluid.totals(), fluid.particles().len());
        fluid.set_refinement_zone(Some(zone()));
        for _ in 0..2 {
            refine(&mut fluid);
            let now = fluid.totals();
            let same = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b.abs(), "{a} became {b}");
            same(before.mass, now.mass);
            same(before.height, now.height);
            same(before.energy.kinetic, now.energy.kinetic);
            assert!((now.volume / before.volume - 1.0).abs() < 1e-9, "volume {} became {}", before.volume, now.volume);
            (0..2).for_each(|i| same(before.momentum[i], now.momentum[i]));
        }
        assert!(fluid.particles().len() > 5 * count / 2, "the left half in four");
        let mut ids = fluid.particles().id.clone();
        ids.sort_unstable();
        assert!(ids.iter().enumerate().all(|(k, &id)| k == id as usize), "an identity twice");
    }

    /// A square lattice halved twice is the square lattice of half the spacing, moved along x by half of that.
    #[test]
    fn halves_of_halves_of_a_lattice_are_a_lattice() {
        let mut fluid = block(0.0);
        fluid.set_refinement_zone(Some(zone()));
        refine(&mut fluid);
        refine(&mut fluid);
        let (p, fine) = (fluid.particles(), 0.5 * SPACING);
        for k in (0..p.len()).filter(|&k| p.x[k] < zone().half_width) {
            assert_eq!(p.refinement_level[k], 2);
            assert!((p.h[k] / (1.5 * fine) - 1.0).abs() < 1e-12, "h = {}", p.h[k]);
            for offset in [p.x[k] / fine, p.y[k] / fine - 0.5] {
                assert!((offset - offset.round()).abs() < 1e-9, "({}, {})", p.x[k], p.y[k]);
            }
        }
    }
}
