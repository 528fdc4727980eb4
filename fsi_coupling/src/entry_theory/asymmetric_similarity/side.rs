//! What one face bears, and the free surface beside it (THEORY EN33).

use super::sums::{Place, Sums};
use super::system::Side;
use crate::entry_theory::dobrovolskaya::integral;
use crate::entry_theory::similarity::{finer, peak};

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
    /// The jet's tip, [x, y]/(V t) [-], x outwards from the apex, y from still water.
    pub tip: [f64; 2],
    /// Along the face from the apex to the tip: distance over V t and pressure coefficient [-], shape (n, 2). It begins at 10⁻⁶ of the
    /// wet length.
    pub profile: Vec<[f64; 2]>,
    /// Free surface from the tip outwards, [x, y]/(V t) [-], x outwards, shape (n, 2).
    pub surface: Vec<[f64; 2]>,
}

/// A side, whose unit of length is λ = `scale`.
pub(super) fn flow(side: &Side, beta: f64, step: f64, scale: f64) -> (FaceFlow, Sums) {
    let (sin, cos) = beta.sin_cos();
    let contact = side.contact;
    let length = integral(&side.lengths, step, side.lengths[0] / contact);
    let speed = integral(&side.speeds, step, side.speeds[0] / (0.5 - contact));
    // Bernoulli along the face: dp = ρ (s − v) dv, from the tip, where p is nothing
    let rate: Vec<f64> = (0..length.len()).map(|k| (length[k] - speed[k]) * side.speeds[k]).collect();
    let pressure: Vec<f64> = integral(&rate, step, 0.0).iter().map(|p| p * scale * scale).collect();
    let weights: Vec<f64> = side.lengths.iter().map(|s| s * step * scale).collect();
    let whole = side.along * scale;
    // the distance from the keel as a sum from there, free of cancellation
    let backwards: Vec<f64> = side.lengths.iter().rev().copied().collect();
    let mut from_keel: Vec<f64> = integral(&backwards, step, 0.0).iter().map(|s| s * scale).collect();
    from_keel.reverse();
    let force: f64 = pressure.iter().zip(&weights).map(|(p, w)| p * w).sum();
    let moment: f64 = (0..length.len()).map(|k| pressure[k] * from_keel[k] * weights[k]).sum();

    let cps: Vec<f64> = finer(&pressure, BETWEEN).iter().map(|p| 2.0 * p).collect();
    let arcs = finer(&from_keel, BETWEEN);
    let (top, cp_max) = match peak(&cps) {
        (Some(top), cp_max) => (top, cp_max),
        (None, _) => (0.0, 0.0),
    };
    let at = |place: f64| arcs[place as usize] + place.fract() * (arcs[place as usize + 1] - arcs[place as usize]);
    let mut profile: Vec<[f64; 2]> = arcs.iter().zip(&cps).map(|(s, p)| [*s, *p]).rev().collect();
    profile.retain(|[s, _]| *s > NEAREST * whole);
    profile.dedup_by(|b, a| b[0] - a[0] < 1e-12);

    let tip = [whole * cos, whole * sin - 1.0];
    let places: Vec<Place> = (0..length.len())
        .map(|k| {
            let relative = speed[k] * scale - length[k] * scale;
            let at = [from_keel[k] * cos, from_keel[k] * sin - 1.0];
            let velocity = [at[0] - relative * cos, at[1] - relative * sin];
            Place { at, velocity, normal: [-sin, cos], pressure: pressure[k] }
        })
        .collect();
    let counted: Vec<f64> =
        weights.iter().zip(&from_keel).map(|(w, s)| if *s > RESOLVED * whole { *w } else { 0.0 }).collect();
    let on_face = Sums::over(&places, &counted).plus(&places[0].from_tip(tip, length[0] * scale), 1.0);
    let (surface, on_surface) = surface(side, step, scale, tip);
    let flow = FaceFlow {
        deadrise_deg: beta.to_degrees(),
        force_coefficient: force,
        moment_coefficient: moment,
        cp_max,
        peak: at(top),
        length: whole,
        contact_angle_deg: 180.0 * contact,
        tip,
        profile,
        surface,
    };
    (flow, on_face.plus(&on_surface, 1.0))
}

/// The free surface from the tip outwards and the integrals over it.
fn surface(side: &Side, step: f64, scale: f64, tip: [f64; 2]) -> (Vec<[f64; 2]>, Sums) {
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
    let sums = Sums::over(&places, &weights).plus(&places[0].from_tip(tip, side.arc[0] * scale), 1.0);
    (std::iter::once(tip).chain(x.into_iter().zip(y).map(|(x, y)| [x, y])).collect(), sums)
}
