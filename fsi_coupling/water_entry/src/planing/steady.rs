//! Lift of a planing hull and its distribution (THEORY EN43–EN45).

use super::hull::{Immersion, NotPlaning, PlaningHull, Wetted};
use super::lifting_surface::{LiftingSurface, solved};
use crate::Loads;

/// Sections for the sum of the lift, and for its distribution.
const STRIPS: usize = 400;
const SECTIONS: usize = 60;
/// Most steps of Newton's method, and the last change of the velocities over U tan τ.
const MOST_STEPS: usize = 40;
const CONVERGED: f64 = 1e-9;

/// The load of a hull that planes.
#[derive(Clone, Debug)]
pub struct Planing {
    /// The wetted bottom.
    pub wetted: Wetted,
    /// Lift [N].
    pub lift: f64,
    /// Lift over ½ρ U² b² [-].
    pub lift_coefficient: f64,
    /// Lift of the strips without the effect of the ends: EN17 and the whole buoyancy [N].
    pub strip_lift: f64,
    /// Drag of the pressure, lift times tan τ [N].
    pub pressure_drag: f64,
    /// Wetted area of the bottom aft of the spray root [m²].
    pub wetted_area: f64,
    /// Place of the lift ahead of the step, along the keel [m].
    pub centre: f64,
    /// The lift along the hull, from the front to the step.
    pub slices: Vec<PlaningSlice>,
}

/// A slice of the hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaningSlice {
    /// Its place ahead of the step, along the keel [m].
    pub ahead: f64,
    /// Lift per metre of keel [N/m].
    pub lift_per_m: f64,
    /// Half breadth of its wetted bottom [m].
    pub wetted: f64,
    /// Velocity at which it sinks through the water that the other slices move, over U tan τ [-].
    pub sinking: f64,
}

/// A hull of the breadth 1 at the speed 1 in water of density 1.
struct Unit<'a> {
    loads: &'a Loads,
    /// U tan τ.
    sinking: f64,
    /// 1/C_v².
    gravity: f64,
    /// Wetted keel on the way of the hull.
    length: f64,
    /// Half of the wetted breadth at the step.
    half_breadth: f64,
    /// Wetted area over the square of the wetted breadth.
    aspect: f64,
}

/// EN43 (Pabst 1930): share (1 + 1/λ²)^(−1/2) of the load of a long wetted area that is left at a mean wetted length λ over the breadth, not
/// below 0: that of an endless line of dipoles, seen from half a breadth aside, which is within λ/2 of the middle.
pub fn finite_length(mean: f64) -> f64 {
    share_ahead(0.5 * mean, 0.5)
}

/// EN43: share of the part of a line of dipoles up to a distance `ahead`, seen from a distance `aside`, in what it has without an end there.
fn share_ahead(ahead: f64, aside: f64) -> f64 {
    ahead / ahead.hypot(aside)
}

impl PlaningHull {
    /// EN42–EN45: the load at an immersion.
    ///
    /// # Errors
    /// A number out of the method's range; velocities that do not converge.
    pub fn planes(&self, immersion: Immersion) -> Result<Planing, NotPlaning> {
        let wetted = self.wetted(immersion)?;
        let (loads, b, trim) = (self.loads()?, self.breadth, self.trim());
        let unit = Unit {
            loads: &loads,
            sinking: trim.tan(),
            gravity: self.froude().powi(-2),
            length: wetted.keel / b * trim.cos(),
            half_breadth: 0.5 * wetted.breadth / b,
            aspect: wetted.mean * (b / wetted.breadth).powi(2),
        };
        let [strip, lift] = unit.lifts();
        let (forces, sinking) = unit.distribution().ok_or_else(|| NotPlaning {
            what: "convergence",
            value: self.froude(),
            expected: "a larger C_v, a smaller trim or a shorter wetted length".into(),
        })?;
        let whole: f64 = forces.iter().sum();
        let scale = self.density * (self.speed * b).powi(2);
        let step = unit.length / SECTIONS as f64;
        let slice = |k: usize| {
            let middle = (k as f64 + 0.25) * step; // the load stands there
            PlaningSlice {
                ahead: b * (unit.length - middle) / trim.cos(),
                lift_per_m: scale / b * lift * forces[k] / whole / step * trim.cos(),
                wetted: b * loads.at(middle * unit.sinking).wetted.min(0.5),
                sinking: sinking[k],
            }
        };
        let slices: Vec<PlaningSlice> = (0..SECTIONS).map(slice).collect();
        let centre = slices.iter().zip(&forces).map(|(s, force)| s.ahead * force).sum::<f64>() / whole;
        Ok(Planing {
            wetted,
            lift: scale * lift,
            lift_coefficient: 2.0 * lift,
            strip_lift: scale * strip,
            pressure_drag: scale * lift * unit.sinking,
            wetted_area: wetted.mean * b * b / self.deadrise_deg.to_radians().cos(),
            centre,
            slices,
        })
    }
}

impl Unit<'_> {
    /// Lift of the strips, and EN43 the lift.
    fn lifts(&self) -> [f64; 2] {
        let step = self.length / STRIPS as f64;
        let (mut slam, mut buoyancy, mut reduced) = (0.0, 0.0, 0.0);
        for k in 0..STRIPS {
            let x = (k as f64 + 0.5) * step;
            let draught = x * self.sinking;
            slam += step * self.loads.at(draught).slam * self.sinking * self.sinking;
            let floats = step * self.gravity * self.loads.section().still_area(draught);
            buoyancy += floats;
            reduced += floats * share_ahead(self.length - x, self.half_breadth);
        }
        [slam + buoyancy, finite_length(self.aspect) * (slam + reduced)]
    }

    /// EN44: force of each section, and the velocity at which it sinks through the water over `sinking`; `None` where they do not converge.
    fn distribution(&self) -> Option<(Vec<f64>, Vec<f64>)> {
        let (n, step, m) = (SECTIONS, self.length / SECTIONS as f64, self.sinking);
        let places: Vec<f64> = (0..n).map(|k| (k as f64 + 0.75) * step).collect();
        let at: Vec<_> = places.iter().map(|x| self.loads.at(x * m)).collect();
        let surface = LiftingSurface::new(step, at.iter().map(|load| load.wetted.min(0.5)).collect());
        let floats: Vec<f64> =
            places.iter().map(|x| step * self.gravity * self.loads.section().still_area(x * m)).collect();
        let change = |at: usize, of: usize| surface.share(at, of) - if of <= at { 1.0 } else { 0.0 };
        let changes: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| change(i, j)).collect()).collect();
        let mut v = vec![m; n];
        for _ in 0..MOST_STEPS {
            let mut forces = floats.clone();
            let mut slopes = vec![0.0; n];
            for k in 0..n {
                let small = 1e-6 * m;
                let slam = |v: f64| step * self.slam(places[k], step, v);
                slopes[k] = (slam(v[k] + small) - slam(v[k] - small)) / (2.0 * small);
                forces[k] += slam(v[k]) + at[k].added_mass * (v[k] - v[k.saturating_sub(1)]);
            }
            let residual = |i: usize| {
                let induced: f64 = (0..n).map(|j| changes[i][j] * forces[j]).sum();
                surface.mass(i) * (m - v[i]) - induced
            };
            let slope = |i: usize, j: usize| {
                let own = slopes[j] + if j > 0 { at[j].added_mass } else { 0.0 };
                let next = if j + 1 < n { changes[i][j + 1] * at[j + 1].added_mass } else { 0.0 };
                changes[i][j] * own - next + if i == j { surface.mass(i) } else { 0.0 }
            };
            let rows = (0..n).map(|i| (0..n).map(|j| slope(i, j)).collect()).collect();
            let steps = solved(rows, (0..n).map(residual).collect());
            (0..n).for_each(|k| v[k] += steps[k]);
            let largest = steps.iter().fold(0.0_f64, |most, s| most.max(s.abs()));
            if !largest.is_finite() {
                return None;
            }
            if largest < CONVERGED * m {
                return Some((forces, v.into_iter().map(|v| v / m).collect()));
            }
        }
        None
    }

    /// Mean of the force over ρ of a section that sinks at v through its water, while its wetted breadth grows as the hull passes: four places.
    fn slam(&self, place: f64, step: f64, v: f64) -> f64 {
        if v <= 0.0 {
            return 0.0;
        }
        let of = |k: usize| {
            let draught = (place + step * ((k as f64 + 0.5) / 4.0 - 0.75)) * self.sinking;
            let growth = if self.loads.at(draught).wetted <= 0.5 { self.sinking / v } else { 1.0 };
            self.loads.slam_growing(draught, growth)
        };
        v * v * 0.25 * (0..4).map(of).sum::<f64>()
    }
}
