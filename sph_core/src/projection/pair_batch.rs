//! The neighbours of one target side by side, so that several pairs are weighed at once.

use crate::interactions::geometry::PairConstants;
use crate::interactions::kernel::Shape;
use crate::interactions::packed_particle::PackedParticle;

/// Pairs that are summed at once.
const LANES: usize = 2;

/// Those of a list that lie within the support, as the target sees them.
#[derive(Clone, Debug)]
pub(crate) struct PairBatch {
    /// How many.
    count: usize,
    index: [u32; Self::MOST],
    dx: [f64; Self::MOST],
    dy: [f64; Self::MOST],
    r2: [f64; Self::MOST],
    h: [f64; Self::MOST],
    /// Velocity less the target's [m/s].
    du: [f64; Self::MOST],
    dv: [f64; Self::MOST],
    raw_volume: [f64; Self::MOST],
    /// V_b W [-].
    cover: [f64; Self::MOST],
    /// V_b × grad_factor [1/m²].
    pull: [f64; Self::MOST],
    /// Viscous pressure [Pa], times the target's volume (WC6).
    brake: [f64; Self::MOST],
    link: [f64; Self::MOST],
}

impl Default for PairBatch {
    fn default() -> PairBatch {
        let none = [0.0; PairBatch::MOST];
        PairBatch {
            count: 0,
            index: [0; PairBatch::MOST],
            dx: none,
            dy: none,
            r2: none,
            h: none,
            du: none,
            dv: none,
            raw_volume: none,
            cover: none,
            pull: none,
            brake: none,
            link: none,
        }
    }
}

impl PairBatch {
    /// At most so many of a list at a time; a power of two.
    pub const MOST: usize = 64;

    /// Those of the next [`PairBatch::MOST`] of `listed` whose supports overlap that of `a`; true if there may be more.
    #[inline(always)]
    pub fn gather(
        &mut self,
        a: &PackedParticle,
        listed: &mut impl Iterator<Item = u32>,
        rows: &[PackedParticle],
    ) -> bool {
        let (mut count, mut looked_at) = (0, 0);
        for j in listed.take(Self::MOST) {
            looked_at += 1;
            let b = &rows[j as usize];
            let (dx, dy, h) = (a.x - b.x, a.y - b.y, 0.5 * (a.h + b.h));
            // written in any case, and over again by the next where this one is too far: no branch
            self.index[count % Self::MOST] = j;
            count += usize::from(dx * dx + dy * dy < 4.0 * h * h);
        }
        for slot in 0..count.min(Self::MOST) {
            let b = &rows[self.index[slot] as usize];
            let (dx, dy) = (a.x - b.x, a.y - b.y);
            (self.dx[slot], self.dy[slot]) = (dx, dy);
            (self.r2[slot], self.h[slot]) = (dx * dx + dy * dy, 0.5 * (a.h + b.h));
            (self.du[slot], self.dv[slot]) = (b.u - a.u, b.v - a.v);
            self.raw_volume[slot] = b.raw_volume;
        }
        self.count = count;
        // whole lanes: the rest has no volume, half a support away
        for slot in count..count.next_multiple_of(LANES) {
            (self.dx[slot], self.dy[slot], self.r2[slot], self.h[slot]) = (0.0, 0.0, 1.0, 1.0);
            (self.du[slot], self.dv[slot], self.raw_volume[slot]) = (0.0, 0.0, 0.0);
        }
        looked_at == Self::MOST
    }

    /// OP2, OP3, WC6, PR6: kernel, grad_factor, viscous pressure and link of each.
    #[inline(always)]
    pub fn evaluate<K: Shape>(&mut self, a: &PackedParticle, c: &PairConstants) {
        let count = self.count.next_multiple_of(LANES).min(Self::MOST);
        let [dx, dy, r2, h] = [&self.dx, &self.dy, &self.r2, &self.h].map(|x| &x[..count]);
        let [du, dv, raw_volume] = [&self.du, &self.dv, &self.raw_volume].map(|x| &x[..count]);
        let cover = &mut self.cover[..count];
        let pull = &mut self.pull[..count];
        let brake = &mut self.brake[..count];
        let link = &mut self.link[..count];
        let (of_link, of_brake) = (-2.0 / c.rho0, -c.rho0 * c.alpha * c.c0 * a.raw_volume);
        for i in 0..count {
            // one division for two: over h and over r² + 0.01 h²
            let blunt = r2[i] + 0.01 * h[i] * h[i];
            let both = 1.0 / (h[i] * blunt);
            let inverse = both * blunt;
            let q = r2[i].sqrt() * inverse;
            let i2 = inverse * inverse;
            let peak = K::ALPHA * i2;
            let grad_factor = peak * i2 * K::DW_FACTOR * K::dw_over_q(q);
            cover[i] = raw_volume[i] * (peak * K::w(q));
            pull[i] = raw_volume[i] * grad_factor;
            link[i] = of_link * ((a.raw_volume * raw_volume[i]) * grad_factor);
            let parting = du[i] * dx[i] + dv[i] * dy[i]; // −v_ab·r_ab
            let approach = if parting > 0.0 { parting } else { 0.0 };
            brake[i] = of_brake * approach * (h[i] * h[i] * both);
        }
    }

    /// Their indices.
    pub fn listed(&self) -> &[u32] {
        &self.index[..self.count]
    }

    /// PR6: 2 V_a V_b |grad_factor|/ρ of each, the same from both sides to the last bit.
    pub fn links(&self) -> &[f64] {
        &self.link[..self.count]
    }
}

/// Sums over a target's neighbours, in lanes.
#[derive(Default)]
pub(crate) struct Sums {
    kernel_sum: [f64; LANES],
    concentration_gradient: [[f64; LANES]; 2],
    second_moment: [[f64; LANES]; 3],
    divergence: [f64; LANES],
    drag: [[f64; LANES]; 2],
}

impl Sums {
    /// Add those of `near`, which were weighed.
    #[inline(always)]
    pub fn add(&mut self, near: &PairBatch, a: &PackedParticle, c: &PairConstants) {
        let count = near.count.next_multiple_of(LANES).min(PairBatch::MOST);
        let lanes = |x: &'_ [f64; PairBatch::MOST], i: usize| -> [f64; LANES] { [x[i], x[i + 1]] };
        let of_shear = -2.0 * c.rho0 * c.nu * a.raw_volume;
        for i in (0..count).step_by(LANES) {
            let [dx, dy, du, dv] = [&near.dx, &near.dy, &near.du, &near.dv].map(|x| lanes(x, i));
            let [pull, brake, cover] = [&near.pull, &near.brake, &near.cover].map(|x| lanes(x, i));
            for l in 0..LANES {
                let (x, y) = (pull[l] * dx[l], pull[l] * dy[l]);
                let shear = of_shear * pull[l];
                self.kernel_sum[l] += cover[l];
                self.concentration_gradient[0][l] += x;
                self.concentration_gradient[1][l] += y;
                self.second_moment[0][l] -= x * dx[l];
                self.second_moment[1][l] -= x * dy[l];
                self.second_moment[2][l] -= y * dy[l];
                self.divergence[l] += du[l] * x + dv[l] * y;
                self.drag[0][l] += brake[l] * x + shear * du[l];
                self.drag[1][l] += brake[l] * y + shear * dv[l];
            }
        }
    }

    /// Σ V W [-].
    pub fn kernel_sum(&self) -> f64 {
        total(self.kernel_sum)
    }

    /// Σ V ∇W [1/m].
    pub fn concentration_gradient(&self) -> [f64; 2] {
        self.concentration_gradient.map(total)
    }

    /// −Σ V r⊗∇W [-].
    pub fn second_moment(&self) -> [f64; 3] {
        self.second_moment.map(total)
    }

    /// Σ V_b (u_b − u_a)·∇W [1/s].
    pub fn divergence(&self) -> f64 {
        total(self.divergence)
    }

    /// Viscous force [N/m] (WC6, WC7).
    pub fn drag(&self) -> [f64; 2] {
        self.drag.map(total)
    }
}

fn total(lanes: [f64; LANES]) -> f64 {
    lanes[0] + lanes[1]
}
