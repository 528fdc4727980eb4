//! The size of the work, before any particle exists.

use fsi_coupling::geometry::polygon;

use super::keys::{Scene, Symmetry};
use super::legacy::wall_rows;

/// Memory per particle of a run [bytes]: 242 for state, scratch and neighbour lists (`bench`), the rest while the water is
/// laid out and for what the log and the report keep; 430 measured between runs of 87 000 and 334 000 particles.
pub const BYTES_PER_PARTICLE: u64 = 450;

/// Panels of the integrals over shells of graded rows and along walls.
const PANELS: u32 = 2000;

/// Estimated numbers of particles, `(fluid, wall)`, to a few per cent. Pure arithmetic: allocates nothing that grows
/// with them.
///
/// Fluid: the sum of area over spacing² over the shells around the fine zone, with the spacing dx + (growth − 1) d at
/// distance d [m]; water that the body displaces is counted. Walls: length over spacing times the rows that fill the
/// kernel's support, ⌈2 h/dx⌉, along the floor, the side walls and the body.
pub fn particle_estimate(scene: &Scene) -> (u64, u64) {
    ((fluid_particles(scene) + block_particles(scene)).ceil() as u64, wall_particles(scene).ceil() as u64)
}

/// Estimated memory of a run [bytes]: [`BYTES_PER_PARTICLE`] for each particle of [`particle_estimate`].
pub fn memory_estimate(scene: &Scene) -> u64 {
    let (fluid, wall) = particle_estimate(scene);
    fluid.saturating_add(wall).saturating_mul(BYTES_PER_PARTICLE)
}

fn fluid_particles(scene: &Scene) -> f64 {
    let spacing = scene.resolution.spacing;
    let slope = scene.resolution.growth - 1.0;
    let [left, right] = scene.water_sides();
    if slope == 0.0 {
        return (right - left) * scene.tank.depth / (spacing * spacing);
    }
    let [half_width, fine_depth] = scene.resolution.fine_zone;
    let middle = scene.fine_zone_center();
    let area_within = |distance: f64| {
        let x = (middle - half_width - distance).max(left)..(middle + half_width + distance).min(right);
        (x.end - x.start).max(0.0) * (fine_depth + distance).min(scene.tank.depth)
    };
    let beside = (middle - left).max(right - middle) - half_width;
    let reach = beside.max(scene.tank.depth - fine_depth).max(0.0);
    // Equal panels of ln(spacing): rows, as it were.
    let growth = (1.0 + slope * reach / spacing).powf(1.0 / f64::from(PANELS));
    let mut particles = area_within(0.0) / (spacing * spacing);
    let (mut distance, mut row) = (0.0, spacing);
    for _ in 0..PANELS {
        let next_row = row * growth;
        let next = (next_row - spacing) / slope;
        particles += (area_within(next) - area_within(distance)) / (row * next_row);
        (distance, row) = (next, next_row);
    }
    particles
}

/// Particles of the block of water in the air.
fn block_particles(scene: &Scene) -> f64 {
    let spacing = scene.resolution.spacing;
    scene.tank.block().map_or(0.0, |b| (b.to[0] - b.from[0]) * (b.to[1] - b.from[1]) / (spacing * spacing))
}

fn wall_particles(scene: &Scene) -> f64 {
    let options = scene.solver.weakly_compressible().map(|fluid| fluid.options).unwrap_or_default();
    let rows = wall_rows(&options, scene.water().smoothing_ratio);
    let half = 0.5 * scene.tank.width;
    let (floor, top) = (-scene.tank.depth, scene.tank.height - scene.tank.depth);
    let right = particles_along(scene, [half, floor], [half, top]);
    let left = particles_along(scene, [-half, floor], [-half, top]);
    let bottom = particles_along(scene, [-half, floor], [half, floor]);
    let perimeter: f64 = scene.all_bodies().map(|body| polygon::perimeter(&body.shape.outline())).sum();
    let body = perimeter / scene.resolution.spacing;
    let single = match scene.symmetry {
        Symmetry::None => left + right + bottom + body,
        Symmetry::X => right + 0.5 * (bottom + body),
    };
    rows * single
}

/// Particles of one row from `a` to `b`: ∫ ds / (dx + (growth − 1) d(s)), d the larger of the distances in x and y from the fine zone.
fn particles_along(scene: &Scene, a: [f64; 2], b: [f64; 2]) -> f64 {
    let slope = scene.resolution.growth - 1.0;
    let ([half_width, depth], middle) = (scene.resolution.fine_zone, scene.fine_zone_center());
    let distance = |at: [f64; 2]| ((at[0] - middle).abs() - half_width).max(-at[1] - depth).max(0.0);
    let panel = (b[0] - a[0]).hypot(b[1] - a[1]) / f64::from(PANELS);
    let at = |i: u32| {
        let s = (f64::from(i) + 0.5) / f64::from(PANELS);
        [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])]
    };
    let spacing = |p| scene.resolution.spacing + slope * distance(p);
    (0..PANELS).map(|i| panel / spacing(at(i))).sum()
}
