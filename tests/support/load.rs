//! A body pushed by hand: boundary particles and forces on them without a fluid.

use fsi_coupling::{Body, WallRows};
use sph_core::{Walls, walls::Resultant};

/// The boundary particles of one body, and the forces that a test writes on them.
pub struct Handled {
    /// Where the body last put its particles, and what pushes them.
    pub walls: Walls,
    mirrored: bool,
}

/// Smoothing length over spacing of the sampled particles [-]; no force depends on it here.
const RATIO: f64 = 1.5;

impl Handled {
    /// Sample a body at `spacing` [m] in three layers; `mirrored` where only its half x > 0 is simulated.
    pub fn new(body: &mut dyn Body, spacing: f64, mirrored: bool) -> Handled {
        let mut walls = Walls::default();
        walls.extend(&body.sample(&WallRows::filled(spacing, 3)).expect("a sound outline"), RATIO);
        let mut handled = Handled { walls, mirrored };
        handled.place(body, 0.0);
        handled
    }

    /// H: let the body write where its particles will be `ahead` [s] from now.
    pub fn place(&mut self, body: &dyn Body, ahead: f64) {
        let all = 0..self.walls.len();
        body.kinematics(ahead, self.walls.slice_mut(all));
    }

    /// Write the force now on each particle [N/m]; the step's mean is that of this force and the one before,
    /// as a kick–drift–kick step has it (THEORY WC11).
    pub fn push(&mut self, force: impl Fn(usize, &Walls) -> [f64; 2]) {
        for k in 0..self.walls.len() {
            let ([fx, fy], before) = (force(k, &self.walls), [self.walls.fx[k], self.walls.fy[k]]);
            (self.walls.mean_fx[k], self.walls.mean_fy[k]) = (0.5 * (before[0] + fx), 0.5 * (before[1] + fy));
            (self.walls.fx[k], self.walls.fy[k]) = (fx, fy);
        }
    }

    /// Hᵀ: hand the forces to the body.
    pub fn load(&self, body: &mut dyn Body) {
        let mut forces = self.walls.forces(0..self.walls.len());
        forces.mirrored = self.mirrored;
        body.load(forces);
    }

    /// One step of `dt` [s] as the coupling takes it, with the force of `force` on particle k where it will be.
    pub fn step(&mut self, body: &mut dyn Body, dt: f64, force: impl Fn(usize, &Walls) -> [f64; 2]) {
        self.place(body, dt);
        self.push(force);
        self.load(body);
        body.advance(dt).expect("the motion stays finite");
    }

    /// Start with the load of `force` where the particles are: the step's mean is the force itself.
    pub fn start(&mut self, body: &mut dyn Body, force: impl Fn(usize, &Walls) -> [f64; 2]) {
        self.place(body, 0.0);
        self.push(force);
        self.walls.mean_fx.clone_from(&self.walls.fx);
        self.walls.mean_fy.clone_from(&self.walls.fy);
        self.load(body);
    }

    /// The forces that add up to a resultant about `pole` [m]: spread evenly, the moment by a rigid swirl.
    pub fn spread(&self, total: Resultant, pole: [f64; 2]) -> Vec<[f64; 2]> {
        let (walls, n) = (&self.walls, self.walls.len() as f64);
        let arm = |k: usize| [walls.x[k] - pole[0], walls.y[k] - pole[1]];
        let arms = || (0..walls.len()).map(arm);
        let centre = [0, 1].map(|c| arms().map(|r| r[c]).sum::<f64>() / n);
        let swirl: f64 = arms().map(|r| (r[0] - centre[0]).powi(2) + (r[1] - centre[1]).powi(2)).sum();
        let even = total.force.map(|f| f / n);
        let rest = (total.moment - (centre[0] * total.force[1] - centre[1] * total.force[0])) / swirl;
        arms().map(|r| [even[0] - rest * (r[1] - centre[1]), even[1] + rest * (r[0] - centre[0])]).collect()
    }
}
