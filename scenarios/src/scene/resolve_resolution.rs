//! `[resolution]`: spacings, where they are fine, and whether that place follows the body.

use super::file::ResolutionFile;
use super::impact::Entry;
use super::model::{Body, Fluid, Integrator, Lattice, Resolution, Solver, WallModel};
use super::problem::{Problem, positive, within};
use fsi_coupling::Shape;

/// What a fine zone that grows depends on.
pub(super) struct Grown<'a> {
    pub solver: Solver,
    pub fluid: &'a Fluid,
    pub entry: Option<&'a Entry>,
    pub body: Option<&'a Body>,
}

pub(super) fn resolve_resolution(
    file: &ResolutionFile,
    spacing: f64,
    fine_zone: [f64; 2],
    snug: bool,
    grown: &Grown,
) -> Result<Resolution, Problem> {
    for length in fine_zone {
        positive("resolution.fine_zone", length)?;
    }
    let growth = within("resolution.growth", file.growth.unwrap_or(1.1), 1.0..=2.0)?;
    let lattice = file.lattice.unwrap_or_default();
    if lattice == Lattice::Staggered && growth != 1.0 {
        let expected = format!("\"square\" with resolution.growth = {growth}: a staggered lattice needs growth = 1");
        return Err(Problem::new("resolution.lattice", "\"staggered\"", expected));
    }
    let follow = match (file.follow, grown.obstacle(growth)) {
        (Some(true), Some(obstacle)) => return Err(Problem::new("resolution.follow", true, obstacle)),
        (Some(follow), _) => follow,
        (None, obstacle) => obstacle.is_none() && file.fine_zone.is_none() && grown.is_usual(),
    };
    Ok(Resolution { spacing, growth, fine_zone, lattice, packing: file.packing.unwrap_or(snug), follow })
}

impl Grown<'_> {
    /// Why the zone cannot grow (THEORY E26): what would be expected in the place of `true`.
    fn obstacle(&self, growth: f64) -> Option<&'static str> {
        let thin = self.body.is_some_and(|body| matches!(body.shape, Shape::Polyline { .. }));
        [
            (self.entry.is_none(), "false where no body enters the water"),
            (growth == 1.0, "false with resolution.growth = 1: all the water is fine"),
            (thin, "false with a polyline, whose sides see different water"),
            (self.solver != Solver::WeaklyCompressible, "false with this solver: only \"weakly_compressible\" halves particles"),
            (self.fluid.gas().is_some(), "false with an ideal gas: halves get their pressures from Tait's equation"),
            (
                self.fluid.integrator != Integrator::Symplectic,
                "false with this fluid.integrator: \"symplectic\" is the one that keeps nothing of a particle from step to step",
            ),
            (
                self.fluid.walls != WallModel::Extrapolated,
                "false with these fluid.walls: only \"extrapolated\" ones are seen before a particle is halved into them",
            ),
        ]
        .into_iter()
        .find_map(|(stands, expected)| stands.then_some(expected))
    }

    /// The zone grows unless told otherwise: beside rigid bodies.
    fn is_usual(&self) -> bool {
        self.body.is_some_and(|body| body.panels.is_empty())
    }
}
