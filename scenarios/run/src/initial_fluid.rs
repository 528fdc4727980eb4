//! The water of a scene at t = 0.

use fsi_coupling::geometry::layout::{Cell, Layout, tile};
use fsi_coupling::geometry::packing::{self, Packing};
use fsi_coupling::{Body, PlacedBodies};
use scene::Scene;
use sph_core::{Domain, Seed};

/// Water at rest under its own weight, level or not (THEORY WC19), and a block of it in the air (WC18), without the water that bodies
/// displace; packed around them where the scene asks for it (WC20). `thin`: a body is a thin plate.
pub(crate) fn initial_fluid(
    scene: &Scene,
    domain: &Domain,
    layout: &Layout,
    placed: &PlacedBodies,
    thin: bool,
) -> Vec<Seed> {
    let bodies: Vec<&dyn Body> = placed.bodies().take(scene.all_bodies().count()).collect();
    let distance = |at: [f64; 2]| bodies.iter().map(|body| body.signed_distance(at)).fold(f64::INFINITY, f64::min);
    let weight = scene.water().density * scene.gravity[1];
    let is_free = |cell: &Cell| distance(cell.at) >= cell.clearance(thin);
    let surface = scene.tank.surface();
    let level = |x: f64| surface.as_ref().map_or(0.0, |surface| surface.mean(x, x));
    // cells with the height of the surface above them
    let mut cells = Vec::new();
    layout.for_each(|cell| cells.push(surface.as_ref().map_or((cell, 0.0), |surface| surface.lift(cell))));
    if scene.resolution.packing && !bodies.is_empty() {
        let cells_only = cells.into_iter().map(|(cell, _)| cell).collect();
        cells = packed(cells_only, domain, placed, &distance, level);
    } else {
        cells.retain(|(cell, _)| is_free(cell));
    }
    let at_rest = |(cell, height): (Cell, f64)| Seed {
        at: cell.at,
        velocity: [0.0; 2],
        area: cell.area(),
        pressure: weight * (cell.at[1] - height),
    };
    let mut seeds: Vec<Seed> = cells.into_iter().map(at_rest).collect();
    if let Some(block) = scene.tank.block() {
        tile(block.from, block.to, scene.resolution.spacing, |cell| {
            if is_free(&cell) {
                seeds.push(Seed { at: cell.at, velocity: block.velocity, area: cell.area(), pressure: 0.0 });
            }
        });
    }
    seeds
}

/// The cells packed around bodies, each with the height of the surface above it.
fn packed(
    cells: Vec<Cell>,
    domain: &Domain,
    placed: &PlacedBodies,
    signed_distance: &impl Fn([f64; 2]) -> f64,
    level: impl Fn(f64) -> f64,
) -> Vec<(Cell, f64)> {
    let mut cells = packing::choose(cells, signed_distance);
    let packing = Packing {
        signed_distance,
        walls: placed.walls(),
        kernel: domain.fluid.kernel,
        ratio: domain.fluid.smoothing_ratio,
        mirrored: domain.mirror.is_some(),
    };
    packing.relax(&mut cells, &level);
    cells.into_iter().map(|cell| (cell, level(cell.at[0]))).collect()
}

#[cfg(test)]
mod tests {
    use fsi_coupling::geometry::polygon;

    use crate::build;

    /// Σ V W of the fluid particles within 3 spacings of the body and 4 below the surface: smallest and largest [-]; and the
    /// water's area [m²].
    fn fillings(packing: bool) -> ([f64; 2], f64) {
        let sets = [
            "body.position=[0.03, -0.4]",
            "body.angle_deg=30",
            "body.motion=fixed",
            "resolution.spacing=0.025",
            "resolution.growth=1",
            "tank.width=1.4",
            "tank.depth=0.8",
            &format!("resolution.packing={packing}"),
        ];
        let scene = crate::load("floating_box", &sets.map(String::from)).expect("a built-in scene").scene;
        let system = build::build(&scene).expect("a box under water");
        let (p, w) = (system.fluid.particles(), &system.walls);
        let body = system.bodies().find(|b| b.outline().is_some()).expect("a box");
        let kernel = system.fluid.domain().fluid.kernel;
        let near = |k: &usize| body.signed_distance([p.x[*k], p.y[*k]]) < 0.075 && p.y[*k] < -0.1;
        let fill = |k: usize| {
            let value = |x: f64, y: f64, h: f64| kernel.value((p.x[k] - x).hypot(p.y[k] - y), 0.5 * (p.h[k] + h));
            let water: f64 = (0..p.len()).map(|j| p.mass[j] / p.rho[j] * value(p.x[j], p.y[j], p.h[j])).sum();
            water + (0..w.len()).map(|j| w.volume[j] * value(w.x[j], w.y[j], w.h[j])).sum::<f64>()
        };
        let all: Vec<f64> = (0..p.len()).filter(near).map(fill).collect();
        let area = (0..p.len()).map(|k| p.mass[k] / p.rho[k]).sum();
        let extremes = [all.iter().copied().fold(f64::MAX, f64::min), all.iter().copied().fold(0.0, f64::max)];
        assert!(all.len() > 100, "{} particles beside the box", all.len());
        (extremes, area)
    }

    #[test]
    fn packed_water_fills_the_room_round_a_turned_box() {
        let scene = crate::load("floating_box", &[]).expect("a built-in scene").scene;
        let shape = scene.body.expect("a box").shape;
        let exact = 1.4 * 0.8 - polygon::signed_area(&shape.outline());
        let ([loose, _], area) = fillings(false);
        println!("as filled: from {loose:.3}, area {:+.4} of a cell", (area - exact) / 0.025_f64.powi(2));
        assert!(loose < 0.9, "gaps beside a turned box: {loose}");
        let ([least, most], area) = fillings(true);
        println!("packed: from {least:.3} to {most:.3}, area {:+.4} of a cell", (area - exact) / 0.025_f64.powi(2));
        assert!(least > 0.96 && most < 1.04, "{least} to {most}");
        assert!((area - exact).abs() < 1.5 * 0.025_f64.powi(2), "{area} m2, exact {exact} m2");
    }

    /// At h/Δx = 2 cells wandered through the plane of symmetry, pushed on by their own images.
    #[test]
    fn packed_water_stays_on_its_side_of_the_plane_of_symmetry() {
        let sets = ["solver=incompressible", "resolution.spacing=0.025", "fluid.smoothing_ratio=2"];
        let scene = crate::load("heaving_box", &sets.map(String::from)).expect("a built-in scene").scene;
        assert!(scene.resolution.packing && scene.symmetry == scene::Symmetry::X);
        let system = build::build(&scene).expect("a box afloat");
        assert!(system.fluid.particles().x.iter().all(|&x| x > 0.0));
        assert!(system.penetration().worst.is_none());
    }
}
