//! A box of a twentieth of the water's density, under the water or above it, and how it comes to rest.

use fsi_coupling::Coupled;

use crate::statistics::mean;
use crate::systems::{advance, system};

/// Breadth of the box [m].
pub const BREADTH: f64 = 0.1;
/// Its height [m].
pub const HEIGHT: f64 = 0.4;
/// Its draught at rest [m]: its density is a twentieth of the water's.
pub const DRAUGHT: f64 = HEIGHT / 20.0;

/// The box with its centre at a height [m] over the still water, in a tank 0.4 m wide; more overrides in `sets`.
pub fn light_box(centre: f64, depth: f64, spacing: f64, sets: &[&str]) -> Coupled {
    let mass = 1000.0 * BREADTH * DRAUGHT;
    let own = [
        format!("body.breadth={BREADTH}"),
        format!("body.height={HEIGHT}"),
        format!("body.mass={mass}"),
        format!("body.position=[0.0, {centre}]"),
        format!("resolution.spacing={spacing}"),
        format!("tank.depth={depth}"),
        format!("tank.height={}", depth + 0.5),
        "tank.width=0.4".into(),
        "body.free=[\"x\", \"y\"]".into(),
        "fluid.sound_speed=20".into(),
    ];
    let sets: Vec<&str> = own.iter().map(String::as_str).chain(sets.iter().copied()).collect();
    system("floating_box", &sets)
}

/// Level of the water next to the box [m]: that at which a uniform layer over the floor has the same mean height.
fn level(system: &Coupled, box_at: f64, depth: f64, spacing: f64) -> f64 {
    let p = system.fluid.particles();
    let aside = |k: &usize| (p.x[*k] - box_at).abs() > 0.5 * BREADTH + 2.0 * spacing;
    let heights: Vec<f64> = (0..p.len()).filter(aside).map(|k| p.y[k]).collect();
    2.0 * mean(&heights) + depth
}

/// How a box came to rest.
pub struct Settled {
    /// Mean draught over the last part of the run [m].
    pub draught: f64,
    /// Largest deviation from it then [m].
    pub swing: f64,
    /// Least draught then [m]: negative where it left the water.
    pub least: f64,
    /// Largest acceleration of the whole run [m/s²].
    pub wildest: f64,
}

/// Step until `end` [s]; the draught is that `from` [s] on.
pub fn settle(system: &mut Coupled, depth: f64, spacing: f64, [from, end]: [f64; 2]) -> Settled {
    let (mut draughts, mut wildest) = (Vec::new(), 0.0_f64);
    advance(system, end, |s| {
        let motion = s.bodies().find_map(|body| body.motion()).expect("a box");
        wildest = wildest.max(motion.acceleration[0].hypot(motion.acceleration[1]));
        if s.fluid.time() >= from {
            let [x, y] = motion.position;
            draughts.push(level(s, x, depth, spacing) - (y - 0.5 * HEIGHT));
        }
    })
    .expect("a stable run");
    let draught = mean(&draughts);
    let swing = draughts.iter().map(|d| (d - draught).abs()).fold(0.0, f64::max);
    let least = draughts.iter().copied().fold(f64::INFINITY, f64::min);
    Settled { draught, swing, least, wildest }
}
