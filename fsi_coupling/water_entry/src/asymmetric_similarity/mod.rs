//! Entry of a wedge with two deadrises at constant speed, down or obliquely: the similar flow without gravity and viscosity (THEORY EN31–EN33,
//! EN47; Semenov & Iafrati 2006; Semenov & Yoon 2009).
//!
//! The water turns round the apex from the flatter to the steeper face, or from the face that goes ahead to the one behind. The velocity there is infinite, the pressure is −∞, force and moment are
//! finite.

mod grid;
mod plate;
mod side;
mod solve;
mod sums;
mod system;

use std::cell::RefCell;

pub use plate::{NoPlateFlow, PlateFlow};
pub use side::FaceFlow;

use grid::Grid;
use sums::Sums;
use system::{System, Trial};

/// Deadrises [rad] and U/V, and their flow.
type Known = ([f64; 3], Result<AsymmetricFlow, NoFlow>);

thread_local! {
    /// The last one: a scene needs it several times.
    static LAST: RefCell<Option<Known>> = const { RefCell::new(None) };
}

/// Step of the usual grids.
const USUAL_STEP: f64 = 0.5;
/// Deadrises of a face [deg].
const DEADRISES: [f64; 2] = [4.0, 80.0];
/// Largest speed sideways over the one downwards [-].
const FASTEST: f64 = 2.0;

/// The flow about a wedge with two deadrises that moves down at constant speed V, and to the right at U, in units of V t, ½ρV² and ρV³t.
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
    pub balance: Balance,
}

/// The same from the water's momentum and energy, and what is lost of its mass.
#[derive(Clone, Copy, Debug)]
pub struct Balance {
    /// Force from the rate of the water's momentum, [F_x, F_y]/(ρV³t) [-].
    pub force: [f64; 2],
    /// Moment about the apex from the rate of its angular momentum, M/(ρV⁴t²) [-].
    pub moment: f64,
    /// F_y/(ρV³t) from the rate of its kinetic energy and F_x [-].
    pub force_from_energy: f64,
    /// Flux through the whole boundary over that through the faces [-].
    pub flux: f64,
}

impl Balance {
    /// Of the integrals over the boundary, U/V, F_x and the flux through the faces.
    fn of(sums: &Sums, ratio: f64, sideways: f64, through: f64) -> Balance {
        let [p_x, p_y] = sums.momentum;
        Balance {
            force: [-2.0 * p_x, -2.0 * p_y],
            moment: -3.0 * sums.angular + 2.0 * (p_x + ratio * p_y),
            force_from_energy: sums.energy + ratio * sideways,
            flux: sums.flux / through,
        }
    }
}

/// There is no such flow.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no similar flow about a wedge with deadrises of {left_deg} and {right_deg} degrees at U/V = {ratio}: {why}")]
pub struct NoFlow {
    /// Deadrise on the left [deg].
    pub left_deg: f64,
    /// Deadrise on the right [deg].
    pub right_deg: f64,
    /// Speed to the right over the one downwards U/V [-].
    pub ratio: f64,
    /// Why.
    pub why: &'static str,
}

impl NoFlow {
    /// The wedge, as the case outside a range.
    pub(crate) fn as_case(&self) -> String {
        let NoFlow { left_deg, right_deg, ratio, why } = self;
        let sideways = if *ratio == 0.0 { String::new() } else { format!(" at U/V = {ratio:.3}") };
        format!("one with deadrises of {left_deg:.2} and {right_deg:.2} degrees{sideways} ({why})")
    }
}

impl AsymmetricFlow {
    /// For the deadrises of the left and the right face [rad]; a symmetric wedge of deadrise β that is rolled by r counter-clockwise has β − r and
    /// β + r.
    ///
    /// # Errors
    /// A deadrise outside 4–80°; an asymmetry at which the flow would suck at the steeper face: a real one leaves the apex; one at which Newton's
    /// method does not arrive.
    pub fn solve(left: f64, right: f64) -> Result<AsymmetricFlow, NoFlow> {
        AsymmetricFlow::oblique(left, right, 0.0)
    }

    /// For the deadrises of the left and the right face [rad] and the speed to the right over the one downwards, U/V [-] (THEORY EN47).
    ///
    /// # Errors
    /// As [`AsymmetricFlow::solve`], and a ratio above 2 either way.
    pub fn oblique(left: f64, right: f64, ratio: f64) -> Result<AsymmetricFlow, NoFlow> {
        let case = [left, right, ratio];
        let known = LAST.with_borrow(|last| last.as_ref().filter(|(of, _)| *of == case).map(|(_, flow)| flow.clone()));
        known.unwrap_or_else(|| {
            let flow = AsymmetricFlow::with_step(left, right, ratio, USUAL_STEP);
            LAST.set(Some((case, flow.clone())));
            flow
        })
    }

    /// The same on grids of another step [-].
    ///
    /// # Errors
    /// As [`AsymmetricFlow::oblique`].
    pub fn with_step(left: f64, right: f64, ratio: f64, step: f64) -> Result<AsymmetricFlow, NoFlow> {
        let [left_deg, right_deg] = [left, right].map(f64::to_degrees);
        let refused = |why| NoFlow { left_deg, right_deg, ratio, why };
        let [least, most] = DEADRISES;
        if !(least..=most).contains(&left_deg) || !(least..=most).contains(&right_deg) {
            return Err(refused("expected faces of 4 to 80 degrees"));
        }
        if !(-FASTEST..=FASTEST).contains(&ratio) {
            return Err(refused("expected U/V from -2 to 2"));
        }
        let grid = Grid::new(step);
        let trial = solve::solve(&grid, 0.5 * (left + right), 0.5 * (right - left), ratio)
            .map_err(|_| refused("the flow that follows both faces ends nearer to the symmetric one"))?;
        let flow = AsymmetricFlow::of(&trial, &System { grid: &grid, beta: [right, left], ratio });
        if flow.left.force_coefficient.min(flow.right.force_coefficient) <= 0.0 {
            return Err(refused(
                "the suction next to the apex exceeds the pressure on the face behind it, and the flow leaves the apex",
            ));
        }
        Ok(flow)
    }

    /// Of a solution of the equations.
    fn of(trial: &Trial, system: &System<'_>) -> AsymmetricFlow {
        let System { grid, beta: [right, left], ratio } = *system;
        let scale = 1.0 / system.keel_speed(0, &trial.sides[0])[1];
        let (right, on_right) = side::flow(&trial.sides[0], [right, ratio], grid.step, scale);
        let (left, on_left) = side::flow(&trial.sides[1], [left, -ratio], grid.step, scale);
        let [(sin_r, cos_r), (sin_l, cos_l)] = [&right, &left].map(|face| face.deadrise_deg.to_radians().sin_cos());
        let [f_r, f_l] = [right.force_coefficient, left.force_coefficient];
        let force = [f_l * sin_l - f_r * sin_r, f_l * cos_l + f_r * cos_r];
        let sums = on_right.plus(&on_left.mirrored(), 1.0);
        let through = [right.length * (cos_r + ratio * sin_r), left.length * (cos_l - ratio * sin_l)];
        AsymmetricFlow {
            force,
            moment: right.moment_coefficient - left.moment_coefficient,
            balance: Balance::of(&sums, ratio, force[0], through[0] + through[1]),
            left,
            right,
        }
    }

    /// The faces, left and right.
    pub fn faces(&self) -> [&FaceFlow; 2] {
        [&self.left, &self.right]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SimilarityFlow;

    fn flow(left: f64, right: f64) -> AsymmetricFlow {
        AsymmetricFlow::solve(left.to_radians(), right.to_radians()).expect("a solution")
    }

    fn oblique(left: f64, right: f64, ratio: f64) -> AsymmetricFlow {
        AsymmetricFlow::oblique(left.to_radians(), right.to_radians(), ratio).expect("a solution")
    }

    /// Equal faces: the solution of Dobrovolskaya (1969), which uses other equations.
    #[test]
    fn equal_faces_are_those_of_a_symmetric_wedge() {
        for deadrise in [10.0, 17.0, 20.0, 30.0, 45.0, 60.0] {
            let (own, exact) = (flow(deadrise, deadrise), SimilarityFlow::solve(deadrise).expect("a solution"));
            let force = own.force[1] / exact.force_coefficient - 1.0;
            let cp = [own.left.cp_max, own.right.cp_max].map(|cp| cp / exact.cp_max - 1.0);
            let tip = own.right.tip[0] / exact.tip[0] - 1.0;
            let all = [force, cp[0], cp[1], tip];
            assert!(all.iter().all(|e| e.abs() < 1e-4), "{deadrise}°: {all:+.6?}");
            assert!(own.force[0].abs() < 1e-7 * own.force[1] && own.moment.abs() < 1e-7 * own.force[1], "{deadrise}°");
        }
    }

    /// Force and moment from the pressure are those from the momentum, the angular momentum and the energy of the water, and mass is kept.
    #[test]
    fn momentum_energy_and_mass_are_kept() {
        for (left, right) in
            [(8.0, 32.0), (10.0, 30.0), (40.0, 20.0), (35.0, 55.0), (30.0, 70.0), (29.0, 31.0), (44.0, 63.0)]
        {
            let flow = flow(left, right);
            let Balance { force: [x, y], moment, force_from_energy, flux } = flow.balance;
            let of = [x / flow.force[0], y / flow.force[1], force_from_energy / flow.force[1], moment / flow.moment];
            assert!(of.iter().all(|of| (of - 1.0).abs() < 5e-4), "{left}°, {right}°: {of:.6?}");
            assert!(flux.abs() < 1e-4, "{left}°, {right}°: {flux:e}");
        }
    }

    #[test]
    fn the_mirror_image_has_the_mirrored_load() {
        let (own, mirrored) = (flow(22.0, 47.0), flow(47.0, 22.0));
        let pairs = [
            (own.force[0], -mirrored.force[0]),
            (own.force[1], mirrored.force[1]),
            (own.moment, -mirrored.moment),
            (own.left.cp_max, mirrored.right.cp_max),
            (own.right.peak, mirrored.left.peak),
            (own.left.tip[0], mirrored.right.tip[0]),
        ];
        assert!(pairs.iter().all(|(a, b)| (a - b).abs() < 1e-7 * a.abs()), "{pairs:?}");
    }

    /// With a speed sideways too: mass, momentum, energy and the angular momentum about the moving apex are kept.
    #[test]
    fn oblique_entry_keeps_momentum_energy_and_mass() {
        for (left, right, ratio) in
            [(30.0, 30.0, 0.25), (30.0, 30.0, 1.0), (20.0, 40.0, 0.25), (20.0, 40.0, -0.5), (12.0, 12.0, 1.9)]
        {
            let flow = oblique(left, right, ratio);
            let Balance { force: [x, y], moment, force_from_energy, flux } = flow.balance;
            let of = [x / flow.force[0], y / flow.force[1], force_from_energy / flow.force[1], moment / flow.moment];
            assert!(of.iter().all(|of| (of - 1.0).abs() < 5e-4), "{left}°, {right}°, {ratio}: {of:.6?}");
            assert!(flux.abs() < 1e-4, "{left}°, {right}°, {ratio}: {flux:e}");
        }
    }

    /// A symmetric wedge: the vertical force is even in U/V, the horizontal one and the moment are odd and begin in proportion.
    #[test]
    fn a_small_speed_sideways_changes_the_load_in_proportion() {
        let (still, small, back, twice) =
            (flow(30.0, 30.0), oblique(30.0, 30.0, 0.02), oblique(30.0, 30.0, -0.02), oblique(30.0, 30.0, 0.04));
        let vertical = |flow: &AsymmetricFlow| flow.force[1] / still.force[1] - 1.0;
        assert!((vertical(&small) - vertical(&back)).abs() < 1e-8, "{:e} {:e}", vertical(&small), vertical(&back));
        assert!((vertical(&twice) / vertical(&small) - 4.0).abs() < 0.05, "{:e}", vertical(&twice));
        for of in [|flow: &AsymmetricFlow| flow.force[0], |flow: &AsymmetricFlow| flow.moment] {
            assert!((of(&small) + of(&back)).abs() < 1e-7 * of(&small).abs(), "{} {}", of(&small), of(&back));
            assert!((of(&twice) / of(&small) - 2.0).abs() < 1e-3, "{} {}", of(&small), of(&twice));
        }
    }

    /// Half and a quarter of the usual step: the differences fall by an order of four and more.
    #[test]
    fn it_converges_with_the_number_of_nodes() {
        for (left, right) in [(10.0, 30.0), (35.0, 55.0)] {
            let [coarse, usual, fine] = [1.0, 0.5, 0.25].map(|step: f64| {
                let flow = AsymmetricFlow::with_step(f64::to_radians(left), f64::to_radians(right), 0.0, step)
                    .expect("a solution");
                [flow.force[0], flow.force[1], flow.moment, flow.left.cp_max, flow.right.cp_max]
            });
            for k in 0..5 {
                let [first, second] = [coarse[k] / fine[k] - 1.0, usual[k] / fine[k] - 1.0];
                assert!(second.abs() < 1e-4, "{left}°, {right}°, {k}: {second:e}");
                assert!(
                    second.abs() < first.abs() / 4.0 || second.abs() < 1e-5,
                    "{left}°, {right}°, {k}: {first:e} {second:e}"
                );
            }
        }
    }

    #[test]
    fn what_has_no_flow_is_refused() {
        let why =
            |left: f64, right: f64| AsymmetricFlow::solve(left.to_radians(), right.to_radians()).expect_err("none").why;
        assert!(why(20.0, 80.0).contains("leaves the apex") && why(80.0, 20.0).contains("leaves the apex"));
        let oblique = |ratio: f64| AsymmetricFlow::oblique(0.8, 0.8, ratio).expect_err("none").why;
        assert!(oblique(1.0).contains("leaves the apex") && oblique(-3.0).contains("-2 to 2"));
        assert!(why(3.0, 20.0).contains("4 to 80") && why(f64::NAN, 20.0).contains("4 to 80"));
    }
}
