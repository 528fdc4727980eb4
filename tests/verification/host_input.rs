//! The embedding element: what is refused, with which words; what is sized and shown.

use evidence::host_wedge::{MASS, bits, element, moved, placed, spec, wedge_of_nodes};
use fsi_coupling::Motion;
use fsi_coupling::embed::{FluidElementSpec, HostError, HostNodes, HostStep, Topology};

/// Bad input changes nothing and says which node or array, what was given, what expected.
#[test]
fn bad_steps_are_refused_and_change_nothing() {
    let (mut element, nodes) = element();
    let mut forces = vec![[7.0; 3]; nodes.len()];
    let good = moved(&nodes, [0.0, -6.15e-3], [0.0, -6.15]);
    let before = bits(&element, &forces);
    let mut said = |dt: f64, nodes: &HostNodes, forces: &mut [[f64; 3]]| {
        element.contribute(HostStep { dt, nodes }, forces).expect_err("refused").to_string()
    };
    let with = |change: fn(&mut HostNodes)| {
        let mut nodes = good.clone();
        change(&mut nodes);
        nodes
    };
    let count = nodes.len();
    let short = with(|n| n.position.truncate(4));
    assert_eq!(
        said(1e-3, &short, &mut forces),
        format!("positions: given {} values, expected {count}, one for each node", count - 1)
    );
    assert!(said(1e-3, &good, &mut forces[1..]).starts_with(&format!("nodal forces: given {} values", count - 1)));
    let turned = with(|n| n.rotation = vec![0.0; n.position.len()]);
    assert_eq!(
        said(1e-3, &turned, &mut forces),
        format!("rotations: given {count} values, expected 0, one for each node")
    );
    let lost = said(1e-3, &with(|n| n.velocity[2][0] = f64::NAN), &mut forces);
    assert!(lost.starts_with("node 2 at t = 1.000000e-3 s: velocity [NaN, -6.15], expected finite numbers"), "{lost}");
    let fast = said(1e-3, &with(|n| n.position[1][0] += 0.5), &mut forces);
    assert!(fast.starts_with("node 1 at t = 1.000000e-3 s: mean speed 5.0"), "{fast}");
    for dt in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
        let said = said(dt, &good, &mut forces);
        assert!(said.starts_with(&format!("step of {dt} s at t = 0.000000e0 s, expected")), "{said}");
    }
    assert!(bits(&element, &forces) == before, "nothing has changed");
    assert_eq!(element.restore(), Err(HostError::NothingSaved));
    element.contribute(HostStep { dt: 1e-3, nodes: &good }, &mut forces).expect("a good step");
}

/// Surfaces and waters that cannot be are refused before anything is built.
#[test]
fn bad_elements_are_refused_before_they_are_built() {
    let (topology, nodes) = wedge_of_nodes();
    let said =
        |spec: FluidElementSpec, topology: &Topology| spec.size(topology).map(|_| ()).expect_err("refused").to_string();
    let thin = said(FluidElementSpec { spacing: 0.06, ..spec() }, &topology);
    assert!(thin.contains("thick where it is thinnest, expected 0.3600 m at least"), "{thin}");
    assert!(said(FluidElementSpec { reach: 0.2, ..spec() }, &topology).contains("expected x between the walls"));
    assert!(
        said(FluidElementSpec { spacing: 1e-7, ..spec() }, &topology)
            .starts_with("`spacing` = 1e-7: expected at least")
    );
    let mut crossed = topology.clone();
    crossed.nodes.swap(0, 1);
    assert!(said(spec(), &crossed).contains("cross"), "{}", said(spec(), &crossed));
    let elsewhere = moved(&nodes, [0.0, 0.1], [0.0, -6.15]);
    let Err(refused) = spec().size(&topology).expect("sound").build(&elsewhere) else { panic!("built elsewhere") };
    assert!(refused.to_string().starts_with("node 0 at t = 0.000000e0 s: position"), "{refused}");
}

/// What `size` says is what `build` makes.
#[test]
fn what_is_sized_is_what_is_built() {
    let (topology, nodes) = wedge_of_nodes();
    let sized = spec().size(&topology.weighing(vec![MASS / 5.0; 5])).expect("a sound element");
    let (fluid, walls, dt) = (sized.fluid_particles(), sized.wall_particles(), sized.fluid_dt());
    println!("{fluid} + {walls} particles, {} bytes, {dt} s, {:?}", sized.bytes(), sized.added_mass());
    println!("{:?}", sized.warnings());
    let element = sized.build(&nodes).expect("water");
    assert_eq!((element.system().fluid.particles().len(), element.system().walls.len()), (fluid, walls));
    let first = element.fluid_dt().expect("a stable step");
    assert!(first <= dt && first > 0.9 * dt, "{first} s, {dt} s said");
}

/// A snapshot is plain data that goes to a file and back.
#[test]
fn a_snapshot_goes_to_a_file_and_back() {
    let (mut element, nodes) = element();
    let end = moved(&nodes, [0.0, -6.15e-3], [0.0, -6.15]);
    element.contribute(HostStep { dt: 1e-3, nodes: &end }, &mut vec![[0.0; 3]; nodes.len()]).expect("a step");
    let snapshot = element.snapshot();
    assert_eq!(snapshot.position.len(), element.system().fluid.particles().len());
    assert_eq!((snapshot.surface[0].len(), &snapshot.nodes), (nodes.len(), &end));
    assert!(snapshot.pressure.iter().any(|p| *p > 1e4) && snapshot.spacing.iter().all(|s| *s > 0.01));
    let text = serde_json::to_string(&snapshot).expect("plain numbers");
    let again: fsi_coupling::embed::Snapshot = serde_json::from_str(&text).expect("what was written");
    let gap = |k: usize, axis: usize| (again.position[k][axis] - snapshot.position[k][axis]).abs();
    assert!((0..snapshot.position.len()).all(|k| gap(k, 0) + gap(k, 1) < 1e-15));
    assert!(again.surface == snapshot.surface && again.pressure.len() == snapshot.pressure.len());
}

/// The frame that `placed` makes is the scene's.
#[test]
fn nodes_of_a_frame_turn_with_it() {
    let motion =
        Motion { position: [1.0, 2.0], angle: 0.5, velocity: [3.0, 0.0], angular_velocity: 2.0, ..Motion::default() };
    let nodes = placed(&[[0.0, 1.0]], &motion);
    assert!((nodes.position[0][0] - (1.0 - 0.5_f64.sin())).abs() < 1e-15);
    assert!((nodes.velocity[0][0] - (3.0 - 2.0 * 0.5_f64.cos())).abs() < 1e-15);
}
