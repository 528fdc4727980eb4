//! The contract of the `splashdown` command, driven as its users drive it: exit codes, messages, files.
//!
//! Exit 0 done, 1 the run failed (what, where, when), 2 the input was wrong (file, line, key, given, expected). The
//! command must be built: `cargo test --workspace --release` builds it before these tests run.

mod command;

mod accuracy;
mod bench;
mod bits;
mod certify;
mod chart;
mod converge;
mod decisions;
mod ditch;
mod documents;
mod endings;
mod files;
mod model;
mod plane;
mod refusals;
mod report;
mod results;
mod stability;
mod study;
