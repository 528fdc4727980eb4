//! Cubic splines through points of uneven distance.

/// A cubic spline, whose curvature is constant in its first and its last piece.
pub(super) struct Spline<'a> {
    at: &'a [f64],
    value: Vec<f64>,
    /// Second derivatives at the points.
    curvature: Vec<f64>,
}

impl<'a> Spline<'a> {
    /// Through `value` at the increasing arguments `at`, three or more.
    pub fn new(at: &'a [f64], value: impl IntoIterator<Item = f64>) -> Spline<'a> {
        let (value, n): (Vec<f64>, _) = (value.into_iter().collect(), at.len());
        // continuity of the first derivative, by Thomas' algorithm: above × next + diagonal × own = right − below × previous
        let (mut ratio, mut curvature) = (vec![-1.0; n], vec![0.0; n]);
        for k in 1..n - 1 {
            let [before, after] = [at[k] - at[k - 1], at[k + 1] - at[k]];
            let bend = (value[k + 1] - value[k]) / after - (value[k] - value[k - 1]) / before;
            let diagonal = (before + after) / 3.0 - before / 6.0 * ratio[k - 1];
            ratio[k] = after / 6.0 / diagonal;
            curvature[k] = (bend - before / 6.0 * curvature[k - 1]) / diagonal;
        }
        curvature[n - 1] = curvature[n - 2] / (1.0 + ratio[n - 2]);
        for k in (0..n - 1).rev() {
            curvature[k] -= ratio[k] * curvature[k + 1];
        }
        Spline { at, value, curvature }
    }

    /// Value and derivative at `x`.
    pub fn sample(&self, x: f64) -> [f64; 2] {
        let k = self.at.partition_point(|&at| at <= x).clamp(1, self.at.len() - 1) - 1;
        let h = self.at[k + 1] - self.at[k];
        let [a, b] = [(self.at[k + 1] - x) / h, (x - self.at[k]) / h];
        let ([y0, y1], [m0, m1]) = ([self.value[k], self.value[k + 1]], [self.curvature[k], self.curvature[k + 1]]);
        let value = a * y0 + b * y1 + ((a * a * a - a) * m0 + (b * b * b - b) * m1) * h * h / 6.0;
        let slope = (y1 - y0) / h + ((3.0 * b * b - 1.0) * m1 - (3.0 * a * a - 1.0) * m0) * h / 6.0;
        [value, slope]
    }

    /// Derivatives at its points.
    pub fn slopes(&self) -> Vec<f64> {
        let last = self.at.len() - 1;
        let within = |k: usize| {
            let h = self.at[k + 1] - self.at[k];
            let [m0, m1] = [self.curvature[k], self.curvature[k + 1]];
            [(self.value[k + 1] - self.value[k]) / h, h / 6.0, m0, m1]
        };
        let at_first = |k: usize| {
            let [mean, h, m0, m1] = within(k);
            mean - (2.0 * m0 + m1) * h
        };
        let [mean, h, m0, m1] = within(last - 1);
        (0..last).map(at_first).chain([mean + (m0 + 2.0 * m1) * h]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_met_exactly() {
        let at = [0.0, 0.5, 0.8, 2.0, 3.5];
        let spline = Spline::new(&at, at.map(|x| 1.0 + 2.0 * x - 3.0 * x * x));
        for x in [0.0, 0.3, 0.5, 1.1, 2.9, 3.5] {
            let [value, slope] = spline.sample(x);
            assert!((value - (1.0 + 2.0 * x - 3.0 * x * x)).abs() < 1e-13, "{x}: {value}");
            assert!((slope - (2.0 - 6.0 * x)).abs() < 1e-13, "{x}: {slope}");
        }
    }
}
