//! What a scene says of the particles: the water and its space, how it is divided, rows of the boundary.

use fsi_coupling::WallRows;
use fsi_coupling::geometry::layout::{Basin, Layout};
use sph_core::{Domain, Mirror};

use super::follow::Follower;
use super::keys::{Scene, Symmetry};

/// Rows of the boundary particles of a scene.
pub fn rows(scene: &Scene) -> WallRows {
    WallRows::of(scene.solver.scheme(scene.tank.depth).wall_layout(&domain(scene)), scene.resolution.spacing)
}

/// How the water is divided into particles.
pub fn layout(scene: &Scene) -> Layout {
    let x = scene.water_sides();
    let (middle, [half_width, fine_depth]) = match Follower::of(scene) {
        Some(follower) => follower.at_start(),
        None => (scene.fine_zone_center(), scene.resolution.fine_zone),
    };
    let layout = Layout::new(Basin {
        x,
        y: [-scene.tank.depth, 0.0],
        fine_x: [(middle - half_width).max(x[0]), (middle + half_width).min(x[1])],
        fine_depth,
        spacing: scene.resolution.spacing,
        growth: scene.resolution.growth,
    });
    if scene.resolution.follow { layout.with_split_rows() } else { layout.with_lattice(scene.resolution.lattice) }
}

/// The water and the space it moves in.
pub fn domain(scene: &Scene) -> Domain {
    Domain {
        fluid: *scene.water(),
        gravity: scene.gravity,
        mirror: (scene.symmetry == Symmetry::X).then_some(Mirror { at: 0.0 }),
        fastest_speed: scene.projection_speed(),
        starts_level: scene.starts_level(),
        ..Domain::default()
    }
}
