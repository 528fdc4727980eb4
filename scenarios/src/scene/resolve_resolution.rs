//! `[resolution]`: the defaults of packing and refinement tracking, and what they exclude.

use fsi_coupling::Shape;
use fsi_coupling::settings::Problem;
use sph_core::legacy::settings::{EquationOfState, Options};
use sph_core::{Integrator, WallModel};

use super::draft::Draft;
use super::impact::Entry;
use super::settings::{Body, Lattice, Resolution, SolverSettings};

/// What decides whether the fine zone can grow.
pub(super) struct Growth<'a> {
    pub solver: &'a SolverSettings,
    pub entry: Option<&'a Entry>,
    pub body: Option<&'a Body>,
    /// The scene leaves the fine zone to the program.
    pub automatic: bool,
}

pub(super) fn resolve_resolution(draft: &mut Draft, growth: &Growth) -> Result<(), Problem> {
    let is_plate = |body: &Body| matches!(body.shape, Shape::Polyline { .. });
    let plate = growth.body.is_some_and(is_plate);
    if plate && draft.get("resolution.packing") == Some(true) {
        let expected = "false with a polyline, beside which there is room anyhow";
        return Err(Problem::new("resolution.packing", true, expected));
    }
    draft.fill("resolution.packing", growth.solver.is_incompressible() && growth.body.is_some() && !plate);
    let asked: Option<bool> = draft.get("resolution.follow");
    draft.fill("resolution.follow", false);
    let resolution: Resolution = draft.read("resolution")?;
    for length in resolution.fine_zone {
        if length <= 0.0 {
            return Err(Problem::new("resolution.fine_zone", length, "a finite number above 0"));
        }
    }
    if resolution.lattice == Lattice::Staggered && resolution.growth != 1.0 {
        let expected =
            format!("\"square\" with resolution.growth = {}: a staggered lattice needs growth = 1", resolution.growth);
        return Err(Problem::new("resolution.lattice", "\"staggered\"", expected));
    }
    match (asked, growth.obstacle(resolution.growth)) {
        (Some(true), Some(obstacle)) => Err(Problem::new("resolution.follow", true, obstacle)),
        (Some(_), _) => Ok(()),
        (None, obstacle) => {
            let rigid = growth.body.is_some_and(|body| body.panels.is_empty());
            draft.set("resolution.follow", obstacle.is_none() && growth.automatic && rigid);
            Ok(())
        }
    }
}

impl Growth<'_> {
    /// Why the zone cannot grow (THEORY WC21): what is expected instead of `true`.
    fn obstacle(&self, growth: f64) -> Option<&'static str> {
        let thin = self.body.is_some_and(|body| matches!(body.shape, Shape::Polyline { .. }));
        let options = self.solver.weakly_compressible().map(|fluid| fluid.options);
        let has = |differs: fn(&Options) -> bool| options.as_ref().is_some_and(differs);
        [
            (self.entry.is_none(), "false where no body enters the water"),
            (growth == 1.0, "false with resolution.growth = 1: all the water is fine"),
            (thin, "false with a polyline, whose sides see different water"),
            (self.solver.is_incompressible(), "false with this solver: only \"weakly_compressible\" splits particles"),
            (
                has(|options| options.equation_of_state == EquationOfState::IdealGas),
                "false with an ideal gas: split particles get their pressures from Tait's equation",
            ),
            (
                has(|options| options.integrator != Integrator::Symplectic),
                "false with this fluid.integrator: only \"symplectic\" keeps nothing of a particle between steps",
            ),
            (
                has(|options| options.walls != WallModel::Extrapolated),
                "false with these fluid.walls: only \"extrapolated\" ones are checked before a particle is split into them",
            ),
        ]
        .into_iter()
        .find_map(|(stands, expected)| stands.then_some(expected))
    }
}
