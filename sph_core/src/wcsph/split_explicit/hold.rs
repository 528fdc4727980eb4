//! Taking the weights of the pairs that are held (THEORY WC23).

use std::marker::PhantomData;

use super::candidates::{BLOCK, Candidates};
use super::held_pairs::{HeldChunk, HeldPairs, OfBlock, Own, by_distance, lanes, of_targets};
use crate::interactions::dissipation::{Dissipation, PairDissipation, WithPairs, with_pairs};
use crate::interactions::geometry::{MeanScale, PairConstants, PairGeometry, ScaleRule};
use crate::interactions::packed_particle::PackedParticle;
use crate::kernel::{self, Kernel, Shape};
use crate::neighbours::lists::Lists;
use crate::parallel::{self, CHUNK};
use crate::simd::{SimdReal, Task};

/// Take the geometry of the packed particles, which move with the water and with the `shift_velocity` [m/s] (WC26).
pub(super) fn hold(
    HeldPairs { chunks, own, lists: known }: &mut HeldPairs,
    (kernel, dissipation, simd): (Kernel, Dissipation, bool),
    (fluid, shift_velocity): (&[PackedParticle], &[[f64; 2]]),
    (lists, number): (&Lists, u64),
    constants: PairConstants,
) {
    let n = lists.targets();
    let lists = (*known != Some(number)).then_some(lists);
    *known = Some(number);
    chunks.resize(n.div_ceil(CHUNK), HeldChunk::default());
    own.resize(n, Own::default());
    with_pairs(kernel, dissipation, Hold { fluid, shift_velocity, lists, constants, simd, chunks, own });
}

/// Square of a distance that rounding does not take for one within reach [-].
const JUST_BEYOND: f64 = 1.0 + 1e-9;

struct Hold<'a> {
    fluid: &'a [PackedParticle],
    shift_velocity: &'a [[f64; 2]],
    /// Those that the candidates are not yet taken from.
    lists: Option<&'a Lists>,
    constants: PairConstants,
    simd: bool,
    chunks: &'a mut [HeldChunk],
    own: &'a mut [Own],
}

impl WithPairs for Hold<'_> {
    fn with<K: Shape, D: PairDissipation>(self) {
        let Hold { fluid, shift_velocity, lists, constants, simd, chunks, own } = self;
        let pieces: Vec<_> = chunks.iter_mut().zip(own.chunks_mut(CHUNK)).collect();
        parallel::each_piece(pieces, |c, (held, own)| {
            let (first, pairs) = (c * CHUNK, PhantomData);
            if let Some(lists) = lists {
                held.candidates = Candidates::of(lists, first, own.len(), |k| fluid[k].h);
            }
            let chunk = HoldChunk::<K, D> { fluid, shift_velocity, constants, first, held, own, pairs };
            kernel::run_sums::<K, _>(simd, chunk);
        });
    }
}

struct HoldChunk<'a, K, D> {
    fluid: &'a [PackedParticle],
    shift_velocity: &'a [[f64; 2]],
    constants: PairConstants,
    first: usize,
    held: &'a mut HeldChunk,
    own: &'a mut [Own],
    pairs: PhantomData<(K, D)>,
}

impl<K: Shape, D: PairDissipation> Task for HoldChunk<'_, K, D> {
    type Out = ();
    #[inline(always)]
    fn run<R: SimdReal>(self, zero: R) {
        let HoldChunk { fluid, shift_velocity, constants, first, held, own, .. } = self;
        let candidates = std::mem::take(&mut held.candidates);
        let Candidates { start, found, alike } = &candidates;
        let weight = constants.gravity.map(|g| zero.of(constants.rho0 * g));
        held.clear(found.len(), !D::LENGTH_IS_DISTANCE);
        let mut kept = 0;
        for (b, own) in own.chunks_mut(BLOCK).enumerate() {
            let at = |l: usize| first + b * BLOCK + (l * R::WIDTH).min(BLOCK - R::WIDTH);
            let targets: [PackedParticle<R>; BLOCK] =
                std::array::from_fn(|l| PackedParticle::targets(fluid, at(l), zero));
            let own_shift: [[R; 2]; BLOCK] = std::array::from_fn(|l| {
                [0, 1].map(|i| zero.each(|k| shift_velocity[(at(l) + k).min(shift_velocity.len() - 1)][i]))
            });
            let mut uniform = [MeanScale.of::<K>(targets[0].h, targets[0].h); BLOCK];
            for l in 0..BLOCK / R::WIDTH {
                uniform[l] = MeanScale.of::<K>(targets[l].h, targets[l].h);
            }
            let mut sums = [[zero; 4]; BLOCK];
            let mut rates = [[zero; 3]; BLOCK];
            for &(j, meets) in &found[start[b] as usize..start[b + 1] as usize] {
                let (row, [shift_u, shift_v]) = (&fluid[j as usize], shift_velocity[j as usize]);
                let mut within_reach = 0;
                for a in &targets[..BLOCK / R::WIDTH] {
                    let (dx, dy, reach) = (a.x - zero.of(row.x), a.y - zero.of(row.y), a.h + zero.of(row.h));
                    within_reach |= dx.mul_add(dx, dy * dy).less(reach * reach * zero.of(JUST_BEYOND));
                }
                if within_reach == 0 {
                    continue; // lists reach farther than the kernel
                }
                let (mut gradient, mut diffusion) = ([OfBlock::default(); 2], OfBlock::default());
                let mut offsets = [[zero; 2]; BLOCK];
                for l in 0..BLOCK / R::WIDTH {
                    let (a, lane) = (&targets[l], l * R::WIDTH);
                    let (dx, dy) = (a.x - zero.of(row.x), a.y - zero.of(row.y));
                    let size = if alike[b] { uniform[l] } else { MeanScale.of::<K>(a.h, zero.of(row.h)) };
                    let ab = PairGeometry::new::<K>(dx, dy, size);
                    let share = (a.volume * zero.of(row.volume)).mask(u32::from(meets) >> lane);
                    let flux = share * ab.grad_factor;
                    let apart = [a.u - zero.of(row.u), a.v - zero.of(row.v)];
                    let moving =
                        [own_shift[l][0] - zero.of(shift_u) + apart[0], own_shift[l][1] - zero.of(shift_v) + apart[1]];
                    let [rate_x, rate_y] = ab.gradient_rate::<K>(share, flux, moving);
                    let (both, [opening, push_x, push_y]) = (a.p + zero.of(row.p), rates[l]);
                    let opening = apart[0].mul_add(rate_x, apart[1].mul_add(rate_y, opening));
                    rates[l] = [opening, both.mul_add(rate_x, push_x), both.mul_add(rate_y, push_y)];
                    let (x, y) = ((flux * dx).to_single(), (flux * dy).to_single());
                    gradient[0].0[lane..lane + R::WIDTH].copy_from_slice(&x[..R::WIDTH]);
                    gradient[1].0[lane..lane + R::WIDTH].copy_from_slice(&y[..R::WIDTH]);
                    if !D::LENGTH_IS_DISTANCE {
                        let d = (D::length(&ab) * flux).to_single();
                        diffusion.0[lane..lane + R::WIDTH].copy_from_slice(&d[..R::WIDTH]);
                    }
                    offsets[l] = [dx, dy];
                }
                if D::LENGTH_IS_DISTANCE {
                    diffusion = by_distance(&gradient);
                }
                for l in 0..BLOCK / R::WIDTH {
                    let lane = l * R::WIDTH;
                    let (x, y) = (lanes(zero, &gradient[0], lane), lanes(zero, &gradient[1], lane));
                    let d = lanes(zero, &diffusion, lane);
                    let hydrostatic = d * weight[0].mul_add(offsets[l][0], weight[1] * offsets[l][1]);
                    let [sx, sy, sd, sw] = sums[l];
                    sums[l] = [sx + x, sy + y, sd + d, sw + hydrostatic];
                }
                (held.neighbour[kept], held.gradient[kept]) = (j, gradient);
                if !D::LENGTH_IS_DISTANCE {
                    held.diffusion[kept] = diffusion;
                }
                kept += usize::from(diffusion.0.iter().any(|&weight| weight != 0.0)); // else the next is written over it
            }
            held.start.push(kept as u32);
            let sums: [[f64; BLOCK]; 4] = std::array::from_fn(|i| of_targets(sums.map(|sum| sum[i])));
            let rates: [[f64; BLOCK]; 3] = std::array::from_fn(|i| of_targets(rates.map(|rate| rate[i])));
            for (k, own) in own.iter_mut().enumerate() {
                let per_volume = 1.0 / fluid[first + b * BLOCK + k].volume;
                let ([x, y, d, w], [opening_rate, push_x, push_y]) = (sums.map(|of| of[k]), rates.map(|of| of[k]));
                let push_rate = [push_x, push_y];
                *own = Own { gradient: [x, y], diffusion: d, weight: w, per_volume, opening_rate, push_rate };
            }
        }
        held.truncate(kept);
        held.candidates = candidates;
    }
}
