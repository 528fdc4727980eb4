//! The pressure along a wedge's face at one moment, in similarity coordinates: its peak and its noise (THEORY GE14).

/// Spacings of the running mean that separates noise.
const SMOOTHED: f64 = 4.0;
/// Noise is measured up to this share of the way to the pressure peak, where the profile turns sharply.
const UP_TO: f64 = 0.9;
/// Points of at least this share of the largest value enter the fit of the peak.
const NEAR_PEAK: f64 = 0.97;

/// Place of the largest value of a profile (x, value): the top of the parabola that fits, by least squares, the points
/// about the largest that reach 97 % of it; the largest point itself at an end of the profile, or where fewer than three
/// points reach that far or they have no top. Noise moves it little; the exact profiles at 10, 20 and 30 degrees give it within 0.2 %.
pub fn peak_place(profile: &[[f64; 2]]) -> Option<f64> {
    let top = (0..profile.len()).max_by(|a, b| profile[*a][1].total_cmp(&profile[*b][1]))?;
    let [at, largest] = profile[top];
    let high = |k: &usize| profile[*k][1] >= NEAR_PEAK * largest;
    let from = (0..top).rev().take_while(high).last().unwrap_or(top);
    let to = (top..profile.len()).take_while(high).last().unwrap_or(top);
    if from == 0 || to + 1 == profile.len() || to - from < 2 {
        return Some(at);
    }
    let near = profile[from..=to].iter().map(|[x, value]| [x - at, value - largest]);
    Some(at + summit(near).unwrap_or(0.0))
}

/// Length of a profile (x, value) in x with at least 90 % of its largest value.
pub fn length_near_peak(profile: &[[f64; 2]]) -> f64 {
    let least = 0.9 * profile.iter().map(|p| p[1]).fold(0.0, f64::max);
    let high = || profile.iter().filter(|p| p[1] >= least).map(|p| p[0]);
    high().fold(0.0, f64::max) - high().fold(f64::INFINITY, f64::min).min(f64::MAX)
}

/// Where the least-squares parabola through points (x, value) is highest; `None` where it has no top.
fn summit(points: impl Iterator<Item = [f64; 2]> + Clone) -> Option<f64> {
    let (n, sum) = points.clone().fold((0.0, 0.0), |(n, sum), [x, _]| (n + 1.0, sum + x));
    let middle = sum / n;
    let (mut power, mut moment) = ([0.0; 5], [0.0; 3]);
    for [x, value] in points {
        let d = x - middle;
        let powers = [1.0, d, d * d, d.powi(3), d.powi(4)];
        power.iter_mut().zip(powers).for_each(|(sum, term)| *sum += term);
        moment.iter_mut().zip(powers).for_each(|(sum, term)| *sum += term * value);
    }
    // value = a + b d + c d²; the first moment of d is zero
    let [m0, _, m2, m3, m4] = power;
    let [v0, v1, v2] = moment;
    let determinant = m0 * (m2 * m4 - m3 * m3) - m2.powi(3);
    let bend = (m0 * (m2 * v2 - m3 * v1) - m2 * m2 * v0) / determinant;
    let slope = (v1 - bend * m3) / m2;
    (bend < 0.0).then(|| middle - 0.5 * slope / bend)
}

/// RMS of what a running mean over four spacings leaves of a profile (x, Cp), sampled evenly, from two spacings
/// beside the keel to 0.9 `peak`, over `scale`; `spacing` and `peak` in the unit of x. `None` where fewer than
/// four spacings lie between.
pub fn noise(profile: &[[f64; 2]], spacing: f64, peak: f64, scale: f64) -> Option<f64> {
    let (half, end) = (0.5 * SMOOTHED * spacing, UP_TO * peak);
    let mut squares = Vec::new();
    for [x, cp] in profile.iter().filter(|p| p[0] >= half && p[0] <= end) {
        let from = profile.partition_point(|p| p[0] < x - half - 1e-9 * spacing);
        let to = profile.partition_point(|p| p[0] <= x + half + 1e-9 * spacing);
        let window = &profile[from..to];
        let mean = window.iter().map(|p| p[1]).sum::<f64>() / window.len() as f64;
        squares.push((cp - mean).powi(2));
    }
    (end - half >= SMOOTHED * spacing).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt() / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(f: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        (0..1000).map(|k| 1e-3 * (f64::from(k) + 0.5)).map(|x| [x, f(x)]).collect()
    }

    #[test]
    fn the_peak_of_a_parabola_is_found_between_samples() {
        let profile = sampled(|x| 3.0 - (x - 0.47123).powi(2));
        assert!((peak_place(&profile).expect("a profile") - 0.47123).abs() < 1e-9);
        let waves = sampled(|x| 3.0 - (x - 0.47123).powi(2) + 0.001 * (600.0 * x).sin());
        assert!((peak_place(&waves).expect("a profile") - 0.47123).abs() < 0.003, "noise moves it by as much");
        assert_eq!(peak_place(&sampled(|x| -x)), Some(0.0005));
        assert_eq!(peak_place(&[]), None);
    }

    /// A wave as long as the running mean has none in it: all of it is noise. A straight line is none.
    #[test]
    fn noise_is_what_waves_by_the_spacing() {
        let spacing = 0.01;
        let wave = |x: f64| 5.0 + 2.0 * x + 0.03 * (std::f64::consts::TAU * x / 0.04).sin();
        let notes = noise(&sampled(wave), spacing, 1.0, 10.0).expect("a long face");
        assert!((notes / (0.003 / 2.0_f64.sqrt()) - 1.0).abs() < 0.03, "{notes}");
        assert!(noise(&sampled(|x| 5.0 - 2.0 * x), spacing, 1.0, 10.0).expect("a long face") < 1e-12);
        // a long wave is flow: of one of length L the residue is 1 − sin(πw/L)/(πw/L) of it, w = 4 spacings
        let long = |x: f64| 0.3 * (std::f64::consts::TAU * x / 0.4).sin();
        let share = 1.0 - (0.1 * std::f64::consts::PI).sin() / (0.1 * std::f64::consts::PI);
        let left = noise(&sampled(long), spacing, 1.0, 1.0).expect("a long face");
        assert!((left / (share * 0.3 / 2.0_f64.sqrt()) - 1.0).abs() < 0.1, "{left}");
        assert_eq!(noise(&sampled(wave), 0.2, 1.0, 1.0), None, "a face of five spacings");
    }
}
