//! Density filters (THEORY L4, L5): every so many steps the density field is smoothed, as the thesis's
//! `i_densityFilter` has it. Fluid neighbours only.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::fluid::Fluid;
use crate::interactions::kernel::{Shape, WithKernel};
use crate::interactions::pair::{self, Row};
use crate::neighbours::Search;
use crate::parallel;
use crate::timers::Phase;
use crate::walls::Walls;

/// How densities are smoothed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DensityFilter {
    /// Not at all.
    #[default]
    None,
    /// L4, zeroth order (Shepard 1968): keeps a constant.
    Shepard,
    /// L5, first order, moving least squares (Colagrossi & Landrini 2003): keeps a linear field.
    Mls,
}

/// L5 falls back to L4 where the normalised determinant of its moments is smaller: on lines and in lone pairs of particles.
const LEAST_DETERMINANT: f64 = 1e-3;

/// L4 or L5 for every fluid particle.
struct Filter<'a> {
    fluid: &'a [Row],
    rho: &'a [f64],
    search: &'a Search,
    linear: bool,
    out: &'a mut [f64],
}

impl WithKernel for Filter<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Filter { fluid, rho, search, linear, out } = self;
        parallel::gather_into(out, |k| {
            let near = search.fluid.of(k).map(|j| (&fluid[j as usize], rho[search.source(j, rho.len())]));
            let moments = Moments::gather::<K>(&fluid[k], rho[k], near);
            if linear { moments.linear() } else { moments.constant() }
        });
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
    fn gather<'r, K: Shape>(a: &Row, rho_a: f64, near: impl Iterator<Item = (&'r Row, f64)>) -> Moments {
        let mut sum = Moments::default();
        sum.take(a.fill * K::ALPHA * K::w(0.0) / (a.h * a.h), 0.0, 0.0, rho_a);
        for (b, rho_b) in near {
            if let Some(ab) = pair::bond::<K>(a.x, a.y, a.h, b.x, b.y, b.h) {
                sum.take(b.fill * ab.w::<K>(), -ab.dx / a.h, -ab.dy / a.h, rho_b);
            }
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

    /// L4: the weighted mean.
    fn constant(&self) -> f64 {
        self.of_density[0] / self.of_space[0]
    }

    /// L5: the value here of the plane that fits best, by elimination of its slopes about the weighted middle.
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

impl Fluid {
    /// L4, L5: smooth the densities, if a filter is chosen and this step is one of its own.
    pub(crate) fn filter_density(&mut self, walls: &Walls) {
        let every = self.parameters.density_filter_every.max(1);
        let due = (self.steps + 1).is_multiple_of(every);
        let linear = match self.parameters.density_filter {
            DensityFilter::None => return,
            DensityFilter::Shepard => false,
            DensityFilter::Mls => true,
        };
        if due {
            self.smooth_density(walls, linear);
        }
    }

    /// L5 if `linear`, else L4, now; walls where they stand at the end of the step.
    pub fn smooth_density(&mut self, walls: &Walls, linear: bool) {
        self.pack(walls, 0.0);
        self.phases.begin(Phase::Density);
        let mut smooth = std::mem::take(&mut self.density_rate); // free between rates
        smooth.resize(self.particles.len(), 0.0);
        self.parameters.kernel.run(Filter {
            fluid: &self.rows.fluid,
            rho: &self.particles.rho,
            search: &self.search,
            linear,
            out: &mut smooth,
        });
        std::mem::swap(&mut self.particles.rho, &mut smooth);
        if let Some(gas) = self.parameters.gas {
            let p = &mut self.particles; //          a gas follows its isentropes
            for k in 0..p.x.len() {
                p.energy[k] *= (p.rho[k] / smooth[k]).powf(gas.gamma - 1.0);
            }
        }
        self.density_rate = smooth;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interactions::kernel::WendlandC2;

    /// An uneven one-sided cloud, as at a free surface, and a density on it.
    fn filtered(rho: impl Fn(f64, f64) -> f64) -> (Moments, f64) {
        let row = |x: f64, y: f64, fill: f64| Row { x, y, fill, volume: fill, h: 0.15, ..Row::default() };
        let places = [(0.1, 0.02), (-0.07, 0.05), (0.03, 0.11), (0.12, 0.13), (-0.11, 0.12), (0.0, 0.21)];
        let near: Vec<(Row, f64)> =
            places.iter().enumerate().map(|(k, &(x, y))| (row(x, y, 0.01 + 0.001 * k as f64), rho(x, y))).collect();
        let a = row(0.0, 0.0, 0.012);
        (Moments::gather::<WendlandC2>(&a, rho(0.0, 0.0), near.iter().map(|(b, r)| (b, *r))), rho(0.0, 0.0))
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
