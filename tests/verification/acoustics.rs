//! Sound in a closed box (THEORY WC2, WC3, WC5): the first mode between two walls has the period 2L/c₀.

use evidence::parameters::Parameters;
use evidence::statistics::period;
use evidence::systems::advance;
use fsi_coupling::geometry::layout::{Basin, Layout};
use fsi_coupling::{Body, Coupled, Outline, PrescribedBody, Scheme, Shape, Tank};
use sph_core::wcsph::eos::Tait;
use sph_core::{Fluid, IdealGas, Seed};

const LENGTH: f64 = 1.0;
const HEIGHT: f64 = 1.0;
const SOUND: f64 = 50.0;
/// Pressure that keeps the whole box above tension, and the sound's amplitude [Pa]: Mach 1e-4, so linear.
const PRESSURE: [f64; 2] = [5000.0, 250.0];

/// Water in which nothing dissipates.
pub(crate) fn lossless() -> Parameters {
    let eos = Tait { rho0: 1000.0, c0: SOUND, gamma: 1.0 };
    Parameters { alpha: 0.0, delta: 0.0, shifting: false, ..Parameters::usual(eos) }
}

/// A box full of fluid under a fixed lid, with p = p₀ + A cos(π x/L); `prepare` may change the state that has it.
pub(crate) fn box_of_sound(spacing: f64, parameters: Parameters, prepare: impl Fn(&mut Fluid, &[Seed])) -> Coupled {
    let (x, y) = ([0.0, LENGTH], [-HEIGHT, 0.0]);
    let layout = Layout::new(Basin { x, y, fine_x: x, fine_depth: HEIGHT, spacing, growth: 1.0 });
    let mut seeds = Vec::new();
    layout.for_each(|cell| {
        let pressure = PRESSURE[0] + PRESSURE[1] * (std::f64::consts::PI * cell.at[0] / LENGTH).cos();
        seeds.push(Seed { at: cell.at, velocity: [0.0; 2], area: cell.area(), pressure });
    });
    // the lid covers the side walls' rims, so that the corners are closed
    let lid = Outline::of(&Shape::Box { breadth: LENGTH + 6.0 * spacing, height: 6.0 * spacing }).expect("a box");
    let still = PrescribedBody::steady([0.5 * LENGTH, 3.0 * spacing], 0.0, [0.0; 2], 0.0);
    let lid: Box<dyn Body> = Box::new(PrescribedBody::new("lid", lid, false, still));
    let tank: Box<dyn Body> = Box::new(Tank::new(layout, x, -HEIGHT, 0.0, false));
    let mut fluid = parameters.fluid(&seeds);
    prepare(&mut fluid, &seeds);
    Coupled::new(fluid, vec![lid, tank], Scheme::Weak, spacing).expect("a full box")
}

/// Relative error of the first mode's period over four periods, in a fluid whose sound has the speed `sound` [m/s].
fn period_error(mut system: Coupled, sound: f64) -> f64 {
    let exact = 2.0 * LENGTH / sound;
    let mut mode = Vec::new();
    advance(&mut system, 4.0 * exact, |s| {
        let (p, d) = (s.fluid.particles(), s.fluid.fields());
        let share = |k: usize| (d.pressure[k] - PRESSURE[0]) * (std::f64::consts::PI * p.x[k] / LENGTH).cos();
        mode.push([s.fluid.time(), (0..p.len()).map(share).sum::<f64>()]);
    })
    .expect("a stable run");
    period(&mode) / exact - 1.0
}

/// Sound travels at c₀, to 1.5 % over 40 cells. The error is of first order in the spacing, not of second as inside the
/// fluid, and larger in a lower box, so it comes from the layers next to the walls: there WA4 counts how fast the water
/// comes at the wall, and not how fast it is stretched along it.
#[test]
fn sound_crosses_a_closed_box_at_its_speed() {
    let water = |cells: f64| box_of_sound(LENGTH / cells, Parameters { delta: 0.1, ..lossless() }, |_, _| ());
    let (coarse, fine) = (period_error(water(20.0), SOUND), period_error(water(40.0), SOUND));
    let order = (coarse / fine).log2();
    assert!(fine.abs() < 0.015, "40 cells: period off by {:.3} %", 100.0 * fine);
    assert!((0.8..2.2).contains(&order), "period off by {coarse:.4}, then {fine:.4}: observed order {order:.2}");
}

/// Walls that feel the water stretch along them halve the error.
#[test]
fn sound_along_walls_that_feel_the_stretching_is_nearer_its_speed() {
    let box_ = |wall_stretch| {
        let parameters = Parameters { delta: 0.1, wall_stretch, ..lossless() };
        period_error(box_of_sound(LENGTH / 20.0, parameters, |_, _| ()), SOUND)
    };
    let (without, with) = (box_(false), box_(true));
    assert!(with.abs() < 0.6 * without.abs(), "20 cells: period off by {without:.4} without, {with:.4} with");
}

/// Sound in a gas (THEORY LE11, LE12) is adiabatic: its speed is √(γ R T/M), not Newton's √(R T/M), which is 18 % less. The
/// box's error of 2.2 % at 20 cells is that of water.
#[test]
fn sound_in_a_gas_is_adiabatic() {
    let air = IdealGas { rho0: 1.225, gamma: 1.4, temperature: 288.15, molar_mass: 0.028_964_4 };
    let sound = air.sound_speed_at_rest();
    let eos = Tait { rho0: air.rho0, c0: sound, gamma: air.gamma };
    let parameters = Parameters { eos, gas: Some([air.temperature, air.molar_mass]), delta: 0.1, ..lossless() };
    let system = box_of_sound(LENGTH / 20.0, parameters, |fluid, seeds| {
        let rest = air.ambient() + PRESSURE[0];
        for (k, seed) in seeds.iter().enumerate() {
            // isentropic about the uniform state of temperature T₀ and pressure `rest`
            let pressure = air.ambient() + seed.pressure;
            let dense = air.density(PRESSURE[0], air.energy_at_rest());
            let rho = dense * (pressure / rest).powf(1.0 / air.gamma);
            let p = fluid.particles_mut();
            p.mass[k] *= rho / p.rho[k];
            p.rho[k] = rho;
            p.energy[k] = pressure / ((air.gamma - 1.0) * rho);
        }
    });
    let error = period_error(system, sound);
    assert!(error.abs() < 0.03, "period off by {:.2} %", 100.0 * error);
}
