//! Regression: what our own runs did, frozen. Nothing here says that a result is right; a change says that the work
//! or the order of its sums has changed, which must be meant.
//!
//! Integers only are frozen: counts of particles, rebuilds and pairs. States are compared bit by bit within one process
//! and never stored, because `sin`, `powf` and `hypot` come from the system's mathematical library, whose last bit
//! differs between systems. To mint new counters: run `cargo test --release --workspace --test regression`, take the
//! numbers from the failure's `left`, and say in the commit what changed them.

mod drift;

use std::hash::{DefaultHasher, Hash, Hasher};

use evidence::systems::{system, take};
use fsi_coupling::Coupled;
use rayon::ThreadPoolBuilder;

/// Steps taken in each scene.
const STEPS: usize = 120;

/// Tiny scenes, with and without a moving body, a mirror, grading, gravity.
const SCENES: [(&str, &[&str]); 3] = [
    ("wedge_constant", &["resolution.spacing=0.1"]),
    ("dam_break", &["resolution.spacing=0.05"]),
    ("floating_box", &["resolution.spacing=0.033", "body.position=[0.0, 0.05]", "body.angle_deg=8"]),
];

fn stepped(name: &str, sets: &[&str]) -> Coupled {
    let mut system = system(name, sets);
    take(&mut system, STEPS).expect("a stable run");
    system
}

/// A hash of every bit that a restart would need, and of the forces on the walls.
fn bits(system: &Coupled) -> u64 {
    let (p, w) = (system.fluid.particles(), &system.walls);
    let mut hasher = DefaultHasher::new();
    p.id.hash(&mut hasher);
    for array in [&p.x, &p.y, &p.u, &p.v, &p.rho, &p.mass, &p.h, &p.ax, &p.ay, &w.x, &w.y, &w.fx, &w.fy] {
        array.iter().for_each(|value| value.to_bits().hash(&mut hasher));
    }
    system.fluid.time().to_bits().hash(&mut hasher);
    hasher.finish()
}

/// Sums run in a fixed order whatever the number of threads (one gather per target): the same bits with one thread,
/// two, three, and again.
#[test]
fn the_bits_do_not_depend_on_threads_and_come_again() {
    for (name, sets) in SCENES {
        let with = |threads: usize| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
            pool.install(|| bits(&stepped(name, sets)))
        };
        let one = with(1);
        assert_eq!([with(1), with(2), with(3)], [one; 3], "{name}: other bits, with 1, 2 and 3 threads");
    }
}

/// The passes of the options are gathers too: the same bits with one thread and with three.
#[test]
fn the_options_bits_do_not_depend_on_threads() {
    let coarse = "resolution.spacing=0.05";
    let eddies = ["fluid.kinematic_viscosity=1e-6", "fluid.turbulence=sps", "fluid.density_filter=mls"];
    for sets in [
        [&eddies[..], &[coarse, "fluid.xsph=0.5", "fluid.integrator=beeman"]].concat(),
        vec![coarse, "fluid.equation_of_state=ideal_gas", "fluid.molar_mass=2.1", "fluid.integrator=verlet"],
        vec![coarse, "fluid.density_filter=shepard", "fluid.density_filter_every=5"],
        vec![coarse, "fluid.dissipation=riemann"],
    ] {
        let with = |threads: usize| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
            pool.install(|| bits(&stepped("dam_break", &sets)))
        };
        assert_eq!(with(1), with(3), "{sets:?}");
    }
}

/// So are the sums of the coupling schemes, of rigid bodies and of bodies that bend.
#[test]
fn the_couplings_bits_do_not_depend_on_threads() {
    let boxed = ["resolution.spacing=0.033", "body.mass=4", "body.position=[0.0, -0.2]", "body.angle_deg=8"];
    for (name, sets) in [("floating_box", &boxed[..]), ("flexible_wedge", &["resolution.spacing=0.02"])] {
        for scheme in ["coupling.scheme=added_mass", "coupling.scheme=iqn_ils"] {
            let sets = [sets, &[scheme]].concat();
            let with = |threads: usize| {
                let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
                pool.install(|| bits(&stepped(name, &sets)))
            };
            assert_eq!(with(1), with(3), "{name}: {scheme}");
        }
    }
}

/// The hash changes with a single bit, so that equal hashes mean equal states.
#[test]
fn the_hash_changes_with_the_last_bit_of_one_particle() {
    let (name, sets) = SCENES[0];
    let mut system = stepped(name, sets);
    let before = bits(&system);
    let last = system.fluid.particles().len() - 1;
    let rho = &mut system.fluid.particles_mut().rho[last];
    *rho = f64::from_bits(rho.to_bits() ^ 1);
    assert_ne!(bits(&system), before);
}

/// Work done: particles of fluid and walls, rebuilds of the neighbour lists, pairs of fluid and of fluid with wall in
/// the last lists.
#[test]
fn the_work_of_a_run_is_what_it_was() {
    let work = SCENES.map(|(name, sets)| {
        let system = stepped(name, sets);
        let search = system.fluid.neighbours();
        let pairs = [search.fluid.pairs(), search.walls_of_fluid.pairs()];
        (name, [system.fluid.particles().len(), system.walls.len()], search.rebuilds, pairs)
    });
    let frozen = [
        ("wedge_constant", [1264, 505], 9, [40514, 712]),
        ("dam_break", [288, 426], 12, [7024, 805]),
        ("floating_box", [1072, 423], 10, [27212, 2083]),
    ];
    assert_eq!(work, frozen);
}
