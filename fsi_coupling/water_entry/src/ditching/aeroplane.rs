//! The aeroplane of a landing, and its air and water (THEORY EN19).

use serde::{Deserialize, Serialize};

use super::attitude::Attitude;
use super::bending::Bending;
use super::hull::Hull;
use super::parts::{Nacelle, Panel, PointForce, Surface};
use super::strip::Strip;
use super::struts::Strut;
use super::swell::Swell;

/// The wing: lift in proportion to the angle of attack and to the speed's square. A landing's table `[wing]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Wing {
    /// Area of the wing [m²].
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub area: f64,
    /// Mean chord of the wing [m].
    #[cfg_attr(feature = "schema", schemars(extend("exclusiveMinimum" = 0)))]
    pub chord: f64,
    /// Slope of the lift coefficient against the angle of attack [1/rad].
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub lift_slope: f64,
    /// Angle of attack of the body axis at which there is no lift [deg].
    pub zero_lift_deg: f64,
    /// Slope of the aeroplane's moment coefficient against the angle of attack [1/rad].
    #[serde(default = "usual::pitch_stiffness")]
    pub pitch_stiffness: f64,
    /// Its slope against q c/(2U), the rate of pitch [1/rad].
    #[serde(default = "usual::pitch_damping")]
    pub pitch_damping: f64,
    /// Angle of attack of the body axis at which the elevator balances the moment [deg].
    #[cfg_attr(feature = "schema", schemars(range(min = -90.0, max = 90.0), extend("x-default" = "landing.angle_of_attack_deg")))]
    pub trim_deg: Option<f64>,
    /// Drag coefficient of the aeroplane in air [-].
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub drag: f64,
    /// Density of the air [kg/m³].
    #[serde(default = "usual::air_density")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub air_density: f64,
}

mod usual {
    pub fn pitch_stiffness() -> f64 {
        -1.0
    }
    pub fn pitch_damping() -> f64 {
        -25.0
    }
    pub fn air_density() -> f64 {
        1.225
    }
}

/// What is rigid.
#[derive(Clone, Debug)]
pub struct Aeroplane {
    /// Mass [kg].
    pub mass: f64,
    /// Moment of inertia in pitch about the centre of mass [kg m²].
    pub inertia: f64,
    /// Centre of mass: from the nose, and over the body axis [m].
    pub centre: [f64; 2],
    /// The wing in air.
    pub wing: Wing,
    /// Surfaces that may meet the water.
    pub surfaces: Vec<Surface>,
    /// Nacelles or floats.
    pub nacelles: Vec<Nacelle>,
    /// Parts of the bottom that give way.
    pub panels: Vec<Panel>,
    /// Struts, at most [`STRUTS`](super::STRUTS).
    pub struts: Vec<Strut>,
    /// Bending of the fuselage; `None`: it is rigid.
    pub bending: Option<Bending>,
}

/// A landing's table `[water]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default)]
pub struct Water {
    /// Density of the water [kg/m³].
    #[cfg_attr(feature = "schema", schemars(extend("exclusiveMinimum" = 0)))]
    pub density: f64,
    /// Acceleration of gravity [m/s²].
    #[cfg_attr(feature = "schema", schemars(extend("exclusiveMinimum" = 0)))]
    pub gravity: f64,
    /// Friction coefficient of the wetted bottom [-].
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.1)))]
    pub friction: f64,
    /// Share of the theory's suction where the keel curves up [-].
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub suction: f64,
    /// Largest suction: atmospheric less vapour pressure, for a model test times the model's scale [Pa].
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub largest_suction: f64,
    /// Lift falls with the finite length of the wetted fuselage where the water leaves it at its end, a transom or step (THEORY EN46).
    pub finite_length: bool,
}

impl Default for Water {
    fn default() -> Water {
        Water {
            density: 1000.0,
            gravity: 9.81,
            friction: 0.003,
            suction: 1.0,
            largest_suction: 9.9e4,
            finite_length: true,
        }
    }
}

impl Wing {
    /// EN19: lift [N] at a speed [m/s] and angle of attack [rad]; never downwards.
    pub fn lift(&self, speed: f64, attack: f64) -> f64 {
        let coefficient = (self.lift_slope * (attack - self.zero_lift_deg.to_radians())).max(0.0);
        0.5 * self.air_density * self.area * coefficient * speed * speed
    }

    /// EN19: lift and drag forward and up, the lift, and the moment that turns the aeroplane towards its angle of attack in balance; without `trim_deg` this
    /// is the `attack` at the first touch [rad]. [N, N m]
    pub(super) fn air(&self, now: &Attitude, attack_at_touch: f64) -> ([f64; 2], f64, f64) {
        let [u, w, q] = now.rate;
        let (speed, attack) = (u.hypot(w), now.place[2] - w.atan2(u));
        let off = self.pitch_stiffness * (attack - self.trim_deg.map_or(attack_at_touch, f64::to_radians));
        let turning = self.pitch_damping * q * self.chord / (2.0 * speed.max(f64::MIN_POSITIVE));
        let of_area = 0.5 * self.air_density * speed * self.area;
        let lift = self.lift(speed, attack);
        let [ahead, above] = [u, w].map(|v| v / speed.max(f64::MIN_POSITIVE));
        let force = [-lift * above - of_area * self.drag * u, lift * ahead - of_area * self.drag * w];
        (force, lift, of_area * speed * self.chord * (off + turning))
    }

    /// Speed at which the wing carries a weight [N] at an angle of attack [rad]; `None` where it has no lift.
    pub fn carrying_speed(&self, weight: f64, attack: f64) -> Option<f64> {
        let at_one = self.lift(1.0, attack);
        (at_one > 0.0).then(|| (weight / at_one).sqrt())
    }
}

impl Aeroplane {
    /// Number of parts that may be lost: surfaces, then kinds of nacelles, then panels, then struts.
    pub fn parts(&self) -> usize {
        self.first_strut() + self.struts.len()
    }

    /// Number of the parts before the struts.
    pub(super) fn first_strut(&self) -> usize {
        self.surfaces.len() + self.nacelles.len() + self.panels.len()
    }

    /// Names of these.
    pub fn part_names(&self) -> Vec<&str> {
        let surfaces = self.surfaces.iter().map(|s| s.name.as_str());
        let nacelles = self.nacelles.iter().map(|n| n.name.as_str());
        let panels = self.panels.iter().map(|p| p.name.as_str());
        surfaces.chain(nacelles).chain(panels).chain(self.struts.iter().map(|s| s.name.as_str())).collect()
    }

    /// Forces of the water on the surfaces, on the nacelles' faces, and on the frames behind panels that have given way.
    pub(super) fn immersed(
        &self,
        hull: &Hull,
        now: &Attitude,
        swell: &Swell,
        lost: &[bool],
        rho: f64,
    ) -> Vec<Vec<PointForce>> {
        let surfaces = self.surfaces.iter().zip(lost).map(|(s, lost)| match lost {
            true => Vec::new(),
            false => s.water(self.centre, now, swell, rho),
        });
        let faces = self.nacelles.iter().map(|n| n.face_drag(self.centre, now, swell, rho).into_iter().collect());
        let frame = |p: &Panel| p.frame_drag(hull.fuselage(), self.centre, now, swell, rho).into_iter().collect();
        let held = self.surfaces.len() + self.nacelles.len();
        let is_loaded = |k: usize| lost[k] == (k >= held);
        let forces = surfaces.chain(faces).chain(self.panels.iter().map(frame)).enumerate();
        forces.map(|(k, forces)| if is_loaded(k) { forces } else { Vec::new() }).collect()
    }

    /// Parts whose load is larger than what they hold are lost.
    pub(super) fn lose(&self, hull: &Hull, lost: &mut [bool], parts: &[Vec<PointForce>], strips: &[(Strip, f64)]) {
        let holds = self.surfaces.iter().map(|s| s.breaks_at);
        let holds = holds.chain(self.nacelles.iter().map(|n| n.breaks_at.map(|f| f * n.number)));
        for ((lost, forces), holds) in lost.iter_mut().zip(parts).zip(holds) {
            let [fx, fz] = [0, 1].map(|k| forces.iter().map(|p| p.force[k]).sum::<f64>());
            *lost |= holds.is_some_and(|most| fx.hypot(fz) > most);
        }
        let held = self.surfaces.len() + self.nacelles.len();
        for (lost, panel) in lost[held..].iter_mut().zip(&self.panels) {
            *lost |= panel.is_pressed_in(hull.fuselage(), strips);
        }
        let of_struts = lost[self.first_strut()..].iter_mut().zip(&parts[self.first_strut()..]);
        for ((lost, forces), strut) in of_struts.zip(&self.struts) {
            let [fx, fz] = [0, 1].map(|k| forces.iter().map(|p| p.force[k]).sum::<f64>());
            *lost |= strut.breaks_at.is_some_and(|most| fx.hypot(fz) > most * strut.number);
        }
    }

    /// Has the bottom given way at a place [m from the nose]?
    pub(super) fn is_open(&self, x: f64, lost: &[bool]) -> bool {
        let held = self.surfaces.len() + self.nacelles.len();
        self.panels.iter().zip(&lost[held..]).any(|(panel, lost)| *lost && panel.covers(x))
    }
}
