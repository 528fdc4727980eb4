//! Verification: what has an exact answer must meet it, and errors must fall at the order the theory says.

mod acoustics;
mod conservation;
mod echo;
mod gas;
mod gauges;
mod integrators;
mod kernel_sums;
mod options;
mod rigid_body;
mod standing_wave;
mod still_water;
mod study;
mod symmetry;
mod transfer;
