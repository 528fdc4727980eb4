use super::*;

/// A line with a corner at its third node.
fn line() -> Vec<c64> {
    let ends = [[1.0, 0.3], [1.1, 0.32], [1.3, 0.4], [2.0, 0.1], [2.2, -0.4], [2.25, -0.5], [2.2, -0.6]];
    (0..3).flat_map(|n| ends.map(|[x, y]| c64::new(x, y - f64::from(n)))).collect()
}

fn mirrored(z: c64) -> c64 {
    c64::new(-z.re, z.im)
}

/// The factors of φ and of ψ of the nodes at a place.
fn written(influence: &mut Influence, n: usize, at: c64, is_imaginary: bool) -> [Vec<f64>; 2] {
    let [mut phi, mut psi] = [(); 2].map(|()| vec![0.0; n]);
    influence.write(at, &mut Row { known: &mut phi, unknown: &mut psi, body: 0..0, is_imaginary });
    [phi, psi]
}

#[test]
fn series_and_logarithm_agree() {
    let z = line();
    let block = Elements::new(&z).blocks;
    for (k, ends) in z.windows(2).enumerate() {
        let [from, to] = [ends[0], ends[1]];
        for (turn, near_by) in (0..16).flat_map(|turn| [(turn, FAR), (turn, VERY_SMALL)]) {
            let away = c64::new(0.0, f64::from(turn) * std::f64::consts::PI / 8.0).exp();
            let at = 0.5 * (from + to) + away * (0.5 * (to - from).norm() / (0.999 * near_by).sqrt());
            let Factors { of, near } = by_series(&block[k / LANES], at);
            assert!(near.0[k % LANES] < FAR);
            for (number, exact) in by_logarithm([from - at, to - at]).into_iter().enumerate() {
                let own = c64::new(of[2 * number].0[k % LANES], of[2 * number + 1].0[k % LANES]);
                assert!((own - exact).norm() < 2e-11, "{number} of element {k}: {own} for {exact}");
            }
        }
    }
}

/// The factors are those of the sum over the elements by the logarithm alone, on the images too.
#[test]
fn factors_are_those_of_all_elements() {
    let (z, corner) = (line(), 2);
    let n = z.len();
    let beta: Vec<c64> = (0..n).map(|k| c64::new((0.7 * k as f64).sin(), (0.3 * k as f64).cos())).collect();
    let second_difference = |z: &[c64], beta: &[c64], k: usize| {
        let slope = |k: usize| (beta[k + 1] - beta[k]) / (z[k + 1] - z[k]);
        (slope(k) - slope(k - 1)) / (z[k + 1] - z[k - 1])
    };
    let integral = |z: &[c64], beta: &[c64], corner: usize, at: c64| -> c64 {
        let of = |k: usize| {
            let [first, second, third] = by_logarithm([z[k] - at, z[k + 1] - at]);
            let differences: Vec<c64> = [k, k + 1]
                .into_iter()
                .filter(|k| 0 < *k && k + 1 < n && *k != corner)
                .map(|k| second_difference(z, beta, k))
                .collect();
            let mean = differences.iter().sum::<c64>() / differences.len().max(1) as f64;
            first * beta[k] + second * beta[k + 1] + third * mean
        };
        (0..n - 1).map(of).sum()
    };
    let images: Vec<c64> = z.iter().rev().map(|z| mirrored(*z)).collect();
    let conjugates: Vec<c64> = beta.iter().rev().map(|beta| beta.conj()).collect();
    let places = [c64::new(-3.0, 0.5), c64::new(1.0, 8.0), z[15]];
    for (at, is_imaginary) in places.into_iter().flat_map(|at| [(at, false), (at, true)]) {
        for is_half in [false, true] {
            let of = if is_half { Influence::symmetric } else { Influence::whole };
            let [phi, psi] = written(&mut of(&z, Some(&[corner])), n, at, is_imaginary);
            let own: f64 = (0..n).map(|k| phi[k] * beta[k].re + psi[k] * beta[k].im).sum();
            let mut exact = integral(&z, &beta, corner, at);
            if is_half {
                exact += integral(&images, &conjugates, n - 1 - corner, at);
            }
            let exact = if is_imaginary { exact.im } else { exact.re };
            assert!((own - exact).abs() < 1e-9, "{at}: {own} for {exact}");
        }
    }
}

/// β = z² is quadratic on every element: its integral is exact.
#[test]
fn a_parabola_is_integrated_exactly() {
    let z: Vec<c64> = (0..9).map(|k| c64::new(0.2 * f64::from(k), 0.03 * f64::from(k * k))).collect();
    let at = c64::new(0.5, -0.6);
    let [from, to] = [z[0] - at, z[8] - at];
    let exact = 0.5 * (to * to - from * from) + 2.0 * at * (to - from) + at * at * (to / from).ln();
    for is_imaginary in [false, true] {
        let [phi, psi] = written(&mut Influence::whole(&z, Some(&[])), z.len(), at, is_imaginary);
        let own: f64 = z.iter().enumerate().map(|(k, z)| phi[k] * (z * z).re + psi[k] * (z * z).im).sum();
        let exact = if is_imaginary { exact.im } else { exact.re };
        assert!((own - exact).abs() < 1e-10, "{own} for {exact}");
    }
}
