//! Taking the weights of the pairs of fluid and walls that are held, and how they change (THEORY WC24).

use std::ops::Range;

use super::held_walls::{FluidBeside, FluidRates, HeldWalls, Rows, WallBeside, WallRates};
use crate::forces::interface_dynamics::PressureSensitivity;
use crate::interactions::geometry::{MeanScale, PairConstants, PairGeometry, ScaleRule};
use crate::interactions::pair::TOUCHED;
use crate::kernel::{Shape, WithKernel};
use crate::parallel;
use crate::system::ParticleSystem;
use crate::walls::Walls;

impl HeldWalls {
    /// Take the geometry of the packed particles, which move with the water and with the `shift_velocity` [m/s] (WC26).
    pub fn hold(
        &mut self,
        system: &ParticleSystem,
        walls: &Walls,
        shift_velocity: &[[f64; 2]],
        constants: PairConstants,
    ) {
        system.domain.fluid.kernel.run(Hold { held: self, system, walls, shift_velocity, constants });
    }
}

struct Hold<'a> {
    held: &'a mut HeldWalls,
    system: &'a ParticleSystem,
    walls: &'a Walls,
    shift_velocity: &'a [[f64; 2]],
    constants: PairConstants,
}

impl WithKernel for Hold<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Hold { held, system, walls, shift_velocity, constants } = self;
        let (side, lists) = (Side { system, walls, shift_velocity }, &system.neighbours.walls_of_fluid);
        let of_chunk = |targets: Range<usize>| {
            let (mut near, mut rows, mut rates) = (Vec::new(), Rows::default(), Vec::new());
            for k in targets {
                let (before, mut rate) = (rows.entries.len(), FluidRates::default());
                let beside = |w: u32| side.wall_beside::<K>(constants.stretch, k, w as usize, &mut rate);
                rows.entries.extend(lists.of(k).filter_map(beside));
                if rows.entries.len() > before {
                    rows.start.push(rows.entries.len() as u32);
                    near.push(k as u32);
                    rates.push(rate);
                }
            }
            (near, rows, rates)
        };
        (held.near, held.beside_fluid, held.of_fluid) = Default::default();
        for (near, rows, rates) in parallel::by_chunk(system.particles.len(), of_chunk) {
            held.near.extend(near);
            held.beside_fluid.append(rows);
            held.of_fluid.extend(rates);
        }
        let of_chunk = |targets: Range<usize>| {
            let mut rows = Rows::default();
            let found: Vec<_> = targets.map(|w| side.fluid_beside::<K>(w, &mut rows)).collect();
            (found, rows)
        };
        (held.sensitivity, held.of_wall, held.beside_wall) = Default::default();
        for (found, rows) in parallel::by_chunk(walls.len(), of_chunk) {
            held.sensitivity.extend(found.iter().map(|(sensitivity, _)| sensitivity));
            held.of_wall.extend(found.iter().map(|(_, rates)| rates));
            held.beside_wall.append(rows);
        }
        held.normal = (0..walls.len()).map(|w| [walls.nx[w], walls.ny[w]]).collect();
    }
}

/// What both sides read.
struct Side<'a> {
    system: &'a ParticleSystem,
    walls: &'a Walls,
    shift_velocity: &'a [[f64; 2]],
}

impl Side<'_> {
    /// The listed wall particle `w`, or its image, beside fluid particle `k`; `None` beyond the support. What it adds to the rates of `k` is
    /// added to `rates`.
    fn wall_beside<K: Shape>(&self, stretch: f64, k: usize, w: usize, rates: &mut FluidRates) -> Option<WallBeside> {
        let Side { system, walls, shift_velocity } = self;
        let (a, wall, face) = (&system.packed.fluid[k], &system.packed.walls[w], &system.packed.packed_walls[w]);
        let pair = PairGeometry::new::<K>(a.x - wall.x, a.y - wall.y, MeanScale.of::<K>(a.h, wall.h));
        if pair.grad_factor == 0.0 {
            return None;
        }
        let (n, volumes, slope) = ([face.nx, face.ny], a.volume * wall.volume, wall.volume * pair.grad_factor);
        let [rn, rt] = along([pair.dx, pair.dy], n);
        let (along_normal, along_tangent) = (2.0 * rn * slope, stretch * rt * slope);
        let of_fluid = [along_normal * n[0] - along_tangent * n[1], along_normal * n[1] + along_tangent * n[0]];
        let reflected = w >= walls.len() && system.neighbours.wall_shifts.is_empty();
        let side = if reflected { -1.0 } else { 1.0 };
        let source = system.neighbours.wall_source(w, walls.len());

        let moving =
            [a.u + shift_velocity[k][0] - side * walls.u[source], a.v + shift_velocity[k][1] - walls.v[source]];
        let rate = pair.gradient_rate::<K>(1.0, pair.grad_factor, moving); // d(F r)/dt
        let ([vn, vt], [rate_n, rate_t]) = (along([a.u, a.v], n), along(rate, n));
        let closing = 2.0 * rate_n * (vn - face.vn) + stretch * rate_t * (vt - face.vt);
        rates.closing += wall.volume * closing;
        let both = volumes * (a.p + walls.pressure[source]);
        rates.push = [rates.push[0] + both * rate[0], rates.push[1] + both * rate[1]];

        let flux = volumes * pair.grad_factor;
        let gradient = [flux * pair.dx, flux * pair.dy];
        Some(WallBeside { wall: source as u32, gradient, of_fluid, of_wall: [along_normal, side * along_tangent] })
    }

    /// The next row: the fluid beside wall particle `w`.
    fn fluid_beside<K: Shape>(&self, w: usize, rows: &mut Rows<FluidBeside>) -> (PressureSensitivity, WallRates) {
        let Side { system, walls, shift_velocity } = self;
        let (wall, before) = (&system.packed.walls[w], rows.entries.len());
        let mut sensitivity = PressureSensitivity::default();
        let (mut sum, mut sum_p, mut rate, mut rate_p, mut push) = (0.0, 0.0, 0.0, 0.0, [0.0; 2]);
        for j in system.neighbours.fluid_of_wall.of(w) {
            let (b, [shift_u, shift_v]) = (&system.packed.fluid[j as usize], shift_velocity[j as usize]);
            let pair = PairGeometry::new::<K>(wall.x - b.x, wall.y - b.y, MeanScale.of::<K>(wall.h, b.h));
            if pair.grad_factor == 0.0 {
                continue;
            }
            let (share, slope, flux) =
                (b.volume * pair.w::<K>(), b.volume * pair.grad_factor, wall.volume * b.volume * pair.grad_factor);
            let ([dx, dy], [arm, turn]) = ([pair.dx, pair.dy], [sensitivity.arm, sensitivity.push]);
            sensitivity.arm = [arm[0] + share * dx, arm[1] + share * dy];
            sensitivity.push = [turn[0] + slope * dx, turn[1] + slope * dy];
            rows.entries.push(FluidBeside { fluid: j, share, gradient: [flux * dx, flux * dy] });

            let moving = [walls.u[w] - b.u - shift_u, walls.v[w] - b.v - shift_v];
            let of_share = slope * (dx * moving[0] + dy * moving[1]);
            (sum, sum_p) = (sum + share, sum_p + share * b.p);
            (rate, rate_p) = (rate + of_share, rate_p + of_share * b.p);
            let of_gradient = pair.gradient_rate::<K>(1.0, pair.grad_factor, moving);
            let both = wall.volume * b.volume * (walls.pressure[w] + b.p);
            push = [push[0] + both * of_gradient[0], push[1] + both * of_gradient[1]];
        }
        let mean = if sum < TOUCHED { 0.0 } else { 1.0 / sum };
        rows.entries[before..].iter_mut().for_each(|b| b.share *= mean);
        rows.start.push(rows.entries.len() as u32);
        if sum < TOUCHED {
            sensitivity.push = [0.0; 2]; // as in WA3: no pressure without a fluid in reach
        }
        let pressure = mean * (rate_p - rate * (mean * sum_p));
        let sensitivity = PressureSensitivity { arm: sensitivity.arm.map(|a| a * mean), ..sensitivity };
        (sensitivity, WallRates { pressure, push })
    }
}

/// The parts of `v` along the normal `n` and along the tangent (−n_y, n_x).
fn along(v: [f64; 2], n: [f64; 2]) -> [f64; 2] {
    [v[0] * n[0] + v[1] * n[1], v[1] * n[0] - v[0] * n[1]]
}
