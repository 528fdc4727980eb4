//! Waves that run to the right and to the left, separated by gauges (THEORY GE26).

/// A complex amplitude, real and imaginary part [m].
pub type Amplitude = [f64; 2];

/// Least determinant of the equations over their largest value at which gauges separate the waves [-]: (Σ sin²)/n² of the
/// phases between them; 0 where they are half a wave apart.
const LEAST: f64 = 0.05;

/// GE26: the amplitudes [m] at x = 0 of the waves to the right and to the left that fit those at the gauges best:
/// a_j = a_r exp(−i k x_j) + a_l exp(i k x_j) by least squares (two gauges: Goda & Suzuki 1976; three: Mansard & Funke 1980).
/// `None` where the gauges are about half wavelengths apart, or fewer than two.
pub fn separate(wave_number: f64, gauges: &[(f64, Amplitude)]) -> Option<[Amplitude; 2]> {
    // normal equations: n a_r + s* a_l = Σ e^{ikx} a, s a_r + n a_l = Σ e^{-ikx} a, s = Σ e^{-2ikx}
    let n = gauges.len() as f64;
    let mut sums = [[0.0; 2]; 3];
    for (x, [re, im]) in gauges {
        let (sin, cos) = (wave_number * x).sin_cos();
        let (sin2, cos2) = (2.0 * wave_number * x).sin_cos();
        let add = |sum: &mut [f64; 2], value: [f64; 2]| (0..2).for_each(|k| sum[k] += value[k]);
        add(&mut sums[0], [re * cos - im * sin, re * sin + im * cos]);
        add(&mut sums[1], [re * cos + im * sin, im * cos - re * sin]);
        add(&mut sums[2], [cos2, -sin2]);
    }
    let [b, c, s] = sums;
    let determinant = n * n - s[0] * s[0] - s[1] * s[1];
    if gauges.len() < 2 || determinant < LEAST * n * n {
        return None;
    }
    let right = [n * b[0] - (s[0] * c[0] + s[1] * c[1]), n * b[1] - (s[0] * c[1] - s[1] * c[0])];
    let left = [n * c[0] - (s[0] * b[0] - s[1] * b[1]), n * c[1] - (s[0] * b[1] + s[1] * b[0])];
    Some([right.map(|r| r / determinant), left.map(|l| l / determinant)])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two waves that were put together are found again, by two gauges and by more.
    #[test]
    fn waves_that_were_added_are_separated() {
        let (k, right, left) = (2.1, [0.03, -0.01], [0.002, 0.004]);
        let at = |x: f64| {
            let (sin, cos) = (k * x).sin_cos();
            let re = right[0] * cos + right[1] * sin + left[0] * cos - left[1] * sin;
            let im = right[1] * cos - right[0] * sin + left[1] * cos + left[0] * sin;
            (x, [re, im])
        };
        for places in [&[3.0, 3.6][..], &[-1.0, -0.2, 0.4, 5.0]] {
            let gauges: Vec<_> = places.iter().map(|x| at(*x)).collect();
            let found = separate(k, &gauges).expect("gauges apart");
            for (found, exact) in found.iter().zip([right, left]) {
                assert!((0..2).all(|i| (found[i] - exact[i]).abs() < 1e-12), "{found:?} {exact:?}");
            }
        }
    }

    #[test]
    fn gauges_half_a_wave_apart_tell_nothing() {
        let half = std::f64::consts::PI / 2.1;
        let gauge = |x: f64| (x, [0.01, 0.0]);
        assert_eq!(separate(2.1, &[gauge(1.0), gauge(1.0 + half)]), None);
        assert_eq!(separate(2.1, &[gauge(1.0)]), None);
    }
}
