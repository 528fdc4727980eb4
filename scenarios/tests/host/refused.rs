//! Input that is refused, with what was given and what was expected; nothing changes.

use run::host::{ErrorKind, HostedError};

use super::*;

fn said(opened: Result<HostedScene, HostedError>) -> String {
    let error = opened.err().expect("refused");
    assert_eq!(error.kind(), ErrorKind::Input);
    error.to_string()
}

#[test]
fn scenes_that_no_host_can_move() {
    let open = |scene: &str, sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        HostedScene::open(scene, &sets, Interface::Body)
    };
    assert!(said(open("dam_break", &[])).contains("no body"));
    assert!(said(open("plate_drop", &[])).contains("body.panels"));
    assert!(said(open("wedge", &["model=wagner"])).contains("wagner"));
    assert!(said(open("wegde", &[])).contains("wedge"));
    assert!(said(open("wedge", &["resolution.spacing=-1"])).contains("resolution.spacing"));
    assert!("corners".parse::<Interface>().unwrap_err().to_string().contains("turning_nodes"));
    assert!(open("wedge", &["model=auto"]).is_ok(), "particles where the program chooses");
}

#[test]
fn water_that_does_not_fit_in_memory() {
    let scene = CASES[0].open(&["resolution.spacing=2e-5", "resolution.growth=1"]);
    let nodes = scene.nodes().clone();
    let error = scene.build(&nodes).err().expect("more than any machine has");
    assert_eq!(error.kind(), ErrorKind::Input);
    assert!(error.to_string().contains("bytes of memory"), "{error}");
}

#[test]
fn steps_that_are_refused_change_nothing() {
    let (mut run, start) = CASES[1].build(&[]);
    let before = run.to_bytes().expect("a state");
    let mut forces = vec![[7.0; 3]; start.len()];
    let dt = 1e-4;
    let good = moved(&start, dt);
    let mut refuse = |dt: f64, nodes: &HostNodes, forces: &mut [[f64; 3]], expected: &str| {
        let error = run.contribute(dt, nodes, forces).expect_err(expected);
        assert_eq!(error.kind(), ErrorKind::Input, "{error}");
        assert!(error.to_string().contains(expected), "{error}");
        assert!(forces.iter().all(|force| *force == [7.0; 3]));
        assert!(run.to_bytes().expect("a state") == before, "{error}");
    };
    for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refuse(dt, &good, &mut forces, "expected a number above 0");
    }
    refuse(1e3, &good, &mut forces, "most_substeps");
    let with = |change: &dyn Fn(&mut HostNodes)| {
        let mut nodes = good.clone();
        change(&mut nodes);
        nodes
    };
    refuse(dt, &with(&|n| n.position[2][1] = f64::NAN), &mut forces, "node 2");
    refuse(dt, &with(&|n| n.velocity[0][0] = f64::INFINITY), &mut forces, "node 0");
    let sink = |n: &mut HostNodes| n.position.iter_mut().for_each(|at| at[1] -= 1e4);
    refuse(dt, &with(&sink), &mut forces, "speed of sound");
    refuse(dt, &with(&|n| n.position.truncate(2)), &mut forces, "positions: given 2 values");
    refuse(dt, &with(&|n| n.rotation = vec![0.0; 5]), &mut forces, "rotations");
    let lean = |n: &mut HostNodes| n.position.iter_mut().for_each(|at| at[0] += 1e-4);
    refuse(dt, &with(&lean), &mut forces, "the image in x = 0 of node");
    refuse(dt, &good, &mut [[7.0; 3]; 2], "nodal forces: given 2 values");
    assert_eq!(run.restore().unwrap_err().kind(), ErrorKind::NothingSaved);
    let error = run.restore_bytes(&before[..20]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::State, "{error}");
    assert_eq!(run.contribute(dt, &good, &mut forces).unwrap_err().kind(), ErrorKind::Failed);
    run.restore_bytes(&before).expect("its own bytes");
    run.contribute(dt, &good, &mut forces).expect("a step");
}

#[test]
fn nodes_that_stand_elsewhere_are_refused() {
    let scene = CASES[1].open(&[]);
    let mut nodes = scene.nodes().clone();
    nodes.position[1][1] += 0.01;
    let error = scene.build(&nodes).err().expect("refused");
    assert!(error.to_string().contains("node 1") && error.kind() == ErrorKind::Input, "{error}");
}

/// Of a half model nodes move as each other's images, in every quantity; a body does not leave the plane.
#[test]
fn motions_that_are_not_symmetric_are_refused_in_a_half_model() {
    let dt = 1e-4;
    let said = |case: Case, change: &dyn Fn(&mut HostNodes)| {
        let (mut run, start) = case.build(&[]);
        let mut nodes = moved(&start, dt);
        change(&mut nodes);
        let error = run.contribute(dt, &nodes, &mut vec![[0.0; 3]; start.len()]).expect_err("refused");
        assert_eq!(error.kind(), ErrorKind::Input, "{error}");
        assert!(error.to_string().contains("only one half of the water is simulated"), "{error}");
        let scene = case.open(&[]);
        let mut nodes = scene.nodes().clone();
        change(&mut nodes);
        assert_eq!(scene.build(&nodes).err().expect("refused").kind(), ErrorKind::Input);
    };
    said(CASES[0], &|n| n.velocity[0][0] = 2.0);
    said(CASES[0], &|n| n.spin[0] = 2.0);
    said(CASES[0], &|n| n.rotation[0] = 0.01);
    said(CASES[1], &|n| n.velocity[0][1] += 0.5);
    let turning = Case { interface: Interface::TurningNodes, ..CASES[1] };
    said(turning, &|n| n.rotation[0] = 0.3);
    said(turning, &|n| n.spin[0] = 3.0);
}

#[test]
fn speeds_beyond_sound_are_refused_at_the_start_and_at_the_outline() {
    let scene = CASES[5].open(&[]);
    let mut nodes = scene.nodes().clone();
    nodes.velocity[0][1] = -1e4;
    assert!(scene.build(&nodes).err().expect("refused").to_string().contains("speed of sound"));
    let (mut run, start) = CASES[5].build(&[]);
    let mut nodes = moved(&start, 1e-4);
    nodes.spin[0] = 1e6;
    let error = run.contribute(1e-4, &nodes, &mut [[0.0; 3]]).expect_err("refused");
    assert!(error.kind() == ErrorKind::Input && error.to_string().contains("turning at the outline"), "{error}");
}

/// A state of another water, or with a byte changed anywhere, is refused.
#[test]
fn states_that_are_damaged_or_of_another_scene_are_refused() {
    let (run, _) = CASES[0].build(&[]);
    let bytes = run.to_bytes().expect("a state");
    let (mut other, _) = CASES[0].build(&["fluid.density=1025"]);
    let error = other.restore_bytes(&bytes).expect_err("refused");
    assert!(error.kind() == ErrorKind::State && error.to_string().contains("another scene"), "{error}");
    let (mut run, _) = CASES[0].build(&[]);
    for place in (0..bytes.len()).step_by(bytes.len() / 97) {
        let mut damaged = bytes.clone();
        damaged[place] ^= 0x10;
        let error = run.restore_bytes(&damaged).expect_err("refused");
        assert_eq!(error.kind(), ErrorKind::State, "{place}: {error}");
    }
    run.restore_bytes(&bytes).expect("its own bytes");
}
