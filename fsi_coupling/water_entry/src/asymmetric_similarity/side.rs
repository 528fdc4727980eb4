//! The load of one face, and the free surface next to it (THEORY EN33).

use super::sums::{Place, Sums};
use super::system::Side;
use crate::dobrovolskaya::integral;
use crate::similarity::{finer, peak};

/// Points of the profile between two of the grid.
const BETWEEN: usize = 16;
/// Least distance of the profile from the apex, over the wet length: there the pressure falls without bound.
const NEAREST: f64 = 1e-6;

/// Nearer to the apex, over the wet length, φ is lost in the rounding of ½v² and p; its integral there is not counted.
const RESOLVED: f64 = 1e-10;

/// The flow on one side of a wedge at constant speed V, in units of V t, ½ρV² and ρV³t. Lengths on the face count from the apex.
#[derive(Clone, Debug)]
pub struct FaceFlow {
    /// Deadrise [deg].
    pub deadrise_deg: f64,
    /// Force normal to the face F_n/(ρV³t) [-].
    pub force_coefficient: f64,
    /// Moment of it about the apex, M/(ρV⁴t²) [-], positive where the force pushes the face up.
    pub moment_coefficient: f64,
    /// Largest pressure coefficient [-].
    pub cp_max: f64,
    /// Its distance from the apex over V t [-].
    pub peak: f64,
    /// Wet length from the apex to the jet's tip over V t [-].
    pub length: f64,
    /// Angle between free surface and face at the jet's tip [deg].
    pub contact_angle_deg: f64,
    /// The jet's tip, [x, y]/(V t) [-], x outwards from the place of first contact, y from still water.
    pub tip: [f64; 2],
    /// Along the face from the apex to the tip: distance over V t and pressure coefficient [-], shape (n, 2). It begins at 10⁻⁶ of the
    /// wet length.
    pub profile: Vec<[f64; 2]>,
    /// Free surface from the tip outwards, [x, y]/(V t) [-], from the same place, shape (n, 2).
    pub surface: Vec<[f64; 2]>,
}

/// What is known at the points of a face from the tip to the apex, in units of V t, V and ρV².
struct Face {
    /// Distance from the tip, and from the apex.
    from_tip: Vec<f64>,
    from_apex: Vec<f64>,
    /// Velocity towards the apex relative to the growing flow, v − s.
    relative: Vec<f64>,
    pressure: Vec<f64>,
    /// ds between points.
    weights: Vec<f64>,
}

impl Face {
    fn new(side: &Side, step: f64, scale: f64) -> Face {
        let from_tip = integral(&side.lengths, step, side.lengths[0] / side.contact);
        let speed = integral(&side.speeds, step, side.speeds[0] / (0.5 - side.contact));
        // Bernoulli along the face: dp = ρ (s − v) dv, from the tip, where p is nothing
        let rate: Vec<f64> = (0..from_tip.len()).map(|k| (from_tip[k] - speed[k]) * side.speeds[k]).collect();
        // the distance from the apex as a sum from there, free of cancellation
        let backwards: Vec<f64> = side.lengths.iter().rev().copied().collect();
        let mut from_apex: Vec<f64> = integral(&backwards, step, 0.0).iter().map(|s| s * scale).collect();
        from_apex.reverse();
        Face {
            from_apex,
            relative: speed.iter().zip(&from_tip).map(|(v, s)| (v - s) * scale).collect(),
            pressure: integral(&rate, step, 0.0).iter().map(|p| p * scale * scale).collect(),
            weights: side.lengths.iter().map(|s| s * step * scale).collect(),
            from_tip: from_tip.iter().map(|s| s * scale).collect(),
        }
    }

    /// ∫ p ds and ∫ p r ds, r from the apex.
    fn load(&self) -> [f64; 2] {
        let points = || self.pressure.iter().zip(&self.weights);
        [points().map(|(p, w)| p * w).sum(), points().zip(&self.from_apex).map(|((p, w), r)| p * r * w).sum()]
    }

    /// Largest pressure coefficient, its distance from the apex, and the pressure coefficient along the face, shape (n, 2).
    fn profile(&self, whole: f64) -> (f64, f64, Vec<[f64; 2]>) {
        let cps: Vec<f64> = finer(&self.pressure, BETWEEN).iter().map(|p| 2.0 * p).collect();
        let arcs = finer(&self.from_apex, BETWEEN);
        let (top, cp_max) = match peak(&cps) {
            (Some(top), cp_max) => (top, cp_max),
            (None, _) => (0.0, 0.0),
        };
        let k = top as usize;
        let mut profile: Vec<[f64; 2]> = arcs.iter().zip(&cps).map(|(s, p)| [*s, *p]).rev().collect();
        profile.retain(|[s, _]| *s > NEAREST * whole);
        profile.dedup_by(|b, a| b[0] - a[0] < 1e-12);
        (cp_max, arcs[k] + top.fract() * (arcs[k + 1] - arcs[k]), profile)
    }

    /// EN33 over the face.
    fn sums(&self, [sin, cos]: [f64; 2], drift: f64, tip: [f64; 2], whole: f64) -> Sums {
        let place = |k: usize| {
            let at = [drift + self.from_apex[k] * cos, self.from_apex[k] * sin - 1.0];
            let velocity = [at[0] - self.relative[k] * cos, at[1] - self.relative[k] * sin];
            Place { at, velocity, normal: [-sin, cos], pressure: self.pressure[k] }
        };
        let places: Vec<Place> = (0..self.from_tip.len()).map(place).collect();
        let resolved = |r: &f64| *r > RESOLVED * whole;
        let counted = self.weights.iter().zip(&self.from_apex).map(|(w, r)| if resolved(r) { *w } else { 0.0 });
        let counted: Vec<f64> = counted.collect();
        Sums::over(&places, &counted).plus(&places[0].jet(tip, self.from_tip[0]), 1.0)
    }
}

/// A side, whose unit of length is λ = `scale` and whose apex moves outwards by `drift` V.
pub(super) fn flow(side: &Side, [beta, drift]: [f64; 2], step: f64, scale: f64) -> (FaceFlow, Sums) {
    let (sin, cos) = beta.sin_cos();
    let face = Face::new(side, step, scale);
    let length = side.along * scale;
    let tip = [drift + length * cos, length * sin - 1.0];
    let [force_coefficient, moment_coefficient] = face.load();
    let (cp_max, peak, profile) = face.profile(length);
    let on_face = face.sums([sin, cos], drift, tip, length);
    let (surface, on_surface) = surface(side, step, scale, tip);
    let flow = FaceFlow {
        deadrise_deg: beta.to_degrees(),
        force_coefficient,
        moment_coefficient,
        cp_max,
        peak,
        length,
        contact_angle_deg: 180.0 * side.contact,
        tip,
        profile,
        surface,
    };
    (flow, on_face.plus(&on_surface, 1.0))
}

/// The free surface from the tip outwards and the integrals over it.
pub(super) fn surface(side: &Side, step: f64, scale: f64, tip: [f64; 2]) -> (Vec<[f64; 2]>, Sums) {
    let n = side.fall.len();
    let from_afar = |f: &dyn Fn(usize) -> f64| {
        let backwards: Vec<f64> = (0..n).rev().map(f).collect();
        let mut sums = integral(&backwards, step, backwards[0]);
        sums.reverse();
        sums
    };
    let directions = side.directions(step);
    let density: Vec<f64> = side.density.iter().map(|d| d * scale).collect();
    let kick = |k: usize| std::f64::consts::PI * side.fall[k] * side.arc[k] * scale;
    let rate: Vec<f64> = (0..n).map(|k| density[k] * directions[k][0]).collect();
    let x = integral(&rate, step, tip[0] + rate[0] / side.contact);
    let y = from_afar(&|k| density[k] * directions[k][1]);
    let u = from_afar(&|k| kick(k) * directions[k][1]);
    let v = from_afar(&|k| kick(k) * directions[k][0]);
    let places: Vec<Place> = (0..n)
        .map(|k| Place {
            at: [x[k], y[k]],
            velocity: [u[k], v[k]],
            normal: [directions[k][1], directions[k][0]],
            pressure: 0.0,
        })
        .collect();
    let weights: Vec<f64> = density.iter().map(|d| d * step).collect();
    let sums = Sums::over(&places, &weights).plus(&places[0].jet(tip, side.arc[0] * scale), 1.0);
    (std::iter::once(tip).chain(x.into_iter().zip(y).map(|(x, y)| [x, y])).collect(), sums)
}
