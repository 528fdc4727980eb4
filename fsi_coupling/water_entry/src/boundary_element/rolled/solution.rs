//! The flow about a rolled wedge at an instant, and its load (THEORY EN34, EN35).

use std::f64::consts::PI;

use faer::c64;

use super::super::cauchy::Complex;
use super::super::solution::{Nodes, Solved};
use super::super::state::EntryFlow;
use super::contour::WholeContour;

/// Load of the water on both faces of a rolled wedge, over its density. The moment is about the apex, counter-clockwise.
#[derive(Clone, Debug, Default)]
pub struct RolledLoad {
    /// Force at constant speed [F_x, F_y]/ρ [m³/s²], x to the right, y up.
    pub force: [f64; 2],
    /// Moment at constant speed M/ρ [m⁴/s²].
    pub moment: f64,
    /// What they grow by per downward acceleration: [F_x, F_y]/ρ [m²].
    pub added_mass: [f64; 2],
    /// The same of the moment [m³].
    pub added_moment: f64,
    /// Of the left and the right face, from the jet or the chine to the apex: distance from the apex along the face [m], p/ρ at constant speed
    /// [m²/s²], p/ρ per downward acceleration [m], shape (n, 3). The value at the apex, where p is −∞, is that with the right mean over the last
    /// element.
    pub pressure: [Vec<[f64; 3]>; 2],
}

impl RolledLoad {
    /// Of pressures right and left.
    fn of([right, left]: [Vec<[f64; 3]>; 2], tangents: [c64; 2]) -> RolledLoad {
        let [over_right, over_left] = [&right, &left].map(|pressure| {
            [1, 2].map(|of| {
                pressure.windows(2).fold([0.0; 2], |[force, moment], p| {
                    let (length, mean) = (p[0][0] - p[1][0], 0.5 * (p[0][of] + p[1][of]));
                    let arm = p[0][of] * (2.0 * p[0][0] + p[1][0]) + p[1][of] * (p[0][0] + 2.0 * p[1][0]);
                    [force + mean * length, moment + arm * length / 6.0]
                })
            })
        });
        let force = |of: usize| {
            let [r, l] = [over_right[of][0], over_left[of][0]];
            [l * tangents[1].im - r * tangents[0].im, r * tangents[0].re + l * tangents[1].re]
        };
        RolledLoad {
            force: force(0),
            moment: over_right[0][1] - over_left[0][1],
            added_mass: force(1),
            added_moment: over_right[1][1] - over_left[1][1],
            pressure: [left, right],
        }
    }
}

/// The flow about a rolled wedge: right and left, x outwards.
pub(super) type RolledSolution = Solved<2, RolledLoad>;

/// Values on the nodes of the whole contour, from those of its right and left side.
fn joined<T: Copy>([right, left]: [&[T]; 2], mirrored: impl Fn(T) -> T) -> Vec<T> {
    right.iter().copied().chain(left.iter().rev().skip(1).map(|value| mirrored(*value))).collect()
}

fn image(z: c64) -> c64 {
    c64::new(-z.re, z.im)
}

/// Velocities on a side.
struct Velocities {
    above: Vec<c64>,
    below: Vec<c64>,
    on_body: Vec<c64>,
}

/// φ and ψ of a side, whose nodes are the first `count` of the right, or the last of the left.
fn of_side(beta: &Complex, count: usize, is_left: bool) -> Complex {
    match is_left {
        false => Complex { phi: beta.phi[..count].to_vec(), psi: beta.psi[..count].to_vec() },
        true => Complex {
            phi: beta.phi.iter().rev().take(count).copied().collect(),
            psi: beta.psi.iter().rev().take(count).map(|psi| -psi).collect(),
        },
    }
}

impl Velocities {
    fn new(flow: &EntryFlow, nodes: &Nodes, beta: &Complex) -> Velocities {
        let [above, below] = flow.surface_velocities(nodes, beta);
        Velocities { above, below, on_body: flow.face_velocities(&nodes.along, &beta.phi[nodes.contact..]) }
    }

    /// φ_t in the wedge's axes, φ_t + U φ_x − V φ_y, where p = 0; 0 on the face.
    fn rates(&self, flow: &EntryFlow, nodes: &Nodes) -> Vec<f64> {
        let Nodes { z, end, foot, contact, .. } = nodes;
        let body = flow.keel_velocity();
        let body_rate = |v: &c64, z: &c64| -0.5 * v.norm_sqr() - flow.gravity * z.im + (v * body.conj()).re;
        let of_end = self.above[*end];
        let of_foot = *self.below.first().unwrap_or(&self.on_body[0]);
        let in_cut = |k: usize| {
            let share = (z[k] - z[*end]).norm() / (z[*foot] - z[*end]).norm();
            (1.0 - share) * body_rate(&of_end, &z[*end]) + share * body_rate(&of_foot, &z[*foot])
        };
        let at = |k: usize| match k {
            _ if k <= *end => body_rate(&self.above[k], &z[k]),
            _ if k > *contact => 0.0,
            _ if k >= *foot && !self.below.is_empty() => body_rate(&self.below[k - foot], &z[k]),
            _ => in_cut(k),
        };
        (0..z.len()).map(at).collect()
    }
}

/// EN34, EN35 for the sides right and left.
pub(super) fn solve(sides: &[EntryFlow; 2]) -> RolledSolution {
    let nodes = [0, 1].map(|i| sides[i].contour());
    let z = joined([&nodes[0].z, &nodes[1].z], image);
    let counts = [0, 1].map(|i| nodes[i].z.len());
    let contacts = [nodes[0].contact, z.len() - 1 - nodes[1].contact];
    let mut corners = vec![counts[0] - 1];
    corners.extend([nodes[0].end, nodes[0].foot, nodes[0].contact]);
    corners.extend([nodes[1].end, nodes[1].foot, nodes[1].contact].map(|k| z.len() - 1 - k));
    let contour = WholeContour::new(&z, contacts, sides[0].sizes.quadratic.then_some(&corners));
    let solved = |phi: [Vec<f64>; 2], velocity: c64| {
        let psi = z.iter().map(|z| (velocity.conj() * z).im).collect();
        let mut beta = Complex { phi: joined([&phi[0], &phi[1]], |phi| phi), psi };
        contour.solve(&mut beta);
        [0, 1].map(|i| of_side(&beta, counts[i], i == 1))
    };
    let potentials = [0, 1].map(|i| sides[i].potential(&nodes[i].z, nodes[i].end, nodes[i].foot));
    let beta = solved(potentials, sides[0].keel_velocity());
    let velocities = [0, 1].map(|i| Velocities::new(&sides[i], &nodes[i], &beta[i]));
    let rate = solved([0, 1].map(|i| velocities[i].rates(&sides[i], &nodes[i])), c64::new(0.0, 0.0));
    let per_acceleration = solved(counts.map(|count| vec![0.0; count]), c64::new(0.0, -1.0));

    let tangents = [0, 1].map(|i| sides[i].face.place(0.0).tangent);
    let sum: f64 = tangents.iter().map(|tangent| tangent.arg()).sum();
    let singular = 1.0 - PI / (PI + sum); // the velocity next to the apex falls like r to minus this power
    let pressure = [0, 1].map(|i| {
        let at = |k: usize| {
            Place { flow: &sides[i], nodes: &nodes[i], velocities: &velocities[i] }.pressure(
                k,
                rate[i].phi[k],
                per_acceleration[i].phi[k],
                singular,
            )
        };
        let mut pressure: Vec<[f64; 3]> = (nodes[i].contact..counts[i]).map(at).collect();
        // the mean over the last element
        if let [.., before, apex] = &mut pressure[..] {
            apex[1] = 2.0 * apex[1] - before[1];
        }
        pressure
    });
    let mut load = RolledLoad::of(pressure, tangents);
    load.pressure.iter_mut().for_each(|pressure| pressure[0][1] = 0.0); // as of `FlowLoad`
    let [right, left] = nodes;
    let ([beta_right, beta_left], [v_right, v_left]) = (beta, velocities);
    let right = sides[0].solution(right, beta_right, [v_right.above, v_right.below]);
    let left = sides[1].solution(left, beta_left, [v_left.above, v_left.below]);
    Solved { sides: [right, left], force: load.force[1], load }
}

/// A place on a face.
struct Place<'a> {
    flow: &'a EntryFlow,
    nodes: &'a Nodes,
    velocities: &'a Velocities,
}

impl Place<'_> {
    /// EN35: [distance from the apex, p/ρ, p/ρ per acceleration] at the node k; at the apex the mean over the last element.
    fn pressure(&self, k: usize, rate: f64, per_acceleration: f64, singular: f64) -> [f64; 3] {
        let Nodes { z, contact, along, .. } = self.nodes;
        let body = self.flow.keel_velocity();
        let is_apex = k + 1 == z.len();
        let at = k - contact - usize::from(is_apex);
        let share = if is_apex { 1.0 / (1.0 - 2.0 * singular) } else { 1.0 };
        let relative = share * (self.velocities.on_body[at] - body).norm_sqr();
        let steady = -rate - 0.5 * relative + 0.5 * body.norm_sqr() - self.flow.gravity * z[k].im;
        [along[k - contact], steady, -per_acceleration]
    }
}
