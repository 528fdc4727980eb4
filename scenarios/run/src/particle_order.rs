//! Distances between nearest neighbours, which show whether particles pair.

use scene::vocabulary::Doubt;
use serde::Serialize;
use settings::significant;
use sph_core::{Kernel, Particles};

/// How regularly the particles lie at the end of a run: particles that pair, or clump, are nearer than a spacing.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ParticleOrder {
    /// Least distance of a particle to the nearest, over the mean of their spacings [-].
    pub nearest_least: f64,
    /// Median of the same [-].
    pub nearest_median: f64,
}

/// Particles nearer than this share of a spacing have paired [-].
const PAIRED: f64 = 0.02;

impl ParticleOrder {
    /// Particles that are in one place, under a kernel that lets them pair; under others they have met in a splash.
    pub(super) fn doubt(&self, kernel: Kernel) -> Option<Doubt> {
        let pairs = matches!(kernel, Kernel::Gaussian | Kernel::CubicSpline);
        (pairs && self.nearest_least < PAIRED).then(|| {
            let why = format!(
                "two particles are {} spacings apart: they have paired, since the slope of this kernel vanishes \
                 at the centre; use a wendland kernel",
                significant(self.nearest_least)
            );
            Doubt::about("order.nearest_least", why)
        })
    }
}

/// The order of all particles; `None` for fewer than two, or if a position is not finite.
pub(super) fn particle_order(particles: &Particles) -> Option<ParticleOrder> {
    let p = particles;
    if p.len() < 2 || p.x.iter().chain(&p.y).any(|place| !place.is_finite()) {
        return None;
    }
    let mut along: Vec<usize> = (0..p.len()).collect();
    along.sort_by(|&a, &b| p.x[a].total_cmp(&p.x[b]).then(p.id[a].cmp(&p.id[b])));
    let spacing = |k: usize| (p.mass[k] / p.rho[k]).sqrt();
    let gap_to_nearest = |place: usize| {
        let (a, mut nearest) = (along[place], (f64::INFINITY, 0));
        for side in
            [&mut along[..place].iter().rev() as &mut dyn Iterator<Item = &usize>, &mut along[place + 1..].iter()]
        {
            for &b in side {
                let (dx, dy) = (p.x[a] - p.x[b], p.y[a] - p.y[b]);
                if dx * dx > nearest.0 {
                    break; // and so are all beyond
                }
                let distance2 = dx * dx + dy * dy;
                nearest = if distance2 < nearest.0 { (distance2, b) } else { nearest };
            }
        }
        nearest.0.sqrt() / (0.5 * (spacing(a) + spacing(nearest.1)))
    };
    let mut gaps: Vec<f64> = (0..p.len()).map(gap_to_nearest).collect();
    gaps.sort_by(f64::total_cmp);
    Some(ParticleOrder { nearest_least: gaps[0], nearest_median: gaps[gaps.len() / 2] })
}

#[cfg(test)]
mod tests {
    use sph_core::{Domain, Fluid, Seed, wcsph};

    use super::*;

    #[test]
    fn a_lattice_is_a_spacing_apart_and_a_pair_is_found() {
        let settings = wcsph::Settings { sound_speed: 10.0.into(), ..wcsph::Settings::default() };
        let fluid = |seeds: &[Seed]| Fluid::new(Domain::default(), &settings, seeds);
        let seed = |x: f64, y: f64| Seed { at: [x, y], velocity: [0.0; 2], area: 1.0, pressure: 0.0 };
        let mut seeds: Vec<Seed> = (0..25).map(|k| seed(f64::from(k % 5), f64::from(k / 5))).collect();
        let whole = particle_order(fluid(&seeds).particles()).expect("25 particles");
        assert!((whole.nearest_least - 1.0).abs() < 1e-9 && (whole.nearest_median - 1.0).abs() < 1e-9, "{whole:?}");
        seeds[12].at[1] -= 0.75;
        let paired = particle_order(fluid(&seeds).particles()).expect("25 particles");
        let close = ParticleOrder { nearest_least: 0.001, ..paired };
        assert!(close.doubt(Kernel::Gaussian).is_some_and(|doubt| doubt.to_string().contains("wendland")));
        assert_eq!((close.doubt(Kernel::WendlandC2), paired.doubt(Kernel::Gaussian)), (None, None));
        assert!((paired.nearest_least - 0.25).abs() < 1e-9 && (paired.nearest_median - 1.0).abs() < 1e-9, "{paired:?}");
    }
}
