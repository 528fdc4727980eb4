//! Struts with wheels or floats that go into water (THEORY EN56).

use super::attitude::{Attitude, FREEDOMS};
use super::swell::Swell;

/// Stiffness of the stops at the ends of the stroke over the load at the end of the stroke per stroke [-].
const STOP: f64 = 20.0;
/// Largest share of a gas column's length that is pressed in [-].
const MOST_PRESSED: f64 = 0.98;

/// What carries a strut's load along its stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StrutSpring {
    /// A spring: stiffness [N/m].
    Linear(f64),
    /// Gas: load P (1 − s/l)^−n over the stroke s of a column of the length l [m] with the exponent n [-].
    Gas {
        /// Length of the column, extended [m].
        length: f64,
        /// Exponent of the polytropic compression [-].
        exponent: f64,
    },
}

/// A strut along the normal of the body axis, with what stands in the water at its foot. Loads are those of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Strut {
    /// A word that names it.
    pub name: String,
    /// How many of them side by side.
    pub number: f64,
    /// Lowest point of wheel or float, extended: from the nose, over the body axis [m].
    pub foot: [f64; 2],
    /// Mass that moves with the foot; part of the aeroplane's mass [kg].
    pub mass: f64,
    /// Largest stroke [m].
    pub stroke: f64,
    /// Load at which the stroke begins [N].
    pub preload: f64,
    /// Its spring.
    pub spring: StrutSpring,
    /// Load per speed of the stroke [N s/m].
    pub damping: f64,
    /// Load per square of the speed of the stroke, of an orifice [N s²/m²].
    pub orifice: f64,
    /// Force on the fuselage at which it is lost [N]; `None`: it holds.
    pub breaks_at: Option<f64>,
    /// Breadth and height of what stands against the water above the foot [m].
    pub face: [f64; 2],
    /// Drag coefficient of its immersed part [-].
    pub drag: f64,
    /// Area of a float's waterplane: buoyancy per depth over ρg [m²].
    pub waterplane: f64,
}

/// A strut at a moment: all of its number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StrutLoad {
    /// Load along the stroke [N].
    pub along: f64,
    /// Force of the water forward and up, and its moment about the centre of mass [N, N, N m].
    pub water: [f64; 3],
    /// Directions of the load along the stroke on the freedoms.
    pub lever: [f64; FREEDOMS],
    /// Of the water's force the part along the stroke [N].
    pub water_along: f64,
}

impl Strut {
    /// EN56: load along the stroke at a stroke [m] and its speed [m/s], of one strut.
    pub fn load(&self, stroke: f64, speed: f64) -> f64 {
        let stop = STOP * self.spring_load(self.stroke) / self.stroke;
        let inside = stroke.clamp(0.0, self.stroke);
        let static_load = self.spring_load(inside) + stop * (stroke - inside);
        static_load + speed * (self.damping + self.orifice * speed.abs())
    }

    fn spring_load(&self, stroke: f64) -> f64 {
        match self.spring {
            StrutSpring::Linear(stiffness) => self.preload + stiffness * stroke,
            StrutSpring::Gas { length, exponent } => {
                self.preload * (1.0 - (stroke / length).min(MOST_PRESSED)).powf(-exponent)
            }
        }
    }

    /// Largest stiffness of spring, stops and water [N/m], in water of ρ g [N/m³]: what the step has to follow.
    pub fn largest_stiffness(&self, of_water: f64) -> f64 {
        let end = 1e-3 * self.stroke;
        let slope = (self.spring_load(self.stroke) - self.spring_load(self.stroke - end)) / end;
        (STOP * self.spring_load(self.stroke) / self.stroke).max(slope) + of_water * self.waterplane
    }

    /// Stroke at which the foot hangs in the air by its weight [m].
    pub fn hanging(&self, gravity: f64) -> f64 {
        let stop = STOP * self.spring_load(self.stroke) / self.stroke;
        -(self.preload + self.mass * gravity) / stop
    }

    /// Place of the foot at a stroke: from the nose, over the body axis [m].
    pub fn foot_at(&self, stroke: f64) -> [f64; 2] {
        [self.foot[0], self.foot[1] + stroke]
    }

    /// EN56: loads of strut and water at a moment, in water of density ρ [kg/m³] and gravity g [m/s²].
    pub fn at(
        &self,
        index: usize,
        centre: [f64; 2],
        now: &Attitude,
        swell: &Swell,
        rho: f64,
        gravity: f64,
    ) -> StrutLoad {
        let (stroke, speed) = (now.stroke[index], now.stroke_rate[index]);
        let place = self.foot_at(stroke);
        let (sin, cos) = now.place[2].sin_cos();
        let [x, z] = now.of_point(centre, place);
        let surface = swell.water(x);
        let depth = (surface.elevation - z).max(0.0);
        let wet = depth.min(self.face[1]);
        let [u, w] = now.velocity_of(centre, place);
        let [u, w] = [u - speed * sin - surface.velocity[0], w + speed * cos - surface.velocity[1]];
        let of_speed = -0.5 * rho * self.drag * self.face[0] * wet * u.hypot(w);
        let force = [of_speed * u, of_speed * w + rho * gravity * self.waterplane * depth].map(|f| self.number * f);
        // drag acts at the middle of the wet part
        let [rx, rz] = [x - now.place[0], z + 0.5 * wet - now.place[1]];
        let lever = [-sin, cos, rx * cos + rz * sin];
        let mut all = [0.0; FREEDOMS];
        all[..3].copy_from_slice(&lever);
        StrutLoad {
            along: self.number * self.load(stroke, speed),
            water: [force[0], force[1], rx * force[1] - rz * force[0]],
            lever: all,
            water_along: -sin * force[0] + cos * force[1],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strut(spring: StrutSpring) -> Strut {
        Strut {
            name: "main".into(),
            number: 2.0,
            foot: [10.0, -2.0],
            mass: 100.0,
            stroke: 0.4,
            preload: 2e4,
            spring,
            damping: 1e3,
            orifice: 2e4,
            breaks_at: None,
            face: [0.4, 1.0],
            drag: 0.8,
            waterplane: 0.0,
        }
    }

    #[test]
    fn gas_is_compressed_by_its_law_and_stops_hold_the_ends() {
        let oleo = strut(StrutSpring::Gas { length: 0.5, exponent: 1.3 });
        assert!((oleo.load(0.25, 0.0) / (2e4 * 2.0_f64.powf(1.3)) - 1.0).abs() < 1e-14);
        assert!((oleo.load(0.25, -2.0) - oleo.load(0.25, 0.0) + 2e3 + 8e4).abs() < 1e-9);
        assert!(oleo.load(0.44, 0.0) > 2.9 * oleo.load(0.4, 0.0) && oleo.load(0.41, 0.0) < 1.6 * oleo.load(0.4, 0.0));
        assert!((oleo.load(oleo.hanging(9.81), 0.0) + 100.0 * 9.81).abs() < 1e-9);
        let linear = strut(StrutSpring::Linear(1e5));
        assert!((linear.load(0.3, 0.0) - 5e4).abs() < 1e-9);
    }
}
