//! Allocations of a step through the C interface, and of the same step in Rust.

use std::alloc::{GlobalAlloc, Layout, System};
use std::ffi::CString;
use std::ptr::null_mut;
use std::sync::atomic::{AtomicU64, Ordering};

use fsi_coupling::embed::HostNodes;
use run::host::{HostedRun, HostedScene, Interface};

use crate::element::{
    splashdown_contribute, splashdown_element, splashdown_free_element, splashdown_restore, splashdown_save,
};
use crate::scene::{splashdown_build, splashdown_open};
use crate::status::splashdown_status::SPLASHDOWN_OK;

/// The allocator of the system, with counts.
struct Counting;

static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);
static BYTES: AtomicU64 = AtomicU64::new(0);

fn count(bytes: usize) {
    ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
    BYTES.fetch_add(bytes as u64, Ordering::Relaxed);
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

// SAFETY: the allocator of the system does the work.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size());
        // SAFETY: passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        // SAFETY: passed on.
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size);
        // SAFETY: passed on.
        unsafe { System.realloc(memory, layout, size) }
    }
}

/// The wedge with some 10 000 particles.
const SETTINGS: [&str; 4] = ["resolution.spacing=0.0069", "resolution.growth=1", "tank.width=1.6", "tank.depth=0.6"];
/// One step of the water.
const DT: f64 = 1e-5;

fn in_rust() -> (HostedRun, HostNodes) {
    let scene = HostedScene::open("wedge", &SETTINGS.map(String::from), Interface::Body).expect("a built-in scene");
    println!("{} particles", scene.fluid_particles());
    let nodes = scene.nodes().clone();
    (scene.build(&nodes).expect("water"), nodes)
}

fn in_c(nodes: &HostNodes) -> *mut splashdown_element {
    let texts = SETTINGS.map(|text| CString::new(text).expect("no zero"));
    let settings = texts.each_ref().map(|text| text.as_ptr());
    let (mut scene, mut element) = (null_mut(), null_mut());
    // SAFETY: texts end with a zero, arrays have the lengths that are given.
    unsafe {
        assert_eq!(splashdown_open(c"wedge".as_ptr(), settings.as_ptr(), SETTINGS.len(), 0, &mut scene), SPLASHDOWN_OK);
        let [at, v] = [nodes.position[0].as_ptr(), nodes.velocity[0].as_ptr()];
        let built = splashdown_build(scene, at, v, nodes.rotation.as_ptr(), nodes.spin.as_ptr(), 1, &mut element);
        assert_eq!(built, SPLASHDOWN_OK);
    }
    element
}

fn step_in_c(element: *mut splashdown_element, nodes: &HostNodes, forces: &mut [[f64; 3]; 1]) {
    let [at, v] = [nodes.position[0].as_ptr(), nodes.velocity[0].as_ptr()];
    let (angle, spin) = (nodes.rotation.as_ptr(), nodes.spin.as_ptr());
    // SAFETY: one node, three forces.
    let status = unsafe {
        splashdown_contribute(element, DT, at, v, angle, spin, 1, forces.as_flattened_mut().as_mut_ptr(), null_mut())
    };
    assert_eq!(status, SPLASHDOWN_OK);
}

fn fall(nodes: &mut HostNodes) {
    nodes.position[0][1] += DT * nodes.velocity[0][1];
}

/// Allocations and bytes of a step.
fn counted(step: impl FnOnce()) -> [u64; 2] {
    let counts = || [&ALLOCATIONS, &BYTES].map(|count| count.load(Ordering::Relaxed));
    let before = counts();
    step();
    let after = counts();
    [after[0] - before[0], after[1] - before[1]]
}

/// The same step, restored and redone, through either interface, on one thread: the nodes' arrays are read in place.
#[test]
fn a_step_through_the_c_interface_allocates_what_a_step_in_rust_does_and_gives_the_same_force() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the first pool");
    let (mut rust, mut nodes) = in_rust();
    let element = in_c(&nodes);
    let (mut forces, mut of_c) = ([[0.0; 3]], [[0.0; 3]]);
    for _ in 0..20 {
        fall(&mut nodes);
        rust.contribute(DT, &nodes, &mut forces).expect("a step");
        step_in_c(element, &nodes, &mut of_c);
        assert_eq!(forces, of_c);
    }
    rust.save();
    assert_eq!(splashdown_save(element), SPLASHDOWN_OK);
    fall(&mut nodes);
    let mut fewest = [[u64::MAX; 2]; 2];
    for _ in 0..10 {
        rust.restore().expect("the state");
        assert_eq!(splashdown_restore(element), SPLASHDOWN_OK);
        let found = [
            counted(|| drop(rust.contribute(DT, &nodes, &mut forces).expect("a step"))),
            counted(|| step_in_c(element, &nodes, &mut of_c)),
        ];
        assert_eq!(forces, of_c);
        for k in 0..2 {
            fewest[k] = fewest[k].min(found[k]); // the pool allocates a block of jobs now and then
        }
    }
    println!("allocations and bytes of a step: {:?} in Rust, {:?} through C", fewest[0], fewest[1]);
    assert_eq!(fewest[0], fewest[1]);
    assert_eq!(splashdown_free_element(element), SPLASHDOWN_OK);
}
