//! Distances to nearest neighbours: do particles pair?

use sph_core::Particles;

use crate::summary::Order;

/// Of all particles where they are now; `None` where there are less than two, or one is nowhere.
pub(crate) fn order(particles: &Particles) -> Option<Order> {
    let p = particles;
    if p.len() < 2 || p.x.iter().chain(&p.y).any(|place| !place.is_finite()) {
        return None;
    }
    let mut along: Vec<usize> = (0..p.len()).collect();
    along.sort_by(|&a, &b| p.x[a].total_cmp(&p.x[b]).then(p.id[a].cmp(&p.id[b])));
    let spacing = |k: usize| (p.mass[k] / p.rho[k]).sqrt();
    let gap = |a: usize, b: usize| {
        let distance = (p.x[a] - p.x[b]).hypot(p.y[a] - p.y[b]);
        distance / (0.5 * (spacing(a) + spacing(b)))
    };
    // a strip as wide as the coarsest spacing, and what is nearer than that lies in it
    let reach = 2.0 * (0..p.len()).map(spacing).fold(0.0, f64::max);
    let nearest = |place: usize| {
        let a = along[place];
        let beside = |other: &&usize| (p.x[**other] - p.x[a]).abs() <= reach;
        let before = along[..place].iter().rev().take_while(beside);
        let after = along[place + 1..].iter().take_while(beside);
        before.chain(after).map(|&b| gap(a, b)).fold(f64::INFINITY, f64::min)
    };
    let mut gaps: Vec<f64> = (0..p.len()).map(nearest).collect();
    gaps.sort_by(f64::total_cmp);
    Some(Order { nearest_least: gaps[0], nearest_median: gaps[gaps.len() / 2] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_core::{Domain, Fluid, Seed, wcsph};

    #[test]
    fn a_lattice_is_a_spacing_apart_and_a_pair_is_found() {
        let settings = wcsph::Settings { sound_speed: 10.0.into(), ..wcsph::Settings::default() };
        let fluid = |seeds: &[Seed]| Fluid::new(Domain::default(), &settings, seeds);
        let seed = |x: f64, y: f64| Seed { at: [x, y], velocity: [0.0; 2], area: 1.0, pressure: 0.0 };
        let mut seeds: Vec<Seed> = (0..25).map(|k| seed(f64::from(k % 5), f64::from(k / 5))).collect();
        let whole = order(fluid(&seeds).particles()).expect("25 particles");
        assert!((whole.nearest_least - 1.0).abs() < 1e-9 && (whole.nearest_median - 1.0).abs() < 1e-9, "{whole:?}");
        seeds[12].at[1] -= 0.75;
        let paired = order(fluid(&seeds).particles()).expect("25 particles");
        assert!((paired.nearest_least - 0.25).abs() < 1e-9 && (paired.nearest_median - 1.0).abs() < 1e-9, "{paired:?}");
    }
}
