//! Failures at walls: how many rows of wall particles keep water in, and what each kind of wall survives.

use evidence::systems::{advance, scene, system};
use fsi_coupling::fill::{Basin, Tiling};
use fsi_coupling::{Arrangement, Tank, WettedBody};
use scenarios::build;
use sph_core::{Fluid, Seed, WallModel, WallTreatment, Walls};

const SPACING: f64 = 0.05;

/// How a test's wall is made: model, rows, how they lie.
#[derive(Clone, Copy)]
struct Wall {
    model: WallModel,
    layers: usize,
    arrangement: Arrangement,
}

/// Particles outside a tank of 20 by 20 after `end` [s]; the water falls at `speed` [m/s] from the start. Nothing but
/// the walls holds it: no contact with the surface (THEORY E25).
fn leaked(wall: Wall, speed: f64, end: f64) -> usize {
    let (x, floor) = ([-0.5, 0.5], -1.0);
    let tiling = Tiling::new(Basin { x, y: [floor, 0.0], fine_x: x, fine_depth: 1.0, spacing: SPACING, growth: 1.0 });
    let mut parameters = system("hydrostatic_tank", &["resolution.spacing=0.05"]).fluid.parameters;
    parameters.walls = WallTreatment { model: wall.model, ..parameters.walls };
    let mut seeds = Vec::new();
    tiling.for_each(|cell| {
        let pressure = parameters.eos.rho0 * parameters.gravity[1] * cell.at[1];
        seeds.push(Seed { at: cell.at, velocity: [0.0, -speed], area: cell.area(), pressure });
    });
    let mut tank = Tank::new(tiling, x, floor, 0.25, false);
    tank.arrange(wall.arrangement);
    let mut walls = Walls::default();
    walls.extend(&tank.sample(SPACING, wall.layers).expect("a tank"), parameters.smoothing_ratio);
    tank.place(0.0, walls.slice_mut(0..walls.len()));
    let mut fluid = Fluid::new(parameters, &seeds);
    let out = |fluid: &Fluid| {
        let p = &fluid.particles;
        (0..p.len()).filter(|&k| tank.clearance([p.x[k], p.y[k]]) < 0.0).count()
    };
    fluid.initialise(&mut walls).expect("water at rest");
    while fluid.time < end {
        // a leak may end in a breakdown: what is out by then counts
        let Ok(dt) = fluid.stable_dt(&walls) else { break };
        if fluid.step(&mut walls, dt).is_err() {
            break;
        }
    }
    out(&fluid)
}

fn filled(layers: usize) -> Wall {
    Wall { model: WallModel::Extrapolated, layers, arrangement: Arrangement::Filled }
}

fn dynamic(layers: usize) -> Wall {
    Wall { model: WallModel::Dynamic, layers, arrangement: Arrangement::Staggered }
}

/// A wall must fill the kernel's support 2h = 3 spacings. Failure: one row leaks (M. Pilorget 2010 saw the same and
/// doubled it). Remedy: the three rows that every body is sampled with hold every particle.
#[test]
fn a_single_row_of_wall_particles_leaks() {
    let (one, three) = (leaked(filled(1), 0.0, 1.0), leaked(filled(3), 0.0, 1.0));
    assert!(one > 10, "one row let {one} of 400 particles out");
    assert_eq!(three, 0, "three rows let {three} of 400 particles out");
}

#[test]
#[ignore]
fn probe_leaks() {
    for mach in [0.0, 0.05, 0.1, 0.2, 0.3, 0.4] {
        let c0 = system("hydrostatic_tank", &["resolution.spacing=0.05"]).fluid.parameters.eos.c0;
        let n = [dynamic(1), dynamic(2)].map(|w| leaked(w, mach * c0, 0.3));
        println!("c0 {c0} mach {mach}: {n:?}");
    }
}

/// Every wall runs a coarse dam break to its end with nothing beyond a wall and momentum closed to 1e-10.
#[test]
fn every_wall_holds_a_dam_break() {
    for model in ["extrapolated", "repulsive", "dynamic", "mirror_point"] {
        let scene = scene("dam_break", &["resolution.spacing=0.05", &format!("fluid.walls={model}")]);
        let mut system = build::build(&scene).expect("a scene that loads can be built");
        advance(&mut system, scene.time.end, |_| {}).unwrap_or_else(|error| panic!("{model}: {error}"));
        let (out, gap) = (system.penetration().count, system.momentum_audit().worst);
        assert_eq!(out, 0, "{model}: {out} particles beyond a wall");
        assert!(gap < 1e-10, "{model}: momentum off by {gap:.1e} of what was exchanged in a step");
    }
}
