//! What a plane of water sees of a landing: the section's way into it (THEORY EN63).

use super::landing::{FlightMoment, Landing};
use super::strip::{Bottom, KeelPoint, along};

/// Bisections of an interval in a search for a place or a time.
const BISECTIONS: usize = 60;

/// EN63: the keel in a plane of water, from its contact with the surface to where it leaves the water, or the fuselage the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneHistory {
    /// Rows, the first at the contact.
    pub rows: Vec<PlaneMoment>,
}

/// The keel in a plane of water at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneMoment {
    /// Time since the landing's first touch [s].
    pub time: f64,
    /// Place of the fuselage that is in the plane, from the nose [m].
    pub x: f64,
    /// Draught h [m], its rate ḣ [m/s] and its second derivative [m/s²].
    pub draught: f64,
    /// ḣ [m/s].
    pub speed: f64,
    /// d²h/dt² [m/s²].
    pub rate: f64,
}

impl PlaneHistory {
    /// Is a time [s] between its first row and its last?
    pub fn covers(&self, time: f64) -> bool {
        (self.rows[0].time..=self.rows[self.rows.len() - 1].time).contains(&time)
    }

    /// Place of the fuselage that is in the plane at a time [s], from the nose [m]; linear between rows.
    pub fn place(&self, time: f64) -> f64 {
        let rows = &self.rows;
        let after = rows.partition_point(|row| row.time <= time).clamp(1, rows.len() - 1);
        let (a, b) = (rows[after - 1], rows[after]);
        a.x + (time - a.time) / (b.time - a.time) * (b.x - a.x)
    }
}

impl Landing<'_> {
    /// EN63: of the plane of water that the keel at `x` [m from the nose] is in at a time [s], to the next moment of this landing's motion.
    /// `None` where the keel is dry there, and where the plane's first wet place is an end of the fuselage.
    pub fn plane_history(&self, moments: &[FlightMoment], time: f64, x: f64) -> Option<PlaneHistory> {
        let after = (1.0 - 1e-9) * time;
        let at = moments.partition_point(|now| now.time < after).min(moments.len().checked_sub(1)?);
        let of = |k: usize, x: f64| self.keel_at(&moments[k], x);
        let abscissa = |k: usize, x: f64| moments[k].attitude.place[0] + of(k, x).lever_arm[0];
        let wet = |row: &PlaneMoment| row.draught > 0.0;
        let now = Some(self.plane_moment(&moments[at], x)).filter(wet)?;
        // how far the water has moved between two moments, by its mean velocity
        let moved = |from: usize, to: usize, place: f64| {
            let dt = moments[to].time - moments[from].time;
            let velocity = |k: usize, place: f64| self.swell.later(moments[k].time).water(place).velocity[0];
            let first = velocity(from, place);
            place + 0.5 * dt * (first + velocity(to, place + dt * first))
        };
        let row = |k: usize, place: f64| {
            let [mut from, mut to] = self.hull.fuselage().ends();
            if !(abscissa(k, to)..=abscissa(k, from)).contains(&place) {
                return None;
            }
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (from + to);
                if abscissa(k, middle) > place { from = middle } else { to = middle }
            }
            Some(self.plane_moment(&moments[k], 0.5 * (from + to)))
        };
        let mut rows = vec![now];
        let mut place = abscissa(at, x);
        for k in (0..at).rev() {
            place = moved(k + 1, k, place);
            let earlier = row(k, place)?;
            if wet(&earlier) {
                rows.insert(0, earlier);
            } else {
                rows.insert(0, contact(&earlier, &rows[0]));
                break;
            }
        }
        let mut place = abscissa(at, x);
        for k in at + 1..moments.len() {
            place = moved(k - 1, k, place);
            match row(k, place).filter(wet) {
                Some(later) => rows.push(later),
                None => break,
            }
        }
        (rows.len() > 1).then_some(PlaneHistory { rows })
    }

    /// The keel of the fuselage at a moment.
    fn keel_at(&self, now: &FlightMoment, x: f64) -> KeelPoint {
        let (centre, bending) = (self.aeroplane.centre, self.aeroplane.bending.as_ref());
        KeelPoint::new(
            &Bottom { hull: self.hull, centre, bending, swell: self.swell.later(now.time) },
            &now.attitude,
            x,
        )
    }

    fn plane_moment(&self, now: &FlightMoment, x: f64) -> PlaneMoment {
        let keel = self.keel_at(now, x);
        let rate = keel.bending - along(&keel.lever(), &now.acceleration);
        PlaneMoment { time: now.time, x, draught: keel.draught, speed: keel.speed, rate }
    }
}

/// Between a dry moment and a wet one: where the draught, cubic in time by its rates, is none.
fn contact(dry: &PlaneMoment, wet: &PlaneMoment) -> PlaneMoment {
    let dt = wet.time - dry.time;
    let rise = (wet.draught - dry.draught) / dt;
    let bends = [3.0 * rise - 2.0 * dry.speed - wet.speed, dry.speed + wet.speed - 2.0 * rise];
    let draught = |s: f64| dry.draught + dt * s * (dry.speed + s * (bends[0] + s * bends[1]));
    let [mut from, mut to] = [0.0, 1.0];
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (from + to);
        if draught(middle) > 0.0 { to = middle } else { from = middle }
    }
    let mix = |a: f64, b: f64| a + to * (b - a);
    PlaneMoment {
        time: mix(dry.time, wet.time),
        x: mix(dry.x, wet.x),
        draught: 0.0,
        speed: dry.speed + to * (2.0 * bends[0] + 3.0 * to * bends[1]),
        rate: mix(dry.rate, wet.rate),
    }
}
