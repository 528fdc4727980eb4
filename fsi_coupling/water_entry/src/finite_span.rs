//! A section of finite length: the share of the two-dimensional load that is left between two free ends (THEORY RU6–RU8).
//!
//! ```
//! use water_entry::finite_span::Ends;
//!
//! // a wetted bottom 2 m long and 1 m wide
//! let ends = Ends::of_aspect_ratio(2.0);
//! assert!((ends.impulse.value - 0.75).abs() < 0.01 && (ends.force.value - 0.64).abs() < 0.02);
//! ```

/// Pabst (1930): his tests with plates, 1 − 0.425 s [-].
const PABST: [f64; 4] = [0.425, 0.0, 0.0, 0.0];
/// Coefficients of powers of s for the rectangular plate in potential flow, a fit within 0.01 % of a lifting-surface solution [-].
const PLATE: [f64; 4] = [0.529_18, -0.530_40, 0.535_48, -0.284_66];
/// Aspect ratios, over and under the one that is asked for, among which the difference of the two formulas is looked for [-].
const NEIGHBOURHOOD: f64 = 2.0;
/// Steps from one end of them to the other.
const STEPS: i32 = 16;

/// A factor on a two-dimensional load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor {
    /// Mean of the two formulas [-].
    pub value: f64,
    /// Half of the largest difference of the two between half and twice the aspect ratio, relative, times `value` [-]: the two cross near 3.5.
    pub band: f64,
}

/// Factors for a wetted bottom of finite length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// Length over wetted breadth [-].
    pub aspect_ratio: f64,
    /// On the added mass, and so on the impulse of a given motion up to this breadth (RU7).
    pub impulse: Factor,
    /// On the force at constant speed while the wetted breadth grows (RU8).
    pub force: Factor,
}

impl Ends {
    /// Factors at a length over wetted breadth above 0 [-].
    pub fn of_aspect_ratio(aspect_ratio: f64) -> Ends {
        let of = |share: fn(f64, &[f64; 4]) -> f64| Factor::between(aspect_ratio, share);
        Ends { aspect_ratio, impulse: of(added_mass), force: of(force) }
    }
}

impl Factor {
    fn between(aspect_ratio: f64, share: fn(f64, &[f64; 4]) -> f64) -> Factor {
        let both = |ratio: f64| [share(ratio, &PABST), share(ratio, &PLATE)];
        let spread = |k: i32| {
            let [a, b] = both(aspect_ratio * NEIGHBOURHOOD.powf(f64::from(2 * k - STEPS) / f64::from(STEPS)));
            (a - b).abs() / (a + b)
        };
        let [a, b] = both(aspect_ratio);
        let value = 0.5 * (a + b);
        Factor { value, band: value * (0..=STEPS).map(spread).fold(0.0, f64::max) }
    }
}

/// RU7: added mass of a rectangular plate of length over breadth λ over that of a strip of an endless one, by the coefficients of s = λ/(1 + λ²).
fn added_mass(aspect_ratio: f64, coefficients: &[f64; 4]) -> f64 {
    let (s, root) = (aspect_ratio / (1.0 + aspect_ratio * aspect_ratio), aspect_ratio.hypot(1.0));
    aspect_ratio / root * (1.0 - s * polynomial(s, coefficients))
}

/// RU8: k = f − ½ λ df/dλ.
fn force(aspect_ratio: f64, coefficients: &[f64; 4]) -> f64 {
    let squared = aspect_ratio * aspect_ratio;
    let (s, root) = (aspect_ratio / (1.0 + squared), aspect_ratio.hypot(1.0));
    let [a, b, c, d] = *coefficients;
    let lost = s * polynomial(s, coefficients);
    let rate = a + s * (2.0 * b + s * (3.0 * c + s * 4.0 * d)); // of the loss with s
    // λ d/dλ of λ/√(1+λ²) and of s
    let of_root = aspect_ratio / root / (1.0 + squared);
    let of_s = s * (1.0 - squared) / (1.0 + squared);
    let growth = of_root * (1.0 - lost) - aspect_ratio / root * rate * of_s;
    added_mass(aspect_ratio, coefficients) - 0.5 * growth
}

fn polynomial(s: f64, [a, b, c, d]: &[f64; 4]) -> f64 {
    a + s * (b + s * (c + s * d))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Table A-2 of DNV-RP-H103 (2011), which holds Meyerhoff's (1970) plates: length over breadth, added mass over that of a strip.
    const TABLE: [[f64; 2]; 10] = [
        [1.0, 0.579],
        [1.25, 0.642],
        [1.5, 0.690],
        [2.0, 0.757],
        [2.5, 0.801],
        [4.0, 0.872],
        [5.0, 0.897],
        [6.25, 0.917],
        [8.0, 0.934],
        [10.0, 0.947],
    ];

    #[test]
    fn the_plate_is_that_of_the_table() {
        for [ratio, listed] in TABLE {
            assert!((added_mass(ratio, &PLATE) - listed).abs() < 1.1e-3, "{ratio}: {}", added_mass(ratio, &PLATE));
        }
    }

    #[test]
    fn a_plate_is_the_same_whichever_side_is_called_length() {
        for ratio in [0.1, 0.5, 0.8, 1.0] {
            for of in [&PABST, &PLATE] {
                let (long, wide) = (added_mass(1.0 / ratio, of), added_mass(ratio, of));
                assert!((wide - ratio * long).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn the_force_is_the_rate_of_the_added_mass() {
        // F over the endless strip's: d(c² f(L/2c))/dc over d(c²)/dc
        for ratio in [0.3, 1.0, 2.7, 9.0] {
            for of in [&PABST, &PLATE] {
                let mass = |c: f64| c * c * added_mass(ratio / c, of);
                let rate = (mass(1.0 + 1e-5) - mass(1.0 - 1e-5)) / 4e-5;
                assert!((force(ratio, of) - rate).abs() < 1e-9, "{ratio}: {} {rate}", force(ratio, of));
            }
        }
    }

    #[test]
    fn long_bottoms_lose_nothing_and_the_band_never_vanishes() {
        assert!((Ends::of_aspect_ratio(1e4).force.value - 1.0).abs() < 1e-3);
        for k in 0..60 {
            let Ends { impulse, force, .. } = Ends::of_aspect_ratio(0.2 * 1.1_f64.powi(k));
            assert!(force.value < impulse.value && impulse.value < 1.0);
            assert!(force.value > 0.0 && impulse.band > 0.001 * impulse.value && force.band < 0.08 * force.value);
        }
    }
}
