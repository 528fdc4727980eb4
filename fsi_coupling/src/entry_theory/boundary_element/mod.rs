//! Fully nonlinear potential flow about an entering wedge by boundary elements (THEORY EN20–EN23).
//!
//! The surface moves with the water (mixed Eulerian–Lagrangian; Longuet-Higgins & Cokelet 1976, Zhao & Faltinsen 1993), the jet is cut. Per stage
//! one matrix gives the velocity, the pressure and the added mass.

mod cauchy;
mod spline;
mod surface;

use faer::c64;

use super::model::{EntryModel, OutOfRange};
use cauchy::{Complex, Contour, Known};
use spline::Spline;
use surface::{FINE_ELEMENTS, Face, FreeSurface, GROWTH, arc_length, graded};

/// Deadrises of the validity [deg].
pub const BOUNDARY_ELEMENT_DEADRISES: [f64; 2] = [15.0, 60.0];
/// Longest way of a node per step, over the length of its element.
const COURANT: f64 = 0.5;
/// Largest growth of the draught per step.
const DRAUGHT_GROWTH: f64 = 0.03;
/// Size of elements on the face at the keel, and the largest, over the wetted length.
const FACE_ELEMENTS: [f64; 2] = [1e-4, 0.06];
/// Distance to which the free surface reaches, over half the wetted breadth, at the start.
const FAR: f64 = 240.0;

/// Load of the water on both halves, over its density.
#[derive(Clone, Debug)]
pub struct WedgeLoad {
    /// Upward force at constant speed F/ρ [m³/s²].
    pub force: f64,
    /// Added mass M/ρ [m²]: the force grows by it times the downward acceleration.
    pub added_mass: f64,
    /// From the jet to the keel: height above still water [m], p/ρ at constant speed [m²/s²], p/ρ per downward acceleration [m], shape (n, 3).
    pub pressure: Vec<[f64; 3]>,
}

/// The water about a symmetric wedge that moves downwards. The chines are dry.
#[derive(Clone, Debug)]
pub struct WedgeFlow {
    face: Face,
    surface: FreeSurface,
    /// Downward speed [m/s].
    speed: f64,
    /// Gravity in the water [m/s²].
    gravity: f64,
}

/// The flow cannot be followed further.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the flow about the wedge ended at a draught of {draught} m, where its downward speed became {speed} m/s")]
pub struct FlowEnded {
    /// Draught of the keel [m].
    pub draught: f64,
    /// Downward speed after the step that failed [m/s].
    pub speed: f64,
}

/// One solution of the flow.
struct Solution {
    /// Of the surface's nodes [m/s].
    velocity: Vec<c64>,
    /// dφ/dt of them [m²/s²].
    rate: Vec<f64>,
    load: WedgeLoad,
}

impl WedgeFlow {
    /// A wedge of `deadrise_deg` whose keel is at `draught` [m], with the downward `speed` [m/s], `gravity` [m/s²] in the water. The surface
    /// is that of Wagner: loads are those of the entry from about three times this draught on.
    ///
    /// # Errors
    /// A deadrise outside [`BOUNDARY_ELEMENT_DEADRISES`]; a draught or a speed that is not above zero.
    pub fn new(deadrise_deg: f64, draught: f64, speed: f64, gravity: f64) -> Result<WedgeFlow, OutOfRange> {
        let [least, most] = BOUNDARY_ELEMENT_DEADRISES;
        if !(least..=most).contains(&deadrise_deg) {
            return Err(OutOfRange {
                what: format!("{deadrise_deg}°"),
                range: format!("boundary elements need a deadrise of {least} to {most}°"),
                next: if deadrise_deg < most { EntryModel::Similarity } else { EntryModel::Wcsph },
            });
        }
        if !(draught > 0.0 && draught.is_finite() && speed > 0.0 && speed.is_finite()) {
            return Err(OutOfRange {
                what: format!("{draught} m and {speed} m/s"),
                range: "boundary elements need a draught and a downward speed above zero".into(),
                next: EntryModel::Wcsph,
            });
        }
        let face = Face { beta: deadrise_deg.to_radians(), draught };
        let half_breadth = draught / face.beta.tan();
        Ok(WedgeFlow { surface: FreeSurface::at_first(&face, FAR * half_breadth), face, speed, gravity })
    }

    /// Draught of the keel below still water [m].
    pub fn draught(&self) -> f64 {
        self.face.draught
    }

    /// Downward speed [m/s].
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// The right half of the free surface from far away to the jet's cut, [x, y] [m], shape (n, 2).
    pub fn surface(&self) -> Vec<[f64; 2]> {
        self.surface.z.iter().map(|z| [z.re, z.im]).collect()
    }

    /// Load of the water now.
    pub fn load(&self) -> WedgeLoad {
        self.solve().load
    }

    /// One step by the midpoint rule. `acceleration` gives the downward acceleration [m/s²] under a load. Returns the step [s] and the load at
    /// its start.
    ///
    /// # Errors
    /// A wedge that has stopped, or a flow that is no longer finite; the state before the step is kept.
    pub fn step(&mut self, acceleration: impl Fn(&WedgeLoad) -> f64) -> Result<(f64, WedgeLoad), FlowEnded> {
        let start = self.solve();
        let dt = self.stable_dt(&start.velocity);
        let half = self.moved(self.speed, &start, acceleration(&start.load), 0.5 * dt);
        let middle = half.solve();
        let end = self.moved(half.speed, &middle, acceleration(&middle.load), dt);
        let surface = end.surface.redistributed(&end.face);
        if !(end.speed > 0.0 && start.load.force.is_finite() && surface.z.iter().all(|z| z.is_finite())) {
            return Err(FlowEnded { draught: self.face.draught, speed: end.speed });
        }
        *self = WedgeFlow { surface, ..end };
        Ok((dt, start.load))
    }

    /// Moved over `dt` with a downward speed, an acceleration and the flow `at` some instant.
    fn moved(&self, speed: f64, at: &Solution, acceleration: f64, dt: f64) -> WedgeFlow {
        let face = Face { draught: self.face.draught + speed * dt, ..self.face };
        WedgeFlow {
            surface: self.surface.moved(&at.velocity, &at.rate, dt, &face),
            face,
            speed: self.speed + acceleration * dt,
            gravity: self.gravity,
        }
    }

    fn stable_dt(&self, velocity: &[c64]) -> f64 {
        let courant = self.surface.z.windows(2).zip(velocity.windows(2)).map(|(z, v)| {
            let speed = 0.5 * (v[0].norm() + v[1].norm());
            COURANT * (z[1] - z[0]).norm() / speed.max(f64::MIN_POSITIVE)
        });
        courant.fold(DRAUGHT_GROWTH * self.face.draught / self.speed.abs(), f64::min)
    }

    /// EN21 for β and its time derivative, EN23.
    fn solve(&self) -> Solution {
        let WedgeFlow { face, surface, speed, gravity } = self;
        let (nodes, contact) = self.contour();
        let (n, free) = (nodes.len(), surface.z.len());
        let known = |k: usize| match k.cmp(&contact) {
            std::cmp::Ordering::Less => Known::Potential,
            std::cmp::Ordering::Equal => Known::Both,
            std::cmp::Ordering::Greater => Known::StreamFunction,
        };
        let contour = Contour::new(&nodes, (0..n).map(known).collect());

        // velocity: φ on the surface, ψ = V x on the body, φ along the cut by the body's speed normal to its face
        let across = |z: &c64| speed * face.direction().re * face.coordinates(*z)[1];
        let end = free - 1;
        let on_cut = nodes[free..=contact].iter().map(|z| surface.phi[end] + across(z) - across(&nodes[end]));
        let mut beta = Complex {
            phi: surface.phi.iter().copied().chain(on_cut).chain(vec![0.0; n - contact - 1]).collect(),
            psi: nodes.iter().enumerate().map(|(k, z)| if k < contact { 0.0 } else { speed * z.re }).collect(),
        };
        contour.solve(&mut beta);
        let velocity = surface.velocity(&beta.psi[..free]);
        let on_body = self.body_velocity(&nodes[contact..], &beta.phi[contact..]);

        // φ_t: p = 0 on the surface and in the cut; ψ_t of the body's motion
        let at_rest = |k: usize| -0.5 * velocity[k].norm_sqr() - gravity * nodes[k].im;
        let mut rate = Complex {
            phi: (0..n).map(|k| if k <= contact { at_rest(k.min(end)) } else { 0.0 }).collect(),
            psi: (0..n).map(|k| if k < contact { 0.0 } else { speed * on_body[k - contact].re }).collect(),
        };
        contour.solve(&mut rate);
        let x_on_body = |k: usize| if k < contact { 0.0 } else { nodes[k].re };
        let mut per_acceleration = Complex { phi: vec![0.0; n], psi: (0..n).map(x_on_body).collect() };
        contour.solve(&mut per_acceleration);

        let pressure: Vec<[f64; 3]> = (contact..n)
            .map(|k| {
                let steady = rate.phi[k] + 0.5 * on_body[k - contact].norm_sqr() + gravity * nodes[k].im;
                [nodes[k].im, -steady, -per_acceleration.phi[k]]
            })
            .collect();
        // both halves: twice the trapezoid in x
        let over_breadth = |of: usize| -> f64 {
            let trapezoid =
                |k: usize| (pressure[k][of] + pressure[k + 1][of]) * (nodes[contact + k] - nodes[contact + k + 1]).re;
            (0..pressure.len() - 1).map(trapezoid).sum()
        };
        Solution {
            load: WedgeLoad { force: over_breadth(1), added_mass: over_breadth(2), pressure },
            rate: (0..free).map(|k| velocity[k].norm_sqr() + at_rest(k)).collect(),
            velocity,
        }
    }

    /// Nodes of the right half of the contour: free surface, cut, face down to the keel; and which is that where the face begins.
    fn contour(&self) -> (Vec<c64>, usize) {
        let WedgeFlow { face, surface, .. } = self;
        let mut nodes = surface.z.clone();
        let (end, size) = (surface.end(), face.finest(surface.end()));
        let foot = face.foot(end);
        if surface.cut {
            let elements = (face.coordinates(end)[1] / size).ceil().max(2.0);
            nodes.extend((1..=elements as usize).map(|k| end + (foot - end) * (k as f64 / elements)));
        }
        let contact = nodes.len() - 1;
        let wetted = (foot - face.keel()).norm();
        let [at_keel, largest] = FACE_ELEMENTS.map(|x| x * wetted);
        let from_contact = |s: f64| size + GROWTH * (s - FINE_ELEMENTS * size).max(0.0);
        let from_keel = |s: f64| at_keel + GROWTH * (wetted - s).max(0.0);
        let along = graded(wetted, |s| from_contact(s).min(from_keel(s)).min(largest));
        nodes.extend(along[1..].iter().map(|s| foot + (face.keel() - foot) * (s / wetted)));
        let keel = nodes.len() - 1;
        nodes[keel] = face.keel();
        (nodes, contact)
    }

    /// Velocity u + iv of the water on the face [m/s]; at the keel it is the wedge's.
    fn body_velocity(&self, nodes: &[c64], phi: &[f64]) -> Vec<c64> {
        let (s, down) = (arc_length(nodes), -self.face.direction());
        let along = Spline::new(&s, phi.iter().copied()).slopes();
        let mut velocity: Vec<c64> =
            along.iter().map(|phi_s| (c64::new(*phi_s, self.speed * down.re) / down).conj()).collect();
        if let Some(keel) = velocity.last_mut() {
            *keel = c64::new(0.0, -self.speed);
        }
        velocity
    }
}
