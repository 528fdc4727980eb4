//! Latin hypercube samples (McKay, Beckman & Conover 1979): each of `n` equal parts of every axis has one sample.

/// Random numbers in a fixed order for a seed (SplitMix64; Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// From 0 up to, not including, 1.
    fn share(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A whole number below `count`.
    fn below(&mut self, count: usize) -> usize {
        ((u128::from(self.bits()) * count as u128) >> 64) as usize
    }
}

/// Samples in the unit cube [-], shape (samples, axes); the same for the same seed on every machine.
pub(super) fn latin_hypercube(samples: usize, axes: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random(seed);
    let mut points = vec![Vec::with_capacity(axes); samples];
    for _ in 0..axes {
        let mut parts: Vec<usize> = (0..samples).collect();
        for last in (1..samples).rev() {
            parts.swap(last, random.below(last + 1));
        }
        for (point, part) in points.iter_mut().zip(parts) {
            point.push((part as f64 + random.share()) / samples as f64);
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
