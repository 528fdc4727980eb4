//! Motion of an aeroplane on the water, in its plane of symmetry (THEORY EN18, EN19).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::hull::Hull;
use super::strip::{Attitude, ImpactingPart, Strip};

/// Rounds in which strips that would pull are let go.
const MOST_ROUNDS: usize = 40;
/// Steepest pitch that strips across the way of flight stand for [rad].
const STEEPEST_PITCH: f64 = 0.7;

/// The wing: lift in proportion to the angle of attack and to the speed's square. A landing's table `[wing]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Wing {
    /// Area of the wing [m²].
    #[schemars(range(min = 0.0))]
    pub area: f64,
    /// Mean chord of the wing [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub chord: f64,
    /// Slope of the lift coefficient against the angle of attack [1/rad].
    #[schemars(range(min = 0.0))]
    pub lift_slope: f64,
    /// Angle of attack of the body axis at which there is no lift [deg].
    pub zero_lift_deg: f64,
    /// Slope of the aeroplane's moment coefficient against the angle of attack [1/rad].
    #[serde(default = "usual::pitch_stiffness")]
    pub pitch_stiffness: f64,
    /// Its slope against q c/(2U), the rate of pitch [1/rad].
    #[serde(default = "usual::pitch_damping")]
    pub pitch_damping: f64,
    /// Density of the air [kg/m³].
    #[serde(default = "usual::air_density")]
    #[schemars(range(min = 0.0))]
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aeroplane {
    /// Mass [kg].
    pub mass: f64,
    /// Moment of inertia in pitch about the centre of mass [kg m²].
    pub inertia: f64,
    /// Centre of mass: from the nose, and over the body axis [m].
    pub centre: [f64; 2],
    /// The wing.
    pub wing: Wing,
}

/// A landing's table `[water]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Water {
    /// Density of the water [kg/m³].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: f64,
    /// Acceleration of gravity [m/s²].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub gravity: f64,
    /// Friction coefficient of the wetted bottom [-].
    #[schemars(range(min = 0.0, max = 0.1))]
    pub friction: f64,
    /// Share of the theory's suction where the keel curves up [-].
    #[schemars(range(min = 0.0, max = 1.0))]
    pub suction: f64,
}

impl Default for Water {
    fn default() -> Water {
        Water { density: 1000.0, gravity: 9.81, friction: 0.003, suction: 1.0 }
    }
}

/// A landing: from the first touch to the end.
#[derive(Clone, Debug)]
pub struct Landing<'a> {
    /// What the water meets.
    pub hull: &'a Hull,
    /// What is rigid.
    pub aeroplane: Aeroplane,
    /// The water.
    pub water: Water,
    /// Pitch at the first touch, nose up [rad].
    pub pitch: f64,
    /// Direction of flight then, upwards [rad].
    pub path: f64,
    /// Speed along it [m/s].
    pub speed: f64,
    /// Number of strips along the fuselage.
    pub strips: usize,
    /// Length of a step [s].
    pub step: f64,
    /// Steps between samples.
    pub sample_every: usize,
    /// End of time [s].
    pub end: f64,
    /// The run ends below this forward speed [m/s].
    pub least_speed: f64,
}

/// The landing at a moment.
#[derive(Clone, Debug, PartialEq)]
pub struct LandingState {
    /// Time since the first touch [s].
    pub time: f64,
    /// Where it is and how it moves.
    pub attitude: Attitude,
    /// Accelerations forward and up [m/s²], and in pitch [rad/s²].
    pub acceleration: [f64; 3],
    /// Force of the water forward and up [N], and its moment about the centre of mass, nose up [N m].
    pub force: [f64; 3],
    /// Lift of the wing [N].
    pub lift: f64,
    /// Foremost and aftmost wet place, from the nose [m]; `None` in the air.
    pub wetted: Option<[f64; 2]>,
    /// The strips that are wet, and the force of each on the keel line [N]: pressure of entry, without buoyancy.
    pub strips: Vec<(Strip, f64)>,
}

/// A keel this far above the water, over the fuselage's length, is not in a skip [-].
const ALOFT: f64 = 0.1;

/// Why a landing ended.
#[derive(Clone, Debug, PartialEq)]
pub enum LandingEnd {
    /// The time was up.
    Time,
    /// It was as slow as asked for.
    Slow,
    /// It left the water for good: what happened.
    Aloft(String),
    /// The motion left what strips can describe: what happened.
    OutOfRange(String),
}

/// A landing that was followed.
#[derive(Clone, Debug)]
pub struct LandingResult {
    /// Samples, the first at the first touch, the last at the end.
    pub moments: Vec<LandingState>,
    /// Why it ended.
    pub ended: LandingEnd,
}

impl Wing {
    /// EN19: lift [N] at a speed [m/s] and angle of attack [rad]; never downwards.
    pub fn lift(&self, speed: f64, attack: f64) -> f64 {
        let coefficient = (self.lift_slope * (attack - self.zero_lift_deg.to_radians())).max(0.0);
        0.5 * self.air_density * self.area * coefficient * speed * speed
    }

    /// Speed at which the wing carries a weight [N] at an angle of attack [rad]; `None` where it has no lift.
    pub fn carrying_speed(&self, weight: f64, attack: f64) -> Option<f64> {
        let at_one = self.lift(1.0, attack);
        (at_one > 0.0).then(|| (weight / at_one).sqrt())
    }
}

/// Accelerations and what made them.
struct Balance {
    acceleration: [f64; 3],
    force: [f64; 3],
    lift: f64,
    strips: Vec<(Strip, f64)>,
}

impl Landing<'_> {
    /// Where it first touches: the lowest place of the keel on the still surface.
    pub fn start(&self) -> Attitude {
        let (sin, cos) = self.path.sin_cos();
        let mut attitude = Attitude { place: [0.0, 0.0, self.pitch], rate: [self.speed * cos, self.speed * sin, 0.0] };
        attitude.place[1] = -self.clearance(&attitude);
        attitude
    }

    /// Height of the keel's lowest place above the still surface [m].
    fn clearance(&self, now: &Attitude) -> f64 {
        let height = |x: f64| now.of_point(self.aeroplane.centre, [x, self.hull.fuselage().keel(x).height])[1];
        self.edges().into_iter().map(height).fold(f64::INFINITY, f64::min)
    }

    /// Ends of the strips, from the nose [m]: stations are among them.
    fn edges(&self) -> Vec<f64> {
        let fuselage = self.hull.fuselage();
        let mut edges = vec![fuselage.ends()[0]];
        for pair in fuselage.stations().windows(2) {
            let (from, to) = (pair[0].x, pair[1].x);
            let n = (self.strips as f64 * (to - from) / fuselage.length()).ceil().max(1.0);
            edges.extend((1..=n as usize).map(|k| from + (to - from) * k as f64 / n));
        }
        edges
    }

    /// Follow it to its end: the classical Runge–Kutta method, with EN18 solved for the accelerations at each stage.
    pub fn solve(&self) -> LandingResult {
        let mut attitude = self.start();
        let mut moments = vec![self.moment(0.0, attitude)];
        for step in 1.. {
            attitude = self.advanced(attitude);
            let time = step as f64 * self.step;
            let ended = self.ended(time, &attitude);
            if ended.is_some() || step % self.sample_every == 0 {
                moments.push(self.moment(time, attitude));
            }
            if let Some(ended) = ended {
                return LandingResult { moments, ended };
            }
        }
        unreachable!("time ends")
    }

    fn ended(&self, time: f64, now: &Attitude) -> Option<LandingEnd> {
        let [nose, _] = self.hull.fuselage().ends();
        let tip = now.of_point(self.aeroplane.centre, [nose, self.hull.fuselage().keel(nose).height]);
        if !now.place.iter().chain(&now.rate).all(|v| v.is_finite()) {
            return Some(LandingEnd::OutOfRange(format!(
                "motion without bounds at t = {time:.4} s: take a shorter step"
            )));
        }
        if tip[1] < 0.0 {
            return Some(LandingEnd::OutOfRange(format!("the nose goes under at t = {time:.3} s")));
        }
        if now.place[2].abs() > STEEPEST_PITCH {
            let pitch = now.place[2].to_degrees();
            return Some(LandingEnd::OutOfRange(format!("a pitch of {pitch:.1} degrees at t = {time:.3} s")));
        }
        if now.rate[0] < self.least_speed {
            return Some(LandingEnd::Slow);
        }
        let clearance = self.clearance(now);
        if clearance > ALOFT * self.hull.fuselage().length() {
            return Some(LandingEnd::Aloft(format!(
                "the aeroplane has left the water: at t = {time:.3} s its keel is {clearance:.1} m above it, which is no landing any more"
            )));
        }
        (time >= self.end - 0.5 * self.step).then_some(LandingEnd::Time)
    }

    fn advanced(&self, now: Attitude) -> Attitude {
        let dt = self.step;
        let slope = |a: &Attitude| (a.rate, self.balance(a).acceleration);
        let ahead = |(v, a): ([f64; 3], [f64; 3]), dt: f64| Attitude {
            place: [0, 1, 2].map(|k| now.place[k] + dt * v[k]),
            rate: [0, 1, 2].map(|k| now.rate[k] + dt * a[k]),
        };
        let k1 = slope(&now);
        let k2 = slope(&ahead(k1, 0.5 * dt));
        let k3 = slope(&ahead(k2, 0.5 * dt));
        let k4 = slope(&ahead(k3, dt));
        let mean = |a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]| {
            [0, 1, 2].map(|k| (a[k] + 2.0 * (b[k] + c[k]) + d[k]) / 6.0)
        };
        ahead((mean(k1.0, k2.0, k3.0, k4.0), mean(k1.1, k2.1, k3.1, k4.1)), dt)
    }

    /// EN19: lift [N], and the moment that turns the aeroplane back to its attitude at the first touch [N m].
    fn air(&self, now: &Attitude) -> [f64; 2] {
        let (wing, [u, w, q]) = (&self.aeroplane.wing, now.rate);
        let (speed, attack) = (u.hypot(w), now.place[2] - w.atan2(u));
        let off = wing.pitch_stiffness * (attack - (self.pitch - self.path));
        let turning = wing.pitch_damping * q * wing.chord / (2.0 * speed.max(f64::MIN_POSITIVE));
        let pressure = 0.5 * wing.air_density * speed * speed;
        [wing.lift(speed, attack), pressure * wing.area * wing.chord * (off + turning)]
    }

    /// What happens at an attitude.
    pub fn moment(&self, time: f64, attitude: Attitude) -> LandingState {
        let Balance { acceleration, force, lift, strips } = self.balance(&attitude);
        let ends = strips.iter().map(|(s, _)| s.wet.x).fold(None, |ends: Option<[f64; 2]>, x| {
            Some(ends.map_or([x, x], |[first, last]| [first.min(x), last.max(x)]))
        });
        LandingState { time, attitude, acceleration, force, lift, wetted: ends, strips }
    }

    /// EN18: (diag(m, m, I) + Σ M g gᵀ) a = Σ f₀ g + weight, lift, buoyancy, friction.
    ///
    /// Which strips press and which would pull is found with the accelerations: f = f₀ − M g·a.
    fn balance(&self, now: &Attitude) -> Balance {
        let Landing { aeroplane: craft, water, .. } = self;
        let edges = self.edges();
        let cut = |w: &[f64]| Strip::new(self.hull, craft.centre, now, [w[0], w[1]], water.density, water.gravity);
        let strips: Vec<Strip> = edges.windows(2).filter_map(cut).collect();
        let [lift, trimming] = self.air(now);
        let mut steady = [0.0, lift - craft.mass * water.gravity, trimming];
        for strip in &strips {
            let rub = strip.entry.map_or([0.0; 3], |e| e.friction(0.5 * water.density * water.friction));
            let floating = strip.floating();
            (0..3).for_each(|k| steady[k] += floating[k] + rub[k]);
        }
        // a strip that would pull does so by the share `suction`
        let share = |e: &ImpactingPart, a: [f64; 3]| if e.force(a) >= 0.0 { 1.0 } else { water.suction };
        let entering: Vec<ImpactingPart> = strips.iter().filter_map(|s| s.entry).collect();
        let mut shares: Vec<f64> = entering.iter().map(|e| share(e, [0.0; 3])).collect();
        let mut acceleration = [0.0; 3];
        for _ in 0..MOST_ROUNDS {
            let mut matrix = [[craft.mass, 0.0, 0.0], [0.0, craft.mass, 0.0], [0.0, 0.0, craft.inertia]];
            let mut right = steady;
            for (e, share) in entering.iter().zip(&shares) {
                for i in 0..3 {
                    right[i] += share * e.pressing * e.lever[i];
                    (0..3).for_each(|j| matrix[i][j] += share * e.mass * e.lever[i] * e.lever[j]);
                }
            }
            acceleration = solved(matrix, right);
            let next: Vec<f64> = entering.iter().map(|e| share(e, acceleration)).collect();
            if next == shares {
                break;
            }
            shares = next;
        }
        let load = |e: &ImpactingPart| share(e, acceleration) * e.force(acceleration);
        let strips: Vec<(Strip, f64)> = strips.into_iter().map(|s| (s, s.entry.as_ref().map_or(0.0, load))).collect();
        let mut force = steady;
        force[1] -= lift - craft.mass * water.gravity;
        force[2] -= trimming;
        for (entry, f) in strips.iter().filter_map(|(s, f)| Some((s.entry?, f))) {
            (0..3).for_each(|k| force[k] += f * entry.lever[k]);
        }
        Balance { acceleration, force, lift, strips }
    }
}

/// Cramer's rule, for a positive definite matrix.
fn solved(m: [[f64; 3]; 3], b: [f64; 3]) -> [f64; 3] {
    let det = |m: &[[f64; 3]; 3]| {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    };
    let whole = det(&m);
    [0, 1, 2].map(|k| {
        let mut with = m;
        (0..3).for_each(|i| with[i][k] = b[i]);
        det(&with) / whole
    })
}
