//! The water of a scene at t = 0.

use fsi_coupling::geometry::layout::{self, Cell};
use fsi_coupling::geometry::packing::{self, Packing};
use fsi_coupling::{Arrangement, CouplingError, WettedBody};
use sph_core::{Seed, Walls};

use crate::build::{body, is_thin, parameters, tank, tiling};
use crate::scene::{Scene, Symmetry};

/// Water is filled in up to this share of half a cell beside a thin plate: a plate amid the cells' edges then displaces none.
const BESIDE_PLATE: f64 = 0.5;

/// Water at rest under its own weight, level or not (THEORY Q1), and a block of it in the air (Q2), without what the body
/// displaces; packed round the body where the scene asks (Q6).
pub(crate) fn fill(scene: &Scene, body: Option<&dyn WettedBody>) -> Result<Vec<Seed>, CouplingError> {
    let weight = scene.water().density * scene.gravity[1];
    let share = if scene.body.as_ref().is_some_and(|b| is_thin(scene, b)) { BESIDE_PLATE } else { 1.0 };
    let has_room = |cell: &Cell| {
        let room = 0.5 * cell.area().sqrt() * (1.0 - 1e-6);
        body.is_none_or(|b| b.clearance(cell.at) >= share * room)
    };
    let surface = scene.tank.surface();
    let level = |x: f64| surface.as_ref().map_or(0.0, |surface| surface.mean(x, x));
    let mut seeds = Vec::new();
    if let (true, Some(body)) = (scene.resolution.packing, body) {
        let still = |cell: Cell| {
            let pressure = weight * (cell.at[1] - level(cell.at[0]));
            Seed { at: cell.at, velocity: [0.0; 2], area: cell.area(), pressure }
        };
        seeds.extend(packed(scene, body, level)?.into_iter().map(still));
    } else {
        tiling(scene).for_each(|cell| {
            let (cell, rise) = surface.as_ref().map_or((cell, 0.0), |surface| surface.lift(cell));
            if has_room(&cell) {
                let pressure = weight * (cell.at[1] - rise);
                seeds.push(Seed { at: cell.at, velocity: [0.0; 2], area: cell.area(), pressure });
            }
        });
    }
    if let Some(block) = scene.tank.block() {
        layout::tile(block.from, block.to, scene.resolution.spacing, |cell| {
            if has_room(&cell) {
                seeds.push(Seed { at: cell.at, velocity: block.velocity, area: cell.area(), pressure: 0.0 });
            }
        });
    }
    Ok(seeds)
}

/// The cells of the tank's water, packed round the body.
fn packed(scene: &Scene, around: &dyn WettedBody, level: impl Fn(f64) -> f64) -> Result<Vec<Cell>, CouplingError> {
    let (parameters, surface) = (parameters(scene), scene.tank.surface());
    let (arrangement, layers) = Arrangement::of(&parameters);
    let mut walls = Walls::default();
    // a body is sampled once in its life: these are another body and tank, in the same places
    for mut bound in body(scene)?.into_iter().chain([Box::new(tank(scene)) as Box<dyn WettedBody>]) {
        bound.arrange(arrangement);
        let range = walls.extend(&bound.sample(scene.resolution.spacing, layers)?, parameters.smoothing_ratio);
        bound.place(0.0, walls.slice_mut(range));
    }
    let mut cells = Vec::new();
    tiling(scene).for_each(|cell| cells.push(surface.as_ref().map_or(cell, |surface| surface.lift(cell).0)));
    let mut cells = packing::choose(cells, around);
    let packing = Packing {
        body: around,
        walls: &walls,
        kernel: parameters.kernel,
        ratio: parameters.smoothing_ratio,
        mirrored: scene.symmetry == Symmetry::X,
    };
    packing.settle(&mut cells, level);
    Ok(cells)
}

#[cfg(test)]
mod tests {
    use crate::build;
    use crate::scene;
    use fsi_coupling::geometry::polygon;

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
        let scene = scene::load("floating_box", &sets.map(String::from)).expect("a built-in scene").scene;
        let system = build::build(&scene).expect("a box under water");
        let (p, w) = (&system.fluid.particles, &system.walls);
        let body = system.bodies().find(|b| b.outline().is_some()).expect("a box");
        let kernel = system.fluid.parameters.kernel;
        let near = |k: &usize| body.clearance([p.x[*k], p.y[*k]]) < 0.075 && p.y[*k] < -0.1;
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
        let scene = scene::load("floating_box", &[]).expect("a built-in scene").scene;
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
        let scene = scene::load("heaving_box", &sets.map(String::from)).expect("a built-in scene").scene;
        assert!(scene.resolution.packing && scene.symmetry == crate::scene::Symmetry::X);
        let system = build::build(&scene).expect("a box afloat");
        assert!(system.fluid.particles.x.iter().all(|&x| x > 0.0));
        assert!(system.penetration().worst.is_none());
    }
}
