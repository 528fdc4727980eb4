//! A strip of the fuselage and the plane of water that it is in: kinematics and the parts of its load.

use std::f64::consts::PI;

use super::attitude::{Attitude, FREEDOMS, MODES};
use super::bending::Bending;
use super::hull::Hull;
use super::swell::Swell;

/// What the water meets: a bottom on an aeroplane whose centre of mass is `centre`, which may bend.
#[derive(Clone, Copy)]
pub struct Bottom<'a> {
    /// Keel and sections.
    pub hull: &'a Hull,
    /// From the nose, and over the body axis [m].
    pub centre: [f64; 2],
    /// Bending of the fuselage.
    pub bending: Option<&'a Bending>,
    /// The water's swell.
    pub swell: Swell,
}

/// EN15, EN37: the keel at a place, and the plane of water that it passes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeelPoint {
    /// Place from the nose along the body axis [m].
    pub x: f64,
    /// Draught of the keel h [m].
    pub draught: f64,
    /// Its rate in the plane of water ḣ [m/s].
    pub speed: f64,
    /// What of d²h/dt² is no acceleration of the aeroplane [m/s²].
    pub bending: f64,
    /// Slope of the keel in space, upwards ahead [-].
    pub slope: f64,
    /// From the centre of mass, forward and up [m].
    pub lever_arm: [f64; 2],
    /// Its velocity through the water, forward and up [m/s].
    pub velocity: [f64; 2],
    /// Acceleration of the water there, forward and up [m/s²].
    pub water_acceleration: [f64; 2],
    /// Length on the way of flight over length along the axis [-].
    pub shortening: f64,
    /// Its way across the way of flight per amplitude of the bending modes [-].
    pub modes: [f64; MODES],
}

impl KeelPoint {
    /// The keel at x [m from the nose].
    pub fn new(bottom: &Bottom<'_>, now: &Attitude, x: f64) -> KeelPoint {
        let keel = bottom.hull.fuselage().keel(x);
        let modes = bottom.bending.map_or([[0.0; 3]; MODES], |bending| bending.at(x));
        let sum = |of: &[f64; MODES], k: usize| (0..MODES).map(|mode| of[mode] * modes[mode][k]).sum::<f64>();
        let [height, keel_slope, keel_bend] =
            [keel.height + sum(&now.bend, 0), keel.slope + sum(&now.bend, 1), keel.bend + sum(&now.bend, 2)];
        let [px, pz] = now.of_point(bottom.centre, [x, height]);
        let (sin, cos) = now.place[2].sin_cos();
        let shortening = cos + keel_slope * sin;
        let slope = (sin - keel_slope * cos) / shortening;
        let curvature = keel_bend / shortening.powi(3);
        let (lever_arm, [u, w, q]) = ([px - now.place[0], pz - now.place[1]], now.rate);
        let (rises, turns) = (sum(&now.bend_rate, 0), q - sum(&now.bend_rate, 1));
        let water = bottom.swell.water(px);
        let velocity = [
            u - q * lever_arm[1] - rises * sin - water.velocity[0],
            w + q * lever_arm[0] + rises * cos - water.velocity[1],
        ];
        KeelPoint {
            x,
            draught: water.elevation - pz,
            speed: slope * velocity[0] - velocity[1],
            bending: 2.0 * velocity[0] * turns * (1.0 + slope * slope) - curvature * velocity[0].powi(2)
                + q * q * (lever_arm[1] - slope * lever_arm[0])
                + (water.acceleration[1] - slope * water.acceleration[0]),
            slope,
            lever_arm,
            velocity,
            water_acceleration: water.acceleration,
            shortening,
            modes: [0, 1, 2, 3].map(|k| modes[k][0] * (slope * sin + cos)),
        }
    }

    /// Forward and upward force, moment nose up and forces on the bending modes, per unit of force on the keel across the way of flight
    /// [-, -, m, -].
    pub fn lever(&self) -> [f64; FREEDOMS] {
        let [a, b, c, d] = self.modes;
        [-self.slope, 1.0, self.lever_arm[0] + self.slope * self.lever_arm[1], a, b, c, d]
    }
}

/// A wet strip: the part of it that goes down presses with f = pressing − mass · (lever · acceleration), along `lever`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Middle of the wet part.
    pub wet: KeelPoint,
    /// Length of the wet part on the way of flight [m].
    pub wet_length: f64,
    /// Buoyancy, forward and up [N].
    pub buoyancy: [f64; 2],
    /// The part that presses, where there is one.
    pub entry: Option<ImpactingPart>,
}

/// The part of a strip that goes down into its plane of water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactingPart {
    /// Its middle.
    pub at: KeelPoint,
    /// Its length on the way of flight [m].
    pub length: f64,
    /// Directions of its load ([`KeelPoint::lever`]).
    pub lever: [f64; FREEDOMS],
    /// Load at no acceleration of the aeroplane [N].
    pub pressing: f64,
    /// Added mass [kg].
    pub mass: f64,
    /// Area that the water rubs along [m²].
    pub area: f64,
    /// Area of its cut with still water [m²].
    pub still_area: f64,
    /// Share of the load that is left where it pulls: added mass of the still half width over the theory's (EN27) [-].
    pub pulling: f64,
}

impl Strip {
    /// The strip between two places of the keel, in water of density ρ and gravity g; `None` where it is dry.
    pub fn new(bottom: &Bottom<'_>, now: &Attitude, ends: [&KeelPoint; 2], rho: f64, g: f64) -> Option<Strip> {
        let hull = bottom.hull;
        let [from, to] = part_above_nothing(ends.map(|p| p.x), ends.map(|p| p.draught))?;
        let wet = KeelPoint::new(bottom, now, 0.5 * (from + to));
        let wet_length = (to - from) * wet.shortening;
        let [ahead, up] = wet.water_acceleration;
        let of_wet = hull.at(wet.x, wet.draught);
        let buoyancy = [ahead, g + up].map(|acceleration| rho * acceleration * wet_length * of_wet.area);
        let speed_at = |x: f64| {
            let share = (x - ends[0].x) / (ends[1].x - ends[0].x);
            ends[0].speed + share * (ends[1].speed - ends[0].speed)
        };
        let entry = part_above_nothing([from, to], [from, to].map(speed_at)).map(|[from, to]| {
            let middle = 0.5 * (from + to);
            let (at, load) = match middle == wet.x {
                true => (wet, of_wet),
                false => {
                    let at = KeelPoint::new(bottom, now, middle);
                    (at, hull.at(at.x, at.draught))
                }
            };
            let length = (to - from) * at.shortening;
            let [before, after] = ends.map(|p| hull.added_mass(p.x, at.draught));
            let growth = (after - before) / (ends[1].x - ends[0].x); // ∂M/∂x
            let passing = at.velocity[0] / at.shortening; // dx/dt of the station that a plane meets
            let speed = at.speed.max(0.0);
            // EN17
            let per_length = load.slam * speed * speed + growth * passing * speed + load.added_mass * at.bending;
            ImpactingPart {
                at,
                length,
                lever: at.lever(),
                pressing: rho * length * per_length,
                mass: rho * length * load.added_mass,
                area: 2.0 * load.wetted * length * (1.0 + at.slope * at.slope).sqrt(),
                still_area: 2.0 * load.still * length,
                pulling: (0.5 * PI * load.still * load.still / load.added_mass).min(1.0),
            }
        });
        Some(Strip { wet, wet_length, buoyancy, entry })
    }

    /// `number` of them side by side.
    pub(super) fn times(self, number: f64) -> Strip {
        let entry = self.entry.map(|e| ImpactingPart {
            pressing: number * e.pressing,
            mass: number * e.mass,
            area: number * e.area,
            still_area: number * e.still_area,
            ..e
        });
        Strip { buoyancy: self.buoyancy.map(|force| number * force), entry, ..self }
    }

    /// EN46: with a share of its load and of its added mass.
    pub(super) fn with_share(self, share: f64) -> Strip {
        let entry = self.entry.map(|e| ImpactingPart { pressing: share * e.pressing, mass: share * e.mass, ..e });
        Strip { entry, ..self }
    }

    /// EN19: force and moment of the friction on its entering part; `of_square` is ½ρ C_f [kg/m³].
    pub fn rubbing(&self, of_square: f64) -> [f64; 3] {
        self.entry.map_or([0.0; 3], |entry| entry.friction(of_square))
    }

    /// EN19, EN37: force and moment of the buoyancy.
    pub fn floating(&self) -> [f64; 3] {
        let ([forward, up], [ax, az]) = (self.buoyancy, self.wet.lever_arm);
        [forward, up, up * ax - forward * az]
    }
}

impl ImpactingPart {
    /// Breadth that is wet [m].
    pub(super) fn breadth(&self) -> f64 {
        self.area / (self.length * (1.0 + self.at.slope * self.at.slope).sqrt())
    }

    /// EN17: its load [N] at accelerations of the aeroplane [m/s², m/s², rad/s², m/s²].
    pub fn force(&self, acceleration: [f64; FREEDOMS]) -> f64 {
        self.pressing - self.mass * along(&self.lever, &acceleration)
    }

    /// EN19: force and moment of the friction ½ρ C_f v|v| against the way along the keel; `of_square` is ½ρ C_f [kg/m³].
    pub fn friction(&self, of_square: f64) -> [f64; 3] {
        let KeelPoint { slope, lever_arm: [ax, az], velocity: [vx, vz], .. } = self.at;
        let along = 1.0 / (1.0 + slope * slope).sqrt();
        let sliding = (vx + slope * vz) * along;
        let forward = -of_square * self.area * sliding * sliding.abs() * along;
        [forward, forward * slope, forward * (ax * slope - az)]
    }
}

/// The part of accelerations that is along a lever.
pub(super) fn along(lever: &[f64; FREEDOMS], acceleration: &[f64; FREEDOMS]) -> f64 {
    (0..FREEDOMS).map(|k| lever[k] * acceleration[k]).sum()
}

/// The part of an interval where a quantity that is linear on it, with these values at its ends, is above nothing.
fn part_above_nothing([from, to]: [f64; 2], [first, last]: [f64; 2]) -> Option<[f64; 2]> {
    let crossing = from + (to - from) * first / (first - last);
    match (first > 0.0, last > 0.0) {
        (true, true) => Some([from, to]),
        (true, false) => Some([from, crossing]),
        (false, true) => Some([crossing, to]),
        (false, false) => None,
    }
}
