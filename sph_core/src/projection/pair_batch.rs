//! The neighbours of a cluster of targets, and the sums of one target over them, several pairs at once.

use crate::interactions::geometry::PairConstants;
use crate::interactions::kernel::Shape;
use crate::interactions::packed_particle::PackedParticle;
use crate::interactions::simd::{LANES, SimdReal};
use crate::neighbours::lists::Lists;

/// Who lies within the support of each target of a cluster.
#[derive(Clone, Debug, Default)]
pub(crate) struct ClusterPairs {
    near: [Vec<u32>; LANES],
    count: [usize; LANES],
}

impl ClusterPairs {
    /// Those of the targets from `first` on; no target is its own neighbour.
    #[inline(always)]
    pub fn find<R: SimdReal>(&mut self, lists: &Lists, first: usize, rows: &[PackedParticle], zero: R) {
        let ClusterPairs { near, count } = self;
        let listed = lists.cluster(first);
        let most = listed.len() + 1; // one place more: written, never kept
        near.iter_mut().filter(|near| near.len() < most).for_each(|near| near.resize(most, 0));
        *count = [0; LANES];
        let at: [PackedParticle; LANES] = std::array::from_fn(|k| rows[(first + k).min(rows.len() - 1)]);
        for entry in listed {
            let (j, mut met) = (entry.index(), entry.bits());
            let target = (j as usize).wrapping_sub(first);
            if target < LANES {
                met &= !(1 << target);
            }
            let b = &rows[j as usize];
            let mut within = 0;
            for lane in (0..LANES).step_by(R::WIDTH) {
                let dx = zero.each(|k| at[lane + k].x) - zero.of(b.x);
                let dy = zero.each(|k| at[lane + k].y) - zero.of(b.y);
                let h = zero.of(0.5) * (zero.each(|k| at[lane + k].h) + zero.of(b.h));
                within |= (dx * dx + dy * dy).less(zero.of(4.0) * h * h) << lane;
            }
            for lane in 0..LANES {
                // written in any case, and over again by the next where this one is too far: no branch
                near[lane][count[lane]] = j;
                count[lane] += (within & met) as usize >> lane & 1;
            }
        }
    }

    /// Those of the target in `lane`.
    #[inline(always)]
    pub fn of(&self, lane: usize) -> &[u32] {
        &self.near[lane][..self.count[lane]]
    }
}

/// Sums over a target's neighbours, in lanes.
pub(crate) struct Sums<R> {
    kernel_sum: R,
    concentration_gradient: [R; 2],
    second_moment: [R; 3],
    divergence: R,
    drag: [R; 2],
}

impl<R: SimdReal> Sums<R> {
    /// OP2, OP3, WC6, PR6: the sums of `a` over those `near`, and the link 2 V_a V_b |grad_factor|/ρ of each, which is the same from
    /// both sides to the last bit.
    #[inline(always)]
    pub fn over<K: Shape>(
        a: &PackedParticle,
        near: &[u32],
        rows: &[PackedParticle],
        links: &mut [f64],
        c: &PairConstants,
        zero: R,
    ) -> Sums<R> {
        let mut sums = Sums {
            kernel_sum: zero,
            concentration_gradient: [zero; 2],
            second_moment: [zero; 3],
            divergence: zero,
            drag: [zero; 2],
        };
        let own = PackedParticle {
            x: zero.of(a.x),
            y: zero.of(a.y),
            u: zero.of(a.u),
            v: zero.of(a.v),
            p: zero,
            volume: zero,
            raw_volume: zero.of(a.raw_volume),
            h: zero.of(a.h),
        };
        let (whole, links_of_whole) = (near.chunks_exact(R::WIDTH), links.chunks_exact_mut(R::WIDTH));
        let rest = whole.remainder();
        for (near, links) in whole.zip(links_of_whole) {
            let b = gathered(zero, |k| &rows[near[k] as usize]);
            links.copy_from_slice(&sums.add::<K>(&own, &b, c, zero).lanes()[..R::WIDTH]);
        }
        if !rest.is_empty() {
            // lanes that are left over hold the first of the rest once more, without volume
            let mut b = gathered(zero, |k| &rows[rest[if k < rest.len() { k } else { 0 }] as usize]);
            b.raw_volume = b.raw_volume.mask((1 << rest.len()) - 1);
            let from = links.len() - rest.len();
            links[from..].copy_from_slice(&sums.add::<K>(&own, &b, c, zero).lanes()[..rest.len()]);
        }
        sums
    }

    /// Add a pair in each lane; their links.
    #[inline(always)]
    fn add<K: Shape>(&mut self, a: &PackedParticle<R>, b: &PackedParticle<R>, c: &PairConstants, zero: R) -> R {
        let (dx, dy, h) = (a.x - b.x, a.y - b.y, zero.of(0.5) * (a.h + b.h));
        let (du, dv) = (b.u - a.u, b.v - a.v);
        let r2 = dx.mul_add(dx, dy * dy);
        // one division for two: over h and over r² + 0.01 h²
        let h2 = h * h;
        let blunt = h2.mul_add(zero.of(0.01), r2);
        let both = zero.of(1.0) / (h * blunt);
        let inverse = both * blunt;
        let q = r2.sqrt() * inverse;
        let i2 = inverse * inverse;
        let peak = zero.of(K::ALPHA) * i2;
        let grad_factor = peak * i2 * (zero.of(K::DW_FACTOR) * K::dw_over_q(q));
        let pull = b.raw_volume * grad_factor;
        let (x, y) = (pull * dx, pull * dy);
        let approach = (du * dx + dv * dy).max(zero); // −v_ab·r_ab
        let brake = zero.of(-c.rho0 * c.alpha * c.c0) * a.raw_volume * approach * (h2 * both);
        let shear = zero.of(-2.0 * c.rho0 * c.nu) * a.raw_volume * pull;
        let Sums { kernel_sum, concentration_gradient, second_moment, divergence, drag } = self;
        *kernel_sum = (b.raw_volume * peak).mul_add(K::w(q), *kernel_sum);
        *concentration_gradient = [concentration_gradient[0] + x, concentration_gradient[1] + y];
        let [xx, xy, yy] = *second_moment;
        *second_moment = [x.mul_add(dx, xx), x.mul_add(dy, xy), y.mul_add(dy, yy)];
        *divergence = *divergence + (du * x + dv * y);
        *drag = [drag[0] + (brake * x + shear * du), drag[1] + (brake * y + shear * dv)];
        zero.of(-2.0 / c.rho0) * ((a.raw_volume * b.raw_volume) * grad_factor)
    }

    /// Σ V W [-].
    #[inline(always)]
    pub fn kernel_sum(&self) -> f64 {
        total(self.kernel_sum)
    }

    /// Σ V ∇W [1/m].
    #[inline(always)]
    pub fn concentration_gradient(&self) -> [f64; 2] {
        self.concentration_gradient.map(total)
    }

    /// −Σ V r⊗∇W [-].
    #[inline(always)]
    pub fn second_moment(&self) -> [f64; 3] {
        self.second_moment.map(|sum| -total(sum))
    }

    /// Σ V_b (u_b − u_a)·∇W [1/s].
    #[inline(always)]
    pub fn divergence(&self) -> f64 {
        total(self.divergence)
    }

    /// Viscous force [N/m] (WC6, WC7).
    #[inline(always)]
    pub fn drag(&self) -> [f64; 2] {
        self.drag.map(total)
    }
}

/// The particles `of(k)`, side by side.
#[inline(always)]
fn gathered<'a, R: SimdReal>(zero: R, of: impl Fn(usize) -> &'a PackedParticle) -> PackedParticle<R> {
    PackedParticle {
        x: zero.each(|k| of(k).x),
        y: zero.each(|k| of(k).y),
        u: zero.each(|k| of(k).u),
        v: zero.each(|k| of(k).v),
        p: zero,
        volume: zero,
        raw_volume: zero.each(|k| of(k).raw_volume),
        h: zero.each(|k| of(k).h),
    }
}

#[inline(always)]
fn total<R: SimdReal>(lanes: R) -> f64 {
    lanes.lanes()[..R::WIDTH].iter().sum()
}
