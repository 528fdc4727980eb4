//! Cauchy's integral over straight elements, of which β is linear (THEORY EN21): eight elements at a time by a series, near ones by the
//! logarithm.

use std::array::from_fn;
use std::ops::{Add, Mul, Sub};

use faer::c64;
use pulp::{Arch, NullaryFnOnce};

/// Numbers of as many elements as are treated at a time.
#[derive(Clone, Copy, Default)]
struct Lanes([f64; LANES]);

const LANES: usize = 8;
/// Factors of w, w², … in artanh(u)/u − 1, w = u².
const SERIES: [f64; 4] = [1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0, 1.0 / 9.0];
/// Place of an element that fills a block and has no length [m].
const VERY_FAR: f64 = 1e30;
/// Largest |u|² of the series, whose error is 10⁻¹¹ at most; u is half the element over the distance of its middle.
const FAR: f64 = 0.01;

impl Add for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn add(self, other: Lanes) -> Lanes {
        Lanes(from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn sub(self, other: Lanes) -> Lanes {
        Lanes(from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl Mul for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn mul(self, other: Lanes) -> Lanes {
        Lanes(from_fn(|k| self.0[k] * other.0[k]))
    }
}

impl Lanes {
    #[inline(always)]
    fn all(value: f64) -> Lanes {
        Lanes([value; LANES])
    }

    #[inline(always)]
    fn inverse(self) -> Lanes {
        Lanes(from_fn(|k| 1.0 / self.0[k]))
    }
}

/// Product of complex numbers.
#[inline(always)]
fn times(a: [Lanes; 2], b: [Lanes; 2]) -> [Lanes; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// Middles of elements, and half of the way from their first end to their second, x and y [m].
#[derive(Clone, Copy, Default)]
struct Block {
    middle: [Lanes; 2],
    half: [Lanes; 2],
}

/// Straight elements between the nodes of a line.
struct Elements {
    ends: Vec<[c64; 2]>,
    blocks: Vec<Block>,
}

/// Factors of β at the first and the second end of elements in the integral, real and imaginary part.
#[derive(Clone, Copy)]
struct Factors {
    first: [Lanes; 2],
    second: [Lanes; 2],
    /// |u|².
    near: Lanes,
}

/// Factors of φ and ψ of the nodes in the equation of a node.
pub(super) struct Row<'a> {
    /// As long as [`Row::length`] says; what is beyond the nodes is of no meaning.
    pub phi: &'a mut [f64],
    pub psi: &'a mut [f64],
    /// Is the imaginary part of the equation the one that counts?
    pub is_imaginary: bool,
}

impl Row<'_> {
    /// Length of a row of factors for a number of nodes.
    pub fn length(nodes: usize) -> usize {
        (nodes - 1).div_ceil(LANES) * LANES + 1
    }

    /// Add the factor of β of node `k`.
    pub fn add(&mut self, k: usize, own: c64) {
        let [phi, psi] = if self.is_imaginary { [own.im, own.re] } else { [own.re, -own.im] };
        self.phi[k] += phi;
        self.psi[k] += psi;
    }

    /// Add the factor of iψ of node `k`.
    pub fn add_stream(&mut self, k: usize, own: c64) {
        self.psi[k] += if self.is_imaginary { own.re } else { -own.im };
    }
}

/// The elements of a contour.
pub(super) struct Influence {
    own: Elements,
    /// Those of the other half of a symmetric contour.
    image: Option<Elements>,
    arch: Arch,
}

impl Influence {
    /// Of the elements between the nodes of a whole contour.
    pub fn whole(z: &[c64]) -> Influence {
        let own = Elements::new(z.windows(2).map(|ends| [ends[0], ends[1]]));
        Influence { own, image: None, arch: Arch::new() }
    }

    /// Of the elements between the nodes of the right half of a symmetric contour and of their mirror images, whose β is the conjugate.
    pub fn symmetric(z: &[c64]) -> Influence {
        let mirrored = |z: c64| c64::new(-z.re, z.im);
        let image = Elements::new(z.windows(2).map(|ends| [mirrored(ends[1]), mirrored(ends[0])]));
        Influence { image: Some(image), ..Influence::whole(z) }
    }

    /// ∫ β/(z − `at`) dz over all elements, written to a row. At an end that is `at` the singular part is left to the node.
    pub fn write(&self, at: c64, row: &mut Row<'_>) {
        self.arch.dispatch(Writing { own: &self.own, image: self.image.as_ref(), at, row });
    }
}

impl Elements {
    fn new(ends: impl Iterator<Item = [c64; 2]>) -> Elements {
        let ends: Vec<[c64; 2]> = ends.collect();
        let nothing = Block { middle: [Lanes::all(VERY_FAR); 2], half: [Lanes::all(0.0); 2] };
        let mut blocks = vec![nothing; ends.len().div_ceil(LANES)];
        for (k, [from, to]) in ends.iter().enumerate() {
            let (block, k) = (&mut blocks[k / LANES], k % LANES);
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            (block.middle[0].0[k], block.middle[1].0[k]) = (middle.re, middle.im);
            (block.half[0].0[k], block.half[1].0[k]) = (half.re, half.im);
        }
        Elements { ends, blocks }
    }

    /// Factors of a block of elements for a node.
    #[inline(always)]
    fn factors(&self, block: usize, at: c64) -> Factors {
        let mut factors = by_series(&self.blocks[block], at);
        let largest = factors.near.0.iter().fold(0.0, |most: f64, size| if *size < most { most } else { *size });
        let all_are_far = largest < FAR;
        if !all_are_far {
            let first = block * LANES;
            replace_near(&mut factors, &self.ends[first..self.ends.len().min(first + LANES)], at);
        }
        factors
    }
}

/// What [`Influence::write`] does, for vector instructions.
struct Writing<'a, 'b> {
    own: &'a Elements,
    image: Option<&'a Elements>,
    at: c64,
    row: &'a mut Row<'b>,
}

impl NullaryFnOnce for Writing<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Writing { own, image, at, row } = self;
        let part = if row.is_imaginary { [1, 0] } else { [0, 1] };
        let sign = Lanes::all(if row.is_imaginary { 1.0 } else { -1.0 });
        let mut before = [0.0; 2];
        for block in 0..own.blocks.len() {
            let Factors { first, second, .. } = own.factors(block, at);
            let [mut of_phi, mut of_psi] = part.map(|part| [first[part], second[part]]);
            if let Some(image) = image {
                // the second end of an image is that of the first node, and ψ has the other sign
                let Factors { first, second, .. } = image.factors(block, at);
                of_phi = [of_phi[0] + second[part[0]], of_phi[1] + first[part[0]]];
                of_psi = [of_psi[0] - second[part[1]], of_psi[1] - first[part[1]]];
            }
            let start = block * LANES;
            let rows = [(&mut row.phi[start..], of_phi), (&mut row.psi[start..], of_psi.map(|of| of * sign))];
            for ((row, [first, second]), before) in rows.into_iter().zip(&mut before) {
                let after: [f64; LANES] = from_fn(|k| if k == 0 { *before } else { second.0[k - 1] });
                for k in 0..LANES {
                    row[k] = first.0[k] + after[k];
                }
                *before = second.0[LANES - 1];
            }
        }
        let end = own.blocks.len() * LANES;
        [row.phi[end], row.psi[end]] = before;
    }
}

/// The logarithm in place of the series where an element is near.
fn replace_near(factors: &mut Factors, ends: &[[c64; 2]], at: c64) {
    for (k, [from, to]) in ends.iter().enumerate() {
        let is_far = factors.near.0[k] < FAR;
        if !is_far {
            let [first, second] = by_logarithm([from - at, to - at]);
            (factors.first[0].0[k], factors.first[1].0[k]) = (first.re, first.im);
            (factors.second[0].0[k], factors.second[1].0[k]) = (second.re, second.im);
        }
    }
}

/// With u half the element over the distance of its middle, w = u², A = artanh u and E = A/u − 1: A + E and A − E.
#[inline(always)]
fn by_series(block: &Block, at: c64) -> Factors {
    let [x, y] = [block.middle[0] - Lanes::all(at.re), block.middle[1] - Lanes::all(at.im)];
    let inverse = (x * x + y * y).inverse();
    let [hx, hy] = block.half;
    let u = [(hx * x + hy * y) * inverse, (hy * x - hx * y) * inverse];
    let [xx, yy, xy] = [u[0] * u[0], u[1] * u[1], u[0] * u[1]];
    let (w, near) = ([xx - yy, xy + xy], xx + yy);
    // Σ c_k w^k = b₀ + b₁ (w − 2 Re w), b_k = c_k + 2 Re w b_{k+1} − |w|² b_{k+2}
    let (twice, square) = (w[0] + w[0], near * near);
    let [c0, c1, c2, c3] = SERIES.map(Lanes::all);
    let b2 = c2 + twice * c3;
    let b1 = c1 + twice * b2 - square * c3;
    let b0 = c0 + twice * b1 - square * b2;
    let sum = [b0 - b1 * w[0], b1 * w[1]];
    let e = times(w, sum);
    let a = times(u, [e[0] + Lanes::all(1.0), e[1]]);
    Factors { first: [a[0] + e[0], a[1] + e[1]], second: [a[0] - e[0], a[1] - e[1]], near }
}

/// The same of an element from z₀ + `a` to z₀ + `b` at any distance.
fn by_logarithm([a, b]: [c64; 2]) -> [c64; 2] {
    let one = c64::new(1.0, 0.0);
    let size = |z: c64| 0.5 * z.norm_sqr().ln();
    if a == c64::ZERO {
        return [c64::new(size(b), 0.0) - one, one];
    }
    if b == c64::ZERO {
        return [-one, one - c64::new(size(a), 0.0)];
    }
    let turn = b * a.conj();
    let log = c64::new(size(b) - size(a), turn.im.atan2(turn.re));
    let second = one - a * log / (b - a);
    [log - second, second]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_logarithm_agree() {
        let ends = [[1.0, 0.3], [1.1, 0.32], [1.3, 0.4], [2.0, 0.1], [2.2, -0.4], [2.25, -0.5], [2.2, -0.6]];
        let z: Vec<c64> = (0..3).flat_map(|n| ends.map(|[x, y]| c64::new(x, y - f64::from(n)))).collect();
        let places = [c64::new(-3.0, 0.5), c64::new(1.0, 8.0), z[2], z[15]];
        for (at, is_imaginary) in places.into_iter().flat_map(|at| [(at, false), (at, true)]) {
            for influence in [Influence::whole(&z), Influence::symmetric(&z)] {
                let length = Row::length(z.len());
                let [[mut phi, mut psi], mut exact] = [(); 2].map(|()| [(); 2].map(|()| vec![0.0; length]));
                influence.write(at, &mut Row { phi: &mut phi, psi: &mut psi, is_imaginary });
                let mut add = |k: usize, factor: c64, of_psi: f64| {
                    exact[0][k] += if is_imaginary { factor.im } else { factor.re };
                    exact[1][k] += of_psi * if is_imaginary { factor.re } else { -factor.im };
                };
                for (k, ends) in influence.own.ends.iter().enumerate() {
                    let [first, second] = by_logarithm(ends.map(|z| z - at));
                    add(k, first, 1.0);
                    add(k + 1, second, 1.0);
                }
                for (k, ends) in influence.image.iter().flat_map(|image| image.ends.iter().enumerate()) {
                    let [first, second] = by_logarithm(ends.map(|z| z - at));
                    add(k + 1, first, -1.0);
                    add(k, second, -1.0);
                }
                let all = [phi, psi].into_iter().flatten().zip(exact.into_iter().flatten());
                all.for_each(|(own, exact)| assert!((own - exact).abs() < 3e-11, "{at}: {own} for {exact}"));
            }
        }
    }
}
