//! A smooth curve through points that bulges nowhere.

/// Piecewise cubic through points, monotone wherever they are, with a continuous slope (Fritsch & Butland 1984).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Monotone {
    x: Vec<f64>,
    y: Vec<f64>,
    slope: Vec<f64>,
}

impl Monotone {
    /// Through at least two points of increasing x.
    pub fn through(x: Vec<f64>, y: Vec<f64>) -> Monotone {
        let n = x.len();
        let step: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
        let chord: Vec<f64> = (0..n - 1).map(|k| (y[k + 1] - y[k]) / step[k]).collect();
        let inner = |k: usize| match chord[k - 1] * chord[k] > 0.0 {
            true => {
                let (left, right) = (2.0 * step[k] + step[k - 1], step[k] + 2.0 * step[k - 1]);
                (left + right) / (left / chord[k - 1] + right / chord[k])
            }
            false => 0.0,
        };
        let slope = (0..n)
            .map(|k| match k {
                0 => chord[0],
                k if k == n - 1 => chord[n - 2],
                k => inner(k),
            })
            .collect();
        Monotone { x, y, slope }
    }

    /// Value, slope and second derivative; beyond its ends the curve goes on straight.
    pub fn at(&self, x: f64) -> [f64; 3] {
        let last = self.x.len() - 1;
        if x <= self.x[0] || x >= self.x[last] {
            let end = if x <= self.x[0] { 0 } else { last };
            return [self.y[end] + self.slope[end] * (x - self.x[end]), self.slope[end], 0.0];
        }
        let k = self.x.partition_point(|at| *at <= x).clamp(1, last) - 1;
        let step = self.x[k + 1] - self.x[k];
        let (t, rise) = ((x - self.x[k]) / step, (self.y[k + 1] - self.y[k]) / step);
        let [from, to] = [self.slope[k], self.slope[k + 1]];
        // y = y_k + step (from t + b t² + c t³)
        let (b, c) = (3.0 * rise - 2.0 * from - to, from + to - 2.0 * rise);
        [
            self.y[k] + step * t * (from + t * (b + t * c)),
            from + t * (2.0 * b + 3.0 * t * c),
            (2.0 * b + 6.0 * t * c) / step,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_its_points_keeps_between_them_and_has_its_own_derivatives() {
        let (x, y) = (vec![0.0, 1.0, 2.5, 3.0, 5.0], vec![1.0, -0.5, -0.5, 0.25, 4.0]);
        let curve = Monotone::through(x.clone(), y.clone());
        x.iter().zip(&y).for_each(|(x, y)| assert!((curve.at(*x)[0] - y).abs() < 1e-14));
        for k in 1..500 {
            let at = 0.01 * f64::from(k) + 1e-4;
            let after = x.partition_point(|x| *x <= at);
            let [value, slope, bend] = curve.at(at);
            let (low, high) = (y[after - 1].min(y[after]), y[after - 1].max(y[after]));
            assert!((low - 1e-14..=high + 1e-14).contains(&value), "{at}: {value}");
            let [before, next] = [curve.at(at - 1e-6), curve.at(at + 1e-6)];
            assert!(((next[0] - before[0]) / 2e-6 - slope).abs() < 1e-7, "{at}");
            assert!(((next[1] - before[1]) / 2e-6 - bend).abs() < 1e-5, "{at}");
        }
    }
}
