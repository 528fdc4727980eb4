//! Water that does not start as a level rectangle (THEORY WC19, WC18): its keys, and what they must fit.

use fsi_coupling::geometry::water_surface::WaterSurface;

use super::settings::{Block, Scene, Symmetry, Tank};
use fsi_coupling::settings::{Problem, significant};

/// Largest rise or fall of the surface over the depth: columns are stretched by as much.
const LARGEST_RISE: f64 = 0.5;

/// Spacings across the smallest block of water.
const SMALLEST_BLOCK: f64 = 4.0;

impl Tank {
    /// The surface that the water starts with; `None` where it is level.
    pub fn surface(&self) -> Option<WaterSurface> {
        let (amplitude, slope) = (self.surface_amplitude, self.surface_tilt_deg.to_radians().tan());
        let x = [-0.5 * self.width, 0.5 * self.width];
        let surface = WaterSurface { x, depth: self.depth, amplitude, mode: self.surface_mode, slope };
        (amplitude != 0.0 || slope != 0.0).then_some(surface)
    }

    /// The highest that the water starts above still water, at most [m].
    fn rise(&self) -> f64 {
        self.surface().map_or(0.0, |surface| surface.largest())
    }

    /// Height that water may fall through, from the highest at the start to the floor [m].
    pub fn fall(&self) -> f64 {
        self.depth + self.block().map_or(self.rise(), |block| block.to[1].max(self.rise()))
    }

    /// Speed of the block of water at the start [m/s]; 0 where there is none.
    pub fn block_speed(&self) -> f64 {
        self.block().map_or(0.0, |block| block.velocity[0].hypot(block.velocity[1]))
    }
}

/// Surface and block fit the tank, and each other.
pub(super) fn check_start(scene: &Scene) -> Result<(), Problem> {
    let tank = &scene.tank;
    if let Some(surface) = tank.surface() {
        let steepest = if tank.surface_amplitude != 0.0 { "surface_amplitude" } else { "surface_tilt_deg" };
        let given = if tank.surface_amplitude != 0.0 { tank.surface_amplitude } else { tank.surface_tilt_deg };
        let (key, largest) = (format!("tank.{steepest}"), LARGEST_RISE * tank.depth);
        if surface.largest() > largest {
            let expected = format!(
                "a surface that rises and falls by no more than {} m, half the depth: this one may by {} m",
                significant(largest),
                significant(surface.largest())
            );
            return Err(Problem::new(&key, given, expected));
        }
        if tank.height < tank.depth + surface.largest() {
            let expected =
                format!("at least {} m, where the water starts", significant(tank.depth + surface.largest()));
            return Err(Problem::new("tank.height", tank.height, expected));
        }
        if tank.water_width < tank.width {
            let expected = format!("tank.width = {} m with a surface that is not level", tank.width);
            return Err(Problem::new("tank.water_width", tank.water_width, expected));
        }
        let half_wave = tank.width / f64::from(tank.surface_mode);
        if tank.surface_amplitude != 0.0 && half_wave < SMALLEST_BLOCK * scene.resolution.spacing {
            let expected = format!("at most one half wave to {SMALLEST_BLOCK} spacings");
            return Err(Problem::new("tank.surface_mode", tank.surface_mode, expected));
        }
        check_symmetric_start(scene)?;
    }
    tank.block().map_or(Ok(()), |block| check_block(scene, &block))
}

/// With a mirror at x = 0 the surface is its own image.
fn check_symmetric_start(scene: &Scene) -> Result<(), Problem> {
    let tank = &scene.tank;
    if scene.symmetry != Symmetry::X {
        return Ok(());
    }
    if tank.surface_tilt_deg != 0.0 {
        return Err(Problem::new("tank.surface_tilt_deg", tank.surface_tilt_deg, "0 with symmetry = \"x\""));
    }
    match tank.surface_mode % 2 {
        0 => Ok(()),
        _ => Err(Problem::new("tank.surface_mode", tank.surface_mode, "an even number with symmetry = \"x\"")),
    }
}

fn check_block(scene: &Scene, block: &Block) -> Result<(), Problem> {
    let (tank, spacing) = (&scene.tank, scene.resolution.spacing);
    let least = SMALLEST_BLOCK * spacing;
    let left = if scene.symmetry == Symmetry::X { 0.0 } else { -0.5 * tank.width };
    let (right, rise, rim) = (0.5 * tank.width, tank.rise(), tank.height - tank.depth);
    let [from, to] = [block.from, block.to];
    if (0..2).any(|k| to[k] - from[k] < least) {
        let least = significant(least);
        let expected =
            format!("at least {SMALLEST_BLOCK} spacings, {least} m, above and right of block_from = {from:?}");
        return Err(Problem::new("tank.block_to", format!("{to:?}"), expected));
    }
    if from[0] < left || from[1] < rise {
        let expected = format!("x of at least {} m and y of at least {} m, where the water below ends", left, rise);
        return Err(Problem::new("tank.block_from", format!("{from:?}"), expected));
    }
    if to[0] > right || to[1] > rim {
        let expected = format!("x of at most {right} m and y of at most {} m, the walls' rim", significant(rim));
        return Err(Problem::new("tank.block_to", format!("{to:?}"), expected));
    }
    match scene.symmetry == Symmetry::X && from[0] == 0.0 && block.velocity[0] != 0.0 {
        true => Err(Problem::new("tank.block_velocity", format!("{:?}", block.velocity), "[0, ...] on the mirror")),
        false => Ok(()),
    }
}
