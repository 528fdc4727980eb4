//! What the pressure of an incompressible step costs, by number of particles:
//! `cargo run --release -p sph_core --example pressure_cost [most particles [preconditioner]]`.
//!
//! A tank twice as wide as deep, h/Δx = 1.5, Wendland C2, particles of a jittered lattice, air above; the last lines a
//! tank whose spacing grows twentyfold downwards. Right side: water at rest, a wave and noise. Tolerance: 10⁻⁴ of the
//! largest divergence. `cold`: from zero, with a hierarchy made for this matrix; `warm`: from the pressure one step
//! before (particles have moved, the wave has gone on), with the hierarchy of that step. The sweep that it is compared
//! with is the compressible solver's over all pairs, `pair::momentum`, same particles, same run.

use sph_core::interactions::dissipation::DiffusivePair;
use sph_core::interactions::kernel::WendlandC2;
use sph_core::interactions::pair::{self, Constants, Gathered, Mean, Row};
use sph_core::projection::{Matrix, Preconditioner, PressureSolver, Stop};
use sph_core::wcsph::eos::Tait;
use sph_core::{Fluid, Kernel, Parameters, Seed, Walls, parallel};
use std::time::Instant;

const RATIO: f64 = 1.5;
/// Distances between particles vary by about this share of the spacing.
const JITTER: f64 = 0.2;

fn main() {
    let most: usize = std::env::args().nth(1).and_then(|a| a.parse().ok()).unwrap_or(500_000);
    println!("us a particle; /sweep: over one momentum sweep");
    println!(
        "{:>12} {:>9} {:>5} | {:>10} | {:>6} {:>5} {:>7} {:>6} | {:>6} {:>5} {:>7} {:>6}",
        "tank", "particles", "pairs", "by", "set up", "its", "cold", "/sweep", "keep", "its", "warm", "/sweep"
    );
    for n in [2_000, 8_000, 50_000, 200_000, 500_000].into_iter().filter(|&n| n <= most) {
        report("even", &even(n));
    }
    for width in [4.0, 16.0] {
        report("graded 1:20", &graded(width));
    }
}

/// Particles in rows over the depth 1 m: the top of each row and its spacing [m].
fn rows(width: f64, spacing: impl Fn(f64) -> f64) -> Vec<Seed> {
    let (mut top, mut seeds, mut dice) = (0.0, Vec::new(), Dice(1));
    while top < 1.0 {
        let count = (width / spacing(top)).round().max(1.0);
        let dx = width / count;
        for k in 0..count as usize {
            let at = [dx * (k as f64 + 0.5 + JITTER * dice.throw()), -top - dx * (0.5 + JITTER * dice.throw())];
            seeds.push(Seed { at, velocity: [0.0; 2], area: dx * dx, pressure: 0.0 });
        }
        top += dx;
    }
    seeds
}

fn even(n: usize) -> Vec<Seed> {
    rows(2.0, |_| (2.0 / n as f64).sqrt())
}

/// The spacing grows by a tenth a row, from 1/400 to 1/20 m.
fn graded(width: f64) -> Vec<Seed> {
    rows(width, |depth| (0.0025 + 0.1 * depth).min(0.05))
}

/// Evenly spread numbers from −½ to ½, the same every time (Marsaglia 2003).
struct Dice(u64);

impl Dice {
    fn throw(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
}

/// Best time of some, by particle [us].
fn best(repeats: usize, particles: usize, mut task: impl FnMut()) -> f64 {
    let times = (0..repeats).map(|_| {
        let start = Instant::now();
        task();
        start.elapsed().as_secs_f64()
    });
    times.fold(f64::INFINITY, f64::min) * 1e6 / particles as f64
}

fn report(name: &str, seeds: &[Seed]) {
    let (n, repeats) = (seeds.len(), (1_000_000 / seeds.len()).clamp(3, 40));
    let parameters =
        Parameters { smoothing_ratio: RATIO, ..Parameters::usual(Tait { rho0: 1000.0, c0: 50.0, gamma: 7.0 }) };
    let mut fluid = Fluid::new(parameters, seeds);
    fluid.initialise(&mut Walls::default()).expect("water at rest");
    let sweep = momentum_sweep(&fluid, repeats);
    let (a, b, scale) = system(&fluid, 0.0);
    let before = fluid.particles.clone();
    let mut dice = Dice(99);
    for k in 0..n {
        let reach = 0.05 * fluid.particles.h[k] / RATIO; // one step's distortion
        fluid.particles.x[k] += reach * dice.throw();
        fluid.particles.y[k] += reach * dice.throw();
    }
    let (a_next, b_next, scale_next) = system(&fluid, 0.1);
    let pinned = vec![false; n];
    let stop = Stop { tolerance: 1e-4, most_iterations: 5000 };
    let wanted = std::env::args().nth(2).unwrap_or_default();
    for kind in Preconditioner::ALL.into_iter().filter(|k| format!("{k:?}").to_lowercase().contains(&wanted)) {
        let (mut earlier, mut x, mut iterations) = (vec![0.0; n], vec![0.0; n], [0, 0]);
        let mut solver = PressureSolver::default();
        let set_up = best(repeats, n, || {
            solver = PressureSolver::with(kind);
            solver.prepare(&a, &before.x, &before.y, &before.h);
        });
        let cold = best(repeats, n, || {
            earlier.fill(0.0);
            let solved = solver.solve(&a, &[], &b, &scale, &pinned, &mut earlier, &stop).expect("converged");
            iterations[0] = solved.iterations;
        });
        let now = &fluid.particles;
        let keep = best(repeats, n, || solver.prepare(&a_next, &now.x, &now.y, &now.h));
        let warm = best(repeats, n, || {
            x.copy_from_slice(&earlier);
            let solved = solver.solve(&a_next, &[], &b_next, &scale_next, &pinned, &mut x, &stop).expect("converged");
            iterations[1] = solved.iterations;
        });
        let kept = kind == Preconditioner::Diagonal || solver.set_ups() == 1;
        assert!(kept, "the second step keeps the first's hierarchy");
        println!(
            "{name:>12} {n:>9} {:>5.1} | {:>10} | {set_up:>6.3} {:>5} {cold:>7.3} {:>6.2} | {keep:>6.3} {:>5} {warm:>7.3} {:>6.2}",
            a.values.len() as f64 / n as f64,
            format!("{kind:?}").to_lowercase(),
            iterations[0],
            (set_up + cold) / sweep,
            iterations[1],
            (keep + warm) / sweep,
        );
    }
    println!(
        "{name:>12} {n:>9} {:>5.1} | one momentum sweep: {sweep:.3}",
        fluid.search.fluid.pairs() as f64 / n as f64
    );
}

/// The compressible solver's momentum sweep over the same particles.
fn momentum_sweep(fluid: &Fluid, repeats: usize) -> f64 {
    let p = &fluid.particles;
    let row = |k: usize| {
        let area = p.mass[k] / p.rho[k];
        Row {
            x: p.x[k],
            y: p.y[k],
            u: p.u[k],
            v: p.v[k],
            p: fluid.derived.pressure[k],
            volume: area,
            fill: area,
            h: p.h[k],
        }
    };
    let rows: Vec<Row> = (0..p.len()).map(row).collect();
    let constants =
        Constants { gravity: [0.0, -9.81], rho0: 1000.0, c0: 50.0, delta: 0.1, alpha: 0.02, nu: 0.0, stretch: 0.0 };
    let mut out = vec![Gathered::default(); p.len()];
    best(repeats, p.len(), || {
        parallel::gather_into(&mut out, |k| {
            let near = fluid.search.fluid.of(k).map(|j| rows[j as usize]);
            pair::momentum::<f64, WendlandC2, DiffusivePair>(&rows[k], near, [].into_iter(), Mean, &constants, 0.0)
                .lanes()[0]
        });
    })
}

/// The compact Laplacian, a_ij = 2 V_i V_j w'/r, with a surface at y = 0 for which a linear pressure is exact; right
/// side and scale at a phase of the wave.
fn system(fluid: &Fluid, phase: f64) -> (Matrix, Vec<f64>, Vec<f64>) {
    let (p, n) = (&fluid.particles, fluid.particles.len());
    let area: Vec<f64> = (0..n).map(|k| p.mass[k] / p.rho[k]).collect();
    let mut a = Matrix { starts: vec![0], ..Matrix::default() };
    for i in 0..n {
        let mut sum = 0.0;
        for j in fluid.search.fluid.of(i) {
            let k = j as usize;
            let (dx, dy, h) = (p.x[i] - p.x[k], p.y[i] - p.y[k], 0.5 * (p.h[i] + p.h[k]));
            let weight = -2.0 * area[i] * area[k] * Kernel::WendlandC2.gradient_factor(dx.hypot(dy), h);
            if weight > 0.0 {
                a.columns.push(j);
                a.values.push(-weight);
                sum += weight;
            }
        }
        a.starts.push(a.columns.len());
        a.diagonal.push(sum + excess(p.y[i].min(-0.1 * p.h[i]), p.h[i], area[i]));
    }
    let mut dice = Dice(7);
    let pressure = |k: usize| {
        let (x, y) = (p.x[k], p.y[k].min(0.0));
        -1000.0 * 9.81 * y + 800.0 * ((6.0 * x - phase).cos() * (6.0 * y).exp() - 1.0)
    };
    let truth: Vec<f64> = (0..n).map(pressure).collect();
    let mut b: Vec<f64> = (0..n).map(|i| a.times(i, &truth)).collect();
    let largest = (0..n).map(|i| b[i].abs() / area[i]).fold(0.0, f64::max);
    for i in 0..n {
        b[i] += 0.1 * largest * area[i] * dice.throw();
    }
    let scale = area.iter().map(|v| v * largest).collect();
    (a, b, scale)
}

/// What a flat surface adds to the diagonal of a particle at depth −`y`: missing neighbours, at minus its pressure as
/// far as a linear pressure tells.
fn excess(y: f64, h: f64, area: f64) -> f64 {
    let dx = area.sqrt();
    let mut sum = 0.0;
    for row in 0..4 {
        for column in -4..=4 {
            let (rx, ry) = (dx * f64::from(column), dx * (f64::from(row) + 0.5) - y);
            sum -= 2.0 * area * area * Kernel::WendlandC2.gradient_factor(rx.hypot(ry), h) * ry / -y;
        }
    }
    sum
}
