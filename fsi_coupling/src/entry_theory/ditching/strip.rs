//! A strip of the fuselage and the plane of water that it is in: kinematics and the parts of its load.

use super::hull::Hull;

/// Where the aeroplane is and how it moves: centre of mass, pitch nose up, and their rates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Attitude {
    /// Forward and up from a point of the still surface [m], pitch [rad].
    pub place: [f64; 3],
    /// Their rates [m/s, m/s, rad/s].
    pub rate: [f64; 3],
}

impl Attitude {
    /// Forward and up of a place [m], at x from the nose and z over the body axis; `centre` is that of mass, likewise.
    pub fn of_point(&self, centre: [f64; 2], [x, z]: [f64; 2]) -> [f64; 2] {
        let ((sin, cos), ahead, above) = (self.place[2].sin_cos(), centre[0] - x, z - centre[1]);
        [self.place[0] + ahead * cos - above * sin, self.place[1] + ahead * sin + above * cos]
    }
}

/// EN15: the keel at a place, and the plane of water that it passes through.
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
    /// Its speed forward and up [m/s].
    pub velocity: [f64; 2],
    /// Length on the way of flight over length along the axis [-].
    pub shortening: f64,
}

impl KeelPoint {
    /// The keel at x [m from the nose] of an aeroplane whose centre of mass is `centre`.
    pub fn new(hull: &Hull, centre: [f64; 2], now: &Attitude, x: f64) -> KeelPoint {
        let keel = hull.fuselage().keel(x);
        let [px, pz] = now.of_point(centre, [x, keel.height]);
        let (sin, cos) = now.place[2].sin_cos();
        let shortening = cos + keel.slope * sin;
        let slope = (sin - keel.slope * cos) / shortening;
        let curvature = keel.bend / shortening.powi(3);
        let (lever_arm, [u, w, q]) = ([px - now.place[0], pz - now.place[1]], now.rate);
        let velocity = [u - q * lever_arm[1], w + q * lever_arm[0]];
        KeelPoint {
            x,
            draught: -pz,
            speed: slope * velocity[0] - velocity[1],
            bending: 2.0 * velocity[0] * q * (1.0 + slope * slope) - curvature * velocity[0].powi(2)
                + q * q * (lever_arm[1] - slope * lever_arm[0]),
            slope,
            lever_arm,
            velocity,
            shortening,
        }
    }

    /// Forward and upward force and moment nose up, per unit of force on the keel across the way of flight [-, -, m].
    pub fn lever(&self) -> [f64; 3] {
        [-self.slope, 1.0, self.lever_arm[0] + self.slope * self.lever_arm[1]]
    }
}

/// A wet strip: the part of it that goes down presses with f = pressing − mass · (lever · acceleration), along `lever`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Middle of the wet part.
    pub wet: KeelPoint,
    /// Length of the wet part on the way of flight [m].
    pub wet_length: f64,
    /// Buoyancy [N].
    pub buoyancy: f64,
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
    pub lever: [f64; 3],
    /// Load at no acceleration of the aeroplane [N].
    pub pressing: f64,
    /// Added mass [kg].
    pub mass: f64,
    /// Area that the water rubs along [m²].
    pub area: f64,
}

impl Strip {
    /// The strip between two places from the nose [m], in water of density ρ and gravity g; `None` where it is dry.
    pub fn new(hull: &Hull, centre: [f64; 2], now: &Attitude, ends: [f64; 2], rho: f64, g: f64) -> Option<Strip> {
        let ends = ends.map(|x| KeelPoint::new(hull, centre, now, x));
        let [from, to] = part_above_nothing(ends.map(|p| p.x), ends.map(|p| p.draught))?;
        let wet = KeelPoint::new(hull, centre, now, 0.5 * (from + to));
        let wet_length = (to - from) * wet.shortening;
        let buoyancy = rho * g * wet_length * hull.at(wet.x, wet.draught).area;
        let speed_at = |x: f64| {
            let share = (x - ends[0].x) / (ends[1].x - ends[0].x);
            ends[0].speed + share * (ends[1].speed - ends[0].speed)
        };
        let entry = part_above_nothing([from, to], [from, to].map(speed_at)).map(|[from, to]| {
            let at = KeelPoint::new(hull, centre, now, 0.5 * (from + to));
            let length = (to - from) * at.shortening;
            let load = hull.at(at.x, at.draught);
            let [before, after] = ends.map(|p| hull.at(p.x, at.draught).added_mass);
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
            }
        });
        Some(Strip { wet, wet_length, buoyancy, entry })
    }

    /// EN19: force and moment of the buoyancy.
    pub fn floating(&self) -> [f64; 3] {
        [0.0, self.buoyancy, self.buoyancy * self.wet.lever_arm[0]]
    }
}

impl ImpactingPart {
    /// EN17: its load [N] at accelerations of the aeroplane [m/s², m/s², rad/s²].
    pub fn force(&self, acceleration: [f64; 3]) -> f64 {
        self.pressing - self.mass * (0..3).map(|k| self.lever[k] * acceleration[k]).sum::<f64>()
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
