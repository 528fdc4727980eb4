//! Pistons under an incompressible column: a fluid that answers at once with all of its added mass (THEORY CO11), coupled by
//! the schemes' own code. Only the fluid is a double.

use std::f64::consts::{PI, TAU};

use sph_core::walls::WallPoint;
use sph_core::walls::interface::{InterfaceLoad, ParticleLoad};
use sph_core::{WallInterface, Walls};

use crate::bodies::rigid_interface::RigidInterface;
use crate::coupling::scheme::{CouplingStatistics, Interface, Iteration, Residual, Scheme, set_trial, unknowns};

const TIGHT: Iteration = Iteration { tolerance: 1e-8, max_iterations: 200 };

/// Pistons side by side, of unit mass, each on its spring; the water above them has the added mass `added`.
struct Pistons {
    added: Vec<Vec<f64>>,
    stiffness: Vec<f64>,
    place: Vec<f64>,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    walls: Walls,
    interface: Interface,
}

impl Pistons {
    fn new(added: Vec<Vec<f64>>, stiffness: Vec<f64>, place: Vec<f64>, scheme: Scheme) -> Pistons {
        let (mut walls, n) = (Walls::default(), place.len());
        let point = WallPoint {
            at: [0.0; 2],
            normal: [0.0, 1.0],
            area: 1.0,
            spacing: 1.0,
            depth: 0.0,
            outline: Default::default(),
            midline: None,
        };
        walls.extend(&vec![point; n], 1.0);
        let still = vec![0.0; n];
        let interface = Interface::new(scheme);
        Pistons { added, stiffness, place, velocity: still.clone(), acceleration: still, walls, interface }
    }

    /// Force of the water on the pistons under the accelerations that they show it.
    fn water(added: &[Vec<f64>], walls: &mut Walls) {
        for (k, row) in added.iter().enumerate() {
            walls.fy[k] = -row.iter().zip(&walls.ay).map(|(mass, a)| mass * a).sum::<f64>();
        }
    }

    fn owners(&self) -> Vec<WallInterface> {
        let owner = |k: usize| RigidInterface {
            predicted: [0.0, self.acceleration[k], 0.0],
            inverse_mass: [0.0, 1.0, 0.0],
            free_fall: [0.0, -self.stiffness[k] * self.place[k], 0.0],
            ..RigidInterface::default()
        };
        (0..self.place.len())
            .map(|k| WallInterface { range: k..k + 1, mirrored: false, owner: Box::new(owner(k)) })
            .collect()
    }

    /// Kick–drift–kick (CO2), as a rigid body in the real water.
    fn step(&mut self, scheme: Scheme, dt: f64) {
        for k in 0..self.place.len() {
            self.velocity[k] += 0.5 * dt * self.acceleration[k];
            self.place[k] += dt * self.velocity[k];
        }
        let mut owners = self.owners();
        let first = unknowns(&owners);
        self.walls.ay.clone_from(&self.acceleration);
        let (added, walls) = (&self.added, &mut self.walls);
        match scheme {
            Scheme::Weak => Pistons::water(added, walls),
            Scheme::AddedMass => {
                Pistons::water(added, walls);
                // what the fluid passes to an owner: δF = push (arm·δa)
                let touch = ParticleLoad {
                    at: [0.0; 2],
                    force: [0.0, walls.fy[0]],
                    push: [0.0, -added[0][0]],
                    arm: [0.0, 1.0],
                };
                let (mut change, encounter) =
                    ([[0.0; 2]], InterfaceLoad { particles: &[touch], offset: 0.0, mirrored: false });
                owners[0].owner.solve_acceleration(&encounter, &mut change);
                walls.fy[0] -= added[0][0] * change[0][1];
            }
            Scheme::IqnIls(iteration) => {
                let start = walls.clone();
                let trial = |x: &[f64], again: bool| {
                    if again {
                        walls.clone_from(&start);
                        set_trial(&mut owners, walls, x);
                    }
                    Pistons::water(added, walls);
                    Ok(Residual::of(&owners, walls, false))
                };
                self.interface.iterate(iteration, 0.0, first, trial).expect("agreement");
            }
        }
        for k in 0..self.place.len() {
            self.acceleration[k] = self.walls.fy[k] - self.stiffness[k] * self.place[k];
            self.velocity[k] += 0.5 * dt * self.acceleration[k];
        }
    }

    fn widest(&self) -> f64 {
        self.place.iter().fold(0.0, |widest, place| place.abs().max(widest))
    }
}

/// One piston under a column of `ratio` times its mass, let go at 1, `steps` a period in the water, for two periods, the
/// weak interface for 2000 steps: the widest it went, and how the schemes agreed.
fn one(ratio: f64, steps: usize, scheme: Scheme) -> (f64, CouplingStatistics) {
    let wet = TAU; // period [s]
    let mut piston = Pistons::new(vec![vec![ratio]], vec![(1.0 + ratio) * (TAU / wet).powi(2)], vec![1.0], scheme);
    piston.acceleration[0] = -(TAU / wet).powi(2);
    let mut widest = 0.0_f64;
    for _ in 0..if scheme == Scheme::Weak { 2000 } else { 2 * steps } {
        piston.step(scheme, wet / steps as f64);
        widest = widest.max(piston.widest());
        if widest > 1e6 {
            break;
        }
    }
    if scheme != Scheme::Weak {
        let exact = (2.0 * TAU).cos();
        assert!((piston.place[0] - exact).abs() < 0.02, "{ratio}, {steps}: ends at {}", piston.place[0]);
    }
    (widest, piston.interface.statistics)
}

/// CO11: explicit coupling diverges where the column is heavier than the piston, and the sooner the shorter the step; the
/// other schemes hold at any ratio. One unknown: both iterations have it after one difference.
#[test]
fn a_heavy_column_breaks_one_interface_a_step_whatever_the_step() {
    for ratio in [0.1, 0.5, 0.95, 1.05, 2.0, 10.0, 100.0, 1000.0] {
        for steps in [50, 500, 5000] {
            let [weak, added, newton] =
                [Scheme::Weak, Scheme::AddedMass, Scheme::IqnIls(TIGHT)].map(|scheme| one(ratio, steps, scheme));
            let each = |(_, agreement): (f64, CouplingStatistics)| agreement.iterations as f64 / agreement.steps as f64;
            println!(
                "ratio {ratio:7.2}, {steps:5} steps per period: weak to {:8.1e}, added_mass {:.3}, iqn_ils {:.3} ({:.2} per step)",
                weak.0,
                added.0,
                newton.0,
                each(newton)
            );
            assert_eq!(weak.0 > 1e6, ratio > 1.0, "ratio {ratio}, {steps} steps: weak goes to {}", weak.0);
            for (widest, agreement) in [added, newton] {
                assert!(widest < 1.01 && agreement.most_iterations <= 4, "{ratio}: {widest}, {agreement:?}");
            }
        }
    }
}

/// CO11: repetition with a constant relaxation ω converges below 2/(1 + μ) and nowhere beyond: the double is what it says.
#[test]
fn constant_relaxation_converges_below_its_bound() {
    for ratio in [0.5, 2.0, 50.0] {
        for (share, expected) in [(0.95, true), (1.05, false)] {
            let factor = share * 2.0 / (1.0 + ratio);
            let mut piston = Pistons::new(vec![vec![ratio]], vec![1.0], vec![1.0], Scheme::Weak);
            let (mut owners, start) = (piston.owners(), piston.walls.clone());
            let mut size = Vec::new();
            let mut x = unknowns(&owners);
            for _ in 0..200 {
                piston.walls.clone_from(&start);
                set_trial(&mut owners, &mut piston.walls, &x);
                Pistons::water(&piston.added, &mut piston.walls);
                let r = Residual::of(&owners, &piston.walls, false).of_unknowns;
                x.iter_mut().zip(&r).for_each(|(x, r)| *x += factor * r);
                size.push(r[1].abs());
            }
            assert_eq!(size[199] < 1e-3 * size[0], expected, "ratio {ratio}, {share} of the bound: {}", size[199]);
        }
    }
}

/// Forty panels side by side under a layer of water whose surface is free: waves of length 2L/k along them, k = 1, 2, …, see
/// the added mass ρ tanh(κH)/κ of an incompressible layer of depth H = L. (Added mass found by each panel from its own acceleration
/// only, CO5, does not apply: these share their water.)
#[test]
fn a_flexible_floor_agrees_with_an_incompressible_layer() {
    let n = 40;
    let shape = |k: usize, i: usize| (2.0 / n as f64).sqrt() * (PI * k as f64 * (i as f64 + 0.5) / n as f64).sin();
    let added = |ratio: f64| -> Vec<Vec<f64>> {
        let mass = |k: usize| ratio * (PI * k as f64).tanh() / (PI * k as f64); // ρ L/m_s tanh(κH)/(κL)
        let norm = |k: usize| if k == n { 0.5 } else { 1.0 };
        let entry = |i: usize, j: usize| (1..=n).map(|k| norm(k) * mass(k) * shape(k, i) * shape(k, j)).sum();
        (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
    };
    for ratio in [0.1, 1.0, 10.0, 100.0, 1000.0] {
        let scheme = Scheme::IqnIls(TIGHT);
        let place = (0..n).map(|i| if i < 15 { 1.0 } else { -0.3 }).collect();
        let stiffness = (0..n).map(|i| (1.0 + ratio / PI) * (1.0 + 0.05 * i as f64)).collect();
        let mut floor = Pistons::new(added(ratio), stiffness, place, scheme);
        (0..100).for_each(|_| floor.step(scheme, 0.02));
        let found = floor.interface.statistics;
        assert!(floor.widest() < 3.0, "{ratio}: {}", floor.widest());
        let per_step = found.iterations as f64 / found.steps as f64;
        println!("ratio {ratio:6.1}: iqn_ils {per_step:.1} iterations per step, at most {}", found.most_iterations);
        assert!(per_step < 8.0 && found.most_iterations < 40, "{ratio}: {found:?}");
    }
}
