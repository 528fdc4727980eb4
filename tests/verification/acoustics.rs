//! Sound in a closed box (THEORY E3, E4, E6): the first mode between two walls has the period 2L/c₀.

use evidence::statistics::period;
use evidence::systems::advance;
use fsi_coupling::fill::{Basin, Tiling};
use fsi_coupling::{Coupled, Outline, PrescribedBody, Scheme, Shape, Tank, WettedBody};
use sph_core::eos::Tait;
use sph_core::{Fluid, Integrator, Kernel, Parameters, Seed, Slip, WallTreatment};

const LENGTH: f64 = 1.0;
const HEIGHT: f64 = 1.0;
const SOUND: f64 = 50.0;
/// Pressure that keeps the whole box above tension, and the sound's amplitude [Pa]: Mach 1e-4, so linear.
const PRESSURE: [f64; 2] = [5000.0, 250.0];

/// A box full of water under a fixed lid, with p = p₀ + A cos(π x/L).
fn box_of_sound(spacing: f64) -> Coupled {
    let parameters = Parameters {
        eos: Tait { rho0: 1000.0, c0: SOUND, gamma: 1.0 },
        kernel: Kernel::WendlandC2,
        smoothing_ratio: 1.5,
        gravity: [0.0; 2],
        alpha: 0.0,
        nu: 0.0,
        delta: 0.1,
        shifting: false,
        volume_correction: false,
        slip: Slip::Free,
        integrator: Integrator::Symplectic,
        cfl: 0.6,
        mirror: None,
        walls: WallTreatment::default(),
    };
    let (x, y) = ([0.0, LENGTH], [-HEIGHT, 0.0]);
    let tiling = Tiling::new(Basin { x, y, fine_x: x, fine_depth: HEIGHT, spacing, growth: 1.0 });
    let mut seeds = Vec::new();
    tiling.for_each(|cell| {
        let pressure = PRESSURE[0] + PRESSURE[1] * (std::f64::consts::PI * cell.at[0] / LENGTH).cos();
        seeds.push(Seed { at: cell.at, velocity: [0.0; 2], area: cell.area(), pressure });
    });
    // the lid covers the side walls' rims, so that the corners are closed
    let lid = Outline::of(&Shape::Box { breadth: LENGTH + 6.0 * spacing, height: 6.0 * spacing }).expect("a box");
    let still = PrescribedBody::steady([0.5 * LENGTH, 3.0 * spacing], 0.0, [0.0; 2], 0.0);
    let lid: Box<dyn WettedBody> = Box::new(PrescribedBody::new("lid", lid, false, still));
    let tank: Box<dyn WettedBody> = Box::new(Tank::new(tiling, x, -HEIGHT, 0.0, false));
    Coupled::new(Fluid::new(parameters, &seeds), vec![lid, tank], Scheme::Weak, spacing).expect("a box of water")
}

/// Relative error of the first mode's period over four periods.
fn period_error(cells: f64) -> f64 {
    let mut system = box_of_sound(LENGTH / cells);
    let exact = 2.0 * LENGTH / SOUND;
    let mut mode = Vec::new();
    advance(&mut system, 4.0 * exact, |s| {
        let (p, d) = (&s.fluid.particles, &s.fluid.derived);
        let share = |k: usize| (d.pressure[k] - PRESSURE[0]) * (std::f64::consts::PI * p.x[k] / LENGTH).cos();
        mode.push([s.fluid.time, (0..p.len()).map(share).sum::<f64>()]);
    })
    .expect("a stable run");
    period(&mode) / exact - 1.0
}

/// Sound travels at c₀, to 1.5 % over 40 cells. The error is of first order in the spacing, not of second as inside the
/// fluid, and larger in a lower box, so it comes from the rows beside the walls: there E10 counts how fast the water
/// comes at the wall, and not how fast it is stretched along it.
#[test]
fn sound_crosses_a_closed_box_at_its_speed() {
    let (coarse, fine) = (period_error(20.0), period_error(40.0));
    let order = (coarse / fine).log2();
    assert!(fine.abs() < 0.015, "40 cells: period off by {:.3} %", 100.0 * fine);
    assert!((0.8..2.2).contains(&order), "period off by {coarse:.4}, then {fine:.4}: observed order {order:.2}");
}
