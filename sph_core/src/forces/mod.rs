//! Forces on fluid and walls from the sums over pairs (THEORY WC5–WC7), and the accelerations that follow.
//!
//! [`wall_state`] is what walls take from the fluid (WA3), [`still_pressure`] the pressure of still water (WC29), [`interface_dynamics`]
//! the accelerations of bodies that the forces accelerate (CO4).

pub(crate) mod interface_dynamics;
pub(crate) mod still_pressure;
pub(crate) mod wall_state;

use crate::interactions::dissipation::Dissipation;
use crate::interactions::gather::{ConcentrationGradient, Momentum, MomentumSums, PairSums, VectorSums, WallForce};
use crate::interactions::geometry::PairConstants;
use crate::parallel;
use crate::particles::Particles;
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;

/// Forces on the particles [N/m]. To save memory they occupy the arrays of the accelerations, which are empty meanwhile.
pub(crate) struct Forces {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
}

impl Forces {
    /// Forces to be gathered, in place of the particles' accelerations.
    pub fn in_place_of_accelerations(p: &mut Particles) -> Forces {
        Forces { x: std::mem::take(&mut p.ax), y: std::mem::take(&mut p.ay) }
    }

    /// F ← F + `more` [N/m].
    pub fn add(&mut self, more: &[[f64; 2]]) {
        parallel::update_both(&mut self.x, &mut self.y, |k, x, y| {
            *x += more[k][0];
            *y += more[k][1];
        });
    }

    /// a = F/m + g + f (WC28), in place of F.
    pub fn accelerate(mut self, system: &mut ParticleSystem) {
        system.timers.begin(Phase::Integration);
        let (p, g) = (&mut system.particles, system.domain.gravity);
        parallel::each([&mut self.x, &mut self.y], |at, [ax, ay]| {
            let mass = &p.mass[at.clone()];
            for k in 0..mass.len() {
                ax[k] = ax[k] / mass[k] + g[0];
                ay[k] = ay[k] / mass[k] + g[1];
            }
            let [fx, fy] = p.rest.each_ref().map(|f| if f.is_empty() { &[] } else { &f[at.clone()] });
            for k in 0..fx.len() {
                ax[k] += fx[k];
                ay[k] += fy[k];
            }
        });
        (p.ax, p.ay) = (self.x, self.y);
    }
}

/// What a scheme adds to the pairs of a domain: the constants of its dissipation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairTerms {
    pub constants: PairConstants,
    pub dissipation: Dissipation,
}

/// WC5–WC7 on the fluid, and the kernel moments OP4, OP5, WC10. `walls_push`: walls act by their pressure (WC5).
pub(crate) fn gather_fluid_forces(
    system: &mut ParticleSystem,
    terms: &PairTerms,
    walls_push: bool,
    forces: &mut Forces,
) {
    system.timers.begin(Phase::Momentum);
    let gather = Momentum {
        fluid: &system.packed.fluid,
        walls: &system.packed.walls,
        neighbours: &system.neighbours,
        constants: terms.constants,
        wall_nu: system.domain.fluid.wall_viscosity(),
        walls_push,
    };
    let sums = MomentumSums { x: &mut forces.x, y: &mut forces.y, moments: &mut system.fields.moments };
    PairSums::with(&system.domain, terms.dissipation).run(&gather, sums);
}

/// OP4 of the packed particles [1/m].
pub(crate) fn gather_concentration_gradient(system: &ParticleSystem) -> [Vec<f64>; 2] {
    let n = system.particles.len();
    let mut gradient = [vec![0.0; n], vec![0.0; n]];
    let [x, y] = &mut gradient;
    let ParticleSystem { packed, neighbours, domain, .. } = system;
    let gather = ConcentrationGradient { fluid: &packed.fluid, walls: &packed.walls, neighbours };
    PairSums::of(domain).run_without_dissipation(&gather, VectorSums { x, y });
    gradient
}

/// The same pairs seen from the walls: action equals reaction to rounding.
pub(crate) fn gather_wall_forces(system: &mut ParticleSystem, terms: &PairTerms, walls: &mut Walls) {
    system.timers.begin(Phase::Walls);
    let gather = WallForce {
        fluid: &system.packed.fluid,
        walls: &system.packed.walls,
        neighbours: &system.neighbours,
        constants: terms.constants,
        wall_nu: system.domain.fluid.wall_viscosity(),
    };
    let sums = VectorSums { x: &mut walls.fx, y: &mut walls.fy };
    PairSums::of(&system.domain).run_without_dissipation(&gather, sums);
}
