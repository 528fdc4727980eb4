//! The pairs of a step, by clusters of targets: sums over them, and the links that they leave behind.
//!
//! The targets of a cluster follow one another and are summed side by side. An entry is a neighbour of any of them, with a link to
//! each: it is read once, and the links of a cluster lie side by side.

use crate::interactions::geometry::PairConstants;
use crate::interactions::packed_particle::PackedParticle;
use crate::kernel::Shape;
use crate::neighbours::lists::{Lists, Splat};
use crate::simd::{LANES, SimdReal};

/// A link to each target of a cluster, 0 where it is none: 2 V_i V_j |slope|/ρ, the same number from both sides. In single precision: a
/// relative change of 6e-8 in couplings of a symmetric matrix.
pub(crate) type Links = [f32; LANES];

/// The pairs of a chunk of targets.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChunkPairs {
    /// Where the entries of each cluster end.
    ends: Vec<u32>,
    near: Vec<u32>,
    links: Vec<Links>,
    /// Who is near a target of one cluster, and a bit for each target.
    met: Vec<(u32, u32)>,
}

impl ChunkPairs {
    /// No pairs.
    pub fn clear(&mut self) {
        self.ends.clear();
        self.near.clear();
        self.links.clear();
    }

    /// Of cluster `c`: who is near any of its targets, as listed, and the links.
    #[inline(always)]
    pub fn cluster(&self, c: usize) -> (&[u32], &[Links]) {
        let from = if c == 0 { 0 } else { self.ends[c - 1] as usize };
        let to = self.ends[c] as usize;
        (&self.near[from..to], &self.links[from..to])
    }

    /// Who is near the chunk's target `k`, as listed, and the link.
    #[inline(always)]
    pub fn row(&self, k: usize) -> impl Iterator<Item = (u32, f64)> + '_ {
        let (near, links) = self.cluster(k / LANES);
        let own = near.iter().zip(links).map(move |(&j, links)| (j, links[k % LANES]));
        own.filter(|&(_, link)| link != 0.0).map(|(j, link)| (j, f64::from(link)))
    }

    /// The same pairs where neighbour j is named `source(j)`; no target, `first` the first, is linked to itself.
    pub fn renamed(&mut self, of: &ChunkPairs, first: usize, source: impl Fn(u32) -> u32) {
        self.ends.clone_from(&of.ends);
        self.links.clone_from(&of.links);
        self.near.clear();
        self.near.extend(of.near.iter().map(|&j| source(j)));
        let mut from = 0;
        for (c, &to) in of.ends.iter().enumerate() {
            for e in from..to as usize {
                if let Some(lane) = lane_of(self.near[e], first + c * LANES) {
                    self.links[e][lane] = 0.0;
                }
            }
            from = to as usize;
        }
    }

    /// OP2, OP3, WC6, PR6: the sums of the next cluster, of targets from `first` on, over those that `lists` names; their links are kept.
    #[inline(always)]
    pub fn add_cluster<R: SimdReal, K: Shape>(
        &mut self,
        lists: &Lists,
        first: usize,
        rows: &[PackedParticle],
        c: &PairConstants,
        zero: R,
    ) -> [Sums; LANES] {
        self.find(lists, first, rows, zero);
        let ChunkPairs { ends, near, links, met } = self;
        let from = near.len();
        near.extend(met.iter().map(|&(j, _)| j));
        links.resize(near.len(), [0.0; LANES]);
        ends.push(near.len() as u32);
        let mut found = [Sums::default(); LANES];
        for lane in (0..LANES).step_by(R::WIDTH) {
            let a = PackedParticle::targets(rows, first + lane, zero);
            let mut sums = LaneSums::zero(zero);
            for (&(j, bits), links) in met.iter().zip(&mut links[from..]) {
                let b = PackedParticle::mask(rows[j as usize].splat(zero), bits >> lane);
                let link = sums.add::<K>(&a, &b, c, zero).to_single();
                links[lane..lane + R::WIDTH].copy_from_slice(&link[..R::WIDTH]);
            }
            sums.put(&mut found[lane..lane + R::WIDTH]);
        }
        found
    }

    /// Who lies within the support of a target of the cluster from `first` on, with a bit for each; no target is its own neighbour.
    #[inline(always)]
    fn find<R: SimdReal>(&mut self, lists: &Lists, first: usize, rows: &[PackedParticle], zero: R) {
        let listed = lists.cluster(first);
        // one place more: written, never kept
        self.met.resize(listed.len() + 1, (0, 0));
        let at: [PackedParticle; LANES] = std::array::from_fn(|k| rows[(first + k).min(rows.len() - 1)]);
        let mut kept = 0;
        for entry in listed {
            let (j, mut met) = (entry.index(), entry.bits());
            if let Some(own) = lane_of(j, first) {
                met &= !(1 << own);
            }
            let b = &rows[j as usize];
            let mut within = 0;
            for lane in (0..LANES).step_by(R::WIDTH) {
                let dx = zero.each(|k| at[lane + k].x) - zero.of(b.x);
                let dy = zero.each(|k| at[lane + k].y) - zero.of(b.y);
                let h = zero.of(0.5) * (zero.each(|k| at[lane + k].h) + zero.of(b.h));
                within |= (dx * dx + dy * dy).less(zero.of(4.0) * h * h) << lane;
            }
            // written in any case, and over again by the next where this one is too far: no branch
            self.met[kept] = (j, within & met);
            kept += usize::from(within & met != 0);
        }
        self.met.truncate(kept);
    }
}

/// Which target of the cluster from `first` on point `j` is.
#[inline(always)]
fn lane_of(j: u32, first: usize) -> Option<usize> {
    Some((j as usize).wrapping_sub(first)).filter(|&lane| lane < LANES)
}

/// Sums of a target over its neighbours.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    /// Σ V W [-].
    pub kernel_sum: f64,
    /// Σ V ∇W [1/m].
    pub concentration_gradient: [f64; 2],
    /// −Σ V r⊗∇W [-].
    pub second_moment: [f64; 3],
    /// Σ V_b (u_b − u_a)·∇W [1/s].
    pub divergence: f64,
    /// Viscous force [N/m] (WC6, WC7).
    pub drag: [f64; 2],
}

/// The same side by side, the second moment with its sign changed.
struct LaneSums<R> {
    kernel_sum: R,
    concentration_gradient: [R; 2],
    second_moment: [R; 3],
    divergence: R,
    drag: [R; 2],
}

impl<R: SimdReal> LaneSums<R> {
    #[inline(always)]
    fn zero(zero: R) -> LaneSums<R> {
        let (two, three) = ([zero; 2], [zero; 3]);
        LaneSums { kernel_sum: zero, concentration_gradient: two, second_moment: three, divergence: zero, drag: two }
    }

    /// Add b to the sums of a; the links.
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
        let LaneSums { kernel_sum, concentration_gradient, second_moment, divergence, drag } = self;
        *kernel_sum = (b.raw_volume * peak).mul_add(K::w(q), *kernel_sum);
        *concentration_gradient = [concentration_gradient[0] + x, concentration_gradient[1] + y];
        let [xx, xy, yy] = *second_moment;
        *second_moment = [x.mul_add(dx, xx), x.mul_add(dy, xy), y.mul_add(dy, yy)];
        *divergence = *divergence + (du * x + dv * y);
        *drag = [drag[0] + (brake * x + shear * du), drag[1] + (brake * y + shear * dv)];
        zero.of(-2.0 / c.rho0) * ((a.raw_volume * b.raw_volume) * grad_factor)
    }

    #[inline(always)]
    fn put(self, out: &mut [Sums]) {
        let kernel_sum = self.kernel_sum.lanes();
        let concentration_gradient = self.concentration_gradient.map(R::lanes);
        let second_moment = self.second_moment.map(R::lanes);
        let divergence = self.divergence.lanes();
        let drag = self.drag.map(R::lanes);
        for (k, out) in out.iter_mut().enumerate() {
            *out = Sums {
                kernel_sum: kernel_sum[k],
                concentration_gradient: concentration_gradient.map(|sum| sum[k]),
                second_moment: second_moment.map(|sum| -sum[k]),
                divergence: divergence[k],
                drag: drag.map(|sum| sum[k]),
            };
        }
    }
}
