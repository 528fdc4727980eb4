//! The reference host: a landing-dynamics program with water under it. The same program exists in each language that has an interface.
//!
//! ```sh
//! cargo run --release -p scenarios --example reference_host
//! ```
//!
//! A fuselage section comes down at 3 m/s: a frame that carries a cabin on an oleo (a spring and a damper whose force grows with the square
//! of the speed), and a flexible belly between the chines, a beam of nine nodes by finite differences. The host integrates all of it by
//! velocity Verlet. It predicts each step with the water's last force; where the force came out too different it rejects the step and
//! repeats it with the better force.
//!
//! Per metre of span, SI units. Each line: time, height of frame and cabin, deflection and velocity of the keel, force of the water,
//! force of the oleo. At the end: steps, rejected steps.

use std::path::PathBuf;

use run::host::{HostedError, HostedScene, Interface};

/// Nodes of the belly, their distance along x [m].
const BELLY: usize = 9;
const H: f64 = 0.1;
/// Bending stiffness [N m] and mass of a node of the belly [kg/m].
const STIFFNESS: f64 = 6.0e3;
const NODE: f64 = 4.0;
/// Masses of frame and cabin [kg/m]; spring [N/m²] and damper [N s²/m³] of the oleo.
const FRAME: f64 = 250.0;
const CABIN: f64 = 500.0;
const SPRING: f64 = 5.0e5;
const DAMPER: f64 = 4.0e4;
const GRAVITY: f64 = 9.81;
/// Step of the host [s], their number, and the change of velocity from which a step is rejected [m/s].
const DT: f64 = 5.0e-5;
const STEPS: usize = 400;
const TOLERANCE: f64 = 0.002;

/// Heights of frame and cabin, deflections of the belly against the frame [m]; and their velocities [m/s].
#[derive(Clone, Copy)]
struct State {
    x: [f64; 2 + BELLY],
    v: [f64; 2 + BELLY],
}

fn oleo(s: &State) -> f64 {
    let (closing, speed) = (s.x[0] - s.x[1], s.v[0] - s.v[1]);
    SPRING * closing + DAMPER * speed * speed.abs()
}

/// Accelerations under the water's forces on the belly [N/m].
fn accelerations(s: &State, water: &[f64; BELLY]) -> [f64; 2 + BELLY] {
    let w = &s.x[2..];
    let mut moment = [0.0; BELLY];
    for i in 1..BELLY - 1 {
        moment[i] = STIFFNESS * (w[i - 1] - 2.0 * w[i] + w[i + 1]) / (H * H);
    }
    let mut force = [0.0; BELLY];
    for i in 0..BELLY {
        let left = if i > 0 { moment[i - 1] } else { 0.0 };
        let right = if i < BELLY - 1 { moment[i + 1] } else { 0.0 };
        force[i] = water[i] - (left - 2.0 * moment[i] + right) / H;
    }
    let strut = oleo(s);
    let mut a = [0.0; 2 + BELLY];
    a[0] = (force[0] + force[BELLY - 1] - strut) / FRAME - GRAVITY;
    a[1] = strut / CABIN - GRAVITY;
    for i in 1..BELLY - 1 {
        a[2 + i] = force[i] / NODE - GRAVITY - a[0];
    }
    a
}

/// The state after a step under forces of the water that are predicted.
fn verlet(s: &State, water: &[f64; BELLY]) -> State {
    let before = accelerations(s, water);
    let mut end = *s;
    for k in 0..2 + BELLY {
        end.x[k] = s.x[k] + DT * s.v[k] + 0.5 * DT * DT * before[k];
    }
    let after = accelerations(&end, water);
    for k in 0..2 + BELLY {
        end.v[k] = s.v[k] + 0.5 * DT * (before[k] + after[k]);
    }
    end
}

fn main() -> Result<(), HostedError> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("examples/reference_section.toml");
    let scene = HostedScene::open(&path.to_string_lossy(), &[], Interface::Nodes)?;
    let start = scene.nodes().clone();
    let mut nodes = start.clone();
    let mut water = scene.build(&start)?;

    let mut state = State { x: [0.0; 2 + BELLY], v: [0.0; 2 + BELLY] };
    (state.v[0], state.v[1]) = (start.velocity[0][1], start.velocity[0][1]);
    let mut predicted = [0.0; BELLY];
    let mut forces = vec![[0.0; 3]; nodes.len()];
    let mut rejected = 0;
    for step in 1..=STEPS {
        water.save();
        let mut redone = false;
        loop {
            let mut end = verlet(&state, &predicted);
            for k in 0..nodes.len() {
                let (w, rate) = if k < BELLY { (end.x[2 + k], end.v[2 + k]) } else { (0.0, 0.0) };
                nodes.position[k][1] = start.position[k][1] + end.x[0] + w;
                nodes.velocity[k][1] = end.v[0] + rate;
            }
            water.contribute(DT, &nodes, &mut forces)?;
            let mut found = [0.0; BELLY];
            let mut change = 0.0_f64;
            for i in 0..BELLY {
                found[i] = forces[i][1];
                change = change.max(DT * (found[i] - predicted[i]).abs() / NODE);
            }
            if change > TOLERANCE && !redone {
                water.restore()?;
                (predicted, redone, rejected) = (found, true, rejected + 1);
                continue;
            }
            // the nodes are where the water saw them; their velocities take the impulse that it gave
            let (with, without) = (accelerations(&end, &found), accelerations(&end, &predicted));
            for k in 0..2 + BELLY {
                end.v[k] += DT * (with[k] - without[k]);
            }
            (state, predicted) = (end, found);
            break;
        }
        if step % 20 == 0 {
            let mut total = 0.0;
            for force in &forces {
                total += force[1];
            }
            let [frame, cabin, keel, rate] = [state.x[0], state.x[1], state.x[6], state.v[6]];
            println!(
                "{:.16e} {frame:.16e} {cabin:.16e} {keel:.16e} {rate:.16e} {total:.16e} {:.16e}",
                water.time(),
                oleo(&state)
            );
        }
    }
    println!("{STEPS} steps, {rejected} rejected");
    water.finish().map(drop)
}
