//! Motion of an aeroplane on the water, in its plane of symmetry (THEORY EN18).

use super::attitude::{Attitude, FREEDOMS, MODES};
use super::balance::Balance;
use super::landing::{Landing, LandingEnd, LandingResult, LandingState};

/// Steepest pitch that strips across the way of flight stand for [rad].
const STEEPEST_PITCH: f64 = 0.7;

/// A keel this far above the water, over the fuselage's length, is not in a skip [-].
const ALOFT: f64 = 0.1;

impl Landing<'_> {
    /// Where it first touches: the lowest place of keel and parts on the still surface.
    pub fn start(&self) -> Attitude {
        let (sin, cos) = self.path.sin_cos();
        let mut attitude = Attitude {
            place: [0.0, 0.0, self.pitch],
            rate: [self.speed * cos, self.speed * sin, 0.0],
            ..Attitude::default()
        };
        attitude.place[1] = -self.clearance(&attitude);
        attitude
    }

    /// Height of the lowest place of keel and parts above the still surface [m].
    fn clearance(&self, now: &Attitude) -> f64 {
        let craft = &self.aeroplane;
        let keel = self.edges().into_iter().map(|x| [x, self.hull.fuselage().keel(x).height]);
        let surfaces = craft.surfaces.iter().flat_map(|surface| surface.corners());
        let nacelles = craft.nacelles.iter().flat_map(|nacelle| nacelle.keel());
        let height = |place: [f64; 2]| now.of_point(craft.centre, place)[1];
        keel.chain(surfaces).chain(nacelles).map(height).fold(f64::INFINITY, f64::min)
    }

    /// Follow it to its end: the classical Runge–Kutta method, with EN18 solved for the accelerations at each stage.
    pub fn solve(&self) -> LandingResult {
        let mut attitude = self.start();
        let mut lost = vec![false; self.aeroplane.parts()];
        let mut moments = vec![self.moment(0.0, attitude, &lost)];
        for step in 1.. {
            let first = self.balance(&attitude, &lost);
            self.aeroplane.lose(self.hull, &mut lost, &first.parts, &first.strips);
            attitude = self.advanced(attitude, &first, &lost);
            let time = step as f64 * self.step;
            let ended = self.ended(time, &attitude);
            if ended.is_some() || step % self.sample_every == 0 {
                moments.push(self.moment(time, attitude, &lost));
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

    /// One step of the classical Runge–Kutta method; `first` is the balance at its start.
    fn advanced(&self, now: Attitude, first: &Balance, lost: &[bool]) -> Attitude {
        let dt = self.step;
        let slope = |a: &Attitude| Slope::new(a, self.balance(a, lost).acceleration);
        let k1 = Slope::new(&now, first.acceleration);
        let k2 = slope(&k1.ahead(&now, 0.5 * dt));
        let k3 = slope(&k2.ahead(&now, 0.5 * dt));
        let k4 = slope(&k3.ahead(&now, dt));
        let mean = |of: fn(&Slope) -> &[f64; FREEDOMS]| {
            let [a, b, c, d] = [&k1, &k2, &k3, &k4].map(of);
            std::array::from_fn(|k| (a[k] + 2.0 * (b[k] + c[k]) + d[k]) / 6.0)
        };
        Slope { rate: mean(|k| &k.rate), acceleration: mean(|k| &k.acceleration) }.ahead(&now, dt)
    }

    /// What happens at an attitude with some parts lost.
    pub fn moment(&self, time: f64, attitude: Attitude, lost: &[bool]) -> LandingState {
        let Balance { acceleration, force, lift, strips, parts } = self.balance(&attitude, lost);
        let ends = strips.iter().map(|(s, _)| s.wet.x).fold(None, |ends: Option<[f64; 2]>, x| {
            Some(ends.map_or([x, x], |[first, last]| [first.min(x), last.max(x)]))
        });
        LandingState { time, attitude, acceleration, force, lift, wetted: ends, strips, parts, lost: lost.to_vec() }
    }
}

/// Rates of place and bending, and of these rates.
struct Slope {
    rate: [f64; FREEDOMS],
    acceleration: [f64; FREEDOMS],
}

impl Slope {
    fn new(now: &Attitude, acceleration: [f64; FREEDOMS]) -> Slope {
        let mut rate = [0.0; FREEDOMS];
        rate[..3].copy_from_slice(&now.rate);
        rate[3..].copy_from_slice(&now.bend_rate);
        Slope { rate, acceleration }
    }

    /// The attitude after `dt` [s] along it.
    fn ahead(&self, now: &Attitude, dt: f64) -> Attitude {
        let Slope { rate, acceleration } = self;
        Attitude {
            place: std::array::from_fn(|k| now.place[k] + dt * rate[k]),
            rate: std::array::from_fn(|k| now.rate[k] + dt * acceleration[k]),
            bend: std::array::from_fn::<_, MODES, _>(|k| now.bend[k] + dt * rate[3 + k]),
            bend_rate: std::array::from_fn(|k| now.bend_rate[k] + dt * acceleration[3 + k]),
        }
    }
}
