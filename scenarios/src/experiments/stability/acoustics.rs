//! The largest stable step of an integrator for sound on a lattice (THEORY WC14, WC15).

use std::f64::consts::PI;

use nalgebra::{Matrix2, Matrix4, SMatrix};
use scene::{Integrator, Kernel};

use super::lattice::neighbours;

/// Growth of an amplitude per step below which a wave counts as stable [-].
const HARMLESS: f64 = 1e-4;
/// Wave numbers tried along each side of the Brillouin zone's eighth.
const WAVES: u32 = 8;
/// Resolution of the Courant number [-].
const RESOLUTION: f64 = 1e-3;
/// Largest Courant number searched [-].
const LARGEST: f64 = 4.0;
/// ‖Rⁿ‖^(1/n) is taken as the spectral radius of R at n = 2 to the power of this.
const SQUARINGS: u32 = 24;

/// The water that sound runs through.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Medium {
    pub kernel: Kernel,
    /// h/Δx [-].
    pub smoothing_ratio: f64,
    /// δ of WC4 [-].
    pub diffusion: f64,
}

/// What a wave does: both times the Courant number C = Δt c₀/h are per step.
#[derive(Clone, Copy)]
struct Wave {
    /// h |Σ V sin(k·r) ∇W| [-]: its frequency over c₀/h (WC14).
    frequency: f64,
    /// 2δ h² Σ V (1 − cos k·r) |F| [-]: the rate at which WC4 damps its density over c₀/h (WC14).
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

/// Spectral radius of a step for u' = θ r, r' = −θ u − d r (WC15); of Verlet's, the mean over the steps between two Euler steps.
fn growth(integrator: Integrator, euler_every: u32, theta: f64, d: f64) -> f64 {
    let one = Matrix2::identity();
    let rates = Matrix2::new(0.0, theta, -theta, -d);
    match integrator {
        Integrator::Symplectic => {
            let kick = Matrix2::new(1.0, 0.5 * theta, 0.0, 1.0);
            let compress = Matrix2::new(1.0, 0.0, -theta, 1.0 - d);
            spectral_radius(kick * compress * kick)
        }
        Integrator::PredictorCorrector => spectral_radius(one + rates + 0.5 * rates * rates),
        Integrator::Verlet if euler_every == 0 => spectral_radius(blocks(2.0 * rates, one, one, 0.0 * one)),
        Integrator::Verlet => {
            let (mut before, mut now) = (one, one + rates);
            for _ in 1..euler_every {
                (before, now) = (now, before + 2.0 * rates * now);
            }
            spectral_radius(now).powf(1.0 / f64::from(euler_every))
        }
        Integrator::Beeman => spectral_radius(beeman(rates)),
    }
}

/// LE4 for even steps: (q, Δt q̇⁻) ← (q + (5M q* + 8M q − Δt q̇⁻)/12, M q) with q* = q + (3M q − Δt q̇⁻)/2, q̇ = M q/Δt.
fn beeman(rates: Matrix2<f64>) -> Matrix4<f64> {
    let one = Matrix2::identity();
    let of_now = one + (13.0 / 12.0) * rates + (7.5 / 12.0) * rates * rates;
    let of_before = (-1.0 / 12.0) * one - (2.5 / 12.0) * rates;
    blocks(of_now, of_before, rates, 0.0 * one)
}

fn blocks(a: Matrix2<f64>, b: Matrix2<f64>, c: Matrix2<f64>, d: Matrix2<f64>) -> Matrix4<f64> {
    let mut whole = Matrix4::zeros();
    for (block, row, column) in [(a, 0, 0), (b, 0, 2), (c, 2, 0), (d, 2, 2)] {
        whole.fixed_view_mut::<2, 2>(row, column).copy_from(&block);
    }
    whole
}

/// Spectral radius by Gelfand's formula; each square is scaled to the norm 1.
fn spectral_radius<const N: usize>(matrix: SMatrix<f64, N, N>) -> f64 {
    let (mut power, mut logarithm, mut share) = (matrix, 0.0, 1.0);
    for _ in 0..SQUARINGS {
        let size = power.amax();
        if size == 0.0 {
            return 0.0;
        }
        logarithm += share * size.ln();
        power *= 1.0 / size;
        power *= power;
        share *= 0.5;
    }
    (logarithm + share * power.amax().ln()).exp()
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

    /// WC12: 0.8 ran and 1.2 blew up; without diffusion the wave alone limits the step.
    #[test]
    fn diffusion_takes_part_in_the_limit() {
        let water = |diffusion: f64| Medium { kernel: Kernel::WendlandC2, smoothing_ratio: 1.5, diffusion };
        let [with, without] = [0.3, 0.0].map(|d| largest_courant(Integrator::Symplectic, 0, water(d)));
        assert!((0.8..1.2).contains(&with) && without > 1.5 * with, "{with}, {without}");
    }
}
