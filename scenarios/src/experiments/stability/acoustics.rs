//! How long a step of an integrator may be for sound on a lattice (THEORY M1–M3).

use std::f64::consts::PI;

use sph_core::{Integrator, Kernel};

use super::lattice::neighbours;

/// Growth of an amplitude in a step that counts as none [-].
const HARMLESS: f64 = 1e-4;
/// Wave numbers tried along each side of the Brillouin zone's eighth.
const WAVES: u32 = 8;
/// Courant numbers are told apart by this.
const RESOLUTION: f64 = 1e-3;
/// Largest Courant number looked at.
const LARGEST: f64 = 4.0;
/// ‖Rⁿ‖^(1/n) is taken as the spectral radius of R at n = 2 to the power of this.
const SQUARINGS: u32 = 24;

/// The water that sound runs through.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Medium {
    pub kernel: Kernel,
    /// h/Δx [-].
    pub smoothing_ratio: f64,
    /// δ of E5 [-].
    pub diffusion: f64,
}

/// What a wave does: both times the Courant number C = Δt c₀/h are per step.
#[derive(Clone, Copy)]
struct Wave {
    /// h |Σ V sin(k·r) ∇W| [-]: its frequency over c₀/h (M1).
    frequency: f64,
    /// 2δ h² Σ V (1 − cos k·r) |F| [-]: the rate at which E5 damps its density over c₀/h (M2).
    damping: f64,
}

/// The largest Courant number Δt c₀/h below which no wave on the lattice grows.
pub(super) fn largest_courant(integrator: Integrator, euler_every: u32, medium: Medium) -> f64 {
    let waves = waves(medium);
    let grows = |courant: f64| {
        waves
            .iter()
            .any(|w| growth(integrator, euler_every, courant * w.frequency, courant * w.damping) > 1.0 + HARMLESS)
    };
    let steps = (LARGEST / RESOLUTION) as u32;
    let coarse = 20;
    let Some(first) = (1..=steps / coarse).find(|&k| grows(RESOLUTION * f64::from(k * coarse))) else { return LARGEST };
    let range = ((first - 1) * coarse + 1)..=(first * coarse);
    let fine = range.into_iter().find(|&k| grows(RESOLUTION * f64::from(k))).unwrap_or(first * coarse);
    RESOLUTION * f64::from(fine - 1)
}

fn waves(medium: Medium) -> Vec<Wave> {
    let Medium { kernel, smoothing_ratio: h, diffusion } = medium;
    let around = neighbours(kernel, h);
    let numbers = (0..=WAVES).flat_map(|i| (0..=i).map(move |j| [i, j]));
    let wave = |[i, j]: [u32; 2]| {
        let k = [i, j].map(|n| PI * f64::from(n) / f64::from(WAVES));
        let (mut gradient, mut damping) = ([0.0; 2], 0.0);
        for n in &around {
            let phase = k[0] * n.at[0] + k[1] * n.at[1];
            (0..2).for_each(|c| gradient[c] += phase.sin() * n.grad_factor * n.at[c]);
            damping -= (1.0 - phase.cos()) * n.grad_factor;
        }
        Wave { frequency: h * gradient[0].hypot(gradient[1]), damping: 2.0 * diffusion * h * h * damping }
    };
    numbers.filter(|n| *n != [0, 0]).map(wave).collect()
}

/// Spectral radius of a step for u' = θ r, r' = −θ u − d r (M3); of Verlet's, the mean over the steps between two Euler steps.
fn growth(integrator: Integrator, euler_every: u32, theta: f64, d: f64) -> f64 {
    let one = Matrix::<2>::one();
    let rates = Matrix([[0.0, theta], [-theta, -d]]);
    match integrator {
        Integrator::Symplectic => {
            let kick = Matrix([[1.0, 0.5 * theta], [0.0, 1.0]]);
            let compress = Matrix([[1.0, 0.0], [-theta, 1.0 - d]]);
            kick.times(&compress).times(&kick).radius()
        }
        Integrator::PredictorCorrector => one.plus(&rates, 1.0).plus(&rates.times(&rates), 0.5).radius(),
        Integrator::Verlet if euler_every == 0 => leap(&rates).radius(),
        Integrator::Verlet => {
            let (mut before, mut now) = (one, one.plus(&rates, 1.0));
            for _ in 1..euler_every {
                (before, now) = (now, before.plus(&rates.times(&now), 2.0));
            }
            now.radius().powf(1.0 / f64::from(euler_every))
        }
        Integrator::Beeman => beeman(&rates).radius(),
    }
}

/// Verlet's leap: (q, q⁻) ← (q⁻ + 2Δt q̇, q).
fn leap(rates: &Matrix<2>) -> Matrix<4> {
    Matrix::of_blocks([[rates.scaled(2.0), Matrix::one()], [Matrix::one(), rates.scaled(0.0)]])
}

/// L2 for even steps: (q, Δt q̇⁻) ← (q + (5M q* + 8M q − Δt q̇⁻)/12, M q) with q* = q + (3M q − Δt q̇⁻)/2, q̇ = M q/Δt.
fn beeman(rates: &Matrix<2>) -> Matrix<4> {
    let one = Matrix::<2>::one();
    let of_now = one.plus(rates, 13.0 / 12.0).plus(&rates.times(rates), 7.5 / 12.0);
    let of_before = one.scaled(-1.0 / 12.0).plus(rates, -2.5 / 12.0);
    Matrix::of_blocks([[of_now, of_before], [*rates, one.scaled(0.0)]])
}

/// A small square matrix.
#[derive(Clone, Copy)]
struct Matrix<const N: usize>([[f64; N]; N]);

impl<const N: usize> Matrix<N> {
    fn one() -> Self {
        Matrix(std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 })))
    }

    fn scaled(&self, factor: f64) -> Self {
        Matrix(self.0.map(|row| row.map(|a| factor * a)))
    }

    /// self + factor other.
    fn plus(&self, other: &Self, factor: f64) -> Self {
        Matrix(std::array::from_fn(|i| std::array::from_fn(|j| self.0[i][j] + factor * other.0[i][j])))
    }

    fn times(&self, other: &Self) -> Self {
        let entry = |i: usize, j: usize| (0..N).map(|k| self.0[i][k] * other.0[k][j]).sum();
        Matrix(std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))))
    }

    /// Spectral radius by Gelfand's formula, each square brought back to size 1.
    fn radius(&self) -> f64 {
        let size = |m: &Self| m.0.iter().flatten().fold(0.0_f64, |largest, a| largest.max(a.abs()));
        let (mut power, mut logarithm) = (*self, 0.0);
        let mut share = 1.0;
        for _ in 0..SQUARINGS {
            let s = size(&power);
            if s == 0.0 {
                return 0.0;
            }
            logarithm += share * s.ln();
            power = power.scaled(1.0 / s);
            power = power.times(&power);
            share *= 0.5;
        }
        (logarithm + share * size(&power).ln()).exp()
    }
}

impl Matrix<4> {
    fn of_blocks(blocks: [[Matrix<2>; 2]; 2]) -> Self {
        Matrix(std::array::from_fn(|i| std::array::from_fn(|j| blocks[i / 2][j / 2].0[i % 2][j % 2])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limit_of_wave(integrator: Integrator, every: u32, theta: f64, d: f64) -> f64 {
        let grows = |c: f64| growth(integrator, every, c * theta, c * d) > 1.0 + 1e-6;
        (1..5000).map(|k| f64::from(k) * 1e-3).find(|&c| grows(c)).unwrap_or(5.0)
    }

    /// Known intervals of absolute stability: leapfrog's 2 and Euler's 2 in the kick–drift–kick, the midpoint rule's real 2,
    /// the real 2.4 and imaginary 1.2 of Adams, Bashforth & Moulton's of second and third order, leapfrog's imaginary 1.
    #[test]
    fn each_integrator_has_its_known_interval() {
        for (integrator, every, theta, d, known) in [
            (Integrator::Symplectic, 0, 1.0, 0.0, 2.0),
            (Integrator::Symplectic, 0, 0.0, 1.0, 2.0),
            (Integrator::PredictorCorrector, 0, 0.0, 1.0, 2.0),
            (Integrator::Beeman, 0, 0.0, 1.0, 2.4),
            (Integrator::Beeman, 0, 1.0, 0.0, 1.2),
            (Integrator::Verlet, 0, 1.0, 0.0, 1.0),
            (Integrator::Verlet, 2, 0.0, 1.0, 1.0),
        ] {
            let found = limit_of_wave(integrator, every, theta, d);
            assert!((found - known).abs() < 0.02, "{integrator:?}, {every}: {found}, known {known}");
        }
    }

    /// E17: 0.8 ran and 1.2 blew up; without diffusion the wave alone limits the step.
    #[test]
    fn diffusion_takes_part_in_the_limit() {
        let water = |diffusion: f64| Medium { kernel: Kernel::WendlandC2, smoothing_ratio: 1.5, diffusion };
        let [with, without] = [0.3, 0.0].map(|d| largest_courant(Integrator::Symplectic, 0, water(d)));
        assert!((0.8..1.2).contains(&with) && without > 1.5 * with, "{with}, {without}");
    }
}
