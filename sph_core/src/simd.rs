//! One number, or the same number of four targets side by side: the pair physics is written once for both.
//!
//! `run` does a task with the lanes this processor has: four f64 (AVX2 and FMA, found at run time), else one. With AVX-512 the
//! same four lanes have 32 registers, twice as many: the sums of the momentum equation then stay in registers. Every lane
//! sums its own target's neighbours in the list's order, so lanes never change what is added to what.

use std::ops::{Add, Div, Mul, Sub};

/// Targets that neighbour lists keep together, one lane each.
pub const LANES: usize = 4;

/// A number of the pair physics: an f64, or one of each of [`LANES`] targets.
pub trait SimdReal:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Send + Sync
{
    /// Targets it holds: 1 or [`LANES`].
    const WIDTH: usize;
    /// `x` for every target.
    fn of(self, x: f64) -> Self;
    /// `of(k)` for target k of [`SimdReal::WIDTH`].
    fn each(self, of: impl FnMut(usize) -> f64) -> Self;
    /// The first [`SimdReal::WIDTH`] of `single`, at least this number.
    fn widened(self, single: &[f32]) -> Self;
    /// What the first [`SimdReal::WIDTH`] targets have, rounded to single precision.
    fn to_single(self) -> [f32; LANES];
    /// What the first [`SimdReal::WIDTH`] targets have.
    fn lanes(self) -> [f64; LANES];
    /// self · b + c, rounded once where the lanes can.
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// √self.
    fn sqrt(self) -> Self;
    /// The lesser.
    fn min(self, b: Self) -> Self;
    /// The greater.
    fn max(self, b: Self) -> Self;
    /// e^self.
    fn exp(self) -> Self;
    /// Bit k set where target k has self < b.
    fn less(self, b: Self) -> u32;
    /// self where its target's bit is set, else 0.
    fn mask(self, bits: u32) -> Self;
    /// `then` where self < limit, else `otherwise`.
    fn below(self, limit: Self, then: Self, otherwise: Self) -> Self;
}

impl SimdReal for f64 {
    const WIDTH: usize = 1;
    #[inline(always)]
    fn of(self, x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn each(self, mut of: impl FnMut(usize) -> f64) -> f64 {
        of(0)
    }
    #[inline(always)]
    fn widened(self, single: &[f32]) -> f64 {
        f64::from(single[0])
    }
    #[inline(always)]
    fn to_single(self) -> [f32; LANES] {
        [self as f32; LANES]
    }
    #[inline(always)]
    fn lanes(self) -> [f64; LANES] {
        [self; LANES]
    }
    #[inline(always)]
    fn mul_add(self, b: f64, c: f64) -> f64 {
        self * b + c // a fused one is a call of the mathematics library where the processor has none
    }
    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn min(self, b: f64) -> f64 {
        f64::min(self, b)
    }
    #[inline(always)]
    fn max(self, b: f64) -> f64 {
        f64::max(self, b)
    }
    #[inline(always)]
    fn exp(self) -> f64 {
        f64::exp(self)
    }
    #[inline(always)]
    fn less(self, b: f64) -> u32 {
        (self < b) as u32
    }
    #[inline(always)]
    fn mask(self, bits: u32) -> f64 {
        if bits & 1 == 1 { self } else { 0.0 }
    }
    #[inline(always)]
    fn below(self, limit: f64, then: f64, otherwise: f64) -> f64 {
        if self < limit { then } else { otherwise }
    }
}

/// A task over numbers of any width.
pub(crate) trait Task {
    /// What comes back.
    type Out;
    /// Do it with numbers like `zero`. To be inlined, so that it is compiled for the processor found.
    fn run<R: SimdReal>(self, zero: R) -> Self::Out;
}

/// Do `task` as wide as this processor can, or one target at a time where `simd` is false.
#[inline]
pub(crate) fn run<T: Task>(simd: bool, task: T) -> T::Out {
    run_wide::<true, T>(simd, task)
}

/// [`run`] with a copy of `task` for the registers of AVX-512, or without.
#[inline]
pub(crate) fn run_wide<const AVX512: bool, T: Task>(simd: bool, task: T) -> T::Out {
    #[cfg(target_arch = "x86_64")]
    if AVX512 && let Some(processor) = pulp::x86::V4::try_new().filter(|_| simd) {
        return processor.vectorize(
            #[inline(always)]
            || task.run(avx2::Four::zero(*processor)),
        );
    }
    #[cfg(target_arch = "x86_64")]
    if let Some(processor) = pulp::x86::V3::try_new().filter(|_| simd) {
        return processor.vectorize(
            #[inline(always)]
            || task.run(avx2::Four::zero(processor)),
        );
    }
    let _ = simd;
    task.run(0.0)
}

/// Do `task`, compiled for the processor found: plain loops over slices then go as wide as it can.
#[inline(always)]
pub(crate) fn with_simd<T>(task: impl FnOnce() -> T) -> T {
    #[cfg(target_arch = "x86_64")]
    if let Some(processor) = pulp::x86::V3::try_new() {
        return processor.vectorize(task);
    }
    task()
}

#[cfg(target_arch = "x86_64")]
mod avx2 {
    use std::arch::x86_64::{__m256d, _CMP_LT_OQ};
    use std::ops::{Add, Div, Mul, Sub};

    use pulp::{cast, f64x4, x86::V3};

    use super::{LANES, SimdReal};

    /// Four f64, and the proof that this processor computes on them at once.
    #[derive(Clone, Copy)]
    pub(crate) struct Four(V3, f64x4);

    impl Four {
        #[inline(always)]
        pub(crate) fn zero(processor: V3) -> Four {
            Four(processor, processor.splat_f64x4(0.0))
        }
        #[inline(always)]
        fn with(self, b: Four, of: impl FnOnce(V3, __m256d, __m256d) -> __m256d) -> Four {
            Four(self.0, cast(of(self.0, cast(self.1), cast(b.1))))
        }
    }

    impl Add for Four {
        type Output = Four;
        #[inline(always)]
        fn add(self, b: Four) -> Four {
            self.with(b, |on, x, y| on.avx._mm256_add_pd(x, y))
        }
    }
    impl Sub for Four {
        type Output = Four;
        #[inline(always)]
        fn sub(self, b: Four) -> Four {
            self.with(b, |on, x, y| on.avx._mm256_sub_pd(x, y))
        }
    }
    impl Mul for Four {
        type Output = Four;
        #[inline(always)]
        fn mul(self, b: Four) -> Four {
            self.with(b, |on, x, y| on.avx._mm256_mul_pd(x, y))
        }
    }
    impl Div for Four {
        type Output = Four;
        #[inline(always)]
        fn div(self, b: Four) -> Four {
            self.with(b, |on, x, y| on.avx._mm256_div_pd(x, y))
        }
    }

    /// All bits of the lanes chosen.
    const CHOSEN: [[u64; LANES]; 16] = {
        let mut table = [[0; LANES]; 16];
        let mut k = 0;
        while k < 16 * LANES {
            if (k / LANES) >> (k % LANES) & 1 == 1 {
                table[k / LANES][k % LANES] = u64::MAX;
            }
            k += 1;
        }
        table
    };

    impl SimdReal for Four {
        const WIDTH: usize = LANES;
        #[inline(always)]
        fn of(self, x: f64) -> Four {
            Four(self.0, self.0.splat_f64x4(x))
        }
        #[inline(always)]
        fn each(self, mut of: impl FnMut(usize) -> f64) -> Four {
            Four(self.0, f64x4(of(0), of(1), of(2), of(3)))
        }
        #[inline(always)]
        fn widened(self, single: &[f32]) -> Four {
            let four: &[f32; LANES] = single.first_chunk().expect("as many as there are lanes");
            Four(self.0, cast(self.0.avx._mm256_cvtps_pd(cast(*four))))
        }
        #[inline(always)]
        fn to_single(self) -> [f32; LANES] {
            cast(self.0.avx._mm256_cvtpd_ps(cast(self.1)))
        }
        #[inline(always)]
        fn lanes(self) -> [f64; LANES] {
            cast(self.1)
        }
        #[inline(always)]
        fn mul_add(self, b: Four, c: Four) -> Four {
            Four(self.0, self.0.mul_add_f64x4(self.1, b.1, c.1))
        }
        #[inline(always)]
        fn sqrt(self) -> Four {
            Four(self.0, self.0.sqrt_f64x4(self.1))
        }
        #[inline(always)]
        fn min(self, b: Four) -> Four {
            self.with(b, |on, x, y| on.avx._mm256_min_pd(x, y))
        }
        #[inline(always)]
        fn max(self, b: Four) -> Four {
            self.with(b, |on, x, y| on.avx._mm256_max_pd(x, y))
        }
        #[inline(always)]
        fn exp(self) -> Four {
            let f64x4(a, b, c, d) = self.1;
            Four(self.0, f64x4(a.exp(), b.exp(), c.exp(), d.exp()))
        }
        #[inline(always)]
        fn less(self, b: Four) -> u32 {
            let on = self.0.avx;
            on._mm256_movemask_pd(on._mm256_cmp_pd::<_CMP_LT_OQ>(cast(self.1), cast(b.1))) as u32
        }
        #[inline(always)]
        fn mask(self, bits: u32) -> Four {
            let chosen: f64x4 = cast(CHOSEN[bits as usize & 15]);
            self.with(Four(self.0, chosen), |on, x, y| on.avx._mm256_and_pd(x, y))
        }
        #[inline(always)]
        fn below(self, limit: Four, then: Four, otherwise: Four) -> Four {
            let on = self.0.avx;
            let less = on._mm256_cmp_pd::<_CMP_LT_OQ>(cast(self.1), cast(limit.1));
            Four(self.0, cast(on._mm256_blendv_pd(cast(otherwise.1), cast(then.1), less)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every operation on lanes is the operation on each lane.
    struct Operations([f64; LANES], [f64; LANES]);

    impl Task for Operations {
        type Out = Vec<[f64; LANES]>;
        #[inline(always)]
        fn run<R: SimdReal>(self, zero: R) -> Self::Out {
            let mut rows = vec![[0.0; LANES]; 13];
            for first in (0..LANES).step_by(R::WIDTH) {
                let (a, b) = (zero.each(|k| self.0[first + k]), zero.each(|k| self.1[first + k]));
                let bits = |bits: u32| zero.each(|k| f64::from(bits >> k & 1));
                let found = [
                    a + b,
                    a - b,
                    a * b,
                    a / b,
                    a.mul_add(b, a),
                    (a * a).sqrt(),
                    a.min(b),
                    a.max(b),
                    a.exp(),
                    bits(a.less(b)),
                    a.mask(5 >> (first % LANES)),
                    a.below(b, a.of(7.0), b),
                    a.of(2.5),
                ];
                for (row, value) in rows.iter_mut().zip(found) {
                    row[first..first + R::WIDTH].copy_from_slice(&value.lanes()[..R::WIDTH]);
                }
            }
            rows
        }
    }

    #[test]
    fn lanes_do_what_single_numbers_do() {
        let (a, b) = ([1.5, -2.25, 0.5, 3.0], [0.25, 4.0, 0.5, -1.0]); // products of these are exact
        let (one, four) = (run(false, Operations(a, b)), run(true, Operations(a, b)));
        assert_eq!(one, four);
    }
}
