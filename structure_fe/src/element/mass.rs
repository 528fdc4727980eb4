//! Consistent mass of an element, in its own axes.

use super::ends::{Ends, EndsMatrix};

/// The consistent mass matrix in the element's axes \[kg, kg m, kg m^2\] (THEORY BE5) of an element of `mass` m
/// \[kg\], `length` L \[m\] and `shear_parameter` Phi \[-\]: linear u; for w the element's own shape functions, those
/// of Euler-Bernoulli where Phi = 0 (Przemieniecki 1968, ch. 11) and Timoshenko's otherwise (Friedman & Kosmatka 1993).
///
/// `radius_squared` I/A \[m^2\] adds rotatory inertia (Rayleigh 1877); 0 omits it.
#[rustfmt::skip]
pub(crate) fn consistent_mass(mass: f64, length: f64, shear_parameter: f64, radius_squared: f64) -> EndsMatrix {
    let phi = shear_parameter;
    let translation = mass / (1.0 + phi).powi(2);
    let rotation = translation * radius_squared / length.powi(2);
    let polynomial = |[a, b, c]: [f64; 3]| a + phi * (b + phi * c);
    let sum = |t: [f64; 3], r: [f64; 3]| translation * polynomial(t) + rotation * polynomial(r);
    let squared = length.powi(2);
    let (own, other) = (mass / 3.0, mass / 6.0);
    // Over (w1, theta1, w2, theta2); the rest follows by symmetry.
    let m11 = sum([13.0 / 35.0, 7.0 / 10.0, 1.0 / 3.0], [6.0 / 5.0, 0.0, 0.0]);
    let m12 = sum([11.0 / 210.0, 11.0 / 120.0, 1.0 / 24.0], [1.0 / 10.0, -1.0 / 2.0, 0.0]) * length;
    let m13 = sum([9.0 / 70.0, 3.0 / 10.0, 1.0 / 6.0], [-6.0 / 5.0, 0.0, 0.0]);
    let m14 = -sum([13.0 / 420.0, 3.0 / 40.0, 1.0 / 24.0], [-1.0 / 10.0, 1.0 / 2.0, 0.0]) * length;
    let m22 = sum([1.0 / 105.0, 1.0 / 60.0, 1.0 / 120.0], [2.0 / 15.0, 1.0 / 6.0, 1.0 / 3.0]) * squared;
    let m24 = -sum([1.0 / 140.0, 1.0 / 60.0, 1.0 / 120.0], [1.0 / 30.0, 1.0 / 6.0, -1.0 / 6.0]) * squared;
    EndsMatrix([
        [own,   0.0,  0.0,  other, 0.0,  0.0],
        [0.0,   m11,  m12,  0.0,   m13,  m14],
        [0.0,   m12,  m22,  0.0,  -m14,  m24],
        [other, 0.0,  0.0,  own,   0.0,  0.0],
        [0.0,   m13, -m14,  0.0,   m11, -m12],
        [0.0,   m14,  m24,  0.0,  -m12,  m22],
    ])
}

/// M v of a mass matrix in the element's axes, without its blocks of zeros.
#[inline]
pub(crate) fn mass_times(mass: &EndsMatrix, v: &Ends) -> Ends {
    Ends::from_fn(|i| match i % 3 {
        0 => mass[(i, 0)] * v[0] + mass[(i, 3)] * v[3],
        _ => mass[(i, 1)] * v[1] + mass[(i, 2)] * v[2] + mass[(i, 4)] * v[4] + mass[(i, 5)] * v[5],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The closed form against 5-point Gauss integration of the shapes themselves.
    #[test]
    fn the_mass_is_that_of_the_element_shapes() {
        let (mass, length, radius_squared) = (3.0, 0.7, 0.02);
        let points: [(f64, f64); 5] = [
            (0.0, 128.0 / 225.0),
            (0.538469310105683, 0.478628670499366),
            (-0.538469310105683, 0.478628670499366),
            (0.906179845938664, 0.236926885056189),
            (-0.906179845938664, 0.236926885056189),
        ];
        for phi in [0.0_f64, 0.4, 30.0] {
            let ours = consistent_mass(mass, length, phi, radius_squared);
            let at = [1, 2, 4, 5];
            for i in 0..4 {
                for j in 0..4 {
                    let integral: f64 = points
                        .iter()
                        .map(|&(place, weight)| {
                            let x: f64 = 0.5 * (1.0 + place);
                            let (y, p) = (1.0 - x, 1.0 + phi);
                            let shapes = [
                                (1.0 - 3.0 * x.powi(2) + 2.0 * x.powi(3) + phi * y) / p,
                                length * (x - 2.0 * x.powi(2) + x.powi(3) + 0.5 * phi * x * y) / p,
                                (3.0 * x.powi(2) - 2.0 * x.powi(3) + phi * x) / p,
                                length * (x.powi(3) - x.powi(2) - 0.5 * phi * x * y) / p,
                            ];
                            let turns = [
                                -6.0 * x * y / (p * length),
                                (1.0 - 4.0 * x + 3.0 * x.powi(2) + phi * y) / p,
                                6.0 * x * y / (p * length),
                                (3.0 * x.powi(2) - 2.0 * x + phi * x) / p,
                            ];
                            let product = shapes[i] * shapes[j] + radius_squared * turns[i] * turns[j];
                            0.5 * weight * mass * product
                        })
                        .sum();
                    let error = ours[(at[i], at[j])] - integral;
                    assert!(error.abs() < 1e-13 * mass, "phi = {phi}, {i}{j}: {error:e}");
                }
            }
        }
    }
}
