//! A program for landing dynamics that uses the water element.
//!
//! A fuselage section comes down on water: a shell (heave and pitch) and a cabin floor on a spring and a damper. The
//! program keeps its own loop, its own integrator (Runge & Kutta's of fourth order) and its own step, which it controls by
//! the error of the water's force that it predicted: a step whose error is too large is taken back and redone shorter. It
//! uses five calls of the water element: `size`, `build`, `contribute`, `save` and `restore`.
//!
//! ```sh
//! cargo run --release -p fsi_coupling --example landing_host
//! ```
//!
//! Per metre of span, SI units. What it prints: time, heave, pitch, velocities, force and moment of the water, the spring's
//! load factor on the cabin; at the end how many steps were rejected, that a redone step came to the same bits, and how well the
//! momentum of shell, cabin and water adds up.

use fsi_coupling::embed::{FluidElement, FluidElementSpec, HostError, HostNodes, HostStep, Topology};

/// Mass of the shell [kg/m], its inertia about its origin [kg m]; mass of the cabin [kg/m].
const SHELL: f64 = 250.0;
const INERTIA: f64 = 120.0;
const CABIN: f64 = 500.0;
/// Spring [N/m²] and damper [N s/m²] under the cabin: 5 Hz, a fifth of critical damping.
const SPRING: f64 = 4.9e5;
const DAMPER: f64 = 6.3e3;
const GRAVITY: f64 = 9.81;
/// Sink speed [m/s] and roll angle [rad] at contact.
const SINK: f64 = 1.5;
const ROLL: f64 = 0.05;
/// Velocity that a step may mistake the water's force by [m/s], and bounds of the step [s].
const TOLERANCE: f64 = 2e-3;
const STEP: [f64; 2] = [5e-5, 1e-2];
const END: f64 = 0.25;

/// Sway, heave, roll of the shell's origin and heave of the cabin; and their rates.
type State = [[f64; 4]; 2];

/// The section's bottom, an arc of radius 1.2 m and breadth 1.6 m, and its deck, about the shell's origin [m].
fn corners() -> Vec<[f64; 2]> {
    let arc = (0..=16).map(|k| {
        let angle = (f64::from(k) / 8.0 - 1.0) * (0.8_f64 / 1.2).asin();
        [1.2 * angle.sin(), 0.7 - 1.2 * angle.cos()]
    });
    arc.chain([[0.8, 0.4], [-0.8, 0.4]]).collect()
}

/// Where the shell puts its corners, and how fast.
fn nodes(corners: &[[f64; 2]], [q, v]: &State) -> HostNodes {
    let (sin, cos) = q[2].sin_cos();
    let turned = |c: &[f64; 2]| [cos * c[0] - sin * c[1], sin * c[0] + cos * c[1]];
    let place = |c: &[f64; 2]| [q[0] + turned(c)[0], q[1] + turned(c)[1]];
    let speed = |c: &[f64; 2]| [v[0] - v[2] * turned(c)[1], v[1] + v[2] * turned(c)[0]];
    HostNodes {
        position: corners.iter().map(place).collect(),
        velocity: corners.iter().map(speed).collect(),
        ..HostNodes::default()
    }
}

/// Accelerations under the water's force and moment [N/m, N/m, N].
fn accelerations([q, v]: &State, water: [f64; 3]) -> [f64; 4] {
    let spring = SPRING * (q[1] - q[3]) + DAMPER * (v[1] - v[3]);
    [water[0] / SHELL, (water[1] - spring) / SHELL - GRAVITY, water[2] / INERTIA, spring / CABIN - GRAVITY]
}

/// Runge & Kutta's step of fourth order under a constant force of the water.
fn runge_kutta(start: &State, water: [f64; 3], dt: f64) -> State {
    let rate = |s: &State| [s[1], accelerations(s, water)];
    let along = |s: &State, r: &State, h: f64| [0, 1].map(|i| [0, 1, 2, 3].map(|k| s[i][k] + h * r[i][k]));
    let k1 = rate(start);
    let k2 = rate(&along(start, &k1, 0.5 * dt));
    let k3 = rate(&along(start, &k2, 0.5 * dt));
    let k4 = rate(&along(start, &k3, dt));
    [0, 1].map(|i| [0, 1, 2, 3].map(|k| start[i][k] + dt / 6.0 * (k1[i][k] + 2.0 * (k2[i][k] + k3[i][k]) + k4[i][k])))
}

/// Force, and moment about the shell's origin, of forces on nodes.
fn resultant(nodes: &HostNodes, origin: [f64; 2], forces: &[[f64; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (at, [fx, fy, m]) in nodes.position.iter().zip(forces) {
        sum = [sum[0] + fx, sum[1] + fy, sum[2] + m + (at[0] - origin[0]) * fy - (at[1] - origin[1]) * fx];
    }
    sum
}

/// Momentum of shell, cabin and water less what gravity and the basin gave [N s/m].
fn momentum(state: &State, element: &FluidElement) -> f64 {
    let (fluid, basin) = (&element.system().fluid, element.system().bodies().nth(1));
    let own = SHELL * state[1][1] + CABIN * state[1][3] + (SHELL + CABIN) * GRAVITY * element.time();
    own + fluid.momentum()[1] + GRAVITY * element.time() * fluid.mass()
        - basin.map_or(0.0, |b| b.momentum().external[1])
}

fn main() -> Result<(), HostError> {
    let corners = corners();
    let mut state: State = [[0.0, 0.0, ROLL, 0.0], [0.0, -SINK, 0.0, -SINK]];
    let lowest = nodes(&corners, &state).position.iter().map(|at| at[1]).fold(f64::INFINITY, f64::min);
    (state[0][1], state[0][3]) = (0.001 - lowest, 0.001 - lowest); // the keel a millimetre above the water
    let start = nodes(&corners, &state);

    // say, size, build
    let spec = FluidElementSpec { fastest_speed: Some(5.0 * SINK), ..FluidElementSpec::new(0.03, 3.0, 2.0) };
    let mut masses = vec![0.0; corners.len()];
    (masses[0], masses[16]) = (0.5 * SHELL, 0.5 * SHELL);
    let topology = Topology::of(start.position.clone()).closed(0..corners.len()).weighing(masses);
    let sized = spec.size(&topology)?;
    println!(
        "{} particles, {:.1} MB, step of the water {:.1e} s",
        sized.fluid_particles(),
        1e-6 * sized.bytes() as f64,
        sized.fluid_dt()
    );
    sized.warnings().iter().for_each(|warning| println!("warning: {warning}"));
    let mut element = sized.build(&start)?;

    let mut forces = vec![[0.0; 3]; corners.len()];
    let (mut water, mut dt, mut time, mut printed) = ([0.0; 3], STEP[0], 0.0, 0.0);
    let (mut accepted, mut rejected, mut fluid_steps, mut redone) = (0, 0, 0, 0);
    let before = momentum(&state, &element);
    println!("  time s   heave m  roll deg  sink m/s  step ms  substeps  force N/m   moment N  cabin g");
    while time < END {
        dt = dt.min(END - time).max(1e-9);
        element.save();
        // predict with the water's last mean force, and find the mean force of this step
        let end = runge_kutta(&state, water, dt);
        let there = nodes(&corners, &end);
        let mut given = element.contribute(HostStep { dt, nodes: &there }, &mut forces)?;
        let mut found = resultant(&there, [end[0][0], end[0][1]], &forces);
        let gap = [0, 1, 2].map(|k| found[k] - water[k]);
        let error = dt * (gap[0] / SHELL).hypot(gap[1] / SHELL).max(0.8 * gap[2].abs() / INERTIA);
        if error > TOLERANCE && dt > STEP[0] {
            element.restore()?;
            dt = (dt * (0.8 * (TOLERANCE / error).sqrt()).clamp(0.2, 0.7)).max(STEP[0]);
            rejected += 1;
            continue;
        }
        if accepted % 50 == 10 {
            // a step taken back comes again to the same bits
            let first: Vec<u64> = forces.as_flattened().iter().map(|f| f.to_bits()).collect();
            element.restore()?;
            given = element.contribute(HostStep { dt, nodes: &there }, &mut forces)?;
            assert!(forces.as_flattened().iter().map(|f| f.to_bits()).eq(first));
            found = resultant(&there, [end[0][0], end[0][1]], &forces);
            redone += 1;
        }
        // the shell stays where it was predicted; its velocities take the impulse of the water
        let kick = [gap[0] / SHELL, gap[1] / SHELL, gap[2] / INERTIA, 0.0].map(|a| dt * a);
        state = [end[0], [0, 1, 2, 3].map(|k| end[1][k] + kick[k])];
        (water, time) = (found, time + dt);
        (accepted, fluid_steps) = (accepted + 1, fluid_steps + given.fluid_steps);
        if time >= printed {
            let cabin = accelerations(&state, water)[3] / GRAVITY + 1.0;
            println!(
                "{time:8.4} {:9.4} {:9.3} {:9.3} {:8.3} {:9} {:10.0} {:10.1} {cabin:8.2}",
                state[0][1],
                state[0][2].to_degrees(),
                -state[1][1],
                1e3 * dt,
                given.fluid_steps,
                water[1],
                water[2]
            );
            printed += END / 25.0;
        }
        dt = (dt * (0.8 * (TOLERANCE / error.max(1e-12)).sqrt()).clamp(0.3, 1.5)).clamp(STEP[0], STEP[1]);
    }
    let after = momentum(&state, &element);
    let exchanged = (SHELL + CABIN) * SINK;
    println!(
        "{accepted} steps accepted, {rejected} rejected, {redone} redone to the same bits; {fluid_steps} steps of the water"
    );
    println!(
        "momentum of shell, cabin and water: changed by {:.1e} of {exchanged:.0} N s/m",
        (after - before) / exchanged
    );
    println!("water beyond a surface: {} particles", element.system().penetration().count);
    Ok(())
}
