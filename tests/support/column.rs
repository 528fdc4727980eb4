//! A piston under a column of real water, which it meets once a window: explicit coupling of any step (THEORY CO11).

use sph_core::{Breakdown, Fluid, Periodic, WallPoint, Walls};

use crate::bare::{lattice, parameters};
use crate::parameters::Parameters;

/// Height of the column [m].
pub const HEIGHT: f64 = 1.0;
/// Speed of sound [m/s].
pub const SOUND: f64 = 30.0;
const WATER: f64 = 1000.0;
const GRAVITY: f64 = 1.0;
const ROWS: usize = 20;
const COLUMNS: usize = 8;

/// The column, its piston for a floor.
pub struct Column {
    fluid: Fluid,
    walls: Walls,
    /// Mass of the piston per area [kg/m²].
    mass: f64,
    place: f64,
    velocity: f64,
    /// The piston's acceleration over the next window [m/s²].
    pub acceleration: f64,
}

impl Column {
    /// A piston of `ratio` = ρL/m, its weight and the water's held up from below, pushed upwards at `velocity` [m/s].
    pub fn new(ratio: f64, velocity: f64) -> Column {
        let spacing = HEIGHT / ROWS as f64;
        let width = COLUMNS as f64 * spacing;
        let parameters = Parameters {
            gravity: [0.0, -GRAVITY],
            periodic: Some(Periodic { x: Some([0.0, width]), y: None }),
            ..parameters(SOUND)
        };
        let point = |k: usize| {
            let depth = ((k / COLUMNS) as f64 + 0.5) * spacing;
            let at = [((k % COLUMNS) as f64 + 0.5) * spacing, -depth];
            WallPoint {
                at,
                normal: [0.0, 1.0],
                area: spacing * spacing,
                spacing,
                depth,
                outline: Default::default(),
                midline: None,
            }
        };
        let points: Vec<WallPoint> = (0..3 * COLUMNS).map(point).collect();
        let mut walls = Walls::default();
        walls.extend(&points, parameters.smoothing_ratio);
        let pressure = |y: f64| WATER * GRAVITY * (HEIGHT - y);
        let seeds = lattice([0.0; 2], [width, HEIGHT], spacing, |at| Some(([0.0; 2], pressure(at[1]))));
        let mass = WATER * HEIGHT / ratio;
        Column { fluid: parameters.fluid(&seeds), walls, mass, place: 0.0, velocity, acceleration: 0.0 }
    }

    /// One window of `dt` [s] in as many equal steps of the water as it needs, the piston's acceleration held; then the
    /// piston's next one, from the mean force.
    pub fn window(&mut self, dt: f64) -> Result<(), Breakdown> {
        if self.fluid.steps() == 0 {
            self.fluid.initialise(&mut self.walls)?;
        }
        let stable = 0.55 * 1.5 * (HEIGHT / ROWS as f64) / SOUND;
        let steps = (dt / stable).ceil();
        let (step, mut impulse) = (dt / steps, 0.0);
        for _ in 0..steps as usize {
            let moved = step * (self.velocity + 0.5 * step * self.acceleration);
            self.walls.y.iter_mut().for_each(|y| *y += moved);
            self.walls.v.fill(moved / step);
            self.walls.ay.fill(self.acceleration);
            self.fluid.step(&mut self.walls, step)?;
            self.place += moved;
            self.velocity += step * self.acceleration;
            impulse += step * self.walls.mean_fy.iter().sum::<f64>();
        }
        let width = HEIGHT * COLUMNS as f64 / ROWS as f64;
        self.acceleration = (impulse / (dt * width) + WATER * GRAVITY * HEIGHT) / self.mass;
        Ok(())
    }
}
