//! `splashdown bench`: how fast this machine is, how fast the steps are on it, and where their time goes; as ratios within one
//! run wherever that is possible, since seconds of a busy machine mean little.
//!
//! `calibrate` measures the machine, `block` a block of fluid without walls, `runs` whole runs, `words` is the table.

mod block;
mod calibrate;
mod error;
mod runs;
mod words;

use std::time::Duration;

use serde::Serialize;

pub use block::{Block, Memory, Speedup};
pub use calibrate::{Calibration, OneAndAll, calibrate};
pub use error::BenchError;
pub use runs::{Column, LogCost};
pub use words::in_words;

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    name: &'static str,
    /// Particles and steps of each block.
    blocks: &'static [(usize, usize)],
    /// Particles and steps of what one thread and two do by turns.
    speedup: (usize, usize),
    /// Simulated [s] and wall time that a dam break ends with.
    column: (f64, Duration),
    /// Simulated time of the dam break whose log is measured [s], spacing of the wedge whose log is, if not its own [m], and turns.
    log: (f64, Option<f64>, usize),
}

impl Extent {
    /// About twenty seconds.
    pub const QUICK: Extent = Extent {
        name: "quick",
        blocks: &[(10_000, 60), (200_000, 6)],
        speedup: (50_000, 6),
        column: (0.05, Duration::from_secs(3)),
        log: (0.006, Some(0.006), 2),
    };
    /// Minutes.
    pub const FULL: Extent = Extent {
        name: "full",
        blocks: &[(10_000, 600), (200_000, 36), (1_000_000, 12)],
        speedup: (200_000, 12),
        column: (0.5, Duration::from_secs(3600)),
        log: (0.1, None, 3),
    };
}

/// What was measured.
#[derive(Clone, Debug, Serialize)]
pub struct Bench {
    /// Version of the program.
    pub version: &'static str,
    /// `quick` or `full`.
    pub extent: &'static str,
    /// Threads of the machine, or those that were asked for.
    pub threads: usize,
    /// What the machine can do.
    pub calibration: Calibration,
    /// Blocks of fluid on one thread.
    pub blocks: Vec<Block>,
    /// Two threads against one; absent where there is only one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speedup: Option<Speedup>,
    /// What a particle takes.
    pub memory: Memory,
    /// The dam break, by solver.
    pub columns: Vec<Column>,
    /// What the log costs.
    pub log: Vec<LogCost>,
}

/// Measure; `tell` is called before each part with its name.
pub fn measure(extent: &Extent, tell: impl Fn(&str)) -> Result<Bench, BenchError> {
    let threads = rayon::current_num_threads();
    tell("memory and arithmetic of this machine");
    let calibration = calibrate(threads);
    let mut blocks = Vec::new();
    for &(particles, steps) in extent.blocks {
        tell(&format!("a block of {particles} particles"));
        blocks.extend(block::blocks(particles, steps)?);
    }
    tell("one thread and two");
    let (particles, steps) = extent.speedup;
    let (speedup, memory) = block::speedup(particles, steps)?;
    let (end, most) = extent.column;
    let mut columns = Vec::new();
    for solver in ["weakly_compressible", "incompressible"] {
        tell(&format!("a dam break, {solver}"));
        columns.push(runs::column(solver, end, most)?);
    }
    tell("runs with their log and without");
    let (end, spacing, turns) = extent.log;
    let log = vec![runs::log_of_column(end, turns)?, runs::log_of_builtin("wedge", spacing, turns)?];
    Ok(Bench {
        version: env!("CARGO_PKG_VERSION"),
        extent: extent.name,
        threads,
        calibration,
        blocks,
        speedup: (threads > 1).then_some(speedup),
        memory,
        columns,
        log,
    })
}
