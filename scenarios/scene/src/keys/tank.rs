//! The tank and the water that it starts with.

use fsi_coupling::geometry::water_surface::WaterSurface;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sph_core::Auto;

use super::waves::{Beach, WaveMaker};

/// The rectangle of water and its walls.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Tank {
    /// Full inner width, x from -width/2 to width/2 (INDAT vlx) [m]. auto: outside acoustic reach of an impact.
    #[schemars(with = "Auto<f64>", extend("exclusiveMinimum" = 0, "x-default" = "auto"))]
    pub width: f64,
    /// Depth of still water, whose surface is y = 0 and whose floor is y = -depth (INDAT h_SWL, ZZMAX) [m]. auto: outside
    /// acoustic reach of an impact.
    #[schemars(with = "Auto<f64>", extend("exclusiveMinimum" = 0, "x-default" = "auto"))]
    pub depth: f64,
    /// Height of the side walls above the floor (INDAT vlz) [m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "1.25 depth, 3 depth for a dam break; 1.25 times the crests of a wave maker"))]
    pub height: f64,
    /// Width of the water at rest from the left wall; less than width for a dam break [m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "width"))]
    pub water_width: f64,
    /// Amplitude of the wave that the water starts with, at rest and with the pressure of its depth [m]. A cosine between the
    /// walls, its crest (where positive) at the left wall; no more than half the depth.
    #[serde(default)]
    pub surface_amplitude: f64,
    /// Half waves of surface_amplitude between the walls [-].
    #[serde(default = "one")]
    #[schemars(range(min = 1), extend("x-when" = ".surface_amplitude"))]
    pub surface_mode: u32,
    /// Tilt of the surface that the water starts with, upwards to the right [deg]. It is the thesis's tank out of equilibrium,
    /// whose INDAT has no switch: IPART places the particles.
    #[serde(default)]
    #[schemars(range(min = -45.0, max = 45.0))]
    pub surface_tilt_deg: f64,
    /// Lower left corner x, y of a block of water in the air, at or above the surface [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub block_from: Option<[f64; 2]>,
    /// Its upper right corner x, y [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-default" = "required with block_from"))]
    pub block_to: Option<[f64; 2]>,
    /// Velocity x, y of that block at t = 0 [m/s].
    #[serde(default)]
    pub block_velocity: [f64; 2],
    /// The left wall as a piston that makes waves. absent: a wall at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wave_maker: Option<WaveMaker>,
    /// The right end as a beach that absorbs waves. absent: a wall.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beach: Option<Beach>,
}

/// A rectangle of water in the air (THEORY WC18).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// Its lower left corner [m], shape (2).
    pub from: [f64; 2],
    /// Its upper right corner [m], shape (2).
    pub to: [f64; 2],
    /// Its velocity [m/s], shape (2).
    pub velocity: [f64; 2],
}

impl Tank {
    /// The block of water in the air.
    pub fn block(&self) -> Option<Block> {
        let (from, to) = self.block_from.zip(self.block_to)?;
        Some(Block { from, to, velocity: self.block_velocity })
    }

    /// The surface that the water starts with; `None` where it is level.
    pub fn surface(&self) -> Option<WaterSurface> {
        let (amplitude, slope) = (self.surface_amplitude, self.surface_tilt_deg.to_radians().tan());
        let x = [-0.5 * self.width, 0.5 * self.width];
        let surface = WaterSurface { x, depth: self.depth, amplitude, mode: self.surface_mode, slope };
        (amplitude != 0.0 || slope != 0.0).then_some(surface)
    }

    /// The highest that the water starts above still water, at most [m].
    pub fn rise(&self) -> f64 {
        self.surface().map_or(0.0, |surface| surface.largest())
    }

    /// Height that water may fall through, from the highest at the start to the floor [m].
    pub fn fall(&self) -> f64 {
        self.depth + self.block().map_or(self.rise(), |block| block.to[1].max(self.rise()))
    }

    /// True where the water reaches from wall to wall and none is above it.
    pub fn is_full(&self) -> bool {
        self.water_width >= self.width && self.block().is_none()
    }

    /// True for level water between a wave maker and a wall.
    pub fn is_wave_tank(&self) -> bool {
        self.wave_maker.is_some() && self.is_full() && self.surface().is_none()
    }

    /// Speed of the block of water at the start [m/s]; 0 where there is none.
    pub fn block_speed(&self) -> f64 {
        self.block().map_or(0.0, |block| block.velocity[0].hypot(block.velocity[1]))
    }
}

fn one() -> u32 {
    1
}
