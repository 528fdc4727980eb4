//! The split-explicit step (THEORY WC22–WC25): what is exact in it, and that it agrees with steps whose geometry is new.

use std::f64::consts::TAU;

use evidence::systems::{advance, lift, scene, system, take};
use sph_core::{Domain, Fluid, Periodic, Seed, Walls, wcsph};

const CELLS: usize = 32;

/// Taylor & Green's vortices in a periodic box.
fn vortices(acoustic_steps: u32) -> Fluid {
    let (dx, cell) = (1.0 / CELLS as f64, Some([0.0, 1.0]));
    let domain = Domain { periodic: Some(Periodic { x: cell, y: cell }), ..Domain::default() };
    let settings = wcsph::Settings {
        sound_speed: 20.0.into(),
        acoustic_steps: acoustic_steps.into(),
        ..wcsph::Settings::default()
    };
    let seed = |k: usize| {
        let [x, y] = [k % CELLS, k / CELLS].map(|i| (i as f64 + 0.5) * dx);
        let velocity = [-(TAU * x).cos() * (TAU * y).sin(), 0.5 + (TAU * x).sin() * (TAU * y).cos()];
        Seed { at: [x, y], velocity, area: dx * dx, pressure: 0.0 }
    };
    let mut fluid = Fluid::new(domain, &settings, &(0..CELLS * CELLS).map(seed).collect::<Vec<_>>());
    fluid.initialise(&mut Walls::default()).expect("water");
    fluid
}

fn run(fluid: &mut Fluid, end: f64) {
    let mut walls = Walls::default();
    while fluid.time() < end {
        let dt = fluid.stable_dt(&walls).expect("a stable step");
        fluid.step(&mut walls, dt).expect("water");
    }
}

/// Momentum is exact with weights in single precision, and the energy of the flow is that of steps with new geometry.
#[test]
fn held_pairs_keep_momentum_and_the_flow() {
    let mut energies = Vec::new();
    for steps in [1, 4, 16] {
        let mut fluid = vortices(steps);
        let (before, scale) = fluid.momentum_and_its_scale();
        run(&mut fluid, 0.1);
        let after = fluid.momentum();
        let gap = (0..2).map(|k| (after[k] - before[k]).abs()).fold(0.0, f64::max);
        assert!(gap < 1e-12 * scale, "{steps} acoustic steps: {gap} N s/m of {scale}");
        energies.push(fluid.energy().kinetic);
    }
    for split in &energies[1..] {
        assert!((split / energies[0] - 1.0).abs() < 6e-3, "{energies:?}");
    }
}

/// Far fewer lists are made where geometry is held.
#[test]
fn lists_are_made_once_per_advective_step() {
    let [full, split] = [1, 16].map(|steps| {
        let mut fluid = vortices(steps);
        run(&mut fluid, 0.05);
        (fluid.steps(), fluid.neighbours().rebuilds)
    });
    assert_eq!(full.0, split.0);
    assert!(9 * split.1 < split.0, "{} lists in {} acoustic steps", split.1, split.0);
}

/// Scatter of the force coefficient about its running mean of 33 acoustic steps, over its mean.
fn scatter(acoustic_steps: u32) -> f64 {
    let steps = format!("fluid.acoustic_steps={acoustic_steps}");
    let mut wedge = system("wedge_constant", &["resolution.spacing=0.04", "body.breadth=8", &steps]);
    let mut force = Vec::new();
    advance(&mut wedge, 0.6, |wedge| force.push([wedge.fluid.time(), lift(wedge) / wedge.fluid.time()]))
        .expect("a run");
    let late: Vec<f64> = force.into_iter().filter(|[time, _]| *time > 0.4).map(|[_, force]| force).collect();
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    let off: Vec<f64> = late.windows(33).map(|around| (around[16] - mean(around)).powi(2)).collect();
    mean(&off).sqrt() / mean(&late)
}

/// WC23: the geometry of a wedge's water moves within an advective step. Where it stood still for 16 acoustic steps, the scatter was 6.2 %.
#[test]
fn force_does_not_swing_with_the_advective_steps() {
    let [full, usual, many] = [1, 12, 16].map(scatter);
    assert!(usual < 0.006 && usual < 3.0 * full, "{usual} with 12 acoustic steps, {full} with one");
    assert!(many < 0.01, "{many} with 16 acoustic steps");
}

const DROP: [&str; 2] = ["resolution.spacing=0.03", "fluid.acoustic_steps=8"];

/// Restored in the middle of an advective step, from memory or from bytes, a free wedge goes on with the same bits.
#[test]
fn a_state_within_an_advective_step_comes_back() {
    let mut wedge = system("wedge", &DROP);
    take(&mut wedge, 53).expect("steps");
    wedge.checkpoint();
    let stored = wedge.to_bytes();
    take(&mut wedge, 40).expect("steps");
    let expected = (wedge.fluid.particles().clone(), lift(&wedge).to_bits());
    wedge.restore();
    take(&mut wedge, 40).expect("steps");
    assert!(expected.0 == *wedge.fluid.particles() && expected.1 == lift(&wedge).to_bits());
    let mut other = system("wedge", &DROP);
    other.restore_bytes(&stored).expect("its own state");
    take(&mut other, 40).expect("steps");
    assert!(expected.0 == *other.fluid.particles() && expected.1 == lift(&other).to_bits());
}

/// A free wedge with the added-mass scheme inside the acoustic steps: momentum is closed, and the drop is that of full steps.
#[test]
fn a_free_wedge_falls_as_with_full_steps() {
    let [full, split] = ["1", "8"].map(|steps| {
        let mut wedge = system("wedge", &["resolution.spacing=0.03", &format!("fluid.acoustic_steps={steps}")]);
        advance(&mut wedge, 0.012, |_| {}).expect("a run");
        let worst = wedge.momentum_audit().worst;
        assert!(worst < 1e-10, "{steps} acoustic steps: momentum {worst:.1e}");
        wedge.bodies().find_map(|body| body.motion()).expect("a wedge").velocity[1]
    });
    assert!((split / full - 1.0).abs() < 5e-3, "velocity {split}, with full steps {full} m/s");
}

/// A rigid keel, or a round bottom, is followed with twelve acoustic steps per geometry. Repeated steps of a light body, and a resolution that does not follow, need the geometry
/// of each step.
#[test]
fn geometry_is_held_by_default_only_where_it_was_found_to_hold() {
    let held = |sets: &[&str]| {
        let scene = scene("wedge", sets);
        scene.solver.weakly_compressible().map(|fluid| fluid.scheme.acoustic_steps())
    };
    assert_eq!(held(&[]), Some(12));
    assert_eq!(held(&["coupling.scheme=added_mass"]), Some(12));
    assert_eq!(held(&["coupling.scheme=iqn_ils"]), Some(1));
    assert_eq!(held(&["resolution.follow=false"]), Some(1));
}
