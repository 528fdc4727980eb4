//! Profile likelihood: how far a value may lie from that of the fit while the others follow it (Venzon & Moolgavkar 1988).
//!
//! Next to a kink of the curves their differences make values look better known than they are.

use super::least_squares::{Fit, minimise};

/// Share of the growth that is asked for, from which it is taken as quadratic [-].
const ENOUGH: f64 = 0.7;
/// Distance at which a value without an end of its interval counts as unknown.
const LONGEST: f64 = 0.5;

/// Distances to the ends of the interval of value `k`, below and above, at least the `half` of the linear fit: there the least sum of squares over
/// the other values is larger by `growth`; infinite where it is not. Residuals and their derivatives are those of all values.
pub fn reach(
    fit: &Fit,
    k: usize,
    [half, growth]: [f64; 2],
    residuals: impl Fn(&[f64]) -> Option<Vec<f64>>,
    slopes: impl Fn(&[f64]) -> Option<Vec<Vec<f64>>>,
) -> [f64; 2] {
    let spread = fit.covariance();
    let with = |others: &[f64], way: f64| {
        let mut at = others.to_vec();
        at.insert(k, fit.at[k] + way);
        at
    };
    let grown = |way: f64| {
        let follow = |j: usize| fit.at[j] + way * spread[k][j] / spread[k][k];
        let start: Vec<f64> = (0..fit.at.len()).filter(|j| *j != k).map(follow).collect();
        let of_others = |others: &[f64]| {
            let mut slopes = slopes(&with(others, way))?;
            slopes.remove(k);
            Some(slopes)
        };
        let least = if start.is_empty() {
            residuals(&with(&start, way))?.iter().map(|r| r * r).sum()
        } else {
            minimise(&start, |others| residuals(&with(others, way)), of_others)?.square()
        };
        Some(least - fit.square())
    };
    let to_side = |sign: f64| {
        let mut reach = half;
        while reach < LONGEST {
            match grown(sign * reach) {
                Some(grown) if grown < ENOUGH * growth => reach *= 2.0,
                Some(grown) => return half.max(reach * (growth / grown).sqrt()),
                None => return reach,
            }
        }
        f64::INFINITY
    };
    [-1.0, 1.0].map(to_side)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight line has its linear interval; a value that the residuals forget beyond a kink has a wider one.
    #[test]
    fn a_line_and_a_kink() {
        let x: Vec<f64> = (0..11).map(|k| 0.1 * f64::from(k)).collect();
        let of = |q: &[f64], kink: f64| x.iter().map(|x| q[0] + q[1].min(kink) * x).collect::<Vec<f64>>();
        let fit = Fit { at: vec![0.0; 2], residuals: vec![0.0; 11], jacobian: vec![vec![1.0; 11], x.clone()] };
        let sigma = 0.01 * fit.covariance()[1][1].sqrt();
        let slopes = |_: &[f64]| Some(vec![vec![1.0; 11], x.clone()]);
        let exact = reach(&fit, 1, [sigma, 1e-4], |q| Some(of(q, 1.0)), slopes);
        assert!(exact.iter().all(|end| (end / sigma - 1.0).abs() < 1e-6), "{exact:?} for {sigma}");
        let [below, above] = reach(&fit, 1, [sigma, 1e-4], |q| Some(of(q, 0.5 * sigma)), slopes);
        assert!((below / sigma - 1.0).abs() < 1e-6 && above.is_infinite(), "{below} and {above} for {sigma}");
    }
}
