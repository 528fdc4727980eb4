//! Rows of a link: relative motion of two solids along one generalised direction, and the multipliers that hold many rows at once (THEORY CO36).

use sph_core::walls::Resultant;

use crate::bodies::state::Solid;
use crate::geometry::vector::cross;

/// Largest number of passes over the rows.
const MOST_PASSES: u32 = 20_000;
/// Change of a multiplier over the largest one at which a solution is taken [-].
const TOLERANCE: f64 = 1e-14;

/// A generalised direction of two solids: the relative speed along it is J_a q̇_a + J_b q̇_b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Direction {
    /// Indices of the solids.
    pub solids: [usize; 2],
    /// Rows J_a, J_b of x, y and angle, shape (2, 3).
    pub jacobian: [[f64; 3]; 2],
}

/// What the multiplier of a row may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Anything: a joint.
    Both,
    /// At least 0, and 0 where the solids part: a contact.
    Push,
    /// At most `coefficient` times the multiplier of row `normal` by magnitude: Coulomb's friction.
    Friction {
        /// Index of the row of the normal direction.
        normal: usize,
        /// Coefficient of friction [-].
        coefficient: f64,
    },
}

/// A direction with its bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    pub direction: Direction,
    pub bound: Bound,
}

impl Direction {
    /// Velocity of solid b less that of solid a along `unit` [-] at the point `at` [m] of both.
    pub fn between(solids: [usize; 2], all: &[Solid], at: [f64; 2], unit: [f64; 2]) -> Direction {
        let row = |solid: usize, sign: f64| {
            let arm = all[solid].arm(at);
            [sign * unit[0], sign * unit[1], sign * cross(arm, unit)]
        };
        Direction { solids, jacobian: [row(solids[0], -1.0), row(solids[1], 1.0)] }
    }

    /// Angular velocity of solid b less that of solid a.
    pub fn turning(solids: [usize; 2]) -> Direction {
        Direction { solids, jacobian: [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]] }
    }

    /// Relative speed [m/s or rad/s].
    pub fn speed(&self, all: &[Solid]) -> f64 {
        self.of(|k| {
            let motion = &all[k].motion;
            [motion.velocity[0], motion.velocity[1], motion.angular_velocity]
        })
    }

    /// Relative acceleration of the material points [m/s² or rad/s²], centripetal parts left out.
    pub fn acceleration(&self, all: &[Solid]) -> f64 {
        self.of(|k| {
            let motion = &all[k].motion;
            [motion.acceleration[0], motion.acceleration[1], motion.angular_acceleration]
        })
    }

    /// J_a z_a + J_b z_b of any three numbers per solid.
    fn of(&self, numbers: impl Fn(usize) -> [f64; 3]) -> f64 {
        let one = |side: usize| dot(self.jacobian[side], numbers(self.solids[side]));
        one(0) + one(1)
    }

    /// Force and moment about their centres that a multiplier exerts on the solids a and b.
    pub fn resultants(&self, multiplier: f64) -> [Resultant; 2] {
        self.jacobian
            .map(|[x, y, turn]| Resultant { force: [multiplier * x, multiplier * y], moment: multiplier * turn })
    }

    /// J_i M⁻¹ J_jᵀ.
    fn coupling(&self, other: &Direction, all: &[Solid]) -> f64 {
        let mut sum = 0.0;
        for (mine, a) in self.solids.iter().zip(self.jacobian) {
            for (theirs, b) in other.solids.iter().zip(other.jacobian) {
                if mine == theirs {
                    let response = all[*mine].response();
                    sum += (0..3).map(|k| a[k] * response[k] * b[k]).sum::<f64>();
                }
            }
        }
        sum
    }
}

/// CO36: multipliers λ with w = `free` + J M⁻¹ Jᵀ λ, where w = 0 in the rows of joints, 0 ≤ w ⟂ λ ≥ 0 in those of contacts, and friction is
/// bounded by its normal row; by projected Gauss–Seidel passes in the order of the rows (Moreau 1988; Jourdan et al. 1998). A row that
/// nothing can move keeps λ = 0.
pub fn multipliers(rows: &[Row], all: &[Solid], free: &[f64]) -> Vec<f64> {
    let count = rows.len();
    let matrix: Vec<f64> =
        rows.iter().flat_map(|a| rows.iter().map(|b| a.direction.coupling(&b.direction, all))).collect();
    let mut found = vec![0.0; count];
    for _ in 0..MOST_PASSES {
        let mut change: f64 = 0.0;
        for (i, row) in rows.iter().enumerate() {
            let diagonal = matrix[i * count + i];
            if diagonal <= 0.0 {
                continue;
            }
            let moving: f64 = free[i] + (0..count).map(|j| matrix[i * count + j] * found[j]).sum::<f64>();
            let wanted = found[i] - moving / diagonal;
            let taken = match row.bound {
                Bound::Both => wanted,
                Bound::Push => wanted.max(0.0),
                Bound::Friction { normal, coefficient } => {
                    let most = coefficient * found[normal];
                    wanted.clamp(-most, most)
                }
            };
            change = change.max((taken - found[i]).abs());
            found[i] = taken;
        }
        let largest = found.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        if change <= TOLERANCE * largest {
            break;
        }
    }
    found
}

/// Share of a gain of energy in the work of the impulses that is rounding [-].
const ROUNDING: f64 = 1e-12;

/// CO37: kinetic energy that impulses λ give solids whose relative speeds were w, λ·w + ½ λ·J M⁻¹ Jᵀ λ [J/m]; 0 where it is rounding.
pub fn energy_gained(rows: &[Row], all: &[Solid], speeds: &[f64], impulses: &[f64]) -> f64 {
    let [linear, square] = work(rows, all, speeds, [impulses, impulses]);
    let gained = linear + 0.5 * square;
    if gained > ROUNDING * (linear.abs() + square) { gained } else { 0.0 }
}

/// CO37: impulses on the way from those without restitution, which take energy, to those with it: the last that give none. Both bounds of
/// Coulomb's cone, the rows of joints and of contacts that do not bounce hold on the whole way, since they hold at both ends.
pub fn without_gain(rows: &[Row], all: &[Solid], speeds: &[f64], [plastic, elastic]: [&[f64]; 2]) -> Vec<f64> {
    let way: Vec<f64> = plastic.iter().zip(elastic).map(|(a, b)| b - a).collect();
    let [linear, square] = work(rows, all, speeds, [&way, &way]);
    let [start, own] = work(rows, all, speeds, [plastic, plastic]);
    let [_, cross] = work(rows, all, speeds, [plastic, &way]);
    // c + b s + a s²/2 = 0 with c ≤ 0: its root above 0, written without cancellation
    let (a, b, c) = (square, linear + cross, (start + 0.5 * own).min(0.0));
    let root = (b * b - 2.0 * a * c).max(0.0).sqrt();
    let share = if b > 0.0 { -2.0 * c / (b + root) } else { (root - b) / a };
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
    plastic.iter().zip(&way).map(|(from, way)| from + share * way).collect()
}

/// λ_b·w and λ_a·J M⁻¹ Jᵀ λ_b [J/m].
fn work(rows: &[Row], all: &[Solid], speeds: &[f64], [a, b]: [&[f64]; 2]) -> [f64; 2] {
    let linear = b.iter().zip(speeds).map(|(impulse, speed)| impulse * speed).sum();
    let moved =
        |row: &Row| rows.iter().zip(b).map(|(other, b)| row.direction.coupling(&other.direction, all) * b).sum::<f64>();
    [linear, rows.iter().zip(a).map(|(row, a)| a * moved(row)).sum()]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::rigid_motion::RigidMotion;

    fn solid(position: [f64; 2], inverse_mass: [f64; 3]) -> Solid {
        Solid { motion: RigidMotion { position, ..RigidMotion::default() }, inverse_mass, halves: 1.0 }
    }

    /// A box of 2 kg on its two corners, pushed down at its middle: each corner carries half; pulled up, none.
    #[test]
    fn two_corners_share_a_weight_and_never_pull() {
        let all = [solid([0.0; 2], [0.0; 3]), solid([0.0, 1.0], [0.5, 0.5, 3.0])];
        let corner =
            |x: f64| Row { direction: Direction::between([0, 1], &all, [x, 0.5], [0.0, 1.0]), bound: Bound::Push };
        let rows = [corner(-0.4), corner(0.4)];
        let found = multipliers(&rows, &all, &[-9.81; 2]);
        found.iter().for_each(|force| assert!((force - 9.81).abs() < 1e-12, "{found:?}"));
        assert_eq!(multipliers(&rows, &all, &[1.0; 2]), [0.0; 2]);
    }

    /// Friction holds what it can: a block on a plane slides when pushed by more than μ N.
    #[test]
    fn friction_is_bounded_by_the_normal_force() {
        let all = [solid([0.0; 2], [0.0; 3]), solid([0.0, 0.5], [1.0, 1.0, 0.0])];
        let row = |unit, bound| Row { direction: Direction::between([0, 1], &all, [0.0; 2], unit), bound };
        let along = Bound::Friction { normal: 0, coefficient: 0.3 };
        let rows = [row([0.0, 1.0], Bound::Push), row([1.0, 0.0], along)];
        for (pushed, held) in [(1.0, -1.0), (5.0, -3.0)] {
            let found = multipliers(&rows, &all, &[-10.0, pushed]);
            assert!((found[0] - 10.0).abs() < 1e-12 && (found[1] - held).abs() < 1e-12, "{found:?}");
        }
    }
}
