//! Entry of a wedge with two different deadrises at constant speed: the similar flow without gravity and viscosity (THEORY EN31–EN33;
//! Semenov & Iafrati 2006).
//!
//! The water turns round the apex from the flatter to the steeper face. The velocity there is infinite, the pressure is −∞, force and moment are
//! finite.

mod grid;
mod side;
mod solve;
mod sums;
mod system;

pub use side::FaceFlow;

use grid::Grid;
use system::System;

/// Step of the usual grids.
const USUAL_STEP: f64 = 0.5;
/// Deadrises of a face [deg].
const DEADRISES: [f64; 2] = [4.0, 80.0];

/// The flow about a wedge with two deadrises that moves down at constant speed V, in units of V t, ½ρV² and ρV³t.
#[derive(Clone, Debug)]
pub struct AsymmetricFlow {
    /// The face on the left, x < 0.
    pub left: FaceFlow,
    /// The face on the right.
    pub right: FaceFlow,
    /// Force [F_x, F_y]/(ρV³t) [-], x to the right, y up.
    pub force: [f64; 2],
    /// Moment about the apex M/(ρV⁴t²) [-], counter-clockwise.
    pub moment: f64,
    /// Checks of the solution.
    pub share: Share,
}

/// The same from the water's momentum and energy, and what is lost of its mass.
#[derive(Clone, Copy, Debug)]
pub struct Share {
    /// Force from the rate of the water's momentum, [F_x, F_y]/(ρV³t) [-].
    pub force: [f64; 2],
    /// Moment about the apex from the rate of its angular momentum, M/(ρV⁴t²) [-].
    pub moment: f64,
    /// F_y/(ρV³t) from the rate of its kinetic energy [-].
    pub force_from_energy: f64,
    /// Flux through the whole boundary over that through the faces [-].
    pub flux: f64,
}

/// There is no such flow.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no similar flow about a wedge with deadrises of {left_deg} and {right_deg} degrees: {why}")]
pub struct NoFlow {
    /// Deadrise on the left [deg].
    pub left_deg: f64,
    /// Deadrise on the right [deg].
    pub right_deg: f64,
    /// Why.
    pub why: &'static str,
}

impl AsymmetricFlow {
    /// For the deadrises of the left and the right face [rad]; a symmetric wedge of deadrise β that is rolled by r counter-clockwise has β − r and
    /// β + r.
    ///
    /// # Errors
    /// A deadrise outside 4–80°; an asymmetry at which Newton's method does not arrive.
    pub fn solve(left: f64, right: f64) -> Result<AsymmetricFlow, NoFlow> {
        AsymmetricFlow::with_step(left, right, USUAL_STEP)
    }

    /// The same on grids of another step [-].
    ///
    /// # Errors
    /// As [`AsymmetricFlow::solve`].
    pub fn with_step(left: f64, right: f64, step: f64) -> Result<AsymmetricFlow, NoFlow> {
        let [left_deg, right_deg] = [left, right].map(f64::to_degrees);
        let refused = |why| NoFlow { left_deg, right_deg, why };
        let [least, most] = DEADRISES;
        if !(least..=most).contains(&left_deg) || !(least..=most).contains(&right_deg) {
            return Err(refused("faces of 4 to 80 degrees"));
        }
        let grid = Grid::new(step);
        let trial = solve::solve(&grid, 0.5 * (left + right), 0.5 * (right - left))
            .map_err(|_| refused("the flow that follows both faces ends at a smaller asymmetry"))?;
        let system = System { grid: &grid, beta: [right, left] };
        let scale = 1.0 / system.keel_speed(0, &trial.sides[0])[1];
        let (right, on_right) = side::flow(&trial.sides[0], right, step, scale);
        let (left, on_left) = side::flow(&trial.sides[1], left, step, scale);
        let [(sin_r, cos_r), (sin_l, cos_l)] = [&right, &left].map(|face| face.deadrise_deg.to_radians().sin_cos());
        let [f_r, f_l] = [right.force_coefficient, left.force_coefficient];
        let sums = on_right.plus(&on_left.mirrored(), 1.0);
        let share = Share {
            force: sums.momentum.map(|p| -2.0 * p),
            moment: -3.0 * sums.angular + 2.0 * sums.momentum[0],
            force_from_energy: sums.energy,
            flux: sums.flux / (right.length * cos_r + left.length * cos_l),
        };
        Ok(AsymmetricFlow {
            force: [f_l * sin_l - f_r * sin_r, f_l * cos_l + f_r * cos_r],
            moment: right.moment_coefficient - left.moment_coefficient,
            share,
            left,
            right,
        })
    }

    /// The faces, left and right.
    pub fn faces(&self) -> [&FaceFlow; 2] {
        [&self.left, &self.right]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::entry_theory::SimilarityFlow;

    #[test]
    fn probe() {
        for beta in [10.0, 20.0, 30.0, 45.0, 60.0_f64] {
            let exact = SimilarityFlow::solve(beta).expect("a");
            let t = std::time::Instant::now();
            match AsymmetricFlow::solve(beta.to_radians(), beta.to_radians()) {
                Ok(f) => println!(
                    "{beta}: F {:.6} {:.6} cp {:.5} {:.5} share {:?} {:?}",
                    f.force[1], exact.force_coefficient, f.left.cp_max, exact.cp_max, f.share, t.elapsed()
                ),
                Err(e) => println!("{e}"),
            }
        }
        for (left, right) in [(10.0, 30.0_f64), (20.0, 40.0), (35.0, 55.0), (29.0, 31.0), (8.0, 32.0), (30.0, 70.0)] {
            for step in [0.5, 0.25] {
                let t = std::time::Instant::now();
                match AsymmetricFlow::with_step(f64::to_radians(left), f64::to_radians(right), step) {
                    Ok(f) => println!(
                        "{left} {right} h {step}: F {:?} M {:.6} cp {:.5} {:.5} len {:.4} {:.4} {:?} {:?}",
                        f.force, f.moment, f.left.cp_max, f.right.cp_max, f.left.length, f.right.length, f.share, t.elapsed()
                    ),
                    Err(e) => println!("{e} {:?}", t.elapsed()),
                }
            }
        }
    }
}
