//! Cauchy's integral over straight elements, on which β is quadratic (THEORY EN21): eight elements at a time by a series, near ones by the
//! logarithm.

use std::array::from_fn;
use std::ops::Range;

use faer::c64;
use pulp::{Arch, NullaryFnOnce};

use super::lanes::{LANES, Lanes, times, times_plus};

/// Factors of w, w², … in artanh(u)/u − 1, w = u².
const SERIES: [f64; 7] = [1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0, 1.0 / 9.0, 1.0 / 11.0, 1.0 / 13.0, 1.0 / 15.0];
/// Place of an element that fills a block and has no length [m].
const VERY_FAR: f64 = 1e30;
/// Largest |u|² of the series, whose error is 10⁻¹¹ at most; u is half the element over the distance of its middle.
const FAR: f64 = 0.04;
/// Largest |u|² at which four terms do, with an error of 10⁻¹⁰.
const VERY_SMALL: f64 = 6e-3;

/// Elements that are treated at a time: middles, half of the way from the first end to the second, and twice its square, x and y [m, m²].
#[derive(Clone, Copy, Default)]
struct Block {
    middle: [Lanes; 2],
    half: [Lanes; 2],
    square: [Lanes; 2],
    /// The square of half its length.
    size: Lanes,
}

/// Straight elements between the nodes of a line.
struct Elements {
    ends: Vec<[c64; 2]>,
    blocks: Vec<Block>,
}

/// Factors in the integral over an element of β at its first and its second end, and of the second divided difference of β on it.
#[derive(Clone, Copy)]
struct Factors {
    /// Real and imaginary part of the first, of the second, of the third.
    of: [Lanes; 6],
    /// |u|².
    near: Lanes,
}

/// Complex numbers along a line: real and imaginary parts.
type Numbers = [Vec<f64>; 2];

fn zeros(length: usize) -> Numbers {
    [vec![0.0; length], vec![0.0; length]]
}

/// Factors of what is known of the nodes and of what is not in the equation of a node: of ψ and φ on the body, of φ and ψ elsewhere.
pub(super) struct Row<'a> {
    pub known: &'a mut [f64],
    pub unknown: &'a mut [f64],
    /// Nodes on the body.
    pub body: Range<usize>,
    /// Is the imaginary part of the equation the one that counts?
    pub is_imaginary: bool,
}

impl Row<'_> {
    /// Add the factor of β of node `k`.
    pub fn add(&mut self, k: usize, own: c64) {
        let [phi, psi] = if self.is_imaginary { [own.im, own.re] } else { [own.re, -own.im] };
        let [known, unknown] = if self.body.contains(&k) { [psi, phi] } else { [phi, psi] };
        self.known[k] += known;
        self.unknown[k] += unknown;
    }

    /// Add the factor of iψ of node `k`, which is not on the body.
    pub fn add_stream(&mut self, k: usize, own: c64) {
        self.unknown[k] += if self.is_imaginary { own.re } else { -own.im };
    }

    /// The factors of β of all nodes.
    #[inline(always)]
    fn write(&mut self, [re, im]: [&[f64]; 2]) {
        let (phi, psi, sign) = if self.is_imaginary { (im, re, 1.0) } else { (re, im, -1.0) };
        let Range { start, end } = self.body;
        for (of, is_body) in [(0..start, false), (start..end, true), (end..re.len(), false)] {
            let [known, unknown] = [&mut self.known[of.clone()], &mut self.unknown[of.clone()]];
            let [of_phi, of_psi] = if is_body { [unknown, known] } else { [known, unknown] };
            of_phi.copy_from_slice(&phi[of.clone()]);
            of_psi.iter_mut().zip(&psi[of]).for_each(|(to, psi)| *to = sign * psi);
        }
    }
}

/// The second divided difference of β at the nodes between the first and the last.
struct SecondDifferences {
    /// Factors of β of the node before, of the node itself and of the node after it, with a zero before and after; 0 at corners.
    factors: [Numbers; 3],
    /// Shares that the elements before and after take of it.
    shares: [Vec<f64>; 2],
}

/// The elements of a contour.
pub(super) struct Influence {
    elements: Elements,
    /// Of a quadratic β.
    differences: Option<SecondDifferences>,
    /// Is the contour the right half of a symmetric one?
    is_half: bool,
    integrals: Integrals,
    arch: Arch,
}

/// What is integrated for a node.
struct Integrals {
    /// Of the elements, as [`Factors`], after a zero.
    of: [Vec<f64>; 6],
    /// Of the second divided difference of each node, with a zero before and after.
    of_difference: Numbers,
    /// Of β of each node.
    beta: Numbers,
}

impl Influence {
    /// Of the elements between the nodes of a whole contour. β is smooth along it between `corners`, and quadratic on each element; linear without.
    pub fn whole(z: &[c64], corners: Option<&[usize]>) -> Influence {
        let elements = Elements::new(z);
        let padded = elements.blocks.len() * LANES;
        let integrals = Integrals {
            of: [(); 6].map(|()| vec![0.0; padded + 1]),
            of_difference: zeros(z.len() + 2),
            beta: zeros(z.len()),
        };
        Influence {
            elements,
            differences: corners.map(|corners| SecondDifferences::new(z, corners)),
            is_half: false,
            integrals,
            arch: Arch::new(),
        }
    }

    /// Of those of the right half of a symmetric contour and of their mirror images, whose β is the conjugate.
    pub fn symmetric(z: &[c64], corners: Option<&[usize]>) -> Influence {
        Influence { is_half: true, ..Influence::whole(z, corners) }
    }

    /// ∫ β/(z − `at`) dz over all elements, written to a row. At an end that is `at` the singular part is left to the node.
    pub fn write(&mut self, at: c64, row: &mut Row<'_>) {
        let Influence { elements, differences, is_half, integrals, arch } = self;
        let differences = differences.as_ref();
        arch.dispatch(Writing { elements, differences, is_half: *is_half, integrals, at, row });
    }
}

impl SecondDifferences {
    /// Of the nodes `z`, of which `corners` have none.
    fn new(z: &[c64], corners: &[usize]) -> SecondDifferences {
        let inner = z.len() - 2;
        let mut differences = SecondDifferences {
            factors: [(); 3].map(|()| zeros(z.len() + 2)),
            shares: [(); 2].map(|()| vec![0.0; inner]),
        };
        let is_smooth = |k: usize| 0 < k && k <= inner && !corners.contains(&k);
        for k in (1..=inner).filter(|k| is_smooth(*k)) {
            let [before, after] = [z[k] - z[k - 1], z[k + 1] - z[k]];
            let both = before + after;
            let of = [(before * both).inv(), -(before * after).inv(), (after * both).inv()];
            for ([re, im], of) in differences.factors.iter_mut().zip(of) {
                (re[k + 1], im[k + 1]) = (of.re, of.im);
            }
            for (shares, next) in differences.shares.iter_mut().zip([k - 1, k + 1]) {
                shares[k - 1] = if is_smooth(next) { 0.5 } else { 1.0 };
            }
        }
        differences
    }
}

impl Integrals {
    /// The first factors of all elements for a node and its mirror image, each with the sign with which it counts.
    #[inline(always)]
    fn take<const FACTORS: usize>(&mut self, elements: &Elements, places: &[(f64, c64)]) {
        for (number, block) in elements.blocks.iter().enumerate() {
            let start = number * LANES;
            let mut sum = [Lanes::default(); FACTORS];
            for place in places {
                elements.add(block, start, *place, &mut sum);
            }
            for k in 0..FACTORS {
                self.of[k][1 + start..][..LANES].copy_from_slice(&sum[k].0);
            }
        }
    }

    /// Of β of each node, linear on the elements.
    #[inline(always)]
    fn gather(&mut self) {
        for part in 0..2 {
            let n = self.beta[part].len();
            let beta = &mut self.beta[part][..n];
            let [first, second] = [&self.of[part][1..][..n - 1], &self.of[2 + part][..n]];
            for k in 0..n - 1 {
                beta[k] = first[k] + second[k];
            }
            beta[n - 1] = second[n - 1];
        }
    }

    /// What is added where it is quadratic.
    #[inline(always)]
    fn gather_second(&mut self, differences: &SecondDifferences) {
        let Integrals { of, of_difference, beta } = self;
        let inner = differences.shares[0].len();
        let n = inner + 2;
        let [of_before, of_after] = [&differences.shares[0][..inner], &differences.shares[1][..inner]];
        for part in 0..2 {
            let third = &of[4 + part];
            let (before, after, of_difference) =
                (&third[1..][..inner], &third[2..][..inner], &mut of_difference[part][2..][..inner]);
            for k in 0..inner {
                of_difference[k] = of_before[k] * before[k] + of_after[k] * after[k];
            }
        }
        let [re, im] = beta;
        // node k is the node after k − 1, itself, and the node before k + 1
        let [re, im] = [&mut re[..n], &mut im[..n]];
        for (shift, factors) in differences.factors.iter().rev().enumerate() {
            let [d_re, d_im] = [&of_difference[0][shift..][..n], &of_difference[1][shift..][..n]];
            let [w_re, w_im] = [&factors[0][shift..][..n], &factors[1][shift..][..n]];
            for k in 0..n {
                re[k] = d_re[k].mul_add(w_re[k], (-d_im[k]).mul_add(w_im[k], re[k]));
                im[k] = d_re[k].mul_add(w_im[k], d_im[k].mul_add(w_re[k], im[k]));
            }
        }
    }
}

impl Elements {
    /// Between the nodes of a line.
    fn new(z: &[c64]) -> Elements {
        let ends: Vec<[c64; 2]> = z.windows(2).map(|ends| [ends[0], ends[1]]).collect();
        let nothing = Block { middle: [Lanes::all(VERY_FAR); 2], ..Block::default() };
        let mut blocks = vec![nothing; ends.len().div_ceil(LANES)];
        for (k, [from, to]) in ends.iter().enumerate() {
            let (block, k) = (&mut blocks[k / LANES], k % LANES);
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let square = 2.0 * half * half;
            for (to, of) in [(&mut block.middle, middle), (&mut block.half, half), (&mut block.square, square)] {
                (to[0].0[k], to[1].0[k]) = (of.re, of.im);
            }
            block.size.0[k] = half.norm_sqr();
        }
        Elements { ends, blocks }
    }

    /// Add the first factors of a block of elements, which begins with number `start`, for a node, `sign` times.
    #[inline(always)]
    fn add<const FACTORS: usize>(
        &self,
        block: &Block,
        start: usize,
        (sign, at): (f64, c64),
        sum: &mut [Lanes; FACTORS],
    ) {
        let with = |of: [Lanes; 6]| from_fn(|k| of[k].times_plus(Lanes::all(sign), sum[k]));
        let factors = by_series(block, at);
        let all_are_far = factors.near.largest() < FAR;
        // both ways on their own: the far ones then stay in registers
        *sum = if all_are_far {
            with(factors.of)
        } else {
            with(replace_near(factors, &self.ends[start..self.ends.len().min(start + LANES)], at).of)
        };
    }
}

/// What [`Influence::write`] does, for vector instructions.
struct Writing<'a, 'b> {
    elements: &'a Elements,
    differences: Option<&'a SecondDifferences>,
    is_half: bool,
    integrals: &'a mut Integrals,
    at: c64,
    row: &'a mut Row<'b>,
}

impl NullaryFnOnce for Writing<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Writing { elements, differences, is_half, integrals, at, row } = self;
        // the conjugate of the factors of the images' β is that of the elements for the mirrored node, with the other sign
        let sign = if row.is_imaginary { 1.0 } else { -1.0 };
        let places = [(1.0, at), (sign, c64::new(-at.re, at.im))];
        let places = &places[..if is_half { 2 } else { 1 }];
        if let Some(differences) = differences {
            integrals.take::<6>(elements, places);
            integrals.gather();
            integrals.gather_second(differences);
        } else {
            integrals.take::<4>(elements, places);
            integrals.gather();
        }
        row.write([&integrals.beta[0], &integrals.beta[1]]);
    }
}

/// The logarithm in place of the series where an element is near.
#[inline(never)]
fn replace_near(mut factors: Factors, ends: &[[c64; 2]], at: c64) -> Factors {
    for (k, [from, to]) in ends.iter().enumerate() {
        let is_far = factors.near.0[k] < FAR;
        if !is_far {
            for (number, of) in by_logarithm([from - at, to - at]).into_iter().enumerate() {
                factors.of[2 * number].0[k] = of.re;
                factors.of[2 * number + 1].0[k] = of.im;
            }
        }
    }
    factors
}

/// With u half the element h over the distance of its middle, w = u², A = artanh u and E = A/u − 1: A + E, A − E and 2 h² (E/u − A).
#[inline(always)]
fn by_series(block: &Block, at: c64) -> Factors {
    let [x, y] = [block.middle[0] - Lanes::all(at.re), block.middle[1] - Lanes::all(at.im)];
    let inverse = x.times_plus(x, y * y).inverse();
    let [hx, hy] = block.half;
    let u = [hx.times_plus(x, hy * y) * inverse, hx.times_less(y, hy * x) * inverse];
    let near = block.size * inverse;
    let w = [(u[0] + u[1]) * (u[0] - u[1]), (u[0] + u[0]) * u[1]];
    // Σ c_k w^k = (c₀ + c₁ w) + w² (c₂ + c₃ w) + w⁴ (c₄ + c₅ w + c₆ w²)
    let squared = [(w[0] + w[1]) * (w[0] - w[1]), (w[0] + w[0]) * w[1]];
    let factor = |k: usize| Lanes::all(SERIES[k]);
    let linear = |k: usize| [w[0].times_plus(factor(k + 1), factor(k)), factor(k + 1) * w[1]];
    let (low, mut middle) = (linear(0), linear(2));
    if near.largest() > VERY_SMALL {
        let high = linear(4);
        let high = [squared[0].times_plus(factor(6), high[0]), squared[1].times_plus(factor(6), high[1])];
        middle = times_plus(squared, high, middle);
    }
    let sum = times_plus(squared, middle, low);
    let e = times(w, sum);
    let one_more = [e[0] + Lanes::all(1.0), e[1]];
    let a = times(u, one_more);
    let third = times(block.square, times(u, [sum[0] - one_more[0], sum[1] - one_more[1]]));
    Factors { of: [a[0] + e[0], a[1] + e[1], a[0] - e[0], a[1] - e[1], third[0], third[1]], near }
}

/// The same of an element from z₀ + `a` to z₀ + `b` at any distance.
fn by_logarithm([a, b]: [c64; 2]) -> [c64; 3] {
    let one = c64::new(1.0, 0.0);
    let size = |square: f64| 0.5 * square.ln();
    let way = b - a;
    let square = 0.5 * way * way;
    let [of_a, of_b] = [a, b].map(|z| z.norm_sqr());
    if a == c64::ZERO {
        return [c64::new(size(of_b), 0.0) - one, one, -square];
    }
    if b == c64::ZERO {
        return [-one, one - c64::new(size(of_a), 0.0), square];
    }
    let turn = b * a.conj();
    let log = c64::new(size(of_b / of_a), turn.im.atan2(turn.re));
    let second = one - a * log / way;
    // ∫ (z − a)(z − b)/z dz = a b log − ½ (a + b)(b − a)
    [log - second, second, a * b * log - 0.5 * (a + b) * way]
}

#[cfg(test)]
mod tests;
