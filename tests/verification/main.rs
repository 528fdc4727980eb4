//! Verification: what has an exact answer must meet it, and errors must fall at the order the theory says.

mod acoustics;
mod conservation;
mod force_rules;
mod kernel_sums;
mod rigid_body;
mod standing_wave;
mod still_water;
mod symmetry;
mod transfer;
