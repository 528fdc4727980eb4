//! Sizes of the elements along a line of nodes.

use std::f64::consts::{FRAC_PI_4, FRAC_PI_6};

use faer::c64;

/// Elements of the finest size next to the jet's end.
const FINE_ELEMENTS: f64 = 8.0;

/// Deadrises between which the longest step changes [deg].
const FLAT_AND_STEEP: [f64; 2] = [15.0, 25.0];

/// Sizes of the elements, and how far nodes move among them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sizes {
    /// Elements next to the jet, over the usual ones [-].
    pub jet: f64,
    /// Growth of the elements per length away from the jet and from knuckles [-].
    pub growth: f64,
    /// Is β quadratic on them? About bottoms that bend it is linear, which damps the sawtooth that grows on their surfaces.
    pub quadratic: bool,
    /// What is added to their growth on the upper surface beyond the half breadth from the jet, while the chine is dry.
    pub far: f64,
    /// Element at the keel over the wetted length: up to 30°, up to 45°, and beyond, where the potential bends more.
    pub keel: [f64; 3],
    /// Longest way of a node per step with a past, over the length of its element, about flat faces and about steep ones.
    pub courant: [f64; 2],
}

impl Sizes {
    /// About a straight wedge.
    pub const WEDGE: Sizes =
        Sizes { jet: 1.0, growth: 0.16, quadratic: true, far: 0.1, keel: [1e-2, 1e-3, 1e-4], courant: [1.8, 1.5] };
    /// About a bottom on which the flow meets knuckles or leaves it between keel and chine.
    pub const BENT: Sizes =
        Sizes { jet: 1.0, growth: 0.1, quadratic: false, far: 0.0, keel: [1e-3, 1e-3, 1e-4], courant: [1.1, 1.1] };
    /// About two deadrises.
    pub const ROLLED: Sizes =
        Sizes { jet: 1.0, growth: 0.16, quadratic: true, far: 0.0, keel: [1e-2, 1e-2, 1e-3], courant: [1.8, 1.5] };

    /// Element at a keel of an `angle` [rad] over the wetted length.
    pub fn at_keel(&self, angle: f64) -> f64 {
        self.keel[usize::from(angle > FRAC_PI_6) + usize::from(angle > FRAC_PI_4)]
    }

    /// Size of an element at a distance from the end of a line where the elements have the `finest` size [m].
    pub fn grown(&self, finest: f64, distance: f64) -> f64 {
        finest + self.growth * (distance - FINE_ELEMENTS * finest).max(0.0)
    }

    /// Longest way of a node per step with a past about a face at an `angle` [rad], over the length of its element.
    pub fn courant_at(&self, angle: f64) -> f64 {
        let ([flat, steep], [of_flat, of_steep]) = (FLAT_AND_STEEP, self.courant);
        let share = ((angle.to_degrees() - flat) / (steep - flat)).clamp(0.0, 1.0);
        of_flat + share * (of_steep - of_flat)
    }
}

/// Lengths along nodes from the first one [m].
pub(super) fn arc_length(z: &[c64]) -> Vec<f64> {
    let mut s = 0.0;
    std::iter::once(0.0)
        .chain(z.windows(2).map(|pair| {
            s += (pair[1] - pair[0]).norm_sqr().sqrt();
            s
        }))
        .collect()
}

/// Distances from 0 to `length`, whose steps are about `size` of the distance. All of them change with the length: nodes that keep their places next
/// to the jet leave a sawtooth on the surface, which grows.
pub(super) fn graded(length: f64, size: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut at = vec![0.0];
    while let Some(&last) = at.last().filter(|&&last| last < length) {
        at.push(last + size(last));
    }
    let reached = at[at.len() - 1];
    at.iter().map(|x| x * length / reached).collect()
}
