//! A step in time: nodes by Adams and Bashforth's rule of third order, their potential along their way, one solution per step; the midpoint rule
//! where there is no past (THEORY EN22).

use std::array::{from_fn, from_mut};

use faer::c64;

use super::solution::{FlowLoad, Solution, Solved, SymmetricSolution};
use super::state::{EntryFlow, Past};
use super::surface::{FreeSurface, SurfaceFlow};
use super::{DRAUGHT_GROWTH, FlowEnded};

/// Longest way of a node per step, over the length of its element, by the midpoint rule.
const COURANT: f64 = 1.0;
/// Longest way of the water at a wet chine per step, over the length of the face's last element.
const AT_CHINE: f64 = 0.6;
/// Least share of the step to which that shortens it.
const LEAST_AT_CHINE: f64 = 0.3;
/// Least growth of the draught per step; a flow that needs shorter ones breaks up.
const LEAST_GROWTH: f64 = 3e-5;
/// Instants of which a step makes use.
const INSTANTS: usize = 3;

/// The coming step.
struct Ahead {
    /// Its length, and how long ago the last one began [s].
    dt: f64,
    ago: f64,
    /// Factors of the velocities now and earlier [s].
    weights: [f64; INSTANTS],
    /// Speed of the axes outwards [m/s].
    drift: f64,
    gravity: f64,
}

/// ∫ over the coming `dt` of the parabola through values now and `ago[0]` and `ago[1]` before now: the factors of the three (Adams and Bashforth,
/// uneven steps).
fn weights(dt: f64, [a, b]: [f64; 2]) -> [f64; INSTANTS] {
    let [one, two, three] = [dt, dt * dt / 2.0, dt * dt * dt / 3.0];
    [one + ((a + b) * two + three) / (a * b), -(b * two + three) / (a * (b - a)), (a * two + three) / (b * (b - a))]
}

/// One step of the flow on the sides of a body. `separate` lets the flow leave the body, under a downward acceleration [m/s²], and says whether
/// it did; `acceleration` gives that acceleration under a load. Returns the step [s] and the load at its start.
pub(super) fn step<const N: usize, L>(
    sides: &mut [EntryFlow; N],
    solve: impl Fn(&[EntryFlow; N]) -> Solved<N, L>,
    separate: impl Fn(&mut [EntryFlow; N], &Solved<N, L>, f64) -> bool,
    acceleration: impl Fn(&L) -> f64,
) -> Result<(f64, L), FlowEnded> {
    let mut start = solve(sides);
    if separate(sides, &start, acceleration(&start.load)) {
        sides.iter_mut().for_each(EntryFlow::clear_past);
        start = solve(sides);
    }
    let ended = |speed: f64| FlowEnded { draught: sides[0].draught, speed };
    let rate = acceleration(&start.load);
    let longest = |of: fn(&EntryFlow, &Solution) -> f64| {
        sides.iter().zip(&start.sides).map(|(side, now)| of(side, now)).fold(f64::INFINITY, f64::min)
    };
    let moved = |speed: f64, at: &Solved<N, L>, rate: f64, dt: f64| -> [EntryFlow; N] {
        from_fn(|i| sides[i].moved(speed, &at.sides[i], rate, dt))
    };
    let (dt, end) = if sides.iter().all(EntryFlow::has_past) {
        let dt = longest(EntryFlow::extrapolated_dt);
        (dt, from_fn(|i| sides[i].extrapolated(&start.sides[i], rate, dt)))
    } else {
        let dt = longest(EntryFlow::stable_dt);
        let half = moved(sides[0].speed, &start, rate, 0.5 * dt);
        if !half.iter().all(EntryFlow::is_finite) {
            return Err(ended(half[0].speed));
        }
        let middle = solve(&half);
        (dt, moved(half[0].speed, &middle, acceleration(&middle.load), dt))
    };
    let is_finite = end.iter().all(EntryFlow::is_finite) && start.force.is_finite();
    if !(is_finite && end[0].speed > 0.0) || sides[0].is_too_short(dt) {
        return Err(ended(end[0].speed));
    }
    for ((side, now), end) in sides.iter_mut().zip(&start.sides).zip(end) {
        *side = end.after(side, now, rate, dt).attached().redistributed();
    }
    Ok((dt, start.load))
}

impl EntryFlow {
    /// One step. `acceleration` gives the downward acceleration [m/s²] under a load. Returns the step [s] and the load at its start.
    ///
    /// # Errors
    /// A wedge that has stopped, or a flow that is no longer finite; the state before the step is kept.
    pub fn step(&mut self, acceleration: impl Fn(&FlowLoad) -> f64) -> Result<(f64, FlowLoad), FlowEnded> {
        let separate = |[flow]: &mut [EntryFlow; 1], now: &SymmetricSolution, rate: f64| flow.separate(now, rate);
        step(from_mut(self), |[flow]| flow.solve(), separate, acceleration)
    }

    /// Is enough known of the past for a step without a solution in its middle? Where the flow leaves a smooth bottom such steps scatter the load.
    pub(super) fn has_past(&self) -> bool {
        let leaves_at_end = self.face.length() >= self.face.whole_length();
        self.past.len() + 1 == INSTANTS && (self.underside.is_none() || leaves_at_end)
    }

    /// Moved over `dt` by Adams and Bashforth's rule; `now` is the flow and `rate` the downward acceleration at this instant.
    pub(super) fn extrapolated(&self, now: &Solution, rate: f64, dt: f64) -> EntryFlow {
        let ago = [self.past[0].ago, self.past[1].ago];
        let weights = weights(dt, ago);
        let ahead = Ahead { dt, weights, ago: ago[0], drift: self.drift, gravity: self.gravity };
        let motion = self.motion(rate, 0.0);
        let sum = |of: &dyn Fn(&Past) -> f64| {
            weights[0] * of(&motion)
                + self.past.iter().zip(&weights[1..]).map(|(past, weight)| weight * of(past)).sum::<f64>()
        };
        let face = self.face.at_draught(self.face.draught + sum(&|past| past.speeds[1]));
        let underside = self.underside.as_ref().map(|before| {
            let mut surface = before.extrapolated(&now.below, &ahead);
            let last = before.z.len() - 1; // moves with the body
            (surface.z[last], surface.phi[last]) = (face.edge(), before.phi[last] + now.below.rate[last] * dt);
            surface
        });
        EntryFlow {
            surface: self.surface.extrapolated(&now.above, &ahead),
            face,
            underside,
            draught: self.draught + sum(&|past| past.speeds[0]),
            speed: self.speed + sum(&|past| past.acceleration),
            past: Vec::new(),
            ..*self
        }
    }

    /// Set the body to a draught [m] and a downward speed [m/s].
    pub(super) fn place(&mut self, draught: f64, speed: f64) {
        let of_keel = self.face.keel_speed(self.half_width()) * (draught - self.draught);
        self.face = self.face.at_draught(self.face.draught + of_keel);
        (self.draught, self.speed) = (draught, speed);
    }

    fn motion(&self, acceleration: f64, ago: f64) -> Past {
        Past { ago, speeds: [self.speed, self.keel_speed()], acceleration }
    }

    /// With what it comes from after `dt`: a flow whose nodes are those of this one.
    pub(super) fn after(mut self, before: &EntryFlow, flow: &Solution, rate: f64, dt: f64) -> EntryFlow {
        let older = before.past.iter().map(|past| Past { ago: past.ago + dt, ..*past });
        self.past = std::iter::once(before.motion(rate, dt)).chain(older).take(INSTANTS - 1).collect();
        self.surface.store_past(&before.surface, &flow.above.velocity);
        if let (Some(surface), Some(before)) = (&mut self.underside, &before.underside) {
            surface.store_past(before, &flow.below.velocity);
        }
        self
    }

    /// Drop the past where the flow changes suddenly.
    pub(super) fn clear_past(&mut self) {
        self.past.clear();
        self.surface.past.clear();
        if let Some(underside) = &mut self.underside {
            underside.past.clear();
        }
    }

    /// Moved over `dt` with a downward speed, an acceleration and the flow `at` some instant.
    pub(super) fn moved(&self, speed: f64, at: &Solution, acceleration: f64, dt: f64) -> EntryFlow {
        let face = self.face.at_draught(self.face.draught + speed * self.face.keel_speed(self.half_width()) * dt);
        let mut underside = self.underside.as_ref().map(|surface| at.below.moves(surface, dt));
        if let Some(at_chine) = underside.as_mut().and_then(|surface| surface.z.last_mut()) {
            *at_chine = face.edge();
        }
        EntryFlow {
            surface: at.above.moves(&self.surface, dt),
            face,
            underside,
            draught: self.draught + speed * dt,
            speed: self.speed + acceleration * dt,
            past: Vec::new(),
            ..*self
        }
    }

    /// With the jet cut and nodes redistributed.
    pub(super) fn redistributed(self) -> EntryFlow {
        let lower = self.lower_side();
        let surface = self.surface.redistributed(lower);
        let (cut, size) = (lower.nearest(surface.end()).foot, lower.finest(surface.end()));
        let underside = self.underside.as_ref().map(|underside| underside.redistributed_below(cut, size, self.sizes));
        EntryFlow { surface, underside, ..self }
    }

    /// Is a step [s] so short that the surface is breaking up?
    pub(super) fn is_too_short(&self, dt: f64) -> bool {
        dt * self.keel_speed().abs() < LEAST_GROWTH * self.face.draught
    }

    /// Longest step of the midpoint rule [s].
    pub(super) fn stable_dt(&self, now: &Solution) -> f64 {
        self.longest_dt(now, COURANT)
    }

    /// Longest step of Adams and Bashforth's rule [s].
    pub(super) fn extrapolated_dt(&self, now: &Solution) -> f64 {
        self.longest_dt(now, self.sizes.courant_at(self.face.place(0.0).tangent.arg()))
    }

    /// Longest step in which nodes move by `courant` elements at most [s].
    fn longest_dt(&self, now: &Solution, courant: f64) -> f64 {
        let crossing = |z: &[c64], v: &[c64]| {
            let speed = 0.5 * (v[0].norm() + v[1].norm());
            courant * (z[1] - z[0]).norm() / speed.max(f64::MIN_POSITIVE)
        };
        let surfaces = [(Some(&self.surface), &now.above), (self.underside.as_ref(), &now.below)];
        let pairs = surfaces.into_iter().filter_map(|(surface, flow)| Some((surface?, flow)));
        let times = pairs.flat_map(|(surface, flow)| {
            surface.z.windows(2).zip(flow.velocity.windows(2)).map(|(z, v)| crossing(z, v))
        });
        let longest = times.fold(DRAUGHT_GROWTH * self.face.draught / self.keel_speed().abs(), f64::min);
        self.chine_dt(now).clamp(LEAST_AT_CHINE * longest, longest)
    }

    /// Longest step next to a wet chine [s]: the potential of its node decays to the one with which the water leaves the chine along the face
    /// (EN24), at a rate of 2.2 times the velocity over the length of the face's last element; both rules amplify what falls by more than 2 per
    /// step.
    fn chine_dt(&self, now: &Solution) -> f64 {
        let body = c64::new(0.0, -self.keel_speed());
        match now.below.velocity.last() {
            Some(velocity) => AT_CHINE * (now.along[0] - now.along[1]) / (velocity - body).norm(),
            None => f64::INFINITY,
        }
    }
}

impl FreeSurface {
    /// EN22: nodes moved by Adams and Bashforth's rule, and the potential that they have then.
    fn extrapolated(&self, now: &SurfaceFlow, ahead: &Ahead) -> FreeSurface {
        let Ahead { dt, weights, ago, drift, gravity } = *ahead;
        let [before, earlier] = [&self.past[0], &self.past[1]];
        let moved = |k: usize| {
            let v = now.velocity[k];
            let way = v * weights[0] + before[k] * weights[1] + earlier[k] * weights[2];
            let a = (v - before[k]) / ago;
            let of_way = ((v + drift) * (way - v * dt).conj()).re + dt.powi(3) / 6.0 * a.norm_sqr();
            let of_height = gravity * dt * (way.im / 2.0 - dt * dt / 12.0 * a.im);
            (self.z[k] + way, self.phi[k] + now.rate[k] * dt + of_way - of_height)
        };
        let (z, phi) = (0..self.z.len()).map(moved).unzip();
        FreeSurface { z, phi, past: Vec::new() }
    }

    /// Keep the `velocity` at the nodes of this surface when they were those of `before`, and what that kept.
    fn store_past(&mut self, before: &FreeSurface, velocity: &Vec<c64>) {
        self.past = std::iter::once(velocity).chain(&before.past).take(INSTANTS - 1).cloned().collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola is integrated exactly.
    #[test]
    fn uneven_steps() {
        let value = |t: f64| 1.0 - 3.0 * t + 2.0 * t * t;
        let (dt, ago) = (0.7, [0.4, 1.3]);
        let weights = weights(dt, ago);
        let sum = weights[0] * value(0.0) + weights[1] * value(-ago[0]) + weights[2] * value(-ago[1]);
        assert!((sum - (dt - 1.5 * dt * dt + 2.0 / 3.0 * dt.powi(3))).abs() < 1e-14, "{sum}");
    }

    /// The potential of a node at an even acceleration, under gravity and in axes that move, is ∫ (½ v² − g y) dt.
    #[test]
    fn the_potential_follows_the_way_of_its_node() {
        let (dt, ago, drift, gravity) = (0.3, [0.2, 0.5], 0.7, 9.81);
        let (first, acceleration, z) = (c64::new(1.2, -0.4), c64::new(-2.0, 3.0), c64::new(0.1, 0.6));
        let velocity = |t: f64| first + acceleration * t; // of the water at rest far away
        let in_axes = |t: f64| vec![velocity(t) - drift];
        let surface = FreeSurface { z: vec![z], phi: vec![5.0], past: ago.map(|ago| in_axes(-ago)).into() };
        let now = SurfaceFlow { velocity: in_axes(0.0), rate: vec![0.5 * first.norm_sqr() - gravity * z.im] };
        let ahead = Ahead { dt, weights: weights(dt, ago), ago: ago[0], drift, gravity };
        let moved = surface.extrapolated(&now, &ahead);
        let rate = |t: f64| 0.5 * velocity(t).norm_sqr() - gravity * (z + first * t + 0.5 * acceleration * t * t).im;
        let way = dt / 6.0 * (rate(0.0) + 4.0 * rate(0.5 * dt) + rate(dt)); // Simpson: exact of a parabola
        assert!((moved.phi[0] - (5.0 + way)).abs() < 1e-14, "{} for {}", moved.phi[0], 5.0 + way);
        let end = z + (first - drift) * dt + 0.5 * acceleration * dt * dt;
        assert!((moved.z[0] - end).norm() < 1e-14, "{} for {end}", moved.z[0]);
    }
}
