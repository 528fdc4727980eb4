//! Two programs that are coupled from outside: a fluid and a structure, and a third that lets them agree by IQN-ILS.
//!
//! ```sh
//! cargo run --release -p scenarios --example partitioned
//! ```
//!
//! Each participant has what an implicit coupling library asks for: its mesh is read once, it reads the other's data, advances by the
//! window in steps of its own, writes its data, keeps a state and returns to it. The structure is a wedge so light that taking the
//! water's force as it comes diverges; the interface quasi-Newton method (Degroote et al. 2009, THEORY CO9) finds the velocity at the end
//! of each window that fits the force. For comparison the scene's own run with the same mass.

use fsi_coupling::QuasiNewton;
use fsi_coupling::embed::HostNodes;
use run::host::{HostedError, HostedRun, HostedScene, Interface};
use run::{RunOptions, run};

const MASS: f64 = 0.5; // kg/m
const WINDOW: f64 = 1e-4; // s
const WINDOWS: usize = 60;
const TOLERANCE: f64 = 1e-6; // of the velocity
const MOST_ITERATIONS: usize = 40;
const GRAVITY: f64 = 9.81;

/// What a coupling library asks of a participant.
trait Participant {
    /// Advances by a window with the other's data, and returns its own.
    fn advance(&mut self, read: &[f64], window: f64) -> Result<Vec<f64>, HostedError>;
    fn write_checkpoint(&mut self) -> Result<(), HostedError>;
    fn read_checkpoint(&mut self) -> Result<(), HostedError>;
}

/// Reads the velocity of its mesh at the end of the window, writes the mean force.
struct Fluid {
    water: HostedRun,
    nodes: HostNodes,
    stored: HostNodes,
}

impl Participant for Fluid {
    fn advance(&mut self, read: &[f64], window: f64) -> Result<Vec<f64>, HostedError> {
        let v = self.nodes.velocity[0][1];
        self.nodes.position[0][1] += window * 0.5 * (v + read[0]);
        self.nodes.velocity[0][1] = read[0];
        let mut forces = [[0.0; 3]];
        self.water.contribute(window, &self.nodes, &mut forces)?;
        Ok(vec![forces[0][1]])
    }

    fn write_checkpoint(&mut self) -> Result<(), HostedError> {
        self.stored = self.nodes.clone();
        self.water.save();
        Ok(())
    }

    fn read_checkpoint(&mut self) -> Result<(), HostedError> {
        self.nodes = self.stored.clone();
        self.water.restore()
    }
}

/// Reads the mean force, writes its velocity at the end of the window; it needs five steps of its own.
struct Structure {
    velocity: f64,
    stored: f64,
}

impl Participant for Structure {
    fn advance(&mut self, read: &[f64], window: f64) -> Result<Vec<f64>, HostedError> {
        for _ in 0..5 {
            self.velocity += 0.2 * window * (read[0] / MASS - GRAVITY);
        }
        Ok(vec![self.velocity])
    }

    fn write_checkpoint(&mut self) -> Result<(), HostedError> {
        self.stored = self.velocity;
        Ok(())
    }

    fn read_checkpoint(&mut self) -> Result<(), HostedError> {
        self.velocity = self.stored;
        Ok(())
    }
}

/// Both through all windows; times, velocities, and the iterations of each window. `accelerated`: by IQN-ILS, else by repetition.
pub fn couple(sets: &[String], accelerated: bool) -> Result<(Vec<[f64; 2]>, Vec<usize>), HostedError> {
    let scene = HostedScene::open("wedge", sets, Interface::Body)?;
    let nodes = scene.nodes().clone();
    let mut interface = vec![nodes.velocity[0][1]];
    let mut structure = Structure { velocity: interface[0], stored: 0.0 };
    let mut fluid = Fluid { water: scene.build(&nodes)?, stored: nodes.clone(), nodes };
    let mut method = QuasiNewton::default();
    let (mut curve, mut iterations) = (Vec::new(), Vec::new());
    for _ in 0..WINDOWS {
        fluid.write_checkpoint()?;
        structure.write_checkpoint()?;
        method.begin_step();
        let mut count = 0;
        loop {
            count += 1;
            let force = fluid.advance(&interface, WINDOW)?;
            let outcome = structure.advance(&force, WINDOW)?;
            let residual: Vec<f64> = outcome.iter().zip(&interface).map(|(a, b)| a - b).collect();
            let agreed = residual[0].abs() < TOLERANCE * interface[0].abs().max(1.0);
            if agreed || count == MOST_ITERATIONS {
                break;
            }
            fluid.read_checkpoint()?;
            structure.read_checkpoint()?;
            interface = if accelerated { method.next(&interface, &residual) } else { outcome };
        }
        curve.push([fluid.water.time(), structure.velocity]);
        iterations.push(count);
        if count == MOST_ITERATIONS {
            break;
        }
    }
    Ok((curve, iterations))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mass = format!("body.mass={MASS}");
    let sets = ["resolution.spacing=0.01", "time.end=0.004", "time.sample_every=1e-4", &mass].map(String::from);

    let series = run(&run::load("wedge", &sets)?.scene, &RunOptions::default())?.series;
    let (times, velocities) = (series.times(), series.column("wedge.vy_m_per_s").expect("a velocity"));
    let own = |time: f64| {
        let k = times.partition_point(|t| *t < time).clamp(1, times.len() - 1);
        let share = ((time - times[k - 1]) / (times[k] - times[k - 1])).clamp(0.0, 1.0);
        velocities[k - 1] + share * (velocities[k] - velocities[k - 1])
    };
    let (_, plain) = couple(&sets, false).unwrap_or_default();
    match plain.iter().position(|count| *count == MOST_ITERATIONS) {
        Some(window) => println!("repetition: no agreement in window {window} after {MOST_ITERATIONS} iterations"),
        None => println!("repetition: {:.1} iterations per window", mean(&plain)),
    }
    let (curve, iterations) = couple(&sets, true)?;
    println!(
        "IQN-ILS: {:.1} iterations per window, {} at most",
        mean(&iterations),
        iterations.iter().max().unwrap_or(&0)
    );
    println!("  time ms  velocity m/s  the scene's own run m/s");
    for [time, velocity] in curve.iter().step_by(6) {
        println!("{:9.3} {velocity:13.5} {:24.5}", 1e3 * time, own(*time));
    }
    let worst = curve.iter().filter(|[t, _]| *t < 0.004).map(|[t, v]| (v - own(*t)).abs()).fold(0.0, f64::max);
    println!("largest difference {worst:.1e} m/s");
    Ok(())
}

fn mean(counts: &[usize]) -> f64 {
    counts.iter().sum::<usize>() as f64 / counts.len().max(1) as f64
}
