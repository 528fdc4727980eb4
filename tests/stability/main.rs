//! Stability: where the method fails. Each known failure is asserted, with its remedy. Where a failure
//! no longer occurs, its test fails, and is then to be reversed.

mod beams;
mod bodies;
mod coupling;
mod courant;
mod flicker;
mod host;
mod maps;
mod noise;
mod options;
mod order;
mod panels;
mod projection_bodies;
mod schemes;
mod surfacing;
mod thesis_projection;
mod thin_walls;
mod walls;
mod water;
mod windows;
