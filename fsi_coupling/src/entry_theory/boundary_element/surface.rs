//! The free surface: nodes that move with the water, placed anew in each step, and the cut through the jet (THEORY EN22).

use std::f64::consts::PI;

use faer::c64;

use super::spline::Spline;

/// Element beside the jet, over Wagner's thickness of the jet c tan²β/(2π).
const FINEST: f64 = 0.35;
/// Largest thickness that counts, over c.
const THICKEST: f64 = 0.08;
/// Growth of the elements per length away from the jet.
pub(super) const GROWTH: f64 = 0.12;
/// Elements of the finest size beside the jet's end.
pub(super) const FINE_ELEMENTS: f64 = 8.0;
/// The jet begins where the surface is steeper than this against the face [rad].
const JET_ANGLE: f64 = 10.0 * PI / 180.0;
/// Length of the jet that is kept, over its thickness.
const KEPT: f64 = 2.0;
/// A tip that is not cut yet is bent: the jet is looked for between these distances from it, in finest elements.
const TIP: [f64; 2] = [2.0, 12.0];

/// A straight face at rest in its own axes: the keel at −i draught, at the deadrise β.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// Deadrise β [rad].
    pub beta: f64,
    /// Draught of the keel below still water [m].
    pub draught: f64,
}

impl Face {
    /// Unit vector from the keel outwards.
    pub fn direction(&self) -> c64 {
        c64::new(self.beta.cos(), self.beta.sin())
    }

    pub fn keel(&self) -> c64 {
        c64::new(0.0, -self.draught)
    }

    /// Distances of a point from the keel along the face, and from the face into the water [m].
    pub fn coordinates(&self, z: c64) -> [f64; 2] {
        let along = (z - self.keel()) * self.direction().conj();
        [along.re, -along.im]
    }

    /// The point of the face nearest to `z`.
    pub fn foot(&self, z: c64) -> c64 {
        self.keel() + self.direction() * self.coordinates(z)[0]
    }

    /// Size of the elements beside the jet's end [m].
    pub fn finest(&self, end: c64) -> f64 {
        let c = self.foot(end).re;
        FINEST * c * (self.beta.tan().powi(2) / (2.0 * PI)).min(THICKEST)
    }
}

/// The right half of the free surface, from far away to the face.
#[derive(Clone, Debug)]
pub(super) struct FreeSurface {
    /// Nodes x + iy [m].
    pub z: Vec<c64>,
    /// Potential φ there [m²/s].
    pub phi: Vec<f64>,
    /// The jet is cut: the last node is not on the face.
    pub cut: bool,
}

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

impl FreeSurface {
    /// Wagner's surface at rest: φ = 0 on y = x tan β (2/π) asin(c/x) − h, out to the distance `far`.
    pub fn at_first(face: &Face, far: f64) -> FreeSurface {
        let (slope, h) = (face.beta.tan(), face.draught);
        let c = 0.5 * PI * h / slope;
        let size = face.finest(c64::new(c, c * slope - h));
        let point = |distance: &f64| {
            let x = c + distance;
            c64::new(x, x * slope * (2.0 / PI) * (c / x).min(1.0).asin() - h)
        };
        let z: Vec<c64> = graded(far - c, |q| size + GROWTH * q).iter().rev().map(point).collect();
        FreeSurface { phi: vec![0.0; z.len()], z, cut: false }
    }

    /// The last node.
    pub fn end(&self) -> c64 {
        self.z[self.z.len() - 1]
    }

    /// Velocity u + iv of the water at the nodes [m/s] of φ and ψ there.
    pub fn velocity(&self, psi: &[f64]) -> Vec<c64> {
        let s = arc_length(&self.z);
        let slopes = |of: &mut dyn Iterator<Item = f64>| Spline::new(&s, of).slopes();
        let (x, y) = (slopes(&mut self.z.iter().map(|z| z.re)), slopes(&mut self.z.iter().map(|z| z.im)));
        let (phi, psi) = (slopes(&mut self.phi.iter().copied()), slopes(&mut psi.iter().copied()));
        (0..s.len()).map(|k| (c64::new(phi[k], psi[k]) / c64::new(x[k], y[k])).conj()).collect()
    }

    /// Moved over `dt` [s] with the velocities of its nodes and the rates of φ; an end on the face stays there.
    pub fn moved(&self, velocity: &[c64], rate: &[f64], dt: f64, face: &Face) -> FreeSurface {
        let mut moved = FreeSurface {
            z: self.z.iter().zip(velocity).map(|(z, v)| z + v * dt).collect(),
            phi: self.phi.iter().zip(rate).map(|(phi, rate)| phi + rate * dt).collect(),
            cut: self.cut,
        };
        if !moved.cut {
            let last = moved.z.len() - 1;
            moved.z[last] = face.foot(moved.z[last]);
        }
        moved
    }

    /// The jet cut, and nodes at distances that grow away from it.
    pub fn redistributed(&self, face: &Face) -> FreeSurface {
        let s = arc_length(&self.z);
        let (x, y) = (Spline::new(&s, self.z.iter().map(|z| z.re)), Spline::new(&s, self.z.iter().map(|z| z.im)));
        let phi = Spline::new(&s, self.phi.iter().copied());
        let at = |s: f64| c64::new(x.sample(s)[0], y.sample(s)[0]);
        let is_jet = |s: f64| {
            let against_face = (c64::new(x.sample(s)[1], y.sample(s)[1]) * face.direction().conj()).arg();
            (-0.5 * PI..JET_ANGLE).contains(&against_face)
        };
        let (whole, size) = (s[s.len() - 1], face.finest(self.end()));
        let found = self.jet_end(whole, size, &is_jet);
        let kept = found.map(|tip| (tip, root_of_jet(tip, size, &is_jet))).and_then(|(tip, root)| {
            let end = root + KEPT * face.coordinates(at(root))[1];
            (end < tip).then_some(end)
        });
        let end = kept.unwrap_or(whole);
        let mut nodes = graded(end, |q| size + GROWTH * (q - FINE_ELEMENTS * size).max(0.0));
        nodes.iter_mut().for_each(|q| *q = (end - *q).max(0.0));
        nodes.reverse();
        FreeSurface {
            z: nodes.iter().map(|&s| at(s)).collect(),
            phi: nodes.iter().map(|&s| phi.sample(s)[0]).collect(),
            cut: self.cut || kept.is_some(),
        }
    }

    /// Where the jet that may be cut ends, as a distance along the surface.
    fn jet_end(&self, whole: f64, size: f64, is_jet: &impl Fn(f64) -> bool) -> Option<f64> {
        let nearest = if self.cut { 0.0 } else { TIP[0] };
        let candidates = (0..).map(|k| nearest + 0.5 * f64::from(k)).take_while(|q| *q < TIP[1]);
        let at = candidates.map(|q| whole - (q + 0.01) * size);
        at.filter(|s| *s > TIP[0] * size).find(|&s| is_jet(s) && is_jet(s - 0.5 * size))
    }
}

/// Where the jet begins that ends at `tip`, by bisection.
fn root_of_jet(tip: f64, size: f64, is_jet: &impl Fn(f64) -> bool) -> f64 {
    let mut inside = tip;
    while inside > 0.0 && is_jet(inside) {
        inside -= 0.25 * size;
    }
    let (mut before, mut after) = (inside, (inside + 0.25 * size).min(tip));
    for _ in 0..30 {
        let middle = 0.5 * (before + after);
        if is_jet(middle) { after = middle } else { before = middle }
    }
    0.5 * (before + after)
}
