//! Fully nonlinear potential flow about a wedge with two deadrises that moves vertically, by boundary elements (THEORY EN34, EN35).
//!
//! Each side is one of a symmetric flow, x outwards: surface, cut of the jet and separation are its own. One matrix joins them.

mod contour;
mod solution;

pub use solution::RolledLoad;

use super::face::Face;
use super::lower_side::LowerSide;
use super::state::EntryFlow;
use super::surface::FreeSurface;
use super::{FAR, FlowEnded};
use crate::entry_theory::asymmetric_similarity::AsymmetricFlow;
use crate::entry_theory::model::{BOUNDARY_ELEMENT_DEADRISES, EntryModel, OutOfRange};

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
        if let Some(deadrise) = deadrises.iter().map(|d| d.to_degrees()).find(|d| !(least - 1e-6..=most + 1e-6).contains(d)) {
            return Err(refused(format!("a face of {deadrise:.2} degrees"), format!("faces of {least} to {most} degrees")));
        }
        if !(draught > 0.0 && draught.is_finite() && speed > 0.0 && speed.is_finite()) {
            let range = "boundary elements need a draught and a downward speed above zero";
            return Err(refused(format!("{draught} m and {speed} m/s"), range.into()));
        }
        let similar = AsymmetricFlow::solve(deadrises[0], deadrises[1]).map_err(|none| {
            refused(none.to_string(), "boundary elements start from the similarity solution".into())
        })?;
        let far = FAR / (0.5 * (deadrises[0] + deadrises[1])).tan();
        let side = |i: usize| {
            let face = Face::straight(deadrises[i], lengths[i]).at_draught(draught);
            let surface = FreeSurface::through(&similar.faces()[i].surface, draught, speed, far);
            let surface = surface.redistributed(LowerSide { face: &face, underside: None });
            EntryFlow { surface, face, underside: None, draught, speed, gravity }
        };
        let sides = [side(1), side(0)];
        if let Some(side) = sides.iter().find(|side| side.face.nearest(side.surface.end(), true).along > side.face.length()) {
            let what = format!("{} m of face at a draught of {draught} m", side.face.length());
            return Err(refused(what, "boundary elements begin with dry chines".into()));
        }
        Ok(RolledFlow { sides })
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

    /// One step by the midpoint rule. `acceleration` gives the downward acceleration [m/s²] under a load. Returns the step [s] and the load at
    /// its start.
    ///
    /// # Errors
    /// A wedge that has stopped, or a flow that is no longer finite; the state before the step is kept.
    pub fn step(&mut self, acceleration: impl Fn(&RolledLoad) -> f64) -> Result<(f64, RolledLoad), FlowEnded> {
        let mut start = solution::solve(&self.sides);
        let mut left = false;
        for (side, now) in self.sides.iter_mut().zip(&start.sides) {
            if let Some(underside) = side.separated(now) {
                side.underside = Some(underside);
                left = true;
            }
        }
        if left {
            start = solution::solve(&self.sides);
        }
        let ended = |speed: f64| FlowEnded { draught: self.draught(), speed };
        let dt = (0..2).map(|i| self.sides[i].stable_dt(&start.sides[i])).fold(f64::INFINITY, f64::min);
        let moved = |speed: f64, at: &solution::RolledSolution, rate: f64, dt: f64| {
            [0, 1].map(|i| self.sides[i].moved(speed, &at.sides[i], rate, dt))
        };
        let half = moved(self.speed(), &start, acceleration(&start.load), 0.5 * dt);
        if !half.iter().all(EntryFlow::is_finite) {
            return Err(ended(half[0].speed));
        }
        let middle = solution::solve(&half);
        let end = moved(half[0].speed, &middle, acceleration(&middle.load), dt);
        let is_finite = end.iter().all(EntryFlow::is_finite) && start.load.force[1].is_finite();
        if !(is_finite && end[0].speed > 0.0) {
            return Err(ended(end[0].speed));
        }
        self.sides = end.map(EntryFlow::redistributed);
        Ok((dt, start.load))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probe() {
        for (left, right) in [(30.0, 30.0_f64), (29.0, 31.0), (20.0, 40.0), (10.0, 30.0)] {
            let [l, r] = [left, right].map(f64::to_radians);
            let exact = AsymmetricFlow::solve(l, r).expect("a solution");
            let time = std::time::Instant::now();
            let mut flow = RolledFlow::new([l, r], [100.0; 2], 0.1, 2.0, 0.0).expect("in range");
            let n = solution::solve(&flow.sides).sides.map(|s| s.nodes.len());
            let mut count = 0;
            while flow.draught() < 0.3 && count < 300 {
                let h = flow.draught();
                match flow.step(|_| 0.0) {
                    Ok((_, load)) => {
                        if count == 32 && left < 25.0 {
                            for i in 0..2 {
                                let n = load.pressure[i].len();
                                for (k, p) in load.pressure[i].iter().enumerate() {
                                    if k < 12 || k + 12 > n { println!("   {i} {k} {:.6} {:.4}", p[0] / h, p[1] / 2.0); }
                                }
                            }
                        }
                        let cp = |i: usize| load.pressure[i].iter().map(|p| p[1]).fold(0.0, f64::max) * 0.5;
                        if count % 16 == 0 {
                            println!(
                                "{left} {right} h {h:.4} n {n:?}: F {:.4} {:.4} M {:.4} cp {:.4} {:.4}",
                                load.force[0] / (4.0 * h) / exact.force[0] - 1.0,
                                load.force[1] / (4.0 * h) / exact.force[1] - 1.0,
                                load.moment / (4.0 * h * h) / exact.moment - 1.0,
                                cp(0) / exact.left.cp_max - 1.0,
                                cp(1) / exact.right.cp_max - 1.0
                            );
                        }
                    }
                    Err(e) => {
                        println!("{e}");
                        break;
                    }
                }
                count += 1;
            }
            println!("{count} steps {:?}", time.elapsed());
        }
    }
}
