//! Water that runs into an aeroplane afloat (THEORY EN58).

use super::afloat::{Volume, Waterline};

/// Largest change of the water inside in a step over the volume of the fuselage [-].
const STEP: f64 = 2e-3;
/// Most steps.
const MOST_STEPS: usize = 20_000;

/// An opening of the fuselage: an exit, or the place of a panel that gave way.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// A word that names it.
    pub name: String,
    /// Its sill: from the nose, over the body axis [m].
    pub sill: [f64; 2],
    /// Area that water runs through [m²]; 0 for a closed exit.
    pub area: f64,
    /// Discharge coefficient [-].
    pub discharge: f64,
}

/// A body afloat.
#[derive(Clone, Debug)]
pub struct Afloat<'a> {
    /// Its volume.
    pub volume: &'a Volume,
    /// Mass over the density of the water [m³].
    pub mass: f64,
    /// Centre of mass: from the nose, over the body axis [m].
    pub centre: [f64; 2],
    /// Acceleration of gravity [m/s²].
    pub gravity: f64,
    /// Openings.
    pub openings: &'a [Opening],
}

/// Afloat at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatingState {
    /// Time since it lay still [s].
    pub time: f64,
    /// Water inside [m³].
    pub inside: f64,
    /// Waterline outside.
    pub outer: Waterline,
    /// Waterline of the water inside.
    pub inner: Waterline,
}

/// How it floated.
#[derive(Clone, Debug, PartialEq)]
pub struct Flooding {
    /// States in time.
    pub states: Vec<FloatingState>,
    /// When the water outside reached each sill [s]; `None`: it did not.
    pub reached: Vec<Option<f64>>,
    /// When it sank or lost its trim [s]; `None`: it floated to the end.
    pub lost: Option<f64>,
}

impl Afloat<'_> {
    fn state(&self, time: f64, inside: f64, near: f64) -> Option<FloatingState> {
        let [outer, inner] = self.volume.afloat(self.mass, self.centre, inside, near)?;
        Some(FloatingState { time, inside, outer, inner })
    }

    /// EN58: volume that runs in per time [m³/s].
    fn inflow(&self, now: &FloatingState) -> f64 {
        let through = |opening: &Opening| {
            let over = |plane: &Waterline| (plane.at(opening.sill[0]) - opening.sill[1]).max(0.0);
            let inner = if now.inside > 0.0 { over(&now.inner) } else { 0.0 };
            // heads are measured upright
            let head = (over(&now.outer) - inner) / now.outer.slope.hypot(1.0);
            opening.discharge * opening.area * (2.0 * self.gravity * head.abs()).sqrt() * head.signum()
        };
        self.openings.iter().filter(|opening| opening.area > 0.0).map(through).sum()
    }

    /// From rest up to an end of time [s], by Heun's method; `None` where it does not float at all.
    pub fn solve(&self, end: f64) -> Option<Flooding> {
        let whole = self.volume.whole();
        let mut now = self.state(0.0, 0.0, 0.0)?;
        let height = |opening: &Opening, state: &FloatingState| state.outer.at(opening.sill[0]) - opening.sill[1];
        let mut reached: Vec<Option<f64>> =
            self.openings.iter().map(|o| (height(o, &now) >= 0.0).then_some(0.0)).collect();
        let (mut states, mut lost) = (vec![now], None);
        for _ in 0..MOST_STEPS {
            let flow = self.inflow(&now);
            if now.time >= end || flow.abs() * (end - now.time) < 1e-9 * whole {
                break;
            }
            let dt = (STEP * whole / flow.abs()).min(end - now.time).min(end / 100.0);
            let ahead = |flow: f64| self.state(now.time + dt, (now.inside + dt * flow).max(0.0), now.outer.slope);
            let next = ahead(flow).and_then(|first| ahead(0.5 * (flow + self.inflow(&first))));
            let Some(next) = next else {
                lost = Some(now.time);
                break;
            };
            for (reached, opening) in reached.iter_mut().zip(self.openings).filter(|(reached, _)| reached.is_none()) {
                let (before, after) = (height(opening, &now), height(opening, &next));
                *reached = (after >= 0.0).then(|| now.time + dt * before / (before - after));
            }
            now = next;
            states.push(now);
        }
        Some(Flooding { states, reached, lost })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Torricelli: in a box the level outside less that inside stays the draught of its mass, so that C A √(2 g T) runs in until the sill is wet.
    #[test]
    fn a_box_floods_as_torricelli_says() {
        let barge = Volume::new([0.0, 20.0], |_| [-1.0, 2.0], |_, _| 2.0);
        let hole = Opening { name: "hole".into(), sill: [10.0, -1.0], area: 0.05, discharge: 0.6 };
        let exit = Opening { name: "exit".into(), sill: [10.0, 1.0], area: 0.0, discharge: 0.6 };
        let openings = [hole, exit];
        let afloat = Afloat { volume: &barge, mass: 80.0, centre: [10.0, -0.6], gravity: 9.81, openings: &openings };
        let flooding = afloat.solve(3600.0).expect("it floats");
        let exact = 80.0 * 1.0 / (0.6 * 0.05 * (2.0_f64 * 9.81 * 1.0).sqrt());
        let reached = flooding.reached[1].expect("the sill is reached");
        println!("{reached} s, exact {exact} s");
        assert!((reached / exact - 1.0).abs() < 2e-3, "{reached}, exact {exact}");
        let sinks = 160.0 / (0.6 * 0.05 * (2.0_f64 * 9.81).sqrt());
        // just before its deck is under water it loses its trim
        assert!((0.95..=1.001).contains(&(flooding.lost.expect("it sinks") / sinks)), "{:?}", flooding.lost);
        assert_eq!(flooding.reached[0], Some(0.0));
    }

    /// A closed barge floats as it did.
    #[test]
    fn without_water_inside_nothing_changes() {
        let barge = Volume::new([0.0, 20.0], |_| [-1.0, 2.0], |_, _| 2.0);
        let dry = [Opening { name: "exit".into(), sill: [10.0, 1.0], area: 1.0, discharge: 0.6 }];
        let afloat = Afloat { volume: &barge, mass: 80.0, centre: [10.0, 0.0], gravity: 9.81, openings: &dry };
        let flooding = afloat.solve(600.0).expect("it floats");
        assert!(flooding.reached[0].is_none() && flooding.lost.is_none() && flooding.states.len() == 1);
    }
}
