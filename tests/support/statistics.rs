//! Mean, scatter, and the zeros of a sampled curve.

/// Arithmetic mean.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Standard deviation about the mean.
pub fn deviation(values: &[f64]) -> f64 {
    let middle = mean(values);
    (values.iter().map(|v| (v - middle) * (v - middle)).sum::<f64>() / values.len() as f64).sqrt()
}

/// Period of a curve of samples (t, y) about zero: twice the mean distance of its zeros, each interpolated linearly.
pub fn period(samples: &[[f64; 2]]) -> f64 {
    let crossing = |pair: &[[f64; 2]]| {
        let ([t0, y0], [t1, y1]) = (pair[0], pair[1]);
        (y0 * y1 < 0.0).then(|| t0 + (t1 - t0) * y0 / (y0 - y1))
    };
    let zeros: Vec<f64> = samples.windows(2).filter_map(crossing).collect();
    assert!(zeros.len() >= 2, "a curve with {} zeros has no period", zeros.len());
    2.0 * (zeros[zeros.len() - 1] - zeros[0]) / (zeros.len() - 1) as f64
}

/// Numbers that look random and are the same everywhere: a 64-bit linear congruence (Knuth's MMIX constants).
pub struct Noise(u64);

impl Noise {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Noise {
        Noise(seed)
    }

    /// The next number of [-1, 1).
    pub fn draw(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_period_of_a_sine_is_found_between_samples() {
        let samples: Vec<[f64; 2]> = (0..200).map(|k| 0.1 * k as f64).map(|t| [t, (1.7 * t + 0.3).sin()]).collect();
        let exact = 2.0 * std::f64::consts::PI / 1.7;
        assert!((period(&samples) / exact - 1.0).abs() < 1e-3, "{}", period(&samples));
    }

    #[test]
    fn noise_fills_its_interval_evenly() {
        let mut noise = Noise::new(7);
        let values: Vec<f64> = (0..10_000).map(|_| noise.draw()).collect();
        assert!(values.iter().all(|v| (-1.0..1.0).contains(v)));
        assert!(mean(&values).abs() < 0.02, "{}", mean(&values));
        assert!((deviation(&values) - 1.0 / 3.0_f64.sqrt()).abs() < 0.02, "{}", deviation(&values));
    }
}
