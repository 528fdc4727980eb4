//! Four rules for the force of the fluid on a body, from the same state (THEORY GE8).
//!
//! | rule | what is summed |
//! |---|---|
//! | [`Rule::Reaction`] | the pair forces on every boundary particle: the load of the coupling (FEX_2D) |
//! | [`Rule::FirstRow`] | pressure × normal × length of the boundary particles of the first layer (FEX_2D2) |
//! | [`Rule::Gauss`] | pressure at Gauss points of the outline's sides, as a gauge reads it (FEX_2D3) |
//! | [`Rule::GaussViscous`] | the same with a moving-least-squares pressure, and viscous traction (FEX_2D4) |
//!
//! The names in brackets are the switches of M. Pilorget's thesis (KTH, 2010). Every rule gives loads on the outline's
//! corners, consistent with linear and Hermite shape functions (GE9), whose resultant is the rule's. FEX_2D2 and FEX_2D4 are in
//! `legacy`: they serve the comparison with the thesis.

mod legacy;
pub mod nodal_loads;
mod placed_outline;
mod surface_pressure;

use sph_core::Probe;
use sph_core::walls::Resultant;

pub use surface_pressure::reaction_and_pressure;

use crate::coupling::coupled::Coupled;
use crate::coupling::force_rules::nodal_loads::{Nodal, resultant};
use crate::coupling::force_rules::placed_outline::{PlacedOutline, PointForce};

/// How a force is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Sum of the reactions of the pairs.
    Reaction,
    /// Pressure of the first layer of boundary particles.
    FirstRow,
    /// Gauged pressure at Gauss points.
    Gauss,
    /// Least-squares pressure and viscous traction at Gauss points.
    GaussViscous,
}

/// All rules, in the thesis's order.
pub const RULES: [Rule; 4] = [Rule::Reaction, Rule::FirstRow, Rule::Gauss, Rule::GaussViscous];

impl Rule {
    /// Name in output.
    pub fn name(self) -> &'static str {
        match self {
            Rule::Reaction => "reaction",
            Rule::FirstRow => "first_row",
            Rule::Gauss => "gauss",
            Rule::GaussViscous => "gauss_viscous",
        }
    }
}

/// Load on a body by a rule; on both halves where one is simulated.
#[derive(Clone, Debug)]
pub struct Load {
    /// Force [N/m] and moment about the body frame's origin [N].
    pub resultant: Resultant,
    /// Loads on the outline's corners, through all its loops.
    pub corners: Vec<Nodal>,
}

/// The four rules' loads on body `k` of a system, in the order of [`RULES`]; Gauss points in panels no longer than
/// `panel` [m]. `None` for a body without an outline or a motion: a tank.
pub fn force_rules(system: &Coupled, k: usize, panel: f64) -> Option<[Load; 4]> {
    let body = system.bodies().nth(k)?;
    let outline_now = PlacedOutline::of(system, body)?;
    let reactions = outline_now.nodal_loads(&outline_now.reactions(k));
    let probe = Probe::new(&system.fluid);
    let first_layer = outline_now.nodal_loads(&outline_now.first_layer(k, &probe));
    let gauss = outline_now.integrated(panel, |at, side| outline_now.gauged(&probe, at, side));
    let viscous = outline_now.integrated(panel, |at, side| outline_now.fitted(&probe, at, side));
    Some([reactions, first_layer, gauss, viscous].map(|corners| Load {
        resultant: resultant(&outline_now.corners, &corners, outline_now.motion.position),
        corners,
    }))
}

impl PlacedOutline<'_> {
    /// FEX_2D: the pair forces, where the boundary particles are.
    fn reactions(&self, k: usize) -> Vec<PointForce> {
        let w = &self.system.walls;
        let force_at =
            |j: usize| PointForce { surface: self.above(j), at: [w.x[j], w.y[j]], force: [w.fx[j], w.fy[j]] };
        self.doubled(self.system.range(k).map(force_at).collect())
    }

    /// FEX_2D3: −p n, p as a gauge reads it (GE2); within 2h of a corner the carried mean (GE6).
    fn gauged(&self, probe: &Probe<'_>, at: [f64; 2], n: [f64; 2]) -> [f64; 2] {
        let near = |c: &[f64; 2]| (c[0] - at[0]).hypot(c[1] - at[1]) < self.support;
        let p = match self.sharp.iter().any(near) {
            true => probe.carried(at, self.field),
            false => probe.on_flat_face(at, n, self.field[0] * n[0] + self.field[1] * n[1]),
        };
        [-p * n[0], -p * n[1]]
    }
}
