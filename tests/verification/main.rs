//! Verification: what has an exact answer must meet it, and errors must fall at the order the theory says.

mod acoustics;
mod channel;
mod conservation;
mod coupling;
mod dissipation;
mod echo;
mod elliptic_drop;
mod force_rules;
mod gas;
mod gauges;
mod heaving_box;
mod host;
mod integrators;
mod kernel_sums;
mod options;
mod rigid_body;
mod rotating_patch;
mod standing_wave;
mod still_water;
mod strips;
mod study;
mod symmetry;
mod taylor_green;
mod thin_walls;
mod transfer;
mod wave_maker;
