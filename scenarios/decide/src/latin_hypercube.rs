//! Latin hypercube samples (McKay, Beckman & Conover 1979): each of `n` equal parts of every axis has one sample.

use sph_core::SplitMix64;

/// A whole number below `count`.
fn below(random: &mut SplitMix64, count: usize) -> usize {
    ((u128::from(random.bits()) * count as u128) >> 64) as usize
}

/// Samples in the unit cube [-], shape (samples, axes); the same for the same seed on every machine.
pub fn latin_hypercube(samples: usize, axes: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = SplitMix64(seed);
    let mut points = vec![Vec::with_capacity(axes); samples];
    for _ in 0..axes {
        let mut parts: Vec<usize> = (0..samples).collect();
        for last in (1..samples).rev() {
            parts.swap(last, below(&mut random, last + 1));
        }
        for (point, part) in points.iter_mut().zip(parts) {
            point.push((part as f64 + random.unit()) / samples as f64);
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_of_every_axis_has_one_sample() {
        let points = latin_hypercube(40, 3, 7);
        for axis in 0..3 {
            let mut parts: Vec<usize> = points.iter().map(|point| (40.0 * point[axis]) as usize).collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..40).collect::<Vec<_>>());
        }
        assert_eq!(points, latin_hypercube(40, 3, 7));
        assert_ne!(points, latin_hypercube(40, 3, 8));
    }
}
