//! Motion of an aeroplane on the water, in its plane of symmetry (THEORY EN18).

use super::attitude::{Attitude, FREEDOMS, MODES, STRUTS};
use super::balance::Balance;
use super::landing::{FlightMoment, Landing, LandingEnd, LandingResult, LandingState};
use super::swell::Swell;

/// Steepest pitch that strips across the way of flight stand for [rad].
const STEEPEST_PITCH: f64 = 0.7;

/// A keel this far above the water, over the fuselage's length, is not in a skip [-].
const ALOFT: f64 = 0.1;

impl Landing<'_> {
    /// Where it first touches: the lowest place of keel and parts on the surface.
    pub fn start(&self) -> Attitude {
        let (sin, cos) = self.path.sin_cos();
        let mut attitude = Attitude {
            place: [0.0, 0.0, self.pitch],
            rate: [self.speed * cos, self.speed * sin, 0.0],
            ..Attitude::default()
        };
        for (k, strut) in self.aeroplane.struts.iter().enumerate() {
            attitude.stroke[k] = strut.hanging(self.water.gravity * self.pitch.cos());
        }
        attitude.place[1] = -self.clearance(&attitude, &self.swell);
        attitude
    }

    /// Places of keel and parts that may touch first: from the nose, over the body axis [m].
    pub(super) fn lowest_places(&self) -> Vec<[f64; 2]> {
        let craft = &self.aeroplane;
        let keel = self.edges().into_iter().map(|x| [x, self.hull.fuselage().keel(x).height]);
        let surfaces = craft.surfaces.iter().flat_map(|surface| surface.corners());
        let nacelles = craft.nacelles.iter().flat_map(|nacelle| nacelle.keel());
        keel.chain(surfaces).chain(nacelles).chain(craft.struts.iter().map(|strut| strut.foot)).collect()
    }

    /// Height of keel and parts above the surface where it is least [m].
    pub(super) fn clearance(&self, now: &Attitude, swell: &Swell) -> f64 {
        let height = |place: [f64; 2]| {
            let [x, z] = now.of_point(self.aeroplane.centre, place);
            z - swell.water(x).elevation
        };
        self.lowest_places().into_iter().map(height).fold(f64::INFINITY, f64::min)
    }

    /// Follow it to its end: the classical Runge–Kutta method, with EN18 solved for the accelerations at each stage.
    pub fn solve(&self) -> LandingResult {
        let mut attitude = self.start();
        let mut lost = vec![false; self.aeroplane.parts()];
        let mut moments = vec![self.moment(0.0, attitude, &lost)];
        let mut flight = Vec::new();
        for step in 1.. {
            let before = (step - 1) as f64 * self.step;
            let first = self.balance(before, &attitude, &lost);
            flight.push(FlightMoment { time: before, attitude, acceleration: first.acceleration });
            self.aeroplane.lose(self.hull, &mut lost, &first.parts, &first.strips);
            attitude = self.advanced(before, attitude, &first, &lost);
            let time = step as f64 * self.step;
            let ended = self.ended(time, &attitude);
            if ended.is_some() || step % self.sample_every == 0 {
                moments.push(self.moment(time, attitude, &lost));
            }
            if let Some(ended) = ended {
                return LandingResult { moments, flight, ended };
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
        let swell = self.swell.later(time);
        if tip[1] < swell.water(tip[0]).elevation {
            return Some(LandingEnd::OutOfRange(format!("the nose goes under at t = {time:.3} s")));
        }
        if now.place[2].abs() > STEEPEST_PITCH {
            let pitch = now.place[2].to_degrees();
            return Some(LandingEnd::OutOfRange(format!("a pitch of {pitch:.1} degrees at t = {time:.3} s")));
        }
        if now.rate[0] < self.least_speed {
            return Some(LandingEnd::Slow);
        }
        let clearance = self.clearance(now, &swell);
        if clearance > ALOFT * self.hull.fuselage().length() + 2.0 * swell.amplitude {
            return Some(LandingEnd::Aloft(format!(
                "the aeroplane has left the water: at t = {time:.3} s its keel is {clearance:.1} m above it, which is no landing any more"
            )));
        }
        (time >= self.end - 0.5 * self.step).then_some(LandingEnd::Time)
    }

    /// One step of the classical Runge–Kutta method; `first` is the balance at its start.
    fn advanced(&self, time: f64, now: Attitude, first: &Balance, lost: &[bool]) -> Attitude {
        let dt = self.step;
        let slope = |after: f64, a: &Attitude| Slope::new(a, &self.balance(time + after, a, lost));
        let k1 = Slope::new(&now, first);
        let k2 = slope(0.5 * dt, &k1.ahead(&now, 0.5 * dt));
        let k3 = slope(0.5 * dt, &k2.ahead(&now, 0.5 * dt));
        let k4 = slope(dt, &k3.ahead(&now, dt));
        Slope::mean([&k1, &k2, &k3, &k4]).ahead(&now, dt)
    }

    /// What happens at a time and an attitude with some parts lost.
    pub fn moment(&self, time: f64, attitude: Attitude, lost: &[bool]) -> LandingState {
        let Balance { acceleration, force, lift, strips, parts, .. } = self.balance(time, &attitude, lost);
        let ends = strips.iter().map(|(s, _)| s.wet.x).fold(None, |ends: Option<[f64; 2]>, x| {
            Some(ends.map_or([x, x], |[first, last]| [first.min(x), last.max(x)]))
        });
        LandingState { time, attitude, acceleration, force, lift, wetted: ends, strips, parts, lost: lost.to_vec() }
    }
}

/// Number of rates: of the freedoms, then of the struts.
const ALL: usize = FREEDOMS + STRUTS;

/// Rates of place, bending and strokes, and of these rates.
struct Slope {
    rate: [f64; ALL],
    acceleration: [f64; ALL],
}

impl Slope {
    fn new(now: &Attitude, balance: &Balance) -> Slope {
        let (mut rate, mut acceleration) = ([0.0; ALL], [0.0; ALL]);
        rate[..3].copy_from_slice(&now.rate);
        rate[3..FREEDOMS].copy_from_slice(&now.bend_rate);
        rate[FREEDOMS..].copy_from_slice(&now.stroke_rate);
        acceleration[..FREEDOMS].copy_from_slice(&balance.acceleration);
        acceleration[FREEDOMS..].copy_from_slice(&balance.of_strokes);
        Slope { rate, acceleration }
    }

    /// The mean of the classical Runge–Kutta method.
    fn mean([a, b, c, d]: [&Slope; 4]) -> Slope {
        let mean = |of: fn(&Slope) -> &[f64; ALL]| {
            let [a, b, c, d] = [a, b, c, d].map(of);
            std::array::from_fn(|k| (a[k] + 2.0 * (b[k] + c[k]) + d[k]) / 6.0)
        };
        Slope { rate: mean(|k| &k.rate), acceleration: mean(|k| &k.acceleration) }
    }

    /// The attitude after `dt` [s] along it.
    fn ahead(&self, now: &Attitude, dt: f64) -> Attitude {
        let Slope { rate, acceleration } = self;
        Attitude {
            place: std::array::from_fn(|k| now.place[k] + dt * rate[k]),
            rate: std::array::from_fn(|k| now.rate[k] + dt * acceleration[k]),
            bend: std::array::from_fn::<_, MODES, _>(|k| now.bend[k] + dt * rate[3 + k]),
            bend_rate: std::array::from_fn(|k| now.bend_rate[k] + dt * acceleration[3 + k]),
            stroke: std::array::from_fn(|k| now.stroke[k] + dt * rate[FREEDOMS + k]),
            stroke_rate: std::array::from_fn(|k| now.stroke_rate[k] + dt * acceleration[FREEDOMS + k]),
        }
    }
}
