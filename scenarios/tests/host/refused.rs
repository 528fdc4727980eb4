//! Input that is refused, with what was given and what was expected; nothing changes.

use scenarios::host::{ErrorKind, HostedError};

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
    refuse(dt, &with(&|n| n.position.truncate(2)), &mut forces, "positions of 2 values");
    refuse(dt, &with(&|n| n.rotation = vec![0.0; 5]), &mut forces, "rotations");
    let lean = |n: &mut HostNodes| n.position.iter_mut().for_each(|at| at[0] += 1e-4);
    refuse(dt, &with(&lean), &mut forces, "the image of node");
    refuse(dt, &good, &mut [[7.0; 3]; 2], "nodal forces of 2 values");
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
