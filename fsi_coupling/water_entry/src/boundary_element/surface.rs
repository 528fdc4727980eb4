//! The free surface: nodes that move with the water, redistributed in each step, and the cut through the jet (THEORY EN22).

use std::f64::consts::PI;

use faer::c64;

use super::elements::{Sizes, arc_length, graded};
use super::lower_side::LowerSide;
use super::spline::Spline;
use crate::similarity::SimilarityFlow;

/// Pieces between two points of the exact surface.
const PIECES: usize = 8;
/// The jet begins where the surface is steeper than this against the face [rad].
const JET_ANGLE: f64 = 10.0 * PI / 180.0;
/// Length of the jet that is kept, over its thickness.
const KEPT: f64 = 2.0;
/// The jet is looked for up to this distance from the cut, in finest elements.
const TIP: f64 = 12.0;
/// Least number of elements of the surface that left the chine.
const LEAST_ELEMENTS: f64 = 4.0;

/// Flow at the nodes of a free surface.
#[derive(Clone, Debug, Default)]
pub(super) struct SurfaceFlow {
    /// u + iv [m/s].
    pub velocity: Vec<c64>,
    /// dφ/dt of the nodes [m²/s²].
    pub rate: Vec<f64>,
}

impl SurfaceFlow {
    /// The surface moved over `dt` [s].
    pub fn moves(&self, surface: &FreeSurface, dt: f64) -> FreeSurface {
        surface.moved(&self.velocity, &self.rate, dt)
    }
}

/// A free surface: the right half of the upper one, from far away to the jet's cut; or that which left the chine, from the
/// cut to the chine.
#[derive(Clone, Debug)]
pub(super) struct FreeSurface {
    /// Nodes x + iy [m].
    pub z: Vec<c64>,
    /// Potential φ there [m²/s].
    pub phi: Vec<f64>,
    /// Velocities u + iv at earlier instants where the water was that is now at the nodes, the last first [m/s].
    pub past: Vec<Vec<c64>>,
}

impl FreeSurface {
    /// EN20: the exact surface at constant speed without gravity, of length unit `draught` [m], at the downward `speed` [m/s]: φ = ½(r² − s²), r from
    /// the place of contact, s along the surface from the jet's tip. Out to `far` draughts.
    pub fn similar(flow: &SimilarityFlow, draught: f64, speed: f64, far: f64) -> FreeSurface {
        FreeSurface::through(&flow.surface, 0.0, draught, speed, far)
    }

    /// The same through points of the exact surface from the tip outwards, x outwards, shape (n, 2), in axes of an apex that has moved outwards by
    /// `drift` draughts.
    pub fn through(surface: &[[f64; 2]], drift: f64, draught: f64, speed: f64, far: f64) -> FreeSurface {
        let z: Vec<c64> = surface.iter().rev().map(|[x, y]| c64::new(*x, *y)).skip_while(|z| z.re > far).collect();
        let coarse = FreeSurface { phi: vec![0.0; z.len()], z, past: Vec::new() };
        let at = arc_length(&coarse.z);
        let between = |k: usize| (0..PIECES).map(move |i| i as f64 / PIECES as f64).map(move |q| (k, q));
        let fine: Vec<f64> = (0..at.len() - 1)
            .flat_map(between)
            .map(|(k, q)| at[k] + q * (at[k + 1] - at[k]))
            .chain(at.last().copied())
            .collect();
        let mut surface = coarse.sampled(&fine);
        let (s, farthest) = (arc_length(&surface.z), surface.z[0].norm());
        surface.phi = surface.z.iter().zip(s).map(|(z, s)| 0.5 * (z.norm_sqr() - (farthest - s).powi(2))).collect();
        surface.z.iter_mut().for_each(|z| z.re -= drift);
        surface.scaled(draught, speed)
    }

    /// The last node.
    pub fn end(&self) -> c64 {
        self.z[self.z.len() - 1]
    }

    /// Velocity u + iv of the water at the nodes [m/s] of ψ there.
    pub fn velocity(&self, psi: &[f64]) -> Vec<c64> {
        let s = arc_length(&self.z);
        let slopes = |of: &mut dyn Iterator<Item = f64>| Spline::new(&s, of).slopes();
        let (x, y) = (slopes(&mut self.z.iter().map(|z| z.re)), slopes(&mut self.z.iter().map(|z| z.im)));
        let (phi, psi) = (slopes(&mut self.phi.iter().copied()), slopes(&mut psi.iter().copied()));
        (0..s.len()).map(|k| (c64::new(phi[k], psi[k]) / c64::new(x[k], y[k])).conj()).collect()
    }

    /// Moved over `dt` [s] with the velocities of its nodes and the rates of φ.
    pub fn moved(&self, velocity: &[c64], rate: &[f64], dt: f64) -> FreeSurface {
        FreeSurface {
            z: self.z.iter().zip(velocity).map(|(z, v)| z + v * dt).collect(),
            phi: self.phi.iter().zip(rate).map(|(phi, rate)| phi + rate * dt).collect(),
            past: Vec::new(),
        }
    }

    /// The jet cut, and nodes at distances that grow away from it.
    pub fn redistributed(&self, lower: LowerSide<'_>) -> FreeSurface {
        let s = arc_length(&self.z);
        let (x, y) = (Spline::new(&s, self.z.iter().map(|z| z.re)), Spline::new(&s, self.z.iter().map(|z| z.im)));
        let at = |s: f64| c64::new(x.sample(s)[0], y.sample(s)[0]);
        let is_jet = |s: f64| {
            let against_face = (c64::new(x.sample(s)[1], y.sample(s)[1]) * lower.nearest(at(s)).tangent.conj()).arg();
            (-0.5 * PI..JET_ANGLE).contains(&against_face)
        };
        let (whole, size) = (s[s.len() - 1], lower.finest(self.end()));
        let kept =
            jet_end(whole, size, &is_jet).map(|tip| (tip, root_of_jet(tip, size, &is_jet))).and_then(|(tip, root)| {
                let end = root + KEPT * lower.nearest(at(root)).away;
                (end < tip).then_some(end)
            });
        let end = kept.unwrap_or(whole);
        let (half_breadth, far) = (lower.nearest(self.end()).foot.re, lower.growth_far());
        let mut nodes = graded(end, |q| lower.sizes.grown(size, q) + far * (q - half_breadth).max(0.0));
        nodes.iter_mut().for_each(|q| *q = (end - *q).max(0.0));
        nodes.reverse();
        self.sampled(&nodes)
    }

    /// The surface that left the chine with its nodes redistributed, fine at both ends, from the point nearest to the jet's cut to the chine.
    pub fn redistributed_below(&self, cut: c64, size: f64, sizes: Sizes) -> FreeSurface {
        let FreeSurface { z, .. } = self;
        let s = arc_length(z);
        let on = |k: usize| {
            let piece = z[k + 1] - z[k];
            let share = (((cut - z[k]) * piece.conj()).re / piece.norm_sqr()).clamp(0.0, 1.0);
            [(z[k] + piece * share - cut).norm(), s[k] + share * (s[k + 1] - s[k])]
        };
        let nearest = (0..z.len() - 1).map(on).fold([f64::INFINITY, 0.0], |a, b| if b[0] < a[0] { b } else { a });
        let whole = s[s.len() - 1];
        let length = (whole - nearest[1]).max(0.5 * size);
        let at =
            graded(length, |q| sizes.grown(size, q).min(sizes.grown(size, length - q)).min(length / LEAST_ELEMENTS));
        self.sampled(&at.iter().map(|q| whole - length + q).collect::<Vec<_>>())
    }

    /// With nodes at the distances `at` along it.
    pub fn sampled(&self, at: &[f64]) -> FreeSurface {
        let s = arc_length(&self.z);
        let along = |of: &mut dyn Iterator<Item = f64>| {
            let spline = Spline::new(&s, of);
            at.iter().map(|&s| spline.sample(s)[0]).collect::<Vec<_>>()
        };
        let places = |z: &[c64]| -> Vec<c64> {
            let (x, y) = (along(&mut z.iter().map(|z| z.re)), along(&mut z.iter().map(|z| z.im)));
            x.into_iter().zip(y).map(|(x, y)| c64::new(x, y)).collect()
        };
        FreeSurface {
            z: places(&self.z),
            phi: along(&mut self.phi.iter().copied()),
            past: self.past.iter().map(|velocity| places(velocity)).collect(),
        }
    }

    /// All lengths times `length`, and all velocities times `speed`.
    pub fn scaled(&self, length: f64, speed: f64) -> FreeSurface {
        FreeSurface {
            z: self.z.iter().map(|z| z * length).collect(),
            phi: self.phi.iter().map(|phi| phi * length * speed).collect(),
            past: Vec::new(),
        }
    }

    /// Are all numbers finite?
    pub fn is_finite(&self) -> bool {
        self.z.iter().all(|z| z.is_finite()) && self.phi.iter().all(|phi| phi.is_finite())
    }
}

/// Where the jet that may be cut ends, as a distance along a surface of length `whole`.
fn jet_end(whole: f64, size: f64, is_jet: &impl Fn(f64) -> bool) -> Option<f64> {
    let candidates = (0..).map(|k| 0.5 * f64::from(k)).take_while(|q| *q < TIP);
    candidates.map(|q| whole - (q + 0.01) * size).find(|&s| s > size && is_jet(s) && is_jet(s - 0.5 * size))
}

/// Where the jet begins that ends at `tip`, by bisection.
fn root_of_jet(tip: f64, size: f64, is_jet: &impl Fn(f64) -> bool) -> f64 {
    let mut inside = tip;
    while inside > 0.0 && is_jet(inside) {
        inside -= 0.25 * size;
    }
    let (mut before, mut after) = (inside, (inside + 0.25 * size).min(tip));
    for _ in 0..30 {
        let middle = 0.5 * (before + after);
        if is_jet(middle) { after = middle } else { before = middle }
    }
    0.5 * (before + after)
}
