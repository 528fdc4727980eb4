//! How far particles may be shifted per advective step (THEORY WC26).

use std::f64::consts::PI;

use crate::kernel::Kernel;

/// The largest gain times the largest relaxation rate [-]: 1 takes a wave away at once, 2 keeps its height.
const GAIN: f64 = 1.8;
/// Wave numbers that are tried in each direction.
const WAVE_NUMBERS: usize = 64;

/// Largest share of h² ∇C by which particles are shifted in an advective step [-].
pub(super) fn shift_gain(kernel: Kernel, smoothing_ratio: f64) -> f64 {
    GAIN / relaxation_rate(kernel, smoothing_ratio)
}

/// Largest rate at which −h² ∇C of a displaced square lattice of spacing `h / smoothing_ratio` brings it back [-]: over wave vectors k
/// along its axes and diagonals, with n = k/|k|, of h² V Σ_b (1 − cos k·r_b) n·(∇∇W)·n.
fn relaxation_rate(kernel: Kernel, smoothing_ratio: f64) -> f64 {
    let (spacing, reach) = (1.0 / smoothing_ratio, (2.0 * smoothing_ratio).ceil() as i32);
    let rows = move || (-reach..=reach).map(move |i| f64::from(i) * spacing);
    let neighbours: Vec<[f64; 2]> =
        rows().flat_map(|x| rows().map(move |y| [x, y])).filter(|at| *at != [0.0; 2]).collect();
    let rate = |[nx, ny]: [f64; 2], k: f64| -> f64 {
        let of = |&[x, y]: &[f64; 2]| {
            let along = nx * x + ny * y;
            (1.0 - (k * along).cos()) * curvature(kernel, x.hypot(y), along)
        };
        spacing * spacing * neighbours.iter().map(of).sum::<f64>()
    };
    let directions = [[1.0, 0.0], [0.5_f64.sqrt(), 0.5_f64.sqrt()]];
    let wave_numbers = (1..=WAVE_NUMBERS).map(|i| PI * smoothing_ratio * i as f64 / WAVE_NUMBERS as f64);
    wave_numbers.flat_map(|k| directions.map(|n| rate(n, k).abs())).fold(0.0, f64::max)
}

/// n·(∇∇W)·n at a distance `r` with n·r = `along`, for h = 1.
fn curvature(kernel: Kernel, r: f64, along: f64) -> f64 {
    const STEP: f64 = 1e-5;
    let slope = (kernel.gradient_factor(r + STEP, 1.0) - kernel.gradient_factor(r - STEP, 1.0)) / (2.0 * STEP);
    kernel.gradient_factor(r, 1.0) + slope * along * along / r
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ x² W of a kernel with h = 1.
    fn second_moment(kernel: Kernel) -> f64 {
        let n = 4000;
        let of = |i: usize| {
            let q = (i as f64 + 0.5) * 2.0 / n as f64;
            PI * q.powi(3) * kernel.value(q, 1.0) * 2.0 / n as f64
        };
        (0..n).map(of).sum()
    }

    /// The rate of a smooth kernel with many neighbours is that of a Gaussian with its second moment, 2/(e σ²): within some percent.
    #[test]
    fn narrow_kernels_relax_faster() {
        for (kernel, ratio) in [(Kernel::WendlandC2, 2.5), (Kernel::WendlandC4, 2.5), (Kernel::WendlandC6, 3.0)] {
            let (rate, gaussian) = (relaxation_rate(kernel, ratio), 2.0 / (1.0_f64.exp() * second_moment(kernel)));
            assert!((rate / gaussian - 1.0).abs() < 0.05, "{kernel:?}: {rate} against {gaussian}");
        }
    }
}
