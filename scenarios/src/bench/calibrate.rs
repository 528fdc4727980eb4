//! What the machine can do: memory bandwidth and arithmetic, for numbers of other machines to be compared by.

use std::hint::black_box;
use std::time::Instant;

use serde::Serialize;
use sph_core::parallel;

/// Length of each array of the triad: three of them are larger than the caches of most processors.
const TRIAD: usize = 8 << 20;
/// Elements that a thread takes in one go.
const PIECE: usize = 1 << 14;
/// Independent sums of the arithmetic: enough to hide the latency of an addition behind others.
const SUMS: usize = 32;
/// Multiplications and additions to each of them.
const REPEATS: usize = 1 << 19;
/// Times that each is measured; the best counts.
const BEST_OF: usize = 4;

/// One thread against all of them.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct OneAndAll {
    /// One thread.
    pub one: f64,
    /// All threads.
    pub all: f64,
}

/// What the machine can do.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Calibration {
    /// STREAM triad a ← b + s c (McCalpin 1995), 24 bytes an element [GB/s].
    pub triad_gb_per_s: OneAndAll,
    /// x ← x a + b on sums in registers, with the instructions that this program is built for [GFLOP/s].
    pub multiply_add_gflop_per_s: OneAndAll,
    /// Whether multiplication and addition are one instruction in this build.
    pub fused: bool,
}

/// Measure with one thread and with `threads`.
pub fn calibrate(threads: usize) -> Calibration {
    let both = |measure: fn(usize) -> f64| OneAndAll {
        one: parallel::on_threads(1, || measure(1)),
        all: parallel::on_threads(threads, || measure(threads)),
    };
    Calibration {
        triad_gb_per_s: both(|_| triad()),
        multiply_add_gflop_per_s: both(multiply_add),
        fused: cfg!(target_feature = "fma"),
    }
}

/// Shortest time of some [s].
fn best(mut task: impl FnMut()) -> f64 {
    let times = (0..BEST_OF).map(|_| {
        let start = Instant::now();
        task();
        start.elapsed().as_secs_f64()
    });
    times.fold(f64::INFINITY, f64::min)
}

fn triad() -> f64 {
    let (b, c, s) = (vec![1.0; TRIAD], vec![2.0; TRIAD], black_box(3.0));
    let mut a = vec![0.0; TRIAD];
    let seconds = best(|| {
        parallel::update_pieces(&mut a, PIECE, |piece, a| {
            let from = piece * PIECE;
            let (b, c) = (&b[from..from + a.len()], &c[from..from + a.len()]);
            a.iter_mut().zip(b).zip(c).for_each(|((a, b), c)| *a = b + s * c);
        });
        black_box(&a);
    });
    24.0 * TRIAD as f64 / seconds * 1e-9
}

fn multiply_add(threads: usize) -> f64 {
    let mut sums = vec![[1.0_f64; SUMS]; threads];
    let (a, b) = (black_box(0.999_999), black_box(1e-6));
    let seconds = best(|| {
        parallel::update_pieces(&mut sums, 1, |_, sums| {
            let mut x = sums[0];
            for _ in 0..REPEATS {
                for x in &mut x {
                    *x = if cfg!(target_feature = "fma") { x.mul_add(a, b) } else { *x * a + b };
                }
            }
            sums[0] = x;
        });
        black_box(&sums);
    });
    (2 * SUMS * REPEATS * threads) as f64 / seconds * 1e-9
}
