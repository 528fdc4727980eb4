//! The bottom of a body, as Wagner's theory sees it.

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

use fsi_coupling::Shape;
use fsi_coupling::geometry::{polygon, underside};

use super::keys::{Body, Motion};

/// Least deadrise that a flat or nearly flat face counts with [deg]: below it trapped air, absent here, takes over.
pub const LEAST_DEADRISE_DEG: f64 = 4.0;

/// Draught over radius at which the spray root of an arc sets the speed of sound [-].
const ARC_DRAUGHT: f64 = 0.05;

/// Mass of a falling wedge over the water's that moves with it, at the peak of its force (THEORY GE22) [-].
pub(super) const PEAK_MASS_RATIO: f64 = 5.0;

/// Half width of a keel, over that of the water at the peak of the force, up to which it holds 2 % of the momentum (THEORY GE25) [-].
const BLUNT: f64 = 0.15;
/// The same of a keel that is round, without an impact of its own [-].
const ROUND: f64 = 0.5;
/// Six times the share of the peak force that the impulse on a keel may have as its mean over three spacings (THEORY GE25) [-].
const HAMMER: f64 = 1.2;

/// A bottom as Wagner's theory sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bottom {
    /// Straight faces.
    Wedge {
        /// Tangent of the deadrise [-].
        slope: f64,
    },
    /// An arc of a circle.
    Arc {
        /// Radius [m].
        radius: f64,
    },
}

impl Bottom {
    /// The bottom of a body as it lies at t = 0: the radius of an arc, or of a polygon whose bottom is round; else the flattest
    /// face that looks down, at least `LEAST_DEADRISE_DEG`. A blunt or round keel does not count (GE25).
    pub fn of(body: &Body, water: &Reach) -> Bottom {
        if let Shape::Arc { radius, .. } = body.shape {
            return Bottom::Arc { radius };
        }
        let outline = body.placed_outline();
        if let Some(radius) = underside::radius_of_bottom(&outline) {
            return Bottom::Arc { radius };
        }
        let least = LEAST_DEADRISE_DEG.to_radians();
        let wedge = |slope: f64| Bottom::Wedge { slope: slope.clamp(least, FRAC_PI_2 - least).tan() };
        let beyond = |half_width: f64| wedge(underside::flattest_face_beyond(&outline, half_width).0);
        // a round keel has no impact of its own
        if let Some(keel) = underside::round_keel(&outline) {
            let sides = beyond(keel.half_width);
            if keel.half_width <= ROUND * water.half_width_at_peak(body, sides) {
                return sides;
            }
        }
        // as wide as the keel of a bottom may be, where the run is long enough and the spacing not too fine
        beyond(water.blunt(body, beyond(BLUNT * water.half_width(body))))
    }

    /// True for faces of the least deadrise that is distinguished from a flat one.
    pub fn is_flat(self) -> bool {
        matches!(self, Bottom::Wedge { slope } if slope <= LEAST_DEADRISE_DEG.to_radians().tan())
    }

    /// Added mass of the water under the wetted half width c [kg/m], (π/2) ρ c², over ρ, at draught D [m]: A/ρ D² or A/ρ D.
    pub(super) fn wetted_added_mass(self, draught: f64) -> f64 {
        FRAC_PI_2 * self.wetted_half_width(draught).powi(2)
    }

    /// Speed of the spray root dc/dt [m/s] at entry speed V [m/s] (Wagner 1932).
    ///
    /// Wedge of deadrise β: U = π V/(2 tan β). Arc of radius R at draught D: U = V √(R/D), taken at D = 5 % of R.
    /// Sharp for deadrise up to about 45°; at first contact of an arc U is infinite, which no speed of sound covers.
    pub fn root_speed(self, entry_speed: f64) -> f64 {
        match self {
            Bottom::Wedge { slope } => FRAC_PI_2 * entry_speed / slope,
            Bottom::Arc { .. } => entry_speed / ARC_DRAUGHT.sqrt(),
        }
    }

    /// Half width of the wetted bottom c [m] at draught D [m], with the pile-up of water (Wagner 1932).
    ///
    /// Wedge: c = (π/2) D/tan β. Arc: c = 2 √(R D), for D up to about R/10.
    pub fn wetted_half_width(self, draught: f64) -> f64 {
        match self {
            Bottom::Wedge { slope } => FRAC_PI_2 * draught / slope,
            Bottom::Arc { radius } => 2.0 * (radius * draught).sqrt(),
        }
    }

    /// Half width of the cut with the still water [m] at draught D [m] (von Karman 1929): D/tan β, √(2 R D).
    pub fn still_half_width(self, draught: f64) -> f64 {
        match self {
            Bottom::Wedge { slope } => draught / slope,
            Bottom::Arc { radius } => SQRT_2 * (radius * draught).sqrt(),
        }
    }

    /// Draught [m] at which the spray root stands at half width c [m]: the inverse of [`Bottom::wetted_half_width`].
    pub fn draught_at(self, wetted_half_width: f64) -> f64 {
        match self {
            Bottom::Wedge { slope } => wetted_half_width * slope / FRAC_PI_2,
            Bottom::Arc { radius } => wetted_half_width.powi(2) / (4.0 * radius),
        }
    }

    /// Slope of the wedge whose spray root is as fast as this bottom's at draught D [m]: tan β, or (π/2) √(D/R).
    pub fn equivalent_slope(self, draught: f64) -> f64 {
        match self {
            Bottom::Wedge { slope } => slope,
            Bottom::Arc { radius } => FRAC_PI_2 * (draught / radius).sqrt(),
        }
    }
}

/// The water that a body meets, and how far it goes into it within a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Density of the water [kg/m³].
    pub density: f64,
    /// Draught at the end that the body has at its speed at t = 0 [m]; infinite where it is not known.
    pub draught: f64,
    /// Finest spacing [m]; infinite where it is not known.
    pub spacing: f64,
}

impl Reach {
    /// Half width [m] at which the water that moves with a body has a fifth of its mass, or its half breadth.
    fn half_width(&self, body: &Body) -> f64 {
        let [min, max] = polygon::bounding_box(&body.placed_outline());
        let half_breadth = 0.5 * (max[0] - min[0]);
        match &body.motion {
            Motion::Free(freedom) => {
                (2.0 * freedom.mass / (PEAK_MASS_RATIO * PI * self.density)).sqrt().min(half_breadth)
            }
            _ => half_breadth,
        }
    }

    /// The same, or the half width at the end of the run under a bottom [m].
    fn half_width_at_peak(&self, body: &Body, bottom: Bottom) -> f64 {
        self.half_width(body).min(bottom.wetted_half_width(self.draught.max(0.0)))
    }

    /// GE25: largest half width of a flat keel that does not count [m], under the sides of a bottom.
    fn blunt(&self, body: &Body, bottom: Bottom) -> f64 {
        let peak = self.half_width_at_peak(body, bottom);
        let slope = bottom.equivalent_slope(self.draught);
        (BLUNT * peak).min((HAMMER * self.spacing * peak / slope).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wagner_root_of_wedge_and_arc_is_the_rate_of_the_wetted_width() {
        for bottom in [Bottom::Wedge { slope: 0.3 }, Bottom::Arc { radius: 2.0 }] {
            let (draught, step) = (0.05 * 2.0, 1e-6);
            let width = |d| bottom.wetted_half_width(d);
            let rate = (width(draught + step) - width(draught - step)) / (2.0 * step);
            assert!((bottom.root_speed(1.0) / rate - 1.0).abs() < 1e-8);
            assert!((bottom.draught_at(width(draught)) / draught - 1.0).abs() < 1e-14);
            let slope = bottom.equivalent_slope(draught);
            assert!((FRAC_PI_2 / slope / rate - 1.0).abs() < 1e-8);
        }
    }
}
