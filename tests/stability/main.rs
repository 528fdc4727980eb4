//! Stability: where the method fails. Each known failure is asserted, and its remedy beside it: a failure that stops
//! failing is news, and its test is then to be turned round.

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
