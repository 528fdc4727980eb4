//! The bytes that `size` says are those that an element holds. Alone in its process: it counts every
//! allocation.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use fsi_coupling::embed::{FluidElementSpec, HostNodes, HostStep, Topology};

struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static LARGEST: AtomicUsize = AtomicUsize::new(0);

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        HELD.fetch_add(layout.size(), Relaxed);
        LARGEST.fetch_max(layout.size(), Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Relaxed);
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn the_bytes_said_are_the_bytes_held() {
    let box_of = |half: f64| vec![[-half, -0.2], [half, -0.2], [half, 0.3], [-half, 0.3]];
    for (spacing, reach, growth) in [(0.03, 1.5, 1.0), (0.012, 1.5, 1.0), (0.012, 4.0, 1.1), (0.02, 3.0, 1.2)] {
        let corners = box_of(0.3);
        let topology = Topology::of(corners.clone()).closed(0..4);
        let spec =
            FluidElementSpec { growth, ..FluidElementSpec::new(spacing, reach, 0.6 * reach).with_sound_speed(20.0) };
        let before = HELD.load(Relaxed);
        LARGEST.store(0, Relaxed);
        let sized = spec.size(&topology).expect("a sound element");
        let (said, fluid, walls) = (sized.bytes(), sized.fluid_particles(), sized.wall_particles());
        let (of_sizing, largest) = (HELD.load(Relaxed) - before, LARGEST.load(Relaxed));
        let mut nodes = HostNodes::at_rest(corners);
        let mut element = sized.build(&nodes).expect("water");
        let mut forces = vec![[0.0; 3]; 4];
        for _ in 0..40 {
            element.save();
            let dt = element.fluid_dt().expect("a stable step");
            nodes.velocity.fill([0.1, 0.0]);
            nodes.position.iter_mut().for_each(|at| at[0] += 0.1 * dt);
            element.contribute(HostStep { dt, nodes: &nodes }, &mut forces).expect("a step");
        }
        let held = HELD.load(Relaxed) - before;
        println!(
            "{fluid} + {walls} particles: {said} bytes said, {held} held ({:+.1} %); sizing holds {of_sizing}, at most {largest} at \
             once",
            100.0 * (said as f64 / held as f64 - 1.0)
        );
        assert!((said as f64 / held as f64 - 1.0).abs() < 0.2);
        assert!(largest < 300 * walls, "sizing allocates nothing that grows with the water");
    }
}
