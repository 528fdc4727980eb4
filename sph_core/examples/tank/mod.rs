//! Water, straight walls and the loop of steps, for the examples.
#![allow(dead_code, reason = "no example needs all")]

use sph_core::{Breakdown, Fluid, Seed, WallPoint, Walls};

/// ρ g [Pa/m].
pub const WEIGHT: f64 = 1000.0 * 9.81;

/// Squares of still water from the origin to `[width, height]` [m], under its own weight.
pub fn water([width, height]: [f64; 2], spacing: f64) -> Vec<Seed> {
    let [columns, rows] = [width, height].map(|length| (length / spacing).round() as usize);
    let seed = |k: usize| {
        let at = [k % columns, k / columns].map(|i| (i as f64 + 0.5) * spacing);
        Seed { at, velocity: [0.0; 2], area: spacing * spacing, pressure: WEIGHT * (height - at[1]) }
    };
    (0..columns * rows).map(seed).collect()
}

/// A straight wall with the water on its left as it runs: three rows of particles fill the kernel's support, 2h = 3 spacings.
pub fn wall(from: [f64; 2], to: [f64; 2], spacing: f64) -> Vec<WallPoint> {
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    let along = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    let (normal, columns) = ([-along[1], along[0]], (length / spacing).round() as usize);
    let point = |k: usize| {
        let (s, depth) = (((k % columns) as f64 + 0.5) * spacing, ((k / columns) as f64 + 0.5) * spacing);
        let at = [0, 1].map(|i| from[i] + s * along[i] - depth * normal[i]);
        WallPoint { at, normal, area: spacing * spacing, spacing, depth, outline: Default::default(), midline: None }
    };
    (0..3 * columns).map(point).collect()
}

/// Floor and right wall of a tank, then its left wall, each as an owner of its own.
pub fn tank([width, height]: [f64; 2], spacing: f64) -> Walls {
    let (mut walls, beyond) = (Walls::default(), 3.0 * spacing);
    let mut fixed = wall([-beyond, 0.0], [width + beyond, 0.0], spacing);
    fixed.extend(wall([width, 0.0], [width, height], spacing));
    walls.extend(&fixed, 1.5);
    walls.extend(&wall([0.0, height], [0.0, 0.0], spacing), 1.5);
    walls
}

/// Step until `end` [s]; the last step ends there.
pub fn advance(fluid: &mut Fluid, walls: &mut Walls, end: f64) -> Result<(), Breakdown> {
    while end - fluid.time() > 1e-12 {
        let dt = fluid.stable_dt(walls)?.min(end - fluid.time());
        fluid.step(walls, dt)?;
    }
    Ok(())
}
