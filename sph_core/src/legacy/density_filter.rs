//! Density filters (THEORY LE6, LE7): at a regular number of steps the density field is smoothed, as the thesis's
//! `i_densityFilter` has it. Fluid neighbours only.

use crate::interactions::packed_particle::PackedParticle;
use crate::kernel::{Shape, TargetSum};
use crate::legacy::{FluidPair, fluid_pairs};
use crate::system::ParticleSystem;
use crate::timers::Phase;

/// LE7 falls back to LE6 where the normalised determinant of its moments is smaller: on lines and in lone pairs of particles.
const LEAST_DETERMINANT: f64 = 1e-3;

/// LE6 for every fluid particle, or LE7 if `linear`.
struct Filter<'a> {
    system: &'a ParticleSystem,
    linear: bool,
}

impl TargetSum for Filter<'_> {
    type Sum = f64;
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> f64 {
        let ParticleSystem { packed, particles, neighbours, .. } = self.system;
        let rho = |j: Option<u32>| particles.rho[j.map_or(k, |j| neighbours.source(j, particles.len()))];
        let moments = Moments::gather::<K>(&packed.fluid[k], fluid_pairs::<K>(self.system, k), rho);
        if self.linear { moments.linear() } else { moments.constant() }
    }
}

/// Sums Σ V W {1, x, y, x², xy, y²} and Σ V W ρ {1, x, y}, lengths from the target in smoothing lengths, itself included.
#[derive(Default)]
struct Moments {
    of_space: [f64; 6],
    of_density: [f64; 3],
}

impl Moments {
    #[inline(always)]
    fn gather<'r, K: Shape>(
        a: &PackedParticle,
        near: impl Iterator<Item = FluidPair<'r>>,
        rho: impl Fn(Option<u32>) -> f64,
    ) -> Moments {
        let mut sum = Moments::default();
        sum.take(a.raw_volume * K::ALPHA * K::w(0.0) / (a.h * a.h), 0.0, 0.0, rho(None));
        for (j, b, ab) in near {
            sum.take(b.raw_volume * ab.w::<K>(), -ab.dx / a.h, -ab.dy / a.h, rho(Some(j)));
        }
        sum
    }

    #[inline(always)]
    fn take(&mut self, weight: f64, x: f64, y: f64, rho: f64) {
        for (sum, term) in self.of_space.iter_mut().zip([1.0, x, y, x * x, x * y, y * y]) {
            *sum += weight * term;
        }
        for (sum, term) in self.of_density.iter_mut().zip([1.0, x, y]) {
            *sum += weight * rho * term;
        }
    }

    /// LE6: the weighted mean.
    fn constant(&self) -> f64 {
        self.of_density[0] / self.of_space[0]
    }

    /// LE7: the value here of the plane that fits best, by elimination of its slopes about the weighted middle.
    fn linear(&self) -> f64 {
        let [m, mx, my, xx, xy, yy] = self.of_space;
        let [r, rx, ry] = self.of_density;
        let (cx, cy, mean) = (mx / m, my / m, r / m);
        let (sxx, sxy, syy) = (xx - cx * mx, xy - cx * my, yy - cy * my);
        let (sx, sy) = (rx - cx * r, ry - cy * r);
        let determinant = sxx * syy - sxy * sxy;
        if determinant < LEAST_DETERMINANT * m * m {
            return mean;
        }
        let slope = [(syy * sx - sxy * sy) / determinant, (sxx * sy - sxy * sx) / determinant];
        mean - slope[0] * cx - slope[1] * cy
    }
}

/// LE7 if `linear`, else LE6, at the state last packed. The energies of a gas follow its isentropes: γ [-], if it is one.
pub fn smooth_density(system: &mut ParticleSystem, linear: bool, gamma: Option<f64>) {
    system.timers.begin(Phase::Density);
    let mut smooth = vec![0.0; system.particles.len()];
    system.domain.fluid.kernel.gather(&Filter { system, linear }, &mut smooth);
    let p = &mut system.particles;
    std::mem::swap(&mut p.rho, &mut smooth);
    if let Some(gamma) = gamma {
        for k in 0..p.x.len() {
            p.energy[k] *= (p.rho[k] / smooth[k]).powf(gamma - 1.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interactions::geometry::pair_geometry;
    use crate::kernel::WendlandC2;

    /// An uneven one-sided cloud, as at a free surface, and a density on it.
    fn filtered(rho: impl Fn(f64, f64) -> f64) -> (Moments, f64) {
        let row = |x: f64, y: f64, raw_volume: f64| PackedParticle {
            x,
            y,
            raw_volume,
            volume: raw_volume,
            h: 0.15,
            ..PackedParticle::default()
        };
        let places = [(0.1, 0.02), (-0.07, 0.05), (0.03, 0.11), (0.12, 0.13), (-0.11, 0.12), (0.0, 0.21)];
        let near: Vec<(PackedParticle, f64)> =
            places.iter().enumerate().map(|(k, &(x, y))| (row(x, y, 0.01 + 0.001 * k as f64), rho(x, y))).collect();
        let (a, here) = (row(0.0, 0.0, 0.012), rho(0.0, 0.0));
        let pairs = (0..)
            .zip(&near)
            .map(|(j, (b, _))| (j, b, pair_geometry::<WendlandC2>(a.x, a.y, a.h, b.x, b.y, b.h).expect("a neighbour")));
        let of = |j: Option<u32>| j.map_or(here, |j| near[j as usize].1);
        (Moments::gather::<WendlandC2>(&a, pairs, of), here)
    }

    #[test]
    fn shepard_keeps_a_constant_and_no_more() {
        let (moments, here) = filtered(|_, _| 997.0);
        assert!((moments.constant() / here - 1.0).abs() < 1e-15);
        let (moments, here) = filtered(|x, y| 997.0 + 30.0 * x - 80.0 * y);
        assert!((moments.constant() - here).abs() > 1.0, "a sloping field changes at an edge");
    }

    #[test]
    fn moving_least_squares_keep_a_linear_field_at_an_edge() {
        let (moments, here) = filtered(|x, y| 997.0 + 30.0 * x - 80.0 * y);
        assert!((moments.linear() / here - 1.0).abs() < 1e-13, "{} {here}", moments.linear());
    }

    #[test]
    fn a_line_of_particles_has_no_slope_across_it() {
        let mut moments = Moments::default();
        for x in [-1.0, 0.0, 1.0] {
            moments.take(0.3, x, 0.0, 1000.0 + x);
        }
        assert_eq!(moments.linear(), moments.constant());
    }
}
