//! Sizes of the elements along a line of nodes.

use faer::c64;

/// Growth of the elements per length away from the jet.
pub(super) const GROWTH: f64 = 0.1;
/// Elements of the finest size beside the jet's end.
const FINE_ELEMENTS: f64 = 8.0;

/// Lengths along nodes from the first one [m].
pub(super) fn arc_length(z: &[c64]) -> Vec<f64> {
    let mut s = 0.0;
    std::iter::once(0.0)
        .chain(z.windows(2).map(|pair| {
            s += (pair[1] - pair[0]).norm();
            s
        }))
        .collect()
}

/// Distances from 0 to about `length`, whose steps are `size` of the distance.
pub(super) fn graded(length: f64, size: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut at = vec![0.0];
    while let Some(&last) = at.last().filter(|&&last| last < length) {
        at.push(last + size(last));
    }
    let reached = at[at.len() - 1];
    at.iter().map(|x| x * length / reached).collect()
}

/// Size of an element at a distance from the end of a line where the elements have the `finest` size [m].
pub(super) fn grown(finest: f64, distance: f64) -> f64 {
    finest + GROWTH * (distance - FINE_ELEMENTS * finest).max(0.0)
}
