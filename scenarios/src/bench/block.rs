//! A block of fluid: what a force costs, by the number of particles and by the way the pairs are summed.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::time::Instant;

use serde::Serialize;
use sph_core::{Domain, Fluid, Periodic, Phase, Seed, Walls, parallel, wcsph};

use super::error::BenchError;

/// Speed of sound over that of the vortices.
const SOUND: f64 = 10.0;
/// Distances between particles vary by about this share of the spacing.
const JITTER: f64 = 0.1;
/// Steps that put particles and lists into the state of a run.
const WARM_UP: usize = 2;

/// A way to sum over pairs.
pub(super) struct PairPath {
    pub name: &'static str,
    simd: bool,
    /// Acoustic steps for which pairs are held (THEORY WC22).
    acoustic_steps: u32,
}

/// As a block is stepped by default.
const SIDE_BY_SIDE: PairPath = PairPath { name: "side by side", simd: true, acoustic_steps: 1 };
/// All of them; the first is the reference that the others are measured by.
pub(super) const PATHS: [PairPath; 3] = [
    PairPath { name: "one at a time", simd: false, acoustic_steps: 1 },
    SIDE_BY_SIDE,
    PairPath { name: "split-explicit", simd: true, acoustic_steps: 16 },
];

/// A block that was stepped on one thread.
#[derive(Clone, Debug, Serialize)]
pub struct Block {
    /// Particles.
    pub particles: usize,
    /// Neighbours of each within the kernel, mean.
    pub neighbours: f64,
    /// How pairs were summed.
    pub path: &'static str,
    /// Steps.
    pub steps: usize,
    /// Forces on particles a second on one thread, the whole step counted, of a split-explicit step each acoustic step [1/s].
    pub evaluations_per_core_second: f64,
    /// The same, of its two interactions over pairs alone [1/s].
    pub sweeps_only_per_core_second: f64,
    /// Speed of the whole step over that of the reference path [-].
    pub over_reference: f64,
    /// Where the time of an evaluation went, by phase; phases without time are left out [ns].
    pub phases_ns: BTreeMap<&'static str, f64>,
}

/// The same block with two threads.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Speedup {
    /// Threads.
    pub threads: usize,
    /// Particles.
    pub particles: usize,
    /// Time with one thread over time with these [-].
    pub speedup: f64,
}

/// What a particle takes.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Memory {
    /// Particles.
    pub particles: usize,
    /// Held by state, rows and lists, counted [bytes].
    pub bytes_per_particle: f64,
    /// Most that the process has held so far, where the system reports it [bytes].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_resident_bytes: Option<u64>,
}

/// A doubly periodic box of Taylor & Green's vortices on a jittered lattice of `particles` [about], h/Δx = 1.5.
fn vortices(particles: usize, path: &PairPath) -> Result<Fluid, BenchError> {
    let PairPath { simd, acoustic_steps, .. } = *path;
    let cells = (particles as f64).sqrt().round() as usize;
    let (dx, cell) = (1.0 / cells as f64, Some([0.0, 1.0]));
    let domain = Domain { periodic: Some(Periodic { x: cell, y: cell }), simd, ..Domain::default() };
    let settings = wcsph::Settings {
        sound_speed: SOUND.into(),
        acoustic_steps: acoustic_steps.into(),
        ..wcsph::Settings::default()
    };
    let mut dice = Dice(1);
    let seed = |k: usize| {
        let centre = |i: usize, throw: f64| (i as f64 + 0.5 + JITTER * throw) * dx;
        let [x, y] = [centre(k % cells, dice.throw()), centre(k / cells, dice.throw())];
        let velocity = [-(TAU * x).cos() * (TAU * y).sin(), (TAU * x).sin() * (TAU * y).cos()];
        Seed { at: [x, y], velocity, area: dx * dx, pressure: 0.0 }
    };
    let seeds: Vec<Seed> = (0..cells * cells).map(seed).collect();
    let mut fluid = Fluid::new(domain, &settings, &seeds);
    fluid.initialise(&mut Walls::default())?;
    advance(&mut fluid, WARM_UP)?;
    Ok(fluid)
}

/// Wall time of some steps [s].
fn advance(fluid: &mut Fluid, steps: usize) -> Result<f64, BenchError> {
    let (mut walls, start) = (Walls::default(), Instant::now());
    for _ in 0..steps {
        fluid.timers_mut().begin(Phase::Integration);
        let dt = fluid.stable_dt(&walls)?;
        fluid.step(&mut walls, dt)?;
        fluid.timers_mut().end();
    }
    Ok(start.elapsed().as_secs_f64())
}

/// Every path over the same block, on one thread.
pub(super) fn blocks(particles: usize, steps: usize) -> Result<Vec<Block>, BenchError> {
    let mut blocks: Vec<Block> = Vec::new();
    for path in PATHS {
        let steps = steps.next_multiple_of(path.acoustic_steps as usize); // whole advective steps
        let block = parallel::on_threads(1, || {
            let mut fluid = vortices(particles, &path)?;
            let before = Phase::ALL.map(|phase| fluid.timers().seconds(phase));
            let seconds = advance(&mut fluid, steps)?;
            let evaluations = (fluid.particles().len() * steps) as f64;
            let spent = |phase: Phase| fluid.timers().seconds(phase) - before[phase as usize];
            let in_phase = |phase: Phase| (phase.name(), 1e9 * spent(phase) / evaluations);
            Ok::<_, BenchError>(Block {
                particles: fluid.particles().len(),
                neighbours: neighbours(&fluid),
                path: path.name,
                steps,
                evaluations_per_core_second: evaluations / seconds,
                sweeps_only_per_core_second: evaluations / (spent(Phase::Density) + spent(Phase::Momentum)),
                over_reference: 1.0,
                phases_ns: Phase::ALL.map(in_phase).into_iter().filter(|(_, ns)| *ns > 0.0).collect(),
            })
        })?;
        let reference = blocks.first().map_or(block.evaluations_per_core_second, |b| b.evaluations_per_core_second);
        blocks.push(Block { over_reference: block.evaluations_per_core_second / reference, ..block });
    }
    Ok(blocks)
}

/// The block as it is stepped by default, on one thread and on two by turns.
pub(super) fn speedup(particles: usize, steps: usize) -> Result<(Speedup, Memory), BenchError> {
    let mut fluid = parallel::on_threads(2, || vortices(particles, &SIDE_BY_SIDE))?;
    let mut seconds = [0.0; 2];
    for threads in [1, 2, 2, 1] {
        seconds[threads - 1] += parallel::on_threads(threads, || advance(&mut fluid, steps))?;
    }
    let particles = fluid.particles().len();
    let bytes_per_particle = fluid.bytes() as f64 / particles as f64;
    let memory = Memory { particles, bytes_per_particle, peak_resident_bytes: peak_resident() };
    Ok((Speedup { threads: 2, particles, speedup: seconds[0] / seconds[1] }, memory))
}

/// Mean number of neighbours within the kernel, of every hundredth particle.
fn neighbours(fluid: &Fluid) -> f64 {
    let p = fluid.particles();
    let meets = |k: usize, j: usize| {
        let apart = |a: f64, b: f64| ((a - b).abs()).min(1.0 - (a - b).abs()); // the box repeats
        apart(p.x[k], p.x[j]).hypot(apart(p.y[k], p.y[j])) < p.h[k] + p.h[j]
    };
    let listed = |k: usize| fluid.neighbours().fluid.of(k).map(|j| fluid.neighbours().source(j, p.len()));
    let some = (0..p.len()).step_by(100);
    let met: usize = some.clone().map(|k| listed(k).filter(|&j| meets(k, j)).count()).sum();
    met as f64 / some.len() as f64
}

/// Most memory that the process has held [bytes], where the system reports it.
fn peak_resident() -> Option<u64> {
    let said = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = said.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(1024 * line.trim().trim_end_matches("kB").trim().parse::<u64>().ok()?)
}

/// Evenly spread numbers from −½ to ½, the same every time (Marsaglia 2003).
struct Dice(u64);

impl Dice {
    fn throw(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
}
