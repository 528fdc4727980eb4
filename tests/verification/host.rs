//! The embedding element: what the nodes get is what the water lost, steps come again, and a host's wedge is the scene's (THEORY
//! CO29–CO32).

use evidence::host_wedge::{
    MASS, bits, element, moved, placed, schemes, spec, swinging, total, wedge_of_nodes, wedge_of_the_scene,
};
use fsi_coupling::embed::{
    ElementScheme, FluidElement, FluidElementSpec, HostError, HostNodes, HostStep, Side, Topology,
};
use fsi_coupling::{Coupled, Motion};
use rayon::ThreadPoolBuilder;
use sph_core::Domain;
use sph_core::wcsph::{self, Wcsph};

/// Momentum that the water and the basin hold, and what gravity gave [N s/m].
fn momentum(element: &FluidElement) -> [f64; 2] {
    let system = element.system();
    let (fluid, basin) = (&system.fluid, system.bodies().nth(1).expect("a basin").momentum().external);
    let held = fluid.momentum();
    let external = fluid.external_force();
    [0, 1].map(|k| held[k] - basin[k] - fluid.time() * external[k])
}

/// Σ forces × Δt is the momentum that the water lost, to rounding, in steps of 1, 7.5 and 50 times the water's; so is the
/// basin's share, and what single particles' impulses gave.
#[test]
fn the_nodes_get_the_impulse_that_the_water_lost() {
    for (scheme, rotations) in schemes().into_iter().flat_map(|scheme| [(scheme, false), (scheme, true)]) {
        let (mut element, law) = swinging(rotations, scheme);
        let (mut forces, mut time) = (vec![[0.0; 3]; 11], 0.0);
        for times in [1.0, 7.5, 50.0, 50.0, 50.0] {
            let before = momentum(&element);
            let dt = times * element.fluid_dt().expect("a stable step");
            time += dt;
            let given = element.contribute(HostStep { dt, nodes: &law(time) }, &mut forces).expect("a step");
            let (after, sum) = (momentum(&element), total(&forces));
            assert!(f64::from(given.fluid_steps) >= times, "{given:?}");
            for k in 0..2 {
                let lost = before[k] - after[k];
                let gap = (dt * sum[k] - lost).abs();
                let size: f64 = forces.iter().map(|f| dt * f[k].abs()).sum();
                println!("{rotations} {times}: J_{k} = {lost:.6e} N s/m, gap {:.1e} of it", gap / size);
                assert!(gap < 1e-12 * size.max(1.0), "{} against {lost}", dt * sum[k]);
                assert!((given.impulse[k] - dt * sum[k]).abs() <= 1e-12 * size);
            }
            assert_eq!(given.penetration.count, 0, "{given:?}");
        }
        let worst = element.system().momentum_audit().worst;
        println!("{rotations}: audit {worst:.1e}, water at {} s, host at {time} s", element.time());
        assert!(worst < 1e-12 && (element.time() - time).abs() < 1e-12);
    }
}

/// Contact impulses of single particles (THEORY WA7) are in the nodes' impulses too: a box that spins through the surface, in the
/// water's own steps, gets more than its boundary particles' forces, and momentum closes.
#[test]
fn impulses_of_single_particles_reach_the_nodes() {
    let arms = [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]];
    let law = |t: f64| placed(&arms, &Motion { angle: 0.4 + 15.0 * t, angular_velocity: 15.0, ..Motion::default() });
    let spec = FluidElementSpec { growth: 1.0, ..FluidElementSpec::new(0.03, 0.9, 0.6).with_sound_speed(50.0) };
    let topology = Topology::of(law(0.0).position).closed(0..4);
    let mut element = spec.size(&topology).expect("a sound element").build(&law(0.0)).expect("water");
    let (mut forces, mut time, mut impulses, mut steps) = (vec![[0.0; 3]; 4], 0.0, 0.0, 0);
    let before = momentum(&element);
    let mut given = [0.0; 2];
    while time < 0.3 {
        let dt = 0.99 * element.fluid_dt().expect("a stable step");
        time += dt;
        let impulse = element.contribute(HostStep { dt, nodes: &law(time) }, &mut forces).expect("a step").impulse;
        let (walls, range) = (&element.system().walls, element.system().range(0));
        let pushed = [&walls.mean_fx, &walls.mean_fy].map(|f| dt * f[range.clone()].iter().sum::<f64>());
        let contact = (impulse[0] - pushed[0]).hypot(impulse[1] - pushed[1]);
        steps += usize::from(contact > 1e-9);
        impulses += contact;
        given = [0, 1].map(|k| given[k] + impulse[k]);
    }
    let after = momentum(&element);
    let gap = [0, 1].map(|k| (before[k] - after[k] - given[k]).abs());
    println!(
        "{steps} steps with impulses of {impulses:.3} N s/m; of {given:.1?} N s/m given {:.1e} gap",
        gap[0] + gap[1]
    );
    assert!(steps > 0 && gap[0] + gap[1] < 1e-10 * given[1].abs());
    assert!(element.system().momentum_audit().worst < 1e-12);
}

/// A rejected step, redone, gives the same bits: at once, after a shorter try, and after a step that broke down.
#[test]
fn a_rejected_step_comes_again_to_the_same_bits() {
    let (mut element, nodes) = element();
    let mut forces = vec![[0.0; 3]; nodes.len()];
    let mut step = |element: &mut FluidElement, time: f64, dt: f64| {
        let end = moved(&nodes, [0.0, -6.15 * (time + dt)], [0.0, -6.15]);
        let given = element.contribute(HostStep { dt, nodes: &end }, &mut forces);
        given.map(|given| (bits(element, &forces), given))
    };
    step(&mut element, 0.0, 3e-3).expect("a step");
    element.save();
    let rebuilds = element.system().fluid.neighbours().rebuilds;
    let first = step(&mut element, 3e-3, 4e-3).expect("a step");
    assert!(element.system().fluid.neighbours().rebuilds > rebuilds + 1, "the lists were remade meanwhile");
    element.restore().expect("saved");
    assert!(step(&mut element, 3e-3, 4e-3).expect("again") == first, "redone at once");
    element.restore().expect("saved");
    step(&mut element, 3e-3, 1e-3).expect("a shorter one");
    element.restore().expect("saved");
    assert!(step(&mut element, 3e-3, 4e-3).expect("again") == first, "redone after a shorter step");
    assert!(step(&mut element, 7e-3, 4e-3).expect("onward") != first);
    // thirty spacings down within a step of 2.3 ms: 160 m/s, below the speed of sound, and the water breaks down
    element.restore().expect("saved");
    let deep = moved(&nodes, [0.0, -6.15 * 3e-3 - 0.375], [0.0, -6.15]);
    let broke = element.contribute(HostStep { dt: 2.3e-3, nodes: &deep }, &mut vec![[0.0; 3]; nodes.len()]);
    let Err(HostError::Step { node: Some(_), start, .. }) = &broke else { panic!("{broke:?}") };
    assert!((start - 3e-3).abs() < 1e-12);
    println!("{}", broke.expect_err("broken"));
    assert!(matches!(step(&mut element, 3e-3, 4e-3), Err(HostError::Failed(_))), "it waits for restore");
    assert!(!element.snapshot().position.is_empty(), "and can be looked at");
    element.restore().expect("saved");
    assert!(step(&mut element, 3e-3, 4e-3).expect("again") == first, "redone after a breakdown");
}

/// The bytes of an element, restored in another one that is built alike, give the steps that it takes itself.
#[test]
fn an_element_continues_from_bytes_to_the_same_bits() {
    for scheme in schemes() {
        continues_from_bytes(scheme);
    }
}

fn continues_from_bytes(scheme: ElementScheme) {
    let ((mut one, law), (mut other, _)) = (swinging(true, scheme), swinging(true, scheme));
    let steps = |element: &mut FluidElement, from: u32| {
        let mut forces = vec![[0.0; 3]; 11];
        for k in from..from + 4 {
            let nodes = law(2e-3 * f64::from(k + 1));
            element.contribute(HostStep { dt: 2e-3, nodes: &nodes }, &mut forces).expect("a step");
        }
        bits(element, &forces)
    };
    steps(&mut one, 0);
    let stored = one.to_bytes().expect("a sound element");
    other.restore_bytes(&stored).expect("its own bytes");
    assert_eq!(steps(&mut one, 4), steps(&mut other, 4));
    assert!(matches!(other.restore_bytes(&stored[..stored.len() / 2]), Err(HostError::State(_))));
    assert!(matches!(other.to_bytes(), Err(HostError::Failed(_))), "it waits for a state");
    other.restore_bytes(&stored).expect("its own bytes");
}

/// A step that is taken back comes again to the same bits by every solver, after a longer and after a shorter one.
#[test]
fn every_solver_repeats_a_step() {
    for scheme in schemes() {
        let (mut element, law) = swinging(true, scheme);
        let mut forces = vec![[0.0; 3]; 11];
        let mut step = |element: &mut FluidElement, dt: f64| {
            let nodes = law(element.time() + dt);
            element.contribute(HostStep { dt, nodes: &nodes }, &mut forces).expect("a step");
            bits(element, &forces)
        };
        step(&mut element, 4e-3);
        let mut never_tried = swinging(true, scheme).0;
        step(&mut never_tried, 4e-3);
        element.save();
        for tried in [8e-3, 1e-3] {
            step(&mut element, tried);
            element.restore().expect("saved");
        }
        assert!(step(&mut element, 4e-3) == step(&mut never_tried, 4e-3), "{scheme:?}");
    }
}

/// The same bits with one thread and with two.
#[test]
fn the_elements_bits_do_not_depend_on_threads() {
    let with = |threads: usize, scheme: ElementScheme| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
        pool.install(|| {
            let (mut element, law) = swinging(true, scheme);
            let mut forces = vec![[0.0; 3]; 11];
            for k in 1..=3 {
                let step = HostStep { dt: 0.01, nodes: &law(0.01 * f64::from(k)) };
                element.contribute(step, &mut forces).expect("a step");
            }
            bits(&element, &forces)
        })
    };
    for scheme in schemes() {
        assert!(with(1, scheme) == with(2, scheme), "other bits with one thread and with two: {scheme:?}");
    }
}

/// A host's wedge in free fall, in steps of `times` the water's [-], each taken `tries` times with the force that the last
/// try found: time [s] and velocity [m/s].
fn drop_by_host(times: f64, tries: usize, end: f64) -> Vec<[f64; 2]> {
    let (mut element, nodes) = element();
    let (mut forces, mut series) = (vec![[0.0; 3]; nodes.len()], Vec::new());
    let (mut y, mut v, mut mean) = (0.0, -6.15, 0.0);
    while element.time() < end {
        let dt = times * element.fluid_dt().expect("a stable step");
        element.save();
        for attempt in 0..tries {
            if attempt > 0 {
                element.restore().expect("saved");
            }
            let a = mean / MASS - 9.81;
            let at_end = moved(&nodes, [0.0, y + dt * (v + 0.5 * dt * a)], [0.0, v + dt * a]);
            element.contribute(HostStep { dt, nodes: &at_end }, &mut forces).expect("a step");
            (y, v) = match attempt + 1 == tries {
                true => (y + dt * (v + 0.5 * dt * a), v + dt * (total(&forces)[1] / MASS - 9.81)),
                false => (y, v),
            };
            mean = total(&forces)[1];
        }
        series.push([element.time(), v]);
    }
    series
}

/// The mean force from 4 to 9 ms [N/m] and the velocity lost after 12 ms [m/s], of velocities against time.
fn judged(series: &[[f64; 2]]) -> [f64; 2] {
    let at = |time: f64| {
        let k = series.partition_point(|row| row[0] < time);
        let ([t0, v0], [t1, v1]) = (if k == 0 { [0.0, -6.15] } else { series[k - 1] }, series[k]);
        v0 + (time - t0) / (t1 - t0) * (v1 - v0)
    };
    [MASS * ((at(0.009) - at(0.004)) / 0.005 + 9.81), at(0.012) + 6.15]
}

/// At constant velocity, in the water's own steps, a host's wedge is a prescribed one: particles agree to rounding.
#[test]
fn a_hosts_steady_wedge_is_a_prescribed_one() {
    // wet chines have no tension by default; a host's element holds any
    let sets = ["body.motion=constant_velocity", "fluid.acoustic_steps=1", "fluid.cavitation_pressure=-1e9"];
    let system = wedge_of_the_scene(&sets);
    let [apart, force] = gaps_to_prescribed(system, spec(), 100);
    assert!(apart < 1e-10 && force < 1e-8);
}

/// The same by projection, in water that is not packed around the body.
#[test]
fn a_hosts_steady_wedge_is_a_prescribed_one_by_projection() {
    let sets = ["body.motion=constant_velocity", "solver=incompressible", "resolution.packing=false"];
    let system = wedge_of_the_scene(&sets);
    let fastest_speed = Some(system.fluid.domain().fastest_speed);
    let spec = FluidElementSpec {
        scheme: ElementScheme::Projection(sph_core::projection::Settings::default()),
        fastest_speed,
        ..spec()
    };
    assert_eq!(spec.domain(), *system.fluid.domain(), "what a scene calls defaults are the element's");
    let [apart, force] = gaps_to_prescribed(system, spec, 10);
    assert!(apart < 1e-6 && force < 1e-3);
}

/// After some steps of a scene's system and of a host's element at the same velocity: how far particles are apart [m], and the relative gap of
/// the forces [-].
fn gaps_to_prescribed(mut system: Coupled, spec: FluidElementSpec, steps: usize) -> [f64; 2] {
    let (topology, nodes) = wedge_of_nodes();
    let mut element = spec.size(&topology).expect("a sound element").build(&nodes).expect("water");
    let (mut forces, mut time) = (vec![[0.0; 3]; nodes.len()], 0.0);
    for _ in 0..steps {
        let dt = system.stable_dt().expect("a stable step");
        system.step(dt).expect("a step");
        time += dt;
        let end = moved(&nodes, [0.0, -6.15 * time], [0.0, -6.15]);
        let given = element.contribute(HostStep { dt, nodes: &end }, &mut forces).expect("a step");
        assert_eq!(given.fluid_steps, 1);
    }
    let (ours, theirs) = (element.system().fluid.particles(), system.fluid.particles());
    assert!(ours.id == theirs.id);
    let gap = |k: usize| (ours.x[k] - theirs.x[k]).hypot(ours.y[k] - theirs.y[k]);
    let (apart, force) = ((0..ours.len()).map(gap).fold(0.0, f64::max), evidence::systems::lift(&system));
    let gap = element.forces_now().iter().map(|f| f[1]).sum::<f64>() / force - 1.0;
    println!("{steps} steps: particles {apart:.1e} m apart, force {gap:+.1e} of {force:.1} N/m");
    [apart, gap.abs()]
}

/// A wedge that a host moves falls like the scene's rigid wedge: in the water's own steps to what the host's prediction of
/// velocities costs, in ten and thirty of them within the errors stated.
#[test]
fn a_hosts_wedge_falls_like_the_scenes() {
    let end = 0.012;
    let mut system =
        wedge_of_the_scene(&["body.free=[\"y\"]", "fluid.cavitation_pressure=-1e9", "fluid.acoustic_steps=1"]);
    // the speed known beforehand is a projection's, of which the element makes no use
    let domain = Domain { fastest_speed: spec().domain().fastest_speed, ..*system.fluid.domain() };
    assert_eq!(domain, spec().domain(), "what a scene calls defaults are the element's");
    let settings = system.fluid.scheme::<Wcsph>().expect("the default scheme").settings;
    let cfl = spec().scheme.courant_number().into();
    let ElementScheme::WeaklyCompressible(own) = spec().scheme else { panic!("the default scheme") };
    assert_eq!(
        settings,
        // an element has no speed that bounds a scene's tension
        wcsph::Settings { cfl, acoustic_steps: 1.into(), cavitation_pressure: Some(-1e9), ..own },
        "what a scene calls defaults are the element's"
    );
    let (element, _) = element();
    assert_eq!(element.system().fluid.particles().id.len(), system.fluid.particles().id.len());
    let mut of_scene = Vec::new();
    while system.fluid.time() < end {
        let dt = system.stable_dt().expect("a stable step");
        system.step(dt).expect("a step");
        let velocity = system.bodies().next().expect("a wedge").motion().expect("it moves").velocity;
        of_scene.push([system.fluid.time(), velocity[1]]);
    }
    let reference = judged(&of_scene);
    println!("scene: {} steps, force {:.1} N/m, velocity lost {:.5} m/s", of_scene.len(), reference[0], reference[1]);
    for (times, tries, tolerance) in
        [(1.0, 1, 1e-3), (10.0, 1, 0.01), (10.0, 3, 0.006), (30.0, 1, 0.025), (30.0, 4, 0.015)]
    {
        let of_host = drop_by_host(times, tries, end);
        let found = judged(&of_host);
        let gaps = [0, 1].map(|k| found[k] / reference[k] - 1.0);
        println!(
            "host, {times}, {tries}: {} steps, force {:+.2e}, velocity lost {:+.2e}",
            of_host.len(),
            gaps[0],
            gaps[1]
        );
        assert!(gaps.iter().all(|gap| gap.abs() < tolerance), "{times}: {gaps:?}");
    }
}

/// Work: with nodes at constant velocity Σ f·Δx is what the water gave, exactly, whatever the step; with nodes that swing and
/// bend the gap falls as the step squared.
#[test]
fn the_works_of_both_sides_agree() {
    let (mut element, nodes) = element();
    let mut forces = vec![[0.0; 3]; nodes.len()];
    let dt = 50.0 * element.fluid_dt().expect("a stable step");
    let end = moved(&nodes, [0.0, -6.15 * dt], [0.0, -6.15]);
    let given = element.contribute(HostStep { dt, nodes: &end }, &mut forces).expect("a step");
    let work = total(&forces)[1] * -6.15 * dt;
    println!("constant velocity: {} J/m, gap {:.1e}", given.work, given.work / work - 1.0);
    assert!((given.work / work - 1.0).abs() < 1e-12);
    for rotations in [false, true] {
        let gap = |steps: u32| {
            let (mut element, law) = swinging(rotations, ElementScheme::default());
            let (mut forces, mut gap, mut size) = (vec![[0.0; 3]; 11], 0.0, 0.0);
            let dt = 0.048 / f64::from(steps);
            for k in 0..steps {
                let (a, b) = (law(dt * f64::from(k)), law(dt * f64::from(k + 1)));
                let given = element.contribute(HostStep { dt, nodes: &b }, &mut forces).expect("a step");
                let mut done = 0.0;
                for (n, [fx, fy, m]) in forces.iter().enumerate() {
                    done += fx * (b.position[n][0] - a.position[n][0]) + fy * (b.position[n][1] - a.position[n][1]);
                    done += if rotations { m * (b.rotation[n] - a.rotation[n]) } else { 0.0 };
                }
                gap += given.work - done;
                size += given.work.abs();
            }
            gap.abs() / size
        };
        let gaps = [3, 6, 12, 24].map(gap);
        println!("swinging, turning {rotations}: {:?}", gaps.map(|gap| format!("{gap:.1e}")));
        assert!(gaps[3] < 5e-3 && gaps[3] < 0.2 * gaps[1], "{gaps:?}");
    }
}

/// An open chain that bends, wet on its left, and a straight one, their backing in the water too: nodes carry the water's
/// weight, and its moment at the ends, as virtual work shares them out.
#[test]
fn a_chain_in_still_water_carries_its_weight() {
    for rotations in [false, true] {
        let rest: Vec<[f64; 2]> = (0..=6).map(|k| [0.3 - 0.1 * f64::from(k), -0.2]).collect();
        let topology = Topology { rotations, ..Topology::of(rest.clone()).open(0..7, Side::Left, 0.4) };
        let mut spec = FluidElementSpec::new(0.02, 0.7, 0.5).with_sound_speed(20.0);
        spec.water.kinematic_viscosity = 0.01;
        let nodes = HostNodes::at_rest(rest);
        let nodes = if rotations { nodes.with_rotations() } else { nodes };
        let mut element = spec.size(&topology).expect("a sound element").build(&nodes).expect("water");
        let (mut forces, mut mean) = (vec![[0.0; 3]; 7], [0.0; 7]);
        for k in 0..20 {
            element.contribute(HostStep { dt: 0.02, nodes: &nodes }, &mut forces).expect("a step");
            (0..7).for_each(|n| mean[n] += if k >= 10 { 0.1 * forces[n][1] } else { 0.0 });
        }
        // the water next to the backing pushes its ends inwards, a third of the depth above the chain: a moment on the last
        // sides, which straight ones carry as a couple of forces
        let (weight, moment) = (9810.0 * 0.2 * 0.1, 9810.0 * 0.2_f64.powi(3) / 6.0);
        let couple = if rotations { 0.0 } else { moment / 0.1 };
        let exact =
            [0.5 * weight + couple, weight - couple, weight, weight, weight, weight - couple, 0.5 * weight + couple];
        println!("{rotations}: {mean:.1?} N/m against {exact:.1?}");
        let near = |found: f64, exact: f64| (found - exact).abs() < 0.02 * weight;
        assert!((2..5).all(|k| near(mean[k], weight)), "{mean:?}");
        assert!(near(mean[0] + mean[1], 1.5 * weight) && near(mean[0], mean[6]), "{mean:?}");
        if !rotations {
            assert!((0..7).all(|k| near(mean[k], exact[k]) && forces[k][2] == 0.0), "{mean:?} against {exact:?}");
        }
    }
}
