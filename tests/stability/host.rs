//! A host with explicit coupling is unstable with long steps (THEORY CO32); one that repeats the step is not.

use evidence::host_wedge::{moved, total};
use fsi_coupling::embed::{FluidElement, FluidElementSpec, HostNodes, HostStep, Topology};

/// A box 0.4 m broad, of `mass` [kg/m], at its draught in still water.
fn floating(mass: f64) -> (FluidElement, HostNodes, f64) {
    let draught = mass / 400.0;
    let corners = vec![[-0.2, -draught], [0.2, -draught], [0.2, 0.2], [-0.2, 0.2]];
    let topology = Topology::of(corners.clone()).closed(0..4).weighing(vec![0.5 * mass, 0.5 * mass, 0.0, 0.0]);
    let spec = FluidElementSpec::new(0.02, 0.8, 0.5).with_sound_speed(20.0);
    let sized = spec.size(&topology).expect("a sound element");
    let longest = sized.added_mass().expect("masses").host_dt;
    let nodes = HostNodes::at_rest(corners);
    (sized.build(&nodes).expect("water"), nodes, longest)
}

/// Its largest speed [m/s] over `steps` of `dt` [s], each tried at most `tries` times; infinite where the water breaks down.
fn top_speed(mass: f64, dt: f64, tries: usize, steps: usize) -> f64 {
    let (mut element, nodes, _) = floating(mass);
    let (mut y, mut v, mut mean, mut top) = (0.0, 0.0, total(&element.forces_now())[1], 0.0_f64);
    let mut forces = vec![[0.0; 3]; 4];
    for _ in 0..steps {
        element.save();
        let (mut omega, mut last) = (0.5, None::<f64>);
        for attempt in 1..=tries {
            let a = mean / mass - 9.81;
            let end = moved(&nodes, [0.0, y + dt * (v + 0.5 * dt * a)], [0.0, v + dt * a]);
            if element.contribute(HostStep { dt, nodes: &end }, &mut forces).is_err() {
                return f64::INFINITY;
            }
            let found = total(&forces)[1];
            let gap = found - mean;
            if attempt == tries || (tries > 1 && gap.abs() < 1e-3 * mass * 9.81) {
                (y, v, mean) = (y + dt * (v + 0.5 * dt * a), v + dt * (found / mass - 9.81), found);
                break;
            }
            // Aitken's relaxation of the mean force (Küttler & Wall 2008)
            omega *= last.map_or(1.0, |before| -before / (gap - before));
            (mean, last) = (mean + omega * gap, Some(gap));
            element.restore().expect("saved");
        }
        top = top.max(v.abs());
    }
    top
}

/// A box lighter than the water it can move: stable with CO32's step, unstable with three times that and with eight; a host
/// that saves, restores and repeats its steps until the force agrees is stable with all of them.
#[test]
fn a_host_with_explicit_coupling_is_unstable_with_long_steps() {
    let (element, _, longest) = floating(40.0);
    println!("CO32: {longest:.2e} s, {:.1} steps of the water", longest / element.fluid_dt().expect("a stable step"));
    for (times, unstable) in [(0.5, false), (1.0, false), (3.0, true), (8.0, true)] {
        let steps = (0.3 / (times * longest)) as usize;
        let (taken, repeated) =
            (top_speed(40.0, times * longest, 1, steps), top_speed(40.0, times * longest, 8, steps));
        println!("40 kg/m, {times} x CO32, {steps} steps: {taken:.2e} m/s explicit, {repeated:.2e} m/s repeated");
        assert!(if unstable { taken > 1.0 } else { taken < 0.02 }, "{times}: {taken} m/s");
        assert!(repeated < 0.02, "{times}: {repeated} m/s");
    }
}
