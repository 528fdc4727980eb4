//! Fully nonlinear potential flow about a wedge with two deadrises that moves vertically, by boundary elements (THEORY EN34, EN35).
//!
//! Each side is one of a symmetric flow, x outwards: surface, cut of the jet and separation are its own. One matrix joins them.

mod contour;
mod entry;
mod solution;

pub use entry::{RolledEntry, RolledInstant};
pub use solution::RolledLoad;
use solution::RolledSolution;

use super::elements::Sizes;
use super::entry::BEGIN;
use super::face::Face;
use super::lower_side::LowerSide;
use super::solution::Solution;
use super::state::EntryFlow;
use super::surface::FreeSurface;
use super::{FAR, FlowEnded};
use crate::entry_theory::asymmetric_similarity::AsymmetricFlow;
use crate::entry_theory::model::{BOUNDARY_ELEMENT_DEADRISES, EntryModel, OutOfRange};

/// Size of the elements beside the jet over that of a symmetric flow, on flat and on steep faces: φ_t in the wedge's axes changes faster
/// than that at rest, most on steep faces.
const SIZES: [f64; 2] = [0.8, 0.6];
/// Deadrises between which it changes [deg].
const FLAT_AND_STEEP: [f64; 2] = [20.0, 35.0];

/// The water about a wedge with two deadrises that moves downwards.
#[derive(Clone, Debug)]
pub struct RolledFlow {
    /// Right and left, x outwards.
    sides: [EntryFlow; 2],
}

impl RolledFlow {
    /// A wedge whose faces, left and right, have the `deadrises` [rad] and `lengths` [m] from the apex to the chine. The apex has come to `draught`
    /// [m] at the constant downward `speed` [m/s] without gravity; from now on there is `gravity` [m/s²] in the water. The surface is that of the
    /// similar flow.
    ///
    /// # Errors
    /// Deadrises outside [`BOUNDARY_ELEMENT_DEADRISES`] or of which there is no similar flow; a draught or a speed that is not above zero; a
    /// jet's tip past a chine.
    pub fn new(
        deadrises: [f64; 2],
        lengths: [f64; 2],
        draught: f64,
        speed: f64,
        gravity: f64,
    ) -> Result<RolledFlow, OutOfRange> {
        let refused = |what: String, range: String| OutOfRange { what, range, next: EntryModel::Wcsph };
        let [least, most] = BOUNDARY_ELEMENT_DEADRISES;
        if let Some(deadrise) =
            deadrises.iter().map(|d| d.to_degrees()).find(|d| !(least - 1e-6..=most + 1e-6).contains(d))
        {
            return Err(refused(
                format!("a face of {deadrise:.2} degrees"),
                format!("faces of {least} to {most} degrees"),
            ));
        }
        if !(draught > 0.0 && draught.is_finite() && speed > 0.0 && speed.is_finite()) {
            let range = "boundary elements need a draught and a downward speed above zero";
            return Err(refused(format!("{draught} m and {speed} m/s"), range.into()));
        }
        let similar = AsymmetricFlow::solve(deadrises[0], deadrises[1])
            .map_err(|none| refused(none.to_string(), "boundary elements start from the similarity solution".into()))?;
        // as far as if it began later: what is far from a small wedge is near to it once its chines are wet
        let wet = (0..2).map(|i| lengths[i] / similar.faces()[i].peak).fold(0.0, f64::max);
        let far = FAR * (BEGIN * wet / draught).max(1.0) / (0.5 * (deadrises[0] + deadrises[1])).tan();
        let side = |i: usize| {
            let sizes = Sizes { jet: element_size(deadrises[i]), ..Sizes::ROLLED };
            let face = Face::straight(deadrises[i], lengths[i]).at_draught(draught);
            let surface = FreeSurface::through(&similar.faces()[i].surface, draught, speed, far);
            let surface = surface.redistributed(LowerSide { face: &face, underside: None, sizes });
            EntryFlow { surface, face, underside: None, draught, speed, gravity, sizes, past: Vec::new() }
        };
        let sides = [side(1), side(0)];
        if let Some(side) =
            sides.iter().find(|side| side.face.nearest(side.surface.end(), true).along > side.face.length())
        {
            let what = format!("{} m of face at a draught of {draught} m", side.face.length());
            return Err(refused(what, "boundary elements begin with dry chines".into()));
        }
        Ok(RolledFlow { sides })
    }

    /// The same with all velocities in proportion to a downward speed [m/s], and under a gravity [m/s²].
    fn at_speed(self, speed: f64, gravity: f64) -> RolledFlow {
        RolledFlow { sides: self.sides.map(|side| EntryFlow { gravity, ..side.at_speed(speed) }) }
    }

    /// Draught of the apex below still water [m].
    pub fn draught(&self) -> f64 {
        self.sides[0].draught
    }

    /// Downward speed [m/s].
    pub fn speed(&self) -> f64 {
        self.sides[0].speed
    }

    /// True where the flow has left the chine, left and right.
    pub fn chines_wet(&self) -> [bool; 2] {
        [self.sides[1].chines_wet(), self.sides[0].chines_wet()]
    }

    /// The free surfaces, left and right, from far away to the jet's cut and from there to a wet chine, [x, y] [m], x to the right,
    /// shape (n, 2).
    pub fn surfaces(&self) -> [Vec<[f64; 2]>; 2] {
        let left = self.sides[1].surface().into_iter().map(|[x, y]| [-x, y]).collect();
        [left, self.sides[0].surface()]
    }

    /// Load of the water now.
    pub fn load(&self) -> RolledLoad {
        solution::solve(&self.sides).load
    }

    /// One step. `acceleration` gives the downward acceleration [m/s²] under a load. Returns the step [s] and the load at
    /// its start.
    ///
    /// # Errors
    /// A wedge that has stopped, or a flow that is no longer finite; the state before the step is kept.
    pub fn step(&mut self, acceleration: impl Fn(&RolledLoad) -> f64) -> Result<(f64, RolledLoad), FlowEnded> {
        let mut start = solution::solve(&self.sides);
        if self.separate(&start) {
            self.sides.iter_mut().for_each(EntryFlow::forget_past);
            start = solution::solve(&self.sides);
        }
        let ended = |speed: f64| FlowEnded { draught: self.draught(), speed };
        let rate = acceleration(&start.load);
        let longest = |of: &dyn Fn(&EntryFlow, &Solution) -> f64| {
            self.sides.iter().zip(&start.sides).map(|(side, now)| of(side, now)).fold(f64::INFINITY, f64::min)
        };
        let (dt, end) = if self.sides.iter().all(EntryFlow::has_past) {
            let dt = longest(&EntryFlow::extrapolated_dt);
            (dt, [0, 1].map(|i| self.sides[i].extrapolated(&start.sides[i], rate, dt)))
        } else {
            let dt = longest(&EntryFlow::stable_dt);
            let half = self.moved(self.speed(), &start, rate, 0.5 * dt);
            if !half.iter().all(EntryFlow::is_finite) {
                return Err(ended(half[0].speed));
            }
            let middle = solution::solve(&half);
            (dt, self.moved(half[0].speed, &middle, acceleration(&middle.load), dt))
        };
        let is_finite = end.iter().all(EntryFlow::is_finite) && start.load.force[1].is_finite();
        if !(is_finite && end[0].speed > 0.0) || self.sides[0].is_too_short(dt) {
            return Err(ended(end[0].speed));
        }
        let [right, left] = end;
        let after = |i: usize, end: EntryFlow| end.after(&self.sides[i], &start.sides[i], rate, dt).redistributed();
        self.sides = [after(0, right), after(1, left)];
        Ok((dt, start.load))
    }

    /// EN24 on each side: true where the flow has left a chine.
    fn separate(&mut self, now: &RolledSolution) -> bool {
        let mut left = false;
        for (side, now) in self.sides.iter_mut().zip(&now.sides) {
            if let Some(underside) = side.separated(now) {
                side.underside = Some(underside);
                left = true;
            }
        }
        left
    }

    /// Both sides moved over `dt` with a downward speed, an acceleration and the flow `at` some instant.
    fn moved(&self, speed: f64, at: &RolledSolution, rate: f64, dt: f64) -> [EntryFlow; 2] {
        [0, 1].map(|i| self.sides[i].moved(speed, &at.sides[i], rate, dt))
    }
}

/// Size of the elements beside the jet of a face over that of a symmetric flow [-].
fn element_size(deadrise: f64) -> f64 {
    let ([flat, steep], [of_flat, of_steep]) = (FLAT_AND_STEEP, SIZES);
    let share = ((deadrise.to_degrees() - flat) / (steep - flat)).clamp(0.0, 1.0);
    of_flat + share * (of_steep - of_flat)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::entry_theory::section::Section;

    fn rolled(deadrises: [f64; 2], lengths: [f64; 2], gravity: f64) -> RolledFlow {
        rolled_from(0.05, deadrises, lengths, gravity)
    }

    fn rolled_from(draught: f64, deadrises: [f64; 2], lengths: [f64; 2], gravity: f64) -> RolledFlow {
        RolledFlow::new(deadrises.map(f64::to_radians), lengths, draught, 2.0, gravity).expect("in range")
    }

    /// Means of F_x, F_y and M over those of the similar flow, and of the largest pressures, from 1.06 of the first draught on.
    fn errors(deadrises: [f64; 2], until: f64) -> [f64; 5] {
        let exact = AsymmetricFlow::solve(deadrises[0].to_radians(), deadrises[1].to_radians()).expect("a solution");
        let mut flow = rolled(deadrises, [100.0; 2], 0.0);
        let (mut sums, mut count) = ([0.0; 5], 0.0);
        while flow.draught() < until * 0.05 {
            let (h, (_, load)) = (flow.draught(), flow.step(|_| 0.0).expect("a step"));
            if h > 1.06 * 0.05 {
                let cp = |i: usize| load.pressure[i].iter().map(|p| 0.5 * p[1]).fold(0.0, f64::max);
                let [x, y] = load.force.map(|f| f / (4.0 * h));
                let of = [x / exact.force[0], y / exact.force[1], load.moment / (4.0 * h * h) / exact.moment];
                let all = [of[0], of[1], of[2], cp(0) / exact.left.cp_max, cp(1) / exact.right.cp_max];
                sums = std::array::from_fn(|k| sums[k] + all[k]);
                count += 1.0;
            }
        }
        sums.map(|sum| sum / count - 1.0)
    }

    #[test]
    fn at_constant_speed_it_is_the_similar_flow() {
        for deadrises in [[20.0, 40.0], [55.0, 35.0], [24.0, 51.0], [37.0, 41.0]] {
            let errors = errors(deadrises, 1.2);
            println!("{deadrises:?}: F_x, F_y, M, cp {errors:+.4?}");
            assert!(errors.iter().all(|e| e.abs() < 0.02), "{deadrises:?}: {errors:+.4?}");
        }
    }

    /// Equal faces have the force and the added mass of the symmetric flow, dry and wet, from a small draught on too: with a surface as far as
    /// 240 of such draughts alone the force was 18 % too large.
    #[test]
    fn equal_faces_are_those_of_a_symmetric_wedge() {
        let section = Section::wedge(30.0, 1.0).expect("a section");
        let mut symmetric = EntryFlow::new(&section, 0.05, 2.0, 9.81).expect("in range");
        let mut table = Vec::new();
        while symmetric.draught() < 0.42 {
            let h = symmetric.draught();
            let load = symmetric.step(|_| 0.0).expect("a step").1;
            table.push([h, load.force, load.added_mass]);
        }
        for first in [0.05, 0.008] {
            let mut flow = rolled_from(first, [30.0; 2], [0.5 / f64::cos(30f64.to_radians()); 2], 9.81);
            let mut compared = [0, 0];
            while flow.draught() < 0.4 {
                let (h, (_, load)) = (flow.draught(), flow.step(|_| 0.0).expect("a step"));
                let k = table.partition_point(|row| row[0] <= h).max(1);
                let share = (h - table[k - 1][0]) / (table[k][0] - table[k - 1][0]);
                let at = |of: usize| table[k - 1][of] + share * (table[k][of] - table[k - 1][of]);
                assert!(
                    load.force[0].abs() < 1e-6 * load.force[1] && load.moment.abs() < 1e-6 * load.force[1],
                    "{h} m"
                );
                let [force, mass] = [load.force[1] / at(1) - 1.0, load.added_mass[1] / at(2) - 1.0];
                let wet = flow.chines_wet()[0];
                // the instant of separation is known to a step
                if wet && h < 0.25 || h < 0.053 {
                    continue;
                }
                assert!(force.abs() < 0.02 && mass.abs() < 0.02, "{h} m, wet {wet}: {force:+.4} {mass:+.4}");
                compared[usize::from(wet)] += 1;
            }
            assert!(compared.iter().all(|count| *count > 10), "{compared:?}");
        }
    }

    /// What the body does as work is energy of the water, with dry and with wet chines.
    #[test]
    fn the_bodys_work_is_energy_of_the_water() {
        for (deadrises, gravity) in [([25.0, 40.0], 0.0), ([35.0, 45.0], 9.81)] {
            let mut flow = rolled(deadrises, [0.5; 2], gravity);
            let mut sums = [[0.0; 2]; 3];
            while flow.draught() < 0.4 {
                let energy = |at: &RolledSolution| at.sides.iter().map(|s| 0.5 * s.energy(gravity)).sum::<f64>();
                flow.separate(&solution::solve(&flow.sides));
                let before = solution::solve(&flow.sides);
                let dt = (0..2).map(|i| flow.sides[i].stable_dt(&before.sides[i])).fold(f64::INFINITY, f64::min);
                let middle = solution::solve(&flow.moved(2.0, &before, 0.0, 0.5 * dt));
                let end = flow.moved(2.0, &middle, 0.0, dt);
                let wet = flow.chines_wet().into_iter().filter(|wet| *wet).count();
                sums[wet][0] += middle.load.force[1] * 2.0 * dt;
                sums[wet][1] += energy(&solution::solve(&end)) - energy(&before);
                flow.sides = end.map(EntryFlow::redistributed);
            }
            for (wet, [work, energy]) in sums.into_iter().enumerate() {
                let error = energy / work - 1.0;
                println!("{deadrises:?}, {wet} wet chines: energy {:+.2} % off", 100.0 * error);
                assert!(error.abs() < 0.03, "{deadrises:?}, {wet} wet chines: energy {:+.2} % off", 100.0 * error);
            }
        }
    }

    /// A free wedge: its momentum is that of weight and force, and its mirror image moves alike.
    #[test]
    fn a_free_wedge_and_its_mirror_image_slow_down_alike() {
        let (mass, gravity, density) = (100.0, 9.81, 1000.0);
        let rate =
            |load: &RolledLoad| (mass * gravity - density * load.force[1]) / (mass + density * load.added_mass[1]);
        let fall = |deadrises: [f64; 2]| {
            let mut flow = rolled(deadrises, [0.5; 2], gravity);
            let (mut time, mut last) = (0.0, [0.0; 2]);
            while flow.draught() < 0.2 {
                let (dt, load) = flow.step(rate).expect("a step");
                let r = rate(&load);
                last = [load.moment + load.added_moment * r, load.force[0] + load.added_mass[0] * r];
                time += dt;
            }
            [time, flow.speed(), last[0], last[1]]
        };
        let (own, mirrored) = (fall([25.0, 40.0]), fall([40.0, 25.0]));
        for (k, sign) in [(0, 1.0), (1, 1.0), (2, -1.0), (3, -1.0)] {
            assert!((own[k] - sign * mirrored[k]).abs() < 1e-5 * own[k].abs(), "{k}: {} {}", own[k], mirrored[k]);
        }
        assert!(own[1] < 1.7 && own[1] > 0.5, "{} m/s", own[1]);
    }

    #[test]
    fn what_is_outside_the_range_is_refused() {
        let refused = |deadrises: [f64; 2], length: f64, draught: f64| {
            let deadrises = deadrises.map(f64::to_radians);
            RolledFlow::new(deadrises, [length; 2], draught, 2.0, 0.0).expect_err("out of range").to_string()
        };
        assert!(refused([8.0, 30.0], 1.0, 0.05).contains("10 to 60 degrees"));
        assert!(refused([20.0, 40.0], 1.0, -0.05).contains("above zero"));
        assert!(refused([20.0, 40.0], 0.1, 0.05).contains("dry chines"));
    }
}
