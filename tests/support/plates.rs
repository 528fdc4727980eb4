//! Thin plates in small tanks: systems to step, and the force on each face.

use crate::parameters::Parameters;
use fsi_coupling::RigidMotion;
use fsi_coupling::geometry::layout::{Basin, Layout};
use fsi_coupling::{Body, Coupled, Outline, PrescribedBody, Scheme, Shape, Tank};
use sph_core::Seed;

use crate::bare;

/// Gravity [m/s²].
pub const GRAVITY: f64 = 9.81;
/// Density [kg/m³].
pub const DENSITY: f64 = 1000.0;

/// Parameters of water under gravity with a sound speed [m/s].
pub fn parameters(c0: f64) -> Parameters {
    Parameters { gravity: [0.0, -GRAVITY], ..bare::parameters(c0) }
}

/// Particles of still water, cells of `spacing` [m] from `from` up to `to` [m], at rest under a surface at height `to[1]`.
pub fn still(from: [f64; 2], to: [f64; 2], spacing: f64) -> Vec<Seed> {
    bare::lattice(from, to, spacing, |at| Some(([0.0; 2], DENSITY * GRAVITY * (to[1] - at[1]))))
}

/// A tank with a floor at y = 0 and walls at `x` up to `rim` [m].
pub fn tank(x: [f64; 2], rim: f64, spacing: f64) -> Tank {
    let layout = Layout::new(Basin { x, y: [0.0, rim], fine_x: x, fine_depth: rim, spacing, growth: 1.0 });
    Tank::new(layout, x, 0.0, rim, false)
}

/// The outline of a plate about a middle line [m].
pub fn plate(middle: &[[f64; 2]], thickness: f64) -> Outline {
    Outline::of(&Shape::Polyline { points: middle.to_vec(), thickness }).expect("a sound plate")
}

/// A plate that does not move.
pub fn fixed(outline: Outline) -> Box<dyn Body> {
    Box::new(PrescribedBody::new("plate", outline, false, PrescribedBody::steady([0.0; 2], 0.0, [0.0; 2], 0.0)))
}

/// Bodies (the plate first) and seeds, ready to step.
pub fn coupled(parameters: Parameters, seeds: &[Seed], bodies: Vec<Box<dyn Body>>, spacing: f64) -> Coupled {
    Coupled::new(parameters.fluid(seeds), bodies, Scheme::Weak, spacing).expect("a sound system")
}

/// A plate of `thickness` spacings that parts a tank of 2 × `columns` cells into two waters of `rows` [left, right] cells;
/// it stands on the floor and ends above both.
pub fn separated(thickness: f64, columns: usize, rows: [usize; 2], spacing: f64) -> Coupled {
    separated_by(thickness, columns, rows, spacing, fixed)
}

/// The same with a body made of the plate's outline.
pub fn separated_by(
    thickness: f64,
    columns: usize,
    rows: [usize; 2],
    spacing: f64,
    body: impl Fn(Outline) -> Box<dyn Body>,
) -> Coupled {
    let (half, width) = (0.5 * thickness * spacing, columns as f64 * spacing);
    let [left, right] = rows.map(|n| n as f64 * spacing);
    let high = left.max(right) + 4.0 * spacing;
    let mut seeds = still([-half - width, 0.0], [-half, left], spacing);
    seeds.extend(still([half, 0.0], [half + width, right], spacing));
    let outline = plate(&[[0.0, 0.0], [0.0, high]], 2.0 * half).rooted([4.0 * spacing, 0.0]);
    let c0 = 10.0 * (2.0 * GRAVITY * left.max(right)).sqrt();
    let tank = tank([-half - width, half + width], high, spacing);
    let tank = tank.with_plates(outline.plate().cloned().into_iter().collect());
    coupled(parameters(c0), &seeds, vec![body(outline), Box::new(tank)], spacing)
}

/// Force of the water along x on the left face and on the right face of body 0 [N/m].
pub fn face_forces(system: &Coupled) -> [f64; 2] {
    let (w, mut sum) = (&system.walls, [0.0; 2]);
    for k in system.range(0) {
        sum[usize::from(w.nx[k] > 0.0)] += w.fx[k];
    }
    sum
}

/// A straight plate of `cells` cells' length under water, `turned` [rad] from upright, in a tank of 32 by 24 cells.
pub struct Submerged {
    /// Thickness over spacing.
    pub thickness: f64,
    /// Length over spacing.
    pub cells: f64,
    /// Angle of the plate from upright [rad].
    pub turned: f64,
    /// Spacing [m].
    pub spacing: f64,
}

impl Submerged {
    /// The plate's outline about its middle [m].
    pub fn outline(&self) -> Outline {
        let (sin, cos) = self.turned.sin_cos();
        let half = 0.5 * self.cells * self.spacing;
        plate(&[[half * sin, -half * cos], [-half * sin, half * cos]], self.thickness * self.spacing)
    }

    /// Middle of the plate [m].
    pub fn middle(&self) -> [f64; 2] {
        [0.0, 12.0 * self.spacing]
    }

    /// The water, with `body` in it (the plate, at the middle) before the tank.
    pub fn with(&self, body: Box<dyn Body>, c0: f64) -> Coupled {
        let s = self.spacing;
        let seeds = still([-16.0 * s, 0.0], [16.0 * s, 24.0 * s], s);
        let outside = |seed: &Seed| body.signed_distance(seed.at) > 0.25 * s;
        let seeds: Vec<Seed> = seeds.into_iter().filter(outside).collect();
        let tank = tank([-16.0 * s, 16.0 * s], 30.0 * s, s);
        coupled(parameters(c0), &seeds, vec![body, Box::new(tank)], s)
    }
}

/// By identity, whether each particle is left of the plate that parts a tank, wherever it is now.
pub fn sides(system: &Coupled) -> Vec<bool> {
    let (p, plate) = (system.fluid.particles(), system.walls.midlines.first().map_or(0.0, |s| s.points[0][0]));
    let mut left = vec![false; p.len()];
    (0..p.len()).for_each(|k| left[p.id[k] as usize] = p.x[k] < plate);
    left
}

/// [`separated`], with a plate that is driven to the right by `travel` [m] in half a second and rests there.
pub fn paddled(thickness: f64, columns: usize, rows: [usize; 2], travel: f64, spacing: f64) -> Coupled {
    let law = move |t: f64| {
        let (s, period) = ((t / 0.5).min(1.0), 0.5);
        let moving = if t < period { 1.0 } else { 0.0 };
        RigidMotion {
            position: [travel * s * s * (3.0 - 2.0 * s), 0.0],
            velocity: [moving * travel * 6.0 * s * (1.0 - s) / period, 0.0],
            acceleration: [moving * travel * (6.0 - 12.0 * s) / (period * period), 0.0],
            ..RigidMotion::default()
        }
    };
    let body = |outline| Box::new(PrescribedBody::new("plate", outline, false, Box::new(law))) as Box<dyn Body>;
    separated_by(thickness, columns, rows, spacing, body)
}
