//! The flow at an instant (THEORY EN21, EN23, EN24): velocity, rate of the potential, load.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, PI};

use faer::c64;

use super::cauchy::{Complex, Contour};
use super::elements::graded;
use super::spline::Spline;
use super::state::EntryFlow;
use super::surface::{FreeSurface, SurfaceFlow};

/// The largest size of elements on a face, over the wetted length.
const LARGEST: f64 = 0.06;

/// Places through which the pressure next to a keel goes, over the wetted length of the face there.
const OF_KEEL_LAW: [f64; 2] = [5e-3, 1e-2];

/// One solution of the flow.
pub(super) struct Solution {
    pub above: SurfaceFlow,
    /// Of the surface that left the chine; empty where it is dry.
    pub below: SurfaceFlow,
    /// Nodes of the contour.
    pub nodes: Vec<c64>,
    /// φ and ψ there [m²/s].
    pub beta: Complex,
    /// The node at which the face begins.
    pub contact: usize,
    /// Distances of the face's nodes from the keel along it [m].
    pub along: Vec<f64>,
}

/// The flow on the sides of a body, and its load.
pub(super) struct Solved<const N: usize, L> {
    pub sides: [Solution; N],
    pub load: L,
    /// Upward force at constant speed over the density [m³/s²].
    pub force: f64,
}

/// The flow about a symmetric section.
pub(super) type SymmetricSolution = Solved<1, FlowLoad>;

/// The right half of the contour: upper surface, cut, underside, face down to the keel.
pub(super) struct Nodes {
    pub z: Vec<c64>,
    /// The last node of the upper surface.
    pub end: usize,
    /// The node at which the cut meets the lower side.
    pub foot: usize,
    /// The node at which the face begins.
    pub contact: usize,
    /// Distances of the nodes of the face from the keel along it [m].
    pub along: Vec<f64>,
}

impl EntryFlow {
    /// EN21 for β and its time derivative, EN23.
    pub(super) fn solve(&self) -> SymmetricSolution {
        self.solve_keeping_matrix().0
    }

    /// The same with the factorised matrix of this instant.
    pub(super) fn solve_keeping_matrix(&self) -> (SymmetricSolution, Contour) {
        let speed = &self.keel_speed();
        let of = self.contour();
        let Nodes { z: nodes, end, foot, contact, along } = &of;
        let (n, end, foot, contact) = (nodes.len(), *end, *foot, *contact);
        let corners = [end, foot, contact];
        let corners = self.sizes.quadratic.then_some(&corners[..]);
        let contour = Contour::new(nodes, contact, corners);

        // velocity: φ on the surfaces and along the cut, ψ = V x on the body
        let bending = self.face.is_bent().then(|| self.bending(along));
        let of_bending = |k: usize| bending.as_ref().map_or(0.0, |bending| bending.psi[k - contact]);
        let psi = (0..n).map(|k| if k < contact { 0.0 } else { speed * nodes[k].re + of_bending(k) }).collect();
        let mut beta = Complex { phi: self.potential(nodes, end, foot), psi };
        contour.solve(&mut beta);
        let [above, below] = self.surface_velocities(&of, &beta);
        let mut on_body = self.face_velocities(along, &beta.phi[contact..]);
        if let Some(keel) = on_body.last_mut() {
            *keel = self.body_velocity(0.0);
        }

        // φ_t: p = 0 on the surfaces and in the cut; ψ_t of the body's motion
        let phi_t = |velocity: &c64, z: &c64| self.rate_on_surface(velocity, z);
        let rate_at = |k: usize| match k {
            _ if k <= end => phi_t(&above[k], &nodes[k]),
            _ if k > contact => 0.0,
            _ if k >= foot && !below.is_empty() => phi_t(&below[k - foot], &nodes[k]),
            _ => phi_t(&above[end], &nodes[end]),
        };
        let psi_t = |k: usize| match &bending {
            _ if k < contact => 0.0,
            None => speed * on_body[k - contact].re,
            Some(bending) => bending.rate_of_psi(k - contact, on_body[k - contact]),
        };
        let mut rate = Complex { phi: (0..n).map(rate_at).collect(), psi: (0..n).map(psi_t).collect() };
        contour.solve(&mut rate);
        let x_on_body = |k: usize| if k < contact { 0.0 } else { nodes[k].re };
        let mut per_acceleration = Complex { phi: vec![0.0; n], psi: (0..n).map(x_on_body).collect() };
        contour.solve(&mut per_acceleration);

        let pressure_at = |k: usize| {
            let moving = rate.phi[k] + 0.5 * on_body[k - contact].norm_sqr();
            let steady = match self.face.level(nodes[k].re, self.draught) {
                None => (moving + self.gravity * nodes[k].im) * self.speed / speed,
                Some(level) => moving * self.speed / speed + self.gravity * level,
            };
            [nodes[k].re, -steady, -per_acceleration.phi[k]]
        };
        let mut pressure: Vec<[f64; 3]> = (contact..n).map(pressure_at).collect();
        self.follow_keel_law(along, &mut pressure);
        let load = FlowLoad::of(pressure).with_dry_end();
        (Solved { force: load.force, load, sides: [self.solution(of, beta, [above, below])] }, contour)
    }

    /// φ_t where p = 0 [m²/s²].
    fn rate_on_surface(&self, velocity: &c64, z: &c64) -> f64 {
        -0.5 * velocity.norm_sqr() - self.gravity * z.im
    }

    /// Velocities u + iv [m/s] of the upper surface and of the one that left the chine.
    pub(super) fn surface_velocities(&self, of: &Nodes, beta: &Complex) -> [Vec<c64>; 2] {
        let below = |surface: &FreeSurface| surface.velocity(&beta.psi[of.foot..=of.contact]);
        let mut below = self.underside.as_ref().map_or_else(Vec::new, below);
        if let Some(at_chine) = below.last_mut() {
            // the water leaves the chine as it comes along the face
            *at_chine = self.on_face(self.face.length(), slope_at_edge(&of.along, &beta.phi[of.contact..]));
        }
        [self.surface.velocity(&beta.psi[..=of.end]), below]
    }

    /// The solution of a side with velocities of its surfaces. A node that moves with v: dφ/dt = φ_t + v·∇φ; the chine moves with the body.
    pub(super) fn solution(&self, of: Nodes, beta: Complex, [above, below]: [Vec<c64>; 2]) -> Solution {
        let Nodes { z: nodes, foot, contact, along, .. } = of;
        let with_water = |(v, z): (&c64, &c64)| v.norm_sqr() + self.rate_on_surface(v, z);
        let mut rate_below: Vec<f64> = below.iter().zip(&nodes[foot..]).map(with_water).collect();
        if let (Some(at_chine), Some(v)) = (rate_below.last_mut(), below.last()) {
            let edge = self.body_velocity(self.face.length());
            *at_chine = self.rate_on_surface(v, &self.face.edge()) + (v * edge.conj()).re;
        }
        let rate_above = above.iter().zip(&nodes).map(with_water).collect();
        let in_axes = |velocity: Vec<c64>| velocity.into_iter().map(|v| v - self.drift).collect();
        Solution {
            above: SurfaceFlow { velocity: in_axes(above), rate: rate_above },
            below: SurfaceFlow { velocity: in_axes(below), rate: rate_below },
            beta,
            nodes,
            contact,
            along,
        }
    }

    /// GE21: the pressure next to a keel above 30° is p₀ − C sᵐ, s the distance from it; there φ_t has a part of s^{m/2}, which straight elements miss.
    fn follow_keel_law(&self, along: &[f64], pressure: &mut [[f64; 3]]) {
        let deadrise = self.face.place(0.0).tangent.arg();
        if !self.face.is_keeled() || deadrise <= FRAC_PI_6 {
            return;
        }
        let reach = along[0].min(self.face.first_length());
        let power = 2.0 * (PI / (FRAC_PI_2 + deadrise) - 1.0);
        let [near, far] = OF_KEEL_LAW.map(|share| along.partition_point(|s| *s > share * reach) - 1);
        let [of_near, of_far] = [near, far].map(|k| along[k].powf(power));
        if near == far {
            return;
        }
        let falls = (pressure[near][1] - pressure[far][1]) / (of_far - of_near);
        for k in near + 1..along.len() {
            pressure[k][1] = pressure[near][1] + falls * (of_near - along[k].powf(power));
        }
    }

    /// φ on the surfaces and, linear, along the cut; 0 on the face [m²/s]. Across an attached jet it grows with the body's speed normal to its
    /// face.
    pub(super) fn potential(&self, nodes: &[c64], end: usize, foot: usize) -> Vec<f64> {
        let EntryFlow { face, surface, underside, .. } = self;
        let across = || {
            let on_face = face.nearest(nodes[end], true);
            -(self.body_velocity(on_face.along) * on_face.tangent.conj()).im * (on_face.z - nodes[end]).norm()
        };
        let of_end = surface.phi[end];
        let of_foot = underside.as_ref().map_or_else(|| of_end - across(), |underside| underside.phi[0]);
        let share = |k: usize| (nodes[k] - nodes[end]).norm() / (nodes[foot] - nodes[end]).norm();
        let mut phi = surface.phi.clone();
        phi.extend((end + 1..=foot).map(|k| of_end + (of_foot - of_end) * share(k)));
        phi.extend(underside.iter().flat_map(|underside| &underside.phi[1..]));
        phi.resize(nodes.len(), 0.0);
        phi
    }

    pub(super) fn contour(&self) -> Nodes {
        let EntryFlow { face, surface, underside, .. } = self;
        let end = surface.end();
        let size = self.lower_side().finest(end);
        let of_face = face.nearest(end, true);
        let below = underside.as_ref().map_or(of_face.z, |underside| underside.z[0]);
        let mut z = surface.z.clone();
        let last = z.len() - 1;
        let elements = ((below - end).norm() / size).ceil().max(2.0);
        z.extend((1..=elements as usize).map(|k| end + (below - end) * (k as f64 / elements)));
        let foot = z.len() - 1;
        z.extend(underside.iter().flat_map(|underside| &underside.z[1..]));
        let contact = z.len() - 1;
        let wetted = if underside.is_some() { face.length() } else { of_face.along };
        let [at_keel, largest] = [self.sizes.at_keel(face.place(0.0).tangent.arg()), LARGEST].map(|x| x * wetted);
        let from_keel =
            |s: f64| if face.is_keeled() { at_keel + self.sizes.growth * (wetted - s).max(0.0) } else { largest };
        // next to a wet chine no smaller ones than on the surface that leaves it: they would need shorter steps
        let least = if underside.is_some() { size } else { 0.0 };
        let of_knuckles = |s: f64| face.size_at(wetted - s, self.sizes.growth).max(least);
        let from_end = graded(wetted, |s| self.sizes.grown(size, s).min(from_keel(s)).min(largest).min(of_knuckles(s)));
        let mut along: Vec<f64> = from_end.iter().map(|s| wetted - s).collect();
        if let Some(keel) = along.last_mut() {
            *keel = 0.0;
        }
        z.extend(along[1..].iter().map(|s| face.place(*s).z));
        Nodes { z, end: last, foot, contact, along }
    }

    /// Velocities u + iv of the water on the face at distances `along` it [m/s].
    pub(super) fn face_velocities(&self, along: &[f64], phi: &[f64]) -> Vec<c64> {
        let from_end: Vec<f64> = along.iter().map(|s| along[0] - s).collect();
        let slopes = Spline::new(&from_end, phi.iter().copied()).slopes();
        along.iter().zip(slopes).map(|(s, slope)| self.on_face(*s, slope)).collect()
    }

    /// Velocity u + iv [m/s] at a place `along` the face where φ grows by `slope` [m/s] towards the keel.
    fn on_face(&self, along: f64, slope: f64) -> c64 {
        let down = -self.face.place(along).tangent;
        (c64::new(slope, (self.body_velocity(along).conj() * down).im) / down).conj()
    }
}

/// EN24: φ_s at an edge at which the flow separates, s the distance from it: U of φ = φ₀ + U s + A s^{3/2} through the first three nodes.
fn slope_at_edge(along: &[f64], phi: &[f64]) -> f64 {
    let at = |k: usize| {
        let s = along[0] - along[k];
        [s.sqrt(), (phi[k] - phi[0]) / s] // the second is U + A √s
    };
    let ([root, secant], [further_root, further_secant]) = (at(1), at(2));
    (secant * further_root - further_secant * root) / (further_root - root)
}

impl Solution {
    /// Nodes of the face from the jet or the chine to the keel.
    pub fn face(&self) -> &[c64] {
        &self.nodes[self.contact..]
    }

    /// φ on the face [m²/s].
    pub fn phi_on_face(&self) -> &[f64] {
        &self.beta.phi[self.contact..]
    }

    /// Kinetic and potential energy of both halves over the density, ½ ∮ φ dψ − ½ g ∮ y² dx [m⁴/s²].
    #[cfg(test)]
    pub fn energy(&self, gravity: f64) -> f64 {
        let Complex { phi, psi } = &self.beta;
        let kinetic = phi.windows(2).zip(psi.windows(2)).map(|(phi, psi)| 0.5 * (phi[0] + phi[1]) * (psi[1] - psi[0]));
        let potential = self.nodes.windows(2).map(|z| {
            let [a, b] = [z[0].im, z[1].im];
            gravity * (z[0].re - z[1].re) * (a * a + a * b + b * b) / 3.0
        });
        kinetic.sum::<f64>() + potential.sum::<f64>()
    }
}

/// Load of the water on both halves, over its density.
#[derive(Clone, Debug)]
pub struct FlowLoad {
    /// Upward force at constant speed F/ρ [m³/s²].
    pub force: f64,
    /// Added mass M/ρ [m²]: the force grows by it times the downward acceleration.
    pub added_mass: f64,
    /// From the jet or the chine to the keel: distance from the plane of symmetry [m], p/ρ at constant speed [m²/s²], p/ρ per downward
    /// acceleration [m], shape (n, 3).
    pub pressure: Vec<[f64; 3]>,
}

impl FlowLoad {
    /// The end of the cut is at the pressure of the air; the force keeps the small tension that is computed there.
    fn with_dry_end(mut self) -> FlowLoad {
        self.pressure[0][1] = 0.0;
        self
    }

    /// Of pressures on the right half, whose image has the same.
    fn of(pressure: Vec<[f64; 3]>) -> FlowLoad {
        let over_breadth =
            |of: usize| -> f64 { pressure.windows(2).map(|p| (p[0][of] + p[1][of]) * (p[0][0] - p[1][0])).sum() };
        FlowLoad { force: over_breadth(1), added_mass: over_breadth(2), pressure }
    }
}
