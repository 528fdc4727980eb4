//! The passes of an acoustic step over the particles (THEORY WC22): each equation for a chunk of targets after the other, so that
//! a chunk's numbers are read once per pass.

use super::held_pairs::{HeldPairs, Row};
use super::held_walls::HeldWalls;
use crate::parallel::{self, CHUNK};
use crate::particles::Particles;
use crate::simd::{self, SimdReal, Task};
use crate::system::ParticleSystem;

/// v ← v + Δt a, and what neighbours show.
pub(super) fn kick(system: &mut ParticleSystem, rows: &mut [Row], dt: f64) {
    let (p, pressure) = (&mut system.particles, &system.fields.pressure);
    let targets = p.u.chunks_mut(CHUNK).zip(p.v.chunks_mut(CHUNK)).zip(rows.chunks_mut(CHUNK));
    parallel::each_piece(targets.collect(), |c, ((u, v), rows)| {
        let at = c * CHUNK..c * CHUNK + u.len();
        let (ax, ay, pressure) = (&p.ax[at.clone()], &p.ay[at.clone()], &pressure[at]);
        for k in 0..u.len() {
            u[k] += dt * ax[k];
            v[k] += dt * ay[k];
            rows[k] = Row { u: u[k], v: v[k], p: pressure[k] };
        }
    });
}

/// ρ' = ρ (2 + ε)/(2 − ε) with ε = δt (dρ/dt)/ρ, then p' = p(ρ') and x' = x + δt (v½ + d).
pub(super) struct Densities<'a, S> {
    pub pairs: &'a HeldPairs,
    pub walls: &'a HeldWalls,
    pub rows: &'a [Row],
    /// Share of each row of `walls` in −∇·v [1/s].
    pub closing: &'a [f64],
    /// Velocities that shift the particles [m/s].
    pub shift_velocity: &'a [Vec<f64>; 2],
    /// Factor of the diffusion's sum [s/m].
    pub diffusion: f64,
    pub dt: f64,
    /// The time since the middle of the advective step [s].
    pub later: f64,
    /// Density that particle k may have, and its pressure [Pa], of a density.
    pub state: S,
}

impl<S: Fn(usize, f64) -> [f64; 2] + Sync> Densities<'_, S> {
    /// Advance them; `shown` are the pressures that the neighbours see.
    pub fn advance(&self, p: &mut Particles, pressure: &mut [f64], shown: &mut [f64], simd: bool) {
        let numbers = p.rho.chunks_mut(CHUNK).zip(pressure.chunks_mut(CHUNK)).zip(shown.chunks_mut(CHUNK));
        let places = p.x.chunks_mut(CHUNK).zip(p.y.chunks_mut(CHUNK));
        parallel::each_piece(numbers.zip(places).collect(), |c, (((rho, pressure), shown), (x, y))| {
            simd::run(simd, DensitiesOf { all: self, c, rho, pressure: [pressure, shown], place: [x, y] });
        });
    }
}

struct DensitiesOf<'a, S> {
    all: &'a Densities<'a, S>,
    c: usize,
    rho: &'a mut [f64],
    pressure: [&'a mut [f64]; 2],
    place: [&'a mut [f64]; 2],
}

impl<S: Fn(usize, f64) -> [f64; 2]> Task for DensitiesOf<'_, S> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let DensitiesOf { all, c, rho, pressure: [pressure, shown], place: [x, y] } = self;
        let Densities { pairs, walls, rows, closing, shift_velocity, diffusion, dt, later, ref state } = *all;
        let (first, count) = (c * CHUNK, rho.len());
        let mut rate = pairs.density_rate(zero, c, rows, rho, [diffusion, later]);
        for (row, k) in walls.near(first..first + count) {
            rate[k - first] += rho[k - first] * closing[row];
        }
        let [shift_u, shift_v] = shift_velocity.each_ref().map(|of| &of[first..first + count]);
        for k in 0..count {
            let (twice, change) = (2.0 * rho[k], dt * rate[k]);
            let advanced = rho[k] * ((twice + change) / (twice - change));
            [rho[k], pressure[k]] = state(first + k, advanced);
            shown[k] = pressure[k];
            x[k] += dt * (rows[first + k].u + shift_u[k]);
            y[k] += dt * (rows[first + k].v + shift_v[k]);
        }
    }
}

/// a = F/m + g of the pressures p, the viscous forces held and the walls' pushes, and v ← v + Δt a.
pub(super) struct Accelerations<'a> {
    pub pairs: &'a HeldPairs,
    pub walls: &'a HeldWalls,
    /// Of particles and images [Pa].
    pub pressure: &'a [f64],
    /// Of the walls [Pa].
    pub wall_pressure: &'a [f64],
    /// [N/m]
    pub viscous: &'a [Vec<f64>; 2],
    pub dt: f64,
    /// The time since the middle of the advective step [s].
    pub later: f64,
}

impl Accelerations<'_> {
    /// Find them.
    pub fn evaluate(&self, system: &mut ParticleSystem) {
        let (p, g, simd) = (&mut system.particles, system.domain.gravity, system.domain.simd);
        let accelerations = p.ax.chunks_mut(CHUNK).zip(p.ay.chunks_mut(CHUNK));
        let velocities = p.u.chunks_mut(CHUNK).zip(p.v.chunks_mut(CHUNK));
        let mass = &p.mass;
        parallel::each_piece(accelerations.zip(velocities).collect(), |c, ((ax, ay), (u, v))| {
            let mass = &mass[c * CHUNK..c * CHUNK + ax.len()];
            simd::run(simd, AccelerationsOf { all: self, c, g, mass, acceleration: [ax, ay], velocity: [u, v] });
        });
    }
}

struct AccelerationsOf<'a> {
    all: &'a Accelerations<'a>,
    c: usize,
    g: [f64; 2],
    mass: &'a [f64],
    acceleration: [&'a mut [f64]; 2],
    velocity: [&'a mut [f64]; 2],
}

impl Task for AccelerationsOf<'_> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let AccelerationsOf { all, c, g, mass, acceleration: [ax, ay], velocity: [u, v] } = self;
        let Accelerations { pairs, walls, pressure, wall_pressure, viscous, dt, later } = *all;
        let (first, count) = (c * CHUNK, mass.len());
        let [mut fx, mut fy] = pairs.pressure_force(zero, c, pressure, (count, later));
        for (row, k) in walls.near(first..first + count) {
            let [x, y] = walls.push(row, pressure[k], wall_pressure, later);
            fx[k - first] += x;
            fy[k - first] += y;
        }
        let [viscous_x, viscous_y] = viscous.each_ref().map(|of| &of[first..first + count]);
        for k in 0..count {
            ax[k] = (fx[k] + viscous_x[k]) / mass[k] + g[0];
            ay[k] = (fy[k] + viscous_y[k]) / mass[k] + g[1];
            u[k] += dt * ax[k];
            v[k] += dt * ay[k];
        }
    }
}
